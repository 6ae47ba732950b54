//! Ranking: which columns a figure depends on, by recursive elimination with a forest, by permutation and by rank correlation.

use super::forest::Forest;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A column in a ranking.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    /// Number of the column.
    pub column: usize,
    /// Mean place in the elimination, 1 for the one that stays to the end, over the seeds.
    pub place: f64,
    /// Lowest and highest place over the seeds.
    pub places: [usize; 2],
    /// Rise of the mean squared error when its values are shuffled, over the variance of the figure; mean over the seeds.
    pub permutation: f64,
    /// Lowest and highest of them.
    pub permutations: [f64; 2],
    /// Spearman's rank correlation.
    pub spearman: f64,
    /// 95 % interval of it by Fisher's transformation.
    pub spearman_interval: [f64; 2],
}

/// Ranks columns by `seeds` forests of `trees` trees; the column that stays longest first.
#[must_use]
pub fn ranking(columns: &[Vec<f64>], targets: &[f64], trees: usize, seeds: u64) -> Vec<Ranked> {
    let mut places = vec![Vec::new(); columns.len()];
    let mut rises = vec![Vec::new(); columns.len()];
    for seed in 0..seeds {
        for (place, column) in elimination(columns, targets, trees, seed)
            .into_iter()
            .enumerate()
        {
            places[column].push(place + 1);
        }
        for (column, rise) in permutation(columns, targets, trees, seed)
            .into_iter()
            .enumerate()
        {
            rises[column].push(rise);
        }
    }
    let mut ranked: Vec<Ranked> = (0..columns.len())
        .map(|column| {
            let (place, rise) = (&places[column], &rises[column]);
            let correlation = spearman(&columns[column], targets);
            Ranked {
                column,
                place: place.iter().sum::<usize>() as f64 / seeds as f64,
                places: [
                    place.iter().copied().min().unwrap_or(0),
                    place.iter().copied().max().unwrap_or(0),
                ],
                permutation: rise.iter().sum::<f64>() / seeds as f64,
                permutations: [
                    rise.iter().copied().fold(f64::INFINITY, f64::min),
                    rise.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                ],
                spearman: correlation,
                spearman_interval: fisher(correlation, targets.len()),
            }
        })
        .collect();
    ranked.sort_by(|a, b| a.place.total_cmp(&b.place).then(a.column.cmp(&b.column)));
    ranked
}

/// Columns in the order in which they are kept: a forest is grown, the column of least importance goes, and again.
fn elimination(columns: &[Vec<f64>], targets: &[f64], trees: usize, seed: u64) -> Vec<usize> {
    let mut left: Vec<usize> = (0..columns.len()).collect();
    let mut gone = Vec::new();
    while !left.is_empty() {
        let some: Vec<Vec<f64>> = left.iter().map(|&c| columns[c].clone()).collect();
        let importance = Forest::grow(&some, targets, trees, seed).importance();
        let least = (0..left.len())
            .min_by(|&a, &b| importance[a].total_cmp(&importance[b]))
            .unwrap_or(0);
        gone.push(left.remove(least));
    }
    gone.reverse();
    gone
}

/// Rise of the error by shuffling each column, over the variance.
fn permutation(columns: &[Vec<f64>], targets: &[f64], trees: usize, seed: u64) -> Vec<f64> {
    let forest = Forest::grow(columns, targets, trees, seed);
    let n = targets.len();
    let error = |columns: &[Vec<f64>]| {
        let squares = (0..n).map(|i| {
            let row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
            (forest.predict(&row) - targets[i]).powi(2)
        });
        squares.sum::<f64>() / n as f64
    };
    let mean = targets.iter().sum::<f64>() / n as f64;
    let variance = targets.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / n as f64;
    let base = error(columns);
    let mut random = Pcg64::seed_from_u64(seed);
    (0..columns.len())
        .map(|c| {
            let mut shuffled = columns.to_vec();
            for i in (1..n).rev() {
                let other = random.random_range(0..=i);
                shuffled[c].swap(i, other);
            }
            (error(&shuffled) - base) / variance
        })
        .collect()
}

/// Ranks, the mean of them where values are equal.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut start = 0;
    while start < order.len() {
        let mut end = start;
        while end + 1 < order.len() && values[order[end + 1]] == values[order[start]] {
            end += 1;
        }
        for &i in &order[start..=end] {
            ranks[i] = 0.5 * (start + end) as f64;
        }
        start = end + 1;
    }
    ranks
}

/// Spearman's rank correlation; 0 where one of them never changes.
#[must_use]
pub fn spearman(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let (ma, mb) = (mean(&a), mean(&b));
    let product: f64 = a.iter().zip(&b).map(|(x, y)| (x - ma) * (y - mb)).sum();
    let square = |x: &[f64], m: f64| x.iter().map(|v| (v - m).powi(2)).sum::<f64>();
    let size = (square(&a, ma) * square(&b, mb)).sqrt();
    if size > 0.0 { product / size } else { 0.0 }
}

/// 95 % interval of a correlation of `n` pairs.
fn fisher(correlation: f64, n: usize) -> [f64; 2] {
    let z = correlation.clamp(-1.0 + 1e-15, 1.0 - 1e-15).atanh();
    // Bonett and Wright 2000: the error of Spearman's coefficient
    let error = ((1.0 + 0.5 * correlation * correlation) / (n as f64 - 3.0).max(1.0)).sqrt();
    [(z - 1.96 * error).tanh(), (z + 1.96 * error).tanh()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spearman_sees_order_alone() {
        let x: Vec<f64> = (1..20).map(f64::from).collect();
        let cubes: Vec<f64> = x.iter().map(|v| v.powi(3)).collect();
        let falling: Vec<f64> = x.iter().map(|v| (-v).exp()).collect();
        assert!((spearman(&x, &cubes) - 1.0).abs() < 1e-12);
        assert!((spearman(&x, &falling) + 1.0).abs() < 1e-12);
        assert_eq!(spearman(&x, &[2.0; 19]), 0.0);
    }

    #[test]
    fn columns_stay_in_the_order_of_what_they_decide() {
        let n = 200;
        let column = |k: usize| (0..n).map(|i| ((i * k) % 17) as f64).collect::<Vec<f64>>();
        let columns = vec![column(3), column(5), column(7)];
        let y: Vec<f64> = (0..n)
            .map(|i| columns[1][i] * 10.0 + columns[2][i] * 2.0)
            .collect();
        let ranked = ranking(&columns, &y, 30, 2);
        let order: Vec<usize> = ranked.iter().map(|r| r.column).collect();
        assert_eq!(order, [1, 2, 0]);
        assert!(ranked[0].permutation > ranked[1].permutation);
    }
}
