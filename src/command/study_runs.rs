//! Runs of a study: which there are, in which folders they lie, and how those that are missing are made.

use super::{CHECKPOINT_FILE, Context, output_folder};
use crate::curve::Summary;
use crate::files::Claim;
use crate::impact::simulate_kept;
use crate::plan::{plan, plans};
use crate::study::{Groups, KeptRun, Study};
use crate::tape::Checkpoint;
use crate::{Error, Result};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Figures of every run by its name, in reference units, with the number of the first case that it is.
pub type Runs = BTreeMap<String, (usize, Summary)>;

/// A study all of whose cases can be run.
///
/// # Errors
/// Those of reading the study and of planning its cases.
pub fn planned(path: &Path) -> Result<Study> {
    let study = Study::read(path)?;
    study
        .cases
        .iter()
        .try_for_each(|case| plans(case).map(drop))?;
    Ok(study)
}

/// Folder of the whole study.
#[must_use]
pub fn study_folder(given: Option<&Path>, study: &Study) -> PathBuf {
    given.map_or_else(|| Path::new("out").join(&study.name), Path::to_owned)
}

/// Claims the folder of a whole study and those of its shards, in which a part may be running.
///
/// # Errors
/// As [`output_folder`].
pub fn whole(folder: &Path, study: &Study) -> Result<(Claim, Vec<Claim>)> {
    let shards = shards(folder)?;
    let shards = shards.iter().map(|shard| Claim::new(shard));
    let shards = shards.collect::<Result<Vec<Claim>>>()?;
    Ok((output_folder(Some(folder), &study.name)?, shards))
}

/// Folders of shards below that of the whole study, in the order of their names.
///
/// # Errors
/// [`Error::File`] when the folder is there and cannot be read.
pub fn shards(whole: &Path) -> Result<Vec<PathBuf>> {
    let found = match std::fs::read_dir(whole) {
        Ok(found) => found,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(Error::file("read", whole)(error)),
    };
    let is_shard = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        path.is_dir() && name.starts_with(SHARD)
    };
    let mut folders: Vec<PathBuf> = found
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(is_shard)
        .collect();
    folders.sort();
    Ok(folders)
}

/// How the folders of shards begin.
pub const SHARD: &str = "shard-";

/// A run that a study asks for.
pub struct Queued {
    groups: Groups,
    /// Name of the run.
    pub name: String,
    /// First case that it is.
    pub first: usize,
    /// Predicted, s of one core.
    pub seconds: f64,
}

/// Every run of a study, longest first.
#[must_use]
pub fn queue(study: &Study) -> Vec<Queued> {
    let mut all: BTreeMap<String, Queued> = BTreeMap::new();
    for (first, case) in study.cases.iter().enumerate() {
        let groups = Groups::of(case);
        all.entry(groups.name()).or_insert_with_key(|name| {
            let run = groups.case();
            Queued {
                name: name.clone(),
                first,
                seconds: plan(&run, run.velocities[0]).seconds,
                groups,
            }
        });
    }
    let mut queue: Vec<Queued> = all.into_values().collect();
    queue.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    queue
}

/// Folder of a run in the folder of a study.
#[must_use]
pub fn run_folder(study: &Path, run: &str) -> PathBuf {
    study.join("runs").join(run)
}

/// Figures of the queued runs: what stands finished in one of the `folders` is read, the rest is run into the first of them.
///
/// # Errors
/// Those of writing.
pub fn simulated(
    study: &Study,
    queue: Vec<Queued>,
    folders: &[&Path],
    interval: Duration,
    context: &Context,
) -> Result<Runs> {
    let bar = context.progress(queue.len() as u64, "study");
    let provenance = context.provenance(&study.hash);
    let done = queue
        .par_iter()
        .with_max_len(1)
        .map(|queued| {
            let name = &queued.name;
            let case = queued.groups.case();
            let finished = folders
                .iter()
                .find_map(|folder| KeptRun::figures(&run_folder(folder, name), name, &case));
            let summary = if let Some(kept) = finished {
                tracing::info!("{name}: kept");
                kept
            } else {
                let folder = run_folder(folders[0], name);
                let plan = plan(&case, case.velocities[0]);
                let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), interval);
                let simulated = simulate_kept(&case.material, case.radius, &plan, &checkpoint);
                simulated.impact.write(&folder, &provenance)?;
                KeptRun::of(&case, name).write(&folder)?;
                let summary = simulated.impact.summary;
                // by the name of the run: its speed is that of a body with R = rho = E = 1
                for warning in &summary.warnings {
                    tracing::warn!("{name}: {warning}");
                }
                tracing::info!(
                    "{name}: {} steps in {:.1} s (predicted {:.1} s)",
                    summary.steps,
                    summary.wall_s,
                    plan.seconds
                );
                summary
            };
            bar.inc(1);
            Ok((name.clone(), (queued.first, summary)))
        })
        .collect::<Result<Runs>>();
    bar.finish_and_clear();
    done
}
