//! Impacts of a case: figures, curves, maps, and the law fitted to them.

use crate::array::shown;
use crate::border::{long, raised, refused, short};
use crate::law::Law;
use crate::values::{columns, numbers, written};
use impactlaw::PROGRAM;
use impactlaw::command::compare::add_fitted;
use impactlaw::command::fit::verdict;
use impactlaw::command::impact_folder;
use impactlaw::compare::Comparison;
use impactlaw::curve::Status;
use impactlaw::fit::fit;
use impactlaw::impact::Simulated;
use impactlaw::law::LawFile;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyList};
use std::path::PathBuf;
use std::sync::Arc;

/// Impacts of a case, slowest first. See the stubs.
#[pyclass(frozen, sequence, module = "impactlaw")]
pub struct Impacts {
    case: Arc<impactlaw::case::Case>,
    all: Vec<Arc<Simulated>>,
}

impl Impacts {
    /// Impacts of `case`.
    pub fn of(case: Arc<impactlaw::case::Case>, all: Vec<Arc<Simulated>>) -> Self {
        Impacts { case, all }
    }

    fn curves(&self) -> Vec<impactlaw::curve::Impact> {
        self.all.iter().map(|one| one.impact.clone()).collect()
    }
}

#[pymethods]
impl Impacts {
    fn __len__(&self) -> usize {
        self.all.len()
    }

    fn __getitem__(&self, index: isize) -> PyResult<Impact> {
        let from_end = index.checked_add_unsigned(self.all.len());
        let index = if index < 0 { from_end } else { Some(index) };
        let one = index.and_then(|index| self.all.get(usize::try_from(index).ok()?));
        let one = one.ok_or_else(|| PyIndexError::new_err("there is no such impact"))?;
        Ok(Impact(one.clone()))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        let all = self.all.iter().map(|one| Impact(one.clone()));
        PyList::new(
            py,
            all.map(|one| Py::new(py, one))
                .collect::<PyResult<Vec<_>>>()?,
        )?
        .try_iter()
    }

    /// Figures of all impacts as columns.
    #[getter]
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let summaries = self.all.iter().map(|one| &one.impact.summary);
        numbers(py, summaries)
    }

    /// Law fitted to all of them.
    fn fit(&self, py: Python<'_>) -> PyResult<Law> {
        let file = long(py, |_| {
            let fit = fit(&self.case, &self.curves())?;
            let file = LawFile::of(&fit, &self.case, PROGRAM);
            // it warns of what the program warns of
            verdict(&file);
            Ok(file)
        })?;
        Law::of_file(py, file)
    }

    /// Rows of `compare.csv` as columns: theories, and the fitted law if one is given.
    #[pyo3(signature = (law = None, *, unverified = false))]
    fn compare<'py>(
        &self,
        py: Python<'py>,
        law: Option<&Law>,
        unverified: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let file = law.map(|law| law.file(py)).transpose()?;
        let comparison = long(py, |_| {
            let case = &self.case;
            let ended = |one: &impactlaw::curve::Impact| one.summary.status == Status::Ok;
            let impacts: Vec<_> = self.curves().into_iter().filter(ended).collect();
            let mut comparison = Comparison::new(&case.material, case.radius, &impacts);
            if let Some(file) = file {
                add_fitted(&mut comparison, file)?;
            }
            comparison.add_theories(unverified);
            Ok(comparison)
        })?;
        columns(py, comparison.rows())
    }

    /// Writes the folders `impact_V*` that `impactlaw fit` and `compare` read.
    fn save(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        let provenance = format!("{PROGRAM}; case sha256 {}; Python", self.case.hash);
        short(py, || {
            self.all.iter().try_for_each(|one| {
                let place = impact_folder(&folder, one.impact.summary.velocity_m_s);
                one.impact.write(&place, &provenance)?;
                let map = |name: &str| place.join(name);
                (one.compressed).write(&map("particle_compressed.csv"), &provenance)?;
                (one.rebound).write(&map("particle_rebound.csv"), &provenance)
            })
        })
    }

    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<Py<PyAny>> {
        let show = slf.py().import("impactlaw._show")?;
        Ok(show.call_method1("impacts_html", (slf,))?.unbind())
    }

    /// Draws force against displacement of every impact, and of `law` if one is given, with matplotlib.
    #[pyo3(signature = (law = None))]
    fn plot(slf: &Bound<'_, Self>, law: Option<&Bound<'_, Law>>) -> PyResult<Py<PyAny>> {
        let show = slf.py().import("impactlaw._show")?;
        Ok(show.call_method1("plot_impacts", (slf, law))?.unbind())
    }

    fn __repr__(&self) -> String {
        format!(
            "<impactlaw.Impacts of {}: {} speeds>",
            self.case.name,
            self.all.len()
        )
    }
}

/// One impact. See the stubs.
#[pyclass(frozen, module = "impactlaw")]
pub struct Impact(Arc<Simulated>);

#[pymethods]
impl Impact {
    #[getter]
    fn velocity(&self) -> f64 {
        self.0.impact.summary.velocity_m_s
    }

    /// `ok`, `sticks`, `no_rebound`, or why it failed.
    #[getter]
    fn status(&self) -> &str {
        match &self.0.impact.summary.status {
            Status::Ok => "ok",
            Status::Sticks => "sticks",
            Status::NoRebound => "no_rebound",
            Status::Failed(reason) => reason,
        }
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.impact.summary.warnings.clone()
    }

    /// What `summary.json` holds.
    #[getter]
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        written(py, &self.0.impact.summary)
    }

    /// What `curve.csv` holds.
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        columns(py, &self.0.impact.curve.samples)
    }

    /// The particle at its largest displacement (`compressed`) or after its rebound (`rebound`), as columns.
    fn particle<'py>(
        &self,
        py: Python<'py>,
        moment: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyDict>> {
        match moment.extract::<String>().as_deref() {
            Ok("compressed") => columns(py, &self.0.compressed.points),
            Ok("rebound") => columns(py, &self.0.rebound.points),
            _ => {
                let allowed = "must be one of compressed, rebound";
                Err(raised(py, refused("moment", shown(moment), allowed)))
            }
        }
    }

    fn __repr__(&self) -> String {
        let s = &self.0.impact.summary;
        format!(
            "<impactlaw.Impact at {} m/s: e = {:.4}, {}>",
            s.velocity_m_s,
            s.restitution,
            self.status()
        )
    }
}
