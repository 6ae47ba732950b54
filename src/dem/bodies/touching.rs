//! Touching points of a ball on a shape, by parry: closest points, and for triangle meshes the local minima of distance.
//!
//! A ball pressed on an edge shared by two triangles touches once, not twice; pressed into a groove it touches both
//! flanks. Both follow from one rule: a point is touched where the distance from the ball's centre to the mesh has a
//! local minimum, that is, where the closest point of a triangle is also the closest point of every other triangle
//! that holds it.

use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::query::PointQuery;
use parry3d::shape::{Shape, TriMesh, Triangle};

/// Most points at which one ball may touch one mesh.
pub const MAX_TOUCHES: usize = 6;
/// Distance, in grain radii, below which two points are one: far above rounding, far below any overlap.
const SAME_POINT: f64 = 1e-9;

/// A touched point, in the frame and unit of the shape.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Touch {
    /// Unit normal from the shape to the ball's centre.
    pub normal: Vector,
    /// Distance from the centre to the surface; negative if the centre is inside.
    pub distance: f64,
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

/// Local minima of the distance from `centre` to a mesh, nearer than `reach`. `scratch` is working space.
#[must_use]
pub fn minima(
    mesh: &TriMesh,
    centre: Vector,
    reach: f64,
    scratch: &mut Vec<(Triangle, Vector)>,
) -> Touches {
    scratch.clear();
    let ball = Aabb::from_half_extents(centre, Vector::splat(reach));
    for id in mesh.bvh().intersect_aabb(&ball) {
        let triangle = mesh.triangle(id);
        let point = triangle.project_local_point(centre, false).point;
        if (point - centre).length_squared() < reach * reach {
            scratch.push((triangle, point));
        }
    }
    let mut touches = Touches::default();
    for (index, &(_, point)) in scratch.iter().enumerate() {
        let same = |other: Vector| (other - point).length_squared() < SAME_POINT * SAME_POINT;
        let first_of_its_kind = !scratch[..index].iter().any(|&(_, other)| same(other));
        let minimum = scratch.iter().all(|(triangle, own)| {
            same(*own) || !same(triangle.project_local_point(point, false).point)
        });
        let line = centre - point;
        let distance = line.length();
        if first_of_its_kind && minimum && distance > 0.0 {
            touches.add(Touch {
                normal: line / distance,
                distance,
            });
        }
    }
    touches
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
        minima(mesh, centre.into(), 1.0, &mut Vec::new())
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
}
