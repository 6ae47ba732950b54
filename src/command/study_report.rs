//! `study report`: the results of a study beside the thesis, as a page.

use super::show::thesis::{Report, metal};
use super::study_runs::{queue, run_folder, simulated};
use super::{Command, Context, Verdict, output_folder};
use crate::case::Case;
use crate::curve::{Impact, Status, Summary};
use crate::files::{sha256, text, write_rows};
use crate::study::{Groups, KeptRun, REFERENCE, Study, scaled};
use crate::thesis::tables::{METAL_RADIUS, METALS};
use crate::thesis::{Data, Row};
use crate::{Error, Result};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Draw the results of a study as the thesis does, with its equations on top: success map, figures, scores, refits, readings.
#[derive(Debug, Args)]
pub struct StudyReportArgs {
    /// Results of a study: `results.csv`, the folder it is in, or the study file whose results are in `out/`.
    pub results: PathBuf,
    /// Output folder (default: `report` beside the results).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

/// Tolerance of the impacts of lead and nickel.
const TOLERANCE: f64 = 0.02;

impl Command for StudyReportArgs {
    const EXAMPLES: &'static [&'static str] = &["impactlaw study report out/study-480"];

    /// Write `report.html`, its plots and `equations.csv`; lead and nickel are run where they are not there yet.
    ///
    /// # Errors
    /// Those of reading the results, running the two metals, and writing.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let path = self.path();
        let bytes = std::fs::read(&path).map_err(Error::file("read", &path))?;
        let hash = sha256([&bytes]);
        let data = Data::parse(&text(bytes, &path)?, &path)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let own = folder.join("report");
        let out = output_folder(Some(self.out.as_deref().unwrap_or(&own)), "report")?;
        context.open_log(&out, "study-report", &hash);
        let metals = metals(&out, &hash, context)?;
        let report = super::on_a_worker(|| Ok(Report::of(data)))?;
        let provenance = context.provenance(&hash);
        write_rows(&out.join("equations.csv"), &provenance, &report.rows())?;
        let curve = |row: &Row| kept(row, &folder);
        let page = report.page(&metals, &curve, &provenance)?.write(&out)?;
        context.say(&format!("{}\n-> {}\n", report.summary(), page.display()))?;
        Ok(Verdict::Met)
    }
}

impl StudyReportArgs {
    fn path(&self) -> PathBuf {
        let given = &self.results;
        if given.is_dir() {
            return given.join("results.csv");
        }
        match given.extension().is_some_and(|end| end == "toml") {
            true => Path::new("out")
                .join(given.file_stem().unwrap_or_default())
                .join("results.csv"),
            false => given.clone(),
        }
    }
}

/// Impacts of lead and nickel, kept as those of a study are.
fn metals(out: &Path, hash: &str, context: &Context) -> Result<Vec<Summary>> {
    let case = |k: usize| {
        Case::of(
            METALS[k].name,
            METAL_RADIUS,
            metal(k),
            &[METALS[k].velocity],
            TOLERANCE,
        )
    };
    let cases = (0..METALS.len()).map(case).collect::<Result<_>>()?;
    let study = Study::made_from(hash, "metals", cases);
    let runs = simulated(
        &study,
        queue(&study),
        &[out],
        Duration::from_secs(30),
        context,
    )?;
    let of = |case: &Case| {
        let (_, summary) = &runs[&Groups::of(case).name()];
        match summary.status {
            Status::Ok => Ok(scaled(summary, &REFERENCE, case)),
            _ => Err(Error::Refused {
                what: format!("impact of {}", case.name),
                found: format!("{:?}", summary.status),
                allowed: "must come back".to_owned(),
            }),
        }
    };
    study.cases.iter().map(of).collect()
}

/// Impact of a case as the study keeps it, if it does.
fn kept(row: &Row, study: &Path) -> Option<Impact> {
    let case = Case::of(
        "",
        row.radius,
        row.material(),
        &[row.velocity],
        row.tolerance,
    )
    .ok()?;
    let groups = Groups::of(&case);
    let folder = run_folder(study, &groups.name());
    KeptRun::figures(&folder, &groups.name(), &groups.case())?;
    Impact::read(&folder).ok()
}
