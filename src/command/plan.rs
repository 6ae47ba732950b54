//! Plan command: prints what would be run, why, and the predicted seconds.

use crate::Result;
use crate::case::Case;
use crate::command::{Command, Context, Verdict, print};
use crate::plan::{Plan, plans};
use crate::unit::engineering;
use clap::Args;
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
        print(&text(&case, &plans(&case)?))?;
        Ok(Verdict::Met)
    }
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
            length(p.estimate.displacement),
            length(p.estimate.contact_radius),
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
