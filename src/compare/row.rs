//! Row: one law at one speed, its figures and their errors; a line of `compare.csv`.

use super::{Misfit, SIMULATION};
use crate::contact::rebound::Rebound;
use crate::curve::{Summary, restitution_error};
use serde::{Deserialize, Serialize};

/// One law at one speed. Field names are the CSV header (file contract); errors and misfits are empty in the rows
/// of the simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the law; `mpm` for the simulated impact.
    pub law: String,
    /// Impact speed V, m/s.
    pub velocity_m_s: f64,
    /// F*, N.
    #[serde(rename = "max_force_N")]
    pub max_force_n: f64,
    /// delta*, m.
    pub max_displacement_m: f64,
    /// e.
    pub restitution: f64,
    /// Contact time, s.
    pub contact_time_s: f64,
    /// [`Misfit::all`].
    pub force_rmse_rel: Option<f64>,
    /// [`Misfit::loading`].
    pub force_rmse_loading_rel: Option<f64>,
    /// [`Misfit::unloading`].
    pub force_rmse_unloading_rel: Option<f64>,
    /// delta_res, m.
    pub residual_displacement_m: f64,
    /// Relative error of F*.
    pub max_force_error_rel: Option<f64>,
    /// Relative error of delta*.
    pub max_displacement_error_rel: Option<f64>,
    /// Error of delta_res over delta* of the simulation.
    pub residual_displacement_error_rel: Option<f64>,
    /// Relative error of e.
    pub restitution_error_rel: Option<f64>,
    /// Relative error of the contact time.
    pub contact_time_error_rel: Option<f64>,
    /// Whether the simulated displacement lies beyond what the law's source supports.
    pub extrapolated: Option<bool>,
}

/// Errors of a law's impact against the simulated one, relative; delta_res over delta*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Of F*.
    pub force: f64,
    /// Of delta*.
    pub displacement: f64,
    /// Of delta_res.
    pub residual: f64,
    /// Of e.
    pub restitution: f64,
    /// Of the contact time.
    pub contact_time: f64,
}

impl Row {
    /// Row of a simulated impact.
    #[must_use]
    pub fn simulated(impact: &Summary) -> Self {
        Self {
            law: SIMULATION.to_owned(),
            velocity_m_s: impact.velocity_m_s,
            max_force_n: impact.max_force_n,
            max_displacement_m: impact.max_displacement_m,
            restitution: impact.restitution,
            contact_time_s: impact.contact_time_s,
            force_rmse_rel: None,
            force_rmse_loading_rel: None,
            force_rmse_unloading_rel: None,
            residual_displacement_m: impact.residual_displacement_m,
            max_force_error_rel: None,
            max_displacement_error_rel: None,
            residual_displacement_error_rel: None,
            restitution_error_rel: None,
            contact_time_error_rel: None,
            extrapolated: None,
        }
    }

    /// Row of a law whose 1-D impact gave `hit`.
    #[must_use]
    pub fn law(
        name: &str,
        impact: &Summary,
        hit: &Rebound,
        misfit: Option<Misfit>,
        extrapolated: bool,
    ) -> Self {
        let relative = |value: f64, reference: f64| Some((value - reference) / reference);
        let residual = hit.residual_displacement - impact.residual_displacement_m;
        Self {
            law: name.to_owned(),
            velocity_m_s: impact.velocity_m_s,
            max_force_n: hit.max_force,
            max_displacement_m: hit.max_displacement,
            restitution: hit.restitution,
            contact_time_s: hit.contact_time,
            force_rmse_rel: misfit.map(|m| m.all),
            force_rmse_loading_rel: misfit.map(|m| m.loading),
            force_rmse_unloading_rel: misfit.map(|m| m.unloading),
            residual_displacement_m: hit.residual_displacement,
            max_force_error_rel: relative(hit.max_force, impact.max_force_n),
            max_displacement_error_rel: relative(hit.max_displacement, impact.max_displacement_m),
            residual_displacement_error_rel: Some(residual / impact.max_displacement_m),
            restitution_error_rel: Some(restitution_error(hit.restitution, impact.restitution)),
            contact_time_error_rel: relative(hit.contact_time, impact.contact_time_s),
            extrapolated: Some(extrapolated),
        }
    }

    /// Errors of a law's row; `None` in a row of the simulation.
    #[must_use]
    pub fn errors(&self) -> Option<Errors> {
        Some(Errors {
            force: self.max_force_error_rel?,
            displacement: self.max_displacement_error_rel?,
            residual: self.residual_displacement_error_rel?,
            restitution: self.restitution_error_rel?,
            contact_time: self.contact_time_error_rel?,
        })
    }
}

impl Errors {
    /// Root mean square of the five errors.
    #[must_use]
    pub fn rms(&self) -> f64 {
        let Errors {
            force,
            displacement,
            residual,
            restitution,
            contact_time,
        } = *self;
        let errors = [force, displacement, residual, restitution, contact_time];
        (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
    }
}
