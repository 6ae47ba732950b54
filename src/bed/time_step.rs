//! Time step: the largest that follows the stiffest contact and the waves through a grain.

use super::scene::TimeTable;
use crate::material::Material;
use std::f64::consts::PI;

/// Time a Rayleigh wave takes over half a grain, s.
///
/// $$ T_R = \frac{\pi R \sqrt{\rho / G}}{0.1631 \nu + 0.8766} $$
///
/// Source: Thornton and Randall 1988; the denominator is the usual fit of the Rayleigh speed over the shear speed.
///
/// ```
/// use impactlaw::{bed::time_step::rayleigh_time, material::Material};
/// let glass = Material { density: 2500.0, young_modulus: 5e7, poisson_ratio: 0.3, flow: None };
/// // pi * 1e-3 * sqrt(2500 / 1.923e7) / 0.92553 = 3.87e-5 s
/// assert!((rayleigh_time(&glass, 1e-3) - 3.87e-5).abs() < 1e-7);
/// ```
#[must_use]
pub fn rayleigh_time(material: &Material, radius: f64) -> f64 {
    let nu = material.poisson_ratio;
    let shear = material.young_modulus / (2.0 * (1.0 + nu));
    PI * radius * (material.density / shear).sqrt() / (0.1631 * nu + 0.8766)
}

/// Largest time step (s) for grains from `radius` (m) up, contacts `softening` times as stiff as the material's, and
/// the present shortest half oscillation `contact_time` (s).
#[must_use]
pub fn largest(
    settings: &TimeTable,
    material: &Material,
    radius: f64,
    softening: f64,
    contact_time: f64,
) -> f64 {
    let rayleigh = settings.rayleigh_fraction * rayleigh_time(material, radius) / softening.sqrt();
    rayleigh.min(contact_time / settings.steps_per_contact)
}
