//! Checks of a filling before the first step: that every group has room, clear of other grains and of bodies.

use super::feed::Feed;
use super::lattice::{Source, lattice, random_of};
use super::space::Space;
use crate::Result;
use crate::bed::scene::region::Region;
use crate::bed::scene::{Change, Insertion, Move, Outlet, Scene, Stage};
use crate::dem::bodies::Mobility;
use crate::dem::bodies::enclosure::Room;
use crate::dem::bodies::machine::Machine;
use crate::dem::grains::neighbours::HalfList;
use crate::dem::grains::{Grains, Sphere};
use parry3d::math::Vector;

/// That every group fits into where it comes in.
///
/// # Errors
/// [`crate::Error::Value`] naming region or box.
pub fn check_regions(scene: &Scene, seed: u64) -> Result<()> {
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
                let source = Source::of(scene, index);
                let mut random = random_of(seed, index, 0);
                let first = lattice(&source, &mut random, |_, _| true, |last| last.is_some());
                (first.len(), "one grain".to_owned())
            }
            Insertion::Lattice => {
                let mut feed = Feed::new(scene, seed);
                let all = feed.lattice(index, |_, _| true);
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

/// That grains, of the groups in their order, are clear of each other and of their images.
///
/// # Errors
/// [`crate::Error::Value`] naming the regions.
pub fn check_overlaps(scene: &Scene, grains: &Grains, groups: &[usize]) -> Result<()> {
    let inside = |sphere: &Sphere| Sphere {
        centre: grains.room.inside(sphere.centre),
        ..*sphere
    };
    let spheres: Vec<Sphere> = grains.spheres.iter().map(inside).collect();
    let list = HalfList::within(&grains.room, &spheres, 0.0);
    let overlap = |&[a, b]: &[u32; 2]| {
        let [a, b] = [a, b].map(|grain| spheres[grain as usize]);
        let distance = grains.room.shortest(a.centre - b.centre).length();
        (a.radius + b.radius - distance) / (2.0 * a.radius.min(b.radius))
    };
    // files may have grains that press each other, and nothing else may
    let let_in = |grain: u32| {
        let given = scene.groups[groups[grain as usize]].given.as_ref();
        given.map_or(0.0, |given| given.overlap)
    };
    let beyond = |pair: &&[u32; 2]| {
        let [a, b] = pair.map(let_in);
        overlap(pair) > a.min(b)
    };
    let Some(pair) = list.pairs.iter().find(beyond) else {
        return Ok(());
    };
    let lines = Lines::of(scene, groups);
    let places = pair.map(|grain| lines.at(grain as usize));
    if let [Some((file, a)), Some((_, b))] = places {
        let group = &scene.groups[groups[pair[1] as usize]];
        let allowed = format!(
            "must list grains that are apart: {file} has those of lines {a} and {b} overlap by {:.1} % of a diameter; let in is {:.1} % (`overlap`)",
            100.0 * overlap(pair),
            100.0 * let_in(pair[1])
        );
        let key = format!("{}.file.path", group.key);
        return Err(scene.document.reject(&key, allowed));
    }
    let [a, b] = pair.map(|grain| groups[grain as usize]);
    let (first, second) = (&scene.groups[a], &scene.groups[b]);
    let allowed = match a == b {
        true => {
            "must be no wider than the period of the box: its grains would overlap their images"
                .to_owned()
        }
        false => format!(
            "must not reach into that of the group \"{}\": grains of both would overlap; move it, or pour them",
            first.name
        ),
    };
    Err(scene
        .document
        .reject(&format!("{}.region", second.key), allowed))
}

/// Files and lines of grains that stand in the order of their groups.
struct Lines<'a> {
    scene: &'a Scene,
    groups: &'a [usize],
    /// Index of the first grain of each group.
    first: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn of(scene: &'a Scene, groups: &'a [usize]) -> Self {
        let first = (0..scene.groups.len()).map(|group| groups.partition_point(|&g| g < group));
        Self {
            scene,
            groups,
            first: first.collect(),
        }
    }

    /// File and line of a grain, if a file lists it.
    fn at(&self, grain: usize) -> Option<(&'a str, usize)> {
        let group = self.groups[grain];
        let given = self.scene.groups[group].given.as_ref()?;
        let place = given.grains.get(grain - self.first[group])?;
        Some((&given.file, place.at))
    }
}

/// That the grains of files are in the room; `groups` are those of the grains.
///
/// # Errors
/// [`crate::Error::Value`] naming file and line.
pub fn check_places(scene: &Scene, grains: &Grains, groups: &[usize], room: &Room) -> Result<()> {
    let lines = Lines::of(scene, groups);
    for (grain, sphere) in grains.spheres.iter().enumerate() {
        let Some((file, line)) = lines.at(grain) else {
            continue;
        };
        let centre = grains.room.inside(sphere.centre);
        let above = scene.container.is_some() && centre.z > room.height;
        if !room.holds(centre) || above {
            let [x, y, z] = (sphere.centre * 1e3).to_array();
            let allowed = format!(
                "must list grains in the room: {file} has that of line {line} at ({x:.3}, {y:.3}, {z:.3}) mm, outside of the {}; move them (`shift`), or look at `length`",
                if scene.container.is_some() {
                    "box"
                } else {
                    "domain"
                }
            );
            let key = format!("{}.file.path", scene.groups[groups[grain]].key);
            return Err(scene.document.reject(&key, allowed));
        }
    }
    Ok(())
}

/// That no grain is in an outlet from the start; `groups` are those of the grains.
///
/// # Errors
/// [`crate::Error::Value`] naming outlet and group.
pub fn check_outlets(scene: &Scene, grains: &Grains, groups: &[usize]) -> Result<()> {
    for (sphere, &group) in grains.spheres.iter().zip(groups) {
        let centre = grains.room.inside(sphere.centre);
        let takes = |outlet: &Outlet| outlet.mouth.takes(centre);
        if let Some(index) = scene.outlets.iter().position(takes) {
            let allowed = format!(
                "must stay clear of the grains of the group \"{}\": they would leave as they come in",
                scene.groups[group].name
            );
            return Err(scene.document.reject(&format!("outlet[{index}]"), allowed));
        }
    }
    Ok(())
}

/// That no grain comes in where a body is: none that is there from the start, and none of the first lattice of a group
/// that comes later, as far as bodies stay where they are. Streams go round bodies.
///
/// # Errors
/// [`crate::Error::Value`] naming group and body.
pub fn check_bodies(scene: &Scene, feed: &Feed, grains: &Grains, machine: &Machine) -> Result<()> {
    let everywhere = [Vector::MIN, Vector::MAX];
    let space = Space::of(everywhere, &Grains::default(), &[], machine);
    for (sphere, &id) in grains.spheres.iter().zip(&grains.ids) {
        let group = feed.group_of(id);
        let radius = sphere.radius * (1.0 - feed.overlap_of(group));
        if let Some(body) = space.body_at(sphere.centre, radius) {
            return Err(in_the_way(scene, machine, group, body, sphere.centre));
        }
    }
    for (index, group) in scene.groups.iter().enumerate() {
        let from_the_start = feed.inflows[index].active;
        let waits = matches!(group.insertion, Insertion::Stream(_));
        if waits || (from_the_start && group.insertion == Insertion::Lattice) {
            continue;
        }
        let mut batch = Grains {
            room: grains.room,
            ..Grains::default()
        };
        let first = feed.clone().lattice(index, |_, _| true);
        first.iter().for_each(|one| one.join(&mut batch));
        check_overlaps(scene, &batch, &vec![index; batch.len()])?;
        for sphere in &batch.spheres {
            let radius = sphere.radius * (1.0 - feed.overlap_of(index));
            let body = space.body_at(sphere.centre, radius);
            if let Some(body) = body.filter(|&body| from_the_start || stays(scene, machine, body)) {
                return Err(in_the_way(scene, machine, index, body, sphere.centre));
            }
        }
    }
    Ok(())
}

/// Whether a body stands where it is in every stage.
fn stays(scene: &Scene, machine: &Machine, body: usize) -> bool {
    let body = &machine.bodies()[body];
    let told = |stage: &Stage| match stage {
        Stage::Run(run) => {
            let leaves = |order: &Move| !matches!(order.change, Change::Belt(_));
            let its = |order: &&Move| order.body == body.name;
            run.moves.iter().filter(its).any(leaves)
        }
        _ => false,
    };
    let stands = matches!(body.mobility, Mobility::Fixed | Mobility::Belt(_));
    stands && !scene.stages.iter().any(told)
}

fn in_the_way(
    scene: &Scene,
    machine: &Machine,
    group: usize,
    body: usize,
    place: Vector,
) -> crate::Error {
    let (name, group) = (&machine.bodies()[body].name, &scene.groups[group]);
    let index = scene.bodies.iter().position(|body| body.name == *name);
    let key = index.map_or(group.key.clone(), |index| format!("body[{index}]"));
    let [x, y, z] = (place * 1e3).to_array();
    let allowed = format!(
        "must stay clear of the grains: \"{name}\" reaches into the grain of \"{}\" at ({x:.3}, {y:.3}, {z:.3}) mm; move the body or the grains' region",
        group.name
    );
    scene.document.reject(&key, allowed)
}
