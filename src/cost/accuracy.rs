//! Accuracy: what the planned run and the schemes of other codes cost at the same error, one line a speed.

use super::ladder::PLANNED;
use super::relatives::CUBIC_LATTICES;
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

/// One speed; the columns of `cost_accuracy.csv`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Impact speed, m/s.
    pub velocity_m_s: f64,
    /// rho V^2/Y; empty for an elastic body.
    pub severity: Option<f64>,
    /// Processor time of the run planned for a tolerance of 1 %, s.
    pub planned_s: Option<f64>,
    /// Its error.
    pub planned_error: Option<f64>,
    /// Finest cubic lattice in three dimensions with the stable step: processor time, s.
    pub lattice_s: Option<f64>,
    /// Its error.
    pub lattice_error: Option<f64>,
    /// Order of its error in the cell size.
    pub lattice_order: Option<f64>,
    /// Whether a lattice came within 1 %.
    pub lattice_reached: Option<bool>,
    /// Processor time of the lattice at 1 %, s; extrapolated where it was not reached.
    pub lattice_target_s: Option<f64>,
    /// That over the planned run's.
    pub lattice_ratio: Option<f64>,
    /// Steps of the thesis over those of a lattice of the same points with the stable step.
    pub thesis_step_ratio: Option<f64>,
}

impl Line {
    /// From all rows of one speed.
    #[must_use]
    pub fn new(rows: &[Row], severity: f64) -> Line {
        let planned = rows
            .iter()
            .find(|r| r.ladder == PLANNED && r.rung.ends_with(" 1 %") && r.error.is_finite());
        let lattices = || rows.iter().filter(|r| r.ladder == CUBIC_LATTICES);
        let runs: Vec<_> = lattices()
            .map(|r| (r.cell_size_rel, r.error, r.cpu_s))
            .collect();
        let reach = Reach::of(&runs);
        let preset = thesis::ladder(Geometry::Quarter, 0);
        let step_ratio = rows.iter().filter(|r| r.ladder == preset).find_map(|r| {
            let twin = lattices().find(|l| l.points == r.points && l.error.is_finite())?;
            Some(r.steps as f64 / twin.steps as f64)
        });
        let target = reach.and_then(|r| r.target_s);
        Line {
            velocity_m_s: rows.first().map_or(f64::NAN, |r| r.velocity_m_s),
            severity: (severity > 0.0).then_some(severity),
            planned_s: planned.map(|r| r.cpu_s),
            planned_error: planned.map(|r| r.error),
            lattice_s: reach.map(|r| r.seconds),
            lattice_error: reach.map(|r| r.error),
            lattice_order: reach.map(|r| r.order),
            lattice_reached: reach.map(|r| r.reached),
            lattice_target_s: target,
            lattice_ratio: target.zip(planned).map(|(t, r)| t / r.cpu_s),
            thesis_step_ratio: step_ratio,
        }
    }
}

/// The lines as Markdown.
#[must_use]
pub fn markdown(lines: &[Line]) -> String {
    let mut text = format!(
        "\n# An error of {} % in F*, delta* and e, speed by speed\n\nPlanned: what `impactlaw impact` runs for a tolerance of 1 \
         %. Lattice: the thesis' scheme in three dimensions (a quarter, cubic splines, one point a cell, FLIP) with the largest \
         stable step; its finest run, the order p of its error in the cell size, and the time at which it would reach the \
         target, extrapolated by the orders of error and time. The thesis' own time step takes the steps of the last column \
         more.\n\n| V, m/s | rho V^2/Y | planned s | error % | lattice s | error % | p | lattice at {} %, s | ratio | steps of \
         the thesis |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        significant(TARGET * 100.0, 2),
        significant(TARGET * 100.0, 2)
    );
    let cell = |x: Option<f64>, digits| x.map_or_else(String::new, |x| rounded(x, digits));
    let percent = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{:.2}", 100.0 * x));
    for l in lines {
        let target = match (l.lattice_reached, l.lattice_target_s) {
            (Some(true), Some(s)) => rounded(s, 2),
            (Some(false), Some(s)) => format!("not reached; about {}", rounded(s, 2)),
            (Some(false), None) => "not reached, not near".to_owned(),
            _ => String::new(),
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {target} | {} | {} |",
            significant(l.velocity_m_s, 4),
            cell(l.severity, 2),
            cell(l.planned_s, 3),
            percent(l.planned_error),
            cell(l.lattice_s, 3),
            percent(l.lattice_error),
            cell(l.lattice_order, 2),
            cell(l.lattice_ratio, 2),
            cell(l.thesis_step_ratio, 2),
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
}
