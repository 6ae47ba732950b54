//! Outline of a body for looking at: triangles, and the sharp edges between them.

use parry3d::math::Vector;
use parry3d::shape::{Cuboid, Shape};
use std::collections::BTreeMap;

/// Segments around a round shape.
const SEGMENTS: u32 = 32;
/// Half the edge of the part of an unbounded plane that is shown, in grain radii.
const PLANE: f64 = 40.0;
/// Cosine of the angle between two triangles up to which the edge between them counts as smooth: 30 degrees.
const SMOOTH: f64 = 0.866;
/// Corners nearer than this part of the outline's size are one corner.
const WELD: f64 = 1e-6;

/// Triangles of a shape and its sharp edges, about its own origin.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outline {
    /// Corners, m.
    pub vertices: Vec<Vector>,
    /// Corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Ends of each edge where the surface turns or ends.
    pub edges: Vec<[u32; 2]>,
}

impl Outline {
    /// Outline of a shape whose lengths count `unit` (m); empty for a kind of shape that no scene can name.
    #[must_use]
    pub fn of(shape: &dyn Shape, unit: f64) -> Self {
        let (vertices, triangles) = mesh(shape);
        let mut outline = Self {
            vertices: vertices.into_iter().map(|v| v * unit).collect(),
            triangles,
            edges: Vec::new(),
        };
        outline.edges = outline.sharp_edges();
        outline
    }

    fn normal(&self, [a, b, c]: [u32; 3]) -> Vector {
        let corner = |i: u32| self.vertices[i as usize];
        (corner(b) - corner(a))
            .cross(corner(c) - corner(a))
            .normalize_or_zero()
    }

    /// Number of the first corner at the place of each corner: meshes from files name one place many times.
    fn welded(&self) -> Vec<u32> {
        let (mut low, mut high) = (Vector::MAX, Vector::MIN);
        for &vertex in &self.vertices {
            (low, high) = (low.min(vertex), high.max(vertex));
        }
        let step = WELD * (high - low).length();
        let mut seen = BTreeMap::new();
        let corners = self.vertices.iter().zip(0u32..);
        corners
            .map(|(&vertex, index)| {
                let place = ((vertex - low) / step).to_array().map(|x| x.round() as i64);
                *seen.entry(place).or_insert(index)
            })
            .collect()
    }

    fn sharp_edges(&self) -> Vec<[u32; 2]> {
        let same = self.welded();
        let mut sides: BTreeMap<[u32; 2], Vec<Vector>> = BTreeMap::new();
        for &triangle in &self.triangles {
            let normal = self.normal(triangle);
            let corners = triangle.map(|corner| same[corner as usize]);
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                sides.entry([a.min(b), a.max(b)]).or_default().push(normal);
            }
        }
        let sharp = |normals: &[Vector]| match normals {
            [a, b] => a.dot(*b) < SMOOTH,
            _ => true,
        };
        let edges = sides.into_iter().filter(|(_, normals)| sharp(normals));
        edges.map(|(ends, _)| ends).collect()
    }
}

fn mesh(shape: &dyn Shape) -> (Vec<Vector>, Vec<[u32; 3]>) {
    if let Some(mesh) = shape.as_trimesh() {
        return (mesh.vertices().to_vec(), mesh.indices().to_vec());
    }
    if let Some(block) = shape.as_cuboid() {
        return block.to_trimesh();
    }
    if let Some(ball) = shape.as_ball() {
        return ball.to_trimesh(SEGMENTS, SEGMENTS / 2);
    }
    if let Some(cylinder) = shape.as_cylinder() {
        return cylinder.to_trimesh(SEGMENTS);
    }
    if shape.as_halfspace().is_some() {
        return Cuboid::new(Vector::new(PLANE, PLANE, 0.0)).to_trimesh();
    }
    (Vec::new(), Vec::new())
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry3d::shape::{Ball, Cylinder, TriMesh};

    #[test]
    fn a_block_shows_its_twelve_edges_a_ball_none_and_a_cylinder_its_two_rims() {
        let block = Outline::of(&Cuboid::new(Vector::new(1.0, 2.0, 3.0)), 2.0);
        assert_eq!((block.edges.len(), block.triangles.len()), (12, 12));
        let far = block.vertices.iter().map(|v| v.z).fold(0.0, f64::max);
        assert_eq!(far, 6.0);
        assert!(Outline::of(&Ball::new(1.0), 1.0).edges.is_empty());
        let rims = Outline::of(&Cylinder::new(1.0, 1.0), 1.0).edges;
        assert_eq!(rims.len(), 2 * SEGMENTS as usize);
    }

    #[test]
    fn an_open_sheet_of_separate_triangles_shows_its_border_and_not_its_seam() {
        let corner = |x: f64, y: f64| Vector::new(x, y, 0.0);
        let (a, b, c, d) = (
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        );
        let sheet = TriMesh::new(vec![a, b, c, a, c, d], vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        assert_eq!(Outline::of(&sheet, 1.0).edges.len(), 4);
    }
}
