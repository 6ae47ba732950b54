//! Scenes: the shipped ones are sound, stages and bodies do what they say, and the order of tables does not matter.

use crate::scene_run::quiet;
use impactlaw::bed::filling::{check_bodies, insert};
use impactlaw::bed::run::{BedReport, LawRun, run_scene};
use impactlaw::bed::scene::Scene;
use impactlaw::dem::bodies::Solid;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::mesh::{Format, read};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// Soft grains, so that a test needs few steps.
const MATERIAL: &str = r#"
[material]
density = "2500 kg/m3"
young_modulus = "2 MPa"
poisson_ratio = 0.3
law = "hertz"
"#;

const HEAD: &str = "seed = 3\ngravity = \"9.81 m/s2\"\n";

const BOX: &str = "[box]\nwidth = \"10 mm\"\ndepth = \"10 mm\"\nheight = \"40 mm\"\n";

const EFFECTS: &str = "[contact]\nfriction = 0.4\nrestitution = 0.6\n";

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")
}

fn parse(text: &str) -> Result<Scene, impactlaw::Error> {
    Scene::parse(text, &cases().join("test.toml"))
}

fn run_in(folder: &Path, text: &str) -> Result<BedReport, impactlaw::Error> {
    run_scene(&parse(text)?, None, &quiet(folder))
}

fn run(text: &str) -> BedReport {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), text).unwrap_or_else(|error| panic!("{error}"))
}

fn only(report: &BedReport) -> &LawRun {
    assert_eq!(report.laws.len(), 1);
    &report.laws[0]
}

/// Scene in the small box with 60 grains of 1 mm, and more tables.
fn boxed(more: &str) -> String {
    let grains = "[grains]\ncount = 60\nradius = \"1 mm\"\n";
    format!("{HEAD}{MATERIAL}{grains}{EFFECTS}{BOX}{more}")
}

const FALL: &str = "[[stage]]\nkind = \"run\"\nname = \"fall\"\nduration = \"0.3 s\"\nuntil = { rest_speed = \"5 mm/s\" }\n";

#[test]
fn every_shipped_scene_is_sound_before_its_first_step() {
    let mut found = 0;
    for entry in std::fs::read_dir(cases()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !(name.contains("bed") || name.contains("benchmark")) || !name.ends_with(".toml") {
            continue;
        }
        let scene = Scene::read(&path).unwrap_or_else(|error| panic!("{error}"));
        let (grains, feed, room) = insert(&scene, scene.seed).unwrap_or_else(|e| panic!("{e}"));
        let machine = Machine::new(scene.all_bodies(&room), scene.gravity, scene.radius()).unwrap();
        check_bodies(&scene, &feed, &grains, &machine).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(
            grains.spheres.iter().all(|s| room.holds(s.centre)),
            "{name}"
        );
        found += 1;
    }
    assert!(found >= 10, "{found}");
}

#[test]
fn the_order_of_tables_does_not_change_a_bit() {
    let tables = [
        MATERIAL,
        "[grains]\ncount = 40\nradius = \"1 mm\"\nspread = 0.1\nstir = \"0.1 m/s\"\n",
        EFFECTS,
        BOX,
        FALL,
        "[[body]]\nname = \"ball\"\nball = { radius = \"2 mm\" }\nat = [\"5 mm\", \"5 mm\", \"36 mm\"]\nfree = { density = \"7800 kg/m3\", joint = { kind = \"prismatic\", axis = [0.0, 0.0, 1.0] } }\n",
        "[output]\nrows = 20\nframes = 0\n",
    ];
    let text = |order: &[usize]| {
        let tables: String = order.iter().map(|&table| tables[table]).collect();
        format!("{HEAD}{tables}")
    };
    let one = run(&text(&[0, 1, 2, 3, 4, 5, 6]));
    let other = run(&text(&[6, 5, 3, 4, 2, 0, 1]));
    assert!(only(&one).rows.len() > 10);
    assert_eq!(only(&one).rows, only(&other).rows);
    assert_eq!(only(&one).grains, only(&other).grains);
}

#[test]
fn poured_grains_all_come_in_come_to_rest_and_close_their_energy() {
    let grains = "[grains]\ncount = 120\nradius = \"1 mm\"\nspread = 0.2\ninsertion = \"pour\"\nvelocity = [\"0 m/s\", \"0 m/s\", \"-0.3 m/s\"]\nregion = { low = [\"0.5 mm\", \"0.5 mm\", \"20 mm\"], high = [\"9.5 mm\", \"9.5 mm\", \"28 mm\"] }\n";
    let stage = FALL.replace("0.3 s", "1 s");
    // stiff enough that a fall from the region makes no contact deep
    let stiff = MATERIAL.replace("2 MPa", "10 MPa");
    let report = run(&format!("{HEAD}{stiff}{grains}{EFFECTS}{BOX}{stage}"));
    let summary = &only(&report).summary;
    assert_eq!((summary.grains, summary.lost_grains), (120, 0));
    assert!(summary.time_s < 0.9, "it never came to rest");
    assert!(summary.energy_closure < 0.01, "{}", summary.energy_closure);
    assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
}

#[test]
fn a_stream_brings_its_rate_of_mass() {
    // 10.5 mg a grain: 0.524 g/s are 50 grains a second
    let grains = "[grains]\ncount = 1000\nradius = \"1 mm\"\ninsertion = \"stream\"\nrate = \"0.524 g/s\"\nregion = { base = [\"5 mm\", \"5 mm\", \"30 mm\"], radius = \"4 mm\", height = \"8 mm\" }\n";
    let stage = "[[stage]]\nkind = \"run\"\nduration = \"0.4 s\"\n";
    let report = run(&format!("{HEAD}{MATERIAL}{grains}{EFFECTS}{BOX}{stage}"));
    let summary = &only(&report).summary;
    assert!((19..=21).contains(&summary.grains), "{}", summary.grains);
    assert!(summary.energy_closure < 0.01, "{}", summary.energy_closure);
    assert!(
        summary
            .warnings
            .iter()
            .any(|w| w.contains("not all grains"))
    );
}

#[test]
fn grains_of_a_mass_and_of_sieve_classes_add_up() {
    let grains = "[grains]\nmass = \"1 g\"\nsieve = [{ radius = \"0.8 mm\", share = 0.4 }, { radius = \"1 mm\", share = 0.6 }]\n";
    let scene = parse(&format!("{HEAD}{MATERIAL}{grains}{BOX}{FALL}")).unwrap();
    let (grains, _, _) = insert(&scene, 1).unwrap();
    let mass: f64 = grains.motions.iter().map(|m| 1.0 / m.inverse_mass).sum();
    assert!((1e-3..1.011e-3).contains(&mass), "{mass}");
    assert!(
        grains
            .spheres
            .iter()
            .all(|s| s.radius == 0.8e-3 || s.radius == 1e-3)
    );
}

#[test]
fn no_grain_leaves_a_closed_box_at_fifty_metres_a_second() {
    let grains = "[grains]\ncount = 60\nradius = \"1 mm\"\nstir = \"30 m/s\"\n";
    let lid = "[[body]]\nname = \"lid\"\nblock = { size = [\"20 mm\", \"20 mm\", \"4 mm\"] }\nat = [\"5 mm\", \"5 mm\", \"42 mm\"]\n";
    let stage = "[[stage]]\nkind = \"run\"\nduration = \"8 ms\"\n";
    let stiff = MATERIAL.replace("2 MPa", "20 GPa");
    // impacts as hard as these need their steps: closure falls with the square of the step
    let clock = "[time]\nsteps_per_contact = 40.0\n";
    let report = run(&format!("{HEAD}{stiff}{grains}{BOX}{lid}{clock}{stage}"));
    let run = only(&report);
    assert!(run.rows.iter().any(|row| row.max_speed_m_s > 50.0));
    assert_eq!(run.summary.lost_grains, 0);
    assert!(
        run.summary.energy_closure < 0.01,
        "{}",
        run.summary.energy_closure
    );
    let inside = |z: f64| (0.0..=40e-3).contains(&z);
    assert!(run.grains.spheres.iter().all(|s| inside(s.centre.z)));
}

#[test]
fn a_grain_that_leaves_is_counted_reported_and_still_listed() {
    let text = boxed(
        "[[stage]]\nkind = \"run\"\nduration = \"60 ms\"\nmove = [{ body = \"right\", remove = true }]\n",
    );
    let folder = tempfile::tempdir().unwrap();
    let report = run_in(folder.path(), &text).unwrap();
    let run = only(&report);
    assert!(run.summary.lost_grains > 5, "{}", run.summary.lost_grains);
    assert_eq!(run.grains.len(), 60);
    assert!(run.summary.warnings[0].contains("outside the room"));
    let grains =
        std::fs::read_to_string(folder.path().join("bed/hertz/vtp/grains_0003.vtp")).unwrap();
    assert!(
        grains.contains("NumberOfPoints=\"60\""),
        "{}",
        &grains[..300]
    );
}

#[test]
fn a_free_ball_that_is_held_waits_for_its_release() {
    let ball = "[[body]]\nname = \"ball\"\nball = { radius = \"2 mm\" }\nat = [\"5 mm\", \"5 mm\", \"36 mm\"]\nfree = { density = \"7800 kg/m3\", held = true }\n";
    let release = "[[stage]]\nkind = \"run\"\nname = \"plunge\"\nduration = \"0.15 s\"\nmove = [{ body = \"ball\", release = true }]\n[[measure]]\nkind = \"plunge\"\nbody = \"ball\"\n";
    let report = run(&boxed(&format!("{ball}{FALL}{release}")));
    let summary = &only(&report).summary;
    let found = |name: &str| {
        summary
            .findings
            .iter()
            .find(|f| f.name == name)
            .unwrap()
            .value
    };
    // it falls from 34 mm to the bed, whose height is between 3 and 8 mm
    let speed = found("speed at first touch");
    let fallen = speed * speed / (2.0 * 9.81);
    assert!((25e-3..32e-3).contains(&fallen), "{fallen}");
    assert!(found("depth") > 0.2e-3 && found("peak deceleration") > 50.0);
    assert!(summary.energy_closure < 0.01, "{}", summary.energy_closure);
}

/// Lid over grains, with what holds and drives it: vertical stress between the grains at the end (Pa), and closure.
fn under_a_lid(how: &str) -> (f64, f64) {
    let lid = format!(
        "[[body]]\nname = \"lid\"\nblock = {{ size = [\"9.8 mm\", \"9.8 mm\", \"2 mm\"] }}\nat = [\"5 mm\", \"5 mm\", \"39 mm\"]\n{how}\n"
    );
    let stage =
        "[[stage]]\nkind = \"run\"\nduration = \"0.5 s\"\n[output]\nrows = 50\nframes = 0\n";
    // the lid comes down at 5 m/s: grains as soft as elsewhere would be flattened by a quarter of their radius
    let stiff = boxed(&format!("{lid}{stage}")).replace("2 MPa", "20 MPa");
    let report = run(&stiff);
    let run = only(&report);
    let stress = run.rows.last().map_or(0.0, |row| row.virial_stress_pa);
    (stress, run.summary.energy_closure)
}

#[test]
fn a_dead_load_a_servo_and_a_motor_press_the_bed_with_their_force() {
    let dead = "free = { mass = \"100 mg\", force = [\"0 N\", \"0 N\", \"-50 mN\"], joint = { kind = \"prismatic\", axis = [0.0, 0.0, 1.0] } }";
    let motor = "free = { mass = \"100 mg\", joint = { kind = \"prismatic\", axis = [0.0, 0.0, -1.0], motor = { velocity = \"0.2 m/s\", max_force = \"50 mN\" } } }";
    let servo = "driven = { servo = { direction = [0.0, 0.0, -1.0], force = \"50 mN\", speed = \"0.2 m/s\" } }";
    let weight = under_a_lid("").0;
    let [dead, motor, servo] = [dead, motor, servo].map(under_a_lid);
    for (stress, closure) in [dead, motor, servo] {
        assert!(closure < 0.01, "{stress}: {closure}");
    }
    let stresses = [dead.0, motor.0, servo.0];
    // 50 mN on 1 cm2 are 500 Pa on top of the grains' own weight; wall contacts are not in the mean
    for stress in stresses {
        assert!(
            stress > 3.0 * weight && stress < 600.0,
            "{stresses:?} over {weight}"
        );
    }
    let [most, least] =
        [f64::max, f64::min].map(|pick| stresses.into_iter().fold(stresses[0], pick));
    assert!(most < 1.25 * least, "{stresses:?}");
}

#[test]
fn a_revolute_joint_lets_a_flap_hang_and_a_shaken_floor_closes_its_energy() {
    let flap = "[[body]]\nname = \"flap\"\nblock = { size = [\"1 mm\", \"9 mm\", \"6 mm\"] }\nat = [\"5 mm\", \"5 mm\", \"34 mm\"]\nturn = { axis = [0.0, 1.0, 0.0], angle = \"20 deg\" }\nfree = { mass = \"0.1 g\", joint = { kind = \"revolute\", axis = [0.0, 1.0, 0.0], point = [\"5 mm\", \"5 mm\", \"37 mm\"] } }\n";
    let shaken = "[[body]]\nname = \"plate\"\nblock = { size = [\"9.9 mm\", \"9.9 mm\", \"1 mm\"] }\nat = [\"5 mm\", \"5 mm\", \"-0.6 mm\"]\ndriven = { oscillation = { direction = [0.0, 0.0, 1.0], amplitude = \"1 mm\", frequency = \"25 Hz\" } }\n";
    let report = run(&boxed(&format!(
        "{flap}{shaken}[[stage]]\nkind = \"run\"\nduration = \"0.3 s\"\n[output]\nrows = 60\nframes = 0\n"
    )));
    let summary = &only(&report).summary;
    assert!(summary.energy_closure < 0.01, "{}", summary.energy_closure);
    let driven = only(&report)
        .rows
        .iter()
        .map(|row| row.driven_work_j)
        .fold(0.0, f64::max);
    assert!(driven > 1e-6, "the plate did no work: {driven}");
}

#[test]
fn two_materials_settle_together_each_under_its_own_law() {
    let materials = "[materials.glass]\ndensity = \"2500 kg/m3\"\nyoung_modulus = \"2 MPa\"\npoisson_ratio = 0.3\nlaw = \"hertz\"\n[materials.lead]\ndensity = \"11300 kg/m3\"\nyoung_modulus = \"1 MPa\"\npoisson_ratio = 0.4\nyield_strength = \"20 kPa\"\nlaw = \"thornton\"\n[[pair]]\nbetween = [\"glass\", \"lead\"]\nfriction = 0.1\n";
    let grains = "[[grains]]\nname = \"light\"\ncount = 30\nradius = \"1 mm\"\nmaterial = \"glass\"\nregion = { low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"10 mm\", \"10 mm\", \"10 mm\"] }\n[[grains]]\nname = \"heavy\"\ncount = 20\nradius = \"0.8 mm\"\nmaterial = \"lead\"\nregion = { low = [\"0 mm\", \"0 mm\", \"20 mm\"], high = [\"10 mm\", \"10 mm\", \"30 mm\"] }\n";
    let report = run(&format!("{HEAD}{materials}{grains}{EFFECTS}{BOX}{FALL}"));
    let run = only(&report);
    assert_eq!(run.law, "own");
    assert_eq!((run.summary.grains, run.summary.lost_grains), (50, 0));
    assert!(
        run.summary.energy_closure < 0.01,
        "{}",
        run.summary.energy_closure
    );
    assert!(
        run.summary.plastic_share > 0.05,
        "the lead must flow: {}",
        run.summary.plastic_share
    );
}

#[test]
fn through_periodic_sides_grains_drift_on_and_none_is_lost() {
    let grains = "[grains]\ncount = 60\nradius = \"1 mm\"\nvelocity = [\"0.3 m/s\", \"0.2 m/s\", \"0 m/s\"]\n";
    let sides = "periodic = [\"x\", \"y\"]\n";
    let stage = "[[stage]]\nkind = \"run\"\nduration = \"0.1 s\"\n";
    let report = run(&format!("{HEAD}{sides}{MATERIAL}{grains}{BOX}{stage}"));
    let run = only(&report);
    assert_eq!(run.summary.lost_grains, 0);
    assert!(
        run.summary.energy_closure < 0.01,
        "{}",
        run.summary.energy_closure
    );
    // smooth grains on a smooth floor keep what they bring
    let motions = &run.grains.motions;
    let mean = motions.iter().map(|m| m.velocity.x).sum::<f64>() / motions.len() as f64;
    assert!((mean - 0.3).abs() < 1e-9, "{mean}");
}

#[test]
fn a_run_ends_with_its_condition() {
    let shove = "[[stage]]\nkind = \"run\"\nname = \"press\"\nsteps = 100000\nmove = [{ body = \"piston\", driven = { velocity = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"] } }]\nuntil = { stress = \"2 kPa\" }\n";
    let report = run(&boxed(&format!("{FALL}{shove}")));
    let last = only(&report).rows.last().unwrap();
    assert_eq!(last.stage, "press");
    assert!((2e3..4e3).contains(&last.stress_pa), "{}", last.stress_pa);
}

#[test]
fn the_drum_of_the_cases_is_a_cylinder_with_six_lifters() {
    let bytes = std::fs::read(cases().join("drum.stl")).unwrap();
    let Solid::Mesh {
        vertices,
        triangles,
    } = read(&bytes, Format::Stl, 1e-3, 1e-6).unwrap().solid
    else {
        panic!()
    };
    assert_eq!(triangles.len(), 36 * 2 + 2 * 36 + 6 * 2);
    let (radius, half, lifter) = (40e-3, 16e-3, 6e-3);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-8;
    let mut inner = 0;
    for v in &vertices {
        assert!(near(v.y.abs(), half), "{v}");
        let reach = v.x.hypot(v.z);
        let sector = (v.z.atan2(v.x) / TAU * 12.0).rem_euclid(2.0);
        if near(reach, radius - lifter) {
            assert!(
                (sector - 1.0).abs() < 1e-6,
                "lifters stand at odd twelfths: {sector}"
            );
            inner += 1;
        } else {
            assert!(near(reach, radius) || near(reach, 0.0), "{v}");
        }
    }
    assert_eq!(inner, 12);
}
