//! `bed`: a scene file to the files of its beds.

use super::bed_export::BedExportArgs;
use super::impact::interval;
use super::{Command, Context, Verdict, on_a_worker, output_folder, show};
use crate::bed::measures::gauge::Finding;
use crate::bed::measures::series::{CLOSURE, Row};
use crate::bed::run::{BedReport, Options, run_scene};
use crate::bed::scene::{Scene, Stage};
use crate::law::LawFile;
use crate::unit::{engineering, significant};
use crate::{Error, Result};
use clap::{Args, Subcommand};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Run a granular bed from a scene file.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    arg_required_else_help = true
)]
pub struct BedArgs {
    /// What to do other than run the scene here.
    #[command(subcommand)]
    pub verb: Option<BedVerb>,
    /// The run.
    #[command(flatten)]
    pub run: Option<BedRunArgs>,
}

/// Verbs on a scene.
#[derive(Debug, Subcommand)]
#[allow(missing_docs)] // each verb is described by the doc comment of its arguments
pub enum BedVerb {
    #[command(after_help = super::examples(BedExportArgs::EXAMPLES))]
    Export(BedExportArgs),
}

/// Arguments of a run.
#[derive(Debug, Args)]
pub struct BedRunArgs {
    /// Scene file.
    pub scene: PathBuf,
    /// Law file for the grains whose law the scene calls `fitted`.
    #[arg(short, long)]
    pub law: Option<PathBuf>,
    /// Output folder (default: `out/<scene name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Insertion seed, overriding the scene's.
    #[arg(long)]
    pub seed: Option<u64>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

impl Command for BedArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw bed cases/bed-drum.toml",
        "impactlaw bed cases/solder-bed.toml --law models/sac305-solder.toml --out out/bed",
    ];

    /// Run the verb, or the one below it.
    ///
    /// # Errors
    /// Those of the scene and law files, of the output folder, of [`run_scene`] and of `bed export`.
    fn run(&self, context: &Context) -> Result<Verdict> {
        match (&self.verb, &self.run) {
            (Some(BedVerb::Export(args)), _) => args.run(context),
            (None, Some(args)) => run_here(args, context),
            (None, None) => Err(Error::Argument {
                argument: "SCENE".to_owned(),
                found: "nothing".to_owned(),
                allowed: "must name a scene file".to_owned(),
            }),
        }
    }
}

fn run_here(args: &BedRunArgs, context: &Context) -> Result<Verdict> {
    let scene = Scene::read(&args.scene)?;
    let law = args.law.as_deref().map(LawFile::read).transpose()?;
    let interval = interval(&args.checkpoint)?;
    let folder = output_folder(args.out.as_deref(), &scene.name)?;
    context.open_log(&folder, "bed", &scene.hash);
    let report = simulate(&scene, law.as_ref(), &folder, args.seed, interval, context)?;
    let compressed = |stage: &Stage| matches!(stage, Stage::Compress { .. });
    let compresses = scene.stages.iter().any(compressed);
    if compresses {
        let show = show::bed(&scene, &report, &report.picture)?;
        for figure in &show.figures {
            figure.write(&folder.join("bed"))?;
        }
    }
    context.say(&summary(&report, compresses))?;
    Ok(verdict(&report))
}

/// Run a scene and write its files into `folder`; the run under way is kept there every `interval`.
///
/// # Errors
/// Those of [`run_scene`].
pub fn simulate(
    scene: &Scene,
    law: Option<&LawFile>,
    folder: &Path,
    seed: Option<u64>,
    interval: Duration,
    context: &Context,
) -> Result<BedReport> {
    let bar = context.progress(rows_expected(scene), "bed");
    let provenance = context.provenance(&scene.hash);
    let told = Told::default();
    let report = on_a_worker(|| {
        let options = Options {
            folder,
            provenance: &provenance,
            seed,
            checkpoint: Some(interval),
            progress: &|what, row| {
                bar.inc(1);
                told.row(what, row);
            },
        };
        run_scene(scene, law, &options)
    })?;
    bar.finish_and_clear();
    Ok(report)
}

/// Rows between two that `-v` tells of within a stage.
const TOLD_EVERY: usize = 20;

/// What `-v` has told of: the stage under way in each run, and the rows since. Runs of several laws go side by side.
#[derive(Default)]
struct Told(Mutex<BTreeMap<String, (String, usize)>>);

impl Told {
    /// Tells of the first row of each stage and of one in [`TOLD_EVERY`].
    fn row(&self, what: &str, row: &Row) {
        // a thread that fell while telling takes nothing with it that matters
        let mut runs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (stage, rows) = runs.entry(what.to_owned()).or_default();
        if *stage != row.stage {
            (*stage, *rows) = (row.stage.clone(), 0);
        }
        if rows.is_multiple_of(TOLD_EVERY) {
            tracing::info!(
                "{what}, {stage}: row {} at {}",
                *rows + 1,
                engineering(row.time_s, "s", 3)
            );
        }
        *rows += 1;
    }
}

/// Rows a scene writes, about: for the progress bar.
#[must_use]
pub fn rows_expected(scene: &Scene) -> u64 {
    let prepare = scene.stages.iter().filter(|stage| stage.prepares()).count();
    let each = scene.stages.len() - prepare;
    (scene.output.rows * (prepare + each * scene.laws.len())) as u64
}

/// What came out, as text: a table of the laws, then what the measures have found and what has to be known.
fn summary(report: &BedReport, compressed: bool) -> String {
    let mut text = if compressed {
        compression(report)
    } else {
        journey(report)
    };
    for run in &report.laws {
        for finding in &run.summary.findings {
            let _ = write!(
                text,
                "{:<22} {:<24} {}",
                run.law,
                finding.name,
                value(finding)
            );
            let _ = match &finding.note[..] {
                "" => writeln!(text),
                note => writeln!(text, "  ({note})"),
            };
        }
        for warning in &run.summary.warnings {
            let _ = writeln!(text, "{:<22} warning: {warning}", run.law);
        }
    }
    let softening = report
        .laws
        .first()
        .map_or(1.0, |run| run.summary.contact_stiffness);
    if softening < 1.0 {
        let _ = writeln!(
            text,
            "contacts are {softening} times as stiff as the material's"
        );
    }
    text
}

/// Value of a finding with its unit, four digits.
fn value(finding: &Finding) -> String {
    match finding.unit {
        _ if finding.value.is_nan() => "none".to_owned(),
        "m" | "kg" | "kg/s" => in_mm_or_g(finding),
        "Pa" => engineering(finding.value, "Pa", 3),
        "" => significant(finding.value, 4),
        unit => format!("{} {unit}", significant(finding.value, 4)),
    }
}

/// Lengths and masses in the units they are read in: mm and g.
fn in_mm_or_g(finding: &Finding) -> String {
    let (unit, prefix) = match finding.unit {
        "m" => ("mm", 1e3),
        "kg" => ("g", 1e3),
        _ => ("g/s", 1e3),
    };
    format!("{} {unit}", significant(prefix * finding.value, 4))
}

/// Table of beds that were compressed.
fn compression(report: &BedReport) -> String {
    let mut text = format!(
        "{:<22} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8}\n",
        "law", "max stress", "residual", "contacts", "plastic", "overlap", "closure", "seconds"
    );
    for run in &report.laws {
        let s = &run.summary;
        let _ = writeln!(
            text,
            "{:<22} {:>10} {:>8.2}% {:>9.2} {:>8.1}% {:>8.2}% {:>9.1e} {:>8.1}",
            run.law,
            engineering(s.max_stress_pa, "Pa", 3),
            100.0 * s.residual_strain,
            s.coordination,
            100.0 * s.plastic_share,
            100.0 * s.max_overlap_ratio,
            s.energy_closure,
            s.wall_s,
        );
    }
    text
}

/// Table of beds that went through other stages.
fn journey(report: &BedReport) -> String {
    let mut text = format!(
        "{:<22} {:>8} {:>10} {:>10} {:>9} {:>9} {:>9} {:>6} {:>8}\n",
        "law", "grains", "time", "time step", "plastic", "overlap", "closure", "lost", "seconds"
    );
    for run in &report.laws {
        let s = &run.summary;
        let _ = writeln!(
            text,
            "{:<22} {:>8} {:>10} {:>10} {:>8.1}% {:>8.2}% {:>9.1e} {:>6} {:>8.1}",
            run.law,
            s.grains,
            engineering(s.time_s, "s", 3),
            engineering(s.time_step_s, "s", 3),
            100.0 * s.plastic_share,
            100.0 * s.max_overlap_ratio,
            s.energy_closure,
            s.lost_grains + s.lost_bodies,
            s.wall_s,
        );
    }
    text
}

/// Missed if an account of energy does not close or a grain got out.
#[must_use]
pub fn verdict(report: &BedReport) -> Verdict {
    let summaries = report.laws.iter().map(|run| &run.summary);
    let fine = summaries
        .chain(report.packing.iter().map(|packing| &packing.summary))
        .all(|s| s.energy_closure < CLOSURE && s.lost_grains + s.lost_bodies == 0);
    if fine { Verdict::Met } else { Verdict::Missed }
}
