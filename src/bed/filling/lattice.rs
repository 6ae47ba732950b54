//! Lattice: places of the grains of one group, its random numbers and its velocities.

use crate::bed::scene::{Group, Place, Scene};
use crate::dem::grains::newcomer::Newcomer;
use parry3d::math::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Lattice spacing over the largest diameter: room for the shifts below.
pub const SPACING: f64 = 1.1;
/// Largest shift of a grain off its lattice place along an axis, over the radius: neighbours 2.2 R apart stay apart.
const SHIFT: f64 = 0.08;

/// Places in a row that hold no grain after which a region is given up: more than any row of a cylinder has.
const MISSES: usize = 10_000_000;

/// A group with all that making its grains takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// The group.
    pub group: Group,
    /// Its index among those of the scene.
    pub index: u32,
    /// Density of its material, kg/m3.
    pub density: f64,
    /// Lowest and highest corner of where it comes in, m: of its region, else of the box, as high as needed.
    pub corners: [Vector; 2],
}

impl Source {
    /// A group of a scene, by its index.
    #[must_use]
    pub fn of(scene: &Scene, index: usize) -> Self {
        let group = &scene.groups[index];
        Self {
            group: group.clone(),
            index: index as u32,
            density: scene.materials[group.material].material.density,
            corners: floor_and_lid(scene, group),
        }
    }

    /// A grain of this group.
    #[must_use]
    pub fn newcomer(&self, centre: Vector, radius: f64, velocity: Vector) -> Newcomer {
        Newcomer {
            centre,
            radius,
            density: self.density,
            material: self.group.material as u8,
            group: self.index,
            velocity,
            spin: Vector::ZERO,
        }
    }

    /// Share of its radius by which a grain may overlap with what is there already: none but of a file.
    #[must_use]
    pub fn overlap(&self) -> f64 {
        let given = self.group.given.as_ref();
        given.map_or(0.0, |given| 2.0 * given.overlap)
    }

    /// The grains of its file, if it has one.
    fn given(&self, random: &mut Pcg64Mcg) -> Option<Vec<Newcomer>> {
        let given = self.group.given.as_ref()?;
        let newcomer = |place: &Place| Newcomer {
            spin: place.spin,
            ..self.newcomer(
                place.centre,
                place.radius,
                place.velocity + self.velocity(random),
            )
        };
        Some(given.grains.iter().map(newcomer).collect())
    }

    /// Velocity of a newcomer: that of its group and its stir.
    pub fn velocity(&self, random: &mut Pcg64Mcg) -> Vector {
        // an even spread over [-1, 1] has a root mean square of 1/sqrt(3)
        let mut speed = || self.group.stir * 3f64.sqrt() * random.random_range(-1.0..=1.0);
        self.group.velocity + Vector::new(speed(), speed(), speed())
    }
}

/// Stream of random numbers for one batch of one group.
#[must_use]
pub fn random_of(seed: u64, group: usize, batch: u64) -> Pcg64Mcg {
    // odd constants far from each other: the first batch of the first group has the scene's own seed
    let group = (group as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let batch = batch.wrapping_mul(0xD1B5_4A32_D192_ED03);
    Pcg64Mcg::seed_from_u64(seed.wrapping_add(group).wrapping_add(batch))
}

/// Fills the region of a source, or its box as high as needed, with grains until `enough` says so or it is full; a place
/// (m) for a radius (m) that is not `free` is left out.
///
/// They stand in square layers, each layer moved sideways at random and each grain a little off its place, so that no
/// columns are left standing.
pub fn lattice(
    source: &Source,
    random: &mut Pcg64Mcg,
    free: impl Fn(Vector, f64) -> bool,
    mut enough: impl FnMut(Option<&Newcomer>) -> bool,
) -> Vec<Newcomer> {
    let group = &source.group;
    if let Some(given) = source.given(random) {
        given.iter().for_each(|newcomer| {
            enough(Some(newcomer));
        });
        return given;
    }
    let [_, largest] = group.sizes.limits();
    let spacing = 2.0 * largest * SPACING;
    let [low, high] = source.corners;
    let size = high - low;
    let along = |edge: f64| ((edge / spacing) as usize).saturating_sub(1).max(1);
    let (nx, ny) = (along(size.x), along(size.y));
    let in_layer = nx.saturating_mul(ny);
    let slack = Vector::new(
        size.x - nx as f64 * spacing,
        size.y - ny as f64 * spacing,
        0.0,
    );
    let mut layer = Vector::ZERO;
    let mut newcomers = Vec::new();
    let (mut complete, mut missed) = (enough(None), 0);
    for index in 0.. {
        let height = index / in_layer;
        if complete || missed > MISSES || (height + 1) as f64 * spacing > size.z {
            break;
        }
        if index % in_layer == 0 {
            let mut share = || random.random_range(0.0..=1.0);
            layer = slack * Vector::new(share(), share(), 0.0);
        }
        let place = Vector::new((index % nx) as f64, (index / nx % ny) as f64, height as f64);
        let mut shift = || SHIFT * largest * random.random_range(-1.0..=1.0);
        let shift = Vector::new(shift(), shift(), shift());
        let radius = group.sizes.draw(random);
        let centre = low + (place + 0.5) * spacing + layer + shift;
        let newcomer = source.newcomer(centre, radius, source.velocity(random));
        let inside = group
            .region
            .is_none_or(|region| region.holds(centre, radius));
        missed = if inside { 0 } else { missed + 1 };
        if inside && free(centre, radius) {
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
