//! Insertion: where grains come in: on lattices in a region, none overlapping, refused before the first step if they
//! would not fit.

pub mod feed;

use self::feed::Feed;
use crate::Result;
use crate::bed::scene::region::Region;
use crate::bed::scene::{Group, Insertion, Scene};
use crate::dem::bodies::enclosure::{Room, THICKNESS};
use crate::dem::bodies::machine::Machine;
use crate::dem::grains::Grains;
use crate::dem::grains::neighbours::{Cells, HalfList};
use crate::dem::grains::newcomer::Newcomer;
use parry3d::math::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Lattice spacing over the largest diameter: room for the shifts below.
const SPACING: f64 = 1.1;
/// Largest shift of a grain off its lattice place along an axis, over the radius: neighbours 2.2 R apart stay apart.
const SHIFT: f64 = 0.08;

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

/// Stream of random numbers for one batch of one group.
#[must_use]
pub fn random_of(seed: u64, group: usize, batch: u64) -> Pcg64Mcg {
    // odd constants far from each other: the first batch of the first group has the scene's own seed
    let group = (group as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let batch = batch.wrapping_mul(0xD1B5_4A32_D192_ED03);
    Pcg64Mcg::seed_from_u64(seed.wrapping_add(group).wrapping_add(batch))
}

/// Velocity of a newcomer: that of its group and its stir.
pub fn velocity_of(group: &Group, random: &mut Pcg64Mcg) -> Vector {
    // an even spread over [-1, 1] has a root mean square of 1/sqrt(3)
    let mut speed = || group.stir * 3f64.sqrt() * random.random_range(-1.0..=1.0);
    group.velocity + Vector::new(speed(), speed(), speed())
}

/// Fills `region`, or the box `room` as high as needed, with grains of `group` until `enough` says so or it is full.
///
/// They stand in square layers, each layer moved sideways at random and each grain a little off its place, so that no
/// columns are left standing.
pub fn lattice(
    scene: &Scene,
    group: &Group,
    random: &mut Pcg64Mcg,
    mut enough: impl FnMut(Option<&Newcomer>) -> bool,
) -> Vec<Newcomer> {
    let [_, largest] = group.sizes.limits();
    let spacing = 2.0 * largest * SPACING;
    let [low, high] = floor_and_lid(scene, group);
    let size = high - low;
    let along = |edge: f64| ((edge / spacing) as usize).saturating_sub(1).max(1);
    let (nx, ny) = (along(size.x), along(size.y));
    let slack = Vector::new(
        size.x - nx as f64 * spacing,
        size.y - ny as f64 * spacing,
        0.0,
    );
    let density = scene.materials[group.material].material.density;
    let mut layer = Vector::ZERO;
    let mut newcomers = Vec::new();
    let mut complete = enough(None);
    for index in 0.. {
        let height = index / (nx * ny);
        if complete || (height + 1) as f64 * spacing > size.z {
            break;
        }
        if index % (nx * ny) == 0 {
            layer = slack
                * Vector::new(
                    random.random_range(0.0..=1.0),
                    random.random_range(0.0..=1.0),
                    0.0,
                );
        }
        let place = Vector::new((index % nx) as f64, (index / nx % ny) as f64, height as f64);
        let mut shift = || SHIFT * largest * random.random_range(-1.0..=1.0);
        let shift = Vector::new(shift(), shift(), shift());
        let radius = group.sizes.draw(random);
        let newcomer = Newcomer {
            centre: low + (place + 0.5) * spacing + layer + shift,
            radius,
            density,
            material: group.material as u8,
            velocity: velocity_of(group, random),
        };
        if group
            .region
            .is_none_or(|region| region.holds(newcomer.centre, radius))
        {
            complete = enough(Some(&newcomer));
            newcomers.push(newcomer);
        }
    }
    newcomers
}

/// Lowest and highest corner of where a group comes in.
fn floor_and_lid(scene: &Scene, group: &Group) -> [Vector; 2] {
    match (&group.region, &scene.container) {
        (Some(region), _) => region.corners(),
        (None, Some(container)) => {
            let lid = container.height.unwrap_or(f64::INFINITY);
            [
                Vector::ZERO,
                Vector::new(container.width, container.depth, lid),
            ]
        }
        (None, None) => [Vector::ZERO; 2],
    }
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
    for group in feed.initial(scene) {
        let newcomers = feed.lattice(scene, group);
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
                let mut random = random_of(seed, index, 0);
                let first = lattice(scene, group, &mut random, |_| false);
                (first.len(), "one grain".to_owned())
            }
            Insertion::Lattice => {
                let (mut missing, mut random) = (Feed::new(scene, seed), random_of(seed, index, 0));
                let all = lattice(scene, group, &mut random, |last| {
                    missing.count(scene, index, last)
                });
                if !missing.is_complete(scene, index) {
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
