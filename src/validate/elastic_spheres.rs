//! Elastic spheres: the benchmark of Chung and Ooi, whose answer is Hertz's theory.

use super::measured::Figure;
use super::{Bound, Derived, Experiment, File, Found, Quantity, Row};
use crate::theory::hertz::Hertz;
use crate::theory::published::Published;

/// Aluminium and magnesium alloy at 0.2 m/s.
pub struct ElasticSpheres;

/// How far ours may be from Hertz's theory, relative.
const TOLERANCE: f64 = 0.01;

impl Experiment for ElasticSpheres {
    const NAME: &'static str = "elastic-spheres";
    const TITLE: &'static str = "Elastic spheres";
    const SOURCE: &'static str = "Chung and Ooi, Granular Matter 13 (2011) 643, test 2; Hertz 1882";
    const FILE: File = File::Study;
    const CASES: &'static str = include_str!("../../cases/experiments/elastic-spheres.toml");
    const MEASURED: &'static str = include_str!("../../cases/experiments/elastic-spheres.csv");
    const FIGURES: &'static [Figure] = &[Figure::Force, Figure::ContactTime, Figure::Restitution];
    const REMARKS: &'static [&'static str] = &[
        "No measurement: their answer is Hertz’s theory. It takes a half-space for each body, and a sphere is none: at a contact of 2.2, 4.5 and 8.9 % of the radius \
         (the aluminium at 0.2, 1.13 and 6.4 m/s) our force lies 0.8, 1.8 and 3.8 % above it and our time 0.6, 1.2 and 2.5 % below, both in proportion to \
         the contact’s radius, and the same at a tolerance of 1 %. So the difference is the theory’s.",
    ];

    fn bounds(found: &Found) -> Vec<Bound> {
        let hertz = super::row::theories()
            .iter()
            .position(|name| *name == Hertz::NAME);
        let near = |row: &Row| {
            let of = Quantity::Figure(row.figure).name();
            let exact = row.theories[hertz?]?;
            let of = format!("{}, {of} beside Hertz’s", row.case);
            Some(Bound::within(of, row.ours, exact, TOLERANCE * exact))
        };
        found.rows.iter().filter_map(near).collect()
    }

    fn tables(_: &Found) -> Vec<Derived> {
        Vec::new()
    }
}
