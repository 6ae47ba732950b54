//! Falls: free bodies that come to another body before any grain can be in between.

use super::feed::Feed;
use crate::Result;
use crate::bed::scene::{Duration, Scene, Stage, Until};
use crate::dem::bodies::machine::Machine;
use crate::dem::grains::Grains;
use crate::unit::engineering;
use parry3d::math::Vector;

/// That no free body falls straight to one that stands, in the time the stages take at least, without a grain that could be in its way.
/// What turns, is thrown or is pushed is found as the run goes.
///
/// # Errors
/// [`crate::Error::Value`] naming both bodies, and when they meet.
pub fn check_falls(scene: &Scene, feed: &Feed, grains: &Grains, machine: &Machine) -> Result<()> {
    let Some(fall) = machine.first_fall(scene.gravity) else {
        return Ok(());
    };
    let way = scene.gravity.normalize_or_zero();
    let to_come = scene.groups.iter().enumerate();
    let to_come = to_come.filter(|(index, _)| !feed.is_complete(*index));
    let regions = to_come.map(|(_, group)| {
        let corners = group.region.map(|region| region.corners());
        corners.unwrap_or([Vector::MIN, Vector::MAX])
    });
    let present = grains
        .spheres
        .iter()
        .map(|sphere| [sphere.centre - sphere.radius, sphere.centre + sphere.radius]);
    let may_stop = regions
        .chain(present)
        .any(|block| meets(block, fall.through, way));
    if fall.after > least_time(scene) || may_stop {
        return Ok(());
    }
    let [free, other] = fall.bodies.map(|body| &machine.bodies()[body].name);
    let index = scene.bodies.iter().position(|body| body.name == *free);
    let key = format!("body[{}].free", index.unwrap_or(0));
    let allowed = format!(
        "must not come to \"{other}\", as it does after {} with no grain in its way: bodies meet grains only; hold it, put grains between, or give it a joint",
        engineering(fall.after, "s", 3)
    );
    Err(scene.document.reject(&key, allowed))
}

/// Whether grains that start in a block (m) may get into another: some way of falling along `way` leads there.
fn meets([low, high]: [Vector; 2], [from, to]: [Vector; 2], way: Vector) -> bool {
    (0..3).all(|axis| {
        // grains fall without end
        let low = if way[axis] < 0.0 { f64::MIN } else { low[axis] };
        let high = if way[axis] > 0.0 {
            f64::MAX
        } else {
            high[axis]
        };
        low < to[axis] && high > from[axis]
    })
}

/// Time (s) that the stages from the first on take whatever happens.
fn least_time(scene: &Scene) -> f64 {
    let certain = scene.stages.iter().map_while(|stage| match stage {
        Stage::Run(run) if run.until == Until::default() => match run.longest {
            Duration::Time(time) => Some(time),
            Duration::Steps(_) => None,
        },
        _ => None,
    });
    certain.sum()
}
