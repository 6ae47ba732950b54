//! Adhesion of the wall: whether an impact feels it, the range that its attraction is given, and the cells it needs.
//!
//! Where the case says no range it is given one so short that the contact is nearly that of Johnson, Kendall and Roberts: at the Maugis
//! number [`CHOSEN`] the pull-off is 1.510 in place of 1.5 $\pi w R$. The sticking speed is lower, for the surfaces give energy on the way from
//! the range to the wall before they snap together (figures in the guide, *The solver*). A shorter range needs smaller cells, as the ring in
//! which parting surfaces attract each other shrinks with its square.
//!
//! Of a body that yields there is no such limit: a short range is a strong traction, and the surface yields before it parts. Its range is chosen so
//! that the traction is no more than its yield strength.

use super::{Effect, Estimate, Grid, LARGE_FROM, estimate, severity};
use crate::case::Case;
use crate::material::adhesion::{Adhesion, Dugdale, Jkr};
use crate::material::{Material, PLASTIC_PRESSURE_RATIO};
use crate::unit::{engineering, significant};
use std::f64::consts::PI;

/// Maugis number of the range that is chosen.
const CHOSEN: f64 = 4.0;
/// Traction over the yield strength of the range that is chosen for a body that yields, at most: stronger ones make the ring yield.
const CHOSEN_TRACTION: f64 = 1.0;
/// The same of a range that is given. A surface that yields can be pulled by no more than some 2.6 Y; with 4.2 Y points at it are turned inside out,
/// 2.1 Y was run.
const MOST_TRACTION: f64 = 2.2;
/// Cells in the width of the ring in which parting surfaces attract each other.
const ZONE_CELLS: f64 = 2.0;
/// Share of the stable time step that is used: surfaces snap together faster than bodies move, and the account of energy, which goes with
/// the square of the step, closes within 0.8 % with all of it and within 0.2 % with half (w/(ER) 1e-4, near the sticking speed).
const STEP: f64 = 0.7;
/// Share of the tolerance that the energy lost to adhesion may have of the incident one to be left out.
const FELT: f64 = 0.01;
/// Contact radius over R, at rest without load, up to which a particle is a sphere that adheres.
const WIDEST: f64 = 0.25;
/// Longest range over R.
const LONGEST: f64 = 0.1;
/// Most cells a contact radius.
const MOST_CELLS: f64 = 600.0;
/// Rows of the smallest cells where the ring asks for smaller ones than the contact; below, they grow.
const ROWS: f64 = 12.0;

/// Adhesion of a case at a speed, lengths in R, stresses in E.
pub(super) struct Felt {
    /// The law.
    pub law: Dugdale,
    /// The sphere, were it elastic.
    sphere: Jkr,
    /// Speed below which it would stick then, m/s.
    sticking: f64,
    /// Energy that adhesion takes, over the incident kinetic energy.
    loss: f64,
}

impl Felt {
    /// Of a case at a normal `velocity` (m/s), where its wall adheres.
    pub(super) fn of(case: &Case, velocity: f64) -> Option<Self> {
        let Adhesion { work, range } = case.adhesion?;
        let material = &case.material;
        let unit = material.young_modulus * case.radius;
        let (work, modulus) = (
            work / unit,
            material.contact_modulus() / material.young_modulus,
        );
        let strength = (material.flow).map(|flow| flow.yield_strength() / material.young_modulus);
        let chosen = || {
            let short = Dugdale::range_at(CHOSEN, work, 1.0, modulus);
            strength.map_or(short, |strength| {
                short.max(work / (CHOSEN_TRACTION * strength))
            })
        };
        let range = range.map_or_else(chosen, |range| range / case.radius);
        let sphere = Jkr {
            radius: 1.0,
            modulus,
            work,
        };
        let mass = 4.0 / 3.0 * PI;
        let speed = (material.young_modulus / material.density).sqrt();
        // a flattened body leaves the wall with a larger radius of curvature
        let flattened = Jkr {
            radius: curvature(material, velocity),
            ..sphere
        };
        Some(Felt {
            law: Dugdale { work, range },
            sphere,
            sticking: sphere.sticking_speed(mass) * speed,
            loss: flattened.snap_loss() / (0.5 * mass * (velocity / speed).powi(2)),
        })
    }

    /// Whether it matters.
    pub(super) fn is_on(&self, case: &Case) -> bool {
        self.loss >= FELT * case.tolerance
    }

    /// Whether it is simulated, and why.
    pub(super) fn effect(&self, case: &Case) -> Effect {
        let on = self.is_on(case);
        let lambda = self.law.maugis_number(1.0, self.sphere.modulus);
        let sticking = engineering(self.sticking, "m/s", 3);
        let strength = case.material.flow.map_or_else(String::new, |flow| {
            let over = self.law.strength() * case.material.young_modulus / flow.yield_strength();
            format!(", {} Y", significant(over, 2))
        });
        let reason = if on {
            format!(
                "{} range {}: Maugis number {}, traction {}{strength}; an elastic sphere sticks below {sticking} (JKR)",
                match case.adhesion.and_then(|adhesion| adhesion.range) {
                    Some(_) => "given",
                    None => "chosen",
                },
                engineering(self.law.range * case.radius, "m", 3),
                significant(lambda, 3),
                engineering(self.law.strength() * case.material.young_modulus, "Pa", 3),
            )
        } else {
            format!(
                "it takes {} of the energy: an elastic sphere sticks below {sticking} (JKR)",
                significant(self.loss, 2)
            )
        };
        Effect {
            name: "adhesion",
            on,
            reason,
        }
    }

    /// What is expected of an impact of `material` at `velocity` (m/s).
    pub(super) fn estimate(&self, material: &Material, velocity: f64) -> Estimate {
        let fast = velocity.max(self.sticking);
        let bare = estimate(material, fast);
        let rest = self.sphere.rest_radius();
        Estimate {
            displacement: bare.displacement + rest * rest / 3.0,
            contact_radius: (bare.contact_radius.powi(3) + rest.powi(3)).cbrt(),
            // near the sticking speed it comes away slowly
            contact_time: bare.contact_time * (1.0 + 2.0 * self.sticking / fast),
        }
    }

    /// The grid with cells small enough for the ring of attraction around the contact.
    pub(super) fn refine(&self, grid: Grid, estimate: &Estimate) -> Grid {
        let zone = self.law.zone(self.sphere.modulus);
        let fine = grid.fine.min(zone / ZONE_CELLS);
        let fine_depth = if fine < grid.fine {
            grid.fine_depth.min(ROWS * fine)
        } else {
            grid.fine_depth
        };
        let ring = zone.min((2.0 * self.law.range).sqrt());
        Grid {
            fine,
            fine_depth,
            dt_share: STEP * grid.dt_share,
            fine_width: (1.2 * estimate.contact_radius + ring).min(1.0),
            ..grid
        }
    }

    /// Key, what was found and what is allowed, where this adhesion cannot be run right.
    pub(super) fn refusal(&self, case: &Case, velocity: f64) -> Option<[String; 3]> {
        const WORK: &str = "wall.work_of_adhesion";
        let refused =
            |key: &str, found: String, allowed: String| Some([key.to_owned(), found, allowed]);
        if !self.is_on(case) {
            return None;
        }
        let material = &case.material;
        let unit = material.young_modulus * case.radius;
        let severity = severity(material, velocity);
        if severity > LARGE_FROM {
            return refused(
                WORK,
                format!("rho V^2/Y = {} at {velocity} m/s", significant(severity, 3)),
                format!(
                    "must be left out from rho V^2/Y = {LARGE_FROM} on: bodies that are flattened are run without adhesion"
                ),
            );
        }
        let rest = self.sphere.rest_radius();
        if rest > WIDEST {
            let most = self.law.work * (WIDEST / rest).powi(3) * unit;
            return refused(
                WORK,
                engineering(self.law.work * unit, "J/m2", 4),
                format!(
                    "must be at most {}: at rest, without load, a larger one gives the sphere a contact of more than {WIDEST} R",
                    engineering(most, "J/m2", 3)
                ),
            );
        }
        let found = || engineering(self.law.range * case.radius, "m", 4);
        if self.law.range > LONGEST {
            return refused(
                "wall.adhesion_range",
                found(),
                format!(
                    "must be at most {}, a tenth of the radius",
                    engineering(LONGEST * case.radius, "m", 3)
                ),
            );
        }
        let strength = material
            .flow
            .map(|flow| flow.yield_strength() / material.young_modulus);
        if let Some(strength) = strength
            && self.law.strength() > MOST_TRACTION * strength
        {
            let least = self.law.work / (MOST_TRACTION * strength) * case.radius;
            return refused(
                "wall.adhesion_range",
                found(),
                format!(
                    "must be at least {} for a body of this yield strength: a traction w/range above {MOST_TRACTION} Y tears its surface; left out, a \
                     range is chosen",
                    engineering(least, "m", 3)
                ),
            );
        }
        let widest = self.estimate(material, velocity).contact_radius;
        let cells = widest * ZONE_CELLS / self.law.zone(self.sphere.modulus);
        if cells > MOST_CELLS {
            let least = self.law.range * (cells / MOST_CELLS).sqrt() * case.radius;
            return refused(
                "wall.adhesion_range",
                found(),
                format!(
                    "must be at least {} at {velocity} m/s: the ring in which parting surfaces attract each other takes {ZONE_CELLS} cells, and \
                     {MOST_CELLS} cells a contact radius are the most that are laid; left out, a range is chosen that does not matter",
                    engineering(least, "m", 3)
                ),
            );
        }
        None
    }
}

/// Radius of curvature over R with which a sphere comes back from a rigid wall that it met at `velocity` (m/s): that of a Hertz contact
/// of its radius a and its force, $4 E^\ast a^3 / (3 F)$ with $F = 2.8\ Y \pi a^2$, where it is larger than R.
fn curvature(material: &Material, velocity: f64) -> f64 {
    material.flow.map_or(1.0, |flow| {
        let a = estimate(material, velocity).contact_radius;
        let pressure = PLASTIC_PRESSURE_RATIO * flow.yield_strength();
        (4.0 * material.contact_modulus() * a / (3.0 * PI * pressure)).max(1.0)
    })
}
