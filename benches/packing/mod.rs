//! The packing all benches of the bed share: 10 000 settled spheres in a box, see `benches/data/README.md`.

use impactlaw::dem::bodies::enclosure::Room;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::grains::Grains;
use impactlaw::dem::grains::neighbours::Cells;
use impactlaw::material::{Flow, Material};
use parry3d::math::Vector;

pub const RADIUS: f64 = 1e-3;
pub const EDGE: f64 = 46e-3;
pub const GRAVITY: Vector = Vector::new(0.0, 0.0, -9.81);
pub const MATERIAL: Material = Material {
    density: 2500.0,
    young_modulus: 5e7,
    poisson_ratio: 0.3,
    flow: Some(Flow::perfectly_plastic(1e6)),
};

const PLACES: &[u8] = include_bytes!("../data/packing.bin");

/// The packing `across` times beside itself along x and y, grains in the order of cells.
pub fn packing(across: usize) -> Grains {
    let mut grains = Grains::default();
    for copy in 0..across * across {
        let corner = [copy % across, copy / across, 0].map(|at| at as f64 * EDGE);
        for place in PLACES.chunks_exact(12) {
            let along = |axis: usize| {
                let bytes = [0, 1, 2, 3].map(|byte| place[4 * axis + byte]);
                f64::from(u32::from_le_bytes(bytes)) * (EDGE / f64::from(1u32 << 31))
            };
            let centre = Vector::from([0, 1, 2].map(along)) + Vector::from(corner);
            grains.add(centre, RADIUS, MATERIAL.density);
        }
    }
    let order = Cells::new(&grains.spheres, 2.0 * RADIUS).order();
    grains.reorder(&order);
    grains
}

/// The box around it.
pub fn walls(across: usize) -> Machine {
    let edge = EDGE * across as f64;
    let room = Room::open_box(edge, edge, 80e-3, 4e-3);
    Machine::new(room.walls(), GRAVITY, RADIUS).expect("a box of blocks is sound")
}
