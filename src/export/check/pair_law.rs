//! Check of the law of a pair in C: random paths against the contact of a bed.

use super::driver::{Driver, Row, row};
use super::paths;
use crate::Result;
use crate::contact::pair::Pressed;
use crate::dem::force::mixture::Mixture;
use crate::dem::force::normal::{NormalModel, Squeeze};
use crate::dem::force::paired::OfPair;
use crate::export::c;
use crate::export::c::kernel;
use crate::export::check::Agreement;
use crate::export::source::portable::Portable;
use crate::law::AnyLaw;
use crate::law::pair::PairTable;
use crate::theory::Theory;
use std::path::Path;

/// Agreement along paths of so many steps of a sphere on a flat and of two spheres, with the deviation allowed; files go into `scratch`.
///
/// # Errors
/// Those of writing, compiling and running files.
pub(super) fn along_paths(
    law: &Portable,
    bodies: &PairTable,
    compiler: &Path,
    scratch: &Path,
    (steps, allowed): (usize, f64),
) -> Result<Vec<Agreement>> {
    let headers = c::export(law);
    let text = kernel::named(include_str!("pair_driver.c"), law);
    let text = text.replace("@FILE@", &headers[0].name);
    let driver = Driver::compile(&headers, &text, compiler, scratch)?;
    let radius = bodies.particle_radius_m;
    let of = |(name, other): (&str, f64)| {
        let radii = [radius, other];
        let effective = match other > 0.0 {
            true => 1.0 / (1.0 / radius + 1.0 / other),
            false => radius,
        };
        let most = law.file.valid.displacement_over_radius_max * effective;
        let path = paths::random(most, steps, 17);
        let ours = pressed(law, bodies, radii, &path)?;
        Ok(Agreement {
            subject: paths::subject(name, steps),
            deviation: driver.deviation(radii, &path, &ours, &ours)?,
            allowed,
        })
    };
    let all = [("a sphere on a flat", 0.0), ("two spheres", 0.4 * radius)];
    all.into_iter().map(of).collect()
}

/// What the mixture of a bed says along a path; forgotten where the overlap is 0.
fn pressed(law: &Portable, bodies: &PairTable, radii: [f64; 2], path: &[f64]) -> Result<Vec<Row>> {
    let held = bodies
        .materials()
        .map(|material| (AnyLaw::Theory(Theory::Hertz, material), material));
    let core = AnyLaw::Fitted(law.core.clone());
    let own = OfPair {
        between: [0, 1],
        law: &core,
        ratio: radii[1] / radii[0],
    };
    let mixture = Mixture::new(held.iter().map(|(law, material)| (law, material)))?;
    let mixture = mixture.with_pairs([own])?;
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
            energy = chunks[0].elastic_energy(0, squeeze);
        }
        rows.push(row(&(state[0], energy)));
    }
    Ok(rows)
}
