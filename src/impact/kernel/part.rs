//! Part: cells by the step they take, and sweeps over the cells of one level.
//!
//! Cells of level k take steps of $2^{-k}$ of the longest (`impact::local`). They lie level by level in memory, so that a
//! sweep over a level is one over a range.

use crate::impact::kernel::{Cell, Points, Purpose, Sweep, side};
use crate::lanes::Lanes;
use crate::space::{Space, Symmetric};
use std::ops::Range;

/// Cells that a sweep goes over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    All,
    /// Those of a level.
    Level(usize),
}

/// Components of the nodes of a row, at most: cubic splines in three dimensions.
const MOST_SLOPES: usize = 12;

/// Cells of a level.
#[derive(Debug, Clone, Default)]
pub(super) struct Level {
    /// End of its cells, which follow those of the level before.
    pub(super) end: usize,
    /// Their nodes, in order; not listed for the first level.
    pub(super) nodes: Vec<usize>,
}

impl<S: Space, const N: usize> Points<S, N> {
    /// Internal forces of the displacements `u`, written into `force`.
    pub fn sweep(&mut self, purpose: Purpose, u: &[S::Vector], force: &mut [S::Vector]) -> Sweep {
        self.sweep_part(Part::All, purpose, u, force)
    }

    /// Internal forces of a part of the cells; with a level beyond the first, only the entries of its nodes are written.
    pub fn sweep_part(
        &mut self,
        part: Part,
        purpose: Purpose,
        u: &[S::Vector],
        force: &mut [S::Vector],
    ) -> Sweep {
        let cells = self.range(part);
        if self.scattered.is_on() {
            return self.sweep_scattered(cells, purpose, u, force);
        }
        if let Part::Level(level @ 1..) = part {
            return self.sweep_nodes(level, cells, purpose, u, force);
        }
        self.partial.clear();
        self.partial
            .resize(force.len() * S::DIRECTIONS, Lanes::default());
        let sweep = self.pass(cells, purpose, u);
        for (n, force) in force.iter_mut().enumerate() {
            for (k, x) in force.as_mut().iter_mut().enumerate() {
                *x = 0.0 - self.partial[n * S::DIRECTIONS + k].sum();
            }
        }
        sweep
    }

    /// A sweep that touches no more nodes than those of its level.
    fn sweep_nodes(
        &mut self,
        level: usize,
        cells: Range<usize>,
        purpose: Purpose,
        u: &[S::Vector],
        force: &mut [S::Vector],
    ) -> Sweep {
        self.partial
            .resize(force.len() * S::DIRECTIONS, Lanes::default());
        for &n in &self.levels[level].nodes {
            self.partial[n * S::DIRECTIONS..][..S::DIRECTIONS].fill(Lanes::default());
        }
        let sweep = self.pass(cells, purpose, u);
        for &n in &self.levels[level].nodes {
            let lanes = &self.partial[n * S::DIRECTIONS..][..S::DIRECTIONS];
            for (x, lanes) in force[n].as_mut().iter_mut().zip(lanes) {
                *x = 0.0 - lanes.sum();
            }
        }
        sweep
    }

    /// Cells of a part.
    pub(super) fn range(&self, part: Part) -> Range<usize> {
        let end = |level: usize| self.levels.get(level).map_or(self.cells.len(), |l| l.end);
        match part {
            Part::All => 0..self.cells.len(),
            Part::Level(0) => 0..end(0),
            Part::Level(level) => end(level - 1)..end(level),
        }
    }

    /// Blocks of points of a part.
    pub fn blocks_of(&self, part: Part) -> u64 {
        let cells = &self.cells[self.range(part)];
        cells.iter().map(|c| u64::from(c.last - c.first)).sum()
    }

    /// The last level that has cells.
    pub fn deepest(&self) -> usize {
        let filled = |level: &usize| !self.range(Part::Level(*level)).is_empty();
        (0..self.levels.len()).rev().find(filled).unwrap_or(0)
    }

    /// Nodes of the cells of a level beyond the first, in order.
    pub fn nodes_of(&self, level: usize) -> &[usize] {
        &self.levels[level].nodes
    }

    /// Trace of $M^{-1} K$ over the nodes of each cell, up to the material's modulus: volumes times squared gradients of the
    /// nodes' functions in the deformed body over the nodes' masses, times the strength that is left. The squared frequency of
    /// the cell goes with it.
    pub fn steepness(&mut self, u: &[S::Vector], recip_mass: &[S::Vector]) -> Vec<f64> {
        let all = self.slopes(u, recip_mass);
        for (cell, steepness) in self.cells.iter_mut().zip(&all) {
            cell.steepness = *steepness;
        }
        all
    }

    /// Steepness of every cell, with whatever vector instructions the machine has.
    fn slopes(&self, u: &[S::Vector], recip_mass: &[S::Vector]) -> Vec<f64> {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
        {
            // SAFETY: the features were detected on the lines above.
            return unsafe { self.slopes_avx2(u, recip_mass) };
        }
        self.slopes_any(u, recip_mass)
    }

    /// [`Self::slopes`] compiled for 256-bit registers.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn slopes_avx2(&self, u: &[S::Vector], recip_mass: &[S::Vector]) -> Vec<f64> {
        self.slopes_any(u, recip_mass)
    }

    #[inline(always)]
    fn slopes_any(&self, u: &[S::Vector], recip_mass: &[S::Vector]) -> Vec<f64> {
        const { assert!(side(N, S::DIRECTIONS) * S::DIRECTIONS <= MOST_SLOPES) };
        let mut all = Vec::with_capacity(self.cells.len());
        for cell in &self.cells {
            let mut sum = Lanes::default();
            for block in cell.first as usize..cell.last as usize {
                sum += self.squared_slopes(cell, block, u, recip_mass) * self.volumes[block];
            }
            all.push(sum.sum() * cell.strength);
        }
        all
    }

    /// Squared gradients of its nodes' functions in the deformed body over the nodes' masses at the points of a block.
    #[inline(always)]
    fn squared_slopes(
        &self,
        cell: &Cell,
        block: usize,
        u: &[S::Vector],
        recip_mass: &[S::Vector],
    ) -> Lanes {
        let gradient = self.gradient(cell, block, u);
        let recip_j = S::determinant(&gradient).recip();
        let unit = S::Symmetric::identity();
        let pulled = S::first_piola(&unit, &gradient, recip_j, Lanes::splat(1.0));
        let factors = &self.factors[block * Self::STRIDE..][..Self::STRIDE];
        let (first, _) = factors.split_at(2 * Self::SIDE);
        let mut sum = Lanes::default();
        for row in 0..Self::ROWS {
            let weights = S::row(factors, Self::SIDE, row);
            let mut slopes = [Lanes::default(); MOST_SLOPES];
            let slopes = &mut slopes[..Self::SIDE * S::DIRECTIONS];
            S::add_row_force(slopes, &pulled, first, &weights);
            let node = cell.node as usize + self.offsets[row * Self::SIDE];
            let masses = recip_mass[node..][..Self::SIDE].iter();
            for (slope, recip) in slopes.iter().zip(masses.flat_map(AsRef::as_ref)) {
                sum += *slope * *slope * *recip;
            }
        }
        sum
    }

    /// Largest steepness last found among the cells of each level; 0 without cells.
    pub fn steepest(&self) -> Vec<f64> {
        let most = |level| {
            let cells = &self.cells[self.range(Part::Level(level))];
            cells.iter().fold(0.0, |a: f64, c| a.max(c.steepness))
        };
        (0..self.levels.len()).map(most).collect()
    }

    /// Let every cell go to the given level or stay where it is deeper, and with it the cells that share a node with it:
    /// forces in long steps then reach it through a row of cells that feels both, and do not kick the modes that need
    /// short steps. `nodes`: number of all nodes. Returns whether a cell changed its level.
    pub fn deepen(&mut self, levels: &[usize], nodes: usize) -> bool {
        let offsets = self.offsets;
        let mut deepest = vec![0; nodes];
        for (cell, level) in self.cells.iter().zip(levels) {
            for offset in offsets {
                let node = &mut deepest[cell.node as usize + offset];
                *node = (*node).max(*level);
            }
        }
        let near = |cell: &Cell| {
            let around = offsets.iter().map(|o| deepest[cell.node as usize + o]);
            around.max().unwrap_or_default()
        };
        let present = |index: usize| self.levels.partition_point(|l| l.end <= index);
        let mut changed = false;
        let mut placed: Vec<(usize, Cell)> = Vec::with_capacity(self.cells.len());
        for (index, cell) in self.cells.iter().enumerate() {
            let level = near(cell).max(present(index));
            changed |= level > present(index);
            placed.push((level, *cell));
        }
        if !changed {
            return false;
        }
        placed.sort_by_key(|(level, _)| *level);
        let last = placed.last().map_or(0, |(level, _)| *level);
        let end = |level| placed.partition_point(|(l, _)| *l <= level);
        self.levels = (0..=last)
            .map(|level| Level {
                end: end(level),
                nodes: Vec::new(),
            })
            .collect();
        self.cells = placed.into_iter().map(|(_, cell)| cell).collect();
        (0..=last).for_each(|level| self.list_nodes(level));
        true
    }

    /// List the nodes of the cells of a level beyond the first.
    pub(super) fn list_nodes(&mut self, level: usize) {
        if level == 0 {
            return;
        }
        let offsets = self.offsets;
        let cells = &self.cells[self.range(Part::Level(level))];
        let mut nodes: Vec<usize> = cells
            .iter()
            .flat_map(|cell| offsets.map(|offset| cell.node as usize + offset))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        self.levels[level].nodes = nodes;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::kernel::made_of;
    use crate::impact::kernel::passes::tests::{GRID, metal};
    use crate::impact::model;
    use crate::impact::model::AxisymmetricModel;
    use crate::scheme::Layout;

    fn model() -> AxisymmetricModel<9> {
        model::build::<2, 9>(&GRID, Layout::Fitted, made_of(metal()), 1e-9)
    }

    /// The third cell goes two levels down, the twentieth one.
    fn chosen(cells: usize) -> Vec<usize> {
        let level = |c| [0, 2, 1][usize::from(c == 3) + 2 * usize::from(c == 20)];
        (0..cells).map(level).collect()
    }

    #[test]
    fn forces_of_all_levels_add_up_to_those_of_all_cells() {
        let mut model = model();
        let nodes = model.mass.len();
        let u: Vec<[f64; 2]> = (0..nodes)
            .map(|n| [0.0, 1e-3 * (0.7 * n as f64).cos()])
            .collect();
        let mut whole = vec![[0.0; 2]; nodes];
        model.points.sweep(Purpose::Trial, &u, &mut whole);
        let cells = model.points.range(Part::All).len();
        assert!(model.points.deepen(&chosen(cells), nodes));
        assert_eq!(model.points.deepest(), 2);
        let mut sum = vec![[0.0; 2]; nodes];
        for level in 0..3 {
            let mut force = vec![[0.0; 2]; nodes];
            (model.points).sweep_part(Part::Level(level), Purpose::Trial, &u, &mut force);
            for (sum, force) in sum.iter_mut().flatten().zip(force.iter().flatten()) {
                *sum += force;
            }
        }
        let most = whole.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        for (a, b) in whole.iter().flatten().zip(sum.iter().flatten()) {
            assert!((a - b).abs() < 1e-13 * most, "{a} {b}");
        }
    }

    #[test]
    fn neighbours_go_along_and_no_cell_comes_back() {
        let mut model = model();
        let nodes = model.mass.len();
        let cells = model.points.range(Part::All).len();
        let chosen = chosen(cells);
        model.points.deepen(&chosen, nodes);
        // a cell of the second level shares no node with one that takes the longest step but through a row in between
        let deep: Vec<usize> = model.points.nodes_of(2).to_vec();
        assert!(deep.len() > 9, "more than the chosen cell's own nodes");
        let counts = |p: &Points<_, 9>| [0, 1, 2].map(|l| p.range(Part::Level(l)).len());
        let before = counts(&model.points);
        assert!(before[1] > 1 && before[2] > 1);
        assert!(!model.points.deepen(&vec![0; cells], nodes));
        assert_eq!(counts(&model.points), before);
    }

    #[test]
    fn steepness_goes_with_the_inverse_square_of_the_thickness() {
        let mut model = model();
        let flat: Vec<[f64; 2]> = model.places.iter().map(|p| [0.0, -0.9 * p[1]]).collect();
        let still = vec![[0.0; 2]; flat.len()];
        let (rest, thin) = (
            model.points.steepness(&still, &model.recip_mass),
            model.points.steepness(&flat, &model.recip_mass),
        );
        for (rest, thin) in rest.iter().zip(&thin) {
            // between a tenth of the height with the same width, and both
            assert!(thin / rest > 1.0 && thin / rest <= 100.0 * (1.0 + 1e-9));
        }
        assert!(thin.iter().zip(&rest).any(|(t, r)| t / r > 40.0));
    }
}
