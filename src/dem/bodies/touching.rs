//! Touching points of a ball on a shape, by parry: closest points, and for triangle meshes the local minima of distance.
//!
//! A ball pressed on an edge shared by two triangles touches once, not twice; pressed into a groove it touches both
//! flanks. Both follow from one rule: a point is touched where the distance from the ball's centre to the mesh has a
//! local minimum, that is, where the closest point of a triangle is also the closest point of every other triangle
//! that holds it.
//!
//! **One surface pushes once.** Triangles that should share a corner may miss it by rounding, walls have a far skin, and
//! floors are laid of several bodies. Of two touched points the farther one is no contact of its own if it lies in the
//! plane that touches the ball at the nearer one ([`Touch::holds`]), or if the nearer surface hides it from the centre.
//! Two points of a ball of radius $R$ lie in one such plane, up to $h$, if they are closer than $\sqrt{2 R h}$: the
//! radius of contact at the overlap $2h$, so that what becomes one is what no contact of that overlap can tell apart.

use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::query::{PointQuery, PointQueryWithLocation};
use parry3d::shape::{Shape, TriMesh, Triangle, TrianglePointLocation};

/// Most points at which one ball may touch one mesh.
pub const MAX_TOUCHES: usize = 6;
/// Distance, in grain radii, below which two points are one: far above rounding, far below any overlap.
const SAME_POINT: f64 = 1e-9;
/// Distance from a plane, in grain radii, up to which a surface is flush with it.
pub(in crate::dem) const FLUSH: f64 = 1e-3;
/// Triangles up to which each point is compared with every triangle at once.
const FEW: usize = 8;

/// A touched point, in the frame and unit of the shape.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Touch {
    /// Unit normal from the shape to the ball's centre.
    pub normal: Vector,
    /// Distance from the centre to the surface; negative if the centre is inside.
    pub distance: f64,
}

impl Touch {
    /// Height of another touched point of the same ball over the plane that touches it here.
    #[inline(always)]
    #[must_use]
    pub fn height(&self, other: &Touch) -> f64 {
        self.distance - other.distance * self.normal.dot(other.normal)
    }

    /// Whether a farther point is flush with the surface touched here, for a ball of `radius`.
    #[inline(always)]
    #[must_use]
    pub fn holds(&self, other: &Touch, radius: f64) -> bool {
        self.height(other).abs() <= FLUSH * radius
    }

    /// Whether a farther point lies behind the surface touched here, so that something may hide it.
    #[inline(always)]
    #[must_use]
    pub fn before(&self, other: &Touch, radius: f64) -> bool {
        self.height(other) < -FLUSH * radius
    }
}

/// Touched points of one ball.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Touches {
    list: [Touch; MAX_TOUCHES],
    count: usize,
    /// Points left out because there was no more room.
    pub left_out: u32,
}

impl Touches {
    /// Points, nearest first.
    #[must_use]
    pub fn as_slice(&self) -> &[Touch] {
        &self.list[..self.count]
    }

    /// Keeps the points of which `keep` says so, by their place in the list.
    pub(in crate::dem) fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let mut count = 0;
        for at in 0..self.count {
            if keep(at) {
                self.list[count] = self.list[at];
                count += 1;
            }
        }
        self.count = count;
    }

    /// The one point `touch`, or none.
    pub(in crate::dem) fn one(touch: Option<Touch>) -> Self {
        let mut touches = Self::default();
        touch.into_iter().for_each(|touch| touches.add(touch));
        touches
    }

    /// Adds a point, keeping the nearest ones in order.
    fn add(&mut self, touch: Touch) {
        let at = self
            .as_slice()
            .partition_point(|other| other.distance <= touch.distance);
        if self.count == MAX_TOUCHES {
            self.left_out += 1;
        } else {
            self.count += 1;
        }
        if at < self.count {
            self.list[at..self.count].rotate_right(1);
            self.list[at] = touch;
        }
    }
}

/// Closest point of a solid shape, if it is nearer than `reach`.
#[inline]
#[must_use]
pub fn closest(shape: &dyn Shape, centre: Vector, reach: f64) -> Option<Touch> {
    if let Some(cuboid) = shape.as_cuboid() {
        // walls are blocks: their closest point, without a call for each grain beside them
        let half = cuboid.half_extents;
        let line = centre - centre.clamp(-half, half);
        let square = line.length_squared();
        if square > 0.0 {
            let touch = || {
                let distance = square.sqrt();
                Touch {
                    normal: line * (1.0 / distance),
                    distance,
                }
            };
            return (square < reach * reach).then(touch);
        }
    }
    let projection = shape.project_local_point(centre, false);
    let line = centre - projection.point;
    let length = line.length();
    let side = if projection.is_inside { -1.0 } else { 1.0 };
    let distance = side * length;
    (distance < reach && length > 0.0).then(|| Touch {
        normal: line * (side / length),
        distance,
    })
}

/// Triangle within reach of a ball.
#[derive(Debug, Clone, Copy)]
struct Near {
    id: u32,
    triangle: Triangle,
    /// Its point closest to the centre.
    point: Vector,
    square: f64,
    location: TrianglePointLocation,
}

/// Working space of [`minima`].
#[derive(Debug, Default)]
pub struct Scratch {
    near: Vec<Near>,
    /// Edges and corners with the squared distance of a triangle at them.
    features: Vec<([u32; 2], f64)>,
    found: Vec<(Vector, Touch)>,
}

/// Local minima of the distance from `centre` to a mesh, nearer than `reach`, one for each surface. `scratch` is
/// working space.
///
/// The time grows as the number n of triangles within reach, and n log n where they are many.
#[must_use]
pub fn minima(mesh: &TriMesh, centre: Vector, reach: f64, scratch: &mut Scratch) -> Touches {
    let Scratch {
        near,
        features,
        found,
    } = scratch;
    near.clear();
    found.clear();
    let ball = Aabb::from_half_extents(centre, Vector::splat(reach));
    for id in mesh.bvh().intersect_aabb(&ball) {
        let triangle = mesh.triangle(id);
        let (projection, location) = triangle.project_local_point_and_get_location(centre, false);
        let point = projection.point;
        let square = (point - centre).length_squared();
        if square < reach * reach {
            near.push(Near {
                id,
                triangle,
                point,
                square,
                location,
            });
        }
    }
    let many = near.len() > FEW;
    if many {
        list_features(mesh, near, features);
    }
    let same = |a: Vector, b: Vector| (a - b).length_squared() < SAME_POINT * SAME_POINT;
    for own in near.iter() {
        if many && nearest_at(mesh, own, features) < own.square * (1.0 - 1e-12) {
            continue;
        }
        let point = own.point;
        let line = centre - point;
        let distance = line.length();
        if !(distance > 0.0) || found.iter().any(|&(other, _)| same(other, point)) {
            continue;
        }
        let minimum = many && is_inside(own)
            || near.iter().all(|other| {
                same(other.point, point)
                    || !same(
                        other.triangle.project_local_point(point, false).point,
                        point,
                    )
            });
        if minimum {
            let normal = line / distance;
            found.push((point, Touch { normal, distance }));
        }
    }
    let mut touches = Touches::default();
    if found.len() > 1 {
        one_a_surface(centre, reach, near, found);
    }
    found.iter().for_each(|&(_, touch)| touches.add(touch));
    touches
}

/// Whether a triangle is closest well inside its edges: no other triangle holds that point.
fn is_inside(near: &Near) -> bool {
    matches!(near.location, TrianglePointLocation::OnFace(_, shares) if shares.iter().all(|share| *share > 1e-6))
}

/// Edge or corner of the mesh on which a triangle's closest point lies; none for its inside.
fn feature(mesh: &TriMesh, near: &Near) -> Option<[u32; 2]> {
    let [a, b, c] = mesh.indices()[near.id as usize];
    match near.location {
        TrianglePointLocation::OnVertex(at) => Some([[a, b, c][at as usize]; 2]),
        TrianglePointLocation::OnEdge(at, _) => {
            let [from, to] = [[a, b], [b, c], [a, c]][at as usize];
            Some([from.min(to), from.max(to)])
        }
        _ => None,
    }
}

/// Lists edges and corners of the triangles within reach, the nearest triangle at each first.
fn list_features(mesh: &TriMesh, near: &[Near], features: &mut Vec<([u32; 2], f64)>) {
    features.clear();
    for own in near {
        let [a, b, c] = mesh.indices()[own.id as usize];
        let edge = |a: u32, b: u32| [a.min(b), a.max(b)];
        let all = [[a; 2], [b; 2], [c; 2], edge(a, b), edge(b, c), edge(a, c)];
        features.extend(all.map(|feature| (feature, own.square)));
    }
    features.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
}

/// Squared distance of the nearest triangle at the edge or corner where a triangle is closest.
fn nearest_at(mesh: &TriMesh, own: &Near, features: &[([u32; 2], f64)]) -> f64 {
    feature(mesh, own).map_or(own.square, |wanted| {
        let at = features.partition_point(|(feature, _)| *feature < wanted);
        features[at].1
    })
}

/// Leaves of several points one for each surface, in their order.
fn one_a_surface(centre: Vector, radius: f64, near: &[Near], found: &mut Vec<(Vector, Touch)>) {
    let by_distance =
        |a: &(Vector, Touch), b: &(Vector, Touch)| a.1.distance.total_cmp(&b.1.distance);
    found.sort_by(by_distance);
    let mut kept = 1;
    for at in 1..found.len() {
        let (point, touch) = found[at];
        let nearer = || found[..kept].iter().map(|(_, touch)| touch);
        let is_part = nearer().any(|other| other.holds(&touch, radius))
            || nearer().any(|other| other.before(&touch, radius))
                && near
                    .iter()
                    .any(|own| hides(&own.triangle, centre, point, radius));
        if !is_part {
            found[kept] = (point, touch);
            kept += 1;
        }
    }
    found.truncate(kept);
}

/// Whether a triangle stands between a centre and a point.
fn hides(triangle: &Triangle, centre: Vector, point: Vector, radius: f64) -> bool {
    let Triangle { a, b, c } = *triangle;
    let (ray, ab, ac) = (point - centre, b - a, c - a);
    let across = ray.cross(ac);
    let volume = ab.dot(across);
    if volume.abs() <= f64::EPSILON * ray.length() * ab.cross(ac).length() {
        return false;
    }
    // a ray through the edge between two triangles meets one of them at least
    const RIM: f64 = 1e-9;
    let from = centre - a;
    let u = from.dot(across) / volume;
    let turned = from.cross(ab);
    let v = ray.dot(turned) / volume;
    let way = ac.dot(turned) / volume * ray.length();
    u >= -RIM && v >= -RIM && u + v <= 1.0 + RIM && way > 0.0 && way < ray.length() - FLUSH * radius
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriMesh {
        TriMesh::new(
            vertices.iter().map(|&v| v.into()).collect(),
            triangles.to_vec(),
        )
        .unwrap()
    }

    fn touch(mesh: &TriMesh, centre: [f64; 3]) -> Touches {
        minima(mesh, centre.into(), 1.0, &mut Scratch::default())
    }

    const SQUARE: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    #[test]
    fn a_block_is_touched_where_parry_says() {
        let block = parry3d::shape::Cuboid::new(Vector::new(1.0, 2.0, 3.0));
        let places = [
            [1.4, 0.3, -0.2],
            [1.3, 2.2, 0.0],
            [-1.2, -2.3, 3.1],
            [0.2, 1.9, 0.1],
            [1.9, 2.9, 0.0],
            [0.0, 0.0, 3.999],
        ];
        for place in places.map(Vector::from) {
            let parry = block.project_local_point(place, false);
            let inside = if parry.is_inside { -1.0 } else { 1.0 };
            let distance = inside * (place - parry.point).length();
            let touch = closest(&block, place, 1.0);
            assert_eq!(touch.is_some(), distance < 1.0, "{place:?}");
            if let Some(touch) = touch {
                assert!((touch.distance - distance).abs() < 1e-14);
                let foot = place - touch.normal * touch.distance;
                assert!((foot - parry.point).length() < 1e-14);
            }
        }
    }

    #[test]
    fn a_flat_mesh_is_touched_once_on_faces_edges_and_corners() {
        let fan = mesh(
            &[
                [0.0, 0.0, 0.0],
                [3.0, 0.0, 0.0],
                [0.0, 3.0, 0.0],
                [-3.0, 0.0, 0.0],
                [0.0, -3.0, 0.0],
            ],
            &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]],
        );
        for (x, y) in [(0.0, 0.0), (0.3, 0.0), (0.0, 0.2), (0.4, 0.4), (1e-7, 0.1)] {
            let touches = touch(&fan, [x, y, 0.99]);
            assert_eq!(touches.as_slice().len(), 1, "at {x}, {y}");
            assert!((touches.as_slice()[0].distance - 0.99).abs() < 1e-12);
            assert!((touches.as_slice()[0].normal - Vector::Z).length() < 1e-12);
        }
    }

    #[test]
    fn a_groove_is_touched_on_both_flanks_and_a_ridge_on_its_crest() {
        let groove = mesh(
            &[
                [0.0, -3.0, 0.0],
                [0.0, 3.0, 0.0],
                [3.0, 3.0, 3.0],
                [3.0, -3.0, 3.0],
                [-3.0, 3.0, 3.0],
                [-3.0, -3.0, 3.0],
            ],
            &[[0, 1, 2], [0, 2, 3], [1, 0, 5], [1, 5, 4]],
        );
        let touches = touch(&groove, [0.0, 0.1, 1.3]);
        assert_eq!(touches.as_slice().len(), 2);
        let upward: f64 = touches.as_slice().iter().map(|t| t.normal.z).sum();
        assert!((upward - 2f64.sqrt()).abs() < 1e-12);
        let ridge = touch(&groove, [0.0, 0.1, -0.9]);
        assert_eq!(ridge.as_slice().len(), 1);
        assert!((ridge.as_slice()[0].normal + Vector::Z).length() < 1e-12);
    }

    #[test]
    fn the_rim_of_an_open_mesh_is_touched() {
        let plate = mesh(
            &[
                [0.0, 0.0, 0.0],
                [2.0, 0.0, 0.0],
                [2.0, 2.0, 0.0],
                [0.0, 2.0, 0.0],
            ],
            &SQUARE,
        );
        let touches = touch(&plate, [-0.5, 1.0, 0.0]);
        assert_eq!(touches.as_slice().len(), 1);
        assert!((touches.as_slice()[0].distance - 0.5).abs() < 1e-12);
    }

    #[test]
    fn triangles_that_miss_each_other_by_rounding_are_touched_once() {
        for gap in [1e-15, 1e-6, 1e-3, 0.03] {
            let split = mesh(
                &[
                    [-20.0, -20.0, 0.0],
                    [20.0, 20.0, 0.0],
                    [-20.0, 20.0, 0.0],
                    [-20.0 + gap, -20.0 - gap, 0.0],
                    [20.0, -20.0, 0.0],
                    [20.0 + gap, 20.0 - gap, 0.0],
                ],
                &[[0, 1, 2], [3, 4, 5]],
            );
            for x in [-0.3, -0.01, 0.0, 0.01, 0.3] {
                let touches = touch(&split, [x, 0.0, 0.98]);
                assert_eq!(touches.as_slice().len(), 1, "gap {gap} at {x}");
            }
        }
    }

    #[test]
    fn the_far_skin_of_a_wall_is_not_touched_and_a_ledge_below_is() {
        let slab = |z: f64, x: [f64; 2]| {
            let corner = |x: f64, y: f64| [x, y, z];
            [
                corner(x[0], -3.0),
                corner(x[1], -3.0),
                corner(x[1], 3.0),
                corner(x[0], 3.0),
            ]
        };
        let two = |low: [[f64; 3]; 4], high: [[f64; 3]; 4]| {
            let vertices: Vec<_> = low.into_iter().chain(high).collect();
            mesh(&vertices, &[[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
        };
        // right through the diagonal of the upper skin as well
        for place in [[0.2, 0.1, 0.9], [0.0, 0.0, 0.9]] {
            let shell = two(slab(-0.02, [-3.0, 3.0]), slab(0.0, [-3.0, 3.0]));
            assert_eq!(touch(&shell, place).as_slice().len(), 1, "{place:?}");
        }
        let ledge = two(slab(-0.02, [-0.1, 3.0]), slab(0.0, [-3.0, -0.1]));
        assert_eq!(touch(&ledge, [0.0, 0.3, 0.9]).as_slice().len(), 2);
    }

    #[test]
    fn a_hub_of_thousands_of_triangles_costs_as_many_steps() {
        // a flat fan and a pointed one: each triangle within reach
        let fan = |count: u32, height: f64| {
            let rim = (0..count).map(|side| {
                let (sin, cos) =
                    (std::f64::consts::TAU * f64::from(side) / f64::from(count)).sin_cos();
                [3.0 * cos, 3.0 * sin, 0.0]
            });
            let vertices: Vec<_> = std::iter::once([0.0, 0.0, height]).chain(rim).collect();
            let triangles: Vec<_> = (0..count)
                .map(|side| [0, 1 + side, 1 + (side + 1) % count])
                .collect();
            mesh(&vertices, &triangles)
        };
        let mut scratch = Scratch::default();
        let mut seconds = |count: u32| {
            let (flat, pointed) = (fan(count, 0.0), fan(count, 1.0));
            let mut best = f64::INFINITY;
            for _ in 0..5 {
                let start = std::time::Instant::now();
                for place in [[0.0, 0.0, 0.95], [0.21, 0.13, 0.95]] {
                    let found = minima(&flat, place.into(), 1.0, &mut scratch);
                    assert_eq!(found.as_slice().len(), 1);
                    let above = [place[0], place[1], 1.95];
                    let found = minima(&pointed, above.into(), 1.0, &mut scratch);
                    assert_eq!(found.as_slice().len(), 1);
                }
                best = best.min(start.elapsed().as_secs_f64());
            }
            best
        };
        let (few, many) = (seconds(400), seconds(12_800));
        // 32 times the triangles; the square would be a thousand times
        assert!(many < 200.0 * few, "{few} s, {many} s");
    }
}
