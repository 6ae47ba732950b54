//! Impact command: simulates every speed of a case in parallel and writes a folder for each.

use crate::case::Case;
use crate::case::pair::{Asked, PairCase};
use crate::command::{CHECKPOINT_FILE, Command, Context, Verdict, impact_folder, output_folder};
use crate::curve::{Status, Summary, film};
use crate::impact::pair::{SimulatedPair, simulate_pair};
use crate::impact::{Simulated, simulate_kept};
use crate::plan::pair::{PairPlan, pair_plans};
use crate::plan::plans;
use crate::tape::Checkpoint;
use crate::unit::{self, Time, engineering, significant};
use crate::view::impact::write_impact_page;
use crate::view::page::Words;
use crate::{Error, Result};
use clap::Args;
use rayon::prelude::*;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Simulate the impacts of a case: `curve.csv` and `summary.json` for each speed.
#[derive(Debug, Args)]
pub struct ImpactArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Output folder (default: `out/<case name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Film the impact on a rigid wall: about so many pictures in the contact time, 1 to 400, as `film/film.html` that plays them, and
    /// `film/points.pvd` and `film/surface.pvd` for ParaView.
    #[arg(long, value_name = "PICTURES", value_parser = clap::value_parser!(u16).range(1..=400))]
    pub film: Option<u16>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

impl Command for ImpactArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw impact cases/thesis-4-4.toml",
        r#"impactlaw impact cases/thesis-4-4.toml --velocity "10 m/s" --out out/slow"#,
        "impactlaw impact cases/thesis-4-4.toml --film 50",
        "impactlaw impact cases/steel-ball-on-plate.toml",
    ];

    /// Simulate and write all impacts of the case.
    ///
    /// # Errors
    /// Those of reading the case and writing the results; [`Error::Impact`] when a run did not finish (its files are written all the same).
    fn run(&self, context: &Context) -> Result<Verdict> {
        let interval = interval(&self.checkpoint)?;
        let case = match Asked::read(&self.case)?.with_velocities(&self.velocity)? {
            Asked::RigidWall(case) => case,
            Asked::Pair(pair) => return self.of_pair(&pair, interval, context),
        };
        let out = output_folder(self.out.as_deref(), &case.name)?;
        context.open_log(&out, "impact", &case.hash);
        context
            .log
            .note("plan", &super::plan::text(&case, &plans(&case)?));
        let pictures = self.film.map_or(0, usize::from);
        let all = impacts(&case, &out, (interval, pictures), context)?;
        let summaries = all.iter().map(|done| &done.impact.summary);
        context.say(&findings(summaries, &out))?;
        all.iter().try_for_each(check)?;
        Ok(Verdict::Met)
    }
}

impl ImpactArgs {
    /// The same for two deformable bodies.
    fn of_pair(&self, pair: &PairCase, interval: Duration, context: &Context) -> Result<Verdict> {
        if let Some(film) = self.film {
            return Err(Error::Argument {
                argument: "--film".to_owned(),
                found: film.to_string(),
                allowed: "is for an impact on a rigid wall: two deformable bodies are not filmed"
                    .to_owned(),
            });
        }
        let plans = pair_plans(pair)?;
        let case = &pair.particle;
        let out = output_folder(self.out.as_deref(), &case.name)?;
        context.open_log(&out, "impact", &case.hash);
        let said = super::plan::pair_text(pair, &plans);
        context.log.note("plan", &said);
        let all = pair_impacts(pair, plans, &out, interval, context)?;
        let summaries = || all.iter().map(|done| &done.impact.summary);
        context.say(&findings(summaries(), &out))?;
        summaries().try_for_each(check_summary)?;
        Ok(Verdict::Met)
    }
}

/// What the impacts gave and where it lies, as text.
pub(super) fn findings<'a>(all: impl Iterator<Item = &'a Summary>, out: &Path) -> String {
    let mut text = format!(
        "{:>10} {:>8} {:>11} {:>11} {:>11}  folder\n",
        "V", "e", "F*", "delta*", "t_c"
    );
    for summary in all {
        let folder = impact_folder(out, summary.velocity_m_s);
        let figures = [
            engineering(summary.velocity_m_s, "m/s", 4),
            significant(summary.restitution, 4),
            engineering(summary.max_force_n, "N", 4),
            engineering(summary.max_displacement_m, "m", 4),
            engineering(summary.contact_time_s, "s", 4),
        ];
        let [v, e, f, d, t] = figures;
        let mark = match &summary.status {
            Status::Ok => "",
            Status::NoRebound => "  no rebound",
            Status::Failed(_) => "  failed",
        };
        let _ = writeln!(
            text,
            "{v:>10} {e:>8} {f:>11} {d:>11} {t:>11}  {}{mark}",
            folder.display()
        );
    }
    text
}

/// Time between two checkpoints.
///
/// # Errors
/// [`Error::Argument`] when the text is no time.
pub fn interval(text: &str) -> Result<Duration> {
    let seconds = unit::argument::<Time>("--checkpoint", text)?;
    Duration::try_from_secs_f64(seconds).map_err(|_| Error::Argument {
        argument: "--checkpoint".to_owned(),
        found: text.to_owned(),
        allowed: "must be a time of 0 s or more".to_owned(),
    })
}

/// Simulate every speed of `case`, longest first, and write each as soon as it is there, with so many pictures a contact time;
/// returned in order of speed, those that did not end among them.
///
/// # Errors
/// Those of planning and of writing the results.
pub fn impacts(
    case: &Case,
    out: &Path,
    (interval, pictures): (Duration, usize),
    context: &Context,
) -> Result<Vec<Simulated>> {
    let mut plans = plans(case)?;
    plans.iter_mut().for_each(|plan| plan.pictures = pictures);
    plans.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    let bar = context.progress(plans.len() as u64, "impacts");
    let provenance = context.provenance(&case.hash);
    let mut all = plans
        .par_iter()
        .with_max_len(1)
        .map(|plan| {
            let folder = impact_folder(out, plan.velocity);
            let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), interval);
            let done = simulate_kept(&case.material, case.radius, plan, &checkpoint);
            done.impact.write(&folder, &provenance)?;
            let map = |name: &str| folder.join(name);
            done.compressed
                .write(&map("particle_compressed.csv"), &provenance)?;
            done.rebound
                .write(&map("particle_rebound.csv"), &provenance)?;
            write_film(case, &done, &folder.join("film"))?;
            bar.inc(1);
            let summary = &done.impact.summary;
            for warning in &summary.warnings {
                tracing::warn!("at {} m/s: {warning}", plan.velocity);
            }
            tracing::info!(
                "{} m/s: {} points, {} steps in {:.1} s (predicted {:.1} s)",
                plan.velocity,
                summary.points,
                summary.steps,
                summary.wall_s,
                plan.seconds
            );
            Ok(done)
        })
        .collect::<Result<Vec<Simulated>>>()?;
    bar.finish_and_clear();
    all.sort_by(|a, b| {
        let speed = |s: &Simulated| s.impact.summary.velocity_m_s;
        speed(a).total_cmp(&speed(b))
    });
    Ok(all)
}

/// Writes the film of an impact and the page that plays it, in place of an earlier one; without pictures none.
fn write_film(case: &Case, done: &Simulated, folder: &Path) -> Result<()> {
    done.film.write(folder)?;
    if done.film.pictures.is_empty() {
        return Ok(());
    }
    let summary = &done.impact.summary;
    let title = format!(
        "{} at {}",
        case.name,
        engineering(summary.velocity_m_s, "m/s", 4)
    );
    let figures = format!(
        "e {}, F* {}, δ* {}, contact time {}; {} material points",
        significant(summary.restitution, 4),
        engineering(summary.max_force_n, "N", 4),
        engineering(summary.max_displacement_m, "m", 4),
        engineering(summary.contact_time_s, "s", 4),
        summary.points
    );
    let words = Words {
        title: &title,
        summary: &figures,
        warnings: &summary.warnings,
    };
    write_impact_page(
        &folder.join(film::PAGE),
        words,
        &done.film,
        &done.impact.curve,
    )
}

/// Maps of an impact of two bodies.
const PAIR_MAPS: [&str; 4] = [
    "particle_compressed.csv",
    "target_compressed.csv",
    "particle_rebound.csv",
    "target_rebound.csv",
];

/// The same for two deformable bodies; maps of the second one stand beside those of the particle.
///
/// # Errors
/// Those of writing the results.
fn pair_impacts(
    pair: &PairCase,
    mut plans: Vec<PairPlan>,
    out: &Path,
    interval: Duration,
    context: &Context,
) -> Result<Vec<SimulatedPair>> {
    plans.sort_by(|a, b| b.impact.seconds.total_cmp(&a.impact.seconds));
    let bar = context.progress(plans.len() as u64, "impacts");
    let provenance = context.provenance(&pair.particle.hash);
    let mut all = plans
        .par_iter()
        .with_max_len(1)
        .map(|plan| {
            let folder = impact_folder(out, plan.impact.velocity);
            let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), interval);
            let done = simulate_pair(pair, plan, Some(&checkpoint));
            done.impact.write(&folder, &provenance)?;
            let maps = done.compressed.iter().chain(&done.rebound);
            for (name, map) in PAIR_MAPS.iter().zip(maps) {
                map.write(&folder.join(name), &provenance)?;
            }
            bar.inc(1);
            let summary = &done.impact.summary;
            tracing::info!(
                "{} m/s: {} points, {} steps in {:.1} s (predicted {:.1} s)",
                plan.impact.velocity,
                summary.points,
                summary.steps,
                summary.wall_s,
                plan.impact.seconds
            );
            Ok(done)
        })
        .collect::<Result<Vec<SimulatedPair>>>()?;
    bar.finish_and_clear();
    all.sort_by(|a, b| {
        let speed = |s: &SimulatedPair| s.impact.summary.velocity_m_s;
        speed(a).total_cmp(&speed(b))
    });
    Ok(all)
}

/// Checks that a run finished.
///
/// # Errors
/// [`Error::Impact`] with its reason when it did not.
pub fn check(done: &Simulated) -> Result<()> {
    check_summary(&done.impact.summary)
}

fn check_summary(summary: &Summary) -> Result<()> {
    let reason = match &summary.status {
        Status::Ok => return Ok(()),
        Status::NoRebound => "no rebound before the longest time of the plan".to_owned(),
        Status::Failed(reason) => reason.clone(),
    };
    Err(Error::Impact {
        velocity: summary.velocity_m_s,
        step: summary.steps,
        reason,
    })
}
