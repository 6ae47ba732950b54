//! Passes of a sweep: a batch of cells is gathered, answered and scattered before the next one.
//!
//! Each pass is a short loop of its own over independent blocks: the chain of one block overlaps with the next, the compiler
//! sees expressions small enough to keep whole registers, and the factors of a batch stay in the nearest cache in between.
//! The weights of the nodes are products of one factor a direction: what the nodes of a row have in common is multiplied
//! once, and a fifth (three dimensions) to a half of the memory is read that the products would take.

use crate::impact::kernel::{Cell, Points, Purpose, Sweep};
use crate::lanes::{Lanes, WIDTH};
use crate::space::{Space, Symmetric};
use std::ops::Range;

/// Sums on the way through the points.
pub(super) struct Tally {
    elastic: f64,
    plastic: Lanes,
    shock: Lanes,
    least: Lanes,
}

impl Tally {
    /// A volume ratio was seen.
    #[inline(always)]
    pub(super) fn see(&mut self, j: Lanes) {
        self.least = self.least.zip(j, |a, b| if b >= a { a } else { b });
    }
}

/// Vector instructions that a sweep is compiled for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vectors {
    /// Those that every machine of its kind has.
    Any,
    /// 256-bit registers.
    #[cfg(target_arch = "x86_64")]
    Avx2,
}

/// Blocks of a batch of cells.
#[inline(always)]
pub(super) fn blocks(cells: &[Cell]) -> impl Iterator<Item = usize> {
    cells
        .iter()
        .flat_map(|cell| cell.first as usize..cell.last as usize)
}

impl<S: Space, const N: usize> Points<S, N> {
    /// The passes over `cells`, forces added to those of the nodes, with whatever vector instructions the machine has.
    pub(super) fn pass(&mut self, cells: Range<usize>, purpose: Purpose, u: &[S::Vector]) -> Sweep {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
        {
            // SAFETY: the features were detected on the lines above.
            return unsafe { self.pass_avx2(cells, purpose, u) };
        }
        self.pass_any(cells, purpose, u, Vectors::Any)
    }

    /// [`Self::pass`] compiled for 256-bit registers.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn pass_avx2(&mut self, cells: Range<usize>, purpose: Purpose, u: &[S::Vector]) -> Sweep {
        self.pass_any(cells, purpose, u, Vectors::Avx2)
    }

    #[inline(always)]
    fn pass_any(
        &mut self,
        cells: Range<usize>,
        purpose: Purpose,
        u: &[S::Vector],
        vectors: Vectors,
    ) -> Sweep {
        let mut tally = Tally {
            least: Lanes::splat(f64::INFINITY),
            plastic: Lanes::default(),
            shock: Lanes::default(),
            elastic: 0.0,
        };
        let scattered = Self::SIDE == WIDTH && self.scattered.is_on();
        let mut from = cells.start;
        while from < cells.end {
            let to = self.batch(from, cells.end);
            match scattered {
                true => self.gather_scattered(from..to, u, &mut tally),
                false => self.gather(from..to, u, &mut tally),
            }
            if self.shock.is_on() && purpose.moves() {
                self.damp(from..to, &mut tally);
            }
            self.respond(from..to, purpose, vectors);
            self.answer(from..to, purpose, &mut tally);
            match scattered {
                true => self.scatter_scattered(from..to),
                false => self.scatter(from..to),
            }
            from = to;
        }
        Sweep {
            elastic: tally.elastic,
            plastic: tally.plastic.sum(),
            shock: tally.shock.sum(),
            least_j: tally.least.min(),
        }
    }

    /// End of the batch of cells that begins at `from`: as many up to `end` as fit into the scratch.
    #[inline(always)]
    fn batch(&self, from: usize, end: usize) -> usize {
        let mut left = self.scratch.len();
        let fits = |cell: &&Cell| {
            let blocks = (cell.last - cell.first) as usize;
            let fits = blocks <= left;
            left = left.saturating_sub(blocks);
            fits
        };
        from + self.cells[from..end].iter().take_while(fits).count()
    }

    /// Deformation gradients and pressures of a batch of cells into the scratch.
    #[inline(always)]
    fn gather(&mut self, cells: Range<usize>, u: &[S::Vector], tally: &mut Tally) {
        let mut at = 0;
        for index in cells {
            let cell = self.cells[index];
            let mut volume = Lanes::default();
            for block in cell.first as usize..cell.last as usize {
                let gradient = self.gradient(&cell, block, u);
                let j = S::determinant(&gradient);
                tally.see(j);
                volume += j * self.volumes[block];
                self.scratch[at].deform(gradient, j);
                at += 1;
            }
            self.cells[index].dilatation = volume.sum() / cell.volume;
        }
    }

    /// Deformation gradients of a block of `cell`.
    #[inline(always)]
    pub(super) fn gradient(&self, cell: &Cell, block: usize, u: &[S::Vector]) -> S::Gradient {
        let factors = &self.factors[block * Self::STRIDE..][..Self::STRIDE];
        let (first, _) = factors.split_at(2 * Self::SIDE);
        let mut gradient = S::identity();
        for row in 0..Self::ROWS {
            let node = cell.node as usize + self.offsets[row * Self::SIDE];
            let weights = S::row(factors, Self::SIDE, row);
            S::add_row(&mut gradient, &u[node..][..Self::SIDE], first, &weights);
        }
        gradient
    }

    /// Viscous stresses of a batch of cells, and the work of those before.
    #[inline(always)]
    fn damp(&mut self, cells: Range<usize>, tally: &mut Tally) {
        let cells = &self.cells[cells];
        let mut at = 0;
        for cell in cells {
            let dt = self.clock - cell.moved;
            for block in cell.first as usize..cell.last as usize {
                let s = &self.scratch[at];
                at += 1;
                let work = self.shock.follow(block, s.j, cell.side, dt);
                tally.shock += work * self.volumes[block] * cell.strength;
            }
        }
    }

    /// Isochoric responses of a batch of cells.
    #[inline(always)]
    fn respond(&mut self, cells: Range<usize>, purpose: Purpose, vectors: Vectors) {
        let cells = &mut self.cells[cells];
        let count = blocks(cells).count();
        let scratch = &mut self.scratch[..count];
        let mut far = false;
        for s in scratch.iter_mut() {
            let root = &mut s.kinematics.recip_cbrt_j;
            *root = root.toward_recip_cbrt(s.j);
            far |= s.j.is_far_from_one();
        }
        for s in scratch.iter_mut() {
            let root = &mut s.kinematics.recip_cbrt_j;
            *root = root.toward_recip_cbrt(s.j);
        }
        if far {
            for s in scratch.iter_mut() {
                s.kinematics.recip_cbrt_j = s.j.recip_cbrt();
            }
        }
        (self.matter).respond(cells, scratch, purpose, self.clock, vectors);
    }

    /// Stresses of a batch of cells: the gradients in the scratch become first Piola-Kirchhoff stresses times volumes.
    #[inline(always)]
    fn answer(&mut self, cells: Range<usize>, purpose: Purpose, tally: &mut Tally) {
        let moduli = self.moduli;
        let own_bulk = 0.5 * moduli.bulk * self.own_volume;
        let share = 1.0 - self.own_volume;
        let mut at = 0;
        for cell in &self.cells[cells] {
            let pressure = moduli.volumetric_stress(cell.dilatation) * share;
            for block in cell.first as usize..cell.last as usize {
                let scratch = &mut self.scratch[at];
                at += 1;
                let volume = self.volumes[block] * cell.strength;
                let (j, answer) = (scratch.j, &scratch.response);
                tally.plastic += answer.dissipation * volume;
                if purpose.sums_energy() {
                    let mut energy = (answer.mean - Lanes::splat(1.0)) * (1.5 * moduli.shear);
                    if self.own_volume > 0.0 {
                        energy += j.map(|j| moduli.volumetric_energy(j)) * self.own_volume;
                    }
                    tally.elastic += (energy * volume).sum();
                }
                let own = (j * j - Lanes::splat(1.0)) * own_bulk;
                let own = self.shock.added_to(own, block);
                let tau = (answer.deviator).shifted(j.mul_add(Lanes::splat(pressure), own));
                scratch.kinematics.gradient = S::first_piola(
                    &tau,
                    &scratch.kinematics.gradient,
                    scratch.kinematics.recip_j,
                    volume,
                );
            }
            if purpose.sums_energy() {
                let energy = moduli.volumetric_energy(cell.dilatation);
                tally.elastic += share * cell.strength * cell.volume * energy;
            }
        }
    }

    /// Forces of the stresses in the scratch, added to the nodes of a batch of cells lane by lane.
    #[inline(always)]
    fn scatter(&mut self, cells: Range<usize>) {
        let mut at = 0;
        for cell in &self.cells[cells] {
            let blocks = cell.first as usize..cell.last as usize;
            for row in 0..Self::ROWS {
                let node = cell.node as usize + self.offsets[row * Self::SIDE];
                let force = &mut self.partial[node * S::DIRECTIONS..][..Self::SIDE * S::DIRECTIONS];
                for (k, block) in blocks.clone().enumerate() {
                    let factors = &self.factors[block * Self::STRIDE..][..Self::STRIDE];
                    let (first, _) = factors.split_at(2 * Self::SIDE);
                    let weights = S::row(factors, Self::SIDE, row);
                    let gradient = &self.scratch[at + k].kinematics.gradient;
                    S::add_row_force(force, gradient, first, &weights);
                }
            }
            at += blocks.len();
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::Vectors;
    use crate::impact::kernel::Part;
    use crate::impact::kernel::*;
    use crate::impact::model;
    use crate::impact::model::solid;
    use crate::impact::wall::surface::Frictionless;
    use crate::material::flow::PerfectlyPlastic;
    use crate::material::stress::{J2, Moduli};
    use crate::plan::{Geometry, Grid, Remedies};
    use crate::scheme::Layout;

    pub type Metal = J2<PerfectlyPlastic>;

    pub const GRID: Grid = Grid {
        shape: crate::shape::Shape::Sphere,
        degree: 2,
        points_per_direction: 2,
        fine: 0.1,
        fine_width: 0.3,
        fine_depth: 0.1,
        growth: 1.3,
        coarse: 0.3,
        dt_share: 1.0,
        scaled: 0.0,
        remedies: Remedies::NONE,
    };

    pub fn metal() -> Metal {
        let moduli = Moduli::new(1.0, 0.35);
        let flow = PerfectlyPlastic { strength: 0.01 };
        J2 { moduli, flow }
    }

    /// Bits of the forces and sums of a few steps at growing displacements.
    fn bits<S: Space, const N: usize>(
        mut points: Points<S, N>,
        nodes: usize,
        mut pass: impl FnMut(&mut Points<S, N>, &[S::Vector]) -> Sweep,
    ) -> Vec<u64> {
        let mut all = Vec::new();
        for step in 1..=3 {
            let mut u = vec![S::Vector::default(); nodes];
            for (n, u) in u.iter_mut().enumerate() {
                for (k, x) in u.as_mut().iter_mut().enumerate() {
                    *x = 2e-3 * f64::from(step) * (0.37 * n as f64 + k as f64).sin();
                }
            }
            points.partial = vec![Lanes::default(); nodes * S::DIRECTIONS];
            let sweep = pass(&mut points, &u);
            assert!(sweep.plastic > 0.0 && sweep.elastic > 0.0);
            all.extend([sweep.plastic, sweep.elastic, sweep.least_j].map(f64::to_bits));
            all.extend(
                points
                    .partial
                    .iter()
                    .flat_map(|l| l.array().map(f64::to_bits)),
            );
        }
        all
    }

    #[test]
    #[cfg(target_arch = "x86_64")]
    fn vector_instructions_do_not_change_a_bit() {
        if !(std::arch::is_x86_feature_detected!("avx2")
            && std::arch::is_x86_feature_detected!("fma"))
        {
            return;
        }
        let flat = || model::build::<2, 9>(&GRID, Layout::Fitted, made_of(metal()), 1e-9);
        let nodes = flat().mass.len();
        let plain = bits(flat().points, nodes, |p, u| {
            p.pass_any(0..p.cells.len(), Purpose::Audit, u, Vectors::Any)
        });
        let vector = bits(flat().points, nodes, |p, u| {
            // SAFETY: the features were detected above.
            unsafe { p.pass_avx2(0..p.cells.len(), Purpose::Audit, u) }
        });
        assert_eq!(plain, vector);
        let mesh = solid::Mesh {
            grid: &GRID,
            layout: Layout::Fitted,
            geometry: Geometry::Quarter,
        };
        let full = || solid::build::<_, 2, 27>(mesh, made_of(metal()), Frictionless, 1e-9);
        let nodes = full().mass.len();
        let plain = bits(full().points, nodes, |p, u| {
            p.pass_any(0..p.cells.len(), Purpose::Audit, u, Vectors::Any)
        });
        let vector = bits(full().points, nodes, |p, u| {
            // SAFETY: the features were detected above.
            unsafe { p.pass_avx2(0..p.cells.len(), Purpose::Audit, u) }
        });
        assert_eq!(plain, vector);
    }

    #[test]
    fn a_look_leaves_the_states_and_finds_what_the_step_then_does() {
        let model = model::build::<2, 9>(&GRID, Layout::Fitted, made_of(metal()), 1e-9);
        let u: Vec<[f64; 2]> = (0..model.mass.len())
            .map(|n| [0.0, 4e-3 * (0.7 * n as f64).cos()])
            .collect();
        let sweep = |points: &mut Points<_, 9>, purpose| {
            let mut force = vec![[0.0; 2]; u.len()];
            let sweep = points.sweep(purpose, &u, &mut force);
            (sweep.plastic, sweep.elastic, force)
        };
        let (mut looked, mut alone) = (model.points.clone(), model.points);
        let seen = sweep(&mut looked, Purpose::Look);
        assert!(seen.0 > 0.0);
        assert_eq!(looked.plastic_strain_volume(), 0.0);
        let step = sweep(&mut looked, Purpose::Audit);
        assert_eq!(step, seen);
        assert_eq!(step, sweep(&mut alone, Purpose::Audit));
        // the step has been taken: a look after it finds no more than rounding
        let after = sweep(&mut looked, Purpose::Look);
        assert!(after.0.abs() < 1e-12 * seen.0, "{}", after.0);
    }

    #[test]
    fn cells_one_by_one_add_up_to_the_whole() {
        let mut model = model::build::<2, 9>(&GRID, Layout::Fitted, made_of(metal()), 1e-9);
        let u: Vec<[f64; 2]> = (0..model.mass.len())
            .map(|n| [0.0, 1e-3 * (0.7 * n as f64).cos()])
            .collect();
        let mut whole = vec![[0.0; 2]; u.len()];
        model.points.sweep(Purpose::Trial, &u, &mut whole);
        let mut sum = vec![[0.0; 2]; u.len()];
        model
            .points
            .one_by_one(Part::All, Purpose::Trial, &u, |_, forces| {
                for (node, force) in forces {
                    for (sum, x) in sum[*node].iter_mut().zip(force) {
                        *sum += x;
                    }
                }
            });
        let most = whole.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        for (a, b) in whole.iter().flatten().zip(sum.iter().flatten()) {
            assert!((a - b).abs() < 1e-13 * most, "{a} {b}");
        }
    }
}
