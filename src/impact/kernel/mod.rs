//! Kernel: gathers deformation gradients from the nodes, updates stresses, scatters internal forces. The hot loop.
//!
//! Points of one cell share their nodes, so the nodes' displacements are loaded once a cell and broadcast over blocks of
//! four points. Pressure comes from the mean dilatation of the cell, $\theta = \sum V_0 J / \sum V_0$, with energy
//! $V U(\theta)$ (Nagtegaal, Parks and Rice 1974; Simo, Taylor and Pister 1985): one volumetric constraint a cell, so
//! isochoric plastic flow does not lock, and forces still derive from an energy. Where deformation is large, a share
//! $\alpha$ of the volumetric energy is taken at the points' own J instead,
//! $(1 - \alpha) V U(\theta) + \alpha \sum V_0 U(J)$: alone, the mean leaves a yielding cell free to turn a point inside out.

mod inspect;
mod matter;
mod part;
mod passes;
mod scattered;
mod shock;

pub use inspect::{PointView, Warmth};
pub use matter::{Matter, made_of};
use part::Level;
pub use part::Part;
use scattered::Scattered;
pub use scattered::{folded, loaded, spread, store};
use shock::Shock;

use crate::lanes::{Lanes, WIDTH};
use crate::material::stress::{Kinematics, Moduli, Response};
use crate::space::{Space, Symmetric};

/// Blocks that a pass works on before the next one follows: their weights stay in the nearest cache in between.
const BATCH: usize = 16;

/// A material point before it is packed.
#[derive(Debug, Clone, Copy)]
pub struct Point<const N: usize> {
    /// Reference position.
    pub position: [f64; 3],
    /// Values of its nodes' functions.
    pub values: [f64; N],
    /// Three derivative-like weights a node; their meaning belongs to the space.
    pub weights: [[f64; 3]; N],
    /// Values and slopes of the functions of each direction, of which values and weights are products; in a curved space
    /// the third holds $1/r$.
    pub factors: [[[f64; 4]; 2]; 3],
    /// Reference volume.
    pub volume: f64,
}

impl<const N: usize> Point<N> {
    /// The factors in the order in which [`Space::row`] takes them.
    fn packed<S: Space>(&self, side: usize) -> impl Iterator<Item = f64> {
        let splines = self.factors.iter().take(S::DIRECTIONS).flatten();
        let functions = splines.flat_map(move |all| all.iter().take(side));
        functions
            .chain(self.factors[2][0].iter().take(usize::from(S::CURVED)))
            .copied()
    }
}

/// A cell of the grid that holds material.
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    /// First node; the others follow by `Points::offsets`.
    node: u32,
    /// Blocks `first..last`.
    first: u32,
    last: u32,
    /// First of its points in `cold`.
    cold: u32,
    /// Reference volume.
    volume: f64,
    /// Its shorter side before deformation.
    side: f64,
    /// Share of the stress that it still carries.
    strength: f64,
    /// Mean dilatation of the last sweep.
    dilatation: f64,
    /// What [`Points::steepness`] found last.
    steepness: f64,
    /// When the states of its points last moved on.
    moved: f64,
}

/// What the passes of a sweep hand on of one block.
#[derive(Clone, Copy)]
pub struct Scratch<S: Space> {
    /// Deformation; its gradient becomes the stress times the volume.
    kinematics: Kinematics<S>,
    /// Volume ratio J.
    j: Lanes,
    /// Isochoric response.
    response: Response<S::Symmetric>,
}

/// The number of which `nodes` is the power `directions`.
const fn side(nodes: usize, directions: usize) -> usize {
    let mut side: usize = 1;
    while side.pow(directions as u32) < nodes {
        side += 1;
    }
    side
}

impl<S: Space> Scratch<S> {
    /// A deformation, with the first guess of what is asked of its volume ratio.
    #[inline(always)]
    fn deform(&mut self, gradient: S::Gradient, j: Lanes) {
        self.j = j;
        self.kinematics = Kinematics {
            gradient,
            recip_j: j.recip(),
            recip_cbrt_j: j.near_recip_cbrt(),
        };
    }

    fn virgin() -> Self {
        let one = Lanes::splat(1.0);
        Scratch {
            kinematics: Kinematics {
                gradient: S::identity(),
                recip_j: one,
                recip_cbrt_j: one,
            },
            j: one,
            response: Response {
                deviator: S::Symmetric::identity(),
                mean: one,
                dissipation: Lanes::default(),
            },
        }
    }
}

/// Material points: blocks of four, grouped by cell, structure of arrays.
pub struct Points<S: Space, const N: usize> {
    cells: Vec<Cell>,
    /// Cells by the step they take; never empty.
    levels: Vec<Level>,
    offsets: [usize; N],
    /// Factors of the weights, [`Self::STRIDE`] a block.
    factors: Vec<Lanes>,
    /// Points without cells, in place of the factors; holds nothing when off.
    scattered: Scattered,
    volumes: Vec<Lanes>,
    matter: Box<dyn Matter<S>>,
    /// Viscous stress in shocks; holds nothing when off.
    shock: Shock,
    scratch: Vec<Scratch<S>>,
    /// Forces on the nodes, not yet summed over the lanes: once a sweep instead of once a cell.
    partial: Vec<Lanes>,
    /// Unpacked points, for snapshots only.
    cold: Vec<(u32, Point<N>)>,
    moduli: Moduli,
    /// Share of the volumetric stiffness on the points' own volume ratio.
    own_volume: f64,
    /// Time, R/c0.
    clock: f64,
}

impl<S: Space, const N: usize> Clone for Points<S, N> {
    fn clone(&self) -> Self {
        Points {
            cells: self.cells.clone(),
            levels: self.levels.clone(),
            offsets: self.offsets,
            factors: self.factors.clone(),
            scattered: self.scattered.clone(),
            volumes: self.volumes.clone(),
            matter: self.matter.copy(),
            shock: self.shock.clone(),
            scratch: self.scratch.clone(),
            partial: self.partial.clone(),
            cold: self.cold.clone(),
            moduli: self.moduli,
            own_volume: self.own_volume,
            clock: self.clock,
        }
    }
}

/// Energies seen on the way through the points.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sweep {
    /// Elastic energy (audit sweeps only).
    pub elastic: f64,
    /// Plastic work of this step.
    pub plastic: f64,
    /// Work of the viscous stress in the step before.
    pub shock: f64,
    /// Smallest volume ratio J; NaN as soon as one point's is.
    pub least_j: f64,
}

/// What a sweep does besides the forces. Points yield in the time since their states last moved on; a sweep that only looks
/// leaves that to the next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A time step: states move on.
    Step,
    /// A time step that also sums the elastic energy.
    Audit,
    /// Forces and energies as [`Purpose::Audit`] would find them, with the states left as they are.
    Look,
    /// Elastic forces with the states frozen.
    Trial,
}

impl Purpose {
    /// Whether states move on.
    fn moves(self) -> bool {
        matches!(self, Purpose::Step | Purpose::Audit)
    }

    /// Whether the elastic energy is summed.
    fn sums_energy(self) -> bool {
        matches!(self, Purpose::Audit | Purpose::Look)
    }
}

impl<S: Space, const N: usize> Points<S, N> {
    /// Functions a direction that reach into a cell.
    const SIDE: usize = side(N, S::DIRECTIONS);
    /// Rows of nodes a cell.
    const ROWS: usize = N / Self::SIDE;
    /// Factors a point.
    const STRIDE: usize = 2 * Self::SIDE * S::DIRECTIONS + S::CURVED as usize;

    /// No points yet, on a grid whose cells reach their nodes by `offsets` from the first. `own_volume`: share of the
    /// volumetric stiffness that acts on each point's own volume ratio. `shocks`: share of the
    /// stable time step that is taken, for a viscous stress in shocks; none without.
    pub fn new(
        matter: Box<dyn Matter<S>>,
        offsets: [usize; N],
        own_volume: f64,
        shocks: Option<f64>,
    ) -> Self {
        let moduli = matter.moduli();
        let dilatational = moduli.dilatational_speed(1.0);
        Points {
            shock: Shock::new(dilatational, shocks),
            cells: Vec::new(),
            levels: vec![Level::default()],
            offsets,
            factors: Vec::new(),
            scattered: Scattered::default(),
            volumes: Vec::new(),
            matter,
            partial: Vec::new(),
            scratch: vec![Scratch::virgin(); BATCH],
            cold: Vec::new(),
            moduli,
            own_volume,
            clock: 0.0,
        }
    }

    /// Add the points of one cell whose shorter side is `side`. A block that is not full is padded with weightless copies of its last point.
    pub fn push_cell(&mut self, node: usize, side: f64, points: &[Point<N>]) {
        let first = self.volumes.len() as u32;
        for block in points.chunks(WIDTH) {
            let point = |lane: usize| &block[lane.min(block.len() - 1)];
            let packed: Vec<[f64; WIDTH]> = {
                let mut columns = [0, 1, 2, 3].map(|lane| point(lane).packed::<S>(Self::SIDE));
                let rows = (0..Self::STRIDE)
                    .map(|_| columns.each_mut().map(|c| c.next().unwrap_or_default()));
                rows.collect()
            };
            self.factors.extend(packed.into_iter().map(Lanes::new));
            let volume = |lane: usize| block.get(lane).map_or(0.0, |p| p.volume);
            self.volumes.push(Lanes::new([0, 1, 2, 3].map(volume)));
            self.matter.push();
            self.shock.push();
        }
        let last = self.volumes.len() as u32;
        self.cells.push(Cell {
            node: node as u32,
            first,
            last,
            cold: self.cold.len() as u32,
            volume: points.iter().map(|p| p.volume).sum(),
            side,
            strength: 1.0,
            dilatation: 1.0,
            steepness: 0.0,
            moved: self.clock,
        });
        self.levels[0].end = self.cells.len();
        let blocks = (last - first) as usize;
        if self.scratch.len() < blocks {
            self.scratch.resize(blocks, Scratch::virgin());
        }
        self.cold.extend(points.iter().map(|p| (node as u32, *p)));
    }

    /// Lumped masses of `nodes` nodes at density one.
    #[must_use]
    pub fn nodal_mass(&self, nodes: usize) -> Vec<f64> {
        self.scaled_mass(nodes, |_| 1.0)
    }

    /// The same at a `density` that differs from point to point; of the whole the mean stays one.
    #[must_use]
    pub fn scaled_mass(&self, nodes: usize, density: impl Fn(&Point<N>) -> f64) -> Vec<f64> {
        let (mut whole, mut volume) = (0.0, 0.0);
        for (_, point) in &self.cold {
            whole += point.volume * density(point);
            volume += point.volume;
        }
        let share = volume / whole;
        let mut mass = vec![0.0; nodes];
        for (node, point) in &self.cold {
            let weight = point.volume * (share * density(point));
            for (offset, value) in self.offsets.iter().zip(&point.values) {
                mass[*node as usize + offset] += weight * value;
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

    /// Let `dt` pass: displacements are now those at its end.
    pub fn pass_time(&mut self, dt: f64) {
        self.clock += dt;
    }

    /// Memory of what the loop works on, bytes.
    pub fn bytes(&self) -> usize {
        fn size<T>(column: &[T]) -> usize {
            std::mem::size_of_val(column)
        }
        size(&self.cells)
            + size(&self.factors)
            + self.scattered.bytes()
            + size(&self.volumes)
            + self.matter.bytes()
            + self.shock.bytes()
            + size(&self.scratch)
            + size(&self.partial)
    }
}
