//! Set-up of a run: the grid laid over the body, its points, nodal masses and surface points.

pub mod solid;

use crate::impact::grid::section::Section;
use crate::impact::kernel::{Matter, Point, Points};
use crate::impact::points::lattice;
use crate::impact::points::section::{SectionPoint, SurfacePoint, clip_cell, meridian, whole_cell};
use crate::impact::wall::attraction::Attraction;
use crate::impact::wall::contact_point::ContactPoint;
use crate::impact::wall::meridian::{Contact, Wall};
use crate::plan::{Grid, Remedies, graded};
use crate::scheme::Layout;
use crate::shape::Shape;
use crate::space::{Axisymmetric, Space};
use crate::tape::keep_fields;
use std::f64::consts::PI;

/// Distance of surface points over the size of their cell. Halving it from 1 takes most of the staircase out of F as the
/// contact radius grows; halving it again changes little and makes the contact system nearly singular.
const CONTACT_SPACING: f64 = 0.5;

/// A body on its grid, ready to run; lengths in R, density and Young's modulus one.
#[derive(Clone)]
pub struct Model<S: Space, W: Wall<S>, const N: usize> {
    /// Material points.
    pub points: Points<S, N>,
    /// Contact of the surface points with the wall.
    pub contact: W,
    /// Lumped nodal masses.
    pub mass: Vec<f64>,
    /// Reciprocal masses by component; 0 where the component is fixed (radial on the axis) or nothing is there.
    pub recip_mass: Vec<S::Vector>,
    /// Coefficients that make the nodes' functions the reference coordinates.
    pub places: Vec<S::Vector>,
    /// Equal parts of the body, of which the grid holds one that carries the volume of all.
    pub copies: f64,
    /// South pole, centre and north pole of the sphere as interpolations of the nodes.
    pub markers: [Vec<(usize, f64)>; 3],
}

keep_fields!(impl [S: Space, W: Wall<S>, const N: usize] Model<S, W, N>: points, contact;
    rebuilt mass, recip_mass, places, copies, markers);

/// Model of the axisymmetric section.
pub type AxisymmetricModel<const N: usize, A = ()> =
    Model<Axisymmetric, Contact<Axisymmetric, N, A>, N>;

/// The grid of a plan over the unit sphere.
fn section<const P: usize>(grid: &Grid, layout: Layout) -> Section<P> {
    if let Some(around) = layout.around_centre(grid.fine) {
        let out = around.iter().copied().filter(|x| *x >= 0.0).collect();
        return Section::new(out, around.iter().map(|x| 1.0 + x).collect());
    }
    let breaks = |length, to| {
        let length = layout.covering(length, grid.fine);
        graded(length, grid.fine, to, grid.growth, grid.coarse)
    };
    Section::new(
        breaks(1.0, grid.fine_width),
        breaks(grid.shape.height(), grid.fine_depth),
    )
}

/// Lay `grid` over its body, of radius one and the given material, before a wall that does not attract it. `N` must be $(P+1)^2$.
pub fn build<const P: usize, const N: usize>(
    grid: &Grid,
    layout: Layout,
    matter: Box<dyn Matter<Axisymmetric>>,
    contact_tolerance: f64,
) -> AxisymmetricModel<N> {
    build_attracted::<P, N, ()>(grid, layout, matter, contact_tolerance, ())
}

/// [`build()`] before a wall that attracts it.
pub fn build_attracted<const P: usize, const N: usize, A: Attraction>(
    grid: &Grid,
    layout: Layout,
    matter: Box<dyn Matter<Axisymmetric>>,
    contact_tolerance: f64,
    attraction: A,
) -> AxisymmetricModel<N, A> {
    const { assert!(N == (P + 1) * (P + 1)) };
    let mut section = section::<P>(grid, layout);
    let columns = section.r.cells();
    let fitted = |c: usize| {
        let (r, z) = (section.r.cell(c % columns), section.z.cell(c / columns));
        match grid.shape {
            Shape::Sphere => clip_cell(r, z, grid.points_per_direction),
            Shape::Cylinder { .. } => whole_cell(r, z, grid.points_per_direction),
        }
    };
    let clipped: Vec<Vec<SectionPoint>> = match layout {
        Layout::Fitted => (0..section.cells()).map(fitted).collect(),
        Layout::Lattice(count) => placed(&section, lattice::points(count)),
        Layout::Centred(count) => placed(&section, lattice::centred_points(count)),
    };
    let area = |points: &Vec<SectionPoint>| points.iter().map(|p| p.area).sum();
    let areas: Vec<f64> = clipped.iter().map(area).collect();
    section.carry(&areas, grid.remedies.least_fill);
    let mut carried = vec![Vec::new(); section.cells()];
    for (c, points) in clipped.iter().enumerate() {
        let home = section.home(c);
        let point = |p: &SectionPoint| section.point(home, p.r, p.z, 2.0 * PI * p.r * p.area);
        carried[home].extend(points.iter().map(point));
    }
    let remedies = &grid.remedies;
    let own_volume = remedies.own_volume;
    let shocks = remedies.shocks.then_some(grid.dt_share);
    let mut points = Points::new(matter, section.offsets(), own_volume, shocks);
    let filled = carried.iter().enumerate();
    let filled = filled.filter(|(_, cell)| !cell.is_empty());
    if is_scattered(P, layout, remedies) {
        let of = |(c, cell): (usize, &Vec<Point<N>>)| {
            let node = section.first_node(c);
            cell.iter().map(|p| (node, *p)).collect::<Vec<_>>()
        };
        points.push_scattered(grid.fine, &filled.flat_map(of).collect::<Vec<_>>());
    } else {
        for (c, cell) in filled {
            points.push_cell(section.first_node(c), section.least_side(c), cell);
        }
    }
    let mass = points.scaled_mass(section.nodes(), |p| {
        let [r, z, _] = p.position;
        grid.density(section.least_side(section.cell_of(r, z)))
    });
    let recip_mass = recip_mass(&mass, section.r.functions());
    let mut contact = Contact::attracted(section.offsets(), contact_tolerance, attraction);
    let outline = match grid.shape {
        Shape::Sphere => surface(&section, layout),
        Shape::Cylinder { length } => (cylinder(&section, length).into_iter())
            .map(|p| (p, p.z))
            .collect(),
    };
    for (p, height) in outline {
        let (first, values) = section.interpolate::<N>(p.r, p.z);
        contact.push(first, values, height, p.r);
    }
    contact.couple(&recip_mass);
    let places: Vec<[f64; 2]> = (0..section.nodes()).map(|n| section.greville(n)).collect();
    if grid.remedies.is_large() {
        let columns = section.r.functions();
        let held = |(node, point): &(u32, Point<N>)| ContactPoint {
            node: *node as usize,
            values: point.values,
            height: point.position[Axisymmetric::NORMAL],
            radius: point.position[0],
        };
        let held = points.unpacked().iter().map(held).collect();
        contact.hold_interior(held, &places, &recip_mass, columns, grid.fine);
    }
    let offsets: [usize; N] = section.offsets();
    let inward = match layout {
        // nothing lies beyond its points, so nothing moves the nodes there
        Layout::Centred(count) => lattice::centred_outermost(count)[0].z,
        Layout::Fitted | Layout::Lattice(_) => 0.0,
    };
    let marker = |z: f64| {
        let z = z.clamp(inward, grid.shape.height() - inward);
        let (first, values) = section.interpolate::<N>(0.0, z);
        (0..N).map(|n| (first + offsets[n], values[n])).collect()
    };
    Model {
        points,
        contact,
        recip_mass,
        markers: [0.0, 0.5, 1.0].map(|share| marker(share * grid.shape.height())),
        places,
        copies: 1.0,
        mass,
    }
}

/// Whether points are better off without cells: those of a lattice on splines of degree `degree`, whose nodes fill the lanes, where nothing is
/// done with a mean over a cell or its strength.
fn is_scattered(degree: usize, layout: Layout, remedies: &Remedies) -> bool {
    let own = Remedies {
        own_volume: 1.0,
        ..Remedies::NONE
    };
    degree == 3 && layout != Layout::Fitted && *remedies == own
}

/// Points by the cell that holds them.
fn placed<const P: usize>(section: &Section<P>, all: Vec<SectionPoint>) -> Vec<Vec<SectionPoint>> {
    let mut cells = vec![Vec::new(); section.cells()];
    for p in all {
        cells[section.cell_of(p.r, p.z)].push(p);
    }
    cells
}

/// Surface points, two a cell along the exact meridian from pole to pole, with their heights above the wall; of a lattice
/// its outermost points, the lowest of which touch at first.
fn surface<const P: usize>(section: &Section<P>, layout: Layout) -> Vec<(SurfacePoint, f64)> {
    let spacing = |p: SurfacePoint| {
        let size = |(a, b): (f64, f64)| b - a;
        let across = size(section.r.cell(section.r.cell_of(p.r)));
        let up = size(section.z.cell(section.z.cell_of(p.z)));
        CONTACT_SPACING * (across / (1.0 - p.z).abs().max(1e-3)).min(up / p.r.max(1e-3))
    };
    let points = match layout {
        Layout::Fitted => meridian(PI, spacing),
        Layout::Lattice(count) => lattice::outermost(count),
        Layout::Centred(count) => lattice::centred_outermost(count),
    };
    let lowest = points.first().map_or(0.0, |p| p.z);
    points.into_iter().map(|p| (p, p.z - lowest)).collect()
}

/// Surface points of a cylinder, two a cell: from the axis along the end that meets the wall, up its side and back to the axis.
fn cylinder<const P: usize>(section: &Section<P>, length: f64) -> Vec<SurfacePoint> {
    let halves = |cells: Vec<(f64, f64)>| -> Vec<f64> {
        let cells = cells.into_iter();
        cells.flat_map(|(a, b)| [a, 0.5 * (a + b)]).collect()
    };
    let across = halves((0..section.r.cells()).map(|c| section.r.cell(c)).collect());
    let up = halves((0..section.z.cells()).map(|c| section.z.cell(c)).collect());
    let end = across.iter().map(|&r| SurfacePoint { r, z: 0.0 });
    let side = up.iter().map(|&z| SurfacePoint { r: 1.0, z });
    let back = [1.0].into_iter().chain(across.iter().rev().copied());
    let back = back.map(|r| SurfacePoint { r, z: length });
    end.chain(side).chain(back).collect()
}

/// Reciprocal masses; the first column of nodes lies on the axis, where the radial component is fixed.
fn recip_mass(mass: &[f64], columns: usize) -> Vec<[f64; 2]> {
    mass.iter()
        .enumerate()
        .map(|(n, &m)| {
            let w = if m > 0.0 { 1.0 / m } else { 0.0 };
            [if n % columns == 0 { 0.0 } else { w }, w]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::kernel::{Purpose, made_of};
    use crate::material::stress::{Elastic, Moduli};

    type Sphere = Model<Axisymmetric, Contact<Axisymmetric, 9>, 9>;

    fn grid() -> Grid {
        Grid {
            shape: crate::shape::Shape::Sphere,
            degree: 2,
            points_per_direction: 2,
            fine: 0.05,
            fine_width: 0.2,
            fine_depth: 0.1,
            growth: 1.2,
            coarse: 0.15,
            dt_share: 1.0,
            scaled: 0.0,
            remedies: crate::plan::Remedies::NONE,
        }
    }

    fn model() -> Sphere {
        let moduli = Moduli::new(1.0, 0.3);
        build::<2, 9>(&grid(), Layout::Fitted, made_of(Elastic { moduli }), 1e-9)
    }

    /// A smooth displacement field that keeps the axis in place.
    fn field(model: &Sphere, size: f64) -> Vec<[f64; 2]> {
        (0..model.mass.len())
            .map(|n| {
                let fixed = model.recip_mass[n][0] == 0.0;
                let x = n as f64;
                let radial = if fixed { 0.0 } else { size * (1.3 * x).sin() };
                [radial, size * (0.7 * x).cos()]
            })
            .collect()
    }

    #[test]
    fn nodal_masses_sum_to_the_sphere() {
        let mass: f64 = model().mass.iter().sum();
        assert!((mass / (4.0 / 3.0 * PI) - 1.0).abs() < 1e-4, "{mass}");
    }

    #[test]
    fn rigid_lift_makes_no_force_and_any_force_sums_to_zero() {
        let mut m = model();
        let mut force = vec![[0.0; 2]; m.mass.len()];
        let lift = vec![[0.0, 0.37]; m.mass.len()];
        let sweep = m.points.sweep(Purpose::Audit, &lift, &mut force);
        assert!(sweep.elastic.abs() < 1e-13);
        assert!(force.iter().flatten().all(|f| f.abs() < 1e-13));
        let u = field(&m, 1e-3);
        m.points.sweep(Purpose::Step, &u, &mut force);
        let (sum, size) = force
            .iter()
            .fold((0.0, 0.0f64), |(s, m), f| (s + f[1], m.max(f[1].abs())));
        assert!(size > 1e-4 && f64::abs(sum) < 1e-12 * size * m.mass.len() as f64);
    }

    #[test]
    fn forces_are_the_derivative_of_the_energy() {
        let mut m = model();
        let mut force = vec![[0.0; 2]; m.mass.len()];
        let mut scrap = force.clone();
        let u = field(&m, 2e-3);
        m.points.sweep(Purpose::Audit, &u, &mut force);
        let direction = field(&m, 1.0);
        let step = 1e-6;
        let mut energy = |sign: f64| {
            let moved: Vec<[f64; 2]> = u
                .iter()
                .zip(&direction)
                .map(|(u, d)| [u[0] + sign * step * d[1] * d[0], u[1] + sign * step * d[1]])
                .collect();
            m.points.sweep(Purpose::Audit, &moved, &mut scrap).elastic
        };
        let slope = (energy(1.0) - energy(-1.0)) / (2.0 * step);
        let power: f64 = force
            .iter()
            .zip(&direction)
            .map(|(f, d)| f[0] * d[1] * d[0] + f[1] * d[1])
            .sum();
        assert!(
            (slope / -power - 1.0).abs() < 1e-6,
            "{slope} against {power}"
        );
    }

    #[test]
    fn uniform_compression_stores_the_closed_form_energy() {
        // u_z = -0.1 z: uniaxial strain with J = 0.9 everywhere; Greville coefficients make it exactly
        let mut m = model();
        let section = section::<2>(&grid(), Layout::Fitted);
        let mut u = vec![[0.0; 2]; m.mass.len()];
        for j in 0..section.z.functions() {
            for i in 0..section.r.functions() {
                u[j * section.r.functions() + i][1] = -0.1 * section.z.greville(j);
            }
        }
        let mut force = vec![[0.0; 2]; m.mass.len()];
        let sweep = m.points.sweep(Purpose::Audit, &u, &mut force);
        let moduli = Moduli::new(1.0, 0.3);
        let mean = 0.9f64.powf(-2.0 / 3.0) * (2.0 + 0.81) / 3.0;
        let density = 1.5 * moduli.shear * (mean - 1.0) + moduli.volumetric_energy(0.9);
        let volume: f64 = m.mass.iter().sum();
        assert!((sweep.elastic / (density * volume) - 1.0).abs() < 1e-12);
        assert!((sweep.least_j - 0.9).abs() < 1e-13);
    }
}
