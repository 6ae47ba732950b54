//! Mesh files made here, and what each must come to.

use crate::meshes::{Facet, cube};
use impactlaw::dem::bodies::Solid;
use impactlaw::dem::bodies::mesh::{Format, read};

/// What a file must come to.
pub enum Right {
    /// Triangles, volume in the file's unit, and words of each warning.
    Read(usize, f64, &'static [&'static str]),
    /// The same, and why it is not closed.
    Open(usize, &'static [&'static str], &'static str),
    /// Words of the reason.
    Refused(&'static [&'static str]),
}
pub use Right::{Open, Read, Refused};

/// Plain ASCII STL of these facets.
pub fn ascii(facets: &[Facet]) -> String {
    let mut text = String::from("solid part\n");
    for facet in facets {
        text += " facet normal 0 0 1\n  outer loop\n";
        for [x, y, z] in facet {
            text += &format!("   vertex {x} {y} {z}\n");
        }
        text += "  endloop\n endfacet\n";
    }
    text + "endsolid part\n"
}

/// OBJ of the cube with its eight corners and faces of four.
pub const OBJ: &str = "# cube\nmtllib cube.mtl\no cube\nv -5 -5 0\nv 5 -5 0\nv -5 5 0\nv 5 5 0\nv -5 -5 10\nv 5 -5 10\nv -5 5 10\nv 5 5 10\n\
    vt 0 0\nvn 0 0 1\ng sides\nusemtl red\ns off\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

pub fn volume(vertices: &[parry3d::math::Vector], triangles: &[[u32; 3]]) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|corner| vertices[corner as usize]);
        a.cross(b).dot(c)
    };
    triangles.iter().map(six).sum::<f64>() / 6.0
}

pub fn assert_right(what: &str, bytes: &[u8], format: Format, right: &Right) {
    let import = read(bytes, format, 1.0, 1e-3);
    let (count, volume_there, warnings, opening) = match (&import, right) {
        (Err(reason), Refused(says)) => {
            for say in *says {
                assert!(reason.contains(say), "{what}: {say:?} is not in: {reason}");
            }
            return;
        }
        (Err(reason), _) => panic!("{what}: refused: {reason}"),
        (Ok(import), Refused(_)) => panic!("{what}: read: {import:?}"),
        (Ok(_), Read(count, volume, warnings)) => (*count, Some(*volume), *warnings, None),
        (Ok(_), Open(count, warnings, why)) => (*count, None, *warnings, Some(*why)),
    };
    let import = import.unwrap();
    let Solid::Mesh {
        vertices,
        triangles,
    } = &import.solid
    else {
        panic!("{what}: no mesh")
    };
    assert_eq!(triangles.len(), count, "{what}");
    if let Some(right) = volume_there {
        let found = volume(vertices, triangles);
        assert!(
            (found / right - 1.0).abs() < 1e-6,
            "{what}: {found} for {right}"
        );
    }
    assert_eq!(
        import.warnings.len(),
        warnings.len(),
        "{what}: {:?}",
        import.warnings
    );
    for (warning, says) in import.warnings.iter().zip(warnings) {
        assert!(
            warning.contains(says),
            "{what}: {says:?} is not in: {warning}"
        );
    }
    match (&import.opening, opening) {
        (None, None) => {}
        (Some(found), Some(why)) => assert!(found.contains(why), "{what}: {found}"),
        (found, _) => panic!("{what}: {found:?}"),
    }
}

pub const CUBE: Right = Read(12, 1000.0, &[]);

/// The cube's facets, each corner changed.
pub fn changed(change: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<Facet> {
    let facets = cube();
    facets.into_iter().map(|facet| facet.map(&change)).collect()
}
