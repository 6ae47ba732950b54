//! Impact command: simulates every speed of a case in parallel and writes a folder for each.

use crate::case::Case;
use crate::case::pair::{Asked, PairCase};
use crate::command::{CHECKPOINT_FILE, Command, Context, Verdict, impact_folder, output_folder};
use crate::curve::{Status, Summary, film};
use crate::files::write_rows;
use crate::impact::pair::{SimulatedPair, simulate_pair};
use crate::impact::{Simulated, each_speed, simulate_kept, simulate_repeated};
use crate::plan::pair::{PairPlan, pair_plans};
use crate::plan::plans;
use crate::tape::Checkpoint;
use crate::unit::{self, Time, engineering, significant};
use crate::view::impact::write_impact_page;
use crate::view::page::Words;
use crate::{Error, Result};
use clap::Args;
use rayon::prelude::*;
use serde::Serialize;
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
    /// Throw the particle so many times at the same speed, 2 to 100, each time as the impact before left it: shape, hardening and
    /// stresses, at rest. Impacts after the first lie in `repeat_2`, `repeat_3`, ... beside it, their figures in `repeats.csv`.
    /// Not resumed after an interruption.
    #[arg(long, value_name = "IMPACTS", value_parser = clap::value_parser!(u16).range(2..=100))]
    pub repeats: Option<u16>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

impl Command for ImpactArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw impact cases/thesis-4-4.toml",
        r#"impactlaw impact cases/thesis-4-4.toml --velocity "10 m/s" --out out/slow"#,
        "impactlaw impact cases/thesis-4-4.toml --film 50",
        r#"impactlaw impact cases/thesis-4-4.toml --velocity "10 m/s" --repeats 5"#,
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
        if self.repeats.is_some() {
            case.of_a_normal_impact("--repeats")?;
            case.of_own_scheme("--repeats")?;
        }
        if self.film.is_some() {
            case.of_own_scheme("--film")?;
        }
        let out = output_folder(self.out.as_deref(), &case.name)?;
        context.open_log(&out, "impact", &case.hash);
        context
            .log
            .note("plan", &super::plan::text(&case, &plans(&case)?));
        let wanted = Wanted {
            pictures: self.film.map_or(0, usize::from),
            impacts: self.repeats.map_or(1, usize::from),
            ..Wanted::once(interval)
        };
        let all = repeated_impacts(&case, &out, &wanted, context)?;
        let summaries = || all.iter().flatten().map(|done| &done.impact.summary);
        context.say(&findings(summaries(), &out))?;
        summaries().try_for_each(check_summary)?;
        Ok(Verdict::Met)
    }
}

impl ImpactArgs {
    /// The same for two deformable bodies.
    fn of_pair(&self, pair: &PairCase, interval: Duration, context: &Context) -> Result<Verdict> {
        for (argument, asked) in [("--film", self.film), ("--repeats", self.repeats)] {
            if let Some(asked) = asked {
                let allowed = "is for impacts on a rigid wall: of two deformable bodies one is run, and not filmed";
                return Err(Error::Argument {
                    argument: argument.to_owned(),
                    found: asked.to_string(),
                    allowed: allowed.to_owned(),
                });
            }
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
    let mut before: Option<(f64, usize)> = None;
    for summary in all {
        // impacts of one speed are those of one particle
        let number = match before {
            Some((velocity, number)) if velocity == summary.velocity_m_s => number + 1,
            _ => 1,
        };
        before = Some((summary.velocity_m_s, number));
        let folder = repeat_place(&impact_folder(out, summary.velocity_m_s), number);
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
            Status::Sticks => "  sticks",
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

/// What is wanted of each impact besides its curve and its figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Time between checkpoints.
    pub interval: Duration,
    /// Pictures a contact time.
    pub pictures: usize,
    /// Impacts of the particle, one after the other.
    pub impacts: usize,
}

impl Wanted {
    /// One impact without a film.
    #[must_use]
    pub fn once(interval: Duration) -> Self {
        Wanted {
            interval,
            pictures: 0,
            impacts: 1,
        }
    }
}

/// Simulate every speed of `case` once; as [`repeated_impacts`].
///
/// # Errors
/// Those of planning and of writing the results.
pub fn impacts(
    case: &Case,
    out: &Path,
    interval: Duration,
    context: &Context,
) -> Result<Vec<Simulated>> {
    let all = repeated_impacts(case, out, &Wanted::once(interval), context)?;
    Ok(all.into_iter().flatten().collect())
}

/// Simulate every speed of `case`, longest first, and write each as soon as it is there; returned in order of speed, those
/// that did not end among them.
///
/// # Errors
/// Those of planning and of writing the results.
fn repeated_impacts(
    case: &Case,
    out: &Path,
    wanted: &Wanted,
    context: &Context,
) -> Result<Vec<Vec<Simulated>>> {
    let plans = plans(case)?;
    let bar = context.progress(plans.len() as u64, "impacts");
    let all = each_speed(plans, |plan| {
        plan.pictures = wanted.pictures;
        let folder = impact_folder(out, plan.velocity);
        let done = if wanted.impacts > 1 {
            simulate_repeated(&case.material, case.radius, plan, wanted.impacts)
        } else {
            let checkpoint = Checkpoint::new(&folder.join(CHECKPOINT_FILE), wanted.interval);
            let (material, radius) = (&case.material, case.radius);
            vec![simulate_kept(material, radius, plan, &checkpoint)]
        };
        write_impacts(case, &done, &folder, context)?;
        bar.inc(1);
        let summary = &done[0].impact.summary;
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
    })?;
    bar.finish_and_clear();
    Ok(all)
}

/// One impact of a particle that is thrown several times: a row of `repeats.csv`.
#[derive(Debug, Serialize)]
struct Repeat {
    impact: usize,
    restitution: f64,
    #[serde(rename = "max_force_N")]
    max_force_n: f64,
    max_displacement_m: f64,
    residual_displacement_m: f64,
    contact_time_s: f64,
    plastic_work_ratio: f64,
    equivalent_plastic_strain: f64,
    compression_ratio: f64,
}

impl Repeat {
    fn of((before, done): (usize, &Simulated)) -> Self {
        let s = &done.impact.summary;
        Repeat {
            impact: before + 1,
            restitution: s.restitution,
            max_force_n: s.max_force_n,
            max_displacement_m: s.max_displacement_m,
            residual_displacement_m: s.residual_displacement_m,
            contact_time_s: s.contact_time_s,
            plastic_work_ratio: s.plastic_work_ratio,
            equivalent_plastic_strain: s.equivalent_plastic_strain,
            compression_ratio: s.compression_ratio,
        }
    }
}

/// File with the figures of repeated impacts, and how folders of those after the first begin.
const REPEATS: &str = "repeats.csv";
const REPEAT: &str = "repeat_";

/// Writes the impacts of one particle into the folder of its speed, in place of what an earlier run left there.
fn write_impacts(case: &Case, done: &[Simulated], folder: &Path, context: &Context) -> Result<()> {
    let provenance = context.provenance(&case.hash);
    clear_repeats(folder)?;
    for (before, one) in done.iter().enumerate() {
        let place = repeat_place(folder, before + 1);
        one.impact.write(&place, &provenance)?;
        let map = |name: &str| place.join(name);
        (one.compressed).write(&map("particle_compressed.csv"), &provenance)?;
        (one.rebound).write(&map("particle_rebound.csv"), &provenance)?;
        write_film(case, one, &place.join("film"))?;
    }
    if done.len() > 1 {
        let rows: Vec<Repeat> = done.iter().enumerate().map(Repeat::of).collect();
        write_rows(&folder.join(REPEATS), &provenance, &rows)?;
    }
    Ok(())
}

/// Folder of the impact `number` of a particle, the first of which lies in `folder`.
fn repeat_place(folder: &Path, number: usize) -> PathBuf {
    match number {
        1 => folder.to_owned(),
        _ => folder.join(format!("{REPEAT}{number}")),
    }
}

/// Removes repeated impacts of an earlier run: they would be taken for this one's.
fn clear_repeats(folder: &Path) -> Result<()> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(());
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name.and_then(|name| name.strip_prefix(REPEAT));
        let removed = match name {
            Some(REPEATS) => std::fs::remove_file(&path),
            _ if number.is_some_and(|n| n.parse::<usize>().is_ok()) => {
                std::fs::remove_dir_all(&path)
            }
            _ => continue,
        };
        removed.map_err(Error::file("remove", &path))?;
    }
    Ok(())
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
pub(super) fn pair_impacts(
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
        Status::Ok | Status::Sticks => return Ok(()),
        Status::NoRebound => "no rebound before the longest time of the plan".to_owned(),
        Status::Failed(reason) => reason.clone(),
    };
    Err(Error::Impact {
        velocity: summary.velocity_m_s,
        step: summary.steps,
        reason,
    })
}
