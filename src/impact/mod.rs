//! Impact: one sphere thrown at a rigid wall, from set-up to curve, by the total Lagrangian material point method.
//!
//! Runs in units R = 1, rho = 1, E = 1. Displacements and velocities live on the nodes of a grid that never moves, so
//! there is no velocity transfer and no transfer loss; points carry only their plastic state.

pub mod ball;
pub mod banded;
pub mod basis;
pub mod body;
pub mod contact;
pub mod homes;
pub mod kernel;
pub mod patch;
pub mod record;
mod run;
pub mod section;
pub mod setup;
pub mod solid;
pub mod timestep;

use crate::curve::{Impact, ParticleMap};
use crate::material::flow::{FlowStress, LinearHardening, PerfectlyPlastic};
use crate::material::stress::{Constitutive, Elastic, J2, Moduli};
use crate::material::{Flow, Material};
use crate::plan::{Geometry, Plan};
use crate::space::{Axisymmetric, Solid};
use patch::{Coulomb, Frictionless};
use record::Record;
use run::Run;

/// Contact violation that counts as solved, in impact speeds.
const CONTACT_TOLERANCE: f64 = 1e-7;

/// What a simulated impact leaves: curve, figures and the particle at two moments.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulated {
    /// Curve and figures.
    pub impact: Impact,
    /// The particle at its largest displacement.
    pub compressed: ParticleMap,
    /// The particle after its rebound.
    pub rebound: ParticleMap,
}

/// Simulate one impact as planned.
///
/// Always returns what the run has; [`crate::curve::Status`] says whether it finished.
#[must_use]
pub fn simulate(material: &Material, radius: f64, plan: &Plan) -> Simulated {
    let moduli = Moduli::new(1.0, material.poisson_ratio);
    let started = std::time::Instant::now();
    let speed = plan.velocity / (material.young_modulus / material.density).sqrt();
    let record = match material.flow.filter(|_| plan.plastic) {
        None => run_geometry(Elastic { moduli }, plan, speed),
        Some(flow) => run_plastic(moduli, &flow, material.young_modulus, plan, speed),
    };
    let seconds = started.elapsed().as_secs_f64();
    Simulated {
        impact: record.impact(material, radius, plan.velocity, seconds),
        compressed: record.compressed.map(material, radius),
        rebound: record.rebound.map(material, radius),
    }
}

/// The flow stress that the material calls for.
fn run_plastic(moduli: Moduli, flow: &Flow, unit: f64, plan: &Plan, speed: f64) -> Record {
    fn with<F: FlowStress>(moduli: Moduli, flow: F, plan: &Plan, speed: f64) -> Record {
        run_geometry(J2 { moduli, flow }, plan, speed)
    }
    let strength = flow.yield_strength / unit;
    if flow.hardening_modulus > 0.0 {
        let modulus = flow.hardening_modulus / unit;
        with(moduli, LinearHardening { strength, modulus }, plan, speed)
    } else {
        with(moduli, PerfectlyPlastic { strength }, plan, speed)
    }
}

/// The space, and in three dimensions the friction, that the plan calls for.
fn run_geometry<M: Constitutive<Axisymmetric> + Constitutive<Solid>>(
    material: M,
    plan: &Plan,
    speed: f64,
) -> Record {
    let tolerance = CONTACT_TOLERANCE * speed * plan.angle.cos();
    let (grid, geometry) = (&plan.grid, plan.geometry);
    if geometry == Geometry::Axisymmetric {
        run_degree(material, plan, speed)
    } else if plan.friction > 0.0 {
        let coefficient = plan.friction;
        let model = solid::build(grid, geometry, material, Coulomb { coefficient }, tolerance);
        Run::new(model, plan, speed).finish()
    } else {
        let model = solid::build(grid, geometry, material, Frictionless, tolerance);
        Run::new(model, plan, speed).finish()
    }
}

/// The spline degree that the plan calls for.
fn run_degree<M: Constitutive<Axisymmetric>>(material: M, plan: &Plan, speed: f64) -> Record {
    let tolerance = CONTACT_TOLERANCE * speed;
    match plan.grid.degree {
        1 => Run::new(
            setup::build::<M, 1, 4>(&plan.grid, material, tolerance),
            plan,
            speed,
        )
        .finish(),
        2 => Run::new(
            setup::build::<M, 2, 9>(&plan.grid, material, tolerance),
            plan,
            speed,
        )
        .finish(),
        _ => Run::new(
            setup::build::<M, 3, 16>(&plan.grid, material, tolerance),
            plan,
            speed,
        )
        .finish(),
    }
}
