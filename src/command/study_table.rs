//! Tables of a study: results, times, and what finer cells change.

use super::show;
use super::study_runs::Runs;
use super::{Context, Verdict};
use crate::case::Case;
use crate::curve::{Status, Summary};
use crate::files::{Claim, rows_text, write_atomic, write_rows};
use crate::impact::simulate;
use crate::material::Flow;
use crate::material::flow::{FlowConstants, InSi, Spelling};
use crate::plan::{plan, severity, with_cells};
use crate::study::{Groups, REFERENCE, Study, drawn, scaled};
use crate::{Error, PROGRAM, Result};
use rayon::prelude::*;
use serde::Serialize;
use std::path::Path;

/// Writes `results.csv`, `times.csv` and `study.md` of finished runs, and with `refine` `refinement.csv`.
///
/// # Errors
/// Those of writing.
pub fn report(
    study: &Study,
    runs: &Runs,
    out: &Claim,
    refine: usize,
    context: &Context,
) -> Result<Verdict> {
    let path = out.join("results.csv");
    write_atomic(&path, &rows_of(study, runs, &provenance(study), &path)?)?;
    let times: Vec<Time> = runs.iter().map(|(run, (_, s))| Time::of(run, s)).collect();
    write_rows(
        &out.join("times.csv"),
        &context.provenance(&study.hash),
        &times,
    )?;
    let overview = show::study::overview(runs.values().map(|(i, s)| (&study.cases[*i], s)));
    write_atomic(&out.join("study.md"), overview.as_bytes())?;
    let status = |case: &&Case| runs[&Groups::of(case).name()].1.status == Status::Ok;
    let ok = study.cases.iter().filter(status).count();
    context.say(&format!(
        "{} cases, {} runs, {ok} with status ok -> {}\n",
        study.cases.len(),
        runs.len(),
        path.display()
    ))?;
    let met = match refine {
        0 => true,
        count => refinement(study, runs, out, count, context)?,
    };
    Ok(if ok == study.cases.len() && met {
        Verdict::Met
    } else {
        Verdict::Missed
    })
}

/// That a folder does not hold the results of another study, which would be lost.
///
/// # Errors
/// [`Error::Refused`] with the name of that study.
pub fn check_owner(out: &Path, study: &Study) -> Result<()> {
    let path = out.join("results.csv");
    let Ok(text) = std::fs::read_to_string(&path) else {
        return Ok(());
    };
    let owner = |line: &str| line.rsplit_once(STUDY).map(|(_, name)| name.to_owned());
    let first = text.lines().next().unwrap_or_default();
    match (owner(first), owner(&provenance(study))) {
        (Some(there), Some(own)) if there != own => Err(Error::Refused {
            what: path.display().to_string(),
            found: format!("the results of {there}"),
            allowed: format!("must be of {own}: name another folder with --out"),
        }),
        _ => Ok(()),
    }
}

/// What stands before the published method in the provenance of results that were made by one.
pub const SCHEME: &str = "; scheme preset ";
/// What stands before the name of the study in the provenance of its results.
const STUDY: &str = "; impactlaw study ";

/// Text of `results.csv`: the figures of the runs of each case, below a line of `provenance`.
///
/// # Errors
/// [`Error::File`] naming `path` for rows that make no table.
pub fn rows_of(study: &Study, runs: &Runs, provenance: &str, path: &Path) -> Result<Vec<u8>> {
    let rows: Vec<(&Case, Summary)> = study
        .cases
        .iter()
        .map(|case| {
            let (_, summary) = &runs[&Groups::of(case).name()];
            (case, scaled(summary, &REFERENCE, case))
        })
        .collect();
    table(&rows, provenance, path)
}

/// Line on top of `results.csv`: the same however the runs were made, so that the parts of a study make the bytes of the whole.
fn provenance(study: &Study) -> String {
    let file = study.cases.first().and_then(|case| case.path.file_name());
    let file = file.unwrap_or_default().to_string_lossy();
    let hash = &study.hash;
    let method = study.cases.first().and_then(|case| case.method);
    let scheme = method.map_or_else(String::new, |method| format!("{SCHEME}{method}"));
    format!(
        "{PROGRAM}; case sha256 {hash}{scheme}{STUDY}{}",
        file.escape_default()
    )
}

/// A row of `times.csv`: what a run took, which differs from one run to the next.
#[derive(Debug, Serialize)]
struct Time<'a> {
    run: &'a str,
    points: usize,
    steps: u64,
    wall_s: f64,
}

impl<'a> Time<'a> {
    fn of(run: &'a str, summary: &Summary) -> Self {
        Time {
            run,
            points: summary.points,
            steps: summary.steps,
            wall_s: summary.wall_s,
        }
    }
}

/// Run `count` of the runs again with cells of half the size, write `refinement.csv`, and say whether every change is below
/// the tolerance.
///
/// F*, delta* and the contact time are held to it relatively, e as it is: a share of the impact speed. Relative to itself, an e of 0.02 would
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
            let summary = &scaled(summary, &REFERENCE, case);
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
    /// Relative.
    contact_time_change: f64,
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
        let time = planned.contact_time_s / fine.contact_time_s - 1.0;
        let restitution = planned.restitution - fine.restitution;
        let relative = if fine.restitution > 0.0 {
            planned.restitution / fine.restitution - 1.0
        } else {
            planned.restitution
        };
        let changes = [force, displacement, time, restitution];
        let within = |change: &f64| change.abs() < case.tolerance;
        let both_ok = planned.status == Status::Ok && fine.status == Status::Ok;
        Refined {
            young_over_yield: m.flow.map_or(0.0, |f| m.young_modulus / f.yield_strength()),
            severity,
            max_force_change: force,
            max_displacement_change: displacement,
            restitution_change: restitution,
            restitution_relative_change: relative,
            restitution: planned.restitution,
            contact_time_change: time,
            wall_s: planned.wall_s,
            refined_wall_s: fine.wall_s,
            refined_status: match &fine.status {
                Status::Ok => "ok".to_owned(),
                Status::Sticks => "sticks".to_owned(),
                Status::NoRebound => "no rebound".to_owned(),
                Status::Failed(reason) => reason.clone(),
            },
            met: both_ok && changes.iter().all(within),
            met_relatively: both_ok && changes.iter().chain([&relative]).all(within),
        }
    }
}

/// $\rho V^2/Y$ of a case of a study.
fn severity_of(case: &Case) -> f64 {
    severity(&case.material, case.velocities[0])
}

/// A cell of `results.csv`.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Cell {
    Number(f64),
    Count(u64),
    Text(String),
}

/// `results.csv`: the case, its groups, then the keys of `summary.json`, one row a case.
fn table(rows: &[(&Case, Summary)], provenance: &str, path: &Path) -> Result<Vec<u8>> {
    let mut keys = Vec::new();
    let mut cells: Vec<Vec<Cell>> = Vec::new();
    for (case, summary) in rows {
        let row = row(case, summary);
        let row = row.map_err(|e| Error::file("write", path)(e.into()))?;
        let (names, values): (Vec<String>, Vec<Cell>) = row.into_iter().unzip();
        keys = names;
        cells.push(values);
    }
    let header = keys.into_iter().map(Cell::Text).collect();
    cells.insert(0, header);
    rows_text(provenance, &cells).map_err(Error::file("write", path))
}

/// Keys and values of a case and of every figure of its run in the order of `summary.json` (`velocity_m_s` first), but for its
/// tables, the warnings and the wall time; the status as one word, its reason after a colon.
fn row(case: &Case, summary: &Summary) -> serde_json::Result<Vec<(String, Cell)>> {
    let m = &case.material;
    let flow = FlowConstants::<InSi>::of(m.flow.as_ref());
    let number = |key: &str, value: f64| (key.to_owned(), Cell::Number(value));
    let mut row = vec![
        ("name".to_owned(), Cell::Text(case.name.clone())),
        number("density_kg_m3", m.density),
        number("young_modulus_Pa", m.young_modulus),
    ];
    // of every kind: the cases of a study may differ in theirs
    row.extend(Flow::all_constants().iter().map(|constant| {
        let value = flow.value(constant).unwrap_or(f64::NAN);
        (InSi::key(constant), Cell::Number(value))
    }));
    row.push(number("poisson_ratio", m.poisson_ratio));
    row.push(number("radius_m", case.radius));
    row.push(number("angle_deg", case.angle.to_degrees()));
    row.push(number("friction", case.friction));
    row.push(number("tolerance", case.tolerance));
    let groups = Groups::of(case).columns().into_iter();
    row.extend(groups.map(|(key, value)| (key, Cell::Number(value))));
    let text = serde_json::to_string_pretty(summary)?;
    let value = serde_json::to_value(summary)?;
    let keys = text.lines().filter_map(|line| {
        line.strip_prefix("  \"")?
            .split_once("\":")
            .map(|(key, _)| key)
            // tables have no column: whose impact it is, the case's own say; a wall time is no figure of the impact
            .filter(|key| !value[key].is_object() && !value[key].is_array())
            .filter(|key| !["wall_s", "status"].contains(key))
    });
    row.extend(keys.map(|key| (key.to_owned(), cell(&value[key]))));
    let heating = summary.heating.as_ref();
    let ratio = heating.map_or(f64::NAN, |h| h.heat_ratio);
    row.push(number("heat_ratio", ratio));
    let hottest = heating.map_or(f64::NAN, |h| h.max_temperature_k);
    row.push(number("max_temperature_K", hottest));
    let along = summary.tangential.as_ref();
    let ratio = along.and_then(|t| t.restitution).unwrap_or(f64::NAN);
    row.push(number("tangential_restitution", ratio));
    let ratio = along.map_or(f64::NAN, |t| t.impulse_ratio);
    row.push(number("impulse_ratio", ratio));
    let predicted = plan(case, case.velocities[0]).seconds;
    row.push(number("predicted_s", predicted));
    row.push(("status".to_owned(), cell(&value["status"])));
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
