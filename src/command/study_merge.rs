//! `study merge`: puts the parts of a study, run apart, together.

use super::study_runs::{Queued, Runs, planned, queue, run_folder, shards, study_folder, whole};
use super::study_table::{check_owner, report};
use super::{Command, Context, Verdict};
use crate::files::write_atomic;
use crate::study::{Groups, KeptRun, Study};
use crate::{Error, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Put the parts of a study that were run with `--shard`, or the finished runs of other studies, together: `results.csv`.
#[derive(Debug, Args)]
pub struct StudyMergeArgs {
    /// Study file.
    pub study: PathBuf,
    /// Output folders to take finished runs from; by default every shard in the study's output folder.
    pub folders: Vec<PathBuf>,
    /// Output folder; by default `out/` and the study's name.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

impl Command for StudyMergeArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw study merge cases/study-480.toml",
        "impactlaw study merge cases/study-480.toml out/study-480 out/another --out out/both",
    ];

    /// Take the finished runs over, then write `results.csv` as the study itself would; [`Verdict::Missed`] as there.
    ///
    /// # Errors
    /// Those of reading and writing; [`Error::Refused`] when a run of the study is in no folder.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let study = planned(&self.study)?;
        let folder = study_folder(self.out.as_deref(), &study);
        let folders = match self.folders.is_empty() {
            true => shards(&folder)?,
            false => self.folders.clone(),
        };
        let (out, _shards) = whole(&folder, &study)?;
        check_owner(&out, &study)?;
        context.open_log(&out, "study-merge", &study.hash);
        let mut runs = Runs::new();
        let mut missing: Option<(usize, Queued)> = None;
        for queued in queue(&study) {
            match taken(&queued, &study, &out, &folders)? {
                Some(run) => {
                    runs.insert(queued.name.clone(), run);
                }
                None => {
                    let (count, first) = missing.unwrap_or((0, queued));
                    missing = Some((count + 1, first));
                }
            }
        }
        if let Some((count, first)) = missing {
            return Err(Error::Refused {
                what: format!("{}: finished runs", self.study.display()),
                found: format!("{} of {}", runs.len(), runs.len() + count),
                allowed: format!(
                    "the other {count} must be run first, with the shards that lack them or `impactlaw study` without `--shard`; \
                     those found are kept in {}. The first that lacks: {}",
                    out.display(),
                    first.name
                ),
            });
        }
        report(&study, &runs, &out, 0, context)
    }
}

/// A run from the first place that has it finished, copied into `out` if it is not there.
fn taken(
    queued: &Queued,
    study: &Study,
    out: &Path,
    folders: &[PathBuf],
) -> Result<Option<(usize, crate::curve::Summary)>> {
    let name = &queued.name;
    let case = Groups::of(&study.cases[queued.first]).case();
    let target = run_folder(out, name);
    if let Some(summary) = KeptRun::figures(&target, name, &case) {
        return Ok(Some((queued.first, summary)));
    }
    for folder in folders {
        let source = run_folder(folder, name);
        let Some(summary) = KeptRun::figures(&source, name, &case) else {
            continue;
        };
        // the mark last: where it stands, the others are whole
        for file in ["curve.csv", "summary.json", KeptRun::FILE] {
            let path = source.join(file);
            let bytes = std::fs::read(&path).map_err(Error::file("read", &path))?;
            write_atomic(&target.join(file), &bytes)?;
        }
        return Ok(Some((queued.first, summary)));
    }
    Ok(None)
}
