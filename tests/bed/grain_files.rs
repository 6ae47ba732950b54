//! Grains from files: every format and dialect is read to the same grains.

use crate::grain_lists::{BOUNDS, DATA, TYPES, VTP, assert_the_two, frame, line_ends, read};
use parry3d::math::Vector;

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
