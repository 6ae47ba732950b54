//! Beds from the files of other beds: read back bit for bit, gone on from, run however one likes.

use crate::grain_lists::{BOX, MATERIALS, RUN, read};
use crate::resume;
use crate::same_bits::assert_same_bits;
use crate::scene_run::quiet;
use impactlaw::bed::run::run_scene;
use impactlaw::bed::scene::Scene;
use impactlaw::dem::grains::Grains;
use std::fmt::Write;
use std::path::Path;

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
