//! What is wrong with a file of grains is told by file, line, what was found and what is allowed, before the first step.

use crate::grain_lists::{BOUNDS, DATA, TYPES, VTP, frame, read, scene_with};
use crate::scene_run::quiet;
use impactlaw::bed::run::run_scene;

/// Name of a file, its text, what is replaced in it by what, further keys of the scene, and parts of the message.
type Malformed<'a> = (&'a str, &'a str, &'a str, &'a str, &'a str, &'a [&'a str]);

#[test]
fn what_is_wrong_with_a_file_is_told_by_line_and_what_is_allowed() {
    let csv =
        "x,y,z,radius,material\n0.005,0.006,0.007,0.001,glass\n0.01,0.0125,0.02,0.0015,steel\n";
    let dump = frame(
        0,
        BOUNDS,
        "id type x y z radius",
        &["1 1 0.005 0.006 0.007 0.001", "2 2 0.01 0.0125 0.02 0.0015"],
    );
    let dump = &dump[..];
    let cases: &[Malformed] = &[
        (
            "a.csv",
            csv,
            "0.006",
            "abc",
            "",
            &["line 2: found `abc` for `y`", "must be a number"],
        ),
        (
            "a.csv",
            csv,
            "0.0125",
            "nan",
            "",
            &["line 3: found `nan` for `y`", "finite"],
        ),
        ("a.csv", csv, "0.0125", "1e999", "", &["line 3", "finite"]),
        (
            "a.csv",
            csv,
            "0.0125,",
            "",
            "",
            &["line 3: found 4 values", "must be 5"],
        ),
        (
            "a.csv",
            csv,
            "steel\n",
            "steel,9\n",
            "",
            &["line 3: found 6 values"],
        ),
        (
            "a.csv",
            csv,
            "0.0015",
            "-0.0015",
            "",
            &["line 3: found -1.5e-3 for `radius`", "above 0"],
        ),
        (
            "a.csv",
            csv,
            "0.0015",
            "0",
            "",
            &["line 3: found 0e0 for `radius`"],
        ),
        (
            "a.csv",
            csv,
            "steel",
            "gold",
            "",
            &["grains[0].file.types", "gold", "glass, steel"],
        ),
        (
            "a.csv",
            csv,
            ",steel",
            ",",
            "",
            &["line 3: found nothing for `material`"],
        ),
        (
            "a.csv",
            csv,
            "x,y,z",
            "x,q,z",
            "",
            &["has no column `y`", "found `x q z radius material`"],
        ),
        (
            "a.csv",
            csv,
            "radius",
            "size",
            "",
            &["no `radius`", "radius = \"1 mm\""],
        ),
        (
            "a.csv",
            csv,
            "radius",
            "radius_kg",
            "",
            &["unit `kg`", "a length"],
        ),
        (
            "a.csv",
            csv,
            "material",
            "radius",
            "",
            &["twice", "`radius`"],
        ),
        (
            "a.csv",
            csv,
            "material",
            "vx",
            "",
            &["part of the velocity", "all three or none"],
        ),
        (
            "a.csv",
            csv,
            "x,y,z,radius,material\n",
            "",
            "",
            &["line 1: found numbers", "header"],
        ),
        ("a.csv", csv, csv, "x,y,z,radius\n", "", &["has no grains"]),
        ("a.csv", csv, csv, "", "", &["has no grains"]),
        (
            "a.csv",
            csv,
            csv,
            "x;y;z;radius\n0,005;6;7;1\n",
            "",
            &["line 2: found `0,005`", "decimal point"],
        ),
        ("a.csv", csv, csv, "\0\0", "", &["is binary"]),
        ("a.csv", csv, "", "", ", frame = 1", &["no frames"]),
        (
            "a.csv",
            csv,
            "radius,material",
            "radius,material",
            ", types = [\"gold\"]",
            &["file.types[0]", "glass, steel"],
        ),
        (
            "a.csv",
            csv,
            "x,y,z,radius,material",
            "x,y,z,radius,density",
            "",
            &["line 2: found `glass`"],
        ),
        (
            "a.xyz",
            csv,
            "",
            "",
            "",
            &["must end in one of .csv", "format"],
        ),
        (
            "a.csv",
            csv,
            "0.01,0.0125,0.02,0.0015",
            "0.01,0.0125,0.02,0.03",
            "",
            &["factor of 20", "3.000e-2"],
        ),
        (
            "a.csv",
            csv,
            "0.01,0.0125",
            "0.03,0.0125",
            "",
            &[
                "line 3 at (30.000, 12.500, 20.000) mm",
                "outside of the box",
            ],
        ),
        (
            "a.csv",
            csv,
            "0.02,",
            "0.06,",
            "",
            &["line 3", "outside of the box"],
        ),
        (
            "a.csv",
            csv,
            "0.01,0.0125,0.02",
            "0.006,0.007,0.008",
            "",
            &["lines 2 and 3 overlap by", "`overlap`"],
        ),
        (
            "a.dump",
            dump,
            "TIMESTEP",
            "TIMES",
            "",
            &["line 1: found `ITEM: TIMES`"],
        ),
        (
            "a.dump",
            dump,
            "\n2\n",
            "\n3\n",
            "",
            &["found 2 atoms", "the 3", "cut off"],
        ),
        (
            "a.dump",
            dump,
            "\n2\n",
            "\n-2\n",
            "",
            &["line 4: found `-2`", "whole number"],
        ),
        (
            "a.dump",
            dump,
            "0 0.02\n0 0.02\n",
            "0 0.02\n",
            "",
            &["line 8: found `ITEM:`"],
        ),
        (
            "a.dump",
            dump,
            "0 0.02\n0",
            "0 0.02 0.01\n0",
            "",
            &["tilted"],
        ),
        (
            "a.dump",
            dump,
            "0 0.02\n0",
            "0 0.0z\n0",
            "",
            &["line 6: found `0.0z`"],
        ),
        ("a.dump", dump, "x y z", "x y q", "", &["has no column `z`"]),
        (
            "a.dump",
            dump,
            "0.007 0.001",
            "0.007",
            "",
            &["line 10: found 5 values", "must be 6"],
        ),
        (
            "a.dump",
            dump,
            "",
            "",
            ", frame = 3",
            &["has 1 frames", "1 to 1"],
        ),
        (
            "a.dump",
            dump,
            "",
            "",
            "",
            &["grains[0].file.types", "1, 2"],
        ),
        ("a.dump", dump, "", "", ", length = \"1 kg\"", &["a length"]),
        (
            "a.dump",
            dump,
            "radius",
            "vx",
            "",
            &["part of the velocity"],
        ),
        (
            "a.data",
            DATA,
            "2 atoms",
            "3 atoms",
            TYPES,
            &["has 2 atoms", "the 3"],
        ),
        (
            "a.data",
            DATA,
            "2 atoms",
            "2 gnats",
            TYPES,
            &["no line `N atoms`"],
        ),
        (
            "a.data",
            DATA,
            "# sphere",
            "# atomic",
            TYPES,
            &["style `atomic`", "sphere"],
        ),
        (
            "a.data",
            DATA,
            "9 2 0.003",
            "4 2 0.003",
            TYPES,
            &["line 13: found the atom 4 again"],
        ),
        (
            "a.data",
            DATA,
            "9 2 0.003",
            "9 2 0",
            TYPES,
            &["line 13: found `0` for `diameter`"],
        ),
        (
            "a.data",
            DATA,
            " 2500",
            " 7800",
            TYPES,
            &["line 12: found a grain of 7.8000e3 kg/m3", "2.5000e3"],
        ),
        (
            "a.data",
            DATA,
            "9 0 0 0",
            "8 0 0 0",
            TYPES,
            &["line 17: found a velocity of 8"],
        ),
        (
            "a.data",
            DATA,
            "Velocities",
            "Ellipsoids",
            TYPES,
            &["the section `Ellipsoids`"],
        ),
        (
            "a.data",
            DATA,
            "0.0125 0.02 0 0 0",
            "0.0125 0.02 0 0",
            TYPES,
            &["line 13: found 9 values"],
        ),
        (
            "a.data",
            DATA,
            "2 -3",
            "2 -3",
            ", length = \"1 mm\"",
            &["`vx`", "say what 1 in them means"],
        ),
        (
            "a.vtp",
            VTP,
            "PolyData\" version",
            "ImageData\" version",
            TYPES,
            &["type `ImageData`", "PolyData"],
        ),
        (
            "a.vtp",
            VTP,
            "version=\"0.1\"",
            "compressor=\"vtkZLibDataCompressor\"",
            TYPES,
            &["compressed"],
        ),
        (
            "a.vtp",
            VTP,
            "LittleEndian",
            "BigEndian",
            TYPES,
            &["big-endian"],
        ),
        (
            "a.vtp",
            VTP,
            "0.01 0.0125 0.02",
            "0.01 0.0125",
            TYPES,
            &["values in `"],
        ),
        (
            "a.vtp",
            VTP,
            "0.01 0.0125",
            "0.01 x",
            TYPES,
            &["has `x` in the array"],
        ),
        (
            "a.vtp",
            VTP,
            "1e-3 0.0015",
            "1e-3 -1",
            TYPES,
            &["point 2: found -1e0 for `Radius`"],
        ),
        (
            "a.vtp",
            VTP,
            "1e-3 0.0015",
            "nan 1",
            TYPES,
            &["point 1: found `NaN`", "finite"],
        ),
        ("a.vtp", VTP, "<VTKFile", "<XML", TYPES, &["no VTK file"]),
        ("a.bin", csv, "", "", "", &["no restart file"]),
    ];
    let mut refused = 0;
    for (name, text, from, to, keys, says) in cases {
        assert!(text.contains(from), "{from}");
        let text = match from.is_empty() {
            true => (*text).to_owned(),
            false => text.replacen(from, to, 1),
        };
        let error = match read(name, text.as_bytes(), "", keys) {
            Ok(_) => panic!("{name} was read: {from} -> {to} {keys}"),
            Err(error) => error,
        };
        for say in *says {
            assert!(error.contains(say), "{say:?} is not in: {error}");
        }
        refused += 1;
    }
    assert!(refused >= 50, "{refused}");
}

#[test]
fn a_grain_in_a_wall_or_a_body_is_refused_with_the_names_of_both() {
    let ball = "[[body]]\nname = \"boulder\"\nball = { radius = \"3 mm\" }\nat = [\"10 mm\", \"10 mm\", \"10 mm\"]\n";
    for (x, body) in [
        ("0.0005", "left"),
        ("0.009", "boulder"),
        ("0.0195", "right"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let text = format!("x,y,z,radius\n{x},0.01,0.01,0.001\n");
        std::fs::write(folder.path().join("a.csv"), text).unwrap();
        let grains = "material = \"glass\"\nfile = { path = \"a.csv\" }";
        let scene = scene_with(folder.path(), grains, ball).unwrap();
        let out = tempfile::tempdir().unwrap();
        let error = run_scene(&scene, None, &quiet(out.path()))
            .err()
            .unwrap()
            .to_string();
        let said = format!("\"{body}\" reaches into the grain of \"sand\"");
        assert!(error.contains(&said), "{error}");
        assert!(std::fs::read_dir(out.path()).unwrap().next().is_none());
    }
    // as deep as grains may overlap, which a packing that rests does
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("a.csv"),
        "x,y,z,radius\n0.00095,0.01,0.01,0.001\n",
    )
    .unwrap();
    let grains = "material = \"glass\"\nfile = { path = \"a.csv\" }";
    let scene = scene_with(folder.path(), grains, "").unwrap();
    let out = tempfile::tempdir().unwrap();
    run_scene(&scene, None, &quiet(out.path())).unwrap();
}

#[test]
fn keys_that_do_not_go_with_a_file_are_refused_by_name() {
    let csv = b"x,y,z,radius\n0.005,0.006,0.007,0.001\n";
    for key in [
        "count = 3",
        "mass = \"1 g\"",
        "spread = 0.1",
        "insertion = \"pour\"",
        "rate = \"1 g/s\"",
        "region = { low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"1 mm\", \"1 mm\", \"1 mm\"] }",
    ] {
        let error = read("a.csv", csv, &format!("material = \"glass\"\n{key}"), "").unwrap_err();
        let name = key.split(' ').next().unwrap();
        let said = format!("`grains[0].{name}`");
        assert!(
            error.contains(&said) && error.contains("beside `file`"),
            "{error}"
        );
    }
    let error = read("a.csv", csv, "", "").unwrap_err();
    assert!(
        error.contains("`grains[0].material`") && error.contains("glass, steel"),
        "{error}"
    );
    let error = read("a.csv", csv, "material = \"glass\"", ", overlap = 0.4").unwrap_err();
    assert!(error.contains("file.overlap"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let missing = scene_with(folder.path(), "file = { path = \"none.csv\" }", "");
    let error = missing.unwrap_err().to_string();
    assert!(
        error.contains("`grains[0].file.path`") && error.contains("none.csv"),
        "{error}"
    );
}
