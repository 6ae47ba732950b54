//! Set-up of a run in three dimensions: a quarter or half of the sphere on a tensor grid, its planes of symmetry fixed.
//!
//! The part that is left out is counted by weight: points of a quarter carry four times their volume, so masses, forces
//! and impulses are those of the whole sphere.

use crate::impact::grid::volume::Volume;
use crate::impact::kernel::{Matter, Point, Points};
use crate::impact::model::{Model, is_scattered};
use crate::impact::points::ball::{BallPoint, clip, surface};
use crate::impact::points::lattice;
use crate::impact::wall::surface::{Friction, Patch};
use crate::plan::{Geometry, Grid};
use crate::scheme::Layout;
use crate::space::Solid;

/// A run's model in three dimensions.
pub type SolidModel<F, const N: usize> = Model<Solid, Patch<F, N>, N>;

/// What is laid over the sphere.
#[derive(Debug, Clone, Copy)]
pub struct Mesh<'a> {
    /// Grid of splines.
    pub grid: &'a Grid,
    /// Material points.
    pub layout: Layout,
    /// Quarter (x, y >= 0) or half (y >= 0).
    pub geometry: Geometry,
}

impl Mesh<'_> {
    /// Material points by the cell that holds them, with the volumes of the part that is simulated.
    fn inside<const P: usize>(&self, volume: &Volume<P>) -> Vec<Vec<BallPoint>> {
        match self.layout {
            Layout::Fitted => (0..volume.cells())
                .map(|c| {
                    let cell = volume.cell(volume.index(c));
                    clip(cell, self.grid.points_per_direction)
                })
                .collect(),
            Layout::Lattice(count) => placed(volume, lattice::ball(count, self.geometry)),
            Layout::Centred(count) => placed(volume, lattice::centred_ball(count, self.geometry)),
        }
    }

    /// Points that may touch the wall, the lowest at height 0 when they first do; of a lattice with the height of each
    /// over the lowest.
    fn surface<const P: usize>(&self, volume: &Volume<P>) -> Vec<([f64; 3], f64)> {
        match self.layout {
            Layout::Fitted => {
                let points = surface(volume.breaks());
                points.into_iter().map(|x| (x, x[2])).collect()
            }
            Layout::Lattice(count) => over_lowest(lattice::outermost_ball(count, self.geometry)),
            Layout::Centred(count) => {
                over_lowest(lattice::centred_outermost_ball(count, self.geometry))
            }
        }
    }
}

/// Points by the cell that holds them.
fn placed<const P: usize>(volume: &Volume<P>, all: Vec<BallPoint>) -> Vec<Vec<BallPoint>> {
    let mut cells = vec![Vec::new(); volume.cells()];
    for p in all {
        cells[volume.cell_of(p.position)].push(p);
    }
    cells
}

/// Points with the height of each over the lowest.
fn over_lowest(points: Vec<[f64; 3]>) -> Vec<([f64; 3], f64)> {
    let lowest = lowest(&points);
    points.into_iter().map(|x| (x, x[2] - lowest)).collect()
}

fn lowest(points: &[[f64; 3]]) -> f64 {
    points
        .iter()
        .fold(f64::INFINITY, |least, x| least.min(x[2]))
}

/// Lay `mesh` over a unit sphere. `N` must be $(P+1)^3$.
pub fn build<F: Friction, const P: usize, const N: usize>(
    mesh: Mesh,
    matter: Box<dyn Matter<Solid>>,
    friction: F,
    contact_tolerance: f64,
) -> SolidModel<F, N> {
    const { assert!(N == (P + 1) * (P + 1) * (P + 1)) };
    let Mesh { grid, geometry, .. } = mesh;
    let volume = Volume::<P>::new(grid, geometry, mesh.layout);
    let copies = if geometry == Geometry::Half { 2.0 } else { 4.0 };
    let offsets = volume.offsets::<N>();
    let mut points = Points::new(matter, offsets, grid.remedies.own_volume, None);
    let scattered = is_scattered(P, mesh.layout, &grid.remedies);
    let mut all = Vec::new();
    for (c, inside) in mesh.inside(&volume).iter().enumerate() {
        let index = volume.index(c);
        let point = |p: &BallPoint| volume.point(index, p.position, copies * p.volume);
        let cell: Vec<Point<N>> = inside.iter().map(point).collect();
        let node = volume.node(index);
        if scattered {
            all.extend(cell.into_iter().map(|p| (node, p)));
        } else if !cell.is_empty() {
            points.push_cell(node, grid.fine, &cell);
        }
    }
    points.push_scattered(grid.fine, &all);
    let mass = points.nodal_mass(volume.nodes());
    let recip_mass = volume.recip_mass(&mass);
    let mut contact = Patch::new(friction, offsets, contact_tolerance);
    for (x, height) in mesh.surface(&volume) {
        let (first, values) = volume.interpolate(x);
        contact.push(first, values, [x[0], x[1], height]);
    }
    contact.couple(&recip_mass);
    let inward = match mesh.layout {
        // nothing lies beyond its points, so nothing moves the nodes there
        Layout::Centred(count) => lowest(&lattice::centred_outermost_ball(count, geometry)),
        Layout::Fitted | Layout::Lattice(_) => 0.0,
    };
    let marker = |z: f64| {
        let z = z.clamp(inward, 2.0 - inward);
        let (first, values) = volume.interpolate::<N>([0.0, 0.0, z]);
        (0..N).map(|n| (first + offsets[n], values[n])).collect()
    };
    Model {
        points,
        contact,
        recip_mass,
        markers: [0.0, 1.0, 2.0].map(marker),
        places: volume.places(),
        copies,
        mass,
    }
}
