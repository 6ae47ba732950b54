//! Surfaces of bodies.

use super::Accepted;
use impactlaw::dem::bodies::mesh::{self, Format};

pub(super) const TETRAHEDRON: &str = "solid t
facet normal 0 0 -1
 outer loop
  vertex 0 0 0
  vertex 0 1 0
  vertex 1 0 0
 endloop
endfacet
facet normal 0 -1 0
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 0 0 1
 endloop
endfacet
facet normal -1 0 0
 outer loop
  vertex 0 0 0
  vertex 0 0 1
  vertex 0 1 0
 endloop
endfacet
facet normal 1 1 1
 outer loop
  vertex 1 0 0
  vertex 0 1 0
  vertex 0 0 1
 endloop
endfacet
endsolid t
";

pub(super) const OBJ: &str = "# t
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vn 0 0 1
f 1 3 2
f 1/1 2/1 4/1
f 1//1 4//1 3//1
f -3/1/1 -2/1/1 -1/1/1
";

/// The tetrahedron as single-precision facets.
pub(super) fn binary_tetrahedron() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(4u32.to_le_bytes());
    for corners in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
        bytes.extend([0; 12]);
        for corner in corners {
            for axis in 1..4 {
                bytes.extend(f32::from(u8::from(corner == axis)).to_le_bytes());
            }
        }
        bytes.extend([0; 2]);
    }
    bytes
}

pub(super) fn import(bytes: &[u8], format: Format) -> Accepted {
    let Ok(import) = mesh::read(bytes, format, 1e-3, 1e-7) else {
        return false;
    };
    assert!(import.solid.extent().is_finite() && import.solid.reach().is_finite());
    if let Ok(Some(volume)) = import.solid.volume(1e-3) {
        assert!(volume.is_finite());
    }
    true
}
