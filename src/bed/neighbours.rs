//! Neighbours: the half list of grains near each other, by cells, valid until a grain has moved half the skin.

use super::grains::Sphere;
use parry3d::math::Vector;
use rayon::prelude::*;

/// Grains whose neighbours are searched by one task.
const CHUNK: usize = 256;
/// Cells per grain the grid may have before the cells are made larger.
const MAX_CELLS_PER_GRAIN: usize = 4;

/// Grid of cells that hold the grains in order of their index.
pub struct Cells {
    origin: Vector,
    inverse_size: f64,
    count: [usize; 3],
    start: Vec<u32>,
    grains: Vec<u32>,
}

/// Sorted half list: every pair once, the first index the smaller, ordered by first, then second.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HalfList {
    /// Pairs of grain indices.
    pub pairs: Vec<[u32; 2]>,
    /// Row of each grain as first of a pair: `pairs[start[i]..start[i + 1]]`.
    pub start: Vec<u32>,
    /// Row of each grain as second of a pair: `reverse[reverse_start[j]..reverse_start[j + 1]]` are indices into `pairs`.
    pub reverse_start: Vec<u32>,
    /// Indices into `pairs`, in rows by second grain, ascending.
    pub reverse: Vec<u32>,
}

impl Cells {
    /// Grid over `spheres` with cells of at least `size` (m).
    #[must_use]
    pub fn new(spheres: &[Sphere], size: f64) -> Self {
        let (mut low, mut high) = (Vector::MAX, Vector::MIN);
        for sphere in spheres {
            low = low.min(sphere.centre);
            high = high.max(sphere.centre);
        }
        let extent = if spheres.is_empty() {
            Vector::ZERO
        } else {
            high - low
        };
        let mut size = size;
        let mut count = grid(extent, size);
        while count[0] * count[1] * count[2] > MAX_CELLS_PER_GRAIN * spheres.len() + 64 {
            size *= 2.0;
            count = grid(extent, size);
        }
        let mut cells = Self {
            origin: low,
            inverse_size: 1.0 / size,
            count,
            start: vec![0; count[0] * count[1] * count[2] + 1],
            grains: vec![0; spheres.len()],
        };
        cells.fill(spheres);
        cells
    }

    fn fill(&mut self, spheres: &[Sphere]) {
        let home: Vec<usize> = spheres
            .iter()
            .map(|s| self.index(self.place(s.centre)))
            .collect();
        for &cell in &home {
            self.start[cell + 1] += 1;
        }
        for cell in 1..self.start.len() {
            self.start[cell] += self.start[cell - 1];
        }
        let mut next = self.start.clone();
        for (grain, &cell) in home.iter().enumerate() {
            self.grains[next[cell] as usize] = grain as u32;
            next[cell] += 1;
        }
    }

    fn place(&self, point: Vector) -> [usize; 3] {
        let place = (point - self.origin) * self.inverse_size;
        [0, 1, 2].map(|axis| (place[axis] as usize).min(self.count[axis] - 1))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    /// Grain indices in the order of the cells: neighbours in space are then neighbours in memory.
    #[must_use]
    pub fn order(self) -> Vec<u32> {
        self.grains
    }

    /// Calls `each` with the grains of the cells around `point`.
    fn around(&self, point: Vector, mut each: impl FnMut(u32)) {
        let centre = self.place(point);
        let range = |axis: usize| {
            centre[axis].saturating_sub(1)..=(centre[axis] + 1).min(self.count[axis] - 1)
        };
        for z in range(2) {
            for y in range(1) {
                let row = range(0);
                let first = self.start[self.index([*row.start(), y, z])] as usize;
                let last = self.start[self.index([*row.end(), y, z]) + 1] as usize;
                self.grains[first..last]
                    .iter()
                    .for_each(|&grain| each(grain));
            }
        }
    }
}

fn grid(extent: Vector, size: f64) -> [usize; 3] {
    [0, 1, 2].map(|axis| ((extent[axis] / size) as usize).max(1))
}

impl HalfList {
    /// Pairs of grains whose surfaces are nearer than `skin` (m).
    #[must_use]
    pub fn new(spheres: &[Sphere], skin: f64) -> Self {
        let largest = spheres.iter().fold(0.0f64, |r, s| r.max(s.radius));
        let cells = Cells::new(spheres, 2.0 * largest + skin);
        let tasks = spheres.len().div_ceil(CHUNK);
        let rows: Vec<(Vec<[u32; 2]>, Vec<u32>)> = (0..tasks)
            .into_par_iter()
            .map(|task| rows(spheres, &cells, skin, task))
            .collect();
        let mut list = HalfList {
            start: vec![0],
            ..HalfList::default()
        };
        for (pairs, lengths) in rows {
            list.pairs.extend(pairs);
            for length in lengths {
                let end = list.start[list.start.len() - 1] + length;
                list.start.push(end);
            }
        }
        list.index_second(spheres.len());
        list
    }

    fn index_second(&mut self, grains: usize) {
        self.reverse_start = vec![0; grains + 1];
        for pair in &self.pairs {
            self.reverse_start[pair[1] as usize + 1] += 1;
        }
        for grain in 0..grains {
            self.reverse_start[grain + 1] += self.reverse_start[grain];
        }
        let mut next = self.reverse_start.clone();
        self.reverse = vec![0; self.pairs.len()];
        for (index, pair) in self.pairs.iter().enumerate() {
            let slot = &mut next[pair[1] as usize];
            self.reverse[*slot as usize] = index as u32;
            *slot += 1;
        }
    }

    /// Pairs whose first grain is `grain`, as a range of indices.
    #[inline]
    #[must_use]
    pub fn first(&self, grain: usize) -> std::ops::Range<usize> {
        self.start[grain] as usize..self.start[grain + 1] as usize
    }

    /// Pairs whose second grain is `grain`, as indices.
    #[inline]
    #[must_use]
    pub fn second(&self, grain: usize) -> &[u32] {
        &self.reverse[self.reverse_start[grain] as usize..self.reverse_start[grain + 1] as usize]
    }

    /// Index of the pair (`first`, `second`), if it is listed.
    #[must_use]
    pub fn find(&self, [first, second]: [u32; 2]) -> Option<usize> {
        if first as usize + 1 >= self.start.len() {
            return None;
        }
        let row = self.first(first as usize);
        self.pairs[row.clone()]
            .binary_search_by_key(&second, |pair| pair[1])
            .ok()
            .map(|at| row.start + at)
    }
}

/// Rows of the half list of one chunk of grains: pairs, and the length of each row.
fn rows(spheres: &[Sphere], cells: &Cells, skin: f64, task: usize) -> (Vec<[u32; 2]>, Vec<u32>) {
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut lengths = Vec::with_capacity(CHUNK);
    for first in task * CHUNK..((task + 1) * CHUNK).min(spheres.len()) {
        let sphere = spheres[first];
        let begin = pairs.len();
        cells.around(sphere.centre, |second| {
            let other = &spheres[second as usize];
            let reach = sphere.radius + other.radius + skin;
            if second as usize > first
                && (sphere.centre - other.centre).length_squared() < reach * reach
            {
                pairs.push([first as u32, second]);
            }
        });
        pairs[begin..].sort_unstable();
        lengths.push((pairs.len() - begin) as u32);
    }
    (pairs, lengths)
}
