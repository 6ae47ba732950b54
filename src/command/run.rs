//! `run`: the whole path from a case file to law, comparison, bed and report.

use super::run_pair::Wanted;
use super::show::{self, NamedLaw, Shown};
use super::{Command, Context, Verdict, bed, compare, impact, output_folder, print_json, run_pair};
use crate::bed::run::BedReport;
use crate::bed::scene::Scene;
use crate::case::Case;
use crate::case::pair::Asked;
use crate::compare::Comparison;
use crate::curve::Impact;
use crate::document::Document;
use crate::fit::fit;
use crate::impact::Simulated;
use crate::law::LawFile;
use crate::plan::{Plan, plans};
use crate::report::RunPage;
use crate::{PROGRAM, Result};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What the stages have made, for the report.
struct Results {
    plans: Vec<Plan>,
    simulated: Vec<Simulated>,
    /// Whether every impact finished; those that did not are named in the law.
    complete: bool,
    law: LawFile,
    comparison: Comparison,
    bed: Option<(Scene, BedReport)>,
}

impl Results {
    /// What was found, for programs.
    fn json(&self, law: &Path, page: &Path) -> Value {
        let impacts = self.simulated.iter().map(|one| &one.impact.summary);
        json!({
            "law": law,
            "report": page,
            "worst_error": self.law.worst_error(),
            "impacts": impacts.collect::<Vec<_>>(),
            "comparison": self.comparison.rows(),
        })
    }
}

/// Run everything: plan, impacts, fit, comparison, bed, report.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// Case file.
    pub case: PathBuf,
    /// Output folder (default: `out/<case name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Skip the bed even if the case names a scene.
    #[arg(long)]
    pub no_bed: bool,
    /// Compare the theories too whose constants are unverified.
    #[arg(long)]
    pub unverified: bool,
    /// Random seed (bed insertion), overriding the scene's.
    #[arg(long)]
    pub seed: Option<u64>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for RunArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw run cases/thesis-4-4.toml",
        "impactlaw run cases/solder-ball.toml --no-bed --out out/solder",
        "impactlaw run cases/steel-ball-on-plate.toml",
    ];

    /// Run the verb; all input is read and checked before any work starts.
    ///
    /// # Errors
    /// Those of every stage; what was finished before stays in the output folder.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let started = Instant::now();
        let document = Document::read(&self.case)?;
        let case = match Asked::from_document(&document)? {
            Asked::RigidWall(case) => case,
            Asked::Pair(pair) => {
                let wanted = Wanted {
                    out: self.out.as_deref(),
                    interval: impact::interval(&self.checkpoint)?,
                    unverified: self.unverified,
                    json: self.json,
                };
                return run_pair::run(&wanted, &pair, &document, context);
            }
        };
        super::fit::check_case(&case)?;
        let interval = impact::interval(&self.checkpoint)?;
        let scene = case
            .bed
            .as_deref()
            .filter(|_| !self.no_bed)
            .map(Scene::read)
            .transpose()?;
        if case.material.flow.is_none() {
            tracing::warn!(
                "{} names no yield_strength: the particle is elastic, and so is its law",
                case.path.display()
            );
        }
        let out = output_folder(self.out.as_deref(), &case.name)?;
        super::fit::check_target(&out.join("law.toml"), &case, None)?;
        context.open_log(&out, "run", &case.hash);
        context
            .log
            .note("plan", &super::plan::text(&case, &plans(&case)?));
        let results = stages(
            &case,
            scene,
            &out,
            (self.seed, interval),
            self.unverified,
            context,
        )?;
        let page = report(&document, &case, &results, &out, context, started)?;
        let law = out.join("law.toml");
        match self.json {
            true => print_json(&results.json(&law, &page))?,
            false => context.say(&format!(
                "{}\nErrors against these impacts, %\n{}\nlaw     {}\nerror   {:.2} % at most, of F*, delta* and e: law against simulation\nreport  {}\ntime    {:.1} s\n",
                impact::findings(results.simulated.iter().map(|one| &one.impact.summary), &out),
                results.comparison.summary_markdown().trim_end(),
                law.display(),
                100.0 * results.law.worst_error(),
                page.display(),
                started.elapsed().as_secs_f64()
            ))?,
        }
        Ok(verdict(&results))
    }
}

fn stages(
    case: &Case,
    scene: Option<Scene>,
    out: &Path,
    (seed, interval): (Option<u64>, Duration),
    unverified: bool,
    context: &Context,
) -> Result<Results> {
    let provenance = context.provenance(&case.hash);
    let plans = plans(case)?;
    let simulated = impact::impacts(case, out, interval, context)?;
    let impacts: Vec<Impact> = simulated.iter().map(|one| one.impact.clone()).collect();
    let (simulated, unfinished): (Vec<_>, Vec<_>) = simulated
        .into_iter()
        .partition(|one| impact::check(one).is_ok());
    let law = LawFile::of(&fit(case, &impacts)?, case, PROGRAM);
    law.write(&out.join("law.toml"))?;
    let impacts: Vec<Impact> = simulated.iter().map(|one| one.impact.clone()).collect();
    let mut comparison = Comparison::new(&case.material, case.radius, &impacts);
    compare::add_fitted(&mut comparison, &law)?;
    comparison.add_theories(unverified);
    compare::write(&comparison, out, &provenance)?;
    let bed = scene
        .map(|scene| {
            bed::simulate(&scene, Some(&law), out, seed, interval, context)
                .map(|report| (scene, report))
        })
        .transpose()?;
    Ok(Results {
        plans,
        simulated,
        complete: unfinished.is_empty(),
        law,
        comparison,
        bed,
    })
}

fn report(
    document: &Document,
    case: &Case,
    results: &Results,
    out: &Path,
    context: &Context,
    started: Instant,
) -> Result<std::path::PathBuf> {
    let laws: Vec<NamedLaw> = show::laws(&results.law, &case.material)?;
    let impacts: Vec<&Impact> = results.simulated.iter().map(|one| &one.impact).collect();
    let picture = out.join("bed/bed.png");
    let bed = results
        .bed
        .as_ref()
        .map(|(scene, report)| show::bed(scene, report, &picture))
        .transpose()?;
    RunPage {
        case,
        target: None,
        case_text: document.text(),
        command: &context.command,
        version: PROGRAM,
        wall: Some(started.elapsed().as_secs_f64()),
        predicted: Some(results.plans.iter().map(|plan| plan.seconds).sum()),
        plan: show::choices(case, &results.plans),
        impacts: impacts
            .iter()
            .map(|impact| impact.summary.clone())
            .collect(),
        curves: show::curves(case, &impacts, &laws, &results.comparison.ranking())?,
        maps: show::maps(
            &results
                .simulated
                .iter()
                .map(Shown::from)
                .collect::<Vec<_>>(),
        )?,
        fit: Some(show::fit(&results.law)?),
        comparison: show::comparison(&results.comparison.markdown()),
        bed,
        references: show::references(&laws),
        limits: [
            show::limits(&results.law),
            results.comparison.left_out_by_theories(),
        ]
        .concat(),
    }
    .write(out)
}

/// Missed if an impact did not finish, the law is off by more than its threshold somewhere, or a bed's account does not close.
fn verdict(results: &Results) -> Verdict {
    let law = super::fit::verdict(&results.law) == Verdict::Met;
    let bed = results
        .bed
        .as_ref()
        .is_none_or(|(_, report)| bed::verdict(report) == Verdict::Met);
    if law && bed && results.complete {
        Verdict::Met
    } else {
        Verdict::Missed
    }
}
