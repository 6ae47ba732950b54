//! Banded symmetric matrix, lower half stored by rows, with an in-place Cholesky solve.

/// Symmetric positive definite matrix of which only entries with `row - column <= band` differ from zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Banded {
    size: usize,
    band: usize,
    entries: Vec<f64>,
}

impl Banded {
    /// Zero matrix.
    #[must_use]
    pub fn new(size: usize, band: usize) -> Self {
        let mut m = Banded::default();
        m.reset(size, band);
        m
    }

    /// Make it a zero matrix of another size, reusing its memory.
    pub fn reset(&mut self, size: usize, band: usize) {
        self.size = size;
        self.band = band;
        self.entries.clear();
        self.entries.resize(size * (band + 1), 0.0);
    }

    /// Largest `row - column` that is stored.
    #[must_use]
    pub fn band(&self) -> usize {
        self.band
    }

    fn index(&self, row: usize, column: usize) -> usize {
        row * (self.band + 1) + (row - column)
    }

    /// Entry, either half; 0 outside the band.
    #[inline]
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        let (low, high) = (row.min(column), row.max(column));
        if high - low > self.band {
            return 0.0;
        }
        self.entries[self.index(high, low)]
    }

    /// Entry of the lower half (`row >= column`, inside the band).
    #[inline]
    pub fn at_mut(&mut self, row: usize, column: usize) -> &mut f64 {
        let k = self.index(row, column);
        &mut self.entries[k]
    }

    /// Solve in place by Cholesky factorisation; the matrix is overwritten by its factor.
    pub fn solve(&mut self, right: &mut [f64]) {
        for row in 0..self.size {
            let first = row.saturating_sub(self.band);
            for column in first..=row {
                let mut sum = self.entries[self.index(row, column)];
                for k in first.max(column.saturating_sub(self.band))..column {
                    sum -= self.entries[self.index(row, k)] * self.entries[self.index(column, k)];
                }
                *self.at_mut(row, column) = if column == row {
                    sum.max(f64::MIN_POSITIVE).sqrt()
                } else {
                    sum / self.entries[self.index(column, column)]
                };
            }
        }
        for row in 0..self.size {
            for k in row.saturating_sub(self.band)..row {
                right[row] -= self.entries[self.index(row, k)] * right[k];
            }
            right[row] /= self.entries[self.index(row, row)];
        }
        for row in (0..self.size).rev() {
            right[row] /= self.entries[self.index(row, row)];
            for k in row.saturating_sub(self.band)..row {
                right[k] -= self.entries[self.index(row, k)] * right[row];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solve_inverts_multiplication() {
        let (size, band) = (12, 3);
        let mut m = Banded::new(size, band);
        for row in 0..size {
            for column in row.saturating_sub(band)..=row {
                *m.at_mut(row, column) = if row == column {
                    4.0 + row as f64
                } else {
                    1.0 / (1 + row + column) as f64
                };
            }
        }
        let x: Vec<f64> = (0..size).map(|k| (k as f64 - 4.0) * 0.3).collect();
        let mut right: Vec<f64> = (0..size)
            .map(|row| (0..size).map(|column| m.at(row, column) * x[column]).sum())
            .collect();
        m.solve(&mut right);
        for (a, b) in right.iter().zip(&x) {
            assert!((a - b).abs() < 1e-13);
        }
    }
}
