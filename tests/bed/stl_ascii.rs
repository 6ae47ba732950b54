//! ASCII STL in every dialect: read with the right number of triangles and the right volume, or refused with the true reason; none in
//! silence.

use crate::mesh_lists::{CUBE, Refused, Right, ascii, assert_right};
use crate::meshes::cube;
use impactlaw::dem::bodies::mesh::Format;

#[test]
fn ascii_stl_of_every_dialect() {
    let plain = ascii(&cube());
    let text = |from: &str, to: &str| {
        assert!(plain.contains(from), "{from}");
        plain.replace(from, to)
    };
    let first = |from: &str, to: &str| {
        assert!(plain.contains(from), "{from}");
        plain.replacen(from, to, 1)
    };
    let files: Vec<(&str, String, Right)> = vec![
        ("plain", plain.clone(), CUBE),
        ("capitals", plain.to_uppercase(), CUBE),
        ("no name", text(" part", ""), CUBE),
        (
            "a name of many words",
            text("solid part", "solid a facet of a loop, vertex 3"),
            CUBE,
        ),
        (
            "a name in another script",
            text("part", "Gehäuse 部品"),
            CUBE,
        ),
        ("byte-order mark", format!("\u{feff}{plain}"), CUBE),
        ("blank lines before", format!("\n \t\n{plain}"), CUBE),
        ("carriage returns", text("\n", "\r"), CUBE),
        ("Windows", text("\n", "\r\n"), CUBE),
        (
            "mixed line ends",
            first("\n", "\r\n").replacen('\n', "\r", 9),
            CUBE,
        ),
        ("tabs", text(" ", "\t"), CUBE),
        ("one line", text("\n", " "), CUBE),
        (
            "nan normals",
            text("normal 0 0 1", "normal nan -nan(ind) NaN"),
            CUBE,
        ),
        ("no normals", text("normal 0 0 1", ""), CUBE),
        (
            "the word normal alone",
            text("normal 0 0 1", "normal"),
            CUBE,
        ),
        ("wrong normals", text("normal 0 0 1", "normal 7 7 7"), CUBE),
        ("end loop", text("endloop", "end loop"), CUBE),
        ("end facet", text("endfacet", "end facet"), CUBE),
        ("end solid", text("endsolid", "end solid"), CUBE),
        (
            "no name at the end",
            text("endsolid part", "endsolid"),
            CUBE,
        ),
        (
            "exponents without a digit behind the point",
            text("-5", "-5.e0").replace(" 5", " .5e+1"),
            CUBE,
        ),
        ("Fortran's exponents", text("10", "1.0D+01"), CUBE),
        ("plus signs", text(" 5", " +5"), CUBE),
        ("minus zeros", text(" 0\n", " -0.0\n"), CUBE),
        (
            "empty first solid",
            format!("solid a\nendsolid a\n{plain}"),
            CUBE,
        ),
        (
            "empty solids between",
            format!("solid\nendsolid\n{plain}solid\nendsolid\n"),
            CUBE,
        ),
        (
            "a solid for each facet",
            cube().iter().map(|facet| ascii(&[*facet])).collect(),
            CUBE,
        ),
        ("no line end at the end", plain.trim_end().to_owned(), CUBE),
        ("blanks at the end", format!("{plain}\n \n\t\n"), CUBE),
        ("padded with zero bytes", format!("{plain}\0\0\0\0"), CUBE),
        // what is wrong
        (
            "decimal commas",
            text(" 5", " 5,0"),
            Refused(&["no number", "`5,0`", "line"]),
        ),
        (
            "truncated in a number",
            plain[..plain.len() / 2].to_owned(),
            Refused(&["cut off after"]),
        ),
        (
            "truncated before its end",
            plain.replace("endsolid part\n", ""),
            Refused(&["cut off after 12 triangles", "endsolid"]),
        ),
        (
            "junk behind",
            format!("{plain}made by hand\n"),
            Refused(&["`made`", "end of the file"]),
        ),
        ("junk within", first("  outer", "  hello outer"), CUBE),
        (
            "a corner of two numbers",
            first("-5 -5 0", "-5 -5"),
            Refused(&["no number", "`vertex`"]),
        ),
        (
            "a corner that is none",
            first("-5 -5 0", "-5 inf 0"),
            Refused(&["no number", "`inf`"]),
        ),
        (
            "a facet of four corners",
            first("  endloop", "  vertex 1 1 1\n  endloop"),
            Refused(&["4 corners", "line 2"]),
        ),
        (
            "a facet without a loop",
            first("  outer loop\n", ""),
            Refused(&["`facet` in line 8", "outer loop"]),
        ),
        (
            "not a word of STL",
            first("endfacet", "endfacete"),
            Refused(&["`endfacete`", "endfacet"]),
        ),
        ("empty", String::new(), Refused(&["is empty"])),
        ("blank", " \n".to_owned(), Refused(&["no STL file"])),
        (
            "no facets",
            "solid part\nendsolid part\n".to_owned(),
            Refused(&["no triangle"]),
        ),
        (
            "a web page",
            "<!DOCTYPE html><html></html>".to_owned(),
            Refused(&["no STL file", "<!DOCTYPE"]),
        ),
        (
            "STEP",
            "ISO-10303-21;\nHEADER;\n".to_owned(),
            Refused(&["STEP", "export"]),
        ),
        (
            "PLY",
            "ply\nformat ascii 1.0\n".to_owned(),
            Refused(&["PLY", "export"]),
        ),
        (
            "OFF",
            "OFF\n8 6 12\n".to_owned(),
            Refused(&["OFF", "export"]),
        ),
    ];
    // "junk within" is a normal with a word too many, which some programs write
    let count = files.len();
    for (what, text, right) in &files {
        assert_right(what, text.as_bytes(), Format::Stl, right);
    }
    assert!(count >= 45, "{count}");
}
