//! Set-up of a run in three dimensions: a quarter or half of the sphere on a tensor grid, its planes of symmetry fixed.
//!
//! The part that is left out is counted by weight: points of a quarter carry four times their volume, so masses, forces
//! and impulses are those of the whole sphere.

use crate::impact::ball::{clip, surface};
use crate::impact::basis::Direction;
use crate::impact::kernel::{Point, Points};
use crate::impact::patch::{Friction, Patch};
use crate::impact::setup::Model;
use crate::material::stress::Constitutive;
use crate::plan::{Geometry, Grid, graded};
use crate::space::Solid;

/// Degree of the splines in three dimensions.
const DEGREE: usize = 2;
/// Memory of friction for the normal force, in cells at the speed c0. Without it a sphere of nu = 0.35 that slides at
/// mu = 0.3 sticks in waves and loses 4 % of the friction impulse; with it 0.15 % is missing.
const MEMORY: f64 = 2.3;
/// Nodes of a cell.
pub const NODES: usize = 27;

/// A run's model in three dimensions.
pub type SolidModel<M, F> = Model<Solid, M, Patch<F, NODES>, NODES>;

/// Tensor grid of three directions.
struct Lattice {
    axes: [Direction<DEGREE>; 3],
    breaks: [Vec<f64>; 3],
}

impl Lattice {
    fn new(grid: &Grid, geometry: Geometry) -> Self {
        let lay = |length, to| graded(length, grid.fine, to, grid.growth, grid.coarse);
        let side = lay(1.0, grid.fine_width);
        let both = || {
            side.iter()
                .skip(1)
                .rev()
                .map(|x| -x)
                .chain(side.iter().copied())
                .collect()
        };
        let along = if geometry == Geometry::Half {
            both()
        } else {
            side.clone()
        };
        let breaks = [along, side, lay(2.0, grid.fine_depth)];
        Lattice {
            axes: breaks.clone().map(Direction::new),
            breaks,
        }
    }

    fn functions(&self) -> [usize; 3] {
        [0, 1, 2].map(|k| self.axes[k].functions())
    }

    fn node(&self, [i, j, k]: [usize; 3]) -> usize {
        let [nx, ny, _] = self.functions();
        (k * ny + j) * nx + i
    }

    fn offsets(&self) -> [usize; NODES] {
        std::array::from_fn(|n| self.node(split(n)))
    }

    fn cell(&self, index: [usize; 3]) -> [(f64, f64); 3] {
        [0, 1, 2].map(|k| self.axes[k].cell(index[k]))
    }

    /// First node of the cell that holds `x`, and the values of its nodes there.
    fn interpolate(&self, x: [f64; 3]) -> (usize, [f64; NODES]) {
        let index = [0, 1, 2].map(|k| self.axes[k].cell_of(x[k]));
        (self.node(index), self.point(index, x, 0.0).values)
    }

    /// Material point at `x` in cell `index`.
    fn point(&self, index: [usize; 3], x: [f64; 3], volume: f64) -> Point<NODES> {
        let b = [0, 1, 2].map(|k| self.axes[k].evaluate(index[k], x[k]));
        let weight = |n: usize, slope: usize| -> f64 {
            let a = split(n);
            let factor = |k: usize| {
                if k == slope {
                    b[k].slope[a[k]]
                } else {
                    b[k].value[a[k]]
                }
            };
            factor(0) * factor(1) * factor(2)
        };
        Point {
            position: x,
            values: std::array::from_fn(|n| weight(n, 3)),
            weights: std::array::from_fn(|n| [weight(n, 0), weight(n, 1), weight(n, 2)]),
            volume,
        }
    }

    /// Coefficients that make the functions the coordinates.
    fn places(&self) -> Vec<[f64; 3]> {
        let [nx, ny, nz] = self.functions();
        (0..nx * ny * nz)
            .map(|n| {
                let index = [n % nx, n / nx % ny, n / nx / ny];
                [0, 1, 2].map(|k| self.axes[k].greville(index[k]))
            })
            .collect()
    }

    /// Reciprocal masses; nodes on a plane of symmetry keep to it.
    fn recip_mass(&self, mass: &[f64], geometry: Geometry) -> Vec<[f64; 3]> {
        let [nx, ny, _] = self.functions();
        let quarter = geometry != Geometry::Half;
        mass.iter()
            .enumerate()
            .map(|(n, &m)| {
                let w = if m > 0.0 { 1.0 / m } else { 0.0 };
                let free = |fixed: bool| if fixed { 0.0 } else { w };
                [free(quarter && n % nx == 0), free(n / nx % ny == 0), w]
            })
            .collect()
    }
}

/// Position of node `n` within its cell.
fn split(n: usize) -> [usize; 3] {
    let side = DEGREE + 1;
    [n % side, n / side % side, n / side / side]
}

/// Lay `grid` over a quarter (x, y >= 0) or half (y >= 0) of a unit sphere.
pub fn build<M: Constitutive<Solid>, F: Friction>(
    grid: &Grid,
    geometry: Geometry,
    material: M,
    friction: F,
    contact_tolerance: f64,
) -> SolidModel<M, F> {
    let lattice = Lattice::new(grid, geometry);
    let copies = if geometry == Geometry::Half { 2.0 } else { 4.0 };
    let offsets = lattice.offsets();
    let places = lattice.places();
    let mut mass = vec![0.0; places.len()];
    let mut points = Points::new(material, offsets, grid.remedies.own_volume);
    let [nx, ny, nz] = [0, 1, 2].map(|k| lattice.axes[k].cells());
    for c in 0..nx * ny * nz {
        let index = [c % nx, c / nx % ny, c / nx / ny];
        let cell: Vec<Point<NODES>> = clip(lattice.cell(index), grid.points_per_direction)
            .iter()
            .map(|p| lattice.point(index, p.position, copies * p.volume))
            .collect();
        if cell.is_empty() {
            continue;
        }
        let first = lattice.node(index);
        for point in &cell {
            for (offset, value) in offsets.iter().zip(&point.values) {
                mass[first + offset] += point.volume * value;
            }
        }
        points.push_cell(first, &cell);
    }
    let recip_mass = lattice.recip_mass(&mass, geometry);
    let mut contact = Patch::new(friction, offsets, MEMORY * grid.fine, contact_tolerance);
    for x in surface(lattice.breaks.each_ref().map(Vec::as_slice)) {
        let (first, values) = lattice.interpolate(x);
        contact.push(first, values, x);
    }
    contact.couple(&recip_mass);
    let marker = |z: f64| {
        let (first, values) = lattice.interpolate([0.0, 0.0, z]);
        offsets
            .iter()
            .zip(values)
            .map(|(o, v)| (first + o, v))
            .collect()
    };
    Model {
        points,
        contact,
        recip_mass,
        markers: [marker(0.0), marker(1.0), marker(2.0)],
        places,
        copies,
        mass,
    }
}
