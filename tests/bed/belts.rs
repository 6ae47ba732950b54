//! Belts: grains feel the surface of a body that stands move along itself, and the work it does is booked.

use crate::same_bits::assert_same_bits;
use crate::scene_run::{quiet, run};
use impactlaw::bed::run::{BedReport, run_scene};
use impactlaw::bed::scene::Scene;
use std::path::Path;

const HEAD: &str = r#"
seed = 3
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[contact]
friction = 0.3
restitution = 0.4
"#;

/// One grain that lies 1 um above a plane, which has these keys more; how long it runs.
fn lying(plane: &str, more: &str, duration: &str) -> String {
    format!(
        "{HEAD}{more}[grains]\ncount = 1\nradius = \"1 mm\"\nregion = {{ low = [\"-1.15 mm\", \"-1.15 mm\", \"-0.099 mm\"], high = [\"1.15 mm\", \"1.15 mm\", \"2.2 mm\"] }}\n\
         [domain]\nlow = [\"-1 m\", \"-1 m\", \"-0.1 m\"]\nhigh = [\"1 m\", \"1 m\", \"0.1 m\"]\n\
         [[body]]\nname = \"belt\"\nplane = {{ normal = [0.0, 0.0, 1.0] }}\nat = [\"0 mm\", \"0 mm\", \"-0.2 mm\"]\n{plane}\n\
         [[stage]]\nkind = \"run\"\nduration = \"{duration}\"\n[output]\nrows = 40\nframes = 0\nfilm = 0\n"
    )
}

fn ran(text: &str) -> BedReport {
    let scene = Scene::parse(text, Path::new("belt.toml")).unwrap_or_else(|e| panic!("{e}"));
    run(&scene).0
}

/// Velocity along x and turn about y of the grain at the end.
fn motion(report: &BedReport) -> [f64; 2] {
    let grains = &report.laws[0].grains;
    [grains.motions[0].velocity.x, grains.spins[0].rate.y]
}

#[test]
fn a_grain_laid_on_a_belt_ends_rolling_at_two_sevenths_of_its_speed() {
    // it slides until v + omega R, with v = mu g t and omega R = 5/2 mu g t, is the speed of the belt: 0.029 s
    let speed = 0.3;
    let belt = "belt = { velocity = [\"0.3 m/s\", \"0 m/s\", \"0.4 m/s\"] }";
    let report = ran(&lying(belt, "", "0.15 s"));
    let [velocity, turn] = motion(&report);
    assert!(
        (velocity / (2.0 / 7.0 * speed) - 1.0).abs() < 2e-3,
        "{velocity}"
    );
    assert!(
        (-turn * 1e-3 / (5.0 / 7.0 * speed) - 1.0).abs() < 2e-3,
        "{turn}"
    );
    let summary = &report.laws[0].summary;
    assert!(summary.energy_closure < 1e-3, "{}", summary.energy_closure);
    // the belt spends m V 2/7 V: half is motion, half is lost to friction
    let last = report.laws[0].rows.last().unwrap();
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    let work = mass * 2.0 / 7.0 * speed * speed;
    assert!(
        (last.driven_work_j / work - 1.0).abs() < 5e-3,
        "{}",
        last.driven_work_j / work
    );
    assert!((last.losses.friction / (0.5 * work) - 1.0).abs() < 1e-2);
}

#[test]
fn a_belt_moves_grains_as_a_plane_that_is_driven_along_itself() {
    let rolling = "rolling = 0.05\n";
    let velocity = "velocity = [\"0.2 m/s\", \"-0.1 m/s\", \"0 m/s\"]";
    let [belt, driven] = ["belt", "driven"].map(|way| {
        ran(&lying(
            &format!("{way} = {{ {velocity} }}"),
            rolling,
            "0.1 s",
        ))
    });
    let (a, b) = (&belt.laws[0].grains, &driven.laws[0].grains);
    let apart = (a.spheres[0].centre - b.spheres[0].centre).length();
    assert!(apart < 1e-9, "{apart} m");
    assert!((a.motions[0].velocity - b.motions[0].velocity).length() < 1e-7);
    assert!((a.spins[0].rate - b.spins[0].rate).length() < 1e-4);
    let work = |report: &BedReport| report.laws[0].rows.last().unwrap().driven_work_j;
    assert!(work(&belt) > 0.0);
    assert!((work(&belt) / work(&driven) - 1.0).abs() < 1e-6);
}

#[test]
fn a_roller_whose_surface_turns_throws_grains_as_one_that_turns() {
    let spin = "{ spin = { axis = [0.0, 1.0, 0.0], rate = \"300 rpm\" } }";
    let scene = |way: &str| {
        format!(
            "{HEAD}rolling = 0.02\n[grains]\ncount = 30\nradius = \"1 mm\"\nspread = 0.1\nregion = {{ low = [\"12 mm\", \"2 mm\", \"13.2 mm\"], high = [\"28 mm\", \"18 mm\", \"30 mm\"] }}\n\
             [box]\nwidth = \"40 mm\"\ndepth = \"20 mm\"\nheight = \"60 mm\"\n\
             [[body]]\nname = \"roller\"\ncylinder = {{ radius = \"6 mm\", length = \"20 mm\", axis = [0.0, 1.0, 0.0] }}\nat = [\"20 mm\", \"10 mm\", \"7 mm\"]\n{way} = {spin}\n\
             [[stage]]\nkind = \"run\"\nduration = \"0.06 s\"\n[output]\nrows = 30\nframes = 0\nfilm = 0\n"
        )
    };
    let [belt, driven] = ["belt", "driven"].map(|way| ran(&scene(way)));
    let (a, b) = (&belt.laws[0].grains, &driven.laws[0].grains);
    let mean = |grains: &impactlaw::dem::grains::Grains| {
        let sum: f64 = grains.motions.iter().map(|m| m.velocity.x).sum();
        sum / grains.len() as f64
    };
    assert!(mean(a) > 0.02, "{} m/s", mean(a));
    assert!(
        (mean(a) / mean(b) - 1.0).abs() < 1e-3,
        "{} {}",
        mean(a),
        mean(b)
    );
    for report in [&belt, &driven] {
        let closure = report.laws[0].summary.energy_closure;
        assert!(closure < 1e-3, "{closure}");
    }
    let work = |report: &BedReport| report.laws[0].rows.last().unwrap().driven_work_j;
    assert!(
        (work(&belt) / work(&driven) - 1.0).abs() < 1e-3,
        "{} {}",
        work(&belt),
        work(&driven)
    );
}

/// A conveyor under a layer of grains: it starts, runs faster, and stops.
const CONVEYOR: &str = r#"
seed = 3
gravity = "9.81 m/s2"
periodic = ["x"]
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
yield_strength = "30 kPa"
law = "thornton"
[contact]
friction = 0.4
rolling = 0.05
restitution = 0.5
[grains]
count = 220
radius = "1 mm"
spread = 0.2
region = { low = ["0 mm", "0 mm", "5 mm"], high = ["30 mm", "16 mm", "30 mm"] }
[box]
width = "30 mm"
depth = "16 mm"
height = "40 mm"
[[body]]
name = "conveyor"
block = { size = ["60 mm", "40 mm", "8 mm"] }
at = ["15 mm", "8 mm", "0.5 mm"]
belt = {}
[[stage]]
kind = "run"
name = "fall"
duration = "40 ms"
[[stage]]
kind = "run"
name = "start"
duration = "30 ms"
move = [{ body = "conveyor", belt = { velocity = ["0.3 m/s", "0 m/s", "0 m/s"] } }]
[[stage]]
kind = "run"
name = "faster"
duration = "30 ms"
move = [{ body = "conveyor", belt = { velocity = ["0.6 m/s", "0 m/s", "0 m/s"] } }]
[[stage]]
kind = "run"
name = "stop"
duration = "40 ms"
move = [{ body = "conveyor", belt = {} }]
[output]
rows = 8
frames = 1
film = 2
"#;

#[test]
fn a_conveyor_carries_a_layer_books_its_work_and_stops_it_again() {
    let report = ran(CONVEYOR);
    let (rows, summary) = (&report.laws[0].rows, &report.laws[0].summary);
    assert!(summary.energy_closure < 2e-3, "{}", summary.energy_closure);
    assert_eq!(summary.lost_grains, 0);
    let end = |stage: &str| rows.iter().rfind(|row| row.stage == stage).unwrap();
    assert_eq!(end("fall").driven_work_j, 0.0);
    let (start, faster, stop) = (end("start"), end("faster"), end("stop"));
    assert!(start.driven_work_j > 0.0);
    assert!(faster.driven_work_j > 1.5 * start.driven_work_j);
    assert_eq!(stop.driven_work_j, faster.driven_work_j);
    assert!(
        stop.kinetic_j < 0.3 * faster.kinetic_j,
        "{} {}",
        stop.kinetic_j,
        faster.kinetic_j
    );
}

#[test]
fn a_bed_with_a_belt_has_the_same_bits_on_any_threads_and_resumed() {
    assert_same_bits(CONVEYOR, ("thornton", 21));
}

#[test]
fn the_time_step_follows_the_speed_of_a_belt() {
    let step = |speed: &str| {
        let belt = format!("belt = {{ velocity = [\"{speed}\", \"0 m/s\", \"0 m/s\"] }}");
        let text = lying(&belt, "", "1 ms").replace("10 MPa", "10 GPa");
        ran(&text).laws[0].rows[0].time_step_s
    };
    let (slow, fast) = (step("0.01 m/s"), step("300 m/s"));
    // no grain moves by more than a tenth of its radius in a step
    assert!(fast <= 0.1 * 1e-3 / 300.0 * 1.0001, "{fast}");
    assert!(slow > 1.5 * fast, "{slow} {fast}");
}

#[test]
fn belts_that_cannot_be_are_refused_by_name() {
    let refused = |text: &str, says: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let scene = Scene::parse(text, Path::new("belt.toml"));
        let error = scene.and_then(|scene| run_scene(&scene, None, &quiet(folder.path())));
        let Err(error) = error else {
            panic!("not refused: {text}")
        };
        let error = error.to_string();
        for say in says {
            assert!(error.contains(say), "{say:?} is not in: {error}");
        }
        assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
    };
    let of = |plane: &str| lying(plane, "", "1 ms");
    let along = "belt = { velocity = [\"0 m/s\", \"0 m/s\", \"1 m/s\"] }";
    refused(&of(along), &["`body[0].belt.velocity`", "along the plane"]);
    let turned = "belt = { spin = { axis = [0.0, 0.0, 1.0], rate = \"1 rpm\" } }";
    refused(&of(turned), &["`body[0].belt.spin`", "no end"]);
    let both = "belt = {}\ndriven = {}";
    refused(&of(both), &["`body[0].belt`", "must stand alone"]);
    let fast = "belt = { velocity = [\"3 km/s\", \"0 m/s\", \"0 m/s\"] }";
    refused(&of(fast), &["`body[0].belt`", "must be slower"]);
    let unknown = "belt = { force = \"1 N\" }";
    refused(&of(unknown), &["unknown field `force`"]);
    let moved = |change: &str| {
        CONVEYOR.replace(
            "move = [{ body = \"conveyor\", belt = {} }]",
            &format!("move = [{change}]"),
        )
    };
    refused(
        &moved(
            "{ body = \"conveyor\", driven = { velocity = [\"0 m/s\", \"0 m/s\", \"1 m/s\"] } }",
        ),
        &["`stage[3].move[0]`", "must not be told to a belt"],
    );
    refused(
        &moved("{ body = \"floor\", belt = {} }"),
        &["`stage[3].move[0].belt`", "a body that is a belt"],
    );
    refused(
        &moved("{ body = \"conveyor\", belt = { velocity = [\"4 km/s\", \"0 m/s\", \"0 m/s\"] } }"),
        &["`stage[3].move[0].belt`", "must be slower"],
    );
    refused(
        &moved("{ body = \"conveyor\", belt = {}, stop = true }"),
        &["`stage[3].move[0]`", "must hold one change"],
    );
}
