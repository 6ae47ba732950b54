//! Refusal: impacts of two bodies that are not run, by the key that asks for them.

use super::{Contact, PairPlan};
use crate::case::pair::{PairCase, TargetShape};
use crate::plan::{Estimate, FASTEST_SHOWN, LARGE_FROM, oversize, severity, too_fine};
use crate::unit::{engineering, significant};
use crate::{Error, Result};
use std::ops::RangeInclusive;

/// Radii of a second sphere over that of the particle that are run; a larger one is a half-space.
const RADII: RangeInclusive<f64> = 0.05..=20.0;
/// Largest Poisson's ratio of the second body: the way of a wave in it decides how far its grid reaches.
const LARGEST_POISSON: f64 = 0.49;
/// Expected approach over R* up to which two bodies are run: beyond, cells are squeezed as by large deformation.
pub(super) const DEEPEST: f64 = 0.15;
/// Least speed over c0: below, the energy of the impact is lost in the rounding of the strain energies.
const SLOWEST: f64 = 1e-6;

/// Refusal of what stands under `key`.
fn refused(pair: &PairCase, key: &str, found: String, allowed: String) -> Error {
    Error::Refused {
        what: format!("{}: `{key}`", pair.particle.path.display()),
        found,
        allowed,
    }
}

/// That the scheme is shown to hold for an impact.
pub(super) fn check(pair: &PairCase, velocity: f64) -> Result<()> {
    let case = &pair.particle;
    let poisson_ratio = pair.target.material.poisson_ratio;
    if poisson_ratio > LARGEST_POISSON {
        let allowed = format!(
            "must be at most {LARGEST_POISSON}: waves in a wall that is all but incompressible go too far while it is in contact"
        );
        let found = poisson_ratio.to_string();
        return Err(refused(pair, "wall.material.poisson_ratio", found, allowed));
    }
    if let TargetShape::Sphere { radius } = pair.target.shape
        && !RADII.contains(&(radius / case.radius))
    {
        let found = engineering(radius, "m", 4);
        let allowed = format!(
            "must be {} to {} times `particle.radius`; a wall without `radius` is a half-space",
            RADII.start(),
            RADII.end()
        );
        return Err(refused(pair, "wall.radius", found, allowed));
    }
    if let Some(allowed) = too_fine(case, velocity) {
        let found = case.tolerance.to_string();
        return Err(refused(pair, "accuracy.tolerance", found, allowed));
    }
    let unit = (case.material.young_modulus / case.material.density).sqrt();
    let speed = velocity / unit;
    let contact = Contact::of(pair);
    let estimate = contact.estimate(pair, speed);
    let found = engineering(velocity, "m/s", 4);
    let severity =
        severity(&case.material, velocity).max(severity(&pair.target.material, velocity));
    let depth = estimate.displacement / contact.radius;
    let allowed = if speed < SLOWEST {
        format!(
            "two bodies are run from {} on, a millionth of sqrt(E/rho): below, the energy is lost in rounding",
            engineering(SLOWEST * unit, "m/s", 3)
        )
    } else if severity > LARGE_FROM {
        format!(
            "rho V^2/Y is {}: two bodies are run up to {LARGE_FROM}; faster impacts flatten them",
            significant(severity, 3)
        )
    } else if !(depth <= DEEPEST) {
        format!(
            "the expected delta* is {} times 1/(1/R1 + 1/R2): two bodies are run up to {DEEPEST}",
            significant(depth, 3)
        )
    } else if speed > FASTEST_SHOWN {
        format!("two bodies are run up to {FASTEST_SHOWN} sqrt(E/rho)")
    } else {
        return check_thickness(pair, velocity, &estimate);
    };
    Err(refused(pair, "impact.velocities", found, allowed))
}

/// That a plate is as thick as the contact is wide.
fn check_thickness(pair: &PairCase, velocity: f64, estimate: &Estimate) -> Result<()> {
    let TargetShape::Plate { thickness } = pair.target.shape else {
        return Ok(());
    };
    let least = estimate.contact_radius * pair.particle.radius;
    if thickness >= least {
        return Ok(());
    }
    let allowed = format!(
        "must be at least {}, the contact radius expected at {velocity} m/s; nothing thinner was compared",
        engineering(least, "m", 3)
    );
    let found = engineering(thickness, "m", 4);
    Err(refused(pair, "wall.thickness", found, allowed))
}

/// That a run is not larger than there is sense in.
pub(super) fn check_size(pair: &PairCase, plan: &PairPlan) -> Result<()> {
    match oversize(&plan.impact) {
        None => Ok(()),
        Some([found, allowed]) => Err(refused(pair, "impact.velocities", found, allowed)),
    }
}
