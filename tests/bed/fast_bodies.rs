//! Fast and free bodies: the time step follows what moves, what no law can follow is refused, and bodies that would meet
//! bodies stop the run by name.

use crate::collisions::{MATERIAL, RADIUS, bed, empty, smooth};
use crate::scene_run::quiet;
use impactlaw::bed::run::{BedReport, run_scene};
use impactlaw::bed::scene::Scene;
use impactlaw::contact::pair::{Alike, Flat};
use impactlaw::dem::grains::Grains;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;
use std::path::Path;

const HEAD: &str = r#"seed = 1
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[contact]
friction = 0.4
restitution = 0.4
"#;

const LAYER: &str = r#"
[grains]
count = 20
radius = "1 mm"
region = { low = ["0 mm", "0 mm", "0 mm"], high = ["20 mm", "20 mm", "4 mm"] }
[box]
width = "20 mm"
depth = "20 mm"
height = "40 mm"
"#;

const CLOUD: &str = r#"
[grains]
count = 20
radius = "2 mm"
region = { low = ["20 mm", "-20 mm", "-20 mm"], high = ["40 mm", "20 mm", "20 mm"] }
[domain]
low = ["-4 m", "-1 m", "-1 m"]
high = ["4 m", "1 m", "1 m"]
[[body]]
name = "blade"
block = { size = ["2 mm", "100 mm", "100 mm"] }
at = ["0 mm", "0 mm", "0 mm"]
"#;

/// Across gravity: where that leads is found as the run goes.
const THROWN: &str = ", velocity = [\"0.01 m/s\", \"0 m/s\", \"0 m/s\"]";

fn stage(duration: &str) -> String {
    format!(
        "[[stage]]\nkind = \"run\"\nduration = \"{duration}\"\n[output]\nrows = 20\nframes = 0\nfilm = 0\n"
    )
}

fn run(text: &str) -> Result<BedReport, impactlaw::Error> {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::parse(text, Path::new("test.toml"))?;
    run_scene(&scene, None, &quiet(folder.path()))
}

fn error(text: &str) -> String {
    match run(text) {
        Ok(_) => panic!("no error: {text}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn bodies_too_fast_for_any_contact_law_are_refused_with_the_largest_speed() {
    // the grains' limit: sqrt(4 E* / (5 pi rho)) = sqrt(4 * 1.067e7 / (5 pi * 2500)) = 32.96 m/s
    for (how, key, speed) in [
        (
            "driven = { velocity = [\"80 m/s\", \"0 m/s\", \"0 m/s\"] }",
            "body[0].driven",
            "80",
        ),
        (
            "driven = { spin = { axis = [0.0, 0.0, 1.0], rate = \"750 rad/s\" } }",
            "body[0].driven",
            "53",
        ),
        (
            "driven = { oscillation = { direction = [1.0, 0.0, 0.0], amplitude = \"10 mm\", frequency = \"1 kHz\" } }",
            "body[0].driven",
            "62.8",
        ),
        (
            "free = { mass = \"1 g\", velocity = [\"40 m/s\", \"0 m/s\", \"0 m/s\"] }",
            "body[0].free.velocity",
            "40",
        ),
    ] {
        let says = error(&format!("{HEAD}{CLOUD}{how}\n{}", stage("1 ms")));
        let found = format!("{speed} m/s");
        for say in [key, &found, "33 m/s", "flattened"] {
            assert!(says.contains(say), "{say:?} is not in: {says}");
        }
    }
    let told = stage("1 ms").replace(
        "[output]",
        "move = [{ body = \"blade\", driven = { velocity = [\"80 m/s\", \"0 m/s\", \"0 m/s\"] } }]\n[output]",
    );
    let says = error(&format!("{HEAD}{CLOUD}{told}"));
    assert!(says.contains("stage[0].move[0].driven"), "{says}");
}

#[test]
fn a_fast_blade_hits_every_grain_of_a_stiff_cloud() {
    let stiff = HEAD
        .replace("10 MPa", "10 GPa")
        .replace("9.81 m/s2", "0 m/s2");
    for (contact, speed) in [("", 80.0), ("stiffness = 1e-2\n", 12.0)] {
        let head = stiff.replace("[contact]\n", &format!("[contact]\n{contact}"));
        let how = format!("driven = {{ velocity = [\"{speed} m/s\", \"0 m/s\", \"0 m/s\"] }}\n");
        let duration = format!("{} ms", 80.0 / speed);
        let report = run(&format!("{head}{CLOUD}{how}{}", stage(&duration)));
        let report = report.unwrap_or_else(|error| panic!("{error}"));
        let run = &report.laws[0];
        assert_eq!(run.grains.len(), 20);
        // its face has come to 81 mm: what it had not hit would lie behind it
        for (sphere, motion) in run.grains.spheres.iter().zip(&run.grains.motions) {
            assert!(
                sphere.centre.x > 81e-3 && motion.velocity.x > 0.0,
                "{sphere:?}"
            );
        }
        assert!(
            run.summary.energy_closure < 0.02,
            "{}",
            run.summary.energy_closure
        );
        let way = run.summary.time_step_s * speed;
        assert!(way <= 0.1 * 2e-3, "{way}");
    }
}

#[test]
fn the_time_step_follows_a_body_before_it_meets_a_grain() {
    let rest = format!("{HEAD}{CLOUD}{}", stage("0.1 ms")).replace("9.81 m/s2", "0 m/s2");
    let swung = rest.replace(
        "at = [\"0 mm\", \"0 mm\", \"0 mm\"]\n",
        "at = [\"-50 mm\", \"0 mm\", \"0 mm\"]\ndriven = { spin = { axis = [0.0, 0.0, 1.0], rate = \"350 rad/s\" } }\n",
    );
    let step = |text: &str| run(text).unwrap().laws[0].summary.time_step_s;
    // tip at 350 rad/s * 70.7 mm = 24.8 m/s; at rest nothing bounds the step but the Rayleigh time
    let (rest, swung) = (step(&rest), step(&swung));
    assert!(swung < 0.5 * rest, "{swung} of {rest}");
    assert!(swung * 24.7 < 0.1 * 2e-3, "{swung}");
}

#[test]
fn a_free_body_that_comes_to_another_body_stops_the_run_by_name() {
    let ball = |name: &str, height: &str, more: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nball = {{ radius = \"4 mm\" }}\nat = [\"12 mm\", \"14 mm\", \"{height}\"]\nfree = {{ density = \"7800 kg/m3\"{more} }}\n"
        )
    };
    let fall = format!(
        "{HEAD}{LAYER}{}{}",
        ball("ball", "20 mm", THROWN),
        stage("0.3 s")
    );
    let says = error(&fall);
    assert!(says.contains("\"ball\" has come to \"floor\""), "{says}");
    // two free bodies, one overtaking the other
    let fast = ", velocity = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"]";
    let fast = fast.replace("\"0 m/s\", \"0 m/s\"", "\"0.01 m/s\", \"0 m/s\"");
    let two = [
        ball("lower", "20 mm", THROWN),
        ball("upper", "32 mm", &fast),
    ]
    .concat();
    let says = error(&format!("{HEAD}{LAYER}{two}{}", stage("0.3 s")));
    assert!(
        says.contains("has come to \"upper\"") || says.contains("has come to \"lower\""),
        "{says}"
    );
    // a driven plate that comes up from below
    let plate = "[[body]]\nname = \"plate\"\nblock = { size = [\"4 mm\", \"4 mm\", \"1 mm\"] }\nat = [\"12 mm\", \"14 mm\", \"10 mm\"]\ndriven = { velocity = [\"0 m/s\", \"0 m/s\", \"0.5 m/s\"] }\n";
    let still = fall.replace("9.81 m/s2", "0 m/s2");
    let says = error(&still.replace("[[stage]]", &format!("{plate}[[stage]]")));
    assert!(says.contains("\"ball\" has come to \"plate\""), "{says}");
}

#[test]
fn a_free_body_that_falls_straight_to_another_is_refused_unless_a_grain_may_be_in_its_way() {
    let scene = |at: &str, duration: &str, more: &str| {
        let ball = format!(
            "[[body]]\nname = \"ball\"\nball = {{ radius = \"1.5 mm\" }}\nat = {at}\nfree = {{ density = \"7800 kg/m3\"{more} }}\n"
        );
        let flat = LAYER.replace("20 mm\", \"4 mm\"]", "20 mm\", \"2.5 mm\"]");
        format!("{HEAD}{flat}{ball}{}", stage(duration))
    };
    // grains stand in the corner at the origin, one layer of them
    let aside = "[\"17 mm\", \"17 mm\", \"6.4049 mm\"]";
    let says = error(&scene(aside, "0.3 s", ""));
    // 4.9049 mm down: sqrt(2 s/g) = 31.6 ms
    for say in [
        "body[0].free",
        "must not come to \"floor\"",
        "31.6 ms",
        "no grain in its way",
    ] {
        assert!(says.contains(say), "{say:?} is not in: {says}");
    }
    // too short a time, held, no gravity's way, grains below
    for (at, duration, more) in [
        (aside, "31 ms", ""),
        (aside, "32 ms", ", held = true"),
        ("[\"3 mm\", \"3 mm\", \"7 mm\"]", "32 ms", ""),
    ] {
        if let Err(error) = run(&scene(at, duration, more)) {
            panic!("{at} {duration} {more}: {error}");
        }
    }
    // sent off without gravity, to a wall: 1.5 mm at 0.1 m/s
    let sent = ", velocity = [\"0.1 m/s\", \"0 m/s\", \"0 m/s\"]";
    let says = error(&scene(aside, "20 ms", sent).replace("9.81 m/s2", "0 m/s2"));
    for say in ["must not come to \"right\"", "15 ms"] {
        assert!(says.contains(say), "{say:?} is not in: {says}");
    }
}

#[test]
fn what_moves_too_far_in_a_step_is_named() {
    let speed = Vector::new(1e3, 0.0, 0.0);
    let mut grains = Grains::default();
    for (x, velocity) in [(0.0, Vector::ZERO), (1.0, speed)] {
        grains.add(Vector::new(x, 0.0, 0.0), RADIUS, MATERIAL.density);
        grains.motions.last_mut().unwrap().velocity = velocity;
    }
    let law = Hertz::of(&MATERIAL);
    let mut bed = bed(smooth(), Alike(law), Flat(law), grains, empty(), 1e-6);
    let mut moved = || {
        bed.evaluate()?;
        bed.advance()?;
        bed.evaluate()
    };
    let says = moved().unwrap_err().to_string();
    for say in [
        "grain 1 at (1001.0000, 0.0000, 0.0000) mm",
        "1000.000 m/s fast",
        "in one step",
    ] {
        assert!(says.contains(say), "{say:?} is not in: {says}");
    }
}

#[test]
fn a_free_body_that_starts_in_another_is_refused_and_one_that_is_held_or_joined_is_not() {
    let scene = |how: &str| {
        format!(
            "{HEAD}{LAYER}[[body]]\nname = \"block\"\nblock = {{ size = [\"8 mm\", \"8 mm\", \"8 mm\"] }}\nat = [\"1 mm\", \"10 mm\", \"20 mm\"]\nfree = {{ mass = \"1 g\"{how} }}\n{}",
            stage("1 ms")
        )
    };
    let says = error(&scene(""));
    for say in ["body[0].free", "\"left\"", "hold it"] {
        assert!(says.contains(say), "{say:?} is not in: {says}");
    }
    assert!(run(&scene(", held = true")).is_ok());
    let joint = ", joint = { kind = \"prismatic\", axis = [0.0, 0.0, 1.0] }";
    assert!(run(&scene(joint)).is_ok());
}

#[test]
fn a_free_body_that_leaves_the_room_is_counted_and_reported() {
    let free = "free = { mass = \"1 g\", velocity = [\"-25 m/s\", \"0 m/s\", \"0 m/s\"] }\n";
    let near = CLOUD.replace("-4 m", "-0.01 m");
    let text = format!("{HEAD}{near}{free}{}", stage("2 ms")).replace("9.81 m/s2", "0 m/s2");
    let report = run(&text).unwrap_or_else(|error| panic!("{error}"));
    let summary = &report.laws[0].summary;
    assert_eq!((summary.lost_grains, summary.lost_bodies), (0, 1));
    assert!(
        summary
            .warnings
            .iter()
            .any(|w| w.contains("free bodies were outside")),
        "{:?}",
        summary.warnings
    );
}

#[test]
fn grains_too_fast_for_any_contact_law_are_refused_with_the_largest_speed() {
    let fast = CLOUD.replace(
        "radius = \"2 mm\"\n",
        "radius = \"2 mm\"\nvelocity = [\"40 m/s\", \"0 m/s\", \"0 m/s\"]\n",
    );
    let says = error(&format!("{HEAD}{fast}{}", stage("1 ms")));
    for say in ["grains.velocity", "40 m/s", "33 m/s", "flattened"] {
        assert!(says.contains(say), "{say:?} is not in: {says}");
    }
}

#[test]
fn a_region_beyond_the_walls_or_the_domain_is_refused_with_both_extents() {
    let beyond = LAYER.replace("low = [\"0 mm\", \"0 mm\"", "low = [\"0 mm\", \"-3 mm\"");
    let says = error(&format!("{HEAD}{beyond}{}", stage("1 ms")));
    for say in [
        "grains.region",
        "`[box]`",
        "-3.000 to 20.000 mm along y",
        "0.000 to 20.000",
    ] {
        assert!(says.contains(say), "{say:?} is not in: {says}");
    }
    // below the floor; above the rim a box is open
    let below = LAYER.replace("\"0 mm\"], high", "\"-1 mm\"], high");
    assert!(error(&format!("{HEAD}{below}{}", stage("1 ms"))).contains("along z"));
    let above = LAYER.replace(
        "low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"20 mm\", \"20 mm\", \"4 mm\"]",
        "low = [\"0 mm\", \"0 mm\", \"42 mm\"], high = [\"20 mm\", \"20 mm\", \"46 mm\"]",
    );
    assert!(run(&format!("{HEAD}{above}{}", stage("0.1 ms"))).is_ok());
    let outside = CLOUD.replace("high = [\"4 m\", \"1 m\"", "high = [\"30 mm\", \"1 m\"");
    let says = error(&format!("{HEAD}{outside}{}", stage("1 ms")));
    assert!(
        says.contains("`[domain]`") && says.contains("along x"),
        "{says}"
    );
}

#[test]
fn what_moves_by_a_radius_in_one_step_stops_the_run() {
    let law = Hertz::of(&MATERIAL);
    let thrown = |ways: f64| {
        let mut grains = Grains::default();
        grains.add(Vector::ZERO, RADIUS, MATERIAL.density);
        grains.motions[0].velocity = Vector::new(1.0, 0.0, 0.0);
        let dt = ways * RADIUS;
        let mut bed = bed(smooth(), Alike(law), Flat(law), grains, empty(), dt);
        (0..5).try_for_each(|_| bed.step())
    };
    // neighbours are listed up to a radius away: half of that and a radius is what is caught
    assert!(thrown(1.0).is_ok());
    let says = thrown(1.6).unwrap_err().to_string();
    assert!(
        says.contains("in one step by more than the radius"),
        "{says}"
    );
}
