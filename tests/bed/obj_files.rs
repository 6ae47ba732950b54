//! OBJ in every dialect: read with the right number of triangles and the right volume, or refused with the true reason; none in silence.

use crate::mesh_lists::{CUBE, OBJ, Open, Read, Refused, Right, ascii, assert_right};
use crate::meshes::cube;
use impactlaw::dem::bodies::mesh::Format;

#[test]
fn obj_of_every_dialect() {
    let text = |from: &str, to: &str| {
        assert!(OBJ.contains(from), "{from}");
        OBJ.replace(from, to)
    };
    let files: Vec<(&str, String, Right)> = vec![
        ("faces of four", OBJ.to_owned(), CUBE),
        ("byte-order mark", format!("\u{feff}{OBJ}"), CUBE),
        ("Windows", text("\n", "\r\n"), CUBE),
        ("carriage returns", text("\n", "\r"), CUBE),
        ("tabs and blanks", text(" ", " \t "), CUBE),
        (
            "textures and normals",
            text("f 1 3 4 2", "f 1/1/1 3/1/1 4/1/1 2/1/1"),
            CUBE,
        ),
        (
            "normals alone",
            text("f 1 3 4 2", "f 1//1 3//1 4//1 2//1"),
            CUBE,
        ),
        (
            "textures alone",
            text("f 1 3 4 2", "f 1/1 3/1 4/1 2/1"),
            CUBE,
        ),
        (
            "counted from the end",
            text("f 1 3 4 2", "f -8 -6 -5 -7"),
            CUBE,
        ),
        (
            "colours at the corners",
            text("v -5 -5 0", "v -5 -5 0 0.2 0.3 0.4"),
            CUBE,
        ),
        (
            "weights at the corners",
            text("v -5 -5 0", "v -5 -5 0 1.0"),
            CUBE,
        ),
        ("continued lines", text("f 1 3 4 2", "f 1 3 \\\n4 2"), CUBE),
        ("triangles", text("f 1 3 4 2", "f 1 3 4\nf 1 4 2"), CUBE),
        (
            "comments behind",
            text("f 1 3 4 2", "f 1 3 4 2 # floor"),
            CUBE,
        ),
        (
            "lines and points beside",
            format!("{OBJ}l 1 2\np 3\n"),
            CUBE,
        ),
        ("no line end at the end", OBJ.trim_end().to_owned(), CUBE),
        (
            "double precision far away",
            OBJ.replace("v -5", "v 4000000.5")
                .replace("v 5", "v 4000010.5"),
            CUBE,
        ),
        (
            "a repeated face",
            format!("{OBJ}f 1 3 4 2\n"),
            Read(12, 1000.0, &["2 facets were left out as repeated"]),
        ),
        (
            "a face cut the other way too",
            format!("{OBJ}f 3 4 2 1\n"),
            Open(14, &[], "have not exactly two triangles"),
        ),
        (
            "a flipped face",
            text("f 1 3 4 2", "f 1 2 4 3"),
            Open(12, &[], "flipped"),
        ),
        ("a hole", text("f 1 3 4 2\n", ""), Open(10, &[], "4 edges")),
        // what is wrong
        (
            "a corner that is not there",
            text("f 1 3 4 2", "f 1 3 4 9"),
            Refused(&["corner `9`", "line 17", "8 corners"]),
        ),
        (
            "the corner zero",
            text("f 1 3 4 2", "f 0 3 4 2"),
            Refused(&["corner `0`", "line 17"]),
        ),
        (
            "further back than there are",
            text("f 1 3 4 2", "f -9 3 4 2"),
            Refused(&["corner `-9`"]),
        ),
        (
            "a face of two",
            text("f 1 3 4 2", "f 1 3"),
            Refused(&["2 corners", "line 17"]),
        ),
        (
            "decimal commas",
            text("v -5 -5 0", "v -5,0 -5 0"),
            Refused(&["no number", "`-5,0`", "line 4"]),
        ),
        (
            "a corner of two numbers",
            text("v -5 -5 0", "v -5 -5"),
            Refused(&["no number", "line 4"]),
        ),
        (
            "a dented face",
            text("f 1 3 4 2", "v 0 4 0\nf 1 3 9 4 2"),
            Refused(&["not convex", "line 18"]),
        ),
        (
            "curves",
            format!("{OBJ}curv 0 1 1 2\n"),
            Refused(&["`curv`", "polygons"]),
        ),
        ("no faces", text("f ", "# "), Refused(&["no triangle"])),
        ("empty", String::new(), Refused(&["no triangle"])),
        ("STL", ascii(&cube()), Refused(&["`solid` in line 1"])),
        ("binary", "\0\0\0".to_owned(), Refused(&["no OBJ file"])),
    ];
    let count = files.len();
    for (what, text, right) in &files {
        assert_right(what, text.as_bytes(), Format::Obj, right);
    }
    assert!(count >= 30, "{count}");
}
