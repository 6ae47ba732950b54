//! Time step: the largest that follows the stiffest contact, the waves through a grain and the fastest grain.

use crate::Result;
use crate::bed::scene::{GrainMaterial, Group, Scene, TimeStep};
use crate::dem::dynamics::state::Packing;
use crate::material::Material;
use crate::unit::engineering;
use std::f64::consts::PI;

/// Largest way of a grain in one step, over its radius.
const LONGEST_WAY: f64 = 0.1;

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
    let shear = material.shear_modulus();
    PI * radius * (material.density / shear).sqrt() / (0.1631 * nu + 0.8766)
}

/// Duration (s) of the elastic impact of two equal grains of `radius` (m) at the relative `speed` (m/s).
///
/// $$ t_c = 2.868 \left( \frac{m^{\ast 2}}{R^\ast E^{\ast 2} v} \right)^{1/5}, \quad m^\ast = \tfrac{m}{2},\quad R^\ast = \tfrac{R}{2},\quad
/// E^\ast = \frac{E}{2 (1 - \nu^2)} $$
///
/// Source: Johnson 1985, section 11.4. A contact that yields is softer while it loads, and lasts longer.
///
/// ```
/// use impactlaw::{bed::time_step::impact_time, material::Material};
/// let glass = Material { density: 2500.0, young_modulus: 5e7, poisson_ratio: 0.3, flow: None };
/// // 2.868 * ((5.236e-6)^2 / (5e-4 * (2.747e7)^2 * 1))^0.2 = 1.071e-4 s
/// assert!((impact_time(&glass, 1e-3, 1.0) - 1.071e-4).abs() < 1e-7);
/// ```
#[must_use]
pub fn impact_time(material: &Material, radius: f64, speed: f64) -> f64 {
    let (mass, modulus) = (
        0.5 * material.sphere_mass(radius),
        0.5 * material.contact_modulus(),
    );
    2.868 * (mass * mass / (0.5 * radius * modulus * modulus * speed)).powf(0.2)
}

/// What bounds the time step of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    settings: TimeStep,
    /// Shortest impact of two grains at 1 m/s and full stiffness, s.
    impact: f64,
    /// Shortest Rayleigh time of a grain at full stiffness, s.
    rayleigh: f64,
    /// Smallest radius, m.
    smallest: f64,
}

impl Limits {
    /// Limits for groups of grains, their materials among `materials`.
    #[must_use]
    pub fn of(settings: TimeStep, groups: &[Group], materials: &[GrainMaterial]) -> Self {
        let smallest = |group: &Group| group.sizes.limits()[0];
        let least = |value: &dyn Fn(&Group) -> f64| {
            let values = groups.iter().map(value);
            values.fold(f64::INFINITY, f64::min)
        };
        let material = |group: &Group| &materials[group.material].material;
        Self {
            settings,
            impact: least(&|group| impact_time(material(group), smallest(group), 1.0)),
            rayleigh: least(&|group| rayleigh_time(material(group), smallest(group))),
            smallest: least(&smallest),
        }
    }

    /// Largest time step (s) by the Rayleigh time, for contacts `softening` times as stiff as the material's; the
    /// scene's own step where it is smaller.
    #[must_use]
    pub fn rayleigh(&self, softening: f64) -> f64 {
        let limit = self.settings.rayleigh_fraction * self.rayleigh / softening.sqrt();
        self.settings.step.map_or(limit, |step| limit.min(step))
    }

    /// Time step (s) for the present state.
    ///
    /// # Errors
    /// The reason why the scene's own step is too large for it, with the largest that would do.
    pub fn step(&self, softening: f64, packing: &Packing) -> std::result::Result<f64, String> {
        // contacts that are there, and those the fastest grains may begin before the next look
        let (speed, least) = (2.0 * packing.max_speed, self.settings.steps_per_contact);
        let coming = self.impact / (softening * softening * speed).powf(0.2);
        let contact = packing.contact_time.min(coming) / least;
        let way = LONGEST_WAY * self.smallest / packing.max_speed;
        let rayleigh = self.settings.rayleigh_fraction * self.rayleigh / softening.sqrt();
        let limit = rayleigh.min(contact).min(way);
        let Some(step) = self.settings.step else {
            return Ok(limit);
        };
        if step <= limit {
            return Ok(step);
        }
        let why = if limit == contact {
            "the stiffest contact"
        } else if limit == way {
            "the fastest grain"
        } else {
            "the Rayleigh time"
        };
        Err(format!(
            "`time.step` is too large: {why} allows at most {}; reduce it, or leave it out to have it follow the bed",
            engineering(limit, "s", 3)
        ))
    }
}

/// That a scene's own time step is within the Rayleigh limit, before anything is run.
///
/// # Errors
/// [`crate::Error::Value`] with the largest step allowed.
pub fn check(scene: &Scene) -> Result<()> {
    let Some(step) = scene.time.step else {
        return Ok(());
    };
    let following = TimeStep {
        step: None,
        ..scene.time
    };
    let limit =
        Limits::of(following, &scene.groups, &scene.materials).rayleigh(scene.contact.softening());
    if step <= limit {
        return Ok(());
    }
    let allowed = format!(
        "must be at most {} ({} of the Rayleigh time of the smallest grain); reduce it, or leave it out to have it follow the bed",
        engineering(limit, "s", 3),
        scene.time.rayleigh_fraction
    );
    Err(scene.document.reject("time.step", allowed))
}
