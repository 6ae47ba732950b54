//! `run` of two deformable bodies: plan, impacts, the law of the pair, comparison, report.

use super::pair_laws::{Shortcuts, shortcuts};
use super::show::{self, NamedLaw, Shown};
use super::{Context, Verdict, compare, impact, output_folder, print_json};
use crate::PROGRAM;
use crate::Result;
use crate::case::pair::PairCase;
use crate::compare::Comparison;
use crate::curve::{Impact, Status};
use crate::document::Document;
use crate::fit::{check_pair, fit_pair};
use crate::impact::pair::SimulatedPair;
use crate::law::PairLaw;
use crate::law::pair::PairTable;
use crate::plan::Plan;
use crate::plan::pair::pair_plans;
use crate::report::RunPage;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What the stages have made, for the report.
struct Results {
    plans: Vec<Plan>,
    simulated: Vec<SimulatedPair>,
    law: PairLaw,
    shortcuts: Shortcuts,
    comparison: Comparison,
}

impl Results {
    fn is_complete(&self) -> bool {
        let ended = |one: &SimulatedPair| one.impact.summary.status == Status::Ok;
        self.simulated.iter().all(ended)
    }
}

/// What is wanted of a run.
#[derive(Debug, Clone, Copy)]
pub struct Wanted<'a> {
    /// Output folder, if not the usual one.
    pub out: Option<&'a Path>,
    /// Time between checkpoints.
    pub interval: Duration,
    /// Whether the theories whose constants are unverified are compared too.
    pub unverified: bool,
    /// Whether what was found is printed as JSON.
    pub json: bool,
}

/// Run everything of a pair; all input is read and checked before any work starts.
///
/// # Errors
/// Those of every stage; what was finished before stays in the output folder.
pub fn run(
    wanted: &Wanted,
    pair: &PairCase,
    document: &Document,
    context: &Context,
) -> Result<Verdict> {
    let started = Instant::now();
    check_pair(pair)?;
    let case = &pair.particle;
    let plans = pair_plans(pair)?;
    let out = output_folder(wanted.out, &case.name)?;
    let target = out.join("law.toml");
    super::fit::check_target(&target, case, Some(&PairTable::of(pair)))?;
    context.open_log(&out, "run", &case.hash);
    context
        .log
        .note("plan", &super::plan::pair_text(pair, &plans));
    let simulated = impact::pair_impacts(pair, plans.clone(), &out, wanted.interval, context)?;
    let plans = plans.into_iter().map(|plan| plan.impact).collect();
    let results = made(wanted, pair, plans, simulated, &out, context)?;
    let page = report(document, pair, &results, &out, context, started.elapsed())?;
    let file = results.law.file();
    let summaries = || results.simulated.iter().map(|one| &one.impact.summary);
    match wanted.json {
        true => print_json(&json!({
            "law": target,
            "report": page,
            "worst_error": file.worst_error(),
            "impacts": summaries().collect::<Vec<_>>(),
            "comparison": results.comparison.rows(),
        }))?,
        false => context.say(&format!(
            "{}\nErrors against these impacts, %\n{}\nlaw     {}, of {}\nerror   {:.2} % at most, of F*, delta* and e: law against simulation\nreport  {}\ntime    {:.1} s\n",
            impact::findings(summaries(), &out),
            results.comparison.summary_markdown().trim_end(),
            target.display(),
            results.law.bodies().bodies(),
            100.0 * file.worst_error(),
            page.display(),
            started.elapsed().as_secs_f64()
        ))?,
    }
    let met = super::fit::verdict(file) == Verdict::Met && results.is_complete();
    Ok(match met {
        true => Verdict::Met,
        false => Verdict::Missed,
    })
}

/// Law and comparison, written.
fn made(
    wanted: &Wanted,
    pair: &PairCase,
    plans: Vec<Plan>,
    simulated: Vec<SimulatedPair>,
    out: &Path,
    context: &Context,
) -> Result<Results> {
    let impacts: Vec<Impact> = simulated.iter().map(|one| one.impact.clone()).collect();
    let law = PairLaw::of(&fit_pair(pair, &impacts)?, pair, PROGRAM);
    law.file().write(&out.join("law.toml"))?;
    let shortcuts = shortcuts(pair, None)?;
    let mut comparison = Comparison::of_pair(law.bodies(), &impacts);
    compare::add_fitted(&mut comparison, law.file())?;
    shortcuts.add_to(&mut comparison)?;
    comparison.add_theories(wanted.unverified);
    let provenance = context.provenance(&pair.particle.hash);
    compare::write(&comparison, out, &provenance)?;
    Ok(Results {
        plans,
        simulated,
        law,
        shortcuts,
        comparison,
    })
}

fn report(
    document: &Document,
    pair: &PairCase,
    results: &Results,
    out: &Path,
    context: &Context,
    taken: Duration,
) -> Result<PathBuf> {
    let (case, effective) = (&pair.particle, pair.effective());
    let file = results.law.file();
    let laws: Vec<NamedLaw> =
        show::laws_of_pair(file, &effective.material, results.shortcuts.laws())?;
    let ended = results.simulated.iter();
    let ended = ended.filter(|one| one.impact.summary.status == Status::Ok);
    let impacts: Vec<&Impact> = ended.clone().map(|one| &one.impact).collect();
    let shown: Vec<Shown> = ended.map(Shown::from).collect();
    RunPage {
        case,
        target: Some(&pair.target),
        case_text: document.text(),
        command: &context.command,
        version: PROGRAM,
        wall: Some(taken.as_secs_f64()),
        predicted: Some(results.plans.iter().map(|plan| plan.seconds).sum()),
        plan: show::choices(case, &results.plans),
        impacts: impacts
            .iter()
            .map(|impact| impact.summary.clone())
            .collect(),
        curves: show::curves(&effective, &impacts, &laws, &results.comparison.ranking())?,
        maps: show::maps(&shown)?,
        fit: Some(show::fit(file)?),
        comparison: show::comparison(&results.comparison.markdown()),
        bed: None,
        references: show::references(&laws),
        limits: [
            show::limits(file),
            results.comparison.left_out_by_theories(),
        ]
        .concat(),
    }
    .write(out)
}
