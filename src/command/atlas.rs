//! `atlas`: from a study of many materials to the law of any of them, and how that compares with the theories.

use super::impact::interval;
use super::study_runs::{planned, queue, run_folder, simulated, study_folder, whole};
use super::study_table::report;
use super::{Command, Context, Verdict, check_writable};
use crate::atlas::{Atlas, Reference, Score, error_of_restitution};
use crate::compare::Comparison;
use crate::curve::Impact;
use crate::files::write_atomic;
use crate::law::ATLAS;
use crate::study::{Groups, Study};
use crate::{Error, PROGRAM, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Fit the atlas, from which `law` makes the law of any material, to a study of many.
#[derive(Debug, Args)]
pub struct AtlasArgs {
    /// Study file; what is not there yet is run.
    pub study: PathBuf,
    /// Output folder of the study; by default `out/` and its name.
    #[arg(long)]
    pub runs: Option<PathBuf>,
    /// Atlas to write; by default `atlas.json` in that folder.
    #[arg(short, long, conflicts_with = "compare")]
    pub out: Option<PathBuf>,
    /// Fit nothing: compare the program's atlas and every theory with the impacts of the study.
    #[arg(long)]
    pub compare: bool,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

impl Command for AtlasArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw atlas cases/atlas.toml --out models/atlas.json",
        "impactlaw atlas cases/atlas-unseen.toml --compare",
    ];

    /// Run what the study lacks, then fit, score with materials left out and write; or compare.
    ///
    /// # Errors
    /// Those of the study, of [`Atlas::fit`], of a material outside the atlas, and of writing.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let study = planned(&self.study)?;
        let interval = interval(&self.checkpoint)?;
        if let Some(path) = &self.out {
            let folder = path
                .parent()
                .filter(|folder| !folder.as_os_str().is_empty());
            check_writable(folder.unwrap_or(Path::new(".")))?;
        }
        let atlas = match self.compare {
            true => Some(seen(&study)?),
            false => None,
        };
        let folder = study_folder(self.runs.as_deref(), &study);
        for case in &study.cases {
            case.of_a_normal_impact("the atlas")?;
            case.of_own_scheme("the atlas")?;
        }
        let (out, _shards) = whole(&folder, &study)?;
        context.open_log(&out, "atlas", &study.hash);
        let runs = simulated(&study, queue(&study), &[&out], interval, context)?;
        report(&study, &runs, &out, 0, context)?;
        // in the order of the study, whose neighbours have nothing in common
        let mut impacts: Vec<Reference> = Vec::new();
        for case in &study.cases {
            let groups = Groups::of(case);
            let impact = Impact::read(&run_folder(&out, &groups.name()))?;
            impacts.push((groups.case(), impact));
        }
        if let Some(atlas) = atlas {
            context.say(&comparison(&atlas, &impacts)?)?;
            return Ok(Verdict::Met);
        }
        let atlas = Atlas::fit(&impacts, (&study.name, &study.hash), PROGRAM)?;
        let path = self.out.clone().unwrap_or_else(|| out.join("atlas.json"));
        let text = serde_json::to_string_pretty(&atlas);
        let text = text.map_err(|e| Error::file("write", &path)(e.into()))?;
        write_atomic(&path, format!("{text}\n").as_bytes())?;
        let rows = [
            ("its own impacts", &atlas.own),
            ("a tenth left out", &atlas.left_out),
            ("of these, E/Y < 30", &atlas.left_out_soft),
            ("a level left out", &atlas.levels),
        ];
        context.say(&table(&rows))?;
        context.say(&format!("-> {}\n", path.display()))?;
        Ok(Verdict::Met)
    }
}

/// The program's atlas, which holds every material of `study`.
fn seen(study: &Study) -> Result<Atlas> {
    let atlas = Atlas::built_in()?;
    for case in &study.cases {
        atlas.law(&case.material)?;
    }
    Ok(atlas)
}

/// Errors of the atlas and of every theory, law by law.
fn comparison(atlas: &Atlas, impacts: &[Reference]) -> Result<String> {
    let mut found: Vec<(String, Vec<[f64; 3]>)> = Vec::new();
    for (case, impact) in impacts {
        let one = std::slice::from_ref(impact);
        let mut laws = Comparison::new(&case.material, case.radius, one);
        laws.add(ATLAS, &atlas.law(&case.material)?);
        laws.add_theories(false);
        for row in laws.rows() {
            let Some(errors) = row.errors() else {
                continue;
            };
            let restitution = error_of_restitution(row.restitution, impact.summary.restitution);
            let errors = [errors.force, errors.displacement, restitution];
            match found.iter_mut().find(|(law, _)| *law == row.law) {
                Some((_, all)) => all.push(errors),
                None => found.push((row.law.clone(), vec![errors])),
            }
        }
    }
    let scores: Vec<(&str, Score)> = found
        .iter()
        .map(|(law, errors)| (law.as_str(), Score::of(errors)))
        .collect();
    let rows: Vec<(&str, &Score)> = scores.iter().map(|(law, score)| (*law, score)).collect();
    Ok(table(&rows))
}

/// Errors in per cent, as text.
fn table(rows: &[(&str, &Score)]) -> String {
    let mut text = format!(
        "{:<22} {:>7} {:>24} {:>24} {:>24}\n",
        "errors (%)", "impacts", "median F*, delta*, e", "1 in 20 beyond", "worst"
    );
    for (name, score) in rows {
        let Score {
            impacts,
            median,
            twentieth,
            worst,
        } = score;
        let per_cent = |all: &[f64; 3]| all.map(|x| format!("{:.2}", 100.0 * x)).join(" ");
        text += &format!(
            "{name:<22} {impacts:>7} {:>24} {:>24} {:>24}\n",
            per_cent(median),
            per_cent(twentieth),
            per_cent(worst)
        );
    }
    text + "error of e below 0.2: over 0.2\n"
}
