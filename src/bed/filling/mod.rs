//! Insertion: where grains come in: on lattices in a region, none overlapping, refused before the first step if they
//! would not fit.

pub mod feed;
pub mod lattice;

use self::feed::Feed;
use self::lattice::{SPACING, Source, lattice, random_of};
use crate::Result;
use crate::bed::scene::region::Region;
use crate::bed::scene::{Insertion, Scene};
use crate::dem::bodies::enclosure::{Room, THICKNESS};
use crate::dem::bodies::machine::Machine;
use crate::dem::grains::Grains;
use crate::dem::grains::neighbours::{Cells, HalfList};

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
/// [`crate::Error::Value`] where a region is too small, or grains would overlap each other.
pub fn insert(scene: &Scene, seed: u64) -> Result<(Grains, Feed, Room)> {
    check_regions(scene, seed)?;
    let mut feed = Feed::new(scene, seed);
    let mut grains = Grains {
        room: scene.sides()?,
        ..Grains::default()
    };
    let mut groups = Vec::new();
    for group in feed.initial() {
        let newcomers = feed.lattice(group);
        groups.resize(groups.len() + newcomers.len(), group);
        newcomers.iter().for_each(|one| one.join(&mut grains));
    }
    check_overlaps(scene, &grains, &groups)?;
    let top = grains
        .spheres
        .iter()
        .fold(0.0f64, |top, s| top.max(s.centre.z));
    let regions = scene.groups.iter().filter_map(|group| group.region);
    let top = regions.fold(top, |top, region| top.max(region.corners()[1].z));
    let [_, largest] = scene.radii();
    grains.reorder(&Cells::new(&grains.spheres, 2.0 * largest).order());
    // whole layers, so that the room does not depend on the shifts of the last one
    let spacing = 2.0 * largest * SPACING;
    let layers = (top / spacing - 1e-3).ceil().max(0.0);
    Ok((grains, feed, room_of(scene, layers * spacing)))
}

fn check_regions(scene: &Scene, seed: u64) -> Result<()> {
    for (index, group) in scene.groups.iter().enumerate() {
        let [_, largest] = group.sizes.limits();
        let key = match group.region {
            Some(_) => format!("{}.region", group.key),
            None => "box.height".to_owned(),
        };
        let (fits, wanted) = match group.insertion {
            Insertion::Stream(_) => {
                let holds = |region: Region| {
                    let [low, high] = region.corners();
                    region.holds(0.5 * (low + high), largest)
                };
                (
                    usize::from(group.region.is_some_and(holds)),
                    "one grain".to_owned(),
                )
            }
            Insertion::Pour => {
                let source = Source::of(scene, group);
                let mut random = random_of(seed, index, 0);
                let first = lattice(&source, &mut random, |_| false);
                (first.len(), "one grain".to_owned())
            }
            Insertion::Lattice => {
                let mut feed = Feed::new(scene, seed);
                let all = feed.lattice(index);
                if !feed.is_complete(index) {
                    let allowed = format!(
                        "must be larger: {} of the grains fit without overlap; enlarge it, or pour them (`insertion = \"pour\"`)",
                        all.len()
                    );
                    return Err(scene.document.reject(&key, allowed));
                }
                (all.len(), String::new())
            }
        };
        if fits == 0 {
            let allowed = format!("must be larger: not even {wanted} fits in it");
            return Err(scene.document.reject(&key, allowed));
        }
    }
    Ok(())
}

fn check_overlaps(scene: &Scene, grains: &Grains, groups: &[usize]) -> Result<()> {
    let Some(&[a, b]) = HalfList::within(&grains.room, &grains.spheres, 0.0)
        .pairs
        .first()
    else {
        return Ok(());
    };
    let [a, b] = [a, b].map(|grain| &scene.groups[groups[grain as usize]]);
    let allowed = format!(
        "must not reach into that of the group \"{}\": grains of both would overlap; move it, or pour them",
        a.name
    );
    Err(scene.document.reject(&format!("{}.region", b.key), allowed))
}

/// That no grain is inside a body.
///
/// # Errors
/// [`crate::Error::Value`] naming the body.
pub fn check_bodies(scene: &Scene, grains: &Grains, machine: &Machine) -> Result<()> {
    for (index, surface) in machine.surfaces.iter().enumerate() {
        for sphere in &grains.spheres {
            let centre = sphere.centre / machine.unit;
            let distance = surface.shape.distance_to_point(&surface.pose, centre, true);
            if distance * machine.unit >= sphere.radius {
                continue;
            }
            let name = &machine.bodies()[index].name;
            let place = scene.bodies.iter().position(|body| body.name == *name);
            let key = place.map_or("grains".to_owned(), |place| format!("body[{place}]"));
            let [x, y, z] = (sphere.centre * 1e3).to_array();
            return Err(scene.document.reject(
                &key,
                format!(
                    "must stay clear of the grains: \"{name}\" reaches into the grain at ({x:.3}, {y:.3}, {z:.3}) mm; move the body or the grains' region"
                ),
            ));
        }
    }
    Ok(())
}
