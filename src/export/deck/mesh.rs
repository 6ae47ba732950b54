//! Mesh of half the section of a sphere: quadrilaterals of eight nodes, fine where the sphere meets the plane.
//!
//! Four blocks: one at the contact, one at the far pole, and two strips of rings between them, which grow in proportion to their
//! distance from the contact. A radius of one; the contact pole is the origin, the centre lies at (0, 1).
//!
//! ```text
//!       N ------ P'        r ->
//!       | far   /  \       A, A', N and the origin: the axis
//!       A'----Q'    \      P, P': the surface
//!       | rings \ rings    Q, Q': where three blocks meet
//!       A ----- Q -- P
//!       | contact   /
//!       0 ---------
//! ```

use std::collections::HashMap;
use std::f64::consts::PI;

/// A point of the section: distance from the axis, height above the plane.
pub type Point = [f64; 2];

/// Depth of the contact block over its width.
const DEPTH: f64 = 0.65;
/// Length of the edge P-Q over the depth: the block narrows as the sphere rises beside it.
const SIDE: f64 = 0.85;
/// Angle of the far block from its pole, and its depth.
const FAR: (f64, f64) = (0.9, 0.6);
/// Growth of the growth from ring to ring, and the largest growth.
const GROWTH: (f64, f64) = (1.04, 1.2);
/// Least cells across the contact block.
const LEAST: usize = 4;

/// A mesh; nodes are counted from 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Nodes.
    pub nodes: Vec<Point>,
    /// Corners, then the nodes amid the sides between them, both counter-clockwise.
    pub elements: Vec<[usize; 8]>,
    /// Element and side (0 to 3) of the surface, from the contact to the far pole.
    pub surface: Vec<(usize, usize)>,
}

/// Nodes of a block as they are laid in rows.
struct Lattice {
    /// Cells of a row.
    across: usize,
    /// Nodes, row by row.
    nodes: Vec<usize>,
}

impl Lattice {
    fn at(&self, i: usize, k: usize) -> usize {
        self.nodes[k * (self.across + 1) + i]
    }

    fn along(&self) -> usize {
        self.nodes.len() / (self.across + 1) - 1
    }
}

/// Outline of a block: its first and last row, and the first and last point of all rows.
struct Outline {
    first: Vec<Point>,
    last: Vec<Point>,
    left: Vec<Point>,
    right: Vec<Point>,
    /// Place of each row between the first (0) and the last (1).
    rows: Vec<f64>,
}

impl Outline {
    /// Point inside by transfinite interpolation (Gordon and Hall 1973).
    fn point(&self, i: usize, k: usize) -> Point {
        let n = self.first.len() - 1;
        let (s, t) = (i as f64 / n as f64, self.rows[k]);
        std::array::from_fn(|x| {
            let (first, last) = (&self.first, &self.last);
            let edges = (1.0 - t) * first[i][x] + t * last[i][x];
            let sides = (1.0 - s) * self.left[k][x] + s * self.right[k][x];
            let corners = (1.0 - t) * ((1.0 - s) * first[0][x] + s * first[n][x])
                + t * ((1.0 - s) * last[0][x] + s * last[n][x]);
            edges + sides - corners
        })
    }
}

/// Point of the surface at an angle from the contact pole.
fn on_sphere(angle: f64) -> Point {
    [angle.sin(), 2.0 * (0.5 * angle).sin().powi(2)]
}

fn between(a: Point, b: Point, share: f64) -> Point {
    std::array::from_fn(|x| a[x] + (b[x] - a[x]) * share)
}

/// Points of a straight edge of `cells` cells.
fn straight(a: Point, b: Point, cells: usize) -> Vec<Point> {
    let share = |k: usize| k as f64 / cells as f64;
    (0..=cells).map(|k| between(a, b, share(k))).collect()
}

/// Logarithm of the distance from the contact pole, and the angle from the axis there.
fn polar([r, z]: Point) -> Point {
    [r.hypot(z).ln(), r.atan2(z)]
}

fn cartesian([log, angle]: Point) -> Point {
    [log.exp() * angle.sin(), log.exp() * angle.cos()]
}

/// Corners P, A, Q of a block about the contact pole.
fn corners(width: f64, depth: f64) -> [Point; 3] {
    let surface = on_sphere(width);
    let inwards = SIDE * depth;
    let inner = [
        surface[0] - width.sin() * inwards,
        surface[1] + width.cos() * inwards,
    ];
    [surface, [0.0, depth], inner]
}

impl Mesh {
    /// Mesh with `cells` quadrilaterals on a length `fine` of the surface (in radii), from the contact pole on.
    #[must_use]
    pub fn new(fine: f64, cells: usize) -> Self {
        let across = cells.max(LEAST);
        let deep = ((DEPTH * across as f64).round() as usize).max(LEAST / 2);
        let [p, a, q] = corners(fine, DEPTH * fine);
        let [p_far, a_far, q_far] = corners(FAR.0, FAR.1).map(|[r, z]| [r, 2.0 - z]);
        let rings = rings(p, p_far, across);
        let rail = |from: Point, to: Point| {
            let (from, to) = (polar(from), polar(to));
            let points = rings.iter().map(|share| between(from, to, *share));
            points.collect::<Vec<_>>()
        };
        // a chord of length l from the pole of a circle makes the angle acos(l/2) with the axis
        let arc = rail(p, p_far);
        let arc = arc
            .into_iter()
            .map(|[log, _]| [log, (0.5 * log.exp()).acos()])
            .collect();
        let inner = rail(q, q_far);
        let polars = |a, b, cells| straight(a, b, cells).into_iter().map(polar).collect();
        let even =
            |cells: usize| -> Vec<f64> { (0..=cells).map(|k| k as f64 / cells as f64).collect() };
        let angles = |k: usize, most: f64| most * k as f64 / across as f64;
        let contact = Outline {
            first: (0..=across).map(|k| on_sphere(angles(k, fine))).collect(),
            last: straight(a, q, across),
            left: straight([0.0; 2], a, deep),
            right: straight(p, q, deep),
            rows: even(deep),
        };
        let side = Outline {
            first: polars(p, q, deep),
            last: polars(p_far, q_far, deep),
            left: arc,
            right: inner.clone(),
            rows: rings.clone(),
        };
        let above = Outline {
            first: polars(a, q, across),
            last: polars(a_far, q_far, across),
            left: rail(a, a_far),
            right: inner,
            rows: rings.clone(),
        };
        let far = Outline {
            first: straight(a_far, q_far, across),
            last: (0..=across)
                .map(|k| on_sphere(PI - angles(k, FAR.0)))
                .map(|[r, z]| if r < 1e-12 { [0.0, 2.0] } else { [r, z] })
                .collect(),
            left: straight(a_far, [0.0, 2.0], deep),
            right: straight(q_far, p_far, deep),
            rows: even(deep),
        };
        assemble(&contact, &side, &above, &far)
    }

    /// Points of an element: corners and the nodes amid its sides.
    #[must_use]
    pub fn points(&self, element: usize) -> [Point; 8] {
        self.elements[element].map(|node| self.nodes[node])
    }
}

/// Places of the rings between the contact block, whose corner is `from`, and the far one, 0 to 1 in the logarithm of the distance.
fn rings(from: Point, to: Point, across: usize) -> Vec<f64> {
    let total = polar(to)[0] - polar(from)[0];
    let mut growth = 1.0 + 1.0 / across as f64;
    let mut places = vec![0.0];
    let mut place = 0.0;
    while place < total {
        place += f64::ln(growth);
        places.push(place);
        growth = growth.max((1.0 + (growth - 1.0) * GROWTH.0).min(GROWTH.1));
    }
    places.iter().map(|at| at / place).collect()
}

/// The four blocks as one mesh: nodes on common edges are those of the block that was laid first.
fn assemble(contact: &Outline, side: &Outline, above: &Outline, far: &Outline) -> Mesh {
    let mut nodes: Vec<Point> = Vec::new();
    let mut lay = |outline: &Outline,
                   point: &dyn Fn(Point) -> Point,
                   known: &dyn Fn(usize, usize) -> Option<usize>| {
        let across = outline.first.len() - 1;
        let mut ids = Vec::new();
        for k in 0..outline.rows.len() {
            for i in 0..=across {
                ids.push(known(i, k).unwrap_or_else(|| {
                    nodes.push(point(outline.point(i, k)));
                    nodes.len() - 1
                }));
            }
        }
        Lattice { across, nodes: ids }
    };
    let contact = lay(contact, &|p| p, &|_, _| None);
    let (wide, deep) = (contact.across, contact.along());
    let side = lay(side, &cartesian, &|i, k| {
        (k == 0).then(|| contact.at(wide, i))
    });
    let above = lay(above, &cartesian, &|i, k| match (i, k) {
        (i, 0) => Some(contact.at(i, deep)),
        (i, k) if i == wide => Some(side.at(deep, k)),
        _ => None,
    });
    let last = side.along();
    let far = lay(far, &|p| p, &|i, k| match (i, k) {
        (i, 0) => Some(above.at(i, last)),
        (i, k) if i == wide => Some(side.at(deep - k, last)),
        _ => None,
    });
    let axis = |lattice: &Lattice| (0..=lattice.along()).map(|k| lattice.at(0, k)).collect();
    let on_axis: [Vec<usize>; 3] = [axis(&contact), axis(&above), axis(&far)];
    for node in on_axis.into_iter().flatten() {
        nodes[node][0] = 0.0;
    }
    elements(nodes, [&contact, &side, &above, &far])
}

/// Elements of the blocks, with nodes amid their sides: on the sphere where the side is, else amid the corners.
fn elements(nodes: Vec<Point>, [contact, side, above, far]: [&Lattice; 4]) -> Mesh {
    let mut mesh = Mesh {
        nodes,
        elements: Vec::new(),
        surface: Vec::new(),
    };
    let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
    let top = far.along() - 1;
    let mut far_surface = Vec::new();
    for lattice in [contact, side, above, far] {
        for k in 0..lattice.along() {
            for i in 0..lattice.across {
                let on = |block: &Lattice| std::ptr::eq(lattice, block);
                let mut corners =
                    [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| lattice.at(i + x, k + y));
                if on(side) {
                    corners.swap(1, 3);
                }
                let element = mesh.elements.len();
                let outer = match () {
                    () if on(contact) && k == 0 || on(side) && i == 0 => Some(0),
                    () if on(far) && k == top => Some(2),
                    () => None,
                };
                match outer {
                    Some(2) => far_surface.push((element, 2)),
                    Some(s) => mesh.surface.push((element, s)),
                    None => {}
                }
                let amid = std::array::from_fn::<usize, 4, _>(|s| {
                    let [a, b] = [corners[s], corners[(s + 1) % 4]];
                    *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                        let middle = between(mesh.nodes[a], mesh.nodes[b], 0.5);
                        mesh.nodes.push(match outer == Some(s) {
                            true => onto_sphere(middle),
                            false => middle,
                        });
                        mesh.nodes.len() - 1
                    })
                });
                let [a, b, c, d] = corners;
                let [e, f, g, h] = amid;
                mesh.elements.push([a, b, c, d, e, f, g, h]);
            }
        }
    }
    mesh.surface.extend(far_surface.into_iter().rev());
    mesh
}

/// The point of the surface on the ray from the centre through a point.
fn onto_sphere([r, z]: Point) -> Point {
    let distance = r.hypot(z - 1.0);
    [r / distance, 1.0 + (z - 1.0) / distance]
}

/// Abscissae and weights of Gauss' rule with three points.
const GAUSS: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];

/// A point within an element: shares of its corners there, where it is, and the volume about the axis that it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Bilinear shares of the corners.
    pub corners: [f64; 4],
    /// Place.
    pub point: Point,
    /// Volume of the ring, negative where the element is turned inside out.
    pub volume: f64,
}

impl Mesh {
    /// Nine points of an element, by its quadratic map.
    #[must_use]
    pub fn samples(&self, element: usize) -> [Sample; 9] {
        let points = self.points(element);
        std::array::from_fn(|index| {
            let ((a, u), (b, v)) = (GAUSS[index / 3], GAUSS[index % 3]);
            let mut point = [0.0; 2];
            let mut slopes = [[0.0; 2]; 2];
            for (place, (share, slope)) in points.iter().zip(serendipity(a, b)) {
                for x in 0..2 {
                    point[x] += share * place[x];
                    slopes[0][x] += slope[0] * place[x];
                    slopes[1][x] += slope[1] * place[x];
                }
            }
            let area = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
            Sample {
                corners: [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                    .map(|(x, y)| 0.25 * (1.0 + a * x) * (1.0 + b * y)),
                point,
                volume: 2.0 * PI * point[0] * area * u * v,
            }
        })
    }
}

/// Shape functions of eight nodes at (a, b), with their slopes along a and b.
fn serendipity(a: f64, b: f64) -> [(f64, [f64; 2]); 8] {
    let corner = |x: f64, y: f64| {
        let (p, q) = (1.0 + a * x, 1.0 + b * y);
        let sum = a * x + b * y - 1.0;
        let slopes = [0.25 * x * q * (sum + p), 0.25 * y * p * (sum + q)];
        (0.25 * p * q * sum, slopes)
    };
    let level = |y: f64| {
        let q = 1.0 + b * y;
        (0.5 * (1.0 - a * a) * q, [-a * q, 0.5 * y * (1.0 - a * a)])
    };
    let upright = |x: f64| {
        let p = 1.0 + a * x;
        (0.5 * (1.0 - b * b) * p, [0.5 * x * (1.0 - b * b), -b * p])
    };
    [
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
        level(-1.0),
        upright(1.0),
        level(1.0),
        upright(-1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    /// From a touch to a contact of two thirds of the radius, coarse and fine.
    const MESHES: [(f64, usize); 6] = [
        (1e-3, 10),
        (0.02, 12),
        (0.2, 4),
        (0.2, 30),
        (0.55, 20),
        (0.8, 24),
    ];

    #[test]
    fn no_element_is_turned_inside_out_or_a_sliver() {
        for (fine, cells) in MESHES {
            let mesh = Mesh::new(fine, cells);
            for element in 0..mesh.elements.len() {
                let points = mesh.points(element);
                for sample in mesh.samples(element) {
                    assert!(sample.volume > 0.0, "{fine} {cells}: {points:?}");
                }
                for k in 0..4 {
                    let [a, b, c] = [points[(k + 3) % 4], points[k], points[(k + 1) % 4]];
                    let [u, v] = [a, c].map(|p| [p[0] - b[0], p[1] - b[1]]);
                    let angle = f64::atan2(v[0] * u[1] - v[1] * u[0], u[0] * v[0] + u[1] * v[1]);
                    let degrees = angle.to_degrees();
                    assert!(
                        (35.0..145.0).contains(&degrees),
                        "{fine} {cells}: {degrees}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_volume_is_that_of_the_sphere() {
        for (fine, cells) in MESHES {
            let mesh = Mesh::new(fine, cells);
            let samples = (0..mesh.elements.len()).flat_map(|element| mesh.samples(element));
            let error = samples.map(|s| s.volume).sum::<f64>() / (4.0 / 3.0 * PI) - 1.0;
            // an arc is off a parabola by the fourth power of its angle, most in the four sides of the coarsest mesh
            let within = if cells < 10 { 2e-3 } else { 1e-4 };
            assert!(error.abs() < within, "{fine} {cells}: {error:e}");
        }
    }

    #[test]
    fn the_surface_is_one_line_on_the_sphere_from_pole_to_pole() {
        for (fine, cells) in MESHES {
            let mesh = Mesh::new(fine, cells);
            let mut end = [0.0, 0.0];
            for &(element, side) in &mesh.surface {
                let points = mesh.points(element);
                let [a, b, m] = [points[side], points[(side + 1) % 4], points[4 + side]];
                assert!(a.iter().zip(end).all(|(x, y)| (x - y).abs() < 1e-12));
                for p in [a, b, m] {
                    assert!((p[0].hypot(p[1] - 1.0) - 1.0).abs() < 1e-12, "{p:?}");
                }
                // counter-clockwise: outwards is to the right of the way
                let out = [b[1] - a[1], a[0] - b[0]];
                assert!(out[0] * m[0] + out[1] * (m[1] - 1.0) > 0.0);
                end = b;
            }
            assert!(end[0].abs() < 1e-12 && (end[1] - 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn inner_sides_are_shared_by_two_elements_and_every_node_is_used() {
        for (fine, cells) in MESHES {
            let mesh = Mesh::new(fine, cells);
            let mut sides: HashMap<[usize; 3], usize> = HashMap::new();
            let mut used: HashSet<usize> = HashSet::new();
            for nodes in &mesh.elements {
                used.extend(nodes);
                for s in 0..4 {
                    let [a, b] = [nodes[s], nodes[(s + 1) % 4]];
                    *sides.entry([a.min(b), a.max(b), nodes[4 + s]]).or_default() += 1;
                }
            }
            assert_eq!(used.len(), mesh.nodes.len());
            let outer = sides.iter().filter(|(_, count)| **count == 1);
            let (axis, surface): (Vec<_>, Vec<_>) =
                outer.partition(|(side, _)| side.iter().all(|n| mesh.nodes[*n][0] == 0.0));
            assert_eq!(surface.len(), mesh.surface.len());
            assert!(axis.len() > 5 && sides.values().all(|count| *count <= 2));
        }
    }
}
