//! Section: the tensor grid over the axisymmetric half plane, and which cell carries what.

use super::basis::Direction;
use super::homes::homes;
use crate::impact::kernel::Point;
use crate::plan::graded;

/// Tensor grid of degree `P` in (r, z).
#[derive(Debug, Clone)]
pub struct Section<const P: usize> {
    /// Radial direction.
    pub r: Direction<P>,
    /// Axial direction.
    pub z: Direction<P>,
    /// Cell whose polynomials carry the material of each cell.
    home: Vec<usize>,
}

impl<const P: usize> Section<P> {
    /// Grid on the given breakpoints; every cell carries its own material.
    #[must_use]
    pub fn new(r: Vec<f64>, z: Vec<f64>) -> Self {
        let (r, z) = (Direction::new(r), Direction::new(z));
        let home = (0..r.cells() * z.cells()).collect();
        Section { r, z, home }
    }

    /// Uniform cells of `size` over at least a width and a height.
    #[must_use]
    pub fn uniform(size: f64, (width, height): (f64, f64)) -> Self {
        let breaks = |length: f64| {
            let length = size * (length / size - 1e-9).ceil();
            graded(length, size, length, 1.0, size)
        };
        Section::new(breaks(width), breaks(height))
    }

    /// Whether a node lies on the axis, where nothing moves sideways.
    #[must_use]
    pub fn is_on_axis(&self, node: usize) -> bool {
        node.is_multiple_of(self.r.functions())
    }

    /// Extends full cells over their neighbours that hold less than `least_fill` of their area, given the area of material in
    /// each cell.
    pub fn carry(&mut self, area: &[f64], least_fill: f64) {
        let size = |(a, b): (f64, f64)| b - a;
        let columns = self.r.cells();
        let share = |(c, area): (usize, &f64)| {
            area / (size(self.r.cell(c % columns)) * size(self.z.cell(c / columns)))
        };
        let fill: Vec<f64> = area.iter().enumerate().map(share).collect();
        self.home = homes(&fill, columns, least_fill);
    }

    /// Cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.home.len()
    }

    /// Cell that holds (r, z).
    #[must_use]
    pub fn cell_of(&self, r: f64, z: f64) -> usize {
        self.z.cell_of(z) * self.r.cells() + self.r.cell_of(r)
    }

    /// Shorter side of cell `c`.
    #[must_use]
    pub fn least_side(&self, c: usize) -> f64 {
        let columns = self.r.cells();
        let size = |(a, b): (f64, f64)| b - a;
        size(self.r.cell(c % columns)).min(size(self.z.cell(c / columns)))
    }

    /// Cell that carries the material of cell `c`.
    #[must_use]
    pub fn home(&self, c: usize) -> usize {
        self.home[c]
    }

    /// Nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.r.functions() * self.z.functions()
    }

    /// First node of cell `c`.
    #[must_use]
    pub fn first_node(&self, c: usize) -> usize {
        let columns = self.r.cells();
        (c / columns) * self.r.functions() + c % columns
    }

    /// Nodes of a cell, from its first.
    #[must_use]
    pub fn offsets<const N: usize>(&self) -> [usize; N] {
        std::array::from_fn(|n| (n / (P + 1)) * self.r.functions() + n % (P + 1))
    }

    /// Greville abscissae (r, z) of node `n`: as coefficients they make the position itself.
    #[must_use]
    pub fn greville(&self, n: usize) -> [f64; 2] {
        let columns = self.r.functions();
        [self.r.greville(n % columns), self.z.greville(n / columns)]
    }

    /// First node of the cell that carries (r, z), and the values of its nodes there.
    #[must_use]
    pub fn interpolate<const N: usize>(&self, r: f64, z: f64) -> (usize, [f64; N]) {
        let home = self.home[self.cell_of(r, z)];
        (self.first_node(home), self.point(home, r, z, 0.0).values)
    }

    /// Material point at (r, z) carried by `cell`: weights $N_{,r}$, $N_{,z}$, $N/r$ of its nodes.
    #[must_use]
    pub fn point<const N: usize>(&self, cell: usize, r: f64, z: f64, volume: f64) -> Point<N> {
        let columns = self.r.cells();
        let br = self.r.evaluate(cell % columns, r);
        let bz = self.z.evaluate(cell / columns, z);
        let split = |n: usize| (n % (P + 1), n / (P + 1));
        Point {
            position: [r, z, 0.0],
            values: std::array::from_fn(|n| br.value[split(n).0] * bz.value[split(n).1]),
            weights: std::array::from_fn(|n| {
                let (a, b) = split(n);
                [
                    br.slope[a] * bz.value[b],
                    br.value[a] * bz.slope[b],
                    br.value[a] * bz.value[b] / r,
                ]
            }),
            factors: [
                [br.value, br.slope],
                [bz.value, bz.slope],
                [[1.0 / r, 0.0, 0.0, 0.0], [0.0; 4]],
            ],
            volume,
        }
    }
}
