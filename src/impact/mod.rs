//! Impact: one sphere thrown at a rigid wall, from set-up to curve, by the total Lagrangian material point method.
//!
//! Runs in units R = 1, rho = 1, E = 1. Displacements and velocities live on the nodes of a grid that never moves, so
//! there is no velocity transfer and no transfer loss; points carry only their plastic state.

pub(crate) mod grid;
pub mod model;
pub(crate) mod points;
pub(crate) mod stepping;

mod choice;
pub mod kernel;
pub mod pair;
mod run;
pub(crate) mod updated;
pub mod wall;

use self::choice::{Job, Plastic};
use self::run::record::Record;
use crate::Result;
use crate::curve::film::Film;
use crate::curve::{Impact, ParticleMap, Status};
use crate::material::stress::{Elastic, Moduli};
use crate::material::{Material, ReferenceUnits};
use crate::plan::Plan;
use crate::scheme::Scheme;
use crate::tape::Checkpoint;
use rayon::prelude::*;

/// Points of the whole sphere on the thesis' lattice of `count` a diameter.
#[must_use]
pub fn lattice_points(count: f64) -> usize {
    points::lattice::Centred::solid(count).count()
}

/// What a simulated impact leaves: curve, figures and the particle at two moments.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulated {
    /// Curve and figures.
    pub impact: Impact,
    /// The particle at its largest displacement.
    pub compressed: ParticleMap,
    /// The particle after its rebound.
    pub rebound: ParticleMap,
    /// The particle on the way, if the plan has pictures.
    pub film: Film,
    /// Memory of points and nodes, bytes.
    pub memory_bytes: usize,
    /// Energy lost in transfers between points and grid over the incident kinetic energy; 0 where there are none.
    pub transfer_loss: f64,
}

/// Simulate one impact as planned.
///
/// Always returns what the run has; [`crate::curve::Status`] says whether it finished. A run of the crate's own scheme that
/// fails is tried once more with half the time step, and a warning says so; only a good end counts.
#[must_use]
pub fn simulate(material: &Material, radius: f64, plan: &Plan) -> Simulated {
    first(simulated(material, radius, plan, None))
}

/// [`simulate`], kept in a file while it is under way: called again after an interruption, it goes on from there and ends
/// with the same bits. Schemes with an updated Lagrangian reference start anew.
#[must_use]
pub fn simulate_kept(
    material: &Material,
    radius: f64,
    plan: &Plan,
    checkpoint: &Checkpoint,
) -> Simulated {
    first(simulated(material, radius, plan, Some(checkpoint)))
}

/// Simulate `impacts` impacts of one particle, each at the planned speed, each beginning with the shape, the hardening and
/// the stresses that the one before left; its vibration is taken to have died out. At least one is returned, fewer than
/// asked for after one that did not end well. The whole wall time is booked to the first.
///
/// With updated Lagrangian schemes only the first is run.
#[must_use]
pub fn simulate_repeated(
    material: &Material,
    radius: f64,
    plan: &Plan,
    impacts: usize,
) -> Vec<Simulated> {
    let plan = Plan {
        impacts,
        ..plan.clone()
    };
    simulated(material, radius, &plan, None)
}

/// Does `work` for each of `plans` on as many threads as there are, longest first; what it returns is in order of speed.
///
/// # Errors
/// The first of the work's.
pub fn each_speed<T: Send>(
    mut plans: Vec<Plan>,
    work: impl Fn(&mut Plan) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    plans.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    let mut all = plans
        .par_iter_mut()
        .with_max_len(1)
        .map(|plan| Ok((plan.velocity, work(plan)?)))
        .collect::<Result<Vec<(f64, T)>>>()?;
    all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Ok(all.into_iter().map(|(_, done)| done).collect())
}

/// Run the impacts of a plan with the material it calls for.
fn attempt(
    material: &Material,
    radius: f64,
    plan: &Plan,
    checkpoint: Option<&Checkpoint>,
) -> Vec<Record> {
    let units = ReferenceUnits::of(material, radius);
    let moduli = Moduli::new(1.0, material.poisson_ratio);
    let job = &Job {
        plan,
        speed: plan.run_velocity / units.speed(),
        checkpoint: checkpoint.map(|c| (c, description(material, radius, plan))),
    };
    match material.flow.filter(|_| plan.plastic) {
        None => choice::run(Elastic { moduli }, job),
        Some(flow) => flow.in_reference(&units).visit(Plastic { moduli, job }),
    }
}

/// What tells a run from others: a flow stress that knows seconds runs differently in another size.
fn description(material: &Material, radius: f64, plan: &Plan) -> String {
    format!("{material:?} R = {radius:?} m {plan:?}")
}

/// Why the last impact failed, if it did.
fn failure(records: &[Record]) -> Option<String> {
    match &records.last()?.status {
        Status::Failed(reason) => Some(reason.clone()),
        _ => None,
    }
}

/// The first impact: there always is one.
fn first(mut all: Vec<Simulated>) -> Simulated {
    all.swap_remove(0)
}

/// All impacts of a plan.
fn simulated(
    material: &Material,
    radius: f64,
    plan: &Plan,
    checkpoint: Option<&Checkpoint>,
) -> Vec<Simulated> {
    let started = std::time::Instant::now();
    let mut records = attempt(material, radius, plan, checkpoint);
    let stopped = checkpoint.is_some_and(Checkpoint::is_stopped);
    let again = plan.scheme == Scheme::default() && !stopped;
    if let Some(reason) = failure(&records).filter(|_| again) {
        tracing::warn!("{reason}; tried again with half the time step");
        let mut careful = plan.clone();
        careful.grid.dt_share *= 0.5;
        let again = attempt(material, radius, &careful, checkpoint);
        // of two that did not end well the first tells more
        if again.last().is_some_and(|r| r.status == Status::Ok) {
            records = again;
        }
    }
    let mut seconds = started.elapsed().as_secs_f64();
    // a film shows the run, at the moments of the curve that is brought back from it
    let moment = ReferenceUnits::of(material, radius).time() * plan.similarity().time();
    let finished = |record: Record| {
        let wall = record.seconds_before + std::mem::take(&mut seconds);
        let impact = record.impact(material, radius, plan, wall);
        Simulated {
            impact,
            compressed: record.compressed.map(material, radius),
            rebound: record.rebound.map(material, radius),
            film: Film {
                pictures: (record.film.iter())
                    .map(|(time, picture)| (time * moment, picture.map(material, radius)))
                    .collect(),
            },
            memory_bytes: record.memory_bytes,
            transfer_loss: record.transfer_loss,
        }
    };
    records.into_iter().map(finished).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_checkpoint_is_of_one_material_radius_and_plan() {
        let text = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
            poisson_ratio = 0.35\nyield_strength = \"3 MPa\"\n[impact]\nvelocities = [\"5 m/s\"]\n[accuracy]\ntolerance = 0.02\n";
        let case = Case::parse(text, "c.toml".as_ref()).unwrap();
        let plan = |velocity| crate::plan::plan(&case, velocity);
        let harder = Material {
            flow: Some(crate::material::Flow::perfectly_plastic(4e6)),
            ..case.material
        };
        let all = [
            description(&case.material, 1e-3, &plan(5.0)),
            description(&case.material, 2e-3, &plan(5.0)),
            description(&case.material, 1e-3, &plan(6.0)),
            description(&harder, 1e-3, &plan(5.0)),
        ];
        for (k, one) in all.iter().enumerate() {
            assert!(!all[..k].contains(one), "{one}");
        }
    }
}
