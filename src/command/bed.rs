//! `bed`: a scene file to the files of its beds.

use super::{Context, Verdict, output_folder, print};
use crate::bed::run::{BedReport, Options, run_scene};
use crate::bed::scene::Scene;
use crate::cli::BedArgs;
use crate::law::LawFile;
use crate::unit::engineering;
use crate::{Error, Result};
use indicatif::ProgressBar;
use std::fmt::Write;
use std::path::Path;

/// Largest energy imbalance over turnover a run may show.
const CLOSURE: f64 = 0.01;

/// Run the verb.
///
/// # Errors
/// Those of the scene and law files, of the output folder, and of [`run_scene`].
pub fn run(args: &BedArgs, context: &Context) -> Result<Verdict> {
    let scene = Scene::read(&args.scene)?;
    let law = args.law.as_deref().map(LawFile::read).transpose()?;
    let folder = output_folder(args.out.as_deref(), &scene.name)?;
    let report = simulate(&scene, law.as_ref(), &folder, args.seed, context)?;
    print(&summary(&report))?;
    Ok(verdict(&report))
}

/// Run a scene and write its files into `folder`.
///
/// # Errors
/// Those of [`run_scene`].
pub fn simulate(
    scene: &Scene,
    law: Option<&LawFile>,
    folder: &Path,
    seed: Option<u64>,
    context: &Context,
) -> Result<BedReport> {
    let bar = context.progress(rows_expected(scene), "bed");
    let provenance = context.provenance(&scene.hash);
    let report = on_a_worker(|| {
        let options = Options {
            folder,
            provenance: &provenance,
            seed,
            progress: &|_, _| advance(&bar),
        };
        run_scene(scene, law, &options)
    })?;
    bar.finish_and_clear();
    Ok(report)
}

fn advance(bar: &ProgressBar) {
    bar.inc(1);
}

/// Rows a scene writes, about: for the progress bar.
#[must_use]
pub fn rows_expected(scene: &Scene) -> u64 {
    let prepare = scene.stages.iter().filter(|stage| stage.prepares()).count();
    let each = scene.stages.len() - prepare;
    (scene.output.rows * (prepare + each * scene.laws.len())) as u64
}

/// Runs `work` on a thread of the pool, so that its parallel loops need no change of threads.
fn on_a_worker<T: Send>(work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    let mut result = Err(Error::Bed {
        step: 0,
        reason: "the thread pool ended before the run".to_owned(),
    });
    rayon::scope(|_| result = work());
    result
}

/// Table of what came out, as text.
fn summary(report: &BedReport) -> String {
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

/// Missed if an account of energy does not close or a grain got out.
#[must_use]
pub fn verdict(report: &BedReport) -> Verdict {
    let summaries = report.laws.iter().map(|run| &run.summary);
    let fine = summaries
        .chain(report.packing.iter().map(|packing| &packing.summary))
        .all(|s| s.energy_closure < CLOSURE && s.lost_grains == 0);
    if fine { Verdict::Met } else { Verdict::Missed }
}
