//! Random forest (Breiman 2001): regression trees on bootstrap samples; what each column contributes, by the variance its
//! splits take away.
//!
//! smartcore and linfa were looked at: either brings a tree of its own, and neither says which bits two runs share on another
//! number of threads. Here every tree has a generator of its own number.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Where a tree goes on.
#[derive(Debug, Clone, Copy)]
enum Node {
    /// Column, threshold, and the nodes below and above it.
    Split(usize, f64, usize, usize),
    /// Mean of the rows that end here.
    End(f64),
}

/// One tree, its nodes in a row; the first is the root.
#[derive(Debug, Clone)]
struct Tree {
    nodes: Vec<Node>,
    importance: Vec<f64>,
}

/// A forest.
#[derive(Debug, Clone)]
pub struct Forest {
    trees: Vec<Tree>,
}

/// Fewest rows that are split.
const FEWEST: usize = 2;

impl Forest {
    /// Grows `trees` trees on columns of equal length; all columns are tried at each split, trees are grown to the end.
    #[must_use]
    pub fn grow(columns: &[Vec<f64>], targets: &[f64], trees: usize, seed: u64) -> Self {
        let n = targets.len();
        let one = |number: usize| {
            let mut random =
                Pcg64::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number as u64);
            let rows: Vec<usize> = (0..n).map(|_| random.random_range(0..n)).collect();
            // columns are tried from a drawn one on, so that of equal splits no column has the better place
            let first = random.random_range(0..columns.len().max(1));
            Tree::grow(columns, targets, rows, first)
        };
        Forest {
            trees: (0..trees).into_par_iter().map(one).collect(),
        }
    }

    /// Prediction of one row.
    #[must_use]
    pub fn predict(&self, row: &[f64]) -> f64 {
        let sum: f64 = self.trees.iter().map(|tree| tree.predict(row)).sum();
        sum / self.trees.len() as f64
    }

    /// Share of the variance that the splits of each column take away; the shares add up to 1.
    #[must_use]
    pub fn importance(&self) -> Vec<f64> {
        let columns = self.trees.first().map_or(0, |tree| tree.importance.len());
        let mut sum = vec![0.0; columns];
        for tree in &self.trees {
            let all: f64 = tree.importance.iter().sum();
            let both = sum.iter_mut().zip(&tree.importance);
            both.for_each(|(s, i)| *s += i / all.max(f64::MIN_POSITIVE));
        }
        let all: f64 = sum.iter().sum();
        sum.iter().map(|s| s / all.max(f64::MIN_POSITIVE)).collect()
    }
}

impl Tree {
    fn grow(columns: &[Vec<f64>], targets: &[f64], rows: Vec<usize>, first: usize) -> Self {
        let mut tree = Tree {
            nodes: vec![Node::End(0.0)],
            importance: vec![0.0; columns.len()],
        };
        let mut todo = vec![(0, rows)];
        while let Some((at, rows)) = todo.pop() {
            let n = rows.len() as f64;
            let mean = rows.iter().map(|&i| targets[i]).sum::<f64>() / n;
            let Some((column, threshold, gain)) = best_split(columns, targets, &rows, first) else {
                tree.nodes[at] = Node::End(mean);
                continue;
            };
            tree.importance[column] += gain;
            let (below, above): (Vec<usize>, Vec<usize>) = rows
                .into_iter()
                .partition(|&i| columns[column][i] <= threshold);
            let next = tree.nodes.len();
            tree.nodes[at] = Node::Split(column, threshold, next, next + 1);
            tree.nodes.extend([Node::End(mean); 2]);
            todo.push((next, below));
            todo.push((next + 1, above));
        }
        tree
    }

    fn predict(&self, row: &[f64]) -> f64 {
        let mut at = 0;
        loop {
            match self.nodes[at] {
                Node::Split(column, threshold, below, above) => {
                    at = if row[column] <= threshold {
                        below
                    } else {
                        above
                    };
                }
                Node::End(value) => return value,
            }
        }
    }
}

/// Column, threshold and fall of the sum of squares of the best split.
fn best_split(
    columns: &[Vec<f64>],
    targets: &[f64],
    rows: &[usize],
    first: usize,
) -> Option<(usize, f64, f64)> {
    if rows.len() < FEWEST {
        return None;
    }
    let n = rows.len() as f64;
    let sum: f64 = rows.iter().map(|&i| targets[i]).sum();
    let squares: f64 = rows.iter().map(|&i| targets[i] * targets[i]).sum();
    let spread = squares - sum * sum / n;
    if !(spread > 1e-14 * squares) {
        return None;
    }
    let mut best: Option<(usize, f64, f64)> = None;
    for c in 0..columns.len() {
        let column = (c + first) % columns.len();
        let mut sorted: Vec<(f64, f64)> = rows
            .iter()
            .map(|&i| (columns[column][i], targets[i]))
            .collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut left = 0.0;
        for (k, pair) in sorted.windows(2).enumerate() {
            left += pair[0].1;
            if pair[0].0 >= pair[1].0 {
                continue;
            }
            let below = (k + 1) as f64;
            let right = sum - left;
            let gain = left * left / below + right * right / (n - below) - sum * sum / n;
            if best.is_none_or(|b| gain > b.2 * (1.0 + 1e-12)) {
                // between neighbouring numbers there is no middle: the lower one keeps them apart
                let middle = 0.5 * (pair[0].0 + pair[1].0);
                let threshold = if middle < pair[1].0 {
                    middle
                } else {
                    pair[0].0
                };
                best = Some((column, threshold, gain));
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step in the first column, nothing in the second.
    fn step() -> (Vec<Vec<f64>>, Vec<f64>) {
        let a: Vec<f64> = (0..60).map(|i| f64::from(i % 10)).collect();
        let b: Vec<f64> = (0..60).map(|i| f64::from((i * 7) % 13)).collect();
        let y = a.iter().map(|x| if *x < 4.5 { 1.0 } else { 3.0 }).collect();
        (vec![a, b], y)
    }

    #[test]
    fn a_forest_finds_a_step_and_the_column_it_is_in() {
        let (columns, targets) = step();
        let forest = Forest::grow(&columns, &targets, 50, 7);
        assert!((forest.predict(&[2.0, 5.0]) - 1.0).abs() < 1e-12);
        assert!((forest.predict(&[8.0, 5.0]) - 3.0).abs() < 1e-12);
        assert!(forest.importance()[0] > 0.999);
    }

    #[test]
    fn numbers_that_differ_in_their_last_bit_are_kept_apart() {
        let step = f64::EPSILON;
        let column: Vec<f64> = (0..20).map(|i| 1.0 + f64::from(i % 2) * step).collect();
        let targets: Vec<f64> = (0..20).map(|i| f64::from(i % 2)).collect();
        let forest = Forest::grow(&[column], &targets, 10, 1);
        assert!(forest.predict(&[1.0]) < 0.5 && forest.predict(&[1.0 + step]) > 0.5);
    }

    #[test]
    fn a_seed_is_the_same_forest_on_any_number_of_threads() {
        let (columns, mut targets) = step();
        targets
            .iter_mut()
            .enumerate()
            .for_each(|(i, y)| *y += (i as f64).sin());
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| Forest::grow(&columns, &targets, 20, 3).predict(&[3.3, 4.4]))
        };
        assert_eq!(on(1).to_bits(), on(3).to_bits());
        let other = Forest::grow(&columns, &targets, 20, 4).predict(&[3.3, 4.4]);
        assert_ne!(on(1).to_bits(), other.to_bits());
    }
}
