//! Dimensions: the matrix of the columns' units, its integer null space, and a basis of small exponents.
//!
//! Buckingham's theorem (1914): what has no unit depends on products of powers without unit alone, and these are the integer
//! vectors that the matrix of exponents takes to zero.

use crate::table::Dimension;

/// Integer exponents of the columns, in their order.
pub type Exponents = Vec<i32>;

/// A lattice basis of all integer vectors that the dimensions take to zero: unimodular column operations bring the matrix to
/// echelon form, and what they made of the empty columns is the kernel.
#[must_use]
pub fn null_space(dimensions: &[Dimension]) -> Vec<Exponents> {
    let n = dimensions.len();
    // each vector: its image under the matrix, and how it is made of the columns
    let mut vectors: Vec<([i64; 4], Vec<i64>)> = (0..n)
        .map(|i| {
            let mut made = vec![0; n];
            made[i] = 1;
            (dimensions[i].0.map(i64::from), made)
        })
        .collect();
    let mut done = 0;
    for row in 0..4 {
        loop {
            // Euclid on the entries of this row, the smallest first
            let rest = done..vectors.len();
            let Some(pivot) = rest
                .filter(|&i| vectors[i].0[row] != 0)
                .min_by_key(|&i| vectors[i].0[row].abs())
            else {
                break;
            };
            vectors.swap(done, pivot);
            let (image, made) = vectors[done].clone();
            let mut left = false;
            for other in &mut vectors[done + 1..] {
                let times = other.0[row].div_euclid(image[row]);
                other
                    .0
                    .iter_mut()
                    .zip(&image)
                    .for_each(|(a, b)| *a -= times * b);
                other
                    .1
                    .iter_mut()
                    .zip(&made)
                    .for_each(|(a, b)| *a -= times * b);
                left |= other.0[row] != 0;
            }
            if !left {
                done += 1;
                break;
            }
        }
    }
    let kernel = vectors[done..].iter();
    kernel
        .map(|(_, made)| made.iter().map(|&x| x as i32).collect())
        .collect()
}

/// Most by which a vector of the kernel is taken when small ones are sought.
const REACH: i32 = 3;

/// Integer combinations of vectors with small coefficients, without the empty one, each once, shortest first.
fn combinations(basis: &[Exponents]) -> Vec<Exponents> {
    let Some(length) = basis.first().map(Vec::len) else {
        return Vec::new();
    };
    let mut all = vec![vec![0; length]];
    for vector in basis {
        all = all
            .iter()
            .flat_map(|sum| {
                (-REACH..=REACH)
                    .map(|times| sum.iter().zip(vector).map(|(a, b)| a + times * b).collect())
            })
            .collect();
    }
    all.retain(|vector: &Exponents| vector.iter().any(|&x| x != 0));
    all.sort_by_key(|vector| {
        (
            length_of(vector),
            vector.iter().map(|x| x.abs()).max(),
            vector.clone(),
        )
    });
    all.dedup();
    all
}

/// Sum of the sizes of the exponents.
fn length_of(vector: &[i32]) -> i32 {
    vector.iter().map(|x| x.abs()).sum()
}

/// Most vectors of a kernel that are combined.
pub const MOST: usize = 6;
/// Shortest candidates among which a basis is sought.
const SHORTEST: usize = 500;

/// Basis of smallest exponents, empty where the kernel has more than [`MOST`] vectors; of two groups as short as each other the one with the larger `merit` is taken.
///
/// Every group is turned so that the merit of its direction is its own; a group is only taken if the ones taken so far can be
/// completed to a basis of the whole lattice.
#[must_use]
pub fn groups(dimensions: &[Dimension], merit: impl Fn(&[i32]) -> f64) -> Vec<Exponents> {
    let kernel = null_space(dimensions);
    if kernel.len() > MOST {
        return Vec::new();
    }
    let mut candidates: Vec<(i32, f64, Exponents)> = combinations(&kernel)
        .into_iter()
        // one of each pair of a group and its inverse: the first column that counts stands above
        .filter(|vector| vector.iter().find(|&&x| x != 0).is_some_and(|&x| x > 0))
        .take(SHORTEST)
        .map(|vector| (length_of(&vector), merit(&vector), vector))
        .collect();
    candidates.sort_by(|a, b| {
        a.0.cmp(&b.0)
            .then(b.1.total_cmp(&a.1))
            .then_with(|| b.2.cmp(&a.2))
    });
    let mut taken: Vec<Exponents> = Vec::new();
    for (_, _, vector) in candidates {
        if taken.len() == kernel.len() {
            break;
        }
        taken.push(vector);
        if !primitive(&taken) {
            taken.pop();
        }
    }
    taken
}

/// Whether integer vectors can be completed to a basis of all integer vectors of the space they span: unimodular operations
/// make a triangle with ones of them.
fn primitive(vectors: &[Exponents]) -> bool {
    let mut rows: Vec<Vec<i64>> = vectors
        .iter()
        .map(|vector| vector.iter().map(|&x| i64::from(x)).collect())
        .collect();
    // columns are combined until each row has one entry beyond those before it
    let width = rows.first().map_or(0, Vec::len);
    for r in 0..rows.len() {
        loop {
            let Some(pivot) = (r..width)
                .filter(|&c| rows[r][c] != 0)
                .min_by_key(|&c| rows[r][c].abs())
            else {
                return false;
            };
            rows.iter_mut().for_each(|row| row.swap(r, pivot));
            let mut left = false;
            for c in r + 1..width {
                let times = rows[r][c].div_euclid(rows[r][r]);
                for row in &mut rows {
                    row[c] -= times * row[r];
                }
                left |= rows[r][c] != 0;
            }
            if !left {
                break;
            }
        }
        if rows[r][r].abs() != 1 {
            return false;
        }
    }
    true
}

/// Shortest product of powers of the columns with the dimension wanted; of equally short ones that with the larger `merit`.
/// `None` where small exponents make none.
#[must_use]
pub fn product_of(
    dimensions: &[Dimension],
    wanted: Dimension,
    merit: impl Fn(&[i32]) -> f64,
) -> Option<Exponents> {
    if wanted.is_none() {
        return Some(vec![0; dimensions.len()]);
    }
    // the kernel of the columns with the wanted one behind them, of all vectors that hold it once
    let mut all = dimensions.to_vec();
    all.push(wanted);
    let kernel = null_space(&all);
    if kernel.len() > MOST {
        return None;
    }
    let mut found: Vec<Exponents> = combinations(&kernel)
        .into_iter()
        .filter(|vector| vector[dimensions.len()] == -1)
        .map(|mut vector| {
            vector.pop();
            vector
        })
        .collect();
    found.sort_by(|a, b| {
        length_of(a)
            .cmp(&length_of(b))
            .then(merit(b).total_cmp(&merit(a)))
            .then_with(|| b.cmp(a))
    });
    found.into_iter().next()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<Dimension> {
        names
            .iter()
            .map(|name| Dimension::of_name(name).unwrap())
            .collect()
    }

    #[test]
    fn the_null_space_is_taken_to_zero_and_has_the_dimension_that_rank_leaves() {
        let names = [
            "velocity_m_s",
            "density_kg_m3",
            "young_modulus_Pa",
            "yield_strength_Pa",
            "radius_m",
            "poisson_ratio",
        ];
        let dimensions = of(&names);
        let kernel = null_space(&dimensions);
        assert_eq!(kernel.len(), 3); // six columns of rank three
        for vector in &kernel {
            for unit in 0..4 {
                let sum: i32 = vector
                    .iter()
                    .zip(&dimensions)
                    .map(|(x, d)| x * d.0[unit])
                    .sum();
                assert_eq!(sum, 0);
            }
        }
    }

    #[test]
    fn the_groups_of_an_impact_follow_from_units_alone() {
        let dimensions = of(&[
            "density_kg_m3",
            "young_modulus_Pa",
            "yield_strength_Pa",
            "radius_m",
            "velocity_m_s",
        ]);
        // a merit that prefers strength to modulus decides between rho V^2/Y and rho V^2/E, which are as short
        let found = groups(&dimensions, |v| f64::from(v[2].abs()));
        assert_eq!(found, [vec![0, 1, -1, 0, 0], vec![1, 0, -1, 0, 2]]);
        let force = product_of(&dimensions, Dimension([1, 1, -2, 0]), |v| {
            f64::from(v[2].abs())
        });
        assert_eq!(force, Some(vec![0, 0, 1, 2, 0]));
    }

    #[test]
    fn squares_of_groups_are_no_basis() {
        assert!(primitive(&[vec![1, -1, 0], vec![0, 1, -1]]));
        assert!(!primitive(&[vec![2, -2, 0]]));
        assert!(!primitive(&[vec![1, -1, 0], vec![1, 1, -2]]));
    }
}
