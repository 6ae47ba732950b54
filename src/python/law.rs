//! Laws: fitted ones, those of the atlas, and theories, pressed and thrown over arrays.

use crate::array::{Numbers, floats, pair, positive};
use crate::border::{raised, refused, short, warn};
use crate::values::written;
use impactlaw::contact::rebound;
use impactlaw::document::Document;
use impactlaw::export::Target;
use impactlaw::export::source::portable::Portable;
use impactlaw::files::{sha256, write_atomic};
use impactlaw::law::{AnyLaw, Form, LawFile, beyond};
use impactlaw::material::{Material, MaterialTable};
use impactlaw::theory::published::Evidence;
use impactlaw::theory::{FORMULAS, Theory};
use impactlaw::unit::{Length, Velocity, engineering};
use impactlaw::{Error, Result};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use std::path::PathBuf;

/// A law of one body pressed by a rigid plane. See the stubs.
#[pyclass(frozen, module = "impactlaw")]
pub struct Law {
    name: String,
    law: AnyLaw,
    /// Largest flattening that its source supports.
    valid_to: f64,
    material: Material,
    radius: f64,
    file: Option<LawFile>,
    /// SHA-256 of the file it was read from.
    hash: Option<String>,
}

/// The form called `name`.
fn form(name: &str) -> Result<Form> {
    let form = Form::ALL.into_iter().find(|form| form.name() == name);
    form.ok_or_else(|| Error::not_one_of("form", name, Form::ALL.map(Form::name)))
}

impl Law {
    /// The law of a file.
    pub fn of_file(py: Python<'_>, file: LawFile) -> PyResult<Self> {
        Self::read(py, file, None, None)
    }

    /// The same of a file whose text has the SHA-256 `hash`.
    fn read(
        py: Python<'_>,
        file: LawFile,
        form: Option<Form>,
        hash: Option<String>,
    ) -> PyResult<Self> {
        short(py, || {
            let law = AnyLaw::Fitted(file.law_in(form.unwrap_or(file.form))?);
            Ok(Law {
                name: file.name.clone(),
                valid_to: law.valid_to()?,
                law,
                material: file.material(),
                radius: file.provenance.radius_m,
                file: Some(LawFile {
                    form: form.unwrap_or(file.form),
                    ..file
                }),
                hash,
            })
        })
    }

    /// The law of a theory.
    pub fn of_theory(name: &str, law: AnyLaw, material: Material, radius: f64) -> Self {
        Law {
            name: name.to_owned(),
            valid_to: law.valid_to().unwrap_or(f64::INFINITY),
            law,
            material,
            radius,
            file: None,
            hash: None,
        }
    }

    /// Its law file.
    pub fn file(&self, py: Python<'_>) -> PyResult<&LawFile> {
        self.file.as_ref().ok_or_else(|| {
            let allowed = "has no law file: only fitted laws and those of the atlas have one";
            raised(py, refused("theory", self.name.clone(), allowed))
        })
    }

    /// Radius of the body: that which is given, or that of the reference impacts.
    fn body(&self, radius: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
        radius.map_or(Ok(self.radius), |radius| {
            positive::<Length>("radius", radius)
        })
    }

    /// Forces at displacements after a largest one.
    fn forces<'py>(
        &self,
        displacement: &Bound<'py, PyAny>,
        largest: Option<f64>,
        radius: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = displacement.py();
        let given = Numbers::of::<Length>("displacement", displacement)?;
        for &value in &given.values {
            if let Some(allowed) = beyond(radius, value, largest, "largest") {
                let found = engineering(value, "m", 4);
                return Err(raised(py, refused("displacement", found, &allowed)));
            }
        }
        let most = largest.unwrap_or(0.0);
        let forces = short(py, || self.law.forces(radius, most, &given.values))?;
        let limit = self.valid_to * radius;
        let outside = given.values.iter().filter(|d| d.max(most) > limit).count();
        if outside > 0 {
            let limit = engineering(limit, "m", 4);
            let text = format!(
                "{outside} of the displacements lie beyond {limit}, the largest that law {} rests on",
                self.name
            );
            warn(py, &text)?;
        }
        given.like(py, forces)
    }
}

#[pymethods]
impl Law {
    /// Reads a law file.
    #[new]
    #[pyo3(signature = (path, form = None))]
    fn new(py: Python<'_>, path: PathBuf, form: Option<&str>) -> PyResult<Self> {
        let (file, form, hash) = short(py, || {
            let form = form.map(self::form).transpose()?;
            let document = Document::read(&path)?;
            Ok((LawFile::parse(&document)?, form, document.hash()))
        })?;
        Self::read(py, file, form, Some(hash))
    }

    /// The law of a law file's text.
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        let document = Document::new("law.toml".as_ref(), text);
        let file = short(py, || LawFile::parse(&document))?;
        Self::read(py, file, None, Some(document.hash()))
    }

    /// For copies and other processes: a law with a law file is its text.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let text = slf.get().toml(slf.py())?;
        Ok((slf.get_type().getattr("from_toml")?, (text,)))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// `closed_form`, `spline`, `hertz`, or `theory`.
    #[getter]
    fn form(&self) -> &'static str {
        self.file.as_ref().map_or("theory", |file| file.form.name())
    }

    /// Radius of the bodies whose impacts it rests on, m: that of bodies where none is given.
    #[getter]
    fn radius(&self) -> f64 {
        self.radius
    }

    /// Largest displacement over radius that its source supports.
    #[getter]
    fn valid_to(&self) -> f64 {
        self.valid_to
    }

    /// Speeds of the impacts it rests on, m/s; none of a theory.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyTuple>>> {
        let valid = self.file.as_ref().map(|file| &file.valid);
        let range = valid.map(|valid| [valid.velocity_min_m_s, valid.velocity_max_m_s]);
        range.map(|range| pair(py, range)).transpose()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        let file = self.file.as_ref();
        file.map_or_else(Vec::new, |file| file.warnings.clone())
    }

    /// Constants of the material by the names that law files give them.
    #[getter]
    fn material<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        written(py, &MaterialTable::from(&self.material))
    }

    /// Largest error of F*, delta* and e against its own impacts; none where it has no impacts of its own.
    #[getter]
    fn worst_error(&self) -> Option<f64> {
        let own = self.file.as_ref().filter(|file| file.thresholds.is_some());
        own.map(LawFile::worst_error)
    }

    /// Text of the law file.
    #[getter]
    fn toml(&self, py: Python<'_>) -> PyResult<String> {
        let file = self.file(py)?;
        short(py, || file.text())
    }

    /// What the law file holds.
    fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        written(py, self.file(py)?)
    }

    /// Force on first loading, N, without inertia.
    #[pyo3(signature = (displacement, *, radius = None))]
    fn force<'py>(
        &self,
        displacement: &Bound<'py, PyAny>,
        radius: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.forces(displacement, None, self.body(radius)?)
    }

    /// Force on the way back from a largest displacement, and up to it again, N.
    #[pyo3(signature = (displacement, largest, *, radius = None))]
    fn unload<'py>(
        &self,
        displacement: &Bound<'py, PyAny>,
        largest: &Bound<'py, PyAny>,
        radius: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let radius = self.body(radius)?;
        let most = positive::<Length>("largest", largest)?;
        if let Some(allowed) = beyond(radius, most, None, "largest") {
            let error = refused("largest", engineering(most, "m", 4), &allowed);
            return Err(raised(displacement.py(), error));
        }
        self.forces(displacement, Some(most), radius)
    }

    /// Impact of a sphere on the rigid plane.
    #[pyo3(signature = (velocity, *, radius = None))]
    fn rebound<'py>(
        &self,
        velocity: &Bound<'py, PyAny>,
        radius: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Rebound> {
        let py = velocity.py();
        let radius = self.body(radius)?;
        let given = Numbers::of::<Velocity>("velocity", velocity)?;
        let is_speed = |v: &&f64| !(**v > 0.0 && v.is_finite());
        if let Some(wrong) = given.values.iter().find(is_speed) {
            let error = refused(
                "velocity",
                format!("{wrong} m/s"),
                "must be positive and finite",
            );
            return Err(raised(py, error));
        }
        let mass = self.material.sphere_mass(radius);
        let all = short(py, || self.law.rebounds(radius, mass, &given.values))?;
        let column = |of: fn(&rebound::Rebound) -> f64| {
            given
                .like(py, all.iter().map(of).collect())
                .map(Bound::unbind)
        };
        Ok(Rebound {
            velocity: given.like(py, given.values.clone())?.unbind(),
            restitution: column(|r| r.restitution)?,
            max_force: column(|r| r.max_force)?,
            max_displacement: column(|r| r.max_displacement)?,
            residual_displacement: column(|r| r.residual_displacement)?,
            contact_time: column(|r| r.contact_time)?,
        })
    }

    /// Such an impact from first touch to loss of contact, as columns.
    #[pyo3(signature = (velocity, *, radius = None))]
    fn trajectory<'py>(
        &self,
        velocity: &Bound<'py, PyAny>,
        radius: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let py = velocity.py();
        let radius = self.body(radius)?;
        let speed = positive::<Velocity>("velocity", velocity)?;
        let mass = self.material.sphere_mass(radius);
        let states = short(py, || self.law.trajectory(radius, mass, speed))?;
        let columns = PyDict::new(py);
        let add = |name: &str, of: fn(&rebound::State) -> f64| {
            columns.set_item(name, floats(py, states.iter().map(of).collect())?)
        };
        add("time_s", |s| s.time)?;
        add("displacement_m", |s| s.displacement)?;
        add("velocity_m_s", |s| s.velocity)?;
        add("force_N", |s| s.force)?;
        Ok(columns)
    }

    /// Writes the law file.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let file = self.file(py)?;
        short(py, || file.write(&path))
    }

    /// Writes the law for another code into `folder`; returns the files.
    fn export(&self, py: Python<'_>, target: &str, folder: PathBuf) -> PyResult<Vec<PathBuf>> {
        let file = self.file(py)?;
        short(py, || {
            let found = Target::ALL.into_iter().find(|known| known.name() == target);
            let found = found.ok_or_else(|| {
                Error::not_one_of("target", target, Target::ALL.map(Target::name))
            })?;
            let hash = match &self.hash {
                Some(hash) => hash.clone(),
                None => sha256([&file.text()?]),
            };
            let law = Portable::new(file.clone(), None, hash)?;
            let write = |artifact: impactlaw::export::source::artifact::Artifact| {
                let path = folder.join(&artifact.name);
                write_atomic(&path, artifact.text.as_bytes())?;
                Ok(path)
            };
            found.export(&law)?.into_iter().map(write).collect()
        })
    }

    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<Py<PyAny>> {
        let show = slf.py().import("impactlaw._show")?;
        Ok(show.call_method1("law_html", (slf,))?.unbind())
    }

    /// Draws force against displacement, and restitution against speed, with matplotlib.
    #[pyo3(signature = (**options))]
    fn plot(slf: &Bound<'_, Self>, options: Option<&Bound<'_, PyDict>>) -> PyResult<Py<PyAny>> {
        let show = slf.py().import("impactlaw._show")?;
        Ok(show.getattr("plot_law")?.call((slf,), options)?.unbind())
    }

    fn __repr__(&self) -> String {
        format!(
            "<impactlaw.Law {} ({}): R = {:?} m, delta/R up to {:.3}>",
            self.name,
            self.form(),
            self.radius,
            self.valid_to
        )
    }
}

/// Impacts of a sphere on a rigid plane under a law: floats, or arrays in the form of the speeds. See the stubs.
#[pyclass(frozen, get_all, module = "impactlaw")]
pub struct Rebound {
    velocity: Py<PyAny>,
    restitution: Py<PyAny>,
    max_force: Py<PyAny>,
    max_displacement: Py<PyAny>,
    residual_displacement: Py<PyAny>,
    contact_time: Py<PyAny>,
}

#[pymethods]
impl Rebound {
    fn __repr__(&self) -> String {
        format!(
            "<impactlaw.Rebound: e = {}, F* = {} N, delta* = {} m, delta_res = {} m, t_c = {} s>",
            self.restitution,
            self.max_force,
            self.max_displacement,
            self.residual_displacement,
            self.contact_time
        )
    }
}

/// Every published model: name, papers, what it is, constants it needs, whether it gives a force, and what its constants rest on.
#[pyo3::pyfunction]
pub fn theories(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let laws = Theory::ALL.map(|theory| (theory.publication(), true));
    let formulas = FORMULAS.map(|formula| (formula, false));
    let list = PyList::empty(py);
    for (model, gives_force) in laws.into_iter().chain(formulas) {
        let one = PyDict::new(py);
        let needs: Vec<&str> = model.flow.iter().map(|constant| constant.key).collect();
        one.set_item("name", model.name)?;
        one.set_item("summary", model.summary)?;
        one.set_item("papers", model.papers.to_vec())?;
        one.set_item("needs", needs)?;
        one.set_item("gives_force", gives_force)?;
        one.set_item("closed_form_restitution", model.restitution.is_some())?;
        one.set_item("checked", model.evidence == Evidence::Checked)?;
        list.append(one)?;
    }
    Ok(list)
}
