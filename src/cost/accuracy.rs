//! Accuracy: what this crate's runs and the schemes of other codes cost at the same error, speed by speed.

use super::ladder::PLANNED;
use super::relatives::{CUBIC_LATTICES, LINEAR_LATTICES};
use super::{Row, thesis};
use crate::plan::Geometry;
use crate::unit::{rounded, significant};
use serde::Serialize;
use std::fmt::Write;

/// Error in F*, delta* and e at which costs are compared.
pub const TARGET: f64 = 0.01;

/// Order of convergence below which nothing is extrapolated.
const LEAST_ORDER: f64 = 0.5;
/// Error of the finest run above which nothing is extrapolated.
const MOST_ERROR: f64 = 0.2;

/// A ladder of cell sizes, and what it would cost to reach [`TARGET`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Processor time of the finest run, s.
    pub seconds: f64,
    /// Its error.
    pub error: f64,
    /// Order p of the error in the cell size, by least squares over the ladder.
    pub order: f64,
    /// Processor time at [`TARGET`], s: of the cheapest run within it, or extrapolated from the finest by the orders of error
    /// and time; `None` where the error does not fall, or is far from it still.
    pub target_s: Option<f64>,
    /// Whether a run came within [`TARGET`].
    pub reached: bool,
}

impl Reach {
    /// From (cell size, error, seconds) of each run; `None` with fewer than two that ended.
    #[must_use]
    pub fn of(runs: &[(f64, f64, f64)]) -> Option<Reach> {
        let runs: Vec<_> = runs.iter().filter(|r| r.1 > 0.0 && r.2 > 0.0).collect();
        let finest = runs.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        if runs.len() < 2 {
            return None;
        }
        let slope = |value: &dyn Fn(&(f64, f64, f64)) -> f64| {
            let n = runs.len() as f64;
            let x = runs.iter().map(|r| r.0.ln()).sum::<f64>() / n;
            let y = runs.iter().map(|r| value(r).ln()).sum::<f64>() / n;
            let xy: f64 = runs
                .iter()
                .map(|r| (r.0.ln() - x) * (value(r).ln() - y))
                .sum();
            let xx: f64 = runs.iter().map(|r| (r.0.ln() - x).powi(2)).sum();
            xy / xx
        };
        let order = slope(&|r| r.1);
        let growth = -slope(&|r| r.2);
        let within = runs.iter().filter(|r| r.1 <= TARGET).map(|r| r.2);
        let cheapest = within.min_by(f64::total_cmp);
        let further = (order >= LEAST_ORDER && finest.1 <= MOST_ERROR)
            .then(|| finest.2 * (finest.1 / TARGET).max(1.0).powf(growth / order));
        Some(Reach {
            seconds: finest.2,
            error: finest.1,
            order,
            target_s: cheapest.or(further),
            reached: cheapest.is_some(),
        })
    }
}

/// A lattice in three dimensions at one speed beside this crate's own runs; the columns of `cost_accuracy.csv`.
///
/// Compared twice: at the error that the lattice's best run has, where nothing is extrapolated, and at [`TARGET`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Impact speed, m/s.
    pub velocity_m_s: f64,
    /// rho V^2/Y; empty for an elastic body.
    pub severity: Option<f64>,
    /// Ladder of the lattices.
    pub lattice: String,
    /// Points of the most accurate of them.
    pub best_points: usize,
    /// Its error.
    pub best_error: f64,
    /// Its processor time, s.
    pub best_s: f64,
    /// Processor time of this crate's cheapest run with no larger error, s.
    pub same_s: Option<f64>,
    /// The lattice's time over that.
    pub same_ratio: Option<f64>,
    /// The same of this crate's runs in three dimensions, s.
    pub same_solid_s: Option<f64>,
    /// The lattice's time over that.
    pub same_solid_ratio: Option<f64>,
    /// Order of the lattices' error in the cell size.
    pub order: f64,
    /// Whether one of them came within 1 %.
    pub reached: bool,
    /// Processor time of the lattice at 1 %, s; extrapolated where it was not reached.
    pub target_s: Option<f64>,
    /// Processor time of the run planned for a tolerance of 1 %, s.
    pub planned_s: Option<f64>,
    /// Its error.
    pub planned_error: Option<f64>,
    /// The lattice's time at 1 % over the planned run's.
    pub target_ratio: Option<f64>,
}

/// The lines of one speed from all its rows: one for each kind of lattice of which there are two runs or more.
#[must_use]
pub fn lines(rows: &[Row], severity: f64) -> Vec<Line> {
    let preset = thesis::ladder(Geometry::Quarter, 0);
    [&preset, CUBIC_LATTICES, LINEAR_LATTICES]
        .into_iter()
        .filter_map(|ladder| Line::of(ladder, rows, severity))
        .collect()
}

/// Processor time of the cheapest of this crate's own runs in so many dimensions with an error of at most `error`.
fn cheapest(rows: &[Row], dimension: usize, error: f64) -> Option<f64> {
    let ours = |r: &&Row| r.ladder.starts_with("cells, ") || r.ladder == PLANNED;
    rows.iter()
        .filter(ours)
        .filter(|r| r.dimension == dimension && r.error <= error)
        .map(|r| r.cpu_s)
        .min_by(f64::total_cmp)
}

impl Line {
    fn of(ladder: &str, rows: &[Row], severity: f64) -> Option<Line> {
        let lattices = || rows.iter().filter(|r| r.ladder == ladder);
        let runs: Vec<_> = lattices()
            .map(|r| (r.cell_size_rel, r.error, r.cpu_s))
            .collect();
        let reach = Reach::of(&runs)?;
        let best = lattices()
            .filter(|r| r.error.is_finite())
            .min_by(|a, b| a.error.total_cmp(&b.error))?;
        let same_s = cheapest(rows, 2, best.error);
        let same_solid_s = cheapest(rows, 3, best.error);
        let planned = rows
            .iter()
            .find(|r| r.ladder == PLANNED && r.rung.ends_with(" 1 %") && r.error.is_finite());
        let over = |time: Option<f64>, other: Option<f64>| Some(time? / other?);
        let planned_s = planned.map(|r| r.cpu_s);
        Some(Line {
            velocity_m_s: best.velocity_m_s,
            severity: (severity > 0.0).then_some(severity),
            lattice: ladder.to_owned(),
            best_points: best.points,
            best_error: best.error,
            best_s: best.cpu_s,
            same_s,
            same_ratio: over(Some(best.cpu_s), same_s),
            same_solid_s,
            same_solid_ratio: over(Some(best.cpu_s), same_solid_s),
            order: reach.order,
            reached: reach.reached,
            target_s: reach.target_s,
            planned_s,
            planned_error: planned.map(|r| r.error),
            target_ratio: over(reach.target_s, planned_s),
        })
    }
}

/// The lines as Markdown.
#[must_use]
pub fn markdown(lines: &[Line]) -> String {
    let target = significant(TARGET * 100.0, 2);
    let mut text = format!(
        "\n# Time at equal accuracy: lattices in three dimensions and this crate\n\nAccuracy: the largest error in F*, delta* \
         and e against the finest run. Lattices: a quarter of the sphere, FLIP. Thesis: its settings with the longest of its time \
         steps; the other two take the largest stable step. First the most \
         accurate lattice of the ladder, and the cheapest runs of this crate that are no less accurate, in the section and in \
         three dimensions. Then an error of {target} %: the run that `impactlaw impact` plans for that tolerance, and the time \
         at which the lattices would reach it, extrapolated by the order p of their error in the cell size and by that of their \
         time.\n\n| V, m/s | rho V^2/Y | lattice | points | error % | s | section s | ratio | 3-D s | ratio | planned s | error % \
         | p | lattice at {target} %, s | ratio \
         |\n|--:|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
    );
    let cell = |x: Option<f64>, digits| x.map_or_else(String::new, |x| rounded(x, digits));
    let percent = |x: f64| format!("{:.2}", 100.0 * x);
    for l in lines {
        let at_target = match (l.reached, l.target_s) {
            (true, Some(s)) => rounded(s, 2),
            (false, Some(s)) => format!("not reached; about {}", rounded(s, 2)),
            (_, None) => "not reached, not near".to_owned(),
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {at_target} | {} |",
            significant(l.velocity_m_s, 4),
            cell(l.severity, 2),
            l.lattice,
            l.best_points,
            percent(l.best_error),
            rounded(l.best_s, 3),
            cell(l.same_s, 3),
            cell(l.same_ratio, 2),
            cell(l.same_solid_s, 3),
            cell(l.same_solid_ratio, 2),
            cell(l.planned_s, 3),
            l.planned_error.map_or_else(String::new, percent),
            rounded(l.order, 2),
            cell(l.target_ratio, 2),
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_of_error_and_time_extend_a_ladder_to_the_target() {
        // error h, time h^-4: from 4 % at h = 0.04 two octaves to 1 %, 256 times the time
        let runs = [0.16, 0.08, 0.04].map(|h: f64| (h, h, h.powi(-4)));
        let reach = Reach::of(&runs).unwrap();
        assert!((reach.order - 1.0).abs() < 1e-12 && !reach.reached);
        let expected = 256.0 * 0.04f64.powi(-4);
        assert!((reach.target_s.unwrap() / expected - 1.0).abs() < 1e-9);
    }

    #[test]
    fn an_error_that_does_not_fall_is_not_extended_and_one_within_the_target_is_taken() {
        let stuck = [(0.16, 0.1, 1.0), (0.08, 0.12, 16.0)];
        assert_eq!(Reach::of(&stuck).unwrap().target_s, None);
        let met = [(0.16, 0.1, 1.0), (0.08, 0.009, 16.0), (0.04, 0.002, 256.0)];
        let reach = Reach::of(&met).unwrap();
        assert!(reach.reached && reach.target_s == Some(16.0));
        assert_eq!(Reach::of(&[(0.1, f64::NAN, 1.0), (0.2, 0.1, 1.0)]), None);
    }

    #[test]
    fn times_are_compared_at_the_error_of_the_best_lattice() {
        let row = |ladder: &str, dimension, error, cpu_s| Row {
            dimension,
            error,
            cpu_s,
            cell_size_rel: 1.0 / cpu_s,
            velocity_m_s: 3.0,
            ..Row::empty(ladder, "x")
        };
        let rows = [
            row(LINEAR_LATTICES, 3, 0.3, 1.0),
            row(LINEAR_LATTICES, 3, 0.1, 8.0),
            row("cells, degree 2", 2, 0.2, 0.01),
            row("cells, degree 2", 2, 0.08, 0.04),
            row("cells, degree 2", 2, 0.02, 0.1),
            row("cells, 3-D", 3, 0.05, 0.5),
            // neither another lattice nor a relative stands for this crate
            row("lattice, degree 1, FLIP", 2, 0.01, 0.001),
            row("transfer", 2, 0.01, 0.001),
        ];
        let all = lines(&rows, 0.0);
        assert_eq!(all.len(), 1);
        let line = &all[0];
        assert_eq!((line.best_error, line.best_s), (0.1, 8.0));
        assert_eq!(line.same_ratio, Some(8.0 / 0.04));
        assert_eq!(line.same_solid_ratio, Some(16.0));
        assert_eq!((line.reached, line.target_ratio), (false, None));
        assert!(
            markdown(&all).contains("| 3 |  | lattice, 3-D, degree 1, 8 points a cell, FLIP |")
        );
    }
}
