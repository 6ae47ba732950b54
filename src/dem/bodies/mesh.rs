//! Mesh: triangle meshes from STL files and of simple thin-walled shapes, refused before use if they are broken.

use crate::dem::bodies::Solid;
use parry3d::math::Vector;
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::io::Cursor;

/// Reads the bytes of an STL file (ASCII or binary) whose lengths count `unit` (m).
///
/// # Errors
/// What is wrong with the file, as the end of a sentence that starts with its name.
pub fn read_stl(bytes: &[u8], unit: f64) -> Result<Solid, String> {
    let count = declared_triangles(bytes)?;
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| {
        format!("is no whole STL file ({error}); export it again, as binary or ASCII STL")
    })?;
    if mesh.faces.is_empty() || count == Some(0) {
        return Err("holds no triangle; export the body's surface".to_owned());
    }
    let vertices: Vec<Vector> = mesh
        .vertices
        .iter()
        .map(|v| Vector::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2])) * unit)
        .collect();
    if let Some(at) = vertices.iter().position(|vertex| !vertex.is_finite()) {
        return Err(format!(
            "has a corner that is no number (vertex {at}); repair the mesh or export it again"
        ));
    }
    let triangles: Vec<[u32; 3]> = mesh
        .faces
        .iter()
        .map(|face| face.vertices.map(|corner| corner as u32))
        .collect();
    let area = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|corner| vertices[corner as usize]);
        (b - a).cross(c - a).length()
    };
    let triangles: Vec<[u32; 3]> = triangles.into_iter().filter(|t| area(*t) > 0.0).collect();
    if triangles.is_empty() {
        return Err("has no triangle with an area; export the body's surface".to_owned());
    }
    Ok(Solid::Mesh {
        vertices,
        triangles,
    })
}

/// Triangles a binary STL file declares, if its length allows them; `None` for ASCII.
fn declared_triangles(bytes: &[u8]) -> Result<Option<usize>, String> {
    if bytes.starts_with(b"solid") && bytes.windows(5).any(|word| word == b"facet") {
        return Ok(None);
    }
    let Some(count) = bytes.get(80..84) else {
        return Err(format!(
            "is no STL file: it is cut off after {} bytes, before its count of triangles; export it again",
            bytes.len()
        ));
    };
    let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize;
    let needed = 84 + 50 * count;
    if bytes.len() < needed {
        return Err(format!(
            "is cut off: it declares {count} triangles ({needed} bytes) and has {} bytes; export it again",
            bytes.len()
        ));
    }
    Ok(Some(count))
}

/// Edges of a mesh that do not have exactly two triangles of opposite sense: none for a closed surface.
#[must_use]
pub fn open_edges(triangles: &[[u32; 3]]) -> usize {
    let mut sense: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
    for [a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let counts = sense.entry([*from.min(to), *from.max(to)]).or_default();
            counts[usize::from(from > to)] += 1;
        }
    }
    sense.values().filter(|counts| **counts != [1, 1]).count()
}

/// Length (m) of the shortest edge.
#[must_use]
pub fn shortest_edge(vertices: &[Vector], triangles: &[[u32; 3]]) -> f64 {
    let corner = |index: u32| vertices[index as usize];
    triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| (corner(a) - corner(b)).length())
        .fold(f64::INFINITY, f64::min)
}

/// Wall of a cone about z that is cut off at both ends: `bottom` and `top` radius (m) at z of -`height`/2 and
/// `height`/2. Equal radii make a tube, no height a ring.
///
/// ```
/// use impactlaw::bed::{bodies::Solid, mesh::cone};
/// let Solid::Mesh { vertices, triangles } = cone(1e-3, 2e-3, 1e-3, 12) else { panic!() };
/// assert_eq!((vertices.len(), triangles.len()), (24, 24));
/// ```
#[must_use]
pub fn cone(bottom: f64, top: f64, height: f64, sides: u32) -> Solid {
    let corner = |radius: f64, z: f64, side: u32| {
        let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
        Vector::new(radius * cos, radius * sin, z)
    };
    let rim = |radius: f64, z: f64| (0..sides).map(move |side| corner(radius, z, side));
    let vertices = rim(bottom, -0.5 * height)
        .chain(rim(top, 0.5 * height))
        .collect();
    let pairs = (0..sides).flat_map(|side| {
        let next = (side + 1) % sides;
        [
            ([side, next, sides + next], bottom),
            ([side, sides + next, sides + side], top),
        ]
    });
    // at a tip one triangle of each pair has no area
    let triangles = pairs
        .filter(|(_, radius)| *radius > 0.0)
        .map(|(triangle, _)| triangle)
        .collect();
    Solid::Mesh {
        vertices,
        triangles,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Binary STL of `triangles`.
    fn binary(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = vec![0u8; 80];
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0u8; 12]);
            for value in triangle.iter().flatten() {
                bytes.extend(value.to_le_bytes());
            }
            bytes.extend([0u8; 2]);
        }
        bytes
    }

    const CORNERS: [[f32; 3]; 4] = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 2.0],
    ];

    fn tetrahedron() -> Vec<[[f32; 3]; 3]> {
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
            .map(|face: [usize; 3]| face.map(|corner| CORNERS[corner]))
            .into()
    }

    #[test]
    fn a_binary_file_comes_in_metres_with_shared_corners() {
        let Solid::Mesh {
            vertices,
            triangles,
        } = read_stl(&binary(&tetrahedron()), 1e-3).unwrap()
        else {
            panic!()
        };
        assert_eq!((vertices.len(), triangles.len()), (4, 4));
        assert!(
            vertices
                .iter()
                .any(|v| (*v - Vector::X * 2e-3).length() < 1e-18)
        );
        assert_eq!(open_edges(&triangles), 0);
        assert_eq!(open_edges(&triangles[1..]), 3);
        assert!((shortest_edge(&vertices, &triangles) - 2e-3).abs() < 1e-12);
    }

    #[test]
    fn an_ascii_file_is_read_too() {
        let text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
        let Solid::Mesh { triangles, .. } = read_stl(text.as_bytes(), 1.0).unwrap() else {
            panic!()
        };
        assert_eq!(triangles.len(), 1);
        let cut = &text[..text.len() - 40];
        assert!(read_stl(cut.as_bytes(), 1.0).is_err());
    }

    #[test]
    fn broken_files_say_what_is_wrong() {
        let whole = binary(&tetrahedron());
        let says = |bytes: &[u8], words: &str| {
            let text = read_stl(bytes, 1.0).unwrap_err();
            assert!(text.contains(words), "{text}");
        };
        says(&whole[..whole.len() - 30], "cut off");
        says(&whole[..40], "cut off after 40 bytes");
        says(&binary(&[]), "no triangle");
        says(&binary(&[[[1.0; 3]; 3]]), "with an area");
        let mut nan = tetrahedron();
        nan[2][1][0] = f32::NAN;
        says(&binary(&nan), "no number");
    }
}
