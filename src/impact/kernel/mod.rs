//! Kernel: gathers deformation gradients from the nodes, updates stresses, scatters internal forces. The hot loop.
//!
//! Points of one cell share their nodes, so the nodes' displacements are loaded once a cell and broadcast over blocks of
//! four points. Pressure comes from the mean dilatation of the cell, $\theta = \sum V_0 J / \sum V_0$, with energy
//! $V U(\theta)$ (Nagtegaal, Parks and Rice 1974; Simo, Taylor and Pister 1985): one volumetric constraint a cell, so
//! isochoric plastic flow does not lock, and forces still derive from an energy. Where deformation is large, a share
//! $\alpha$ of the volumetric energy is taken at the points' own J instead,
//! $(1 - \alpha) V U(\theta) + \alpha \sum V_0 U(J)$: alone, the mean leaves a yielding cell free to turn a point inside out.

mod inspect;

pub use inspect::PointView;

use crate::lanes::{Lanes, WIDTH};
use crate::material::stress::{Constitutive, Response};
use crate::space::{Space, Symmetric};

/// A material point before it is packed.
#[derive(Debug, Clone, Copy)]
pub struct Point<const N: usize> {
    /// Reference position.
    pub position: [f64; 3],
    /// Values of its nodes' functions.
    pub values: [f64; N],
    /// Three derivative-like weights a node; their meaning belongs to the space.
    pub weights: [[f64; 3]; N],
    /// Reference volume.
    pub volume: f64,
}

/// A cell of the grid that holds material.
#[derive(Debug, Clone, Copy)]
struct Cell {
    /// First node; the others follow by `Points::offsets`.
    node: u32,
    /// Blocks `first..last`.
    first: u32,
    last: u32,
    /// First of its points in `cold`.
    cold: u32,
    /// Reference volume.
    volume: f64,
    /// Share of the stress that it still carries.
    strength: f64,
}

/// Material points: blocks of four, grouped by cell, structure of arrays.
#[derive(Clone)]
pub struct Points<S: Space, M: Constitutive<S>, const N: usize> {
    cells: Vec<Cell>,
    offsets: [usize; N],
    weights: Vec<[[Lanes; 3]; N]>,
    volumes: Vec<Lanes>,
    states: Vec<M::State>,
    scratch: Vec<(S::Gradient, Lanes)>,
    /// Unpacked points, for snapshots only.
    cold: Vec<(u32, Point<N>)>,
    material: M,
    /// Share of the volumetric stiffness on the points' own volume ratio.
    own_volume: f64,
}

/// Energies seen on the way through the points.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sweep {
    /// Elastic energy (audit sweeps only).
    pub elastic: f64,
    /// Plastic work of this step.
    pub plastic: f64,
    /// Smallest volume ratio J; NaN as soon as one point's is.
    pub least_j: f64,
}

/// What a sweep does besides the forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A time step: states move on.
    Step,
    /// A time step that also sums the elastic energy.
    Audit,
    /// Elastic forces with the states frozen.
    Trial,
}

impl<S: Space, M: Constitutive<S>, const N: usize> Points<S, M, N> {
    /// No points yet, on a grid whose cells reach their nodes by `offsets` from the first. `own_volume`: share of the
    /// volumetric stiffness that acts on each point's own volume ratio.
    pub fn new(material: M, offsets: [usize; N], own_volume: f64) -> Self {
        Points {
            cells: Vec::new(),
            offsets,
            weights: Vec::new(),
            volumes: Vec::new(),
            states: Vec::new(),
            scratch: Vec::new(),
            cold: Vec::new(),
            material,
            own_volume,
        }
    }

    /// Add the points of one cell. A block that is not full is padded with weightless copies of its last point.
    pub fn push_cell(&mut self, node: usize, points: &[Point<N>]) {
        let first = self.weights.len() as u32;
        for block in points.chunks(WIDTH) {
            let mut weights = [[[0.0; WIDTH]; 3]; N];
            let mut volume = [0.0; WIDTH];
            for lane in 0..WIDTH {
                let point = &block[lane.min(block.len() - 1)];
                for (node, factors) in weights.iter_mut().zip(&point.weights) {
                    for (w, x) in node.iter_mut().zip(factors) {
                        w[lane] = *x;
                    }
                }
                volume[lane] = if lane < block.len() {
                    point.volume
                } else {
                    0.0
                };
            }
            self.weights.push(weights.map(|node| node.map(Lanes::new)));
            self.volumes.push(Lanes::new(volume));
            self.states.push(self.material.virgin());
        }
        let last = self.weights.len() as u32;
        self.cells.push(Cell {
            node: node as u32,
            first,
            last,
            cold: self.cold.len() as u32,
            volume: points.iter().map(|p| p.volume).sum(),
            strength: 1.0,
        });
        let blocks = (last - first) as usize;
        if self.scratch.len() < blocks {
            self.scratch
                .resize(blocks, (S::identity(), Lanes::splat(1.0)));
        }
        self.cold.extend(points.iter().map(|p| (node as u32, *p)));
    }

    /// Lumped masses of `nodes` nodes (density one).
    #[must_use]
    pub fn nodal_mass(&self, nodes: usize) -> Vec<f64> {
        let mut mass = vec![0.0; nodes];
        for (node, point) in &self.cold {
            for (offset, value) in self.offsets.iter().zip(&point.values) {
                mass[*node as usize + offset] += point.volume * value;
            }
        }
        mass
    }

    /// Material points (padding not counted).
    pub fn count(&self) -> usize {
        self.cold.len()
    }

    /// First node and unpacked form of every point.
    pub fn unpacked(&self) -> &[(u32, Point<N>)] {
        &self.cold
    }

    /// Way from a cell's first node to its others.
    pub fn offsets(&self) -> [usize; N] {
        self.offsets
    }

    /// Memory of what the loop works on, bytes.
    pub fn bytes(&self) -> usize {
        fn size<T>(column: &[T]) -> usize {
            std::mem::size_of_val(column)
        }
        size(&self.cells)
            + size(&self.weights)
            + size(&self.volumes)
            + size(&self.states)
            + size(&self.scratch)
    }

    /// Internal forces of the displacements `u`, written into `force`, with whatever vector instructions the machine has.
    pub fn sweep(&mut self, purpose: Purpose, u: &[S::Vector], force: &mut [S::Vector]) -> Sweep {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the feature was detected on the line above.
            return unsafe { self.sweep_avx2(purpose, u, force) };
        }
        self.sweep_any(purpose, u, force)
    }

    /// [`Self::sweep`] compiled for 256-bit registers.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn sweep_avx2(&mut self, purpose: Purpose, u: &[S::Vector], force: &mut [S::Vector]) -> Sweep {
        self.sweep_any(purpose, u, force)
    }

    #[inline(always)]
    fn sweep_any(&mut self, purpose: Purpose, u: &[S::Vector], force: &mut [S::Vector]) -> Sweep {
        force.fill(S::Vector::default());
        let mut total = Sweep {
            least_j: f64::INFINITY,
            ..Sweep::default()
        };
        let mut least = Lanes::splat(f64::INFINITY);
        let mut plastic = Lanes::default();
        for index in 0..self.cells.len() {
            let cell = self.cells[index];
            let mean = self.gather(&cell, u, &mut least);
            let moduli = self.material.moduli();
            let pressure = moduli.volumetric_stress(mean) * (1.0 - self.own_volume);
            let own_bulk = 0.5 * moduli.bulk * self.own_volume;
            let mut local = [[Lanes::default(); 3]; N];
            for block in cell.first as usize..cell.last as usize {
                let (f, j) = self.scratch[block - cell.first as usize];
                let volume = self.volumes[block] * cell.strength;
                let recip_j = j.recip();
                let answer = self.respond(purpose, block, &f, j, recip_j);
                // a point turned inside out has no meaningful dissipation
                plastic += j.zip(
                    answer.dissipation * volume,
                    |j, d| if j > 0.0 { d } else { 0.0 },
                );
                if purpose == Purpose::Audit {
                    let energy = (answer.mean - Lanes::splat(1.0)) * (1.5 * moduli.shear)
                        + j.map(|j| moduli.volumetric_energy(j)) * self.own_volume;
                    total.elastic += (energy * volume).sum();
                }
                let own = (j * j - Lanes::splat(1.0)) * own_bulk;
                let tau = answer.deviator.shifted(j * pressure + own);
                let p = S::first_piola(&tau, &f, recip_j, volume);
                for (force, w) in local.iter_mut().zip(&self.weights[block]) {
                    S::add_force(force, &p, w);
                }
            }
            if purpose == Purpose::Audit {
                let share = 1.0 - self.own_volume;
                total.elastic +=
                    share * cell.strength * cell.volume * moduli.volumetric_energy(mean);
            }
            for (a, lanes) in local.iter().enumerate() {
                let node = &mut force[cell.node as usize + self.offsets[a]];
                for (x, lanes) in node.as_mut().iter_mut().zip(lanes) {
                    *x -= lanes.sum();
                }
            }
        }
        total.plastic = plastic.sum();
        total.least_j = least.min();
        total
    }

    /// Deformation gradients of a cell's blocks into the scratch; returns the cell's mean dilatation.
    #[inline(always)]
    fn gather(&mut self, cell: &Cell, u: &[S::Vector], least: &mut Lanes) -> f64 {
        let mut local = [S::Vector::default(); N];
        for (a, x) in local.iter_mut().enumerate() {
            *x = u[cell.node as usize + self.offsets[a]];
        }
        let mut volume = Lanes::default();
        for block in cell.first as usize..cell.last as usize {
            let mut f = S::identity();
            for (u, w) in local.iter().zip(&self.weights[block]) {
                S::add_node(&mut f, u, w);
            }
            let j = S::determinant(&f);
            *least = least.zip(j, |a, b| if b >= a { a } else { b });
            volume += j * self.volumes[block];
            self.scratch[block - cell.first as usize] = (f, j);
        }
        volume.sum() / cell.volume
    }

    /// Isochoric response of one block.
    #[inline(always)]
    fn respond(
        &mut self,
        purpose: Purpose,
        block: usize,
        f: &S::Gradient,
        j: Lanes,
        recip_j: Lanes,
    ) -> Response<S::Symmetric> {
        let recip_cbrt_j = j.recip_cbrt();
        if purpose == Purpose::Trial {
            self.material.trial(f, recip_cbrt_j, &self.states[block])
        } else {
            self.material
                .update(f, recip_j, recip_cbrt_j, &mut self.states[block])
        }
    }
}
