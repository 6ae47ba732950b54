//! Insertion: where grains come in and leave: on lattices in a region, none overlapping, refused before the first step if they
//! would not fit.

mod check;
pub(crate) mod drain;
pub(crate) mod falls;
pub(crate) mod feed;
pub(crate) mod lattice;
pub(in crate::bed) mod memory;
mod space;

pub use self::check::check_bodies;

use self::check::{check_outlets, check_overlaps, check_places, check_regions};
use self::feed::Feed;
use self::lattice::SPACING;
use crate::Result;
use crate::bed::scene::Scene;
use crate::dem::bodies::enclosure::{Room, THICKNESS};
use crate::dem::grains::Grains;
use crate::dem::grains::neighbours::Cells;

/// Room of a scene whose grains come in below `top` (m): its box, its domain, or the block around its bodies and
/// the regions grains come in through.
#[must_use]
pub fn room_of(scene: &Scene, top: f64) -> Room {
    let thickness = THICKNESS * scene.radii()[1];
    if let Some(container) = &scene.container {
        let room_for_piston = if container.piston { thickness } else { 0.0 };
        let height = container
            .height
            .unwrap_or(top + thickness + room_for_piston);
        return Room {
            periodic: container.periodic,
            ..Room::open_box(container.width, container.depth, height, thickness)
        };
    }
    Room::block(scene.domain.unwrap_or_else(|| scene.extent()), thickness)
}

/// Grains that are there from the start, in an order that keeps neighbours together in memory, with what is to come;
/// and the room they are in.
///
/// # Errors
/// [`crate::Error::Value`] where there is not enough memory, a region is too small, or grains would overlap each other.
pub fn insert(scene: &Scene, seed: u64) -> Result<(Grains, Feed, Room)> {
    memory::check(scene)?;
    check_regions(scene, seed)?;
    let mut feed = Feed::new(scene, seed);
    let mut grains = Grains {
        room: scene.sides()?,
        ..Grains::default()
    };
    let mut groups = Vec::new();
    for group in feed.initial() {
        let newcomers = feed.lattice(group, |_, _| true);
        groups.resize(groups.len() + newcomers.len(), group);
        newcomers.iter().for_each(|one| one.join(&mut grains));
    }
    check_overlaps(scene, &grains, &groups)?;
    check_outlets(scene, &grains, &groups)?;
    let top = grains
        .spheres
        .iter()
        .fold(0.0f64, |top, s| top.max(s.centre.z));
    let regions = scene.groups.iter().filter_map(|group| group.region);
    let top = regions.fold(top, |top, region| top.max(region.corners()[1].z));
    let [_, largest] = scene.radii();
    // whole layers, so that the room does not depend on the shifts of the last one
    let spacing = 2.0 * largest * SPACING;
    let layers = (top / spacing - 1e-3).ceil().max(0.0);
    let room = room_of(scene, layers * spacing);
    check_places(scene, &grains, &groups, &room)?;
    grains.reorder(&Cells::new(&grains.spheres, 2.0 * largest).order());
    Ok((grains, feed, room))
}
