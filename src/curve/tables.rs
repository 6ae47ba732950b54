//! Tables of `summary.json` that only some impacts have.

use super::number_or_null;
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
