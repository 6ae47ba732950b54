//! Insertion: grains come in clear of bodies, of other grains and of their images, or are refused before the first step.

use crate::scene_run::quiet;
use impactlaw::bed::filling::insert;
use impactlaw::bed::run::{BedReport, run_scene};
use impactlaw::bed::scene::Scene;
use impactlaw::dem::grains::Sphere;
use impactlaw::dem::grains::neighbours::HalfList;
use impactlaw::dem::grains::periodic::Periodic;
use parry3d::math::Vector;
use std::path::Path;
use std::time::{Duration, Instant};

const MATERIAL: &str = r#"
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[contact]
friction = 0.4
restitution = 0.5
"#;

const BOX: &str = "[box]\nwidth = \"20 mm\"\ndepth = \"20 mm\"\nheight = \"60 mm\"\n";

const BLOCK: &str =
    "region = { low = [\"2 mm\", \"2 mm\", \"4 mm\"], high = [\"18 mm\", \"18 mm\", \"12 mm\"] }";

const CYLINDER: &str =
    "region = { base = [\"10 mm\", \"10 mm\", \"4 mm\"], radius = \"9 mm\", height = \"10 mm\" }";

const SHELF: &str = "[[body]]\nname = \"shelf\"\nblock = { size = [\"16 mm\", \"16 mm\", \"2 mm\"] }\nat = [\"10 mm\", \"10 mm\", \"8 mm\"]\n";

const BALL: &str = "[[body]]\nname = \"boulder\"\nball = { radius = \"4 mm\" }\nat = [\"10 mm\", \"10 mm\", \"9 mm\"]\n";

const RUN: &str =
    "[[stage]]\nkind = \"run\"\nduration = \"0.3 s\"\n[output]\nrows = 60\nframes = 0\nfilm = 0\n";

/// Scene with these keys before the first table, grains of 1 mm, and what else it holds.
fn scene(head: &str, grains: &str, more: &str) -> Result<Scene, impactlaw::Error> {
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n{head}\n{MATERIAL}[grains]\nname = \"sand\"\nradius = \"1 mm\"\n{grains}\n{more}"
    );
    Scene::parse(&text, Path::new("test.toml"))
}

fn run(head: &str, grains: &str, more: &str) -> Result<BedReport, impactlaw::Error> {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene(head, grains, more)?;
    run_scene(&scene, None, &quiet(folder.path()))
}

fn refused(grains: &str, more: &str, says: &[&str]) {
    let error = match run("", grains, more) {
        Ok(_) => panic!("not refused: {grains}"),
        Err(error) => error.to_string(),
    };
    for say in says {
        assert!(error.contains(say), "{say:?} is not in: {error}");
    }
    assert!(!error.contains("step"), "{error}");
}

/// Largest overlap over the diameter, and number of grains, of a run without a warning.
fn overlap(head: &str, grains: &str, more: &str) -> (f64, usize) {
    let report = run(head, grains, more).unwrap_or_else(|error| panic!("{error}"));
    let summary = &report.laws[0].summary;
    assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
    assert_eq!(summary.lost_grains, 0);
    assert!(summary.energy_closure < 0.01, "{}", summary.energy_closure);
    (summary.max_overlap_ratio, summary.grains)
}

#[test]
fn lattices_and_pours_into_a_body_are_refused_with_its_name_and_the_groups() {
    let pour = |region: &str| format!("count = 40\ninsertion = \"pour\"\n{region}");
    let says = ["body[0]", "\"shelf\"", "\"sand\"", "move the body"];
    refused(&pour(BLOCK), &format!("{BOX}{SHELF}{RUN}"), &says);
    let says = ["body[0]", "\"boulder\"", "\"sand\"", "move the body"];
    refused(&pour(CYLINDER), &format!("{BOX}{BALL}{RUN}"), &says);
    // a lattice that comes in later, where a body stands that no stage moves
    let late = format!("{BOX}{BALL}{RUN}").replace("0.3 s\"", "0.3 s\"\ninsert = [\"sand\"]");
    refused(&format!("count = 40\n{BLOCK}"), &late, &says);
}

#[test]
fn a_stream_goes_round_bodies() {
    let stream =
        |region: &str| format!("count = 40\ninsertion = \"stream\"\nrate = \"4 g/s\"\n{region}");
    for (region, body) in [(BLOCK, SHELF), (CYLINDER, BALL)] {
        let (overlap, grains) = overlap("", &stream(region), &format!("{BOX}{body}{RUN}"));
        assert!(overlap < 0.04, "{overlap}");
        assert_eq!(grains, 40);
    }
    // a body that comes and goes through the region
    let shaken = format!(
        "{BALL}driven = {{ oscillation = {{ direction = [1.0, 0.0, 0.0], amplitude = \"1 mm\", frequency = \"20 Hz\" }} }}\n"
    );
    let (overlap, grains) = overlap("", &stream(CYLINDER), &format!("{BOX}{shaken}{RUN}"));
    assert!(overlap < 0.04, "{overlap}");
    assert_eq!(grains, 40);
}

#[test]
fn a_stream_without_room_waits_and_says_what_is_in_its_way() {
    let stream = format!("count = 40\ninsertion = \"stream\"\nrate = \"4 g/s\"\n{BLOCK}");
    let full = SHELF.replace(
        "\"16 mm\", \"16 mm\", \"2 mm\"",
        "\"19 mm\", \"19 mm\", \"9 mm\"",
    );
    let report = run("", &stream, &format!("{BOX}{full}{RUN}")).unwrap();
    let summary = &report.laws[0].summary;
    assert_eq!(summary.grains, 0);
    let warning = &summary.warnings[0];
    assert!(
        warning.contains("\"sand\"") && warning.contains("in the way of its region: shelf"),
        "{warning}"
    );
}

#[test]
fn a_lattice_that_finds_grains_where_it_comes_in_waits_until_they_are_gone() {
    let grains = format!(
        "count = 40\ninsertion = \"lattice\"\n{BLOCK}\n[[grains]]\nname = \"late\"\ncount = 30\nradius = \"1 mm\"\n{BLOCK}"
    );
    let grains = grains
        .replace("\"12 mm\"", "\"22 mm\"")
        .replace("\"4 mm\"", "\"14 mm\"");
    let more = format!("{BOX}{RUN}").replace("0.3 s\"", "0.3 s\"\ninsert = [\"late\"]");
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n{MATERIAL}[[grains]]\nname = \"sand\"\nradius = \"1 mm\"\n{grains}\n{more}"
    );
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::parse(&text, Path::new("test.toml")).unwrap();
    let report = run_scene(&scene, None, &quiet(folder.path())).unwrap_or_else(|e| panic!("{e}"));
    let summary = &report.laws[0].summary;
    assert_eq!(summary.grains, 70);
    assert!(
        summary.max_overlap_ratio < 0.04,
        "{}",
        summary.max_overlap_ratio
    );
}

#[test]
fn grains_that_come_in_across_periodic_sides_overlap_as_little_as_between_walls() {
    let narrow = "[box]\nwidth = \"12 mm\"\ndepth = \"12 mm\"\nheight = \"60 mm\"\n";
    let region = "region = { low = [\"0 mm\", \"0 mm\", \"8 mm\"], high = [\"12 mm\", \"12 mm\", \"24 mm\"] }";
    let stream = format!("count = 400\ninsertion = \"stream\"\nrate = \"100 g/s\"\n{region}");
    let pour = format!("count = 300\ninsertion = \"pour\"\n{region}");
    let more = format!("{narrow}{RUN}").replace("0.3 s", "0.2 s");
    for (sides, grains) in [
        ("periodic = [\"x\", \"y\"]", &stream),
        ("periodic = [\"x\"]", &stream),
        ("periodic = [\"x\", \"y\"]", &pour),
    ] {
        let report = run(sides, grains, &more).unwrap_or_else(|error| panic!("{error}"));
        let summary = &report.laws[0].summary;
        let overlap = summary.max_overlap_ratio;
        assert!(
            overlap < 0.03 && overlap > 0.0,
            "{sides} {grains}: {overlap}"
        );
        assert!(summary.energy_closure < 0.01, "{}", summary.energy_closure);
        assert!(
            summary.plastic_share.abs() < 0.01,
            "{}",
            summary.plastic_share
        );
    }
}

#[test]
fn a_periodic_room_without_grains_and_tiny_grains_in_a_wide_one_are_searched() {
    let room = Periodic::new(Vector::ZERO, [Some(1.0), Some(1.0), Some(1.0)]).unwrap();
    assert!(HalfList::within(&room, &[], 0.0).pairs.is_empty());
    let tiny = |x: f64| Sphere {
        centre: Vector::new(x, 0.5, 0.5),
        radius: 1e-9,
    };
    let spheres = [tiny(0.5), tiny(0.5 + 1e-9), tiny(0.9)];
    assert_eq!(HalfList::within(&room, &spheres, 0.0).pairs, [[0, 1]]);
}

#[test]
fn stages_shorter_than_a_step_and_more_rows_than_steps_end() {
    let lattice = format!("count = 10\n{BLOCK}");
    let settle = "[[stage]]\nkind = \"settle\"\nlongest = \"1e-25 s\"\nrest_speed = \"1 mm/s\"\n";
    let rows = RUN
        .replace("rows = 60", "rows = 1000000000000")
        .replace("0.3 s", "1 ms");
    let report = run("", &lattice, &format!("{BOX}{settle}{rows}")).unwrap();
    let steps = report.laws[0].summary.steps;
    // a row in each step, and the one at the end
    assert_eq!(report.laws[0].rows.len() as u64, steps + 2);
}

#[test]
fn a_large_region_costs_no_more_than_the_grains_that_come_in() {
    let region =
        "region = { low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"1 m\", \"1 m\", \"1 m\"] }";
    let box_ = "[box]\nwidth = \"1 m\"\ndepth = \"1 m\"\nheight = \"1 m\"\n";
    let pour = format!("count = 10\ninsertion = \"pour\"\n{region}");
    let scene = scene("", &pour, &format!("{box_}{RUN}")).unwrap();
    let began = Instant::now();
    insert(&scene, 1).unwrap();
    assert!(
        began.elapsed() < Duration::from_secs(2),
        "{:?}",
        began.elapsed()
    );
}

#[test]
fn more_grains_than_memory_are_refused_with_what_they_need() {
    let many = format!("count = 1000000000000\ninsertion = \"pour\"\n{BLOCK}");
    let says = ["grains.count", "1.0e12 grains", "GB of memory"];
    refused(&many, &format!("{BOX}{RUN}"), &says);
    let heavy = format!("mass = \"1e9 kg\"\ninsertion = \"pour\"\n{BLOCK}");
    let says = ["grains.mass", "GB of memory"];
    refused(&heavy, &format!("{BOX}{RUN}"), &says);
}
