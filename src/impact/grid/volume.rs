//! Volume: the tensor grid of three directions over a quarter or half of the sphere.

use super::basis::Direction;
use crate::impact::kernel::Point;
use crate::plan::{Geometry, Grid, graded};
use crate::scheme::Layout;

/// Tensor grid of degree `P` in (x, y, z); planes of symmetry at x = 0 (a quarter) and y = 0.
#[derive(Debug, Clone)]
pub struct Volume<const P: usize> {
    axes: [Direction<P>; 3],
    breaks: [Vec<f64>; 3],
    geometry: Geometry,
}

impl<const P: usize> Volume<P> {
    /// The grid of a plan.
    #[must_use]
    pub fn new(grid: &Grid, geometry: Geometry, layout: Layout) -> Self {
        if let Some(around) = layout.around_centre(grid.fine) {
            let side: Vec<f64> = around.iter().copied().filter(|x| *x >= 0.0).collect();
            let along = match geometry {
                Geometry::Half => around.clone(),
                _ => side.clone(),
            };
            let up = around.iter().map(|x| 1.0 + x).collect();
            return Self::on([along, side, up], geometry);
        }
        let lay = |length, to| {
            let length = layout.covering(length, grid.fine);
            graded(length, grid.fine, to, grid.growth, grid.coarse)
        };
        let side = lay(1.0, grid.fine_width);
        let mirrored = || side.iter().skip(1).rev().map(|x| -x);
        let along = if geometry == Geometry::Half {
            mirrored().chain(side.iter().copied()).collect()
        } else {
            side.clone()
        };
        Self::on([along, side, lay(2.0, grid.fine_depth)], geometry)
    }

    /// The grid of these breakpoints.
    fn on(breaks: [Vec<f64>; 3], geometry: Geometry) -> Self {
        Volume {
            axes: breaks.clone().map(Direction::new),
            breaks,
            geometry,
        }
    }

    /// Breakpoints of the three directions.
    #[must_use]
    pub fn breaks(&self) -> [&[f64]; 3] {
        self.breaks.each_ref().map(Vec::as_slice)
    }

    fn functions(&self) -> [usize; 3] {
        self.axes.each_ref().map(Direction::functions)
    }

    /// Nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.functions().iter().product()
    }

    /// Cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.axes.iter().map(Direction::cells).product()
    }

    /// Column, row and layer of cell `c`.
    #[must_use]
    pub fn index(&self, c: usize) -> [usize; 3] {
        let [nx, ny] = [0, 1].map(|k| self.axes[k].cells());
        [c % nx, c / nx % ny, c / nx / ny]
    }

    /// Cell that holds `x`.
    #[must_use]
    pub fn cell_of(&self, x: [f64; 3]) -> usize {
        let [i, j, k] = [0, 1, 2].map(|k| self.axes[k].cell_of(x[k]));
        (k * self.axes[1].cells() + j) * self.axes[0].cells() + i
    }

    /// Extent of a cell.
    #[must_use]
    pub fn cell(&self, index: [usize; 3]) -> [(f64, f64); 3] {
        [0, 1, 2].map(|k| self.axes[k].cell(index[k]))
    }

    /// Node at a column, row and layer of nodes; of a cell's own, the first of its nodes.
    #[must_use]
    pub fn node(&self, [i, j, k]: [usize; 3]) -> usize {
        let [nx, ny, _] = self.functions();
        (k * ny + j) * nx + i
    }

    /// Nodes of a cell, from its first.
    #[must_use]
    pub fn offsets<const N: usize>(&self) -> [usize; N] {
        std::array::from_fn(|n| self.node(split::<P>(n)))
    }

    /// First node of the cell that holds `x`, and the values of its nodes there.
    #[must_use]
    pub fn interpolate<const N: usize>(&self, x: [f64; 3]) -> (usize, [f64; N]) {
        let index = self.index(self.cell_of(x));
        (self.node(index), self.point(index, x, 0.0).values)
    }

    /// Material point at `x` in cell `index`: weights are the gradients of its nodes' functions.
    #[must_use]
    pub fn point<const N: usize>(&self, index: [usize; 3], x: [f64; 3], volume: f64) -> Point<N> {
        let b = [0, 1, 2].map(|k| self.axes[k].evaluate(index[k], x[k]));
        let weight = |n: usize, slope: usize| -> f64 {
            let a = split::<P>(n);
            let factor = |k: usize| {
                if k == slope {
                    b[k].slope[a[k]]
                } else {
                    b[k].value[a[k]]
                }
            };
            factor(0) * factor(1) * factor(2)
        };
        Point {
            position: x,
            values: std::array::from_fn(|n| weight(n, 3)),
            weights: std::array::from_fn(|n| [weight(n, 0), weight(n, 1), weight(n, 2)]),
            factors: b.map(|b| [b.value, b.slope]),
            volume,
        }
    }

    /// Coefficients that make the functions the coordinates.
    #[must_use]
    pub fn places(&self) -> Vec<[f64; 3]> {
        let [nx, ny, _] = self.functions();
        (0..self.nodes())
            .map(|n| {
                let index = [n % nx, n / nx % ny, n / nx / ny];
                [0, 1, 2].map(|k| self.axes[k].greville(index[k]))
            })
            .collect()
    }

    /// Reciprocal masses; nodes on a plane of symmetry keep to it.
    #[must_use]
    pub fn recip_mass(&self, mass: &[f64]) -> Vec<[f64; 3]> {
        let [nx, ny, _] = self.functions();
        let quarter = self.geometry != Geometry::Half;
        mass.iter()
            .enumerate()
            .map(|(n, &m)| {
                let w = if m > 0.0 { 1.0 / m } else { 0.0 };
                let free = |fixed: bool| if fixed { 0.0 } else { w };
                [free(quarter && n % nx == 0), free(n / nx % ny == 0), w]
            })
            .collect()
    }
}

/// Position of node `n` within its cell.
fn split<const P: usize>(n: usize) -> [usize; 3] {
    let side = P + 1;
    [n % side, n / side % side, n / side / side]
}
