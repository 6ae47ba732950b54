//! Mesh files made here in every dialect: each is read with the right number of triangles and the right volume, or refused
//! with the true reason; none in silence.

use crate::meshes::{Facet, binary, cube};
use impactlaw::dem::bodies::Solid;
use impactlaw::dem::bodies::mesh::{Format, read};

/// What a file must come to.
enum Right {
    /// Triangles, volume in the file's unit, and words of each warning.
    Read(usize, f64, &'static [&'static str]),
    /// The same, and why it is not closed.
    Open(usize, &'static [&'static str], &'static str),
    /// Words of the reason.
    Refused(&'static [&'static str]),
}
use Right::{Open, Read, Refused};

/// Plain ASCII STL of these facets.
fn ascii(facets: &[Facet]) -> String {
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
const OBJ: &str = "# cube\nmtllib cube.mtl\no cube\nv -5 -5 0\nv 5 -5 0\nv -5 5 0\nv 5 5 0\nv -5 -5 10\nv 5 -5 10\nv -5 5 10\nv 5 5 10\n\
    vt 0 0\nvn 0 0 1\ng sides\nusemtl red\ns off\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

fn volume(vertices: &[parry3d::math::Vector], triangles: &[[u32; 3]]) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|corner| vertices[corner as usize]);
        a.cross(b).dot(c)
    };
    triangles.iter().map(six).sum::<f64>() / 6.0
}

fn assert_right(what: &str, bytes: &[u8], format: Format, right: &Right) {
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

const CUBE: Right = Read(12, 1000.0, &[]);

/// The cube's facets, each corner changed.
fn changed(change: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<Facet> {
    let facets = cube();
    facets.into_iter().map(|facet| facet.map(&change)).collect()
}

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

#[test]
fn binary_stl_of_every_dialect() {
    let whole = binary(b"made here", &cube());
    let with = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = whole.clone();
        change(&mut bytes);
        bytes
    };
    let attributes = |value: u16| {
        with(&|bytes| {
            for facet in 0..12 {
                bytes[84 + 50 * facet + 48..][..2].copy_from_slice(&value.to_le_bytes());
            }
        })
    };
    let far = |shift: f64| binary(b"", &changed(|[x, y, z]| [x + shift, y, z]));
    let zip = [b"PK\x03\x04\x14\x00".to_vec(), vec![7; 900]].concat();
    let gz = [b"\x1f\x8b\x08\x00".to_vec(), vec![9; 900]].concat();
    let files: Vec<(&str, Vec<u8>, Right)> = vec![
        ("plain", whole.clone(), CUBE),
        ("header of blanks", binary(b"", &cube()), CUBE),
        (
            "header that begins with solid",
            binary(b"solid part", &cube()),
            CUBE,
        ),
        (
            "header like a whole file",
            binary(
                b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                &cube(),
            ),
            CUBE,
        ),
        ("header with a newline", binary(b"solid\r\n", &cube()), CUBE),
        ("header of zeros", binary(&[0; 80], &cube()), CUBE),
        (
            "header of Magics",
            binary(b"COLOR=\xff\x00\x00\xff,MATERIAL=\x01\x02", &cube()),
            CUBE,
        ),
        ("colours of Magics", attributes(0x001f), CUBE),
        ("colours of VisCAM", attributes(0x801f), CUBE),
        ("attributes of all bits", attributes(0xffff), CUBE),
        ("zeros behind", [whole.clone(), vec![0; 12]].concat(), CUBE),
        (
            "a newline behind",
            [whole.clone(), b"\r\n".to_vec()].concat(),
            CUBE,
        ),
        (
            "two solids",
            [binary(b"", &cube()[..7]), binary(b"", &cube()[7..])].concat(),
            CUBE,
        ),
        (
            "minus zeros",
            binary(
                b"",
                &changed(|v| v.map(|x| if x == 0.0 { -0.0 } else { x })),
            ),
            CUBE,
        ),
        (
            "a float apart",
            binary(b"", &changed(|[x, y, z]| [x + 5e-7 * y, y, z])),
            CUBE,
        ),
        ("moved by 4 000", far(4e3), CUBE),
        (
            "moved by 40 000",
            far(4e4),
            Read(12, 1000.0, &["single precision"]),
        ),
        (
            "moved by 4 million",
            far(4e6),
            Refused(&["the shape is lost", "tolerance"]),
        ),
        (
            "repeated facets",
            binary(b"", &[cube(), cube()[..3].to_vec()].concat()),
            Read(12, 1000.0, &["3 facets were left out as repeated"]),
        ),
        (
            "a sliver",
            binary(
                b"",
                &[
                    cube(),
                    vec![[[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [5.0, -4.99999, 0.0]]],
                ]
                .concat(),
            ),
            Read(12, 1000.0, &["1 facet was left out, narrower"]),
        ),
        (
            "a facet without an area",
            binary(b"", &[cube(), vec![[[1.0; 3]; 3]]].concat()),
            Read(12, 1000.0, &["1 facet was left out, narrower"]),
        ),
        (
            "corners in a line",
            binary(
                b"",
                &[
                    cube(),
                    vec![[[0.0, 0.0, 20.0], [1.0, 0.0, 20.0], [2.0, 0.0, 20.0]]],
                ]
                .concat(),
            ),
            Open(12, &["in one line"], "have not exactly two triangles"),
        ),
        (
            "a hole",
            binary(b"", &cube()[..11]),
            Open(11, &[], "3 edges have not exactly two triangles"),
        ),
        (
            "flipped",
            binary(b"", &{
                let mut facets = cube();
                facets[4].swap(0, 1);
                facets
            }),
            Open(12, &[], "facet 5 at"),
        ),
        (
            "a fin: an edge of three facets",
            binary(
                b"",
                &[
                    cube(),
                    vec![[[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, -9.0, 5.0]]],
                ]
                .concat(),
            ),
            Open(13, &[], "have not exactly two triangles"),
        ),
        // what is wrong
        (
            "count too large",
            with(&|bytes| bytes[80] = 13),
            Refused(&["cut off", "13 triangles", "684 bytes"]),
        ),
        (
            "count of gigabytes",
            with(&|bytes| bytes[80..84].fill(0xff)),
            Refused(&["cut off", "4294967295"]),
        ),
        (
            "count too small",
            with(&|bytes| bytes[80] = 11),
            Refused(&["50 bytes more", "11 triangles"]),
        ),
        (
            "count of none",
            with(&|bytes| bytes[80] = 0),
            Refused(&["600 bytes more"]),
        ),
        (
            "truncated",
            whole[..500].to_vec(),
            Refused(&["cut off", "12 triangles", "500 bytes"]),
        ),
        (
            "truncated in the header",
            with(&|bytes| bytes.truncate(60)),
            Refused(&["no STL file"]),
        ),
        (
            "junk behind",
            [whole.clone(), b"garbage".to_vec()].concat(),
            Refused(&["7 bytes more"]),
        ),
        (
            "a corner that is no number",
            with(&|bytes| bytes[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes())),
            Refused(&["no number", "facet 1"]),
        ),
        (
            "an infinite corner",
            with(&|bytes| bytes[84 + 62..84 + 66].copy_from_slice(&f32::INFINITY.to_le_bytes())),
            Refused(&["no number", "facet 2"]),
        ),
        ("no triangle", binary(b"", &[]), Refused(&["no triangle"])),
        ("3MF, which is a ZIP archive", zip, Refused(&["ZIP", "3MF"])),
        ("compressed", gz, Refused(&["gzip", "unpack"])),
    ];
    let count = files.len();
    for (what, bytes, right) in &files {
        assert_right(what, bytes, Format::Stl, right);
    }
    assert!(count >= 35, "{count}");
}

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
