//! Insertion: the box of a scene, its piston, and the grains above its floor before they fall.

use super::bodies::{Body, Mobility};
use super::grains::Grains;
use super::neighbours::Cells;
use super::scene::Scene;
use parry3d::math::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Name of the body that compresses the bed.
pub const PISTON: &str = "piston";
/// Lattice spacing over the largest diameter: room for the shifts below.
const SPACING: f64 = 1.1;
/// Largest shift of a grain off its lattice place along an axis, over the radius: neighbours 2.2 R apart stay apart.
const SHIFT: f64 = 0.08;
/// Thickness of walls and piston over the largest radius: far more than a grain ever sinks in.
const THICKNESS: f64 = 4.0;

/// Inside of the box: x in [0, width], y in [0, depth], z from 0 up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Edge along x, m.
    pub width: f64,
    /// Edge along y, m.
    pub depth: f64,
    /// Height of the walls, m.
    pub height: f64,
    /// Thickness of walls and piston, m.
    pub thickness: f64,
}

impl Room {
    /// Floor area, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.width * self.depth
    }

    /// Whether a point is inside, or above.
    #[must_use]
    pub fn holds(&self, point: Vector) -> bool {
        point.z >= 0.0
            && (0.0..=self.width).contains(&point.x)
            && (0.0..=self.depth).contains(&point.y)
    }

    /// Floor, walls, and the piston parked under the rim.
    #[must_use]
    pub fn bodies(&self) -> Vec<Body> {
        let (w, d, h, t) = (self.width, self.depth, self.height, self.thickness);
        let block =
            |name: &str, low: [f64; 3], high: [f64; 3]| Body::block(name, low.into(), high.into());
        let mut piston = block(PISTON, [0.0, 0.0, h - t], [w, d, h]);
        piston.mobility = Mobility::Driven {
            velocity: Vector::ZERO,
            spin: Vector::ZERO,
        };
        vec![
            block("floor", [-t, -t, -t], [w + t, d + t, 0.0]),
            block("left", [-t, -t, 0.0], [0.0, d + t, h]),
            block("right", [w, -t, 0.0], [w + t, d + t, h]),
            block("front", [0.0, -t, 0.0], [w, 0.0, h]),
            block("back", [0.0, d, 0.0], [w, d + t, h]),
            piston,
        ]
    }
}

/// Grains of a scene above its floor, none overlapping, in an order that keeps neighbours together in memory; and the
/// room that holds them with the piston above.
///
/// They start in square layers, each layer moved sideways at random and each grain a little off its place, so that no
/// columns are left standing.
#[must_use]
pub fn insert(scene: &Scene, seed: u64) -> (Grains, Room) {
    let largest = scene.largest_radius();
    let spacing = 2.0 * largest * SPACING;
    let along = |edge: f64| ((edge / spacing) as usize).saturating_sub(1).max(1);
    let (nx, ny) = (along(scene.width), along(scene.depth));
    let slack = Vector::new(
        scene.width - nx as f64 * spacing,
        scene.depth - ny as f64 * spacing,
        0.0,
    );
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut layer = Vector::ZERO;
    let mut grains = Grains::default();
    for index in 0..scene.count {
        if index % (nx * ny) == 0 {
            layer = slack
                * Vector::new(
                    random.random_range(0.0..=1.0),
                    random.random_range(0.0..=1.0),
                    0.0,
                );
        }
        let place = Vector::new(
            (index % nx) as f64,
            (index / nx % ny) as f64,
            (index / (nx * ny)) as f64,
        );
        let mut shift = || SHIFT * largest * random.random_range(-1.0..=1.0);
        let shift = Vector::new(shift(), shift(), shift());
        let radius = scene.radius * (1.0 + scene.spread * random.random_range(-1.0..=1.0));
        grains.add(
            (place + 0.5) * spacing + layer + shift,
            radius,
            scene.material.density,
        );
        // an even spread over [-1, 1] has a root mean square of 1/sqrt(3)
        let mut speed = || scene.stir * 3f64.sqrt() * random.random_range(-1.0..=1.0);
        grains.motions[index].velocity = Vector::new(speed(), speed(), speed());
    }
    grains.reorder(&Cells::new(&grains.spheres, 2.0 * largest).order());
    let thickness = THICKNESS * largest;
    let layers = scene.count.div_ceil(nx * ny);
    let room = Room {
        width: scene.width,
        depth: scene.depth,
        height: layers as f64 * spacing + 2.0 * thickness,
        thickness,
    };
    (grains, room)
}
