//! Gaussian process with one length a column (Rasmussen and Williams 2006, chapters 2 and 5), as a baseline: what can be
//! predicted without an equation.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Fitted process.
#[derive(Debug, Clone)]
pub struct Process {
    rows: Vec<Vec<f64>>,
    shift: Vec<f64>,
    scale: Vec<f64>,
    mean: f64,
    spread: f64,
    lengths: Vec<f64>,
    weights: DVector<f64>,
}

/// Rounds of the search for lengths and noise, and most rows it looks at.
const ROUNDS: usize = 4;
const LOOKED_AT: usize = 128;

/// Mean and standard deviation; 1 for what never changes.
fn moments(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
    (mean, if variance > 0.0 { variance.sqrt() } else { 1.0 })
}

fn kernel(a: &[f64], b: &[f64], lengths: &[f64]) -> f64 {
    let terms = a
        .iter()
        .zip(b)
        .zip(lengths)
        .map(|((x, y), l)| ((x - y) / l).powi(2));
    (-0.5 * terms.sum::<f64>()).exp()
}

impl Process {
    /// Fits to columns of equal length; lengths and noise by the largest marginal likelihood on a shrinking pattern. `None`
    /// where no covariance can be factored.
    #[must_use]
    pub fn fit(columns: &[Vec<f64>], targets: &[f64]) -> Option<Self> {
        let (shift, scale): (Vec<f64>, Vec<f64>) = columns.iter().map(|c| moments(c)).unzip();
        let (mean, spread) = moments(targets);
        let rows: Vec<Vec<f64>> = (0..targets.len())
            .map(|i| {
                let cell = |c: usize| (columns[c][i] - shift[c]) / scale[c];
                (0..columns.len()).map(cell).collect()
            })
            .collect();
        let y = DVector::from_iterator(targets.len(), targets.iter().map(|t| (t - mean) / spread));
        // logarithms of lengths, noise (of the variance), and amplitude
        let mut best = vec![0.0; columns.len()];
        best.extend([-4.0 * std::f64::consts::LN_10, 2.0]);
        let every = rows.len().div_ceil(LOOKED_AT);
        let some: Vec<Vec<f64>> = rows.iter().step_by(every).cloned().collect();
        let few = DVector::from_iterator(some.len(), y.iter().copied().step_by(every));
        let mut top = likelihood(&some, &few, &best)?.0;
        let mut step = 1.2;
        for _ in 0..ROUNDS {
            for i in 0..best.len() {
                for side in [-step, step] {
                    let mut trial = best.clone();
                    trial[i] += side;
                    if let Some((value, _)) = likelihood(&some, &few, &trial)
                        && value > top
                    {
                        (best, top) = (trial, value);
                        break;
                    }
                }
            }
            step *= 0.6;
        }
        let (_, factor) = likelihood(&rows, &y, &best)?;
        let amplitude = best[columns.len() + 1].exp();
        Some(Process {
            lengths: best[..columns.len()].iter().map(|l| l.exp()).collect(),
            weights: factor.solve(&y) * amplitude,
            rows,
            shift,
            scale,
            mean,
            spread,
        })
    }

    /// Mean of the prediction of one row.
    #[must_use]
    pub fn predict(&self, row: &[f64]) -> f64 {
        let scaled: Vec<f64> = row
            .iter()
            .zip(self.shift.iter().zip(&self.scale))
            .map(|(x, (shift, scale))| (x - shift) / scale)
            .collect();
        let terms = self.rows.iter().zip(self.weights.iter());
        let sum: f64 = terms
            .map(|(other, w)| w * kernel(&scaled, other, &self.lengths))
            .sum();
        self.mean + self.spread * sum
    }
}

/// Logarithm of the marginal likelihood, and the factored covariance.
fn likelihood(
    rows: &[Vec<f64>],
    y: &DVector<f64>,
    logs: &[f64],
) -> Option<(f64, Cholesky<f64, Dyn>)> {
    let m = logs.len() - 2;
    let lengths: Vec<f64> = logs[..m].iter().map(|l| l.exp()).collect();
    let (noise, amplitude) = (logs[m].exp().max(1e-10), logs[m + 1].exp());
    let covariance = DMatrix::from_fn(rows.len(), rows.len(), |i, j| {
        let own = if i == j { noise } else { 0.0 };
        amplitude * kernel(&rows[i], &rows[j], &lengths) + own
    });
    let factor = Cholesky::new(covariance)?;
    let fit = y.dot(&factor.solve(y));
    let size: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
    let value = -0.5 * fit - size;
    value.is_finite().then_some((value, factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_process_predicts_a_smooth_function_between_its_rows() {
        let x: Vec<f64> = (0..40).map(|i| f64::from(i % 8)).collect();
        let z: Vec<f64> = (0..40).map(|i| f64::from(i / 8)).collect();
        let f = |x: f64, z: f64| (0.4 * x).sin() + 0.1 * z * z;
        let y: Vec<f64> = x.iter().zip(&z).map(|(x, z)| f(*x, *z)).collect();
        let process = Process::fit(&[x, z], &y).unwrap();
        let error = (process.predict(&[3.5, 2.5]) - f(3.5, 2.5)).abs();
        assert!(error < 0.01, "{error}");
    }
}
