//! Study command: runs a grid of cases in parallel, equal dimensionless groups once, and resumes where it was stopped.

use super::impact::interval;
use super::study_merge::StudyMergeArgs;
use super::study_report::StudyReportArgs;
use super::study_runs::{Queued, SHARD, planned, queue, simulated, study_folder, whole};
use super::study_table::{check_owner, report};
use super::{Command, Context, Verdict, output_folder};
use crate::curve::Status;
use crate::{Error, Result};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Run the cases of a study, equal dimensionless groups once: `results.csv`. Finished runs are kept and not repeated.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    arg_required_else_help = true
)]
pub struct StudyArgs {
    /// What to do other than run the study here.
    #[command(subcommand)]
    pub verb: Option<StudyVerb>,
    /// The run.
    #[command(flatten)]
    pub run: Option<StudyRunArgs>,
}

/// Verbs on a study.
#[derive(Debug, Subcommand)]
#[allow(missing_docs)] // each verb is described by the doc comment of its arguments
pub enum StudyVerb {
    #[command(after_help = super::examples(StudyMergeArgs::EXAMPLES))]
    Merge(StudyMergeArgs),
    #[command(after_help = super::examples(StudyReportArgs::EXAMPLES))]
    Report(StudyReportArgs),
}

/// Arguments of a run.
#[derive(Debug, Args)]
pub struct StudyRunArgs {
    /// Study file.
    pub study: PathBuf,
    /// Output folder; by default `out/` and the study's name.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Run one of several parts, `1/4` to `4/4`, into a folder of its own below the output folder; `study merge` puts them
    /// together.
    #[arg(long, value_name = "K/N", conflicts_with = "refine")]
    pub shard: Option<String>,
    /// Also run this many cases, drawn over the whole range, with cells of half the size, and compare the change with
    /// the tolerance.
    #[arg(long, default_value_t = 0)]
    pub refine: usize,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

impl Command for StudyArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw study cases/study-480.toml",
        "impactlaw study cases/study-480.toml --refine 20 --out out/study",
        "impactlaw study cases/study-480.toml --shard 1/4",
    ];

    /// Run what is not there yet, then write `results.csv`; [`Verdict::Missed`] when a case did not end with status ok.
    ///
    /// # Errors
    /// Those of reading the study and of writing the results.
    fn run(&self, context: &Context) -> Result<Verdict> {
        match (&self.verb, &self.run) {
            (Some(StudyVerb::Merge(args)), _) => args.run(context),
            (Some(StudyVerb::Report(args)), _) => args.run(context),
            (None, Some(args)) => args.run(context),
            (None, None) => Err(Error::Argument {
                argument: "STUDY".to_owned(),
                found: "nothing".to_owned(),
                allowed: "must name a study file".to_owned(),
            }),
        }
    }
}

impl StudyRunArgs {
    fn run(&self, context: &Context) -> Result<Verdict> {
        let study = planned(&self.study)?;
        if let Some(case) = study.cases.first().filter(|_| self.refine > 0) {
            case.of_own_scheme("--refine")?;
        }
        let interval = interval(&self.checkpoint)?;
        let shard = self.shard.as_deref().map(Shard::read).transpose()?;
        let folder = study_folder(self.out.as_deref(), &study);
        let (out, _shards) = match shard {
            Some(shard) => {
                let own = folder.join(shard.folder());
                (output_folder(Some(&own), &study.name)?, Vec::new())
            }
            None => whole(&folder, &study)?,
        };
        check_owner(&out, &study)?;
        context.open_log(&out, "study", &study.hash);
        let Some(shard) = shard else {
            let runs = simulated(&study, queue(&study), &[&out], interval, context)?;
            return report(&study, &runs, &out, self.refine, context);
        };
        let all = queue(&study);
        let own: Vec<Queued> = all
            .into_iter()
            .skip(shard.index)
            .step_by(shard.of)
            .collect();
        // what the whole study has already is not run again
        let runs = simulated(&study, own, &[&out, &folder], interval, context)?;
        let ok = runs
            .values()
            .filter(|(_, s)| s.status == Status::Ok)
            .count();
        context.say(&format!(
            "shard {}/{}: {} runs, {ok} with status ok -> {}\n",
            shard.index + 1,
            shard.of,
            runs.len(),
            out.display()
        ))?;
        Ok(match ok == runs.len() {
            true => Verdict::Met,
            false => Verdict::Missed,
        })
    }
}

/// One of several parts of a study's runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// From 0.
    index: usize,
    of: usize,
}

impl Shard {
    /// Of `2/4`.
    ///
    /// # Errors
    /// [`Error::Argument`].
    pub fn read(text: &str) -> Result<Self> {
        let number = |text: &str| text.trim().parse::<usize>().ok();
        let both = text.split_once('/');
        let both = both.and_then(|(k, of)| Some((number(k)?, number(of)?)));
        match both {
            Some((k, of)) if (1..=of).contains(&k) => Ok(Shard { index: k - 1, of }),
            _ => Err(Error::Argument {
                argument: "--shard".to_owned(),
                found: format!("\"{text}\""),
                allowed: "must be K/N with K from 1 to N, e.g. 1/4".to_owned(),
            }),
        }
    }

    /// Its folder below that of the study.
    fn folder(self) -> String {
        format!("{SHARD}{}-of-{}", self.index + 1, self.of)
    }
}
