//! Many grains: the same bits for any number of threads, and whole scenes.

use crate::scene_run::{quiet, run};
use impactlaw::bed::filling::insert;
use impactlaw::bed::run::{BedReport, Options, run_scene};
use impactlaw::bed::scene::{Amount, Scene};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::force::slider::Slider;
use impactlaw::material::{Material, YIELD_PRESSURE_RATIO};
use impactlaw::theory::thornton::Thornton;
use parry3d::math::Vector;
use std::path::Path;

/// Soft grains, so that a test needs few steps.
const SCENE: &str = r#"
laws = ["hertz", "thornton"]
seed = 7
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
yield_strength = "100 kPa"
[grains]
count = 150
radius = "1 mm"
stir = "0.2 m/s"
[contact]
friction = 0.4
restitution = 0.7
[box]
width = "10 mm"
depth = "12 mm"
[[stage]]
kind = "settle"
stiffness = 0.1
friction = 0.1
longest = "200 ms"
rest_speed = "5 mm/s"
[[stage]]
kind = "relax"
steps = 500
[[stage]]
kind = "compress"
speed = "0.2 m/s"
seating_stress = "500 Pa"
strain = 0.04
[[stage]]
kind = "unload"
speed = "0.2 m/s"
[output]
rows = 30
frames = 1
"#;

fn scene(from: &str, to: &str) -> Result<Scene, impactlaw::Error> {
    assert!(SCENE.contains(from), "{from}");
    Scene::parse(&SCENE.replace(from, to), Path::new("small.toml"))
}

fn normals<L: NormalLaw>(law: &L) -> Normals {
    Normals {
        pair: Box::new(Model(Twins(law.clone()))),
        wall: Box::new(Model(Flat(law.clone()))),
    }
}

type Frictional = Law<((((), Viscous), Mindlin), RollingSpring)>;

fn frictional(material: &Material) -> Frictional {
    Law::smooth()
        .with(Viscous::new(0.7))
        .with(Mindlin::new(material, 0.4))
        .with(RollingSpring::new(material, 0.05))
}

/// The scene's grains falling into its box under a law that yields, after `steps`.
fn fallen(steps: usize, count: usize) -> Bed<Frictional> {
    let mut scene = scene("seed = 7", "seed = 8").unwrap();
    scene.groups[0].amount = Amount::Count(count);
    let (grains, _, room) = insert(&scene, 1).unwrap();
    let gravity = Vector::new(0.0, 0.0, -9.81);
    let parts = Parts {
        grains,
        machine: Machine::new(room.bodies(), gravity, scene.radius()).unwrap(),
        gravity,
        dt: 1e-5,
        skin: 0.2 * scene.radius(),
    };
    let law = Thornton::of(scene.material(), YIELD_PRESSURE_RATIO).unwrap();
    let mut bed = Bed::new(frictional(scene.material()), normals(&law), parts);
    bed.machine.drive(5, Vector::new(0.0, 0.0, -0.5));
    for _ in 0..steps {
        bed.step().unwrap();
    }
    bed
}

#[test]
fn one_and_two_threads_give_the_same_bits() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| fallen(4000, 1600))
    };
    let (one, two) = (run(1), run(2));
    assert!(
        one.contacts.list.pairs.len() > 1024,
        "too few pairs to need several tasks"
    );
    assert!(
        one.contacts
            .memory
            .iter()
            .any(|memory| memory.effects.0.1 != Slider::default())
    );
    assert_eq!(one.grains, two.grains);
    assert!(one.contacts.same(&two.contacts) && one.surfaces.same(&two.surfaces));
    assert_eq!(one.machine.state(), two.machine.state());
    assert_eq!(one.losses(), two.losses());
}

#[test]
fn a_scene_closes_its_energy_keeps_its_grains_and_tells_laws_apart() {
    let (report, folder) = run(&scene("seed = 7", "seed = 7").unwrap());
    for summary in report
        .laws
        .iter()
        .map(|run| &run.summary)
        .chain(report.packing.iter().map(|packing| &packing.summary))
    {
        assert!(
            summary.energy_closure < 0.01,
            "{}: {}",
            summary.law,
            summary.energy_closure
        );
        assert_eq!(summary.lost_grains, 0, "{}", summary.law);
        assert_eq!(summary.status, "ok");
    }
    let [hertz, thornton] = &report.laws[..] else {
        panic!("two laws")
    };
    assert!(
        hertz.summary.plastic_share.abs() < 1e-3,
        "{}",
        hertz.summary.plastic_share
    );
    assert!(
        thornton.summary.plastic_share > 0.1,
        "{}",
        thornton.summary.plastic_share
    );
    assert!(thornton.summary.max_stress_pa < hertz.summary.max_stress_pa);
    assert!(thornton.summary.residual_strain > hertz.summary.residual_strain);
    for run in &report.laws {
        let dissipated = |at: usize| run.rows[at].dissipated();
        assert!(
            dissipated(run.rows.len() - 1) > dissipated(0),
            "{}",
            run.law
        );
    }
    for file in [
        "bed.png",
        "oedometer.csv",
        "hertz/bed.csv",
        "thornton/summary.json",
        "hertz/vtp/contacts.pvd",
    ] {
        assert!(folder.path().join("bed").join(file).is_file(), "{file}");
    }
}

#[test]
fn a_scene_gives_the_same_rows_twice() {
    let scene = scene("count = 150", "count = 60").unwrap();
    let (one, two) = (run(&scene).0, run(&scene).0);
    let packing = |report: &BedReport| report.packing.as_ref().map(|packing| packing.rows.clone());
    assert!(packing(&one).is_some_and(|rows| !rows.is_empty()));
    assert_eq!(packing(&one), packing(&two));
    assert!(
        one.laws
            .iter()
            .zip(&two.laws)
            .all(|(a, b)| a.rows == b.rows)
    );
}

#[test]
fn polydisperse_grains_close_their_energy_too() {
    let scene = scene("radius = \"1 mm\"", "radius = \"1 mm\"\nspread = 0.2").unwrap();
    let (report, _folder) = run(&scene);
    for run in &report.laws {
        assert!(
            run.summary.energy_closure < 0.01,
            "{}: {}",
            run.law,
            run.summary.energy_closure
        );
    }
}

#[test]
fn bad_scenes_are_refused_with_place_and_remedy() {
    let refused = |from: &str, to: &str, says: &[&str]| {
        let text = scene(from, to).unwrap_err().to_string();
        assert!(says.iter().all(|say| text.contains(say)), "{text}");
    };
    refused("seed = 7", "sed = 7", &["sed", "unknown field"]);
    refused(
        "\"thornton\"",
        "\"thornten\"",
        &["laws[1]", "thornten", "one of"],
    );
    refused("\"thornton\"", "\"hertz\"", &["laws[1]", "once"]);
    refused(
        "\"2500 kg/m3\"",
        "\"0 kg/m3\"",
        &["material.density", "positive"],
    );
    refused("\"2500 kg/m3\"", "\"2500\"", &["material.density", "2500"]);
    refused(
        "width = \"10 mm\"",
        "width = \"3 mm\"",
        &["box.width", "overlap"],
    );
    refused("count = 150", "count = 0", &["grains.count", "at least 1"]);
    refused(
        "restitution = 0.7",
        "restitution = 1.4",
        &["contact.restitution", "(0, 1]"],
    );
    refused(
        "friction = 0.4",
        "rolling = 0.1",
        &["contact.rolling", "friction"],
    );
    refused(
        "[output]",
        "[time]\nrayleigh_fraction = 0.9\n[output]",
        &["time.rayleigh_fraction", "0.5"],
    );
    refused(
        "kind = \"relax\"\nsteps = 500",
        "kind = \"unload\"\nspeed = \"1 m/s\"",
        &["stage[1].kind", "order"],
    );
    refused("strain = 0.04", "strain = 4.0", &["stage[2].strain", "0.2"]);
    refused(
        "yield_strength = \"100 kPa\"",
        "",
        &["laws[1]", "yield_strength"],
    );
}

#[test]
fn a_fitted_law_without_a_law_file_is_refused_before_the_first_step() {
    let scene = scene("\"hertz\"", "\"fitted\"").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let options = Options {
        progress: &|_, _| panic!("a step was made"),
        ..quiet(folder.path())
    };
    let text = run_scene(&scene, None, &options).err().unwrap().to_string();
    assert!(text.contains("--law") && text.contains("fitted"), "{text}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
