//! Plan command: prints what would be run, why, and the predicted seconds.

use super::another_kind::kind_of;
use super::study_runs::{planned, queue};
use crate::Result;
use crate::bed::scene::Scene;
use crate::bed::stages::time_step::lengths;
use crate::case::Case;
use crate::case::pair::{Asked, PairCase};
use crate::command::{Command, Context, Verdict, print, print_json};
use crate::plan::pair::{PairPlan, pair_plans};
use crate::plan::{Plan, plans};
use crate::study::Study;
use crate::unit::{engineering, significant};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

/// Print what would be run, why, and the predicted seconds.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// Case, study or scene file.
    pub case: PathBuf,
    /// Speeds of a case, overriding the case's, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for PlanArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw plan cases/thesis-4-4.toml",
        r#"impactlaw plan cases/thesis-4-4.toml --velocity "120 m/s""#,
        "impactlaw plan cases/study-480.toml",
        "impactlaw plan cases/bed-drum.toml",
    ];

    /// Print the plan of every speed, or how long a study or a bed will take.
    ///
    /// # Errors
    /// Those of reading and planning the file.
    fn run(&self, _context: &Context) -> Result<Verdict> {
        let case = match Asked::read(&self.case) {
            Ok(asked) => match asked.with_velocities(&self.velocity)? {
                Asked::RigidWall(case) => case,
                Asked::Pair(pair) => {
                    let plans = pair_plans(&pair)?;
                    match self.json {
                        true => print_json(&pair_json(&pair, &plans))?,
                        false => print(&pair_text(&pair, &plans))?,
                    }
                    return Ok(Verdict::Met);
                }
            },
            Err(error) if self.velocity.is_empty() => {
                let (values, said) = match kind_of(&error) {
                    Some("study") => of_study(&planned(&self.case)?),
                    Some("scene") => of_scene(&Scene::read(&self.case)?),
                    _ => return Err(error),
                };
                match self.json {
                    true => print_json(&values)?,
                    false => print(&said)?,
                }
                return Ok(Verdict::Met);
            }
            Err(error) => return Err(error),
        };
        let plans = plans(&case)?;
        match self.json {
            true => print_json(&json(&case, &plans))?,
            false => print(&text(&case, &plans))?,
        }
        Ok(Verdict::Met)
    }
}

/// What a study takes: for programs, and for people.
fn of_study(study: &Study) -> (Value, String) {
    let queue = queue(study);
    let seconds: f64 = queue.iter().map(|run| run.seconds).sum();
    let longest = queue.iter().map(|run| run.seconds).fold(0.0, f64::max);
    let values = json!({
        "study": study.name,
        "cases": study.cases.len(),
        "runs": queue.len(),
        "predicted_core_s": seconds,
        "longest_run_core_s": longest,
    });
    let said = format!(
        "{}: {} cases, {} runs that differ, {} core seconds together, the longest run {}\n",
        study.name,
        study.cases.len(),
        queue.len(),
        significant(seconds, 2),
        significant(longest, 2)
    );
    (values, said)
}

/// What a bed takes at least, without its compressions.
fn of_scene(scene: &Scene) -> (Value, String) {
    let (lengths, grains) = lengths(scene);
    let mut said = format!("{}: {} grains\n", scene.name, significant(grains, 6));
    for length in &lengths {
        let _ = match length.steps {
            None => writeln!(
                said,
                "  {:<12} as long as the piston is under way",
                length.stage
            ),
            Some(steps) => writeln!(
                said,
                "  {:<12} {}{} steps, {} core seconds",
                length.stage,
                if length.may_end { "at most " } else { "" },
                significant(steps, 3),
                significant(length.seconds, 2)
            ),
        };
    }
    let seconds: f64 = lengths.iter().map(|length| length.seconds).sum();
    let _ = writeln!(
        said,
        "Together {} core seconds for each law, for steps as long as sound in a grain allows; stiff contacts and fast grains shorten them",
        significant(seconds, 2)
    );
    let stages: Vec<Value> = lengths
        .iter()
        .map(|length| {
            json!({
                "stage": length.stage,
                "steps": length.steps,
                "may_end_earlier": length.may_end,
                "predicted_core_s": length.seconds,
            })
        })
        .collect();
    let values = json!({
        "scene": scene.name,
        "grains": grains,
        "stages": stages,
        "predicted_core_s": seconds,
    });
    (values, said)
}

/// The plan for programs: lengths in m, times in s.
#[must_use]
pub fn json(case: &Case, plans: &[Plan]) -> Value {
    let radius = case.radius;
    let one = |plan: &Plan| {
        let effects = plan.effects.iter();
        let effects: Vec<Value> = effects
            .map(|effect| json!({ "name": effect.name, "on": effect.on, "reason": effect.reason }))
            .collect();
        json!({
            "velocity_m_s": plan.velocity,
            "expected_displacement_m": plan.estimate.displacement * radius,
            "expected_contact_radius_m": plan.estimate.contact_radius * radius,
            "degree": plan.grid.degree,
            "points_per_direction": plan.grid.points_per_direction,
            "finest_cell_m": plan.grid.fine * radius,
            "coarsest_cell_m": plan.grid.coarse * radius,
            "points": plan.points,
            "steps": plan.steps,
            "predicted_core_s": plan.seconds,
            "effects": effects,
        })
    };
    let all: Vec<Value> = plans.iter().map(one).collect();
    json!({ "case": case.name, "tolerance": case.tolerance, "impacts": all })
}

/// The plan of two bodies for programs: that of the particle, with the grid of the second body as `target`.
fn pair_json(pair: &PairCase, plans: &[PairPlan]) -> Value {
    let case = &pair.particle;
    let impacts: Vec<Plan> = plans.iter().map(|plan| plan.impact.clone()).collect();
    let mut values = json(case, &impacts);
    for (plan, value) in plans
        .iter()
        .zip(values["impacts"].as_array_mut().into_iter().flatten())
    {
        let (width, height) = plan.target.extent.size();
        value["target"] = json!({
            "shape": pair.target.shape.name(),
            "finest_cell_m": plan.target.fine * case.radius,
            "coarsest_cell_m": plan.target.coarse * case.radius,
            "grid_radius_m": width * case.radius,
            "grid_depth_m": height * case.radius,
        });
    }
    values
}

/// The plan of two bodies as a person reads it.
pub(super) fn pair_text(pair: &PairCase, plans: &[PairPlan]) -> String {
    let case = &pair.particle;
    let impacts: Vec<Plan> = plans.iter().map(|plan| plan.impact.clone()).collect();
    let mut out = text(case, &impacts);
    let length = |x: f64| engineering(x * case.radius, "m", 3);
    for plan in plans {
        let (width, height) = plan.target.extent.size();
        let _ = writeln!(
            out,
            "V = {}: second body ({}) on a grid of radius {}, depth {}; cells {} growing by {} to {}",
            engineering(plan.impact.velocity, "m/s", 4),
            pair.target.shape.name(),
            length(width),
            length(height),
            length(plan.target.fine),
            plan.target.growth,
            length(plan.target.coarse),
        );
    }
    out
}

/// The plan as a person reads it.
#[must_use]
pub fn text(case: &Case, plans: &[Plan]) -> String {
    let mut out = format!(
        "Plan of {} for {} {}, tolerance {}\n",
        case.name,
        plans.len(),
        if plans.len() == 1 {
            "impact"
        } else {
            "impacts"
        },
        case.tolerance
    );
    let length = |x: f64| engineering(x * case.radius, "m", 3);
    for p in plans {
        let g = &p.grid;
        let _ = write!(
            out,
            "\nV = {}: expect delta* {}, contact radius {}\n  grid      degree {}, {} x {} points a cell piece; cells {} at the pole \
             (a/{:.0}) growing by {} to {}\n  predicted {} points x {} steps = {:.1} s on one core\n",
            engineering(p.velocity, "m/s", 4),
            length(p.estimate.displacement * p.similarity().displacement()),
            length(p.estimate.contact_radius * p.similarity().radius()),
            g.degree,
            g.points_per_direction,
            g.points_per_direction,
            length(g.fine),
            p.estimate.contact_radius / g.fine,
            g.growth,
            length(g.coarse),
            p.points,
            p.steps,
            p.seconds,
        );
        for e in &p.effects {
            let state = if e.on { "on " } else { "off" };
            let _ = writeln!(out, "  {state} {:<18} {}", e.name, e.reason);
        }
    }
    let total: f64 = plans.iter().map(|p| p.seconds).sum();
    let _ = writeln!(out, "\nTogether {total:.1} core seconds");
    out
}
