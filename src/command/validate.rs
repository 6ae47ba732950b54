//! Validate command: experiments beside our impacts, as a table and a page; missed when a stated bound is.

use super::impact::interval;
use super::show::validate::{page, text};
use super::study_runs::{Runs, queue, run_folder, simulated};
use super::{CHECKPOINT_FILE, Command, Context, Verdict, output_folder};
use crate::Result;
use crate::case::Case;
use crate::case::pair::Asked;
use crate::curve::{Impact, Summary};
use crate::files::{self, sha256, write_atomic};
use crate::impact::pair::simulate_pair;
use crate::impact::simulate_kept;
use crate::plan::pair::{pair_plan, pair_plans};
use crate::plan::{plan, plans};
use crate::report::page::Block;
use crate::shape::Shape;
use crate::study::{Groups, KeptRun, REFERENCE, Study, scaled};
use crate::tape::Checkpoint;
use crate::validate::measured::Figure;
use crate::validate::row::Outcome;
use crate::validate::sample::Sampling;
use crate::validate::{EXPERIMENTS, Found, Prepared, Stated};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Run experiments with measured or otherwise known answers, and compare: `validation.csv`, `validation.html`.
#[derive(Debug, Args)]
pub struct ValidateArgs {
    /// Experiments (default: all).
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// The same, as a list with commas.
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        conflicts_with = "names"
    )]
    pub only: Vec<String>,
    /// Folder to take study files and tables of measurements from, `NAME.toml` and `NAME.csv` (default: those of the program, which are
    /// those of `cases/experiments/`).
    #[arg(long, value_name = "FOLDER")]
    pub from: Option<PathBuf>,
    /// Output folder; impacts are kept in it and not run again.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Draws for the intervals.
    #[arg(long, default_value_t = 2000, value_parser = clap::value_parser!(u32).range(200..=100_000))]
    pub draws: u32,
    /// Seed of the draws.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

/// Name of the page.
const PAGE: &str = "validation.html";
/// Name of the table.
const TABLE: &str = "validation.csv";

impl Command for ValidateArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw validate",
        "impactlaw validate --only balls,lead-nickel",
        "impactlaw validate balls --from cases/experiments --out out/balls",
    ];

    /// Run what is not kept yet, compare, and write table and page; [`Verdict::Missed`] when a stated bound is.
    ///
    /// # Errors
    /// Those of reading the experiments' files, before anything is run, and of writing.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let interval = interval(&self.checkpoint)?;
        let (hash, prepared) = self.prepared()?;
        let all: Vec<Asked> = (prepared.iter())
            .flat_map(|one| one.cases.iter().map(|case| one.asked(case)))
            .collect();
        all.iter().try_for_each(|asked| match asked {
            Asked::RigidWall(case) => plans(case).map(drop),
            Asked::Pair(pair) => pair_plans(pair).map(drop),
        })?;
        let (spheres, others): (Vec<Asked>, Vec<Asked>) = all.into_iter().partition(is_scaled);
        let spheres = spheres.iter().map(|asked| asked.particle().clone());
        let study = Study::made_from(&hash, "validation", spheres.collect());
        let out = output_folder(self.out.as_deref(), "validation")?;
        context.open_log(&out, "validate", &hash);
        let mut runs = simulated(&study, queue(&study), &[&out], interval, context)?;
        let provenance = context.provenance(&hash);
        let alone = others.par_iter().with_max_len(1).map(|asked| {
            let summary = in_its_units(asked, &out, interval, &provenance)?;
            Ok((name(asked), (0, summary)))
        });
        runs.extend(alone.collect::<Result<Vec<_>>>()?);
        let mut found = Vec::new();
        let sampling = Sampling {
            draws: self.draws as usize,
            seed: self.seed,
        };
        for one in prepared {
            let outcomes = one.cases.iter();
            let outcomes = outcomes.map(|case| outcome(&one, case, &runs, &out));
            let outcomes = outcomes.collect::<Result<_>>()?;
            // its place among all, so that it draws the same alone
            let place = EXPERIMENTS
                .iter()
                .position(|all| all.name == one.stated.name);
            found.push(one.found(outcomes, &sampling, place.unwrap_or(0) as u64));
        }
        let missed = self.write(&found, &out, &context.provenance(&hash))?;
        context.say(&format!(
            "{}-> {}\n",
            text(&found),
            out.join(PAGE).display()
        ))?;
        Ok(match missed {
            true => Verdict::Missed,
            false => Verdict::Met,
        })
    }
}

/// Outcome of a case of an experiment, from the runs of all.
fn outcome(one: &Prepared, case: &Case, runs: &Runs, out: &Path) -> Result<Outcome> {
    let of_flats = [Figure::Compression, Figure::MeanPressure];
    let flats = of_flats.iter().any(|f| one.stated.figures.contains(f));
    let asked = one.asked(case);
    let name = name(&asked);
    let (_, summary) = &runs[&name];
    // runs of scaled cases have a radius of one
    let (summary, unit) = match is_scaled(&asked) {
        true => (scaled(summary, &REFERENCE, case), 1.0),
        false => (summary.clone(), case.radius),
    };
    Ok(Outcome {
        case: case.clone(),
        target: one.target,
        summary,
        flat: match flats {
            true => widest(&run_folder(out, &name))? / unit,
            false => f64::NAN,
        },
    })
}

/// Whether an impact is run by its groups, as those of a study are.
fn is_scaled(asked: &Asked) -> bool {
    matches!(asked, Asked::RigidWall(case) if case.shape == Shape::Sphere)
}

/// Name of the run of an impact.
fn name(asked: &Asked) -> String {
    if let Asked::RigidWall(case) = asked
        && is_scaled(asked)
    {
        return Groups::of(case).name();
    }
    // groups are those of spheres on a rigid wall
    let Case {
        shape,
        radius,
        material,
        velocities,
        tolerance,
        ..
    } = asked.particle();
    let kind = match asked.pair() {
        None => shape.name(),
        Some(_) => "pair",
    };
    let target = asked.pair().map(|pair| pair.target);
    let all = format!("{shape:?} {radius:e} {material:?} {velocities:?} {tolerance:e} {target:?}");
    format!("{kind}_{}", &sha256([all])[..16])
}

/// Impact of a cylinder or of two bodies, kept as those of spheres are, in its own units.
fn in_its_units(
    asked: &Asked,
    out: &Path,
    interval: Duration,
    provenance: &str,
) -> Result<Summary> {
    let (name, case) = (name(asked), asked.particle());
    let folder = run_folder(out, &name);
    if let Some(kept) = KeptRun::figures(&folder, &name, case) {
        return Ok(kept);
    }
    let velocity = case.velocities[0];
    let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), interval);
    let impact = match asked {
        Asked::RigidWall(case) => {
            let plan = plan(case, velocity);
            simulate_kept(&case.material, case.radius, &plan, &checkpoint).impact
        }
        Asked::Pair(pair) => {
            simulate_pair(pair, &pair_plan(pair, velocity), Some(&checkpoint)).impact
        }
    };
    impact.write(&folder, provenance)?;
    KeptRun::of(case, &name).write(&folder)?;
    Ok(impact.summary)
}

/// Widest contact of a kept run, in the unit of its lengths.
fn widest(run: &Path) -> Result<f64> {
    let impact = Impact::read_any(run)?;
    let radii = impact.curve.samples.iter().map(|one| one.contact_radius_m);
    Ok(radii.fold(0.0, f64::max))
}

impl ValidateArgs {
    /// The experiments that are asked for, read and checked, and the SHA-256 of their files.
    fn prepared(&self) -> Result<(String, Vec<Prepared>)> {
        let mut names: Vec<&str> = Vec::new();
        for name in self.names.iter().chain(&self.only) {
            let stated = Stated::called(name)?;
            if !names.contains(&stated.name) {
                names.push(stated.name);
            }
        }
        let asked = |one: &&Stated| names.is_empty() || names.contains(&one.name);
        let (mut texts, mut all) = (Vec::new(), Vec::new());
        for stated in EXPERIMENTS.iter().filter(asked) {
            let (cases, measured) = (
                self.file(stated, "toml", stated.cases)?,
                self.file(stated, "csv", stated.measured)?,
            );
            let of = |file: &(String, PathBuf)| (file.0.clone(), file.1.clone());
            let ((cases, at), (measured, there)) = (of(&cases), of(&measured));
            all.push(Prepared::new(stated, (&cases, &at), (&measured, &there))?);
            texts.extend([cases, measured]);
        }
        Ok((sha256(texts), all))
    }

    /// A file of an experiment and its path; of the program's own, the name.
    fn file(&self, stated: &Stated, end: &str, own: &str) -> Result<(String, PathBuf)> {
        let name = format!("{}.{end}", stated.name);
        let Some(folder) = &self.from else {
            return Ok((own.to_owned(), PathBuf::from(name)));
        };
        let path = folder.join(name);
        Ok((files::read_text(&path)?, path))
    }

    /// Writes table, page and plots; whether a bound is missed.
    fn write(&self, found: &[Found], out: &Path, provenance: &str) -> Result<bool> {
        let (table, page) = super::on_a_worker(|| {
            let table = super::show::validate::table(found, provenance);
            Ok((table, page(found, provenance)?))
        })?;
        write_atomic(&out.join(TABLE), &table)?;
        for block in page.sections.iter().flat_map(|section| &section.blocks) {
            if let Block::Figures(figures) = block {
                for figure in figures {
                    figure.write(&out.join("plots"))?;
                }
            }
        }
        write_atomic(&out.join(PAGE), page.html().as_bytes())?;
        let mut bounds = found.iter().flat_map(Found::bounds);
        Ok(bounds.any(|bound| !bound.met))
    }
}
