//! Impact command: simulates every speed of a case in parallel and writes a folder for each.

use crate::case::Case;
use crate::cli::ImpactArgs;
use crate::command::{Context, Verdict, impact_folder, output_folder};
use crate::curve::Status;
use crate::impact::{Simulated, simulate};
use crate::plan::plan;
use crate::{Error, Result};
use rayon::prelude::*;
use std::path::Path;

/// Simulate and write all impacts of the case.
///
/// # Errors
/// Those of reading the case and writing the results; [`Error::Impact`] when a run did not finish (its files are written all the same).
pub fn run(args: &ImpactArgs, context: &Context) -> Result<Verdict> {
    let case = Case::read(&args.case)?.with_velocities(&args.velocity)?;
    let out = output_folder(args.out.as_deref(), &case.name)?;
    impacts(&case, &out, context)?;
    Ok(Verdict::Met)
}

/// Simulate every speed of `case`, longest first, and write each as soon as it is there; returned in order of speed.
///
/// # Errors
/// As [`run`].
pub fn impacts(case: &Case, out: &Path, context: &Context) -> Result<Vec<Simulated>> {
    let mut plans: Vec<_> = case.velocities.iter().map(|v| plan(case, *v)).collect();
    plans.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    let bar = context.progress(plans.len() as u64, "impacts");
    let provenance = context.provenance(&case.hash);
    let mut all = plans
        .par_iter()
        .with_max_len(1)
        .map(|plan| {
            let done = simulate(&case.material, case.radius, plan);
            let folder = impact_folder(out, plan.velocity);
            done.impact.write(&folder, &provenance)?;
            let map = |name: &str| folder.join(name);
            done.compressed
                .write(&map("particle_compressed.csv"), &provenance)?;
            done.rebound
                .write(&map("particle_rebound.csv"), &provenance)?;
            bar.inc(1);
            Ok(done)
        })
        .collect::<Result<Vec<Simulated>>>()?;
    bar.finish_and_clear();
    all.sort_by(|a, b| {
        let speed = |s: &Simulated| s.impact.summary.velocity_m_s;
        speed(a).total_cmp(&speed(b))
    });
    for done in &all {
        check(done)?;
    }
    Ok(all)
}

/// A run that did not finish is an error, with its reason.
fn check(done: &Simulated) -> Result<()> {
    let summary = &done.impact.summary;
    let reason = match &summary.status {
        Status::Ok => return Ok(()),
        Status::NoRebound => "no rebound before the longest time of the plan".to_owned(),
        Status::Failed(reason) => reason.clone(),
    };
    Err(Error::Impact {
        velocity: summary.velocity_m_s,
        step: summary.steps,
        reason,
    })
}
