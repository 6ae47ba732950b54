//! Output: the figures of one bed run, `summary.json`.

use crate::bed::measures::gauge::Finding;
use crate::bed::measures::series::{CLOSURE, Row, closure};
use crate::files::write_atomic;
use crate::{Error, Result};
use serde::Serialize;
use std::path::Path;

/// Figures of one run (keys of `summary.json`).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Law between the grains.
    pub law: String,
    /// Grains.
    pub grains: usize,
    /// Time steps.
    pub steps: u64,
    /// Time simulated, s.
    pub time_s: f64,
    /// Smallest time step used, s.
    pub time_step_s: f64,
    /// Wall time, s.
    pub wall_s: f64,
    /// Grains times steps over wall time.
    pub particle_steps_per_s: f64,
    /// Largest imbalance of energy over the largest turnover.
    pub energy_closure: f64,
    /// Largest number of grains seen outside the box.
    pub lost_grains: usize,
    /// Largest number of free bodies seen outside it.
    pub lost_bodies: usize,
    /// Grains that have left through outlets.
    pub outlet_grains: usize,
    /// Largest overlap over diameter.
    pub max_overlap_ratio: f64,
    /// Largest number of contacts flattened beyond what the law's source supports.
    pub beyond_validity: usize,
    /// Largest number of contacts that had yielded and let go short of the slowest impact of the law.
    pub below_validity: usize,
    /// Share of the work of all yielded contacts that let go which is in those.
    pub below_validity_share: f64,
    /// Largest stress on the piston.
    #[serde(rename = "max_stress_Pa")]
    pub max_stress_pa: f64,
    /// Strain left when the piston has come off.
    pub residual_strain: f64,
    /// Coordination number at the largest strain.
    pub coordination: f64,
    /// Inertial number at the largest stress.
    pub inertial_number: f64,
    /// Energy dissipated by plastic flow over all energy dissipated.
    pub plastic_share: f64,
    /// Contact stiffness over that of the material, as the scene asks for.
    pub contact_stiffness: f64,
    /// The same while the packing was made.
    pub settling_stiffness: f64,
    /// Materials, in the order of their numbers in files.
    pub materials: Vec<String>,
    /// Groups of grains, in the order of their numbers in files.
    pub groups: Vec<String>,
    /// What the measures of the scene have found.
    pub findings: Vec<Finding>,
    /// What must be known before the figures are used.
    pub warnings: Vec<String>,
    /// How the run ended.
    pub status: &'static str,
}

/// What a run counted as it went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counts {
    /// Grains.
    pub grains: usize,
    /// Steps done.
    pub steps: u64,
    /// Steps of single grains.
    pub particle_steps: u64,
    /// Wall time, s.
    pub wall_s: f64,
    /// Grains outside.
    pub lost: usize,
    /// Free bodies outside.
    pub lost_bodies: usize,
    /// Grains that have left through outlets.
    pub outlet_grains: usize,
    /// Contacts beyond the law's validity.
    pub beyond_validity: usize,
    /// Contacts that let go below it.
    pub below_validity: usize,
    /// Their share of the work.
    pub below_validity_share: f64,
    /// Largest overlap over diameter.
    pub max_overlap_ratio: f64,
    /// Contact stiffness over that of the material, as the scene asks for.
    pub contact_stiffness: f64,
    /// The same while the packing was made.
    pub settling_stiffness: f64,
}

impl Summary {
    /// Figures of a run of `law` from its rows and counts.
    #[must_use]
    pub fn new(law: &str, rows: &[Row], counts: Counts) -> Self {
        let most =
            |value: fn(&Row) -> f64| rows.iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        let energy_closure = closure(rows);
        let (peak, deepest, last) = (most(|r| r.stress_pa), most(|r| r.strain), rows.last());
        Self {
            law: law.to_owned(),
            grains: counts.grains,
            steps: counts.steps,
            time_s: last.map_or(0.0, |r| r.time_s),
            time_step_s: rows
                .iter()
                .fold(f64::INFINITY, |dt, r| dt.min(r.time_step_s)),
            wall_s: counts.wall_s,
            particle_steps_per_s: counts.particle_steps as f64 / counts.wall_s,
            energy_closure,
            lost_grains: counts.lost,
            lost_bodies: counts.lost_bodies,
            outlet_grains: counts.outlet_grains,
            max_overlap_ratio: counts.max_overlap_ratio,
            beyond_validity: counts.beyond_validity,
            below_validity: counts.below_validity,
            below_validity_share: counts.below_validity_share,
            max_stress_pa: peak.map_or(0.0, |r| r.stress_pa),
            residual_strain: last.map_or(0.0, |r| r.strain),
            coordination: deepest.map_or(0.0, |r| r.coordination),
            inertial_number: peak.map_or(0.0, |r| r.inertial_number),
            plastic_share: last.map_or(0.0, Row::plastic_share),
            contact_stiffness: counts.contact_stiffness,
            settling_stiffness: counts.settling_stiffness,
            materials: Vec::new(),
            groups: Vec::new(),
            findings: Vec::new(),
            warnings: Vec::new(),
            status: if energy_closure < CLOSURE {
                "ok"
            } else {
                "energy imbalance"
            },
        }
    }

    /// Writes `summary.json` into `folder`.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let path = folder.join("summary.json");
        let text = serde_json::to_string_pretty(self)
            .map_err(|e| Error::file("write", &path)(e.into()))?;
        write_atomic(&path, text.as_bytes())
    }
}
