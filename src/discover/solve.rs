//! Least squares of a formula's constants by Levenberg and Marquardt.
//!
//! argmin has the linear methods, Gauss-Newton and Nelder-Mead, but no damped Gauss-Newton; this is Marquardt's (1963) with his
//! scaling by the diagonal.

use super::formula::{Columns, Formula};
use nalgebra::{DMatrix, DVector};

/// What a formula is fitted to.
#[derive(Debug, Clone, Copy)]
pub struct Data<'a> {
    /// Groups.
    pub columns: &'a Columns,
    /// Targets.
    pub targets: &'a [f64],
    /// One over their standard errors, times the root of the number of cases a row stands for.
    pub weights: &'a [f64],
}

/// A fitted formula.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// With its constants.
    pub formula: Formula,
    /// Sum of squares over the squared errors of the data.
    pub chi2: f64,
}

/// Relative fall of the sum of squares below which a step counts as the last.
const FALL: f64 = 1e-7;
/// Damping at the start, and past which no step helps.
const DAMPING: [f64; 2] = [1e-2, 1e9];

/// Sum of squares; infinite where a value is none.
#[must_use]
pub fn chi2(values: &[f64], data: &Data<'_>) -> f64 {
    let rows = values.iter().zip(data.targets).zip(data.weights);
    let sum: f64 = rows.map(|((f, y), w)| ((f - y) * w).powi(2)).sum();
    match sum.is_finite() {
        true => sum,
        false => f64::INFINITY,
    }
}

/// Normal equations at a formula: matrix, right side and sum of squares.
fn normal(formula: &Formula, data: &Data<'_>) -> (DMatrix<f64>, DVector<f64>, f64) {
    let (values, slopes) = formula.slopes(data.columns);
    let n = slopes.len();
    let scaled: Vec<Vec<f64>> = slopes
        .into_iter()
        .map(|column| {
            column
                .iter()
                .zip(data.weights)
                .map(|(d, w)| d * w)
                .collect()
        })
        .collect();
    let residual: Vec<f64> = values
        .iter()
        .zip(data.targets)
        .zip(data.weights)
        .map(|((f, y), w)| (y - f) * w)
        .collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut matrix = DMatrix::zeros(n, n);
    for i in 0..n {
        for j in 0..=i {
            let product = dot(&scaled[i], &scaled[j]);
            matrix[(i, j)] = product;
            matrix[(j, i)] = product;
        }
    }
    let right = DVector::from_iterator(n, scaled.iter().map(|column| dot(column, &residual)));
    (matrix, right, dot(&residual, &residual))
}

/// Fits the constants from where they stand, by at most `steps` steps; `None` where the formula has no value there.
#[must_use]
pub fn fit(formula: &Formula, data: &Data<'_>, steps: usize) -> Option<Fitted> {
    let mut formula = formula.clone();
    formula.settle();
    let mut best = chi2(&formula.values(data.columns), data);
    if !best.is_finite() {
        return None;
    }
    let which = formula.constants();
    if which.is_empty() {
        return Some(Fitted {
            formula,
            chi2: best,
        });
    }
    let mut damping = DAMPING[0];
    for _ in 0..steps {
        let (matrix, right, _) = normal(&formula, data);
        if !matrix.iter().chain(right.iter()).all(|x| x.is_finite()) {
            break;
        }
        let before = best;
        while damping < DAMPING[1] {
            let mut damped = matrix.clone();
            for i in 0..which.len() {
                damped[(i, i)] += damping * matrix[(i, i)].max(1e-12);
            }
            let step = damped.cholesky().map(|factor| factor.solve(&right));
            if let Some(step) = step {
                let mut trial = formula.clone();
                let moved: Vec<f64> = which
                    .iter()
                    .zip(step.iter())
                    .map(|(&i, s)| formula.numbers[i] + s)
                    .collect();
                trial.set(&moved);
                let cost = chi2(&trial.values(data.columns), data);
                if cost < best {
                    (formula, best) = (trial, cost);
                    damping = (damping * 0.2).max(1e-12);
                    break;
                }
            }
            damping *= 5.0;
        }
        if !(before - best > FALL * before) {
            break;
        }
    }
    Some(Fitted {
        formula,
        chi2: best,
    })
}

/// Standard errors of the constants from the curvature, scaled by the misfit; infinite where they are not determined.
#[must_use]
pub fn standard_errors(fitted: &Fitted, data: &Data<'_>) -> Vec<f64> {
    let (matrix, _, sum) = normal(&fitted.formula, data);
    let n = matrix.nrows();
    let freedom = data.targets.len().saturating_sub(n).max(1) as f64;
    let scale = sum / freedom;
    match matrix.cholesky() {
        Some(factor) => {
            let inverse = factor.inverse();
            (0..n).map(|i| (inverse[(i, i)] * scale).sqrt()).collect()
        }
        None => vec![f64::INFINITY; n],
    }
}
