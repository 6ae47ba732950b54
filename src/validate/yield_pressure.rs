//! Yield pressure: mean pressure between a hard sphere and a yielding plate, from first yield to full plasticity.

use super::measured::Figure;
use super::{Bound, Derived, Experiment, File, Found};
use crate::unit::significant;

/// Alumina of 5 mm on a thick plate of steel.
pub struct YieldPressure;

impl Experiment for YieldPressure {
    const NAME: &'static str = "yield-pressure";
    const TITLE: &'static str = "Mean pressure of a yielding plate";
    const SOURCE: &'static str = "Kharaz and Gorham, Philosophical Magazine Letters 2000, abstract";
    const FILE: File = File::Pair;
    const CASES: &'static str = include_str!("../../cases/experiments/yield-pressure.toml");
    const MEASURED: &'static str = include_str!("../../cases/experiments/yield-pressure.csv");
    const FIGURES: &'static [Figure] = &[Figure::MeanPressure, Figure::Restitution];
    const REMARKS: &'static [&'static str] = &[
        "The abstract says that the mean pressure grows from 1.1 Y at first yield to 2.8 Y at about 100 times the speed of first yield. Their points and the constants of \
         their plates were not seen: those here are usual ones, and the strength of the steel is assumed. In units of Y and of the speed of first yield the \
         mean pressure depends on them little.",
        "Ours is F* over the area of the widest contact. Its edge is the outermost point that touches, which lies up to a cell within it, here a tenth of the radius at \
         first yield: the mean pressure is up to a fifth too high, and no bound is stated. The restitution has no printed value.",
    ];

    fn bounds(_: &Found) -> Vec<Bound> {
        Vec::new()
    }

    fn tables(found: &Found) -> Vec<Derived> {
        let slowest = found.outcomes().first().map(|one| one.case.velocities[0]);
        let rows = found.outcomes().iter().filter_map(|one| {
            let velocity = one.case.velocities[0];
            let pressure = one.figure(Figure::MeanPressure)?;
            let cells = [velocity, velocity / slowest?, one.flat, pressure];
            Some(cells.map(|x| significant(x, 3)).into())
        });
        vec![Derived {
            title: "From first yield on".to_owned(),
            text: "The slowest impact is at the speed of first yield by Hertz’s contact of the two bodies, at which the mean pressure is 1.07 Y."
                .to_owned(),
            head: vec!["V (m/s)", "over that of first yield", "a/R", "mean pressure over Y"],
            rows: rows.collect(),
        }]
    }
}
