//! Least squares of a formula's constants.

use super::formula::{Columns, Formula};
use crate::fit::marquardt::{Stop, minimise};
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
    let best = chi2(&formula.values(data.columns), data);
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
    let start: Vec<f64> = which.iter().map(|&i| formula.numbers[i]).collect();
    let at = |numbers: &[f64]| {
        let mut there = formula.clone();
        there.set(numbers);
        there
    };
    let stop = Stop { steps, fall: FALL };
    let cost = |numbers: &[f64]| chi2(&at(numbers).values(data.columns), data);
    let (found, best) = minimise(&start, stop, cost, |numbers| {
        let (matrix, right, _) = normal(&at(numbers), data);
        Some((matrix, right))
    });
    formula.set(&found);
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
