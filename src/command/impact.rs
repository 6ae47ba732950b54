//! Impact command: simulates every speed of a case in parallel and writes a folder for each.

use crate::case::Case;
use crate::command::{Command, Context, Verdict, impact_folder, output_folder};
use crate::curve::Status;
use crate::impact::{Simulated, simulate_kept};
use crate::plan::plan;
use crate::tape::Checkpoint;
use crate::unit::{self, Time};
use crate::{Error, Result};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How often a run saves a checkpoint unless told otherwise.
pub const CHECKPOINT: Duration = Duration::from_secs(30);
/// The file it is kept in, beside the results to come; gone when they are there.
pub const CHECKPOINT_FILE: &str = "checkpoint.bin";

/// Simulate the impacts of a case: `curve.csv` and `summary.json` for each speed.
#[derive(Debug, Args)]
pub struct ImpactArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Output folder (default: `out/<case name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

impl Command for ImpactArgs {
    /// Simulate and write all impacts of the case.
    ///
    /// # Errors
    /// Those of reading the case and writing the results; [`Error::Impact`] when a run did not finish (its files are written all the same).
    fn run(&self, context: &Context) -> Result<Verdict> {
        let case = Case::read(&self.case)?.with_velocities(&self.velocity)?;
        let interval = interval(&self.checkpoint)?;
        let out = output_folder(self.out.as_deref(), &case.name)?;
        impacts(&case, &out, interval, context)?;
        Ok(Verdict::Met)
    }
}

/// Time between two checkpoints.
///
/// # Errors
/// [`Error::Argument`] when the text is no time.
pub fn interval(text: &str) -> Result<Duration> {
    let seconds = unit::argument::<Time>("--checkpoint", text)?;
    Duration::try_from_secs_f64(seconds).map_err(|_| Error::Argument {
        argument: "--checkpoint".to_owned(),
        found: text.to_owned(),
        allowed: "must be a time of 0 s or more".to_owned(),
    })
}

/// Simulate every speed of `case`, longest first, and write each as soon as it is there; returned in order of speed.
///
/// # Errors
/// As [`run`].
pub fn impacts(
    case: &Case,
    out: &Path,
    interval: Duration,
    context: &Context,
) -> Result<Vec<Simulated>> {
    let mut plans: Vec<_> = case.velocities.iter().map(|v| plan(case, *v)).collect();
    plans.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    let bar = context.progress(plans.len() as u64, "impacts");
    let provenance = context.provenance(&case.hash);
    let mut all = plans
        .par_iter()
        .with_max_len(1)
        .map(|plan| {
            let folder = impact_folder(out, plan.velocity);
            let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), interval);
            let done = simulate_kept(&case.material, case.radius, plan, &checkpoint);
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
