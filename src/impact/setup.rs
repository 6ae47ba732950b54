//! Set-up of a run: the grid laid over the body, its points, nodal masses and surface points.

use crate::impact::basis::Direction;
use crate::impact::body::{SectionPoint, SurfacePoint, clip_cell, meridian};
use crate::impact::contact::{Contact, Wall};
use crate::impact::kernel::{Point, Points};
use crate::impact::lattice;
use crate::material::stress::Constitutive;
use crate::plan::{Grid, graded};
use crate::scheme::Layout;
use crate::space::{Axisymmetric, Space};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Distance of surface points over the size of their cell. Halving it from 1 takes most of the staircase out of F as the
/// contact radius grows; halving it again changes little and makes the contact system nearly singular.
const CONTACT_SPACING: f64 = 0.5;

/// A body on its grid, ready to run; lengths in R, density and Young's modulus one.
#[derive(Clone)]
pub struct Model<S: Space, M: Constitutive<S>, W: Wall<S>, const N: usize> {
    /// Material points.
    pub points: Points<S, M, N>,
    /// Contact of the surface points with the wall.
    pub contact: W,
    /// Lumped nodal masses.
    pub mass: Vec<f64>,
    /// Reciprocal masses by component; 0 where the component is fixed (radial on the axis) or nothing is there.
    pub recip_mass: Vec<S::Vector>,
    /// South pole, centre and north pole of the sphere as interpolations of the nodes.
    pub markers: [Vec<(usize, f64)>; 3],
}

/// The tensor grid of the axisymmetric section.
#[derive(Debug, Clone)]
pub struct Section<const P: usize> {
    r: Direction<P>,
    z: Direction<P>,
}

impl<const P: usize> Section<P> {
    fn new(grid: &Grid) -> Self {
        let breaks = |length, to| graded(length, grid.fine, to, grid.growth, grid.coarse);
        Section {
            r: Direction::new(breaks(1.0, grid.fine_width)),
            z: Direction::new(breaks(2.0, grid.fine_depth)),
        }
    }

    /// Uniform cells of about `size` over a width and a height.
    #[must_use]
    pub fn uniform(size: f64, (width, height): (f64, f64)) -> Self {
        let breaks = |length| graded(length, size, length, 1.0, size);
        Section {
            r: Direction::new(breaks(width)),
            z: Direction::new(breaks(height)),
        }
    }

    /// First node of cell (i, j).
    #[must_use]
    pub fn node(&self, i: usize, j: usize) -> usize {
        j * self.r.functions() + i
    }

    /// Nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.r.functions() * self.z.functions()
    }

    /// Whether a node lies on the axis, where nothing moves sideways.
    #[must_use]
    pub fn is_on_axis(&self, node: usize) -> bool {
        node % self.r.functions() == 0
    }

    /// Way from a cell's first node to its others.
    #[must_use]
    pub fn offsets<const N: usize>(&self) -> [usize; N] {
        std::array::from_fn(|n| self.node(n % (P + 1), n / (P + 1)))
    }

    /// Cell that holds (r, z).
    #[must_use]
    pub fn cell_of(&self, r: f64, z: f64) -> (usize, usize) {
        (self.r.cell_of(r), self.z.cell_of(z))
    }

    /// First node of the cell that holds (r, z), and the values of its nodes there.
    fn interpolate<const N: usize>(&self, r: f64, z: f64) -> (usize, [f64; N]) {
        let (i, j) = (self.r.cell_of(r), self.z.cell_of(z));
        let (br, bz) = (self.r.evaluate(i, r), self.z.evaluate(j, z));
        let values = std::array::from_fn(|n| br.value[n % (P + 1)] * bz.value[n / (P + 1)]);
        (self.node(i, j), values)
    }

    /// Material point at (r, z): weights $N_{,r}$, $N_{,z}$, $N/r$ of its nodes.
    #[must_use]
    pub fn point<const N: usize>(&self, i: usize, j: usize, r: f64, z: f64, area: f64) -> Point<N> {
        let (br, bz) = (self.r.evaluate(i, r), self.z.evaluate(j, z));
        Point {
            position: [r, z, 0.0],
            values: std::array::from_fn(|n| br.value[n % (P + 1)] * bz.value[n / (P + 1)]),
            weights: std::array::from_fn(|n| {
                let (a, b) = (n % (P + 1), n / (P + 1));
                [
                    br.slope[a] * bz.value[b],
                    br.value[a] * bz.slope[b],
                    br.value[a] * bz.value[b] / r,
                ]
            }),
            volume: 2.0 * PI * r * area,
        }
    }
}

/// Lay `grid` over a unit sphere of the given material. `N` must be $(P+1)^2$.
pub fn build<M: Constitutive<Axisymmetric>, const P: usize, const N: usize>(
    grid: &Grid,
    layout: Layout,
    material: M,
    contact_tolerance: f64,
) -> Model<Axisymmetric, M, Contact<Axisymmetric, N>, N> {
    const { assert!(N == (P + 1) * (P + 1)) };
    let section = Section::<P>::new(grid);
    let offsets: [usize; N] = section.offsets();
    let nodes = section.nodes();
    let mut mass = vec![0.0; nodes];
    let mut points = Points::new(material, offsets);
    let lattice = section.lattice(layout);
    for j in 0..section.z.cells() {
        for i in 0..section.r.cells() {
            let clipped = match layout {
                Layout::Fitted => clip_cell(
                    section.r.cell(i),
                    section.z.cell(j),
                    grid.points_per_direction,
                ),
                Layout::Lattice(_) => lattice.get(&(i, j)).cloned().unwrap_or_default(),
            };
            let cell: Vec<Point<N>> = clipped
                .iter()
                .map(|p| section.point(i, j, p.r, p.z, p.area))
                .collect();
            if cell.is_empty() {
                continue;
            }
            let first = section.node(i, j);
            for point in &cell {
                for (n, value) in point.values.iter().enumerate() {
                    mass[first + offsets[n]] += point.volume * value;
                }
            }
            points.push_cell(first, &cell);
        }
    }
    let recip_mass = recip_mass(&mass, section.r.functions());
    let mut contact = Contact::new(offsets, contact_tolerance);
    for (p, height) in section.surface(layout) {
        let (first, values) = section.interpolate::<N>(p.r, p.z);
        contact.push(first, values, height, p.r);
    }
    contact.couple(&recip_mass);
    let marker = |z: f64| {
        let (first, values) = section.interpolate::<N>(0.0, z);
        (0..N).map(|n| (first + offsets[n], values[n])).collect()
    };
    Model {
        points,
        contact,
        recip_mass,
        markers: [marker(0.0), marker(1.0), marker(2.0)],
        mass,
    }
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

/// Greville points of all nodes of a grid: where coefficients that equal a coordinate make the field that coordinate.
#[must_use]
pub fn places(grid: &Grid) -> Vec<[f64; 2]> {
    match grid.degree {
        1 => Section::<1>::new(grid).places(),
        2 => Section::<2>::new(grid).places(),
        _ => Section::<3>::new(grid).places(),
    }
}

impl<const P: usize> Section<P> {
    /// Surface points, two a cell along the exact meridian from pole to pole, with their heights above the wall; of a
    /// lattice its outermost points, the lowest of which touch at first.
    fn surface(&self, layout: Layout) -> Vec<(SurfacePoint, f64)> {
        let spacing = |p: SurfacePoint| {
            let size = |(a, b): (f64, f64)| b - a;
            let across = size(self.r.cell(self.r.cell_of(p.r)));
            let up = size(self.z.cell(self.z.cell_of(p.z)));
            CONTACT_SPACING * (across / (1.0 - p.z).abs().max(1e-3)).min(up / p.r.max(1e-3))
        };
        let points = match layout {
            Layout::Fitted => meridian(PI, spacing),
            Layout::Lattice(count) => lattice::outermost(count),
        };
        let lowest = points.first().map_or(0.0, |p| p.z);
        points.into_iter().map(|p| (p, p.z - lowest)).collect()
    }

    /// Lattice points by cell; none for another layout.
    fn lattice(&self, layout: Layout) -> BTreeMap<(usize, usize), Vec<SectionPoint>> {
        let mut cells: BTreeMap<_, Vec<SectionPoint>> = BTreeMap::new();
        if let Layout::Lattice(count) = layout {
            for p in lattice::points(count) {
                let cell = (self.r.cell_of(p.r), self.z.cell_of(p.z));
                cells.entry(cell).or_default().push(p);
            }
        }
        cells
    }

    /// Greville points of all nodes.
    fn places(&self) -> Vec<[f64; 2]> {
        let row =
            |j| (0..self.r.functions()).map(move |i| [self.r.greville(i), self.z.greville(j)]);
        (0..self.z.functions()).flat_map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::kernel::Purpose;
    use crate::material::stress::{Elastic, Moduli};

    type Sphere = Model<Axisymmetric, Elastic, Contact<Axisymmetric, 9>, 9>;

    fn grid() -> Grid {
        Grid {
            degree: 2,
            points_per_direction: 2,
            fine: 0.05,
            fine_width: 0.2,
            fine_depth: 0.1,
            growth: 1.2,
            coarse: 0.15,
            dt_share: 1.0,
        }
    }

    fn model() -> Sphere {
        let moduli = Moduli::new(1.0, 0.3);
        build::<Elastic, 2, 9>(&grid(), Layout::Fitted, Elastic { moduli }, 1e-9)
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
        let section = Section::<2>::new(&grid());
        let mut u = vec![[0.0; 2]; m.mass.len()];
        for j in 0..section.z.functions() {
            for i in 0..section.r.functions() {
                u[section.node(i, j)][1] = -0.1 * section.z.greville(j);
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
