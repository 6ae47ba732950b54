//! Restarts: what an interrupted run of a bed keeps of its grains.

use super::{Listed, Listing, Meaning};
use crate::dem::grains::Grains;
use crate::tape::{Keep, contents};

/// Places and velocities as they were kept: velocities are those of half a step before. Materials count from 0, in the
/// order of their scene.
pub(super) fn read(bytes: &[u8], meaning: &Meaning) -> Result<Listing, String> {
    if meaning.length.is_some() || meaning.velocity.is_some() {
        return Err("is SI: leave out `length` and `velocity`".to_owned());
    }
    let mut tape = contents(bytes.to_vec())?;
    let mut grains = Grains::default();
    // a run begins with its bed, and a bed with its grains
    if grains.load(&mut tape).is_none() || !agree(&grains) {
        return Err("is not kept of a bed; name the `restart.bin` of one".to_owned());
    }
    let mut listing = Listing {
        tells_unit: true,
        ..Listing::default()
    };
    for (index, sphere) in grains.spheres.iter().enumerate() {
        let kind = grains.material(index).to_string();
        let kind = listing.kind(&kind);
        listing.grains.push(Listed {
            at: index + 1,
            centre: sphere.centre,
            radius: Some(sphere.radius),
            velocity: grains.motions[index].velocity,
            spin: grains.spins[index].rate,
            kind: Some(kind),
            density: None,
            mass: Some(1.0 / grains.motions[index].inverse_mass),
        });
    }
    Ok(listing)
}

/// Whether the columns are of one length and hold numbers of grains: those of another kind of run do not.
fn agree(grains: &Grains) -> bool {
    let count = grains.spheres.len();
    let lengths = [
        grains.motions.len(),
        grains.spins.len(),
        grains.plastic.len(),
        grains.ids.len(),
    ];
    let sound = grains.spheres.iter().all(|s| s.radius > 0.0);
    let heavy = grains.motions.iter().all(|m| m.inverse_mass > 0.0);
    lengths.iter().all(|length| *length == count) && sound && heavy
}
