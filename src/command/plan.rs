//! Plan command: prints what would be run, why, and the predicted seconds.

use crate::Result;
use crate::case::Case;
use crate::command::{Command, Context, Verdict, print, print_json};
use crate::plan::{Plan, plans};
use crate::unit::engineering;
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

/// Print what would be run, why, and the predicted seconds.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's, e.g. `--velocity "10 m/s"`.
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
    ];

    /// Print the plan of every speed.
    ///
    /// # Errors
    /// Those of reading and planning the case.
    fn run(&self, _context: &Context) -> Result<Verdict> {
        let case = Case::read(&self.case)?.with_velocities(&self.velocity)?;
        let plans = plans(&case)?;
        match self.json {
            true => print_json(&json(&case, &plans))?,
            false => print(&text(&case, &plans))?,
        }
        Ok(Verdict::Met)
    }
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

/// The plan as a person reads it.
#[must_use]
pub fn text(case: &Case, plans: &[Plan]) -> String {
    let mut out = format!(
        "Plan of {} for {} impacts, tolerance {}\n",
        case.name,
        plans.len(),
        case.tolerance
    );
    let length = |x: f64| engineering(x * case.radius, "m", 3);
    for p in plans {
        let g = &p.grid;
        let _ = write!(
            out,
            "\nV = {} m/s: expect delta* {}, contact radius {}\n  grid      degree {}, {} x {} points a cell piece; cells {} at the pole \
             (a/{:.0}) growing by {} to {}\n  predicted {} points x {} steps = {:.1} s on one core\n",
            p.velocity,
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
