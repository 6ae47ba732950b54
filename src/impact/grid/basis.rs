//! B-spline basis of one direction of the background grid: open graded knots, values and derivatives.
//!
//! A tensor product of two (axisymmetric) or three (3-D) of these is the grid. Degree 1, 2 or 3; the knots are open
//! (the first and last function interpolate the ends), so a plane of symmetry is one row of coefficients.

/// One direction of the grid: B-splines of degree `P` on open knots.
#[derive(Debug, Clone)]
pub struct Direction<const P: usize> {
    breaks: Vec<f64>,
    knots: Vec<f64>,
}

/// Values and derivatives of the functions that do not vanish on a cell (only the first `P + 1` entries are used).
#[derive(Debug, Clone, Copy)]
pub struct Basis {
    /// $N_a(x)$.
    pub value: [f64; 4],
    /// $N_a'(x)$.
    pub slope: [f64; 4],
}

impl<const P: usize> Direction<P> {
    /// Basis on ascending `breaks`.
    #[must_use]
    pub fn new(breaks: Vec<f64>) -> Self {
        let first = breaks[0];
        let last = breaks[breaks.len() - 1];
        let mut knots = vec![first; P];
        knots.extend_from_slice(&breaks);
        knots.extend(std::iter::repeat_n(last, P));
        Direction { breaks, knots }
    }

    /// Cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.breaks.len() - 1
    }

    /// Functions (coefficients).
    #[must_use]
    pub fn functions(&self) -> usize {
        self.cells() + P
    }

    /// Ends of cell `c`.
    #[must_use]
    pub fn cell(&self, c: usize) -> (f64, f64) {
        (self.breaks[c], self.breaks[c + 1])
    }

    /// Greville abscissa of function `k`: coefficients that equal it make the function x.
    #[must_use]
    pub fn greville(&self, k: usize) -> f64 {
        self.knots[k + 1..=k + P].iter().sum::<f64>() / P as f64
    }

    /// Cell that holds `x` (clamped to the ends).
    #[must_use]
    pub fn cell_of(&self, x: f64) -> usize {
        self.breaks
            .partition_point(|b| *b <= x)
            .clamp(1, self.cells())
            - 1
    }

    /// The `P + 1` functions of cell `c` at `x`: numbers `c..=c + P` of the direction (Cox-de Boor recurrence).
    #[must_use]
    pub fn evaluate(&self, c: usize, x: f64) -> Basis {
        let span = c + P;
        let t = &self.knots;
        let mut value = [0.0; 4];
        let mut lower = [0.0; 4];
        value[0] = 1.0;
        for degree in 1..=P {
            lower = value;
            let mut carry = 0.0;
            for a in 0..degree {
                let right = t[span + a + 1];
                let left = t[span + a + 1 - degree];
                let share = lower[a] / (right - left);
                value[a] = carry + (right - x) * share;
                carry = (x - left) * share;
            }
            value[degree] = carry;
        }
        let mut slope = [0.0; 4];
        for (a, slope) in slope.iter_mut().enumerate().take(P + 1) {
            let below = |k: usize| {
                let (left, right) = (t[span + k + 1 - P], t[span + k + 1]);
                P as f64 * lower[k] / (right - left)
            };
            let rise = if a > 0 { below(a - 1) } else { 0.0 };
            let fall = if a < P { below(a) } else { 0.0 };
            *slope = rise - fall;
        }
        Basis { value, slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::graded;

    fn check<const P: usize>() {
        let d = Direction::<P>::new(graded(2.0, 0.01, 0.1, 1.2, 0.15));
        for i in 0..400 {
            let x = 2.0 * f64::from(i) / 399.0;
            let c = d.cell_of(x);
            let b = d.evaluate(c, x);
            let sum: f64 = b.value.iter().sum();
            let slope: f64 = b.slope.iter().sum();
            assert!((sum - 1.0).abs() < 1e-13 && slope.abs() < 1e-9);
            let step = 1e-7 * (d.cell(c).1 - d.cell(c).0);
            let next = d.evaluate(c, x + step);
            for a in 0..=P {
                let difference = (next.value[a] - b.value[a]) / step;
                let scale = 1.0 / (d.cell(c).1 - d.cell(c).0);
                assert!((difference - b.slope[a]).abs() < 1e-5 * scale);
            }
        }
    }

    #[test]
    fn functions_sum_to_one_and_slopes_match_finite_differences() {
        check::<1>();
        check::<2>();
        check::<3>();
    }
}
