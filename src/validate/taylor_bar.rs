//! Taylor bar: final shape of a copper cylinder.

use super::measured::Figure;
use super::{Bound, Derived, Experiment, File, Found, Quantity, Row};

/// Cylinder of OFHC copper at 190 m/s.
pub struct TaylorBar;

/// How far ours may be from the experiment, relative.
const TOLERANCE: f64 = 0.01;

impl Experiment for TaylorBar {
    const NAME: &'static str = "taylor-bar";
    const TITLE: &'static str = "Taylor bar";
    const SOURCE: &'static str =
        "Johnson and Holmquist, J. Appl. Phys. 64 (1988) 3901; Saifoori 2025, table 2-2";
    const FILE: File = File::Case;
    const CASES: &'static str = include_str!("../../cases/experiments/taylor-bar.toml");
    const MEASURED: &'static str = include_str!("../../cases/experiments/taylor-bar.csv");
    const FIGURES: &'static [Figure] = &[Figure::Length, Figure::Foot, Figure::Fifth];
    const REMARKS: &'static [&'static str] = &[
        "The constants were made for this bar and know neither rate nor heat: the agreement shows that the solver is right, and predicts nothing. With Johnson and \
         Cook’s constants of 1983 the mean error is 7 to 8 %, by the constants and not by the grid (guide, chapter Measured).",
        "No uncertainty is printed. The bound is 1 % of each length. The table’s updated Lagrangian MPM (Sulsky and Schreyer 1996) has 18.3, 14.6 and 9.1 mm.",
    ];

    fn bounds(found: &Found) -> Vec<Bound> {
        let near = |row: &Row| {
            let of = format!("{}, m", Quantity::Figure(row.figure).name());
            let reading = row.value().map(|value| [value, TOLERANCE * value]);
            Bound::inside(of, row.ours, reading)
        };
        found.rows.iter().map(near).collect()
    }

    fn tables(_: &Found) -> Vec<Derived> {
        Vec::new()
    }
}
