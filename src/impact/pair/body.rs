//! Body of a pair: one of the two, on a spline grid of its own, laid with the place of first contact at the origin.
//!
//! Both bodies are laid the same way: r from the axis, z from first contact into the body. The second is thus seen upside down, which
//! changes nothing in an isotropic body.

use crate::impact::grid::section::Section;
use crate::impact::kernel::{Matter, Part, Points, Purpose, Sweep};
use crate::impact::points::section::{SectionPoint, clip_cell, whole_cell};
use crate::impact::stepping::erosion::REFRESH;
use crate::impact::stepping::levels::push;
use crate::impact::stepping::stability::StabilityLimit;
use crate::impact::wall::contact_point::ContactPoint;
use crate::plan::graded;
use crate::plan::pair::{BodyGrid, Extent};
use crate::space::{Axisymmetric, Space};
use crate::tape::keep_fields;
use std::f64::consts::PI;

/// Nodes that reach into a cell: quadratic splines.
pub(super) const NODES: usize = 9;
/// Distance of surface points over the size of their cell, as on a rigid wall.
const CONTACT_SPACING: f64 = 0.5;
/// Power iterations for the stable step of the undeformed body.
const FIRST: usize = 60;

/// A point of the surface on its way to the nodes.
pub(super) type Held = ContactPoint<NODES>;

/// One of the two bodies.
#[derive(Clone)]
pub(super) struct Body {
    pub(super) points: Points<Axisymmetric, NODES>,
    pub(super) extent: Extent,
    section: Section<2>,
    pub(super) offsets: [usize; NODES],
    pub(super) mass: Vec<f64>,
    /// Reciprocal masses; 0 where a component is fixed: radial on the axis, all at the back of a layer.
    pub(super) recip_mass: Vec<[f64; 2]>,
    pub(super) whole: f64,
    pub(super) u: Vec<[f64; 2]>,
    pub(super) v: Vec<[f64; 2]>,
    /// Velocities before the last forces.
    pub(super) old: Vec<[f64; 2]>,
    force: Vec<[f64; 2]>,
    limit: StabilityLimit<Axisymmetric>,
    /// Whether the stable step was estimated before.
    known: bool,
    /// Plastic work so far.
    pub(super) plastic: f64,
}

keep_fields!(Body: points, u, v, limit, known, plastic;
    rebuilt extent, section, offsets, mass, recip_mass, whole, old, force);

impl Body {
    /// Lay a grid over a body of `matter` with a density.
    pub(super) fn new(
        grid: &BodyGrid,
        matter: Box<dyn Matter<Axisymmetric>>,
        density: f64,
    ) -> Self {
        let section = section(grid);
        let offsets = section.offsets();
        let mut points = Points::new(matter, offsets, 0.0, None);
        let columns = section.r.cells();
        for c in 0..section.cells() {
            let (r, z) = (section.r.cell(c % columns), section.z.cell(c / columns));
            let inside = quadrature(grid, r, z);
            let point = |p: &SectionPoint| section.point(c, p.r, p.z, 2.0 * PI * p.r * p.area);
            let cell: Vec<_> = inside.iter().map(point).collect();
            if !cell.is_empty() {
                points.push_cell(section.first_node(c), section.least_side(c), &cell);
            }
        }
        let nodes = section.nodes();
        let mass: Vec<f64> = (points.nodal_mass(nodes).iter())
            .map(|m| m * density)
            .collect();
        let functions = section.r.functions();
        let back = match grid.extent {
            Extent::Sphere { .. } => nodes,
            Extent::Layer { .. } => nodes - functions,
        };
        let recip = |(n, m): (usize, &f64)| {
            let w = if *m > 0.0 && n < back { 1.0 / m } else { 0.0 };
            [if n % functions == 0 { 0.0 } else { w }, w]
        };
        let still = vec![[0.0; 2]; nodes];
        Body {
            points,
            extent: grid.extent,
            section,
            offsets,
            recip_mass: mass.iter().enumerate().map(recip).collect(),
            whole: mass.iter().sum(),
            mass,
            u: still.clone(),
            v: still.clone(),
            old: still.clone(),
            force: still,
            limit: StabilityLimit::new(nodes),
            known: false,
            plastic: 0.0,
        }
    }

    /// Let the whole body move towards the other one.
    pub(super) fn start(&mut self, speed: f64) {
        for (v, w) in self.v.iter_mut().zip(&self.recip_mass) {
            v[1] = if w[1] > 0.0 { -speed } else { 0.0 };
        }
    }

    /// Places of surface points along the meridian, from the axis on, as [`Body::place`] takes them.
    pub(super) fn surface(&self) -> Vec<f64> {
        let size = |(a, b): (f64, f64)| b - a;
        match self.extent {
            Extent::Sphere { radius } => {
                let spacing = |angle: f64| {
                    let [r, z] = self.place(angle);
                    let across = size(self.section.r.cell(self.section.r.cell_of(r)));
                    let up = size(self.section.z.cell(self.section.z.cell_of(z)));
                    let slope = (1.0 - z / radius).abs().max(1e-3);
                    CONTACT_SPACING * (across / slope).min(up / (r / radius).max(1e-3)) / radius
                };
                let mut angles = Vec::new();
                let mut angle = 0.0f64;
                while angle <= PI {
                    angles.push(angle);
                    angle += spacing(angle);
                }
                angles
            }
            Extent::Layer { .. } => (0..self.section.r.cells())
                .flat_map(|c| {
                    let (a, b) = self.section.r.cell(c);
                    [a, 0.5 * (a + b)]
                })
                .collect(),
        }
    }

    /// Undeformed (r, z) of a place on the surface: the angle from the pole of a sphere, the distance from the axis on a layer.
    fn place(&self, along: f64) -> [f64; 2] {
        match self.extent {
            Extent::Sphere { radius } => [
                radius * along.sin(),
                2.0 * radius * (0.5 * along).sin().powi(2),
            ],
            Extent::Layer { .. } => [along, 0.0],
        }
    }

    /// Largest place that can face the other body.
    pub(super) fn facing(&self) -> f64 {
        match self.extent {
            Extent::Sphere { .. } => 0.5 * PI,
            Extent::Layer { width, .. } => width,
        }
    }

    /// The surface point at a place.
    pub(super) fn hold(&self, along: f64) -> Held {
        let [r, z] = self.place(along);
        let (node, values) = self.section.interpolate(r, z);
        ContactPoint {
            node,
            values,
            height: z,
            radius: r,
        }
    }

    /// Deformed (r, z) of a surface point.
    pub(super) fn deformed(&self, point: &Held) -> [f64; 2] {
        let [across, up] = [0, 1].map(|axis| point.at(&self.offsets, &self.u, axis));
        [point.radius + across, point.height + up]
    }

    /// Deformed surface, pole to pole of a sphere.
    pub(super) fn outline(&self) -> Vec<(f64, f64)> {
        let places = self.surface();
        let there = places.iter().map(|s| self.deformed(&self.hold(*s)));
        there.map(|[r, z]| (r, z)).collect()
    }

    /// Interpolation of a point on the axis.
    pub(super) fn on_axis(&self, z: f64) -> Held {
        let (node, values) = self.section.interpolate(0.0, z);
        ContactPoint {
            node,
            values,
            height: z,
            radius: 0.0,
        }
    }

    /// Displacement of a point along z.
    pub(super) fn sunk(&self, point: &Held) -> f64 {
        point.at(&self.offsets, &self.u, 1)
    }

    /// Mass average of a nodal field along z.
    pub(super) fn mean(&self, field: &[[f64; 2]]) -> f64 {
        let sum: f64 = (field.iter().zip(&self.mass)).map(|(x, m)| m * x[1]).sum();
        sum / self.whole
    }

    /// Kinetic energy between the velocities before and after the last forces.
    pub(super) fn kinetic(&self) -> f64 {
        let pairs = self.old.iter().zip(&self.v).zip(&self.mass);
        pairs
            .map(|((a, b), m)| 0.5 * m * (a[0] * b[0] + a[1] * b[1]))
            .sum()
    }

    /// Stable time step of the present configuration.
    pub(super) fn stable_step(&mut self) -> f64 {
        let iterations = if self.known { REFRESH } else { FIRST };
        self.known = true;
        let (points, recip_mass) = (&mut self.points, &self.recip_mass);
        (self.limit).estimate(points, Part::All, &self.u, recip_mass, iterations)
    }

    /// Velocities after the internal forces of the present displacements have acted for `dt`.
    pub(super) fn kick(&mut self, purpose: Purpose, dt: f64) -> Sweep {
        let sweep = self.points.sweep(purpose, &self.u, &mut self.force);
        self.plastic += sweep.plastic;
        self.old.copy_from_slice(&self.v);
        for (n, v) in self.v.iter_mut().enumerate() {
            push(v, dt, &self.force[n], &self.recip_mass[n]);
        }
        sweep
    }

    /// Displacements after `dt` at the present velocities.
    pub(super) fn drift(&mut self, dt: f64) {
        for (u, v) in self.u.iter_mut().zip(&self.v) {
            for (u, v) in u.iter_mut().zip(v) {
                *u += dt * v;
            }
        }
        self.points.pass_time(dt);
    }

    /// Memory of points and nodes, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.points.bytes() + 4 * std::mem::size_of_val(&self.u[..])
    }

    /// Distance along z from the present place of first contact to that of a point on the far side of a sphere.
    pub(super) fn height(&self, south: &Held, north: &Held) -> f64 {
        north.height + self.sunk(north) - self.sunk(south)
    }

    /// A point as a map shows it.
    pub(super) fn seen(position: &[f64; 3], reference: &[f64; 3], volume: f64) -> Option<[f64; 3]> {
        Axisymmetric::section(position, reference, volume, 0.0)
    }
}

/// The grid over its body.
fn section(grid: &BodyGrid) -> Section<2> {
    let breaks = |length, to| graded(length, grid.fine, to, grid.growth, grid.coarse);
    let (across, up) = grid.extent.size();
    Section::new(breaks(across, grid.fine_width), breaks(up, grid.fine_depth))
}

/// Quadrature of the part of a cell that lies in the body.
fn quadrature(grid: &BodyGrid, r: (f64, f64), z: (f64, f64)) -> Vec<SectionPoint> {
    let count = grid.points_per_direction;
    match grid.extent {
        Extent::Layer { .. } => whole_cell(r, z, count),
        Extent::Sphere { radius } => {
            let unit = |(a, b): (f64, f64)| (a / radius, b / radius);
            let mut inside = clip_cell(unit(r), unit(z), count);
            for p in &mut inside {
                (p.r, p.z, p.area) = (radius * p.r, radius * p.z, radius * radius * p.area);
            }
            inside
        }
    }
}
