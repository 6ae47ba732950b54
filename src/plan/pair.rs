//! Plan of an impact of two deformable bodies: grids of both, how far the second one reaches, and what is refused.
//!
//! Units are those of a plan of one body: lengths in R of the particle, times in R/c0 of its material.

use super::{Effect, Estimate, Grid, Plan, effects, graded, grid};
use crate::Result;
use crate::case::pair::{PairCase, TargetShape};
use crate::material::stress::Moduli;
use crate::material::{Material, PLASTIC_PRESSURE_RATIO, YIELD_PRESSURE_RATIO};
use crate::unit::{engineering, significant};
use refusal::{DEEPEST, check, check_size};
use std::f64::consts::PI;

mod refusal;

/// Extent of a body on its grid, in R of the particle; r from the axis, z from the place of first contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// A sphere, free to move.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A round layer whose back is held.
    Layer {
        /// Its thickness.
        thickness: f64,
        /// Its radius.
        width: f64,
    },
}

impl Extent {
    /// Width and height of the grid.
    #[must_use]
    pub fn size(self) -> (f64, f64) {
        match self {
            Extent::Sphere { radius } => (radius, 2.0 * radius),
            Extent::Layer { thickness, width } => (width, thickness),
        }
    }
}

/// Grid of quadratic splines over one body, lengths in R of the particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyGrid {
    /// The body.
    pub extent: Extent,
    /// Gauss points a direction in every smooth piece of a cell.
    pub points_per_direction: usize,
    /// Cell size at first contact.
    pub fine: f64,
    /// Distance from the axis up to which cells stay fine.
    pub fine_width: f64,
    /// Depth up to which cells stay fine.
    pub fine_depth: f64,
    /// Growth from cell to cell beyond.
    pub growth: f64,
    /// Largest cell.
    pub coarse: f64,
}

impl BodyGrid {
    /// A body with the cells that a particle has at the contact.
    fn of(extent: Extent, grid: &Grid) -> Self {
        BodyGrid {
            extent,
            points_per_direction: grid.points_per_direction,
            fine: grid.fine,
            fine_width: grid.fine_width,
            fine_depth: grid.fine_depth,
            growth: grid.growth,
            coarse: grid.coarse,
        }
    }
}

/// Plan of one impact of two bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct PairPlan {
    /// The impact as that of the particle; points, steps and seconds are those of both bodies.
    pub impact: Plan,
    /// Grid of the second body.
    pub target: BodyGrid,
    /// Dilatational wave speed of the second body over c0 of the particle.
    pub wave_speed: f64,
    /// Thickness asked for of a plate; infinite of a half-space, none of a sphere.
    pub thickness: Option<f64>,
}

impl PairPlan {
    /// Grid of the particle.
    #[must_use]
    pub fn particle_grid(&self) -> BodyGrid {
        BodyGrid::of(Extent::Sphere { radius: 1.0 }, &self.impact.grid)
    }

    /// Time in which a wave comes back from where the second body is cut off: the rim of a plate, the end of a half-space.
    /// Infinite for a sphere, which is whole.
    #[must_use]
    pub fn undisturbed(&self) -> f64 {
        match (self.target.extent, self.thickness) {
            (Extent::Layer { thickness, width }, Some(asked)) => {
                let end = if thickness < asked {
                    thickness
                } else {
                    f64::INFINITY
                };
                2.0 * width.min(end) / self.wave_speed
            }
            _ => f64::INFINITY,
        }
    }

    /// The plan with a layer that is not disturbed before `time`.
    #[must_use]
    pub fn reaching(&self, time: f64) -> PairPlan {
        let reach = 0.5 * time * self.wave_speed;
        let extent = match (self.target.extent, self.thickness) {
            (Extent::Layer { .. }, Some(asked)) => Extent::Layer {
                thickness: reach.min(asked),
                width: reach,
            },
            (whole, _) => whole,
        };
        PairPlan {
            target: BodyGrid {
                extent,
                ..self.target
            },
            ..self.clone()
        }
    }
}

/// Contact of two bodies, in units of the particle.
#[derive(Debug, Clone, Copy)]
struct Contact {
    /// 1/R* = 1/R1 + 1/R2.
    radius: f64,
    /// 1/m* = 1/m1 + 1/m2.
    mass: f64,
    /// 1/E* = 1/E1* + 1/E2*.
    modulus: f64,
}

impl Contact {
    fn of(pair: &PairCase) -> Self {
        let (own, other) = (&pair.particle.material, &pair.target.material);
        let mass = 4.0 / 3.0 * PI;
        let unit = own.young_modulus;
        let (radius, reduced) = match pair.target.shape {
            TargetShape::Sphere { radius } => {
                let radius = radius / pair.particle.radius;
                let second = mass * radius.powi(3) * other.density / own.density;
                (radius / (1.0 + radius), mass * second / (mass + second))
            }
            TargetShape::Plate { .. } | TargetShape::HalfSpace => (1.0, mass),
        };
        let [first, second] = [own, other].map(|m| m.contact_modulus() / unit);
        Contact {
            radius,
            mass: reduced,
            modulus: first * second / (first + second),
        }
    }

    /// Size of an impact at `speed` on flow stresses of the two, as [`super::estimate`].
    fn estimate(&self, pair: &PairCase, speed: f64) -> Estimate {
        let materials = [&pair.particle.material, &pair.target.material];
        let energy = self.mass * speed * speed;
        let elastic = (15.0 * energy / (16.0 * self.modulus * self.radius.sqrt())).powf(0.4);
        let unit = pair.particle.material.young_modulus;
        let mut plastic = 0.0f64;
        for _ in 0..25 {
            let strain = 0.16 * (2.0 * plastic / self.radius).sqrt().min(1.0);
            let stresses = materials.map(|m| m.flow.map_or(f64::INFINITY, |f| f.at_rest(strain)));
            let pressure = PLASTIC_PRESSURE_RATIO * stresses[0].min(stresses[1]) / unit;
            plastic = (energy / (2.0 * PI * self.radius * pressure)).sqrt();
        }
        let sum = elastic.powi(3) + plastic.powi(3);
        let share = plastic.powi(3) / sum;
        let displacement = sum.cbrt();
        Estimate {
            displacement,
            contact_radius: (self.radius * displacement * (1.0 + share)).sqrt(),
            contact_time: (2.94 - 0.64 * share) * displacement / speed,
        }
    }

    /// Speed of first yield under the peak pressure `1.6 Y` of a material, over c0; infinite for an elastic one.
    fn yield_speed(&self, material: &Material, unit: f64) -> f64 {
        material.flow.map_or(f64::INFINITY, |flow| {
            let pressure = YIELD_PRESSURE_RATIO * flow.yield_strength() / unit;
            let displacement = (PI * pressure / (2.0 * self.modulus)).powi(2) * self.radius;
            let force = 4.0 / 3.0 * self.modulus * (self.radius * displacement.powi(3)).sqrt();
            (0.8 * force * displacement / self.mass).sqrt()
        })
    }
}

/// Way of a wave to where a layer is cut off and back, over the way in the expected contact time.
pub const MARGIN: f64 = 1.4;
/// Cells of a layer over the way of a shear wave in the contact time, at most.
const WAVE_CELLS: f64 = 20.0;

/// Plans of all speeds of a case of two bodies, slowest first.
///
/// # Errors
/// [`crate::Error::Refused`] for speeds, sizes and tolerances that two bodies are not run with, and for a run that needs more memory or time
/// than there is sense in.
pub fn pair_plans(pair: &PairCase) -> Result<Vec<PairPlan>> {
    let case = &pair.particle;
    (case.velocities.iter())
        .map(|velocity| {
            check(pair, *velocity)?;
            let plan = pair_plan(pair, *velocity);
            check_size(pair, &plan)?;
            Ok(plan)
        })
        .collect()
}

/// Plan one impact of a case of two bodies.
#[must_use]
pub fn pair_plan(pair: &PairCase, velocity: f64) -> PairPlan {
    let case = &pair.particle;
    let material = &case.material;
    let speed = velocity / (material.young_modulus / material.density).sqrt();
    let contact = Contact::of(pair);
    let estimate = contact.estimate(pair, speed);
    let grid = grid(&estimate, case, velocity);
    let other = &pair.target.material;
    let waves = Moduli::new(
        other.young_modulus / material.young_modulus,
        other.poisson_ratio,
    );
    let density = other.density / material.density;
    let shear_speed = (waves.shear / density).sqrt();
    let wave_cells = (shear_speed * estimate.contact_time / WAVE_CELLS).max(grid.coarse);
    let (extent, thickness) = match pair.target.shape {
        TargetShape::Sphere { radius } => {
            let radius = radius / case.radius;
            (Extent::Sphere { radius }, None)
        }
        TargetShape::Plate { thickness } => (UNKNOWN, Some(thickness / case.radius)),
        TargetShape::HalfSpace => (UNKNOWN, Some(f64::INFINITY)),
    };
    let plan = PairPlan {
        impact: Plan {
            effects: effects_of(pair, velocity, &contact, &estimate),
            ..Plan::of(case, velocity, estimate, grid)
        },
        target: BodyGrid {
            coarse: match extent {
                Extent::Sphere { radius } => wave_cells.min(0.1 * radius),
                Extent::Layer { .. } => wave_cells,
            },
            ..BodyGrid::of(extent, &grid)
        },
        wave_speed: waves.dilatational_speed(density),
        thickness,
    };
    predicted(plan.reaching(MARGIN * estimate.contact_time), pair)
}

/// A layer that [`PairPlan::reaching`] gives its size.
const UNKNOWN: Extent = Extent::Layer {
    thickness: 0.0,
    width: 0.0,
};

/// What the second body is.
fn second_body(shape: TargetShape) -> String {
    match shape {
        TargetShape::Sphere { radius } => {
            format!("a sphere of {}, free to move", engineering(radius, "m", 4))
        }
        TargetShape::Plate { thickness } => format!(
            "a plate of {}, held at its back; its rim is too far away to be felt",
            engineering(thickness, "m", 4)
        ),
        TargetShape::HalfSpace => {
            "a half-space, cut off where no wave comes back in time".to_owned()
        }
    }
}

/// How fast a body is hit whose first yield takes the speed `least`, m/s; infinite for one that never yields.
fn over_yield(velocity: f64, least: f64, second: TargetShape) -> String {
    if least.is_infinite() {
        return "the material has no yield strength".to_owned();
    }
    let at = engineering(least, "m/s", 3);
    if velocity < least {
        let why = match second {
            TargetShape::Plate { .. } => ", for a thin plate yields sooner",
            TargetShape::Sphere { .. } | TargetShape::HalfSpace => "",
        };
        return format!("V is below the speed of first yield, {at}: followed all the same{why}");
    }
    let times = significant(velocity / least, 3);
    format!("V is {times} times the speed of first yield, {at}")
}

/// Effects of an impact of two bodies, on or off, with reasons.
fn effects_of(
    pair: &PairCase,
    velocity: f64,
    contact: &Contact,
    estimate: &Estimate,
) -> Vec<Effect> {
    let case = &pair.particle;
    let unit = case.material.young_modulus;
    let speed = (unit / case.material.density).sqrt();
    let yielding = |name, material: &Material| Effect {
        name,
        on: material.flow.is_some(),
        reason: over_yield(
            velocity,
            contact.yield_speed(material, unit) * speed,
            pair.target.shape,
        ),
    };
    let off = |name, reason: &str| Effect {
        name,
        on: false,
        reason: reason.to_owned(),
    };
    let mut list = vec![
        Effect {
            name: "second body",
            on: true,
            reason: second_body(pair.target.shape),
        },
        yielding("plasticity", &case.material),
        yielding("wall plasticity", &pair.target.material),
    ];
    list.extend(effects::flow_effects(
        case,
        velocity,
        case.material.flow.is_some(),
    ));
    list.extend([
        off("three dimensions", "a normal impact is axisymmetric"),
        off("friction", "two deformable bodies meet without friction"),
        off(
            "large deformation",
            &format!(
                "delta* is expected to be {} times 1/(1/R1 + 1/R2), two bodies are run up to {DEEPEST}",
                significant(estimate.displacement / contact.radius, 3)
            ),
        ),
        off("mass scaling", "it is measured on rigid walls alone"),
        off("similar impact", "two bodies are run at their own speed: waves take energy away"),
        off("gravity", "the impact is over long before gravity moves the particle"),
    ]);
    list
}

/// Point-steps a second and core, contact and outputs included.
const THROUGHPUT: f64 = 5.5e7;
/// Sweeps over the points that a refresh of the stable step and the pairs costs.
const REFRESH_SWEEPS: f64 = 8.0;

/// The plan with points, steps and seconds predicted from its grids.
fn predicted(mut plan: PairPlan, pair: &PairCase) -> PairPlan {
    let count = |grid: &BodyGrid| {
        let lines = |length, to| graded(length, grid.fine, to, grid.growth, grid.coarse).len() - 1;
        let (across, up) = grid.extent.size();
        let cells = lines(across, grid.fine_width) * lines(up, grid.fine_depth);
        let filled = match grid.extent {
            Extent::Sphere { .. } => 0.8,
            Extent::Layer { .. } => 1.0,
        };
        filled * cells as f64 * (grid.points_per_direction as f64).powi(2)
    };
    let own = Moduli::new(1.0, pair.particle.material.poisson_ratio).dilatational_speed(1.0);
    let points = count(&plan.particle_grid()) + count(&plan.target);
    let impact = &mut plan.impact;
    let fine = impact.grid.fine;
    let dt = 0.87 * (fine / own).min(plan.target.fine / plan.wave_speed);
    let steps = (impact.estimate.contact_time + impact.ring_time) / dt;
    let materials = [&pair.particle.material, &pair.target.material];
    let speed = impact.velocity / (materials[0].young_modulus / materials[0].density).sqrt();
    let interval = (0.5 * fine / (speed * dt)).clamp(1.0, 50.0);
    let cost = materials.map(|m| m.flow.map_or(1.0, crate::material::Flow::cost));
    let sweeps = steps * (1.0 + REFRESH_SWEEPS / interval);
    impact.points = points as usize;
    impact.steps = steps as u64;
    impact.seconds = cost[0].max(cost[1]) * points * sweeps / THROUGHPUT;
    plan
}
