//! Weld: corners of facets closer than a tolerance become one, and what that leaves of the facets.

use super::{Facets, plural};
use parry3d::math::Vector;
use std::collections::HashMap;

/// Edge of a cell over the tolerance: most corners then look into one cell.
const CELL: f64 = 8.0;
/// Height of a triangle over its longest edge below which it is a line.
const LINE: f64 = 1e-12;

/// Facets that share corners, in the file's unit.
pub(super) struct Welded {
    pub(super) vertices: Vec<Vector>,
    /// Triangles, with the number in the file of each, from 0; those without an area among them.
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) numbers: Vec<usize>,
    /// What was left out, as sentences' ends.
    pub(super) warnings: Vec<String>,
}

/// Corners so far, by cells.
struct Corners {
    tolerance: f64,
    list: Vec<Vector>,
    exact: HashMap<[u64; 3], u32>,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl Corners {
    /// Index of the corner at `place`: an earlier one within the tolerance, the nearest if several, or a new one.
    fn at(&mut self, place: Vector) -> u32 {
        let bits = [place.x, place.y, place.z].map(f64::to_bits);
        if let Some(&index) = self.exact.get(&bits) {
            return index;
        }
        let index = self.near(place).unwrap_or_else(|| {
            let index = self.list.len() as u32;
            self.list.push(place);
            if self.tolerance > 0.0 {
                self.cells.entry(self.cell(place)).or_default().push(index);
            }
            index
        });
        self.exact.insert(bits, index);
        index
    }

    fn cell(&self, place: Vector) -> [i64; 3] {
        let edge = CELL * self.tolerance;
        [place.x, place.y, place.z].map(|x| (x / edge).floor() as i64)
    }

    fn near(&self, place: Vector) -> Option<u32> {
        if self.tolerance == 0.0 {
            return None;
        }
        let reach = Vector::splat(self.tolerance);
        let [low, high] = [self.cell(place - reach), self.cell(place + reach)];
        let mut nearest: Option<(f64, u32)> = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for &index in self.cells.get(&[x, y, z]).into_iter().flatten() {
                        let distance = (self.list[index as usize] - place).length();
                        let better = nearest.is_none_or(|best| (distance, index) < best);
                        if distance <= self.tolerance && better {
                            nearest = Some((distance, index));
                        }
                    }
                }
            }
        }
        nearest.map(|(_, index)| index)
    }
}

/// Welds corners closer than `tolerance`, in the file's unit.
pub(super) fn weld(facets: &Facets, tolerance: f64) -> Welded {
    let mut corners = Corners {
        tolerance,
        list: Vec::new(),
        exact: HashMap::new(),
        cells: HashMap::new(),
    };
    let mut welded = Welded {
        vertices: Vec::new(),
        triangles: Vec::new(),
        numbers: Vec::new(),
        warnings: Vec::new(),
    };
    let mut known: HashMap<[u32; 3], usize> = HashMap::new();
    let (mut collapsed, mut repeated) = (Vec::new(), Vec::new());
    for (number, corner) in facets.corners.iter().enumerate() {
        let triangle = corner.map(|place| corners.at(place));
        let mut sorted = triangle;
        sorted.sort_unstable();
        if sorted[0] == sorted[1] || sorted[1] == sorted[2] {
            collapsed.push(number);
        } else if *known.entry(sorted).or_insert(number) != number {
            repeated.push(number);
        } else {
            welded.triangles.push(triangle);
            welded.numbers.push(number);
        }
    }
    welded.vertices = corners.list;
    let mut warn = |list: &[usize], what: &str| {
        if let Some(&first) = list.first() {
            welded.warnings.push(format!(
                "{} {what}, the first {}",
                plural(list.len(), "facet"),
                facets.place(first)
            ));
        }
    };
    warn(
        &collapsed,
        "left out, narrower than the tolerance between two corners",
    );
    warn(&repeated, "left out as repeated");
    welded
}

impl Welded {
    /// Takes out the triangles without an area, whose places are covered by their neighbours' edges.
    pub(super) fn drop_lines(&mut self, facets: &Facets) {
        let vertices = &self.vertices;
        let is_line = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| vertices[corner as usize]);
            let longest = (b - a).length().max((c - b).length()).max((a - c).length());
            (b - a).cross(c - a).length() <= LINE * longest * longest
        };
        let pairs = || self.triangles.iter().zip(&self.numbers);
        let lines: Vec<usize> = pairs()
            .filter(|(triangle, _)| is_line(triangle))
            .map(|(_, &number)| number)
            .collect();
        if let Some(&first) = lines.first() {
            let (triangles, numbers) = pairs().filter(|(triangle, _)| !is_line(triangle)).unzip();
            self.warnings.push(format!(
                "{} left out, their corners in one line, the first {}",
                plural(lines.len(), "facet"),
                facets.place(first)
            ));
            (self.triangles, self.numbers) = (triangles, numbers);
        }
    }
}
