//! Set-up of a run: the grid laid over the body, its points, nodal masses and surface points.

use crate::impact::basis::Direction;
use crate::impact::body::{SurfacePoint, clip_cell, meridian};
use crate::impact::contact::{Contact, Wall};
use crate::impact::kernel::{Point, Points};
use crate::material::stress::Constitutive;
use crate::plan::{Grid, graded};
use crate::space::{Axisymmetric, Space};
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
    /// Coefficients that make the nodes' functions the reference coordinates.
    pub places: Vec<S::Vector>,
    /// Equal parts of the body, of which the grid holds one that carries the volume of all.
    pub copies: f64,
    /// South pole, centre and north pole of the sphere as interpolations of the nodes.
    pub markers: [Vec<(usize, f64)>; 3],
}

/// The tensor grid of the axisymmetric section.
struct Section<const P: usize> {
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

    fn node(&self, i: usize, j: usize) -> usize {
        j * self.r.functions() + i
    }

    /// Coefficients that make the functions the coordinates r and z.
    fn places(&self) -> Vec<[f64; 2]> {
        let columns = self.r.functions();
        let place = |n: usize| [self.r.greville(n % columns), self.z.greville(n / columns)];
        (0..columns * self.z.functions()).map(place).collect()
    }

    /// First node of the cell that holds (r, z), and the values of its nodes there.
    fn interpolate<const N: usize>(&self, r: f64, z: f64) -> (usize, [f64; N]) {
        let (i, j) = (self.r.cell_of(r), self.z.cell_of(z));
        let (br, bz) = (self.r.evaluate(i, r), self.z.evaluate(j, z));
        let values = std::array::from_fn(|n| br.value[n % (P + 1)] * bz.value[n / (P + 1)]);
        (self.node(i, j), values)
    }

    /// Material point at (r, z): weights $N_{,r}$, $N_{,z}$, $N/r$ of its nodes.
    fn point<const N: usize>(&self, i: usize, j: usize, r: f64, z: f64, area: f64) -> Point<N> {
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
    material: M,
    contact_tolerance: f64,
) -> Model<Axisymmetric, M, Contact<Axisymmetric, N>, N> {
    const { assert!(N == (P + 1) * (P + 1)) };
    let section = Section::<P>::new(grid);
    let offsets: [usize; N] = std::array::from_fn(|n| section.node(n % (P + 1), n / (P + 1)));
    let nodes = section.r.functions() * section.z.functions();
    let mut mass = vec![0.0; nodes];
    let mut points = Points::new(material, offsets);
    for j in 0..section.z.cells() {
        for i in 0..section.r.cells() {
            let clipped = clip_cell(
                section.r.cell(i),
                section.z.cell(j),
                grid.points_per_direction,
            );
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
    let contact = surface(&section, offsets, &recip_mass, contact_tolerance);
    let marker = |z: f64| {
        let (first, values) = section.interpolate::<N>(0.0, z);
        (0..N).map(|n| (first + offsets[n], values[n])).collect()
    };
    Model {
        points,
        contact,
        recip_mass,
        markers: [marker(0.0), marker(1.0), marker(2.0)],
        places: section.places(),
        copies: 1.0,
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

/// Surface points: two a cell along the exact meridian, pole to pole.
fn surface<const P: usize, const N: usize>(
    section: &Section<P>,
    offsets: [usize; N],
    recip_mass: &[[f64; 2]],
    tolerance: f64,
) -> Contact<Axisymmetric, N> {
    let spacing = |p: SurfacePoint| {
        let size = |(a, b): (f64, f64)| b - a;
        let across = size(section.r.cell(section.r.cell_of(p.r)));
        let up = size(section.z.cell(section.z.cell_of(p.z)));
        CONTACT_SPACING * (across / (1.0 - p.z).abs().max(1e-3)).min(up / p.r.max(1e-3))
    };
    let mut contact = Contact::new(offsets, tolerance);
    for p in meridian(PI, spacing) {
        let (first, values) = section.interpolate::<N>(p.r, p.z);
        contact.push(first, values, p.z, p.r);
    }
    contact.couple(recip_mass);
    contact
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
        build::<Elastic, 2, 9>(&grid(), Elastic { moduli }, 1e-9)
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
