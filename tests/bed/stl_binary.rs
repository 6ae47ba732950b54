//! Binary STL in every dialect: read with the right number of triangles and the right volume, or refused with the true reason; none in
//! silence.

use crate::mesh_lists::{CUBE, Open, Read, Refused, Right, assert_right, changed};
use crate::meshes::{binary, cube};
use impactlaw::dem::bodies::mesh::Format;

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
