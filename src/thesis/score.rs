//! How good an equation is: errors with its printed constants, and with constants fitted to the data, with intervals.

use super::data::{Row, distinct};
use super::equations::Equation;
use crate::fit::marquardt::{Stop, minimise};
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Errors of an equation over rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Rows.
    pub rows: usize,
    /// Mean absolute error.
    pub mae: f64,
    /// Mean squared error.
    pub mse: f64,
    /// 1 less the squares of the errors over those of the values from their mean.
    pub r2: f64,
    /// Median of the relative errors.
    pub median: f64,
    /// Exceeded by one in ten of them.
    pub tenth: f64,
}

impl Score {
    /// Of an equation with these constants.
    #[must_use]
    pub fn of(equation: &Equation, constants: &[f64], rows: &[&Row]) -> Self {
        let pairs: Vec<(f64, f64)> = rows
            .iter()
            .map(|row| ((equation.value)(row), (equation.form)(row, constants)))
            .collect();
        Self::of_pairs(&pairs)
    }

    /// Of values and what is predicted.
    #[must_use]
    pub fn of_pairs(pairs: &[(f64, f64)]) -> Self {
        let n = pairs.len() as f64;
        let mean = pairs.iter().map(|(v, _)| v).sum::<f64>() / n;
        let squares: f64 = pairs.iter().map(|(v, p)| (v - p).powi(2)).sum();
        let spread: f64 = pairs.iter().map(|(v, _)| (v - mean).powi(2)).sum();
        let mut relative: Vec<f64> = pairs.iter().map(|(v, p)| (p / v - 1.0).abs()).collect();
        relative.sort_by(f64::total_cmp);
        Score {
            rows: pairs.len(),
            mae: pairs.iter().map(|(v, p)| (v - p).abs()).sum::<f64>() / n,
            mse: squares / n,
            r2: 1.0 - squares / spread,
            median: quantile(&relative, 0.5),
            tenth: quantile(&relative, 0.9),
        }
    }
}

/// Quantile of sorted values; NaN of none.
#[must_use]
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = share * sorted.len().saturating_sub(1) as f64;
    let low = sorted.get(at.floor() as usize);
    let high = sorted.get(at.ceil() as usize);
    match (low, high) {
        (Some(low), Some(high)) => low + (at - at.floor()) * (high - low),
        _ => f64::NAN,
    }
}

/// Constants fitted to the data.
#[derive(Debug, Clone, PartialEq)]
pub struct Refit {
    /// Constants.
    pub constants: Vec<f64>,
    /// 95 % intervals: whole levels of E/Y are drawn with replacement; none for fewer than four levels.
    pub intervals: Option<Vec<[f64; 2]>>,
    /// Errors on the rows of the fit.
    pub score: Score,
}

/// Draws of the bootstrap.
const DRAWS: usize = 400;
/// Seed of it.
const SEED: u64 = 2025;
/// Fewest levels that are drawn from.
const LEVELS: usize = 4;
/// When a fit stops.
const STOP: Stop = Stop {
    steps: 100,
    fall: 1e-12,
};

/// Fits the constants by least squares.
#[must_use]
pub fn refit(equation: &Equation, rows: &[&Row]) -> Refit {
    let ones = vec![1.0; rows.len()];
    let constants = solve(equation, rows, &ones, equation.constants);
    let levels = distinct(rows.iter().map(|row| row.young_over_yield()).collect());
    let level = |row: &Row| {
        let x = row.young_over_yield();
        levels.partition_point(|l| *l < x * (1.0 - 1e-8))
    };
    let of: Vec<usize> = rows.iter().map(|row| level(row)).collect();
    let mut random = Pcg64::seed_from_u64(SEED);
    let draws: Vec<Vec<f64>> = (0..DRAWS)
        .map(|_| {
            let mut times = vec![0.0; levels.len()];
            for _ in 0..levels.len() {
                times[random.random_range(0..levels.len())] += 1.0;
            }
            of.iter().map(|l| times[*l]).collect()
        })
        .collect();
    let intervals = (levels.len() >= LEVELS).then(|| {
        let again = |weights: &Vec<f64>| solve(equation, rows, weights, &constants);
        let all: Vec<Vec<f64>> = draws.par_iter().map(again).collect();
        (0..constants.len())
            .map(|k| {
                let mut values: Vec<f64> = all.iter().map(|c| c[k]).collect();
                values.sort_by(f64::total_cmp);
                [quantile(&values, 0.025), quantile(&values, 0.975)]
            })
            .collect()
    });
    Refit {
        score: Score::of(equation, &constants, rows),
        constants,
        intervals,
    }
}

/// Constants of least weighted squares.
fn solve(equation: &Equation, rows: &[&Row], weights: &[f64], start: &[f64]) -> Vec<f64> {
    let residuals = |constants: &[f64]| -> Vec<f64> {
        let one = |(row, weight): (&&Row, &f64)| {
            ((equation.form)(row, constants) - (equation.value)(row)) * weight.sqrt()
        };
        rows.iter().zip(weights).map(one).collect()
    };
    let cost = |constants: &[f64]| {
        let sum: f64 = residuals(constants).iter().map(|x| x * x).sum();
        if sum.is_finite() { sum } else { f64::INFINITY }
    };
    let normal = |constants: &[f64]| {
        let here = residuals(constants);
        let mut slopes = DMatrix::zeros(here.len(), constants.len());
        for k in 0..constants.len() {
            let step = 1e-6 * constants[k].abs().max(1e-3);
            let mut moved = constants.to_vec();
            moved[k] += step;
            let there = residuals(&moved);
            for i in 0..here.len() {
                slopes[(i, k)] = (there[i] - here[i]) / step;
            }
        }
        let right = -(slopes.transpose() * DVector::from_vec(here));
        Some((slopes.transpose() * &slopes, right))
    };
    minimise(start, STOP, cost, normal).0
}
