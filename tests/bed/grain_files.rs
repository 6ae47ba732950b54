//! Grains from files: every format and dialect is read to the same grains, and what is wrong is told by file, line, what was
//! found and what is allowed, before the first step.

use crate::resume;
use crate::same_bits::assert_same_bits;
use crate::scene_run::quiet;
use impactlaw::bed::filling::insert;
use impactlaw::bed::run::run_scene;
use impactlaw::bed::scene::Scene;
use impactlaw::dem::grains::Grains;
use parry3d::math::Vector;
use std::fmt::Write;
use std::path::Path;

const MATERIALS: &str = r#"
[materials.glass]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.25
law = "hertz"
[materials.steel]
density = "7800 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
law = "hertz"
"#;

const BOX: &str = "[box]\nwidth = \"20 mm\"\ndepth = \"20 mm\"\nheight = \"40 mm\"\n";

const RUN: &str = "[[stage]]\nkind = \"run\"\nduration = \"20 ms\"\n[output]\nrows = 10\nframes = 2\nfilm = 2\ndump = true\n";

/// Scene in `folder` whose grains have these keys, with `more` behind them.
fn scene_with(folder: &Path, grains: &str, more: &str) -> Result<Scene, impactlaw::Error> {
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n{MATERIALS}[contact]\nfriction = 0.3\nrestitution = 0.7\n[[grains]]\nname = \"sand\"\n{grains}\n{BOX}{more}{RUN}"
    );
    Scene::parse(&text, &folder.join("scene.toml"))
}

/// Grains of a file called `name` in the order of their names, the keys of `[grains.file]` beside its path being `keys`.
fn read(name: &str, bytes: &[u8], group: &str, keys: &str) -> Result<Grains, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let grains = format!("{group}\nfile = {{ path = \"{name}\"{keys} }}");
    let said = |error: impactlaw::Error| error.to_string();
    let scene = scene_with(folder.path(), &grains, "").map_err(said)?;
    let (mut grains, ..) = insert(&scene, 1).map_err(said)?;
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    order.sort_by_key(|&at| grains.ids[at as usize]);
    grains.reorder(&order);
    Ok(grains)
}

/// The two grains that all small files list: one of glass that flies and turns, one of steel at rest.
fn assert_the_two(grains: &Grains, what: &str) {
    assert_eq!(grains.len(), 2, "{what}");
    let near = |a: Vector, b: [f64; 3], unit: f64| {
        let way = (a - Vector::from(b)).length();
        assert!(way < 1e-6 * unit, "{what}: {a} for {b:?}");
    };
    near(grains.spheres[0].centre, [5e-3, 6e-3, 7e-3], 1e-3);
    near(grains.spheres[1].centre, [10e-3, 12.5e-3, 20e-3], 1e-3);
    for (grain, radius) in [(0, 1e-3), (1, 1.5e-3)] {
        let found = grains.spheres[grain].radius;
        assert!((found / radius - 1.0).abs() < 1e-6, "{what}: {found}");
    }
    near(grains.motions[0].velocity, [0.1, -0.2, 0.3], 1.0);
    near(grains.motions[1].velocity, [0.0; 3], 1.0);
    near(grains.spins[0].rate, [1.0, 2.0, -3.0], 1.0);
    assert_eq!([grains.material(0), grains.material(1)], [0, 1], "{what}");
    let density = |grain: usize| {
        let volume = 4.0 / 3.0 * std::f64::consts::PI * grains.spheres[grain].radius.powi(3);
        1.0 / grains.motions[grain].inverse_mass / volume
    };
    assert!((density(0) / 2500.0 - 1.0).abs() < 1e-9, "{what}");
    assert!((density(1) / 7800.0 - 1.0).abs() < 1e-9, "{what}");
}

/// Turns the lines of a text into those of old Macs and of Windows.
fn line_ends(text: &str) -> [String; 3] {
    [
        text.to_owned(),
        text.replace('\n', "\r"),
        text.replace('\n', "\r\n"),
    ]
}

#[test]
fn tables_of_every_dialect_list_the_same_grains() {
    let si = "x_m,y_m,z_m,radius_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,material\n\
        0.005,0.006,0.007,0.001,0.1,-0.2,0.3,1,2,-3,glass\n0.01,0.0125,0.02,0.0015,0,0,0,0,0,0,steel\n";
    for (k, text) in line_ends(si).iter().enumerate() {
        assert_the_two(
            &read("a.csv", text.as_bytes(), "", "").unwrap(),
            &format!("ends {k}"),
        );
        let marked = format!("\u{feff}# made by hand\n\n{text}");
        assert_the_two(&read("a.CSV", marked.as_bytes(), "", "").unwrap(), "marked");
    }
    let others = [
        // other order, names, units in brackets, diameters, types, a column of no use
        (
            "type;Z [mm];colour;Diameter (mm);Y [mm];X [mm];omegax;omegay;omegaz;VX;VY;VZ\n\
             1;7;red;2;6;5;1;2;-3;0.1;-0.2;0.3\n2.0;20;blue;3;12.5;10;0;0;0;0;0;0\n",
            ", types = [\"glass\", \"steel\"]",
        ),
        // as ParaView writes it
        (
            "\"radius_m\",\"velocity_m_s:0\",\"velocity_m_s:1\",\"velocity_m_s:2\",\"spin_rad_s:0\",\"spin_rad_s:1\",\"spin_rad_s:2\",\"Points:0\",\"Points:1\",\"Points:2\",\"material\"\n\
             1e-3,0.1,-0.2,0.3,1,2,-3,5e-3,6e-3,7e-3,0\n1.5e-3,0,0,0,0,0,0,1e-2,1.25E-2,.02,1\n",
            ", types = [\"glass\", \"steel\"]",
        ),
        // blanks, another unit for all: a millisecond is the unit of time
        (
            "x y z r vx vy vz wx wy wz mat\n5 6 7 1 0.1 -0.2 0.3 0.001 0.002 -0.003 glass\n 10   12.5 20\t1.5 0 0 0 0 0 0 steel \n",
            ", length = \"1 mm\", velocity = \"1 m/s\"",
        ),
        // tabs, micrometres, density and mass that fit
        (
            "x_um\ty_um\tz_um\tradius_um\tvx_mm_s\tvy_mm_s\tvz_mm_s\twx\twy\twz\tmaterial\tdensity_g_cm3\n\
             5000\t6000\t7000\t1000\t100\t-200\t300\t1\t2\t-3\tglass\t2.5\n10000\t12500\t20000\t1500\t0\t0\t0\t0\t0\t0\tsteel\t7.8\n",
            "",
        ),
    ];
    for (text, keys) in others {
        for text in line_ends(text) {
            let grains = read("a.csv", text.as_bytes(), "", keys);
            assert_the_two(&grains.unwrap_or_else(|error| panic!("{error}")), &text);
        }
    }
    // what the file lacks is told beside it; a shift is added
    let bare = "x_mm,y_mm,z_mm\n5,6,7\n10,12,20\n";
    let group =
        "radius = \"1 mm\"\nmaterial = \"steel\"\nvelocity = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"]";
    let keys = ", shift = [\"1 mm\", \"0 mm\", \"2 mm\"]";
    let grains = read("a.txt", bare.as_bytes(), group, keys).unwrap();
    assert!((grains.spheres[0].centre - Vector::new(6e-3, 6e-3, 9e-3)).length() < 1e-15);
    assert_eq!(grains.motions[1].velocity, Vector::new(0.0, 0.0, -1.0));
    assert_eq!(grains.material(0), 1);
}

/// A frame of a dump with these columns.
fn frame(step: usize, bounds: &str, columns: &str, atoms: &[&str]) -> String {
    format!(
        "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {bounds}\nITEM: ATOMS {columns}\n{}\n",
        atoms.len(),
        atoms.join("\n")
    )
}

const BOUNDS: &str = "ff ff ff\n0 0.02\n0 0.02\n-0.01 0.03";
const TYPES: &str = ", types = [\"glass\", \"steel\"]";

#[test]
fn dumps_of_every_dialect_list_the_same_grains() {
    let plain = "id type x y z radius vx vy vz omegax omegay omegaz mass";
    let atoms = [
        "7 1 0.005 0.006 0.007 0.001 0.1 -0.2 0.3 1 2 -3 1.0472e-5",
        "2 2 0.01 0.0125 0.02 0.0015 0 0 0 0 0 0 1.1027e-4",
    ];
    let other = frame(
        0,
        BOUNDS,
        "id type x y z radius",
        &["1 1 0.001 0.002 0.003 0.0005"],
    );
    let last = frame(100, BOUNDS, plain, &atoms);
    for text in line_ends(&format!("{other}{last}")) {
        assert_the_two(
            &read("a.dump", text.as_bytes(), "", TYPES).unwrap(),
            "last frame",
        );
        let keys = format!("{TYPES}, frame = 2");
        assert_the_two(
            &read("a.lammpstrj", text.as_bytes(), "", &keys).unwrap(),
            "second",
        );
        let keys = format!("{TYPES}, frame = 1");
        assert_eq!(read("a.dump", text.as_bytes(), "", &keys).unwrap().len(), 1);
    }
    let dialects = [
        // shares of the box, diameters, in another order, periods gone through
        (
            BOUNDS,
            "diameter zs ys xs ix iy iz vz vy vx omegaz omegay omegax type",
            [
                "0.002 0.425 0.3 0.25 0 0 0 0.3 -0.2 0.1 -3 2 1 1",
                "0.003 0.75 0.625 0.5 0 0 0 0 0 0 0 0 0 2",
            ],
        ),
        // unwrapped, a box of 15 digits, right angles told
        (
            "xy xz yz pp pp ff\n0 2.0e-2 0\n0 2.0e-2 0\n0 4.0e-2 0",
            "type xu yu zu radius vx vy vz omegax omegay omegaz f_force",
            [
                "1 0.005 0.006 0.007 0.001 0.1 -0.2 0.3 1 2 -3 9",
                "2 0.01 0.0125 0.02 0.0015 0 0 0 0 0 0 9",
            ],
        ),
        (
            BOUNDS,
            "type xsu ysu zsu radius vx vy vz omegax omegay omegaz",
            [
                "1 0.25 0.3 0.425 0.001 0.1 -0.2 0.3 1 2 -3",
                "2 0.5 0.625 0.75 0.0015 0 0 0 0 0 0",
            ],
        ),
        // wrapped and unwrapped beside each other
        (
            BOUNDS,
            "type x y z xu yu zu radius vx vy vz omegax omegay omegaz",
            [
                "1 0.005 0.006 0.007 1 1 1 0.001 0.1 -0.2 0.3 1 2 -3",
                "2 0.01 0.0125 0.02 1 1 1 0.0015 0 0 0 0 0 0",
            ],
        ),
    ];
    for (bounds, columns, atoms) in dialects {
        let text = frame(5, bounds, columns, &atoms);
        let text = format!("ITEM: UNITS\nsi\nITEM: TIME\n0.5\n{text}");
        let grains = read("a.dump", text.as_bytes(), "", TYPES);
        assert_the_two(&grains.unwrap_or_else(|error| panic!("{error}")), columns);
    }
    let micro = frame(
        5,
        "ff ff ff\n0 20000\n0 20000\n0 40000",
        "type x y z radius vx vy vz omegax omegay omegaz",
        &[
            "1 5000 6000 7000 1000 0.1 -0.2 0.3 1e-6 2e-6 -3e-6",
            "2 10000 12500 20000 1500 0 0 0 0 0 0",
        ],
    );
    let keys = format!("{TYPES}, length = \"1 um\", velocity = \"1 m/s\"");
    assert_the_two(
        &read("a.dump", micro.as_bytes(), "", &keys).unwrap(),
        "micro units",
    );
}

const DATA: &str = "LAMMPS data file\n\n2 atoms\n2 atom types\n\n0 0.02 xlo xhi\n0 0.02 ylo yhi\n0 0.04 zlo zhi\n\n\
    Atoms # sphere\n\n4 1 0.002 2500 0.005 0.006 0.007 0 0 0\n9 2 0.003 7800 0.01 0.0125 0.02 0 0 0\n\n\
    Velocities\n\n9 0 0 0 0 0 0\n4 0.1 -0.2 0.3 1 2 -3\n";

#[test]
fn data_files_of_lammps_and_liggghts_list_the_same_grains() {
    for text in line_ends(DATA) {
        assert_the_two(
            &read("a.data", text.as_bytes(), "", TYPES).unwrap(),
            "sphere",
        );
    }
    for (from, to) in [
        ("Atoms # sphere", "Atoms"),
        ("Atoms # sphere", "Atoms  # granular"),
        ("0.007 0 0 0\n", "0.007\n"),
        ("\nAtoms #", "\nMasses\n\n1 1\n2 1\n\nAtoms #"),
        ("2 atoms\n", "2  atoms # two\n"),
    ] {
        assert!(DATA.contains(from));
        let text = DATA.replace(from, to);
        assert_the_two(&read("a.lmp", text.as_bytes(), "", TYPES).unwrap(), to);
    }
}

/// VTP in ASCII, as other programs write it.
const VTP: &str = r#"<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
  <PolyData>
    <Piece NumberOfPoints="2" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
      <PointData Scalars="radius">
        <DataArray type="Float32" Name="Radius" format="ascii">
          1e-3 0.0015
        </DataArray>
        <DataArray type="Float64"
                   Name="velocity" NumberOfComponents="3" format="ascii"> 0.1 -0.2 0.3 0 0 0 </DataArray>
        <DataArray type="Float64" Name="omega" NumberOfComponents="3" format="ascii">1 2 -3 0 0 0</DataArray>
        <DataArray type="Int32" Name="type" format="ascii">1 2</DataArray>
        <DataArray type="Int32" Name="colour" format="ascii">1 2</DataArray>
      </PointData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
          0.005 0.006 0.007   0.01 0.0125 0.02
        </DataArray>
      </Points>
    </Piece>
  </PolyData>
</VTKFile>
"#;

#[test]
fn vtp_of_other_programs_lists_the_same_grains() {
    for text in line_ends(VTP) {
        assert_the_two(&read("a.vtp", text.as_bytes(), "", TYPES).unwrap(), "ascii");
    }
    // single precision and integers as base64 with a short head
    use base64::Engine;
    let encode = |bytes: Vec<u8>| {
        let all = [(bytes.len() as u32).to_le_bytes().to_vec(), bytes].concat();
        base64::engine::general_purpose::STANDARD.encode(all)
    };
    let radii = [1e-3f32, 1.5e-3]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let types = [1i32, 2].iter().flat_map(|x| x.to_le_bytes()).collect();
    let text = VTP
        .replace(
            "Name=\"Radius\" format=\"ascii\">\n          1e-3 0.0015",
            &format!(
                "Name=\"Radius\" format=\"binary\">\n          {}",
                encode(radii)
            ),
        )
        .replace(
            "Name=\"type\" format=\"ascii\">1 2",
            &format!("Name=\"type\" format=\"binary\">{}", encode(types)),
        );
    assert_the_two(
        &read("a.vtp", text.as_bytes(), "", TYPES).unwrap(),
        "binary",
    );
}

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

/// A bed that rolls and presses, all its grains on the way.
const FIRST: &str = r#"
laws = ["hertz"]
seed = 7
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.25
[grains]
count = 90
radius = "1 mm"
spread = 0.3
stir = "0.3 m/s"
[contact]
friction = 0.4
restitution = 0.7
[box]
width = "14 mm"
depth = "14 mm"
height = "40 mm"
[[stage]]
kind = "run"
duration = "60 ms"
[output]
rows = 6
frames = 6
film = 0
dump = true
"#;

#[test]
fn what_a_bed_has_written_is_read_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::parse(FIRST, Path::new("first.toml")).unwrap();
    run_scene(&scene, None, &quiet(folder.path())).unwrap();
    let inside = folder.path().join("bed/hertz");
    let dump = std::fs::read(inside.join("dump.lammpstrj")).unwrap();
    let text = String::from_utf8(dump.clone()).unwrap();
    let frames = text.matches("ITEM: TIMESTEP").count();
    assert!(frames >= 6);
    let last = std::fs::read(inside.join(format!("vtp/grains_{:04}.vtp", frames - 1))).unwrap();
    let group = "material = \"glass\"";
    let of_dump = read("first.lammpstrj", &dump, group, ", overlap = 0.2").unwrap();
    let mut of_vtp = read("first.vtp", &last, group, ", overlap = 0.2").unwrap();
    assert_eq!(of_dump.len(), 90);
    // a dump is in the order of names, VTP in that of the run: compare by place
    let order = |grains: &mut Grains| {
        let mut order: Vec<u32> = (0..90).collect();
        order.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|at| grains.spheres[at as usize].centre.to_array());
            a.partial_cmp(&b).unwrap()
        });
        grains.reorder(&order);
    };
    let mut of_dump = of_dump;
    order(&mut of_dump);
    order(&mut of_vtp);
    assert_eq!(of_dump.spheres, of_vtp.spheres);
    assert_eq!(of_dump.motions, of_vtp.motions);
    assert_eq!(of_dump.spins, of_vtp.spins);
    assert!(of_dump.spins.iter().any(|spin| spin.rate.length() > 1.0));
    // the scene's own grains at that instant
    let (x, radius) = {
        let line = text
            .rsplit("ITEM: ATOMS")
            .next()
            .unwrap()
            .lines()
            .nth(1)
            .unwrap();
        let words: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        (words[2], words[5])
    };
    let there = |s: &impactlaw::dem::grains::Sphere| s.centre.x == x && s.radius == radius;
    assert!(of_dump.spheres.iter().any(there));
}

#[test]
fn a_bed_goes_on_from_the_restart_file_of_another() {
    let folder = tempfile::tempdir().unwrap();
    assert!(!resume::run(FIRST, folder.path(), ("hertz", 4)));
    let bytes = std::fs::read(folder.path().join("bed/hertz/restart.bin")).unwrap();
    let grains = read(
        "restart.bin",
        &bytes,
        "material = \"glass\"",
        ", overlap = 0.2",
    )
    .unwrap();
    assert_eq!(grains.len(), 90);
    assert!(
        grains
            .spheres
            .iter()
            .all(|s| s.centre.x < 14e-3 && s.centre.z > 0.0)
    );
    assert!(grains.motions.iter().any(|m| m.velocity.length() > 0.05));
    assert!(grains.spins.iter().any(|s| s.rate.length() > 1.0));
    // of another material, of SI, and damaged
    let wrong = read(
        "restart.bin",
        &bytes,
        "material = \"steel\"",
        ", overlap = 0.2",
    )
    .unwrap_err();
    assert!(
        wrong.contains("2.5000e3 kg/m3") && wrong.contains("7.8000e3"),
        "{wrong}"
    );
    let wrong = read(
        "restart.bin",
        &bytes,
        "material = \"glass\"",
        ", length = \"1 mm\"",
    );
    assert!(wrong.unwrap_err().contains("leave out `length`"));
    let mut flipped = bytes.clone();
    flipped[bytes.len() / 2] ^= 4;
    let wrong = read("restart.bin", &flipped, "material = \"glass\"", "").unwrap_err();
    assert!(wrong.contains("damaged"), "{wrong}");
}

/// A column of grains of two materials beside each other, as a table.
fn column() -> String {
    let mut text = String::from("x_mm,y_mm,z_mm,radius_mm,material,vx_m_s,vy_m_s,vz_m_s\n");
    for k in 0..240 {
        let [i, j, l] = [k % 6, k / 6 % 6, k / 36].map(f64::from);
        let material = if k % 3 == 0 { "steel" } else { "glass" };
        let _ = writeln!(
            text,
            "{},{},{},{},{material},0,0,-0.2",
            2.0 + 3.0 * i + 0.1 * (l % 2.0),
            2.0 + 3.0 * j,
            1.5 + 3.0 * l,
            1.0 + 0.04 * f64::from(k % 10)
        );
    }
    text
}

#[test]
fn a_bed_from_a_file_closes_its_energy_and_has_the_same_bits_however_it_is_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("column.csv");
    std::fs::write(&path, column()).unwrap();
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n{MATERIALS}[contact]\nfriction = 0.3\nrestitution = 0.7\n[[grains]]\nname = \"sand\"\nfile = {{ path = \"{}\" }}\n{BOX}{RUN}",
        path.display()
    );
    let text = text.replace("20 ms", "50 ms");
    let scene = Scene::parse(&text, Path::new("column.toml")).unwrap();
    let out = tempfile::tempdir().unwrap();
    let report = run_scene(&scene, None, &quiet(out.path())).unwrap();
    let summary = &report.laws[0].summary;
    assert_eq!((summary.grains, summary.lost_grains), (240, 0));
    assert!(summary.energy_closure < 2e-3, "{}", summary.energy_closure);
    // the file belongs to the hash of its scene
    std::fs::write(&path, column().replace("-0.2", "-0.3")).unwrap();
    let other = Scene::parse(&text, Path::new("column.toml")).unwrap();
    assert_ne!(scene.hash, other.hash);
    assert_same_bits(&text, ("hertz", 6));
    // the same grains in a later stage, all of the name at once
    let late = text.replace(
        "duration = \"50 ms\"",
        "duration = \"5 ms\"\ninsert = [\"sand\"]",
    );
    let scene = Scene::parse(&late, Path::new("column.toml")).unwrap();
    let out = tempfile::tempdir().unwrap();
    let report = run_scene(&scene, None, &quiet(out.path())).unwrap();
    assert_eq!(report.laws[0].summary.grains, 240);
    assert!(report.laws[0].summary.energy_closure < 2e-3);
}
