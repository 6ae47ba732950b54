//! Scattered: points without cells, for lattices that hold about one point a cell.
//!
//! Four points that follow each other have no nodes in common there, and a block of a cell would be three quarters empty. So a block is
//! four points of any cells, and on the way from and to the nodes the lanes are not points but the four nodes of a row of cubic splines,
//! which lie side by side. A function is a product of one of each direction, so displacements are first summed over the rows, each with the
//! product of the other directions' functions or of one of their slopes, as whole vectors; the sum over the functions of the first
//! direction or their slopes is taken once a point. What is done with a mean over a cell, its
//! strength or its step has no place here: the volumetric stress is that of each point's own volume ratio.

use super::passes::Tally;
use crate::impact::kernel::{BATCH, Cell, Point, Points, Purpose, Sweep};
use crate::lanes::{Lanes, WIDTH};
use crate::space::{Flat, Space};
use std::ops::Range;

/// Points by their nodes.
#[derive(Debug, Clone, Default)]
pub(super) struct Scattered {
    /// First node of every point, those that fill the last block up too.
    nodes: Vec<u32>,
    /// Values and slopes of the functions of each direction, then 1/r in a curved space, point after point.
    factors: Vec<f64>,
    /// Forces on the nodes, component after component.
    sums: Vec<f64>,
}

impl Scattered {
    /// Whether there are any.
    pub(super) fn is_on(&self) -> bool {
        !self.nodes.is_empty()
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.factors[..]) + size_of_val(&self.sums[..])
    }
}

/// Four functions as factors of the components of their nodes, which lie side by side: entry `k` of all of them is of node `k / components`.
#[inline(always)]
pub fn spread(f: &[f64], components: usize) -> [Lanes; 3] {
    let at = |k: usize| Lanes::each(|lane| f[((WIDTH * k + lane) / components).min(WIDTH - 1)]);
    [at(0), at(1), at(2)]
}

/// Numbers `WIDTH * k` and on.
#[inline(always)]
pub fn loaded(all: &[f64], k: usize) -> Lanes {
    let all = &all[WIDTH * k..][..WIDTH];
    Lanes::new([all[0], all[1], all[2], all[3]])
}

/// Writes numbers `WIDTH * k` and on: one by one, for a copy of slices is a call.
#[inline(always)]
pub fn store(all: &mut [f64], k: usize, lanes: Lanes) {
    let (all, numbers) = (&mut all[WIDTH * k..][..WIDTH], lanes.array());
    all[0] = numbers[0];
    all[1] = numbers[1];
    all[2] = numbers[2];
    all[3] = numbers[3];
}

/// Sums over the nodes of a row of what lies as the components of its nodes, each times `factors`.
#[allow(clippy::needless_range_loop)] // as above
#[inline(always)]
pub fn folded(row: &[Lanes; 3], factors: &[Lanes; 3], components: usize) -> [f64; 3] {
    let mut all = [0.0; 3 * WIDTH];
    for k in 0..components {
        store(&mut all, k, row[k] * factors[k]);
    }
    let mut sums = [0.0; 3];
    for c in 0..components {
        let [n, m] = [components, 2 * components];
        sums[c] = (all[c] + all[n + c]) + (all[m + c] + all[m + n + c]);
    }
    sums
}

/// Weights of a row of nodes: the product of the values of all directions but the first, then with the slope of the second, of the third.
#[inline(always)]
fn weights<S: Space>(f: &[f64], row: usize) -> [f64; 3] {
    if S::DIRECTIONS == 2 {
        return [f[8 + row], f[12 + row], 0.0];
    }
    let (j, k) = (row % WIDTH, row / WIDTH);
    let (y, y_slope, z, z_slope) = (f[8 + j], f[12 + j], f[16 + k], f[20 + k]);
    [y * z, y_slope * z, y * z_slope]
}

impl<S: Space, const N: usize> Points<S, N> {
    /// Add points (first node, point) of cells of the size `side`, four to a block as they follow each other; no cell may be added beside them.
    pub fn push_scattered(&mut self, side: f64, points: &[(usize, Point<N>)]) {
        for batch in points.chunks(BATCH * WIDTH) {
            let (first, cold) = (self.volumes.len() as u32, self.cold.len() as u32);
            for block in batch.chunks(WIDTH) {
                for lane in 0..WIDTH {
                    let (node, point) = &block[lane.min(block.len() - 1)];
                    self.scattered.nodes.push(*node as u32);
                    self.scattered.factors.extend(point.packed::<S>(Self::SIDE));
                }
                let volume = |lane: usize| block.get(lane).map_or(0.0, |(_, p)| p.volume);
                self.volumes.push(Lanes::new([0, 1, 2, 3].map(volume)));
                self.matter.push();
                self.shock.push();
            }
            self.cells.push(Cell {
                node: batch[0].0 as u32,
                first,
                last: self.volumes.len() as u32,
                cold,
                volume: batch.iter().map(|(_, p)| p.volume).sum(),
                side,
                strength: 1.0,
                dilatation: 1.0,
                steepness: 0.0,
                moved: self.clock,
            });
            self.cold
                .extend(batch.iter().map(|(node, p)| (*node as u32, *p)));
        }
        self.levels[0].end = self.cells.len();
    }

    /// Internal forces of the displacements `u`, written into `force`.
    pub(super) fn sweep_scattered(
        &mut self,
        cells: Range<usize>,
        purpose: Purpose,
        u: &[S::Vector],
        force: &mut [S::Vector],
    ) -> Sweep {
        self.scattered.sums.clear();
        self.scattered.sums.resize(force.len() * S::DIRECTIONS, 0.0);
        let sweep = self.pass(cells, purpose, u);
        let force = S::Vector::flat_mut(force);
        for (n, sum) in self.scattered.sums.iter().enumerate() {
            force[n] = 0.0 - sum;
        }
        sweep
    }

    /// Deformation gradients of a block, wherever its points are kept.
    pub(super) fn gradient_of(&self, cell: &Cell, block: usize, u: &[S::Vector]) -> S::Gradient {
        match self.scattered.is_on() {
            true => self.scattered_gradient(block, S::Vector::flat(u)),
            false => self.gradient(cell, block, u),
        }
    }

    #[allow(clippy::needless_range_loop)] // iterators are not always inlined
    #[inline(always)]
    fn scattered_gradient(&self, block: usize, u: &[f64]) -> S::Gradient {
        let mut displacement = [[0.0; 9]; WIDTH];
        for lane in 0..WIDTH {
            displacement[lane] = self.displacement_gradient(block * WIDTH + lane, u);
        }
        S::from_points(&displacement)
    }

    /// Displacement gradient of a point, as [`Space::from_points`] takes it.
    #[allow(clippy::needless_range_loop)] // iterators are not always inlined
    #[inline(always)]
    fn displacement_gradient(&self, point: usize, u: &[f64]) -> [f64; 9] {
        let components = S::DIRECTIONS;
        let f = &self.scattered.factors[point * Self::STRIDE..][..Self::STRIDE];
        let first = self.scattered.nodes[point] as usize;
        let mut sums = [[Lanes::default(); 3]; 3];
        for row in 0..Self::ROWS {
            let at = (first + self.offsets[row * WIDTH]) * components;
            let u = &u[at..][..WIDTH * components];
            let weights = weights::<S>(f, row);
            for k in 0..components {
                let u = loaded(u, k);
                for m in 0..components {
                    sums[m][k] = u.mul_add(Lanes::splat(weights[m]), sums[m][k]);
                }
            }
        }
        let values = spread(&f[..WIDTH], components);
        let slopes = spread(&f[WIDTH..2 * WIDTH], components);
        let mut gradient = [0.0; 9];
        for m in 0..components {
            let factors = if m == 0 { &slopes } else { &values };
            let along = folded(&sums[m], factors, components);
            for c in 0..components {
                gradient[3 * c + m] = along[c];
            }
        }
        if S::CURVED {
            gradient[8] = folded(&sums[0], &values, components)[0] * f[Self::STRIDE - 1];
        }
        gradient
    }

    /// Deformation gradients of a batch of blocks into the scratch.
    #[inline(always)]
    pub(super) fn gather_scattered(
        &mut self,
        cells: Range<usize>,
        u: &[S::Vector],
        tally: &mut Tally,
    ) {
        let u = S::Vector::flat(u);
        let mut at = 0;
        for index in cells {
            let blocks = self.cells[index].first as usize..self.cells[index].last as usize;
            for block in blocks {
                let gradient = self.scattered_gradient(block, u);
                let j = S::determinant(&gradient);
                tally.see(j);
                self.scratch[at].deform(gradient, j);
                at += 1;
            }
        }
    }

    /// Nodal forces of a batch of blocks from the scratch.
    #[allow(clippy::needless_range_loop)] // iterators are not always inlined
    #[inline(always)]
    pub(super) fn scatter_scattered(&mut self, cells: Range<usize>) {
        let mut at = 0;
        for index in cells {
            let blocks = self.cells[index].first as usize..self.cells[index].last as usize;
            for block in blocks {
                let stresses = S::to_points(&self.scratch[at].kinematics.gradient);
                for lane in 0..WIDTH {
                    self.press_nodes(block * WIDTH + lane, &stresses[lane]);
                }
                at += 1;
            }
        }
    }

    /// Adds the forces of a point's stress times its volume to those of its nodes: the counterpart of [`Self::displacement_gradient`].
    #[allow(clippy::needless_range_loop)] // iterators are not always inlined
    #[inline(always)]
    fn press_nodes(&mut self, point: usize, stress: &[f64; 9]) {
        let components = S::DIRECTIONS;
        let f = &self.scattered.factors[point * Self::STRIDE..][..Self::STRIDE];
        let first = self.scattered.nodes[point] as usize;
        let values = spread(&f[..WIDTH], components);
        let slopes = spread(&f[WIDTH..2 * WIDTH], components);
        let of = |column: usize, k: usize| {
            Lanes::each(|lane| stress[3 * ((WIDTH * k + lane) % components) + column])
        };
        let mut terms = [[Lanes::default(); 3]; 3];
        for k in 0..components {
            for m in 0..components {
                let factors = if m == 0 { &slopes } else { &values };
                terms[m][k] = factors[k] * of(m, k);
            }
            if S::CURVED {
                let hoop = stress[8] * f[Self::STRIDE - 1];
                let radial = |lane: usize| {
                    let is_radial = (WIDTH * k + lane).is_multiple_of(components);
                    if is_radial { hoop } else { 0.0 }
                };
                terms[0][k] = values[k].mul_add(Lanes::each(radial), terms[0][k]);
            }
        }
        for row in 0..Self::ROWS {
            let at = (first + self.offsets[row * WIDTH]) * components;
            let force = &mut self.scattered.sums[at..][..WIDTH * components];
            let weights = weights::<S>(f, row);
            for k in 0..components {
                let mut sum = loaded(force, k);
                for m in 0..components {
                    sum = terms[m][k].mul_add(Lanes::splat(weights[m]), sum);
                }
                store(force, k, sum);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::impact::kernel::passes::tests::GRID;
    use crate::impact::kernel::{Point, Points, Purpose, made_of};
    use crate::impact::model::{self, solid};
    use crate::impact::wall::surface::Frictionless;
    use crate::material::stress::{Elastic, Moduli};
    use crate::plan::{Geometry, Grid, Remedies};
    use crate::scheme::Layout;
    use crate::space::{Axisymmetric, Flat, Solid, Space};

    /// The same points one after the other and cell by cell: forces, energies and views of both.
    fn compared<S: Space, const N: usize>(scattered: &mut Points<S, N>, nodes: usize)
    where
        Elastic: crate::material::stress::Constitutive<S>,
    {
        assert!(scattered.scattered.is_on());
        let moduli = Moduli::new(1.0, 0.25);
        let mut cells =
            Points::<S, N>::new(made_of(Elastic { moduli }), scattered.offsets(), 1.0, None);
        let all: Vec<(u32, Point<N>)> = scattered.unpacked().to_vec();
        for (node, point) in &all {
            cells.push_cell(*node as usize, 0.2, &[*point]);
        }
        let mut u = vec![S::Vector::default(); nodes];
        for (n, x) in S::Vector::flat_mut(&mut u).iter_mut().enumerate() {
            *x = 3e-3 * (0.37 * n as f64).sin();
        }
        let mut forces = [
            vec![S::Vector::default(); nodes],
            vec![S::Vector::default(); nodes],
        ];
        let mine = scattered.sweep(Purpose::Audit, &u, &mut forces[0]);
        let theirs = cells.sweep(Purpose::Audit, &u, &mut forces[1]);
        assert!((mine.elastic / theirs.elastic - 1.0).abs() < 1e-12);
        assert!((mine.least_j - theirs.least_j).abs() < 1e-13);
        let [a, b] = forces.each_ref().map(|all| S::Vector::flat(all));
        let most = b.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        assert!(most > 0.0);
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 1e-12 * most, "{a} {b}");
        }
        let (a, b) = (scattered.view(&u), cells.view(&u));
        assert_eq!(a.len(), all.len());
        for (a, b) in a.iter().zip(&b) {
            assert_eq!(a.reference, b.reference);
            assert!(
                (a.von_mises - b.von_mises).abs() < 1e-12
                    && (a.pressure - b.pressure).abs() < 1e-12
            );
        }
    }

    const CUBIC: Grid = Grid {
        degree: 3,
        fine: 0.2,
        fine_width: 1.0,
        fine_depth: 2.0,
        remedies: Remedies {
            own_volume: 1.0,
            ..Remedies::NONE
        },
        ..GRID
    };

    #[test]
    fn forces_and_stresses_are_those_of_points_in_cells() {
        let elastic = || Elastic {
            moduli: Moduli::new(1.0, 0.25),
        };
        // 9 points a diameter: the last block is not full
        let layout = Layout::Centred(9.0);
        let mut flat =
            model::build::<3, 16>(&CUBIC, layout, made_of::<Axisymmetric, _>(elastic()), 1e-9);
        compared(&mut flat.points, flat.mass.len());
        let mesh = solid::Mesh {
            grid: &CUBIC,
            layout,
            geometry: Geometry::Quarter,
        };
        let mut full =
            solid::build::<_, 3, 64>(mesh, made_of::<Solid, _>(elastic()), Frictionless, 1e-9);
        compared(&mut full.points, full.mass.len());
    }
}
