//! Dimensions: the matrix of the columns' units, its integer null space, and a basis of small exponents.
//!
//! Buckingham's theorem (1914): what has no unit depends on products of powers without unit alone, and these are the integer
//! vectors that the matrix of exponents takes to zero.

use crate::unit::DIMENSIONS;
use std::sync::LazyLock;

/// Exponents of kilogram, metre, second and kelvin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Dimension(pub [i32; 4]);

/// Units by the end of a column's name; longer ones before those they end in.
const UNITS: [(&str, [i32; 4]); 22] = [
    ("kg_m3", [1, -3, 0, 0]),
    ("J_kg_K", [0, 2, -2, -1]),
    ("rad_s", [0, 0, -1, 0]),
    ("m_s2", [0, 1, -2, 0]),
    ("kg_s", [1, 0, -1, 0]),
    ("J_m2", [1, 0, -2, 0]),
    ("N_m", [1, 2, -2, 0]),
    ("m_s", [0, 1, -1, 0]),
    ("1_s", [0, 0, -1, 0]),
    ("per_s", [0, 0, -1, 0]),
    ("Pa_s", [1, -1, -1, 0]),
    ("m2", [0, 2, 0, 0]),
    ("m3", [0, 3, 0, 0]),
    ("Pa", [1, -1, -2, 0]),
    ("rad", [0, 0, 0, 0]),
    ("deg", [0, 0, 0, 0]),
    ("kg", [1, 0, 0, 0]),
    ("m", [0, 1, 0, 0]),
    ("s", [0, 0, 1, 0]),
    ("N", [1, 1, -2, 0]),
    ("J", [1, 2, -2, 0]),
    ("K", [0, 0, 0, 1]),
];

/// Last words of names of pure numbers.
const BARE: [&str; 12] = [
    "ratio",
    "restitution",
    "strain",
    "closure",
    "points",
    "steps",
    "exponent",
    "coefficient",
    "friction",
    "angle",
    "sensitivity",
    "softening",
];

impl Dimension {
    /// Dimension by the unit at the end of a column's name, as [`Named::of`] reads it.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Named::of(name).map(|named| named.dimension)
    }

    /// Last words of pure numbers.
    #[must_use]
    pub fn bare() -> &'static [&'static str] {
        &BARE
    }

    /// Whether it is a pure number.
    #[must_use]
    pub fn is_none(self) -> bool {
        self == Dimension::default()
    }
}

/// What the name of a column says of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Named {
    /// The name in SI units: `radius_m` for `radius_mm`.
    pub name: String,
    /// Dimension by the unit at its end.
    pub dimension: Dimension,
    /// Its numbers times this are in SI units.
    pub factor: f64,
}

/// Units that names may end in for other reasons (`min` is a minimum, `in` what comes in), or that no factor takes to SI units.
const AMBIGUOUS: [&str; 7] = ["d", "degC", "g", "h", "in", "min", "t"];

/// Every unit a name may end in, the longest first: how it ends, in SI units, dimension, factor.
static ENDINGS: LazyLock<Vec<(String, &str, Dimension, f64)>> = LazyLock::new(|| {
    let written = |unit: &str| unit.replace(['/', ' '], "_").replace(['(', ')'], "");
    let mut all: Vec<_> = UNITS
        .iter()
        .map(|(unit, exponents)| ((*unit).to_owned(), *unit, Dimension(*exponents), 1.0))
        .collect();
    // N_m is the energy or torque it always was: of its multiples none can tell which
    for units in DIMENSIONS.iter().filter(|units| units.noun() != "torque") {
        let value = |unit: &str| (units.parse)(&format!("1 {unit}")).ok();
        let si = UNITS.iter().find(|(end, _)| {
            let is = |unit: &&&str| written(unit) == *end && value(unit) == Some(1.0);
            units.units.iter().any(|unit| is(&unit))
        });
        let Some((si, exponents)) = si else { continue };
        for unit in units.units {
            let end = written(unit);
            let known = all.iter().any(|(known, ..)| *known == end);
            if let (false, false, Some(factor)) =
                (known, AMBIGUOUS.contains(&&end[..]), value(unit))
            {
                all.push((end, *si, Dimension(*exponents), factor));
            }
        }
    }
    all.sort_by_key(|(end, ..)| std::cmp::Reverse(end.len()));
    all
});

impl Named {
    /// Looks at a name; `None` where it ends in nothing that is known.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let plain = |dimension| Named {
            name: name.to_owned(),
            dimension,
            factor: 1.0,
        };
        // A_over_B is a pure number by its name
        if name.contains("_over_") {
            return Some(plain(Dimension::default()));
        }
        let stem = |end: &str| {
            let stem = name.strip_suffix(end)?;
            (stem.ends_with('_') && stem.len() > 1).then_some(stem)
        };
        let unit = ENDINGS
            .iter()
            .find_map(|(end, si, dimension, factor)| Some((stem(end)?, *si, *dimension, *factor)));
        if let Some((stem, si, dimension, factor)) = unit {
            return Some(Named {
                name: format!("{stem}{si}"),
                dimension,
                factor,
            });
        }
        let last = name.rsplit('_').next().unwrap_or(name);
        BARE.contains(&last).then(|| plain(Dimension::default()))
    }

    /// How a name may end.
    #[must_use]
    pub fn known() -> Vec<&'static str> {
        ENDINGS.iter().map(|(end, ..)| &end[..]).collect()
    }
}

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
    fn units_are_read_from_the_ends_of_names() {
        assert_eq!(
            Dimension::of_name("density_kg_m3"),
            Some(Dimension([1, -3, 0, 0]))
        );
        assert_eq!(
            Dimension::of_name("velocity_m_s"),
            Some(Dimension([0, 1, -1, 0]))
        );
        assert_eq!(
            Dimension::of_name("max_force_N"),
            Some(Dimension([1, 1, -2, 0]))
        );
        assert_eq!(
            Dimension::of_name("poisson_ratio"),
            Some(Dimension::default())
        );
        assert_eq!(
            Dimension::of_name("rho_V2_over_Y"),
            Some(Dimension::default())
        );
        assert_eq!(
            Dimension::of_name("young_modulus_lbf"),
            Some(Dimension([1, 1, -2, 0]))
        );
        // a minimum, not minutes
        assert_eq!(Dimension::of_name("radius_min"), None);
        assert_eq!(Dimension::of_name("m"), None);
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

    #[test]
    fn any_unit_of_case_files_is_read_and_converted() {
        for (name, si, factor) in [
            ("young_modulus_MPa", "young_modulus_Pa", 1e6),
            ("young_modulus_N_mm2", "young_modulus_Pa", 1e6),
            ("radius_mm", "radius_m", 1e-3),
            // not the seconds its end is as well
            ("velocity_mm_s", "velocity_m_s", 1e-3),
            ("density_g_cm3", "density_kg_m3", 1e3),
            ("flow_kg_h", "flow_kg_s", 1.0 / 3600.0),
            ("contact_time_us", "contact_time_s", 1e-6),
            ("max_force_mN", "max_force_N", 1e-3),
            ("density_kg_m3", "density_kg_m3", 1.0),
            ("energy_N_m", "energy_N_m", 1.0),
            ("angle_deg", "angle_deg", 1.0),
        ] {
            let found = Named::of(name).unwrap();
            assert_eq!(found.name, si);
            assert!((found.factor / factor - 1.0).abs() < 1e-12, "{found:?}");
            assert_eq!(Some(found.dimension), Dimension::of_name(si));
        }
    }
}
