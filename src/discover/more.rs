//! More runs: where in the range of a study the formulas that were found disagree most.
//!
//! Candidates are a seeded Latin hypercube over the inputs that vary, kept where every group stays within its range in the data and the
//! body yields. The formulas of least description length of each figure are put there; their spread over the error of the data,
//! times the distance to the nearest run, is what a candidate is worth. The best is taken, counts as a run, and so on.

use super::bound::Bound;
use super::front::Entry;
use super::problem::{Inputs, Runs, Target, YIELD_SPEED, yield_speed};
use super::table::{Column, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Candidates in the hypercube.
const CANDIDATES: usize = 4000;
/// Formulas of a figure that are compared.
const COMPARED: usize = 3;
/// Distance, in shares of the range, from which on a run is far away.
const FAR: f64 = 0.2;
/// Spread over the error of the data above which more is not worth more: formulas fail there, how far does not matter.
const MOST_SPREAD: f64 = 10.0;

/// Cases that might be run.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidates {
    /// Their inputs, a row each.
    pub table: Table,
    runs: Runs,
}

impl Candidates {
    /// Draws candidates within the range of `table` and the bounds.
    #[must_use]
    pub fn of(table: &Table, inputs: &Inputs, bounds: &[Bound], seed: u64) -> Self {
        let mut random = Pcg64::seed_from_u64(seed);
        let mut columns = Vec::new();
        for column in table
            .inputs
            .iter()
            .filter(|column| column.name != YIELD_SPEED)
        {
            let [low, high] = column.range();
            let mut order: Vec<usize> = (0..CANDIDATES).collect();
            for i in (1..CANDIDATES).rev() {
                order.swap(i, random.random_range(0..=i));
            }
            let place = |i: usize| (order[i] as f64 + 0.5) / CANDIDATES as f64;
            let value = |i: usize| match (column.constant(), low > 0.0) {
                (true, _) => low,
                (_, true) => low * (high / low).powf(place(i)),
                (_, false) => low + (high - low) * place(i),
            };
            columns.push(Column {
                values: (0..CANDIDATES).map(value).collect(),
                ..column.clone()
            });
        }
        let mut all = Table {
            inputs: columns,
            figures: Vec::new(),
            // they stand in no file
            lines: vec![0; CANDIDATES],
            ..table.clone()
        };
        let mut kept: Vec<usize> = (0..CANDIDATES).collect();
        for group in &inputs.groups {
            let there = group.logs(table);
            let low = there.iter().copied().fold(f64::INFINITY, f64::min);
            let high = there.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let here = group.logs(&all);
            kept.retain(|&i| low <= here[i] && here[i] <= high);
        }
        for bound in bounds {
            let rows = bound.rows(&all);
            kept.retain(|i| rows.binary_search(i).is_ok());
        }
        if let Some(limit) = yield_speed(&all) {
            let speed = all
                .input("velocity_m_s")
                .map_or(Vec::new(), |c| c.values.clone());
            kept.retain(|&i| speed.get(i).is_some_and(|v| *v > limit.values[i]));
            all.inputs.push(limit);
        }
        let table = all.some(&kept);
        Candidates {
            runs: Runs::of(&table, inputs),
            table,
        }
    }

    /// How far the formulas of all figures are apart at each candidate, over the error of the data.
    fn spread(&self, targets: &[(&Target, &[Entry])], tolerance: f64) -> Vec<f64> {
        let mut spread = vec![0.0; self.runs.columns.rows];
        for (target, front) in targets {
            let mut order: Vec<&Entry> = front.iter().collect();
            order.sort_by(|a, b| a.length.total_cmp(&b.length));
            let values: Vec<Vec<f64>> = order
                .iter()
                .take(COMPARED)
                .map(|entry| entry.found.fitted.formula.values(&self.runs.columns))
                .collect();
            // the error of a pure number is the same in every run
            let same = target.errors.windows(2).all(|pair| pair[0] == pair[1]);
            for (i, sum) in spread.iter_mut().enumerate() {
                let each = || values.iter().map(|one| one[i]);
                let (low, high) = (
                    each().fold(f64::INFINITY, f64::min),
                    each().fold(f64::NEG_INFINITY, f64::max),
                );
                let error = match same {
                    true => target.errors.first().copied().unwrap_or(1.0),
                    false => tolerance * high.abs().max(low.abs()),
                };
                let apart = (high - low) / error;
                *sum += if apart.is_finite() {
                    apart.clamp(0.0, MOST_SPREAD)
                } else {
                    MOST_SPREAD
                };
            }
        }
        spread
    }

    /// The `count` candidates that are worth most, by their rows: of formulas `fronts` for `targets` over `runs`.
    #[must_use]
    pub fn chosen(
        &self,
        runs: &Runs,
        targets: &[(&Target, &[Entry])],
        tolerance: f64,
        count: usize,
    ) -> Vec<usize> {
        let n = self.runs.columns.rows;
        let spread = self.spread(targets, tolerance);
        let scale: Vec<f64> = runs
            .columns
            .logs
            .iter()
            .map(|column| {
                let low = column.iter().copied().fold(f64::INFINITY, f64::min);
                let high = column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                (high - low).max(f64::MIN_POSITIVE)
            })
            .collect();
        let between = |a: &[Vec<f64>], i: usize, b: &[Vec<f64>], j: usize| {
            let axes = a.iter().zip(b).zip(&scale);
            axes.map(|((a, b), s)| ((a[i] - b[j]) / s).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let (here, there) = (&self.runs.columns.logs, &runs.columns.logs);
        let mut distance: Vec<f64> = (0..n)
            .map(|i| {
                let all = (0..runs.columns.rows).map(|j| between(here, i, there, j));
                all.fold(FAR, f64::min)
            })
            .collect();
        let mut chosen = Vec::new();
        while chosen.len() < count.min(n) {
            let worth = |i: usize| spread[i] * distance[i];
            let best = (0..n).fold(0, |best, i| if worth(i) > worth(best) { i } else { best });
            if !(worth(best) > 0.0) {
                break;
            }
            chosen.push(best);
            for (i, near) in distance.iter_mut().enumerate() {
                *near = near.min(between(here, i, here, best));
            }
        }
        chosen.iter().map(|&i| self.runs.cases[i][0]).collect()
    }
}
