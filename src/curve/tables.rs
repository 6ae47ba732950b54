//! Tables of `summary.json` that only some impacts have.

use super::files::FromFiles;
use super::number_or_null;
use crate::material::MaterialTable;
use serde::{Deserialize, Serialize};

/// Final size of a cylinder (table `cylinder` of `summary.json`), from its outline as the run leaves it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Length, m.
    #[serde(deserialize_with = "number_or_null")]
    pub final_length_m: f64,
    /// Largest diameter, that of the foot, m.
    #[serde(deserialize_with = "number_or_null")]
    pub foot_diameter_m: f64,
    /// Diameter at a fifth of the initial length above the foot, m.
    #[serde(deserialize_with = "number_or_null")]
    pub diameter_at_fifth_m: f64,
}

/// What became of the plastic work of matter that heats (table `heating` of `summary.json`). The body begins at its room
/// temperature; repeated impacts begin as warm as the one before left it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heating {
    /// Plastic work that became heat over the incident kinetic energy.
    #[serde(deserialize_with = "number_or_null")]
    pub heat_ratio: f64,
    /// Plastic work that stays stored in the material over the incident kinetic energy.
    #[serde(deserialize_with = "number_or_null")]
    pub stored_work_ratio: f64,
    /// Highest temperature of a material point, K.
    #[serde(rename = "max_temperature_K")]
    #[serde(deserialize_with = "number_or_null")]
    pub max_temperature_k: f64,
    /// Volume mean of the temperature at the end, K.
    #[serde(rename = "mean_temperature_K")]
    #[serde(deserialize_with = "number_or_null")]
    pub mean_temperature_k: f64,
}

/// What the wall's adhesion did (table `adhesion` of `summary.json`).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adhering {
    /// Work of adhesion w, J/m2.
    #[serde(rename = "work_of_adhesion_J_m2")]
    pub work_of_adhesion_j_m2: f64,
    /// Gap up to which the surfaces attract each other, m.
    pub range_m: f64,
    /// Maugis' number of the elastic sphere: JKR's limit where it is large, DMT's where it is small.
    pub maugis_number: f64,
    /// Speed below which the sphere, were it elastic, would stay on the wall in JKR's limit, m/s.
    pub sticking_velocity_m_s: f64,
    /// Largest pull of the wall after the largest displacement, averaged as the largest force is, N.
    #[serde(rename = "pull_off_force_N")]
    #[serde(deserialize_with = "number_or_null")]
    pub pull_off_force_n: f64,
    /// Largest energy that the surfaces gave as they met, over the incident kinetic energy.
    #[serde(deserialize_with = "number_or_null")]
    pub surface_energy_ratio: f64,
    /// Energy lost as surface points met the wall, over the incident kinetic energy: a part of what snapping into contact loses.
    #[serde(deserialize_with = "number_or_null")]
    pub contact_loss_ratio: f64,
}

/// The second body of an impact of two (table `target` of `summary.json`): a sphere, a plate or a half-space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// What it is.
    pub shape: String,
    /// Radius of a sphere, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Thickness of a plate, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness_m: Option<f64>,
    /// Its constants.
    pub material: MaterialTable,
    /// Largest travel of the place of first contact towards its centre of mass, of a plate or half-space towards its back, m.
    #[serde(deserialize_with = "number_or_null")]
    pub max_indentation_m: f64,
    /// The same after the rebound, mean over the residual vibration: depth of the dent, m.
    #[serde(deserialize_with = "number_or_null")]
    pub residual_indentation_m: f64,
    /// Plastic work in it over the incident kinetic energy.
    #[serde(deserialize_with = "number_or_null")]
    pub plastic_work_ratio: f64,
    /// Energy that stays in it as waves, vibration and residual stress, over the incident kinetic energy.
    #[serde(deserialize_with = "number_or_null")]
    pub retained_energy_ratio: f64,
    /// What plastic work heated in it; absent where its flow stress knows no temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heating: Option<Heating>,
}

/// Figures of an impact along the wall (table `tangential` of `summary.json`).
///
/// Positive is the direction in which the particle came; a positive spin rolls that way.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tangential {
    /// Velocity along the wall before, m/s.
    pub incident_velocity_m_s: f64,
    /// Velocity of the centre of mass along the wall after, m/s.
    pub velocity_m_s: f64,
    /// Tangential restitution $e_t = -(v_t - R\omega)/V_t$ of the velocity of the contact point (Walton's beta); absent
    /// from a normal impact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Angular velocity after: angular momentum over the moment of inertia 2/5 m R^2, rad/s.
    pub angular_velocity_rad_s: f64,
    /// Impulse along the wall over the normal impulse; the friction coefficient in full sliding.
    pub impulse_ratio: f64,
}

/// Published method that an impact was run by (table `scheme` of `summary.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SchemeFigures {
    /// Name of the preset.
    pub preset: String,
    /// All its settings in words; equal texts are equal methods.
    pub settings: String,
    /// Length of the steps, s; absent where it follows the stability limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_step_s: Option<f64>,
    /// Energy lost in transfers between points and grid over the incident energy.
    #[serde(deserialize_with = "super::number_or_null")]
    pub transfer_loss_ratio: f64,
    /// What its output files say, as the thesis reads them; absent of presets without.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub files: Option<FromFiles>,
}

impl SchemeFigures {
    /// The same impact in other units: factors of time, force and length.
    #[must_use]
    pub fn scaled(&self, time: f64, force: f64, length: f64) -> Self {
        SchemeFigures {
            time_step_s: self.time_step_s.map(|dt| dt * time),
            files: self.files.map(|files| FromFiles {
                interval_s: files.interval_s * time,
                max_force_n: files.max_force_n * force,
                max_displacement_m: files.max_displacement_m * length,
                contact_time_s: files.contact_time_s * time,
                ..files
            }),
            ..self.clone()
        }
    }
}
