//! Mesh files as people have them: every dialect is read to the same shape, or refused with the true reason.

use impactlaw::bed::scene::Scene;
use impactlaw::dem::bodies::mesh::{Format, Import, read};
use impactlaw::dem::bodies::{Mobility, Solid};

pub type Facet = [[f64; 3]; 3];

/// Cube of edge 10 on the plane z = 0, about the z axis.
pub fn cube() -> Vec<Facet> {
    let corner = |at: usize| {
        let side = |bit: usize| if at >> bit & 1 == 1 { 5.0 } else { -5.0 };
        [side(0), side(1), side(2) + 5.0]
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    let facets = quads.into_iter().flat_map(halves);
    facets.map(|facet| facet.map(corner)).collect()
}

/// How an ASCII file is written.
#[derive(Debug, Clone, Copy)]
struct Style {
    lead: &'static str,
    name: &'static str,
    normal: &'static str,
    end_loop: &'static str,
    line: &'static str,
    case: fn(&str) -> String,
    number: fn(f64) -> String,
    /// Facets of each solid: the file holds several.
    solids: usize,
}

fn ascii(facets: &[Facet], style: Style) -> Vec<u8> {
    let key = style.case;
    let mut lines = Vec::new();
    let size = facets.len().div_ceil(style.solids);
    let mut solids: Vec<&[Facet]> = facets.chunks(size).collect();
    if style.solids > 2 {
        solids.insert(0, &[]);
    }
    for solid in solids {
        lines.push(format!("{} {}", key("solid"), style.name));
        for facet in solid {
            lines.push(format!("  {} {}", key("facet"), style.normal));
            lines.push(format!("    {} {}", key("outer"), key("loop")));
            for corner in facet {
                let [x, y, z] = corner.map(style.number);
                lines.push(format!("      {} {x} {y}\t{z}", key("vertex")));
            }
            lines.push(format!("    {}", key(style.end_loop)));
            lines.push(format!("  {}", key("endfacet")));
        }
        lines.push(format!("{} {}", key("endsolid"), style.name));
    }
    let text = lines.join(style.line);
    format!("{}{text}{}", style.lead, style.line).into_bytes()
}

fn capital(word: &str) -> String {
    word[..1].to_uppercase() + &word[1..]
}

/// Binary STL with a header of 80 bytes that begins with `header`.
pub fn binary(header: &[u8], facets: &[Facet]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0xffu8; 12]);
        for value in facet.iter().flatten() {
            bytes.extend((*value as f32).to_le_bytes());
        }
        bytes.extend([0x17, 0x80]);
    }
    bytes
}

fn same_shape(import: &Import, facets: &[Facet], what: &str) {
    let Solid::Mesh {
        vertices,
        triangles,
    } = &import.solid
    else {
        panic!()
    };
    let read: Vec<Facet> = triangles
        .iter()
        .map(|triangle| triangle.map(|corner| vertices[corner as usize].to_array()))
        .collect();
    assert_eq!(read, facets, "{what}");
    assert!(
        vertices.iter().all(|v| v
            .to_array()
            .iter()
            .all(|x| x.to_bits() != (-0.0f64).to_bits())),
        "{what}: a negative zero"
    );
    assert_eq!(import.opening, None, "{what}");
    assert_eq!(import.warnings, Vec::<String>::new(), "{what}");
}

#[test]
fn every_dialect_of_stl_is_read_to_the_same_closed_cube() {
    let cube = cube();
    let leads = ["", " \t", "\u{feff}", "\n\n  "];
    let names = ["", "part", "facet normal plate", "ascii 2.0 endsolid"];
    let normals = [
        "normal 0 0 1",
        "normal nan NaN -nan(ind)",
        "normal",
        "normal 1.#QNAN 0 0",
    ];
    let ends = ["endloop", "end loop"];
    let lines = ["\n", "\r\n", "\r"];
    let cases: [fn(&str) -> String; 3] = [str::to_owned, str::to_uppercase, capital];
    let numbers: [fn(f64) -> String; 5] = [
        |x| format!("{x}"),
        |x| format!("{x:.9e}"),
        |x| format!("{:.6}", if x == 0.0 { -0.0 } else { x }),
        |x| format!("{x:+E}"),
        |x| format!("{x:e}").replace('e', "D"),
    ];
    let mut files = 0;
    for at in 0..120 {
        let style = Style {
            lead: leads[at % 4],
            name: names[at / 4 % 4],
            normal: normals[at % 3 + at / 60],
            end_loop: ends[at / 3 % 2],
            line: lines[at / 2 % 3],
            case: cases[at / 7 % 3],
            number: numbers[at % 5],
            solids: 1 + at / 5 % 4,
        };
        let import = read(&ascii(&cube, style), Format::Stl, 1.0, 1e-3);
        same_shape(&import.unwrap(), &cube, &format!("{style:?}"));
        files += 1;
    }
    assert!(files >= 60);
}

#[test]
fn a_file_in_one_line_is_read() {
    let plain = Style {
        lead: "",
        name: "",
        normal: "normal 0 0 1",
        end_loop: "endloop",
        line: " ",
        case: str::to_owned,
        number: |x| format!("{x}"),
        solids: 1,
    };
    let import = read(&ascii(&cube(), plain), Format::Stl, 1.0, 1e-3);
    same_shape(&import.unwrap(), &cube(), "one line");
}

#[test]
fn binary_files_are_read_whatever_their_header_says() {
    let cube = cube();
    let headers: [&[u8]; 6] = [
        b"",
        b"solid part",
        b"solid\nfacet normal 0 0 1\nouter loop\n",
        b"SOLID\r\n",
        b"\xef\xbb\xbf",
        b"COLOR=\x00\x01\x02\xff,MATERIAL=\x00",
    ];
    for header in headers {
        let whole = binary(header, &cube);
        let what = format!("{header:?}");
        let read = |bytes: &[u8]| read(bytes, Format::Stl, 1.0, 1e-3).unwrap();
        same_shape(&read(&whole), &cube, &what);
        same_shape(&read(&[&whole[..], b"\0\0\0\n"].concat()), &cube, &what);
        let parts = [
            binary(header, &[]),
            binary(header, &cube[..5]),
            binary(header, &cube[5..]),
        ];
        same_shape(&read(&parts.concat()), &cube, &what);
    }
}

#[test]
fn ascii_coordinates_keep_double_precision() {
    let place = |x: f64| [x, 4_000_000.123_456_789, 0.1];
    let facet = [place(0.1), place(1.0 / 3.0), [1.0, 1.0, 1.0]];
    let style = Style {
        lead: "",
        name: "",
        normal: "normal 0 0 0",
        end_loop: "endloop",
        line: "\n",
        case: str::to_owned,
        number: |x| format!("{x:.17e}"),
        solids: 1,
    };
    let import = read(&ascii(&[facet], style), Format::Stl, 1.0, 0.0).unwrap();
    let Solid::Mesh { vertices, .. } = import.solid else {
        panic!()
    };
    assert_eq!(
        vertices.iter().map(|v| v.to_array()).collect::<Vec<_>>(),
        facet
    );
}

fn refused(bytes: &[u8], format: Format, says: &[&str]) {
    let wrong = read(bytes, format, 1.0, 1e-3).unwrap_err();
    for say in says {
        assert!(wrong.contains(say), "{say:?} is not in: {wrong}");
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_its_reason_and_line() {
    let whole = binary(b"", &cube());
    let text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\nendloop\nendfacet\nendsolid a\n";
    let stl = |bytes: &[u8], says: &[&str]| refused(bytes, Format::Stl, says);
    let with = |from: &str, to: &str, says: &[&str]| {
        assert!(text.contains(from));
        stl(text.replacen(from, to, 1).as_bytes(), says);
    };
    stl(b"", &["is empty"]);
    stl(
        &whole[..whole.len() - 30],
        &["cut off", "12 triangles", "684 bytes", "654 bytes"],
    );
    stl(
        &whole[..40].iter().map(|b| b & 1).collect::<Vec<_>>(),
        &["cut off after 40 bytes"],
    );
    stl(
        &[&whole[..], &[7u8; 30]].concat(),
        &["30 bytes more", "12 triangles"],
    );
    let mut uncounted = whole.clone();
    uncounted[80..84].fill(0);
    stl(&uncounted, &["600 bytes more", "0 triangles"]);
    stl(&binary(b"", &[]), &["no triangle"]);
    stl(b"solid a\nendsolid a\n", &["no triangle"]);
    stl(
        b"<html><body>not found</body></html>",
        &["no STL file", "<html>"],
    );
    stl(
        "\u{feff}solid"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect::<Vec<_>>()
            .as_slice(),
        &["UTF-16"],
    );
    let word_ends = text.match_indices(char::is_whitespace).map(|(at, _)| at);
    for end in word_ends.filter(|end| *end < text.rfind("endsolid").unwrap()) {
        stl(&text.as_bytes()[..end], &["cut off after"]);
    }
    with(
        "vertex 9 0 0",
        "vertex 9,5 0 0",
        &["no number", "`9,5`", "line 5"],
    );
    with(
        "vertex 9 0 0",
        "vertex nan 0 0",
        &["no number", "`nan`", "line 5"],
    );
    with("vertex 9 0 0", "vertex 1e999 0 0", &["no number", "line 5"]);
    with("vertex 9 0 0\n", "", &["2 corners", "line 2"]);
    with("endloop", "vertex 9 9 0\nendloop", &["4 corners", "line 2"]);
    with(
        "endfacet",
        "endfact",
        &["`endfact`", "line 8", "triangle 1"],
    );
    with("outer", "inner", &["cut off", "outer loop"]);
    with("solid a", "solid a\nsolid b", &["`solid`", "line 2"]);
    with(
        "endsolid a\n",
        "endsolid a\nfacet\n",
        &["`facet`", "line 10"],
    );
    let mut not_a_number = cube();
    not_a_number[7][1][2] = f64::NAN;
    stl(
        &binary(b"", &not_a_number),
        &["no number", "facet 8", "repair"],
    );
    stl(
        &binary(b"", &[[[1.0; 3]; 3]]),
        &["with an area", "facet 1", "scale"],
    );
}

#[test]
fn facets_that_are_left_out_or_flipped_are_named_with_number_and_place() {
    let named = |facets: &[Facet]| read(&binary(b"", facets), Format::Stl, 1.0, 1e-3).unwrap();
    let mut flipped = cube();
    flipped[6].swap(0, 1);
    let opening = named(&flipped).opening.unwrap();
    assert!(
        opening.starts_with("facet 7 at (-1.667, 5, 6.667) is flipped"),
        "{opening}"
    );
    flipped[3].swap(0, 1);
    let opening = named(&flipped).opening.unwrap();
    assert!(
        opening.contains("facet 4") && opening.contains("facet 7"),
        "{opening}"
    );
    let opening = named(&cube()[..11]).opening.unwrap();
    assert!(
        opening.starts_with("3 edges") && opening.contains("of facet 3"),
        "{opening}"
    );
    // a sliver narrower than the tolerance, a repeated facet, and one without an area whose corners are apart
    let (mut more, a) = (cube(), cube()[0]);
    more.push([a[0], [a[0][0] + 1e-4, a[0][1], a[0][2]], a[1]]);
    more.push([a[1], a[2], a[0]]);
    more.push([[-5.0, 0.0, 0.0], [0.0, 0.0, 0.0], [5.0, 0.0, 0.0]]);
    let warnings = named(&more).warnings;
    for (warning, says) in warnings.iter().zip([
        "facet 13 at",
        "repeated, the first facet 14",
        "in one line, the first facet 15",
    ]) {
        assert!(
            warning.starts_with("1 facet was left out") && warning.contains(says),
            "{warnings:?}"
        );
    }
    assert_eq!(warnings.len(), 3);
}

#[test]
fn corners_closer_than_the_tolerance_are_one_and_slivers_wider_than_it_are_kept() {
    // every corner of every facet moved by itself, by less than half the tolerance
    let mut moved = cube();
    let mut seed = 1u32;
    for value in moved.iter_mut().flatten().flatten() {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *value += (f64::from(seed) / f64::from(u32::MAX) - 0.5) * 0.5e-3;
    }
    let import = read(&binary(b"", &moved), Format::Stl, 1.0, 1e-3).unwrap();
    assert_eq!((import.opening, import.warnings), (None, Vec::new()));
    assert!(
        read(&binary(b"", &moved), Format::Stl, 1.0, 0.0)
            .unwrap()
            .opening
            .is_some()
    );
    let sliver = [[[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 2e-3, 0.0]]];
    let import = read(&binary(b"", &sliver), Format::Stl, 1.0, 1e-3).unwrap();
    assert_eq!(import.warnings, Vec::<String>::new());
    assert!(matches!(import.solid, Solid::Mesh { triangles, .. } if triangles.len() == 1));
}

#[test]
fn coordinates_that_single_precision_has_spoilt_are_told() {
    let surveyed = |far: f64| {
        let move_it = |corner: [f64; 3]| [corner[0] + far, corner[1], corner[2]];
        let facets: Vec<Facet> = cube().into_iter().map(|facet| facet.map(move_it)).collect();
        read(&binary(b"", &facets), Format::Stl, 1.0, 1e-3)
    };
    assert_eq!(surveyed(4e3).unwrap().warnings, Vec::<String>::new());
    let warnings = surveyed(32e3).unwrap().warnings;
    assert!(
        warnings[0].contains("single precision") && warnings.len() == 1,
        "{warnings:?}"
    );
    let lost = surveyed(4e6).unwrap_err();
    assert!(
        lost.contains("the shape is lost") && lost.contains("tolerance"),
        "{lost}"
    );
}

#[test]
fn obj_files_are_read_too() {
    let cube = cube();
    let mut text = "# a cube\nmtllib no.mtl\no cube\n".to_owned();
    for corner in cube.iter().flatten() {
        text += &format!("v {} {} {} 1.0\n", corner[0], corner[1], corner[2]);
    }
    let indexed = |form: &dyn Fn(usize) -> String| {
        let facets = (0..cube.len()).map(|at| {
            let [a, b, c] = [1, 2, 3].map(|corner| form(3 * at + corner));
            format!("f {a} {b} {c}\n")
        });
        text.clone() + "vn 0 0 1\ns off\n" + &facets.collect::<String>()
    };
    let count = 3 * cube.len();
    let forms: [&dyn Fn(usize) -> String; 4] = [
        &|at| format!("{at}"),
        &|at| format!("{at}/{at}/1"),
        &|at| format!("{at}//1"),
        &|at| format!("{}", at as i64 - count as i64 - 1),
    ];
    for form in forms {
        let import = read(indexed(form).as_bytes(), Format::Obj, 1.0, 1e-3).unwrap();
        same_shape(&import, &cube, &form(1));
    }
    let square = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";
    let quad = format!("{square}f 1 2 \\\n3 4\n");
    let import = read(quad.as_bytes(), Format::Obj, 1.0, 1e-3).unwrap();
    assert!(
        matches!(import.solid, Solid::Mesh { triangles, .. } if triangles == [[0, 1, 2], [0, 2, 3]])
    );
    let wrong = |lines: &str, says: &[&str]| {
        refused(format!("{square}{lines}\n").as_bytes(), Format::Obj, says);
    };
    wrong("f 1 2 5", &["corner `5`", "line 5", "4 corners"]);
    wrong("f 1 2", &["2 corners", "line 5"]);
    wrong("v 0 x 0", &["no number", "`x`", "line 5"]);
    wrong("v 0.5 0.5 0\nf 1 2 5 4", &["not convex", "line 6"]);
    wrong("curv 0 1 1 2", &["`curv`", "line 5"]);
    wrong("", &["no triangle"]);
}

/// A scene with a free cube.
const FREE: &str = r#"
seed = 1
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[grains]
count = 10
radius = "1 mm"
region = { low = ["0 mm", "0 mm", "0 mm"], high = ["20 mm", "20 mm", "8 mm"] }
[box]
width = "20 mm"
depth = "20 mm"
height = "40 mm"
[[body]]
name = "cube"
mesh = "cube.stl"
scale = "1 mm"
at = ["10 mm", "10 mm", "9 mm"]
free = { density = "7800 kg/m3" }
[[stage]]
kind = "run"
duration = "0.1 s"
"#;

#[test]
fn a_free_cube_is_closed_with_minus_zeros_or_corners_a_float_apart_and_not_with_a_facet_flipped() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, FREE).unwrap();
    let scene = |facets: &[Facet]| {
        std::fs::write(folder.path().join("cube.stl"), binary(b"solid", facets)).unwrap();
        Scene::read(&file)
    };
    let mass = |facets: &[Facet]| match scene(facets).unwrap().bodies[0].mobility {
        Mobility::Free(freedom) => freedom.mass,
        _ => panic!(),
    };
    let right = 7800.0 * 1e-6;
    assert!((mass(&cube()) / right - 1.0).abs() < 1e-12);
    let (mut minus, mut apart, mut flipped) = (cube(), cube(), cube());
    let zeros = minus.iter_mut().flatten().flatten().filter(|x| **x == 0.0);
    zeros.step_by(3).for_each(|zero| *zero = -0.0);
    assert!((mass(&minus) / right - 1.0).abs() < 1e-12);
    let values = apart.iter_mut().flatten().flatten().step_by(5);
    values.for_each(|x| *x = f64::from((*x as f32).next_up()));
    assert!((mass(&apart) / right - 1.0).abs() < 1e-5);
    flipped[9].swap(1, 2);
    let wrong = scene(&flipped).unwrap_err().to_string();
    assert!(
        wrong.contains("facet 10 at") && wrong.contains("flipped"),
        "{wrong}"
    );
}
