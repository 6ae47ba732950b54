//! Cases: what is asked for, checked by the reader of case files.

use crate::array::floats;
use crate::border::{long, short, warn};
use crate::impacts::Impacts;
use crate::law::Law;
use crate::values::{object, written};
use crate::words::case_text;
use impactlaw::command::plan;
use impactlaw::document::Document;
use impactlaw::impact::{each_speed, simulate_kept};
use impactlaw::law::{AnyLaw, LawFile};
use impactlaw::material::MaterialTable;
use impactlaw::plan::plans;
use impactlaw::tape::Checkpoint;
use impactlaw::theory::Theory;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::path::PathBuf;
use std::sync::Arc;

/// A checked case. See the stubs.
#[pyclass(frozen, module = "impactlaw")]
pub struct Case {
    case: Arc<impactlaw::case::Case>,
    text: String,
}

impl Case {
    fn read(py: Python<'_>, document: Document) -> PyResult<Self> {
        let case = short(py, || impactlaw::case::Case::from_document(&document))?;
        Ok(Case {
            case: Arc::new(case),
            text: document.text().to_owned(),
        })
    }
}

#[pymethods]
impl Case {
    #[new]
    #[pyo3(signature = (*, name = "case", **keywords))]
    fn new(py: Python<'_>, name: &str, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let text = match keywords {
            Some(keywords) => case_text(keywords)?,
            None => String::new(),
        };
        let path = PathBuf::from(format!("{name}.toml"));
        Self::read(py, Document::new(&path, text))
    }

    /// A case file, or its text: what holds a line break is a text.
    #[staticmethod]
    #[pyo3(signature = (source, *, name = "case"))]
    fn from_toml(source: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        let py = source.py();
        if let Ok(text) = source.cast::<PyString>() {
            let text = text.to_string_lossy();
            if text.contains('\n') {
                let path = PathBuf::from(format!("{name}.toml"));
                return Self::read(py, Document::new(&path, text));
            }
        }
        let path = source.extract::<PathBuf>()?;
        Self::read(py, short(py, || Document::read(&path))?)
    }

    /// The case of a text that was, or could have been, read from `path`.
    #[staticmethod]
    fn _of(py: Python<'_>, text: &str, path: PathBuf) -> PyResult<Self> {
        Self::read(py, Document::new(&path, text))
    }

    /// For copies and other processes: a case is its text.
    #[allow(clippy::type_complexity)] // Python's protocol: what makes it, and of what
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, PathBuf))> {
        let case = slf.get();
        let from = (case.text.clone(), case.case.path.clone());
        Ok((slf.get_type().getattr("_of")?, from))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    /// Text of the case file.
    #[getter]
    fn toml(&self) -> &str {
        &self.text
    }

    #[getter]
    fn radius(&self) -> f64 {
        self.case.radius
    }

    #[getter]
    fn tolerance(&self) -> f64 {
        self.case.tolerance
    }

    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        floats(py, self.case.velocities.clone())
    }

    /// Constants by the names that law files give them.
    #[getter]
    fn material<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        written(py, &MaterialTable::from(&self.case.material))
    }

    /// What `impactlaw plan --json` prints.
    fn plan<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let plans = short(py, || plans(&self.case))?;
        object(py, &plan::json(&self.case, &plans))
    }

    /// What `impactlaw plan` prints.
    fn plan_text(&self, py: Python<'_>) -> PyResult<String> {
        short(py, || Ok(plan::text(&self.case, &plans(&self.case)?)))
    }

    /// Simulates every speed, on all cores.
    fn impact(&self, py: Python<'_>) -> PyResult<Impacts> {
        let case = &self.case;
        let all = long(py, |stop| {
            let checkpoint = Checkpoint::stopped_by(stop.clone());
            each_speed(plans(case)?, |plan| {
                let (material, radius) = (&case.material, case.radius);
                Ok(Arc::new(simulate_kept(material, radius, plan, &checkpoint)))
            })
        })?;
        for summary in all.iter().map(|one| &one.impact.summary) {
            for warning in &summary.warnings {
                warn(py, &format!("at {} m/s: {warning}", summary.velocity_m_s))?;
            }
        }
        Ok(Impacts::of(self.case.clone(), all))
    }

    /// The law that the atlas has for the material.
    fn atlas(&self, py: Python<'_>) -> PyResult<Law> {
        let case = &self.case;
        let file = short(py, || {
            LawFile::of_atlas(&case.name, &case.material, case.radius)
        })?;
        Law::of_file(py, file)
    }

    /// The law of the theory called `name`.
    fn theory(&self, py: Python<'_>, name: &str) -> PyResult<Law> {
        let case = &self.case;
        let law = short(py, || {
            case.of_a_normal_impact("a theory")?;
            let law = AnyLaw::Theory(name.parse::<Theory>()?, case.material);
            // whether it has a law of this material
            law.valid_to()?;
            Ok(law)
        })?;
        Ok(Law::of_theory(name, law, case.material, case.radius))
    }

    /// Names of the theories that have a law of the material.
    fn theories(&self) -> Vec<&'static str> {
        Theory::of(&self.case.material).map(Theory::name).collect()
    }

    fn __repr__(&self) -> String {
        let case = &self.case;
        format!(
            "<impactlaw.Case {}: R = {:?} m, {} speeds, tolerance {}>",
            case.name,
            case.radius,
            case.velocities.len(),
            case.tolerance
        )
    }
}
