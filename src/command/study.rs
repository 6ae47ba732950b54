//! Study command: runs a grid of cases in parallel, equal dimensionless groups once, and resumes where it was stopped.

use super::impact::{CHECKPOINT_FILE, interval};
use super::show;
use super::{Command, Context, Verdict, output_folder};
use crate::case::Case;
use crate::curve::{Status, Summary};
use crate::files::{rows_text, write_atomic, write_rows};
use crate::impact::{simulate, simulate_kept};
use crate::material::flow::{FlowConstants, InSi, Spelling};
use crate::material::{Flow, ReferenceUnits};
use crate::plan::{plan, plans, severity, with_cells};
use crate::study::{KeptRun, Study, drawn, group, scaled};
use crate::tape::Checkpoint;
use crate::{Error, Result};
use clap::Args;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Figures of every group by its name, with the number of the case that stands for it.
type Runs = BTreeMap<String, (usize, Summary)>;

/// Run a grid of cases, equal dimensionless groups once: `results.csv`. Finished runs are kept and not repeated.
#[derive(Debug, Args)]
pub struct StudyArgs {
    /// Study file.
    pub study: PathBuf,
    /// Output folder; by default `out/` and the study's name.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
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
    ];

    /// Run what is not there yet, then write `results.csv`; [`Verdict::Missed`] when a case did not end with status ok.
    ///
    /// # Errors
    /// Those of reading the study and of writing the results.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let study = Study::read(&self.study)?;
        study
            .cases
            .iter()
            .try_for_each(|case| plans(case).map(drop))?;
        let interval = interval(&self.checkpoint)?;
        let out = output_folder(self.out.as_deref(), &study.name)?;
        context.open_log(&out, "study", &study.hash);
        let runs = runs(&study, &out, interval, context)?;
        let rows: Vec<(usize, Summary)> = study
            .cases
            .iter()
            .enumerate()
            .map(|(i, case)| {
                let (first, summary) = &runs[&group(case)];
                (i, scaled(summary, &units(&study.cases[*first]), case))
            })
            .collect();
        let path = out.join("results.csv");
        write_atomic(
            &path,
            &table(&study, &rows, &context.provenance(&study.hash), &path)?,
        )?;
        let overview = show::study::overview(runs.values().map(|(i, s)| (&study.cases[*i], s)));
        write_atomic(&out.join("study.md"), overview.as_bytes())?;
        let ok = rows.iter().filter(|(_, s)| s.status == Status::Ok).count();
        context.say(&format!(
            "{} cases, {} runs, {ok} with status ok -> {}\n",
            rows.len(),
            runs.len(),
            path.display()
        ))?;
        let met = match self.refine {
            0 => true,
            count => refinement(&study, &runs, &out, count, context)?,
        };
        Ok(if ok == rows.len() && met {
            Verdict::Met
        } else {
            Verdict::Missed
        })
    }
}

/// Run `count` of the runs again with cells of half the size, write `refinement.csv`, and say whether every change is below
/// the tolerance.
///
/// F* and delta* are held to it relatively, e as it is: a share of the impact speed. Relative to itself, an e of 0.02 would
/// have to be right within 2 % of 4e-4 of the incident energy, less than the energy balance of any run closes to (1e-4 to
/// 1e-3). The relative change is written beside the absolute one, and the cases that would meet it too are counted.
fn refinement(
    study: &Study,
    runs: &Runs,
    out: &Path,
    count: usize,
    context: &Context,
) -> Result<bool> {
    let mut all: Vec<(f64, usize, &Summary)> = runs
        .values()
        .map(|(i, summary)| (severity_of(&study.cases[*i]), *i, summary))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let picked = drawn(all.len(), count);
    let bar = context.progress(picked.len() as u64, "refinement");
    let mut rows: Vec<Refined> = picked
        .par_iter()
        .with_max_len(1)
        .rev()
        .map(|&k| {
            let (severity, i, summary) = all[k];
            let case = &study.cases[i];
            let halved = with_cells(plan(case, case.velocities[0]), 0.5, &case.material);
            let fine = simulate(&case.material, case.radius, &halved)
                .impact
                .summary;
            bar.inc(1);
            Refined::new(case, severity, summary, &fine)
        })
        .collect();
    bar.finish_and_clear();
    rows.reverse();
    let path = out.join("refinement.csv");
    write_rows(&path, &context.provenance(&study.hash), &rows)?;
    let met = rows.iter().filter(|r| r.met).count();
    let relative = rows.iter().filter(|r| r.met_relatively).count();
    context.say(&format!(
        "{met} of {} runs change by less than the tolerance with cells of half the size ({relative} with e relative to \
         itself) -> {}\n",
        rows.len(),
        path.display()
    ))?;
    Ok(met == rows.len())
}

/// One row of `refinement.csv`: changes from the planned cells to cells of half the size.
#[derive(Debug, Serialize)]
struct Refined {
    young_over_yield: f64,
    #[serde(rename = "rho_V2_over_Y")]
    severity: f64,
    /// Relative.
    max_force_change: f64,
    /// Relative.
    max_displacement_change: f64,
    /// Absolute: e is a share of the impact speed.
    restitution_change: f64,
    restitution_relative_change: f64,
    restitution: f64,
    wall_s: f64,
    refined_wall_s: f64,
    refined_status: String,
    met: bool,
    /// The same with the relative change of e.
    met_relatively: bool,
}

impl Refined {
    fn new(case: &Case, severity: f64, planned: &Summary, fine: &Summary) -> Self {
        let m = &case.material;
        let force = planned.max_force_n / fine.max_force_n - 1.0;
        let displacement = planned.max_displacement_m / fine.max_displacement_m - 1.0;
        let restitution = planned.restitution - fine.restitution;
        let relative = if fine.restitution > 0.0 {
            planned.restitution / fine.restitution - 1.0
        } else {
            planned.restitution
        };
        let worst = force.abs().max(displacement.abs()).max(restitution.abs());
        let both_ok = planned.status == Status::Ok && fine.status == Status::Ok;
        Refined {
            young_over_yield: m.flow.map_or(0.0, |f| m.young_modulus / f.yield_strength()),
            severity,
            max_force_change: force,
            max_displacement_change: displacement,
            restitution_change: restitution,
            restitution_relative_change: relative,
            restitution: planned.restitution,
            wall_s: planned.wall_s,
            refined_wall_s: fine.wall_s,
            refined_status: match &fine.status {
                Status::Ok => "ok".to_owned(),
                Status::NoRebound => "no rebound".to_owned(),
                Status::Failed(reason) => reason.clone(),
            },
            met: both_ok && worst < case.tolerance,
            met_relatively: both_ok && worst.max(relative.abs()) < case.tolerance,
        }
    }
}

/// $\rho V^2/Y$ of a case of a study.
fn severity_of(case: &Case) -> f64 {
    severity(&case.material, case.velocities[0])
}

/// Units of the figures of a case.
fn units(case: &Case) -> ReferenceUnits {
    ReferenceUnits::of(&case.material, case.radius)
}

/// Figures of every group, by its name, with the number of the case that stands for it; finished ones are read.
fn runs(study: &Study, out: &Path, interval: Duration, context: &Context) -> Result<Runs> {
    let mut groups: BTreeMap<String, usize> = BTreeMap::new();
    for (i, case) in study.cases.iter().enumerate() {
        groups.entry(group(case)).or_insert(i);
    }
    let mut queue: Vec<(f64, &String, usize)> = groups
        .iter()
        .map(|(name, &i)| {
            (
                plan(&study.cases[i], study.cases[i].velocities[0]).seconds,
                name,
                i,
            )
        })
        .collect();
    queue.sort_by(|a, b| b.0.total_cmp(&a.0));
    let bar = context.progress(queue.len() as u64, "study");
    let provenance = context.provenance(&study.hash);
    let done = queue
        .par_iter()
        .with_max_len(1)
        .map(|&(_, name, i)| {
            let folder: PathBuf = out.join("runs").join(name);
            let case = &study.cases[i];
            let summary = if let Some(kept) = KeptRun::figures(&folder, name, case) {
                tracing::info!("{name}: kept");
                kept
            } else {
                let plan = plan(case, case.velocities[0]);
                let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), interval);
                let simulated = simulate_kept(&case.material, case.radius, &plan, &checkpoint);
                simulated.impact.write(&folder, &provenance)?;
                KeptRun::of(case, name).write(&folder)?;
                let summary = simulated.impact.summary;
                tracing::info!(
                    "{name}: {} steps in {:.1} s (predicted {:.1} s)",
                    summary.steps,
                    summary.wall_s,
                    plan.seconds
                );
                summary
            };
            bar.inc(1);
            Ok((name.clone(), (i, summary)))
        })
        .collect::<Result<BTreeMap<_, _>>>();
    bar.finish_and_clear();
    done
}

/// A cell of `results.csv`.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Cell {
    Number(f64),
    Count(u64),
    Text(String),
}

/// `results.csv`: the case, then every key of `summary.json`, one row a case.
fn table(
    study: &Study,
    rows: &[(usize, Summary)],
    provenance: &str,
    path: &Path,
) -> Result<Vec<u8>> {
    let mut keys = Vec::new();
    let mut cells: Vec<Vec<Cell>> = Vec::new();
    for (i, summary) in rows {
        let row = row(&study.cases[*i], summary);
        let row = row.map_err(|e| Error::file("write", path)(e.into()))?;
        let (names, values): (Vec<String>, Vec<Cell>) = row.into_iter().unzip();
        keys = names;
        cells.push(values);
    }
    let header = keys.into_iter().map(Cell::Text).collect();
    cells.insert(0, header);
    rows_text(provenance, &cells).map_err(Error::file("write", path))
}

/// Keys and values of a case and of every figure of its run in the order of `summary.json` (`velocity_m_s` first), but for
/// `particle` and `warnings`; the status as one word, its reason after a colon.
fn row(case: &Case, summary: &Summary) -> serde_json::Result<Vec<(String, Cell)>> {
    let m = &case.material;
    let flow = FlowConstants::<InSi>::of(m.flow.as_ref());
    let mut row = vec![
        ("density_kg_m3".to_owned(), Cell::Number(m.density)),
        ("young_modulus_Pa".to_owned(), Cell::Number(m.young_modulus)),
    ];
    // of every kind: the cases of a study may differ in theirs
    row.extend(Flow::all_constants().iter().map(|constant| {
        let value = flow.value(constant).unwrap_or(f64::NAN);
        (InSi::key(constant), Cell::Number(value))
    }));
    row.push(("poisson_ratio".to_owned(), Cell::Number(m.poisson_ratio)));
    row.push(("radius_m".to_owned(), Cell::Number(case.radius)));
    let text = serde_json::to_string_pretty(summary)?;
    let value = serde_json::to_value(summary)?;
    let keys = text.lines().filter_map(|line| {
        line.strip_prefix("  \"")?
            .split_once("\":")
            .map(|(key, _)| key)
            // neither is a figure; whose impact it is, the case's own columns say
            .filter(|key| !["particle", "warnings"].contains(key))
    });
    row.extend(keys.map(|key| (key.to_owned(), cell(&value[key]))));
    Ok(row)
}

/// A value of `summary.json`; numbers are written as in every CSV file.
fn cell(value: &serde_json::Value) -> Cell {
    match value {
        serde_json::Value::Null => Cell::Number(f64::NAN),
        serde_json::Value::Number(number) => match number.as_u64() {
            Some(count) => Cell::Count(count),
            None => Cell::Number(number.as_f64().unwrap_or(f64::NAN)),
        },
        serde_json::Value::String(word) => Cell::Text(word.clone()),
        serde_json::Value::Object(map) => {
            let texts = map
                .iter()
                .map(|(word, why)| format!("{word}: {}", why.as_str().unwrap_or_default()));
            Cell::Text(texts.collect())
        }
        other => Cell::Text(other.to_string()),
    }
}
