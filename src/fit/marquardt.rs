//! Least squares by Levenberg and Marquardt: the damping and the steps, whatever the residuals are.
//!
//! argmin has the linear methods, Gauss-Newton and Nelder-Mead, but no damped Gauss-Newton; this is Marquardt's (1963) with his
//! scaling by the diagonal.

use nalgebra::{DMatrix, DVector};

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Most steps.
    pub steps: usize,
    /// Relative fall of the cost below which a step is the last.
    pub fall: f64,
}

/// Damping at the start, and past which no step helps.
const DAMPING: [f64; 2] = [1e-2, 1e9];
/// Least diagonal element that damping scales with.
const LEAST_CURVATURE: f64 = 1e-12;

/// Numbers of least cost from `start` on, and that cost.
///
/// `cost` is infinite where numbers are not admissible; `normal` gives matrix and right side $J^T J$, $-J^T r$ of the normal
/// equations, or `None` to end the search.
pub fn minimise(
    start: &[f64],
    stop: Stop,
    cost: impl Fn(&[f64]) -> f64,
    normal: impl Fn(&[f64]) -> Option<(DMatrix<f64>, DVector<f64>)>,
) -> (Vec<f64>, f64) {
    let mut numbers = start.to_vec();
    let mut best = cost(&numbers);
    let mut damping = DAMPING[0];
    for _ in 0..stop.steps {
        let Some((matrix, right)) = normal(&numbers) else {
            break;
        };
        if !matrix.iter().chain(right.iter()).all(|x| x.is_finite()) {
            break;
        }
        let before = best;
        while damping < DAMPING[1] {
            let mut damped = matrix.clone();
            for i in 0..numbers.len() {
                damped[(i, i)] += damping * matrix[(i, i)].max(LEAST_CURVATURE);
            }
            let step = damped.cholesky().map(|factor| factor.solve(&right));
            if let Some(step) = step {
                let trial: Vec<f64> = numbers
                    .iter()
                    .zip(step.iter())
                    .map(|(a, b)| a + b)
                    .collect();
                let there = cost(&trial);
                if there < best {
                    (numbers, best) = (trial, there);
                    damping = (damping * 0.2).max(1e-12);
                    break;
                }
            }
            damping *= 5.0;
        }
        if !(before - best > stop.fall * before) {
            break;
        }
    }
    (numbers, best)
}
