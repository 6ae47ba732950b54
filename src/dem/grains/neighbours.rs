//! Neighbours: the half list of grains near each other, by cells, valid until a grain has moved half the skin.

use super::periodic::{IMAGES, Periodic};
use crate::dem::grains::Sphere;
use parry3d::math::Vector;
use rayon::prelude::*;

/// Grains whose neighbours are searched by one task.
const CHUNK: usize = 256;
/// Cells per grain the grid may have before the cells are made larger.
const MAX_CELLS_PER_GRAIN: usize = 4;

/// Grid of cells that hold the grains in order of their index.
pub struct Cells {
    origin: Vector,
    inverse_size: Vector,
    count: [usize; 3],
    /// Whether the last cell of an axis is followed by the first.
    closed: [bool; 3],
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
    /// Image of the first grain that meets the second, for each pair ([`Periodic::image`]); empty in an open room.
    pub images: Vec<u8>,
}

impl Cells {
    /// Grid over `spheres` in an open room, with cells of at least `size` (m).
    #[must_use]
    pub fn new(spheres: &[Sphere], size: f64) -> Self {
        Self::within(&Periodic::default(), spheres, size)
    }

    /// Grid over `spheres` that lie inside `room`, with cells of at least `size` (m).
    #[must_use]
    pub fn within(room: &Periodic, spheres: &[Sphere], size: f64) -> Self {
        let (mut low, mut high) = (Vector::MAX, Vector::MIN);
        for sphere in spheres {
            low = low.min(sphere.centre);
            high = high.max(sphere.centre);
        }
        let mut extent = if spheres.is_empty() {
            Vector::ZERO
        } else {
            high - low
        };
        let mut closed = [false; 3];
        for axis in 0..3 {
            if let Some((side, period)) = room.along(axis) {
                (low[axis], extent[axis], closed[axis]) = (side, period, true);
            }
        }
        // without grains there is no size; a periodic room has an extent all the same
        let mut size = size.max(f64::MIN_POSITIVE);
        let mut count = grid(extent, size);
        let cells = |[x, y, z]: [usize; 3]| x.saturating_mul(y).saturating_mul(z);
        while cells(count) > MAX_CELLS_PER_GRAIN * spheres.len() + 64 {
            size *= 2.0;
            count = grid(extent, size);
        }
        let inverse_size = [0, 1, 2].map(|axis| {
            if closed[axis] {
                count[axis] as f64 / extent[axis]
            } else {
                1.0 / size
            }
        });
        let mut cells = Self {
            origin: low,
            inverse_size: Vector::from(inverse_size),
            count,
            closed,
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

    /// As [`Cells::around`] in a periodic room, with the image of `point` that lies near each grain.
    fn around_images(&self, point: Vector, mut each: impl FnMut(u32, u8)) {
        let centre = self.place(point);
        for z in self.near(2, centre[2]) {
            for y in self.near(1, centre[1]) {
                for x in self.near(0, centre[0]) {
                    let cell = self.index([x.0, y.0, z.0]);
                    let image = Periodic::image([x.1, y.1, z.1]);
                    self.grains[self.start[cell] as usize..self.start[cell + 1] as usize]
                        .iter()
                        .for_each(|&grain| each(grain, image));
                }
            }
        }
    }

    /// Cells beside `place` along an axis, with the periods to add to a point of `place` to be near it.
    fn near(&self, axis: usize, place: usize) -> impl Iterator<Item = (usize, i8)> {
        let (count, closed) = (self.count[axis], self.closed[axis]);
        [0, 1, 2].into_iter().filter_map(move |step| {
            let cell = place + step;
            match cell.wrapping_sub(1) {
                inside if inside < count => Some((inside, 0)),
                _ if !closed => None,
                _ if cell == 0 => Some((count - 1, 1)),
                _ => Some((0, -1)),
            }
        })
    }
}

/// Grains that stay when others are taken out; their order is kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Staying {
    /// Index each grain will have, if it stays.
    pub new: Vec<Option<u32>>,
    /// Index each of those that stay had.
    pub old: Vec<u32>,
}

impl Staying {
    /// All of `count` grains but those whose indices are `gone`, ascending.
    #[must_use]
    pub fn without(count: usize, gone: &[u32]) -> Self {
        let (mut new, mut old) = (vec![None; count], Vec::new());
        let mut gone = gone.iter().copied().peekable();
        for grain in 0..count as u32 {
            if gone.next_if_eq(&grain).is_none() {
                new[grain as usize] = Some(old.len() as u32);
                old.push(grain);
            }
        }
        Self { new, old }
    }
}

fn grid(extent: Vector, size: f64) -> [usize; 3] {
    [0, 1, 2].map(|axis| ((extent[axis] / size) as usize).max(1))
}

impl HalfList {
    /// Pairs of grains whose surfaces are nearer than `skin` (m), in an open room.
    #[must_use]
    pub fn new(spheres: &[Sphere], skin: f64) -> Self {
        Self::within(&Periodic::default(), spheres, skin)
    }

    /// Pairs of grains inside `room` whose surfaces are nearer than `skin` (m), through its sides too.
    #[must_use]
    pub fn within(room: &Periodic, spheres: &[Sphere], skin: f64) -> Self {
        let largest = spheres.iter().fold(0.0f64, |r, s| r.max(s.radius));
        let cells = Cells::within(room, spheres, 2.0 * largest + skin);
        let search = Search {
            spheres,
            cells: &cells,
            skin,
            shifts: (!room.is_open()).then(|| room.shifts()),
        };
        let tasks = spheres.len().div_ceil(CHUNK);
        let rows: Vec<Rows> = (0..tasks)
            .into_par_iter()
            .map(|task| search.rows(task))
            .collect();
        let mut list = HalfList {
            start: vec![0],
            ..HalfList::default()
        };
        for rows in rows {
            list.pairs.extend(rows.pairs);
            list.images.extend(rows.images);
            for length in rows.lengths {
                let end = list.start[list.start.len() - 1] + length;
                list.start.push(end);
            }
        }
        list.index_second(spheres.len());
        list
    }

    /// The pairs of grains that stay, under their new indices, and which pairs those were.
    #[must_use]
    pub fn of_those(&self, stay: &Staying) -> (Self, Vec<Option<usize>>) {
        let mut list = HalfList {
            start: vec![0],
            ..HalfList::default()
        };
        let mut from = Vec::new();
        for &old in &stay.old {
            for at in self.first(old as usize) {
                let pair = self.pairs[at].map(|grain| stay.new[grain as usize]);
                if let [Some(first), Some(second)] = pair {
                    list.pairs.push([first, second]);
                    list.images.extend(self.images.get(at));
                    from.push(Some(at));
                }
            }
            list.start.push(list.pairs.len() as u32);
        }
        list.index_second(stay.old.len());
        (list, from)
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

/// What the search for neighbours reads.
struct Search<'a> {
    spheres: &'a [Sphere],
    cells: &'a Cells,
    skin: f64,
    /// Images of a periodic room.
    shifts: Option<[Vector; IMAGES]>,
}

/// Rows of the half list of one chunk of grains.
#[derive(Default)]
struct Rows {
    pairs: Vec<[u32; 2]>,
    images: Vec<u8>,
    /// Length of each row.
    lengths: Vec<u32>,
}

impl Search<'_> {
    fn rows(&self, task: usize) -> Rows {
        let mut rows = Rows::default();
        for first in task * CHUNK..((task + 1) * CHUNK).min(self.spheres.len()) {
            let begin = rows.pairs.len();
            match &self.shifts {
                None => self.row(first, &mut rows.pairs),
                Some(shifts) => self.row_across(first, shifts, &mut rows),
            }
            rows.lengths.push((rows.pairs.len() - begin) as u32);
        }
        rows
    }

    fn row(&self, first: usize, pairs: &mut Vec<[u32; 2]>) {
        let sphere = self.spheres[first];
        let begin = pairs.len();
        self.cells.around(sphere.centre, |second| {
            if second as usize > first && self.listed(&sphere, second) {
                pairs.push([first as u32, second]);
            }
        });
        pairs[begin..].sort_unstable();
    }

    fn row_across(&self, first: usize, shifts: &[Vector; IMAGES], rows: &mut Rows) {
        let sphere = self.spheres[first];
        let mut row = Vec::new();
        self.cells.around_images(sphere.centre, |second, image| {
            let moved = Sphere {
                centre: sphere.centre + shifts[image as usize],
                ..sphere
            };
            if second as usize > first && self.listed(&moved, second) {
                row.push((second, image));
            }
        });
        row.sort_unstable();
        for (second, image) in row {
            rows.pairs.push([first as u32, second]);
            rows.images.push(image);
        }
    }

    fn listed(&self, sphere: &Sphere, second: u32) -> bool {
        let other = &self.spheres[second as usize];
        let reach = sphere.radius + other.radius + self.skin;
        (sphere.centre - other.centre).length_squared() < reach * reach
    }
}
