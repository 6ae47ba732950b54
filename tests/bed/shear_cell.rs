//! A scene that is periodic along z: plane shear without gravity, and all that makes no sense there.

use crate::same_bits::assert_same_bits;
use crate::scene_run::{quiet, run};
use impactlaw::bed::run::run_scene;
use impactlaw::bed::scene::Scene;
use std::path::Path;

/// Grains between two planes whose surfaces pass each other along x; x and z are periodic.
const CELL: &str = r#"
seed = 4
gravity = "0 m/s2"
periodic = ["x", "z"]
[material]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.25
law = "hertz"
[grains]
count = 150
radius = "1 mm"
spread = 0.1
stir = "0.2 m/s"
region = { low = ["0 mm", "2 mm", "0 mm"], high = ["16 mm", "18 mm", "16 mm"] }
[contact]
friction = 0.5
restitution = 0.7
[box]
width = "16 mm"
depth = "20 mm"
height = "16 mm"
[[body]]
name = "lower"
plane = { normal = [0.0, 1.0, 0.0] }
at = ["0 mm", "1.9 mm", "0 mm"]
belt = { velocity = ["-0.5 m/s", "0 m/s", "0 m/s"] }
[[body]]
name = "upper"
plane = { normal = [0.0, -1.0, 0.0] }
at = ["0 mm", "18.1 mm", "0 mm"]
belt = { velocity = ["0.5 m/s", "0 m/s", "0 m/s"] }
[[stage]]
kind = "run"
name = "shear"
duration = "60 ms"
[output]
rows = 12
frames = 2
film = 2
dump = true
"#;

#[test]
fn a_shear_cell_periodic_along_z_closes_its_energy_and_shears_its_grains_evenly_along_z() {
    let scene = Scene::parse(CELL, Path::new("shear.toml")).unwrap();
    let (report, _folder) = run(&scene);
    let (summary, rows) = (&report.laws[0].summary, &report.laws[0].rows);
    assert_eq!((summary.grains, summary.lost_grains), (150, 0));
    assert!(summary.energy_closure < 5e-3, "{}", summary.energy_closure);
    let last = rows.last().unwrap();
    assert!(last.driven_work_j > 0.0 && last.losses.friction > 0.0);
    assert_eq!(last.height_m, 16e-3);
    let volume: f64 = report.laws[0].grains.volume();
    let whole = 16e-3 * 20e-3 * 16e-3;
    assert!((last.solid_fraction / (volume / whole) - 1.0).abs() < 1e-12);
    // grains by the plates go with them
    let grains = &report.laws[0].grains;
    let mean = |near: &dyn Fn(f64) -> bool| {
        let by = grains.spheres.iter().zip(&grains.motions);
        let speeds: Vec<f64> = by
            .filter(|(sphere, _)| near(sphere.centre.y))
            .map(|(_, motion)| motion.velocity.x)
            .collect();
        assert!(speeds.len() > 10);
        speeds.iter().sum::<f64>() / speeds.len() as f64
    };
    let (front, back) = (mean(&|y| y < 6e-3), mean(&|y| y > 14e-3));
    assert!(front < -0.02 && back > 0.02, "{front} {back}");
    // no bottom and no top: as many grains in either half of the period, and momentum along z stays
    let low = grains
        .spheres
        .iter()
        .filter(|s| grains.room.inside(s.centre).z < 8e-3)
        .count();
    assert!((45..=105).contains(&low), "{low}");
}

#[test]
fn a_bed_periodic_along_z_has_the_same_bits_on_any_threads_and_resumed() {
    assert_same_bits(CELL, ("hertz", 6));
}

#[test]
fn a_grain_that_leaves_above_comes_in_below_and_meets_what_is_there() {
    let text = CELL
        .replace("count = 150", "count = 1")
        .replace(
            "spread = 0.1\nstir = \"0.2 m/s\"",
            "velocity = [\"0 m/s\", \"0 m/s\", \"1 m/s\"]",
        )
        .replace("friction = 0.5\nrestitution = 0.7", "friction = 0.5");
    let scene = Scene::parse(&text, Path::new("one.toml")).unwrap();
    let (report, _folder) = run(&scene);
    let run = &report.laws[0];
    // 60 ms at 1 m/s: almost four periods, none of the speed lost
    assert_eq!(run.summary.lost_grains, 0);
    assert_eq!(run.grains.motions[0].velocity.z, 1.0);
    assert!(run.summary.energy_closure < 1e-12);
}

#[test]
fn what_needs_a_floor_a_top_or_a_weight_is_refused_by_name_where_z_is_periodic() {
    let refused = |from: &str, to: &str, says: &[&str]| {
        assert!(CELL.contains(from), "{from}");
        let scene = Scene::parse(&CELL.replace(from, to), Path::new("shear.toml"));
        let folder = tempfile::tempdir().unwrap();
        let error = scene.and_then(|scene| run_scene(&scene, None, &quiet(folder.path())));
        let Err(error) = error else {
            panic!("not refused: {to}")
        };
        let error = error.to_string();
        for say in says {
            assert!(error.contains(say), "{say:?} is not in: {error}");
        }
    };
    refused("\"0 m/s2\"", "\"9.81 m/s2\"", &["`gravity`", "for ever"]);
    refused(
        "\"0 m/s2\"",
        "[\"1 m/s2\", \"0 m/s2\", \"-1 m/s2\"]",
        &["`gravity`"],
    );
    refused(
        "depth = \"20 mm\"\nheight = \"16 mm\"",
        "depth = \"20 mm\"",
        &["`box.height`", "period"],
    );
    refused(
        "height = \"16 mm\"",
        "height = \"6 mm\"",
        &["`box.height`", "three grain diameters"],
    );
    let duration = "duration = \"60 ms\"";
    let told = |body: &str| {
        format!(
            "{duration}
move = [{{ body = \"{body}\", stop = true }}]"
        )
    };
    for gone in ["floor", "left", "right", "piston"] {
        refused(
            duration,
            &told(gone),
            &["`stage[0].move[0].body`", "must be one of"],
        );
    }
    refused(
        "[\"x\", \"z\"]",
        "[\"x\", \"w\"]",
        &["`periodic[1]`", "\"z\""],
    );
    let stage = "[[stage]]\nkind = \"run\"\nname = \"shear\"";
    let compress = format!(
        "[[stage]]\nkind = \"compress\"\nspeed = \"1 m/s\"\nseating_stress = \"1 kPa\"\nstrain = 0.1\n{stage}"
    );
    refused(stage, &compress, &["`stage[0].kind`", "no piston"]);
    refused(
        "duration = \"60 ms\"",
        "duration = \"60 ms\"\nuntil = { stress = \"1 kPa\" }",
        &["`stage[0].until.stress`", "no piston"],
    );
    for measure in [
        "kind = \"repose\"\naxis = [\"0 mm\", \"0 mm\", \"0 mm\"]",
        "kind = \"slope\"",
        "kind = \"flow\"\nheight = \"3 mm\"",
    ] {
        refused(
            "[output]",
            &format!("[[measure]]\n{measure}\n[output]"),
            &["`measure[0].kind`"],
        );
    }
    let plane = "[[outlet]]\nplane = { at = [\"0 mm\", \"0 mm\", \"-9 mm\"], normal = [0.0, 0.0, -1.0] }\n[output]";
    refused("[output]", plane, &["`outlet[0].plane.normal`", "across z"]);
}
