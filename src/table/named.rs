//! Names of columns: the unit at their end, and what it makes of their numbers.

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

#[cfg(test)]
mod tests {
    use super::*;

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
