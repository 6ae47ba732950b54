//! Check of a contact of two materials in C: random paths against the mixture of a bed.

use super::c::{PATH_ALLOWED, STEPS};
use super::driver::{Driver, Row, compiler, row, version};
use super::paths;
use crate::Result;
use crate::contact::pair::Pressed;
use crate::dem::force::mixture::Mixture;
use crate::dem::force::normal::{NormalModel, Squeeze};
use crate::export::c;
use crate::export::c::series;
use crate::export::check::{Agreement, Finding};
use crate::export::source::portable::Portable;
use crate::law::AnyLaw;
use std::path::Path;

/// Radius of the second body over that of the first in the path of two spheres.
const SMALLER: f64 = 0.4;

/// Exports the contact of two laws, runs it along random paths and compares; files go into `scratch`, an existing folder.
///
/// # Errors
/// Those of [`c::export_with`], and of writing and running files.
pub fn check(first: &Portable, second: &Portable, scratch: &Path) -> Result<Finding> {
    let compiler = match compiler() {
        Ok(compiler) => compiler,
        Err(why) => return Ok(Finding::Skipped { why }),
    };
    let text = series::named(include_str!("series_driver.c"), first, second);
    let headers = c::export_with(first, second)?;
    let driver = Driver::compile(&headers, &text, &compiler, scratch)?;
    let mut agreements = Vec::new();
    for (smaller, name) in [
        (SMALLER, "unequal spheres of two materials"),
        (0.0, "a sphere on a flat of the other material"),
    ] {
        let radii = [first.radius(), smaller * first.radius()];
        let path = paths::random(deepest([first, second], radii), STEPS, 13);
        let ours = pressed([first, second], radii, &path)?;
        agreements.push(Agreement {
            subject: paths::subject(name, STEPS),
            deviation: driver.deviation(radii, &path, &ours, &largest_so_far(&ours, &path))?,
            allowed: PATH_ALLOWED,
        });
    }
    Ok(Finding::Ran {
        with: version(&compiler)?,
        agreements,
    })
}

/// Overlap (m) at which one of the sides may be as flat as its law's range goes: the smaller range over both sides.
fn deepest(laws: [&Portable; 2], radii: [f64; 2]) -> f64 {
    let valid = laws.map(|law| law.file.valid.displacement_over_radius_max);
    valid[0].min(valid[1]) * (radii[0] + radii[1])
}

/// What the mixture of two materials says along a path; forgotten where the overlap is 0.
fn pressed(laws: [&Portable; 2], radii: [f64; 2], path: &[f64]) -> Result<Vec<Row>> {
    let held = laws.map(|law| (AnyLaw::Fitted(law.core.clone()), law.material()));
    let mixture = Mixture::new(held.iter().map(|(law, material)| (law, material)))?;
    let mut chunks = mixture.chunks(&[], &[None], 1, &|_| [0, 1]);
    let radii = radii.map(|radius| if radius > 0.0 { radius } else { f64::INFINITY });
    let mut rows = Vec::new();
    for &overlap in path {
        let mut state = [Pressed::default()];
        let mut energy = 0.0;
        if overlap <= 0.0 {
            chunks[0].forget(0);
        } else {
            let squeeze = Squeeze { overlap, radii };
            chunks[0].press(&[0], &[squeeze], &mut state);
            // what carries no force holds no energy, whatever is left where the search for the share has ended
            if state[0].force > 0.0 {
                energy = chunks[0].elastic_energy(0, squeeze);
            }
        }
        rows.push(row(&(state[0], energy)));
    }
    Ok(rows)
}

/// The largest each number has been since the bodies touched. How two sides share an overlap is the result of a search: where
/// contact is nearly lost, rounding of the overlap is any part of the little force that is left.
fn largest_so_far(rows: &[Row], path: &[f64]) -> Vec<Row> {
    let mut most = [0.0f64; 7];
    let mut scales = Vec::new();
    for (row, &overlap) in rows.iter().zip(path) {
        if overlap <= 0.0 {
            most = [0.0; 7];
        }
        for (most, number) in most.iter_mut().zip(row) {
            *most = most.max(*number);
        }
        scales.push(most);
    }
    scales
}
