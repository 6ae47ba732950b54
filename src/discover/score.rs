//! Scores: how well a model predicts runs of levels and materials it has not seen.

use super::forest::Forest;
use super::formula::{Columns, Formula};
use super::problem::{Runs, Target};
use super::process::Process;
use super::solve::{Data, Fitted, fit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Errors over cases.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Score {
    /// Mean absolute error.
    pub mae: f64,
    /// 1 - sum of squares of the errors over that of the figure about its mean.
    pub r2: f64,
    /// Median of the relative error.
    pub median_rel: f64,
    /// 90 % of the relative errors are below it.
    pub p90_rel: f64,
}

impl Score {
    /// Score of predictions of runs, each as often as there are cases of it.
    #[must_use]
    pub fn of(predicted: &[f64], target: &Target, counts: &[usize]) -> Self {
        let cases = || {
            let rows = predicted.iter().zip(&target.values).zip(counts);
            rows.flat_map(|((p, y), n)| std::iter::repeat_n((*p, *y), *n))
        };
        let n = cases().count() as f64;
        let mean = cases().map(|(_, y)| y).sum::<f64>() / n;
        let about = cases().map(|(_, y)| (y - mean).powi(2)).sum::<f64>();
        let mut relative: Vec<f64> = cases().map(|(p, y)| ((p - y) / y).abs()).collect();
        relative.sort_by(f64::total_cmp);
        let at = |share: f64| relative[((relative.len() - 1) as f64 * share).round() as usize];
        Score {
            mae: cases().map(|(p, y)| (p - y).abs()).sum::<f64>() / n,
            r2: 1.0 - cases().map(|(p, y)| (p - y).powi(2)).sum::<f64>() / about,
            median_rel: at(0.5),
            p90_rel: at(0.9),
        }
    }
}

/// Whole parts of the data that are left out in turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    /// Rows that are not seen, of each turn.
    pub out: Vec<Vec<usize>>,
}

impl Split {
    /// Each level in turn.
    #[must_use]
    pub fn levels(runs: &Runs) -> Self {
        let rows = |level: usize| {
            let of = |row: &usize| runs.levels[*row] == level;
            (0..runs.columns.rows).filter(of).collect()
        };
        Split {
            out: (0..runs.level_count).map(rows).collect(),
        }
    }

    /// Whole materials, in `PARTS` parts, by the number of the material of each case. A run that stands for cases of several
    /// materials is left out with each of them.
    #[must_use]
    pub fn materials(runs: &Runs, material: &[usize]) -> Self {
        let rows = |part: usize| -> Vec<usize> {
            let of = |row: &usize| {
                runs.cases[*row]
                    .iter()
                    .any(|&case| material[case] % PARTS == part)
            };
            (0..runs.columns.rows).filter(of).collect()
        };
        let out = (0..PARTS)
            .map(rows)
            .filter(|rows: &Vec<usize>| !rows.is_empty());
        Split { out: out.collect() }
    }

    fn seen(&self, turn: usize, rows: usize) -> Vec<usize> {
        (0..rows)
            .filter(|row| !self.out[turn].contains(row))
            .collect()
    }
}

/// Something that learns from rows and predicts others.
#[derive(Debug, Clone)]
pub enum Model {
    /// Predicts what it says, learns nothing.
    Told(Formula),
    /// Its constants are fitted anew.
    Fitted(Formula),
    /// Random forest over the logarithms of the groups.
    Forest(u64),
    /// Gaussian process over them, of the logarithm of the figure or of itself.
    Process(bool),
}

/// Parts in which materials are left out.
const PARTS: usize = 12;
/// Trees of a baseline forest.
const TREES: usize = 50;
/// Steps of a fit without some rows.
const STEPS: usize = 60;

fn pick(values: &[f64], rows: &[usize]) -> Vec<f64> {
    rows.iter().map(|&row| values[row]).collect()
}

/// Weights of the rows: the root of the number of cases over the error of the data.
#[must_use]
pub fn weights(runs: &Runs, target: &Target) -> Vec<f64> {
    let rows = runs.counts.iter().zip(&target.errors);
    rows.map(|(n, error)| (*n as f64).sqrt() / error).collect()
}

impl Model {
    /// Predictions of `out` from `seen`.
    #[must_use]
    pub fn predict(&self, runs: &Runs, target: &Target, seen: &[usize], out: &[usize]) -> Vec<f64> {
        let (from, to) = (runs.columns.some(seen), runs.columns.some(out));
        let y = pick(&target.values, seen);
        let rows = || {
            (0..to.rows).map(|row| {
                to.logs
                    .iter()
                    .map(|column| column[row])
                    .collect::<Vec<f64>>()
            })
        };
        match self {
            Model::Told(formula) => formula.values(&to),
            Model::Fitted(formula) => {
                let weights = pick(&weights(runs, target), seen);
                let data = Data {
                    columns: &from,
                    targets: &y,
                    weights: &weights,
                };
                let fitted = fit(formula, &data, STEPS);
                fitted.map_or(vec![f64::NAN; out.len()], |f| f.formula.values(&to))
            }
            Model::Forest(seed) => {
                let forest = Forest::grow(&from.logs, &y, TREES, *seed);
                rows().map(|row| forest.predict(&row)).collect()
            }
            Model::Process(logarithm) => {
                let y = match logarithm {
                    true => y.iter().map(|y| y.ln()).collect(),
                    false => y,
                };
                let process = Process::fit(&from.logs, &y);
                let value = |row: Vec<f64>| {
                    let p = process.as_ref().map_or(f64::NAN, |p| p.predict(&row));
                    if *logarithm { p.exp() } else { p }
                };
                rows().map(value).collect()
            }
        }
    }

    /// Score of the predictions of what is left out, every turn of a split together; a run that is left out more than once counts
    /// with the mean of its predictions.
    #[must_use]
    pub fn left_out(&self, runs: &Runs, target: &Target, split: &Split) -> Score {
        Score::of(&self.predictions(runs, target, split), target, &runs.counts)
    }

    /// Predictions of every run from those that are left in.
    #[must_use]
    pub fn predictions(&self, runs: &Runs, target: &Target, split: &Split) -> Vec<f64> {
        let turns: Vec<Vec<f64>> = (0..split.out.len())
            .into_par_iter()
            .map(|turn| {
                let seen = split.seen(turn, runs.columns.rows);
                match seen.is_empty() {
                    true => vec![f64::NAN; split.out[turn].len()],
                    false => self.predict(runs, target, &seen, &split.out[turn]),
                }
            })
            .collect();
        let mut sums = vec![(0.0, 0usize); runs.columns.rows];
        for (rows, predicted) in split.out.iter().zip(turns) {
            for (&row, p) in rows.iter().zip(predicted) {
                sums[row].0 += p;
                sums[row].1 += 1;
            }
        }
        sums.into_iter().map(|(sum, n)| sum / n as f64).collect()
    }
}

/// Samples of a bootstrap.
const SAMPLES: usize = 200;

/// 95 % intervals of the constants: fits to runs drawn with replacement.
#[must_use]
pub fn intervals(formula: &Formula, runs: &Runs, target: &Target, seed: u64) -> Vec<[f64; 2]> {
    let weights = weights(runs, target);
    let n = runs.columns.rows;
    let samples: Vec<Option<Fitted>> = (0..SAMPLES)
        .into_par_iter()
        .map(|sample| {
            let mut random = Pcg64::seed_from_u64(seed.wrapping_mul(1_000_003) + sample as u64);
            let rows: Vec<usize> = (0..n).map(|_| random.random_range(0..n)).collect();
            let columns: Columns = runs.columns.some(&rows);
            let (targets, weights) = (pick(&target.values, &rows), pick(&weights, &rows));
            let data = Data {
                columns: &columns,
                targets: &targets,
                weights: &weights,
            };
            fit(formula, &data, 25)
        })
        .collect();
    formula
        .constants()
        .into_iter()
        .map(|i| {
            let mut values: Vec<f64> = samples
                .iter()
                .flatten()
                .map(|f| f.formula.numbers[i])
                .collect();
            values.sort_by(f64::total_cmp);
            let at = |share: f64| {
                let place = (values.len().saturating_sub(1)) as f64 * share;
                values
                    .get(place.round() as usize)
                    .copied()
                    .unwrap_or(f64::NAN)
            };
            [at(0.025), at(0.975)]
        })
        .collect()
}
