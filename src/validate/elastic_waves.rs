//! Elastic waves: how much of its energy an elastic sphere keeps as vibration, beside published bounds.

use super::measured::Figure;
use super::{Bound, Derived, Experiment, File, Found};

/// A rubber ball without losses at 3, 6 and 10 % of its wave speed.
pub struct ElasticWaves;

impl Experiment for ElasticWaves {
    const NAME: &'static str = "elastic-waves";
    const TITLE: &'static str = "Elastic waves";
    const SOURCE: &'static str = "molecular dynamics of elastic spheres on a hard wall (geocities.ws/cofrest/md2.htm): e is at most 1 − 0.03 V/c; \
         losses to waves of 3 to 4 % at most, cited in Comput. Part. Mech. 2024 (s40571-024-00742-x)";
    const FILE: File = File::Study;
    const CASES: &'static str = include_str!("../../cases/experiments/elastic-waves.toml");
    const MEASURED: &'static str = include_str!("../../cases/experiments/elastic-waves.csv");
    const FIGURES: &'static [Figure] = &[Figure::Restitution];
    const REMARKS: &'static [&'static str] = &[
        "Bounds, not measurements, and both are weak: the first is of up to 13500 atoms and does not say which wave speed it means (c = √(E/ρ) is taken here), the second \
         is what others are cited for. Slower impacts say nothing: 0.03 V/c is lost in the tolerance of e.",
        "The upper bound would be met by any body that loses anything; that an elastic one loses more than it, and less than 4 % of its energy, is what is shown.",
    ];

    fn bounds(found: &Found) -> Vec<Bound> {
        let of_row = |row: &super::Row| {
            let [least, most] = row.limits;
            let of = format!("{}, restitution", row.case);
            let least = least.map(|least| Bound::at_least(of.clone(), row.ours, least));
            let most = most.map(|most| Bound::at_most(of, row.ours, most));
            [least, most]
        };
        found.rows.iter().flat_map(of_row).flatten().collect()
    }

    fn tables(_: &Found) -> Vec<Derived> {
        Vec::new()
    }
}
