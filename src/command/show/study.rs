//! Overview of a study: how its runs ended and what they took, by dynamic pressure over strength.

use crate::case::Case;
use crate::curve::{Status, Summary};
use crate::plan::severity;
use std::fmt::Write;

/// Upper ends of the rows in rho V^2/Y.
const EDGES: [f64; 8] = [1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, f64::INFINITY];

/// What the runs of one row have in common.
#[derive(Default)]
struct Row {
    runs: usize,
    ok: usize,
    closure: f64,
    eroded: f64,
    seconds: f64,
    longest: f64,
}

impl Row {
    fn add(&mut self, s: &Summary) {
        self.runs += 1;
        self.ok += usize::from(s.status == Status::Ok);
        self.closure = self.closure.max(s.energy_closure);
        self.eroded = self.eroded.max(s.eroded_volume_ratio);
        self.seconds += s.wall_s;
        self.longest = self.longest.max(s.wall_s);
    }

    fn line(&self, name: &str) -> String {
        format!(
            "| {name} | {} | {} | {:.2} | {:.1} | {:.1} | {:.1} |\n",
            self.runs,
            self.ok,
            100.0 * self.closure,
            100.0 * self.eroded,
            self.seconds,
            self.longest
        )
    }
}

/// Markdown table of the runs, one row a range of $\rho V^2/Y$ that holds any.
#[must_use]
pub fn overview<'a>(runs: impl Iterator<Item = (&'a Case, &'a Summary)>) -> String {
    let mut rows: [Row; EDGES.len()] = std::array::from_fn(|_| Row::default());
    let mut all = Row::default();
    for (case, summary) in runs {
        // an edge is meant to the digits that groups have
        let q = severity(&case.material, case.velocities[0]) * (1.0 + 1e-8);
        rows[EDGES.partition_point(|edge| *edge <= q)].add(summary);
        all.add(summary);
    }
    let mut text = String::from(
        "| rho V^2/Y | runs | status ok | worst closure (%) | most eroded (%) | seconds | longest run (s) |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for (k, row) in rows.iter().enumerate().filter(|(_, row)| row.runs > 0) {
        let name = match (k.checked_sub(1).map(|k| EDGES[k]), EDGES[k]) {
            (None, high) => format!("below {high}"),
            (Some(low), f64::INFINITY) => format!("{low} and above"),
            (Some(low), high) => format!("{low} to {high}"),
        };
        // writing to a string cannot fail
        let _ = write!(text, "{}", row.line(&name));
    }
    text + &all.line("all")
}
