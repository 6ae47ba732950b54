//! `discover --add`: more runs where the formulas that were found disagree most, kept in the store of the study.

use super::study_runs::{queue, simulated, whole};
use super::study_table::{SCHEME, rows_of};
use super::{Context, Verdict};
use crate::case::Case;
use crate::curve::Status;
use crate::discover::more::Candidates;
use crate::discover::table::Table;
use crate::files::{self, write_atomic};
use crate::material::flow::LinearHardening;
use crate::material::{Flow, Material};
use crate::plan::plans;
use crate::study::Study;
use crate::{Error, Result};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Inputs a case can be made of.
const INPUTS: [&str; 9] = [
    "density_kg_m3",
    "young_modulus_Pa",
    "yield_strength_Pa",
    "hardening_modulus_Pa",
    "poisson_ratio",
    "radius_m",
    "velocity_m_s",
    "angle_deg",
    "friction",
];

/// The cases of chosen candidates.
///
/// # Errors
/// [`Error::Refused`] for a table whose inputs make no case of a normal impact, and those of planning.
pub fn cases(table: &Table, candidates: &Candidates, chosen: &[usize]) -> Result<Vec<Case>> {
    let refuse = |what: &str, found: String, allowed: &str| Error::Refused {
        what: format!("{}: {what}", table.path.display()),
        found,
        allowed: allowed.to_owned(),
    };
    let Some(tolerance) = table.tolerance else {
        let allowed =
            "must say what the runs were planned for: take the results.csv of a study as it is";
        return Err(refuse("tolerance", "no such column".to_owned(), allowed));
    };
    for column in &table.inputs {
        let known = INPUTS.contains(&&column.name[..])
            || column.name == crate::discover::problem::YIELD_SPEED;
        let slanted =
            ["angle_deg", "friction"].contains(&&column.name[..]) && column.range()[1] > 0.0;
        if !known || slanted {
            let allowed = "--add makes normal impacts of perfectly plastic or linearly hardening bodies on a frictionless wall";
            return Err(refuse("inputs", format!("`{}`", column.name), allowed));
        }
    }
    let text = std::fs::read_to_string(&table.path).map_err(Error::file("read", &table.path))?;
    let first = text.lines().next().unwrap_or_default();
    if first.starts_with('#') && first.contains(SCHEME) {
        let allowed = "--add runs the crate's own scheme, whose impacts must not stand among those of another";
        return Err(refuse("scheme", "results of a preset".to_owned(), allowed));
    }
    let mut all = Vec::new();
    for (number, &row) in chosen.iter().enumerate() {
        let value = |name: &str| {
            candidates
                .table
                .input(name)
                .map(|column| column.values[row])
        };
        let needed = |name: &str| {
            let missing = || {
                refuse(
                    "inputs",
                    format!("no `{name}`"),
                    "must be there to make a case",
                )
            };
            value(name).ok_or_else(missing)
        };
        let strength = needed("yield_strength_Pa")?;
        let flow = match value("hardening_modulus_Pa").filter(|modulus| *modulus > 0.0) {
            Some(modulus) => LinearHardening { strength, modulus }.into(),
            None => Flow::perfectly_plastic(strength),
        };
        let material = Material {
            density: needed("density_kg_m3")?,
            young_modulus: needed("young_modulus_Pa")?,
            poisson_ratio: needed("poisson_ratio")?,
            flow: Some(flow),
        };
        let name = format!("added-{}", number + 1);
        let speed = needed("velocity_m_s")?;
        let case = Case::of(&name, needed("radius_m")?, material, &[speed], tolerance)?;
        plans(&case)?;
        all.push(case);
    }
    Ok(all)
}

/// Runs the cases into the store of the study whose results have the SHA-256 `hash`, writes `added.csv` beside them, and returns its
/// path with the text of both tables.
///
/// # Errors
/// Those of running and writing; [`Error::Refused`] where `results.csv` has other columns than this program writes, before anything is run.
pub fn run(
    cases: Vec<Case>,
    results: &Path,
    hash: &str,
    context: &Context,
) -> Result<(PathBuf, String, Verdict)> {
    let folder = results
        .parent()
        .filter(|f| !f.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let text = files::read_text(results)?;
    let study = Study::made_from(hash, "added", cases);
    let head = |text: &str| {
        text.lines()
            .find(|line| !line.starts_with('#'))
            .unwrap_or_default()
            .to_owned()
    };
    if !head(&text).starts_with("name,density_kg_m3") || !head(&text).ends_with(",status") {
        return Err(Error::Refused {
            what: results.display().to_string(),
            found: "other columns than `study` writes".to_owned(),
            allowed: "must be the results.csv of a study as it is, so that added rows fit"
                .to_owned(),
        });
    }
    let (out, _shards) = whole(folder, &study)?;
    let runs = simulated(
        &study,
        queue(&study),
        &[&out],
        Duration::from_secs(30),
        context,
    )?;
    let path = out.join("added.csv");
    let added = rows_of(&study, &runs, &context.provenance(hash), &path)?;
    let added = String::from_utf8_lossy(&added).into_owned();
    write_atomic(&path, added.as_bytes())?;
    if head(&added) != head(&text) {
        return Err(Error::Refused {
            what: results.display().to_string(),
            found: "columns of another version of this program".to_owned(),
            allowed: "run the study again, its finished runs are kept; the added runs are too"
                .to_owned(),
        });
    }
    let rows = added.lines().filter(|line| !line.starts_with('#')).skip(1);
    let both = rows.fold(text.trim_end().to_owned(), |all, line| all + "\n" + line) + "\n";
    let ok = runs
        .values()
        .all(|(_, summary)| summary.status == Status::Ok);
    Ok((path, both, if ok { Verdict::Met } else { Verdict::Missed }))
}
