//! Restitution by damping, and where the energy of a contact goes.

use crate::collisions::{MATERIAL, RADIUS, bed, collide, empty, floor, smooth, thrown};
use crate::scene_run::run;
use impactlaw::bed::scene::Scene;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::elastoplastic::{Elastoplastic, YieldUnits};
use impactlaw::contact::loading::SoftenedHertz;
use impactlaw::contact::pair::{Alike, Flat, Twins};
use impactlaw::contact::rebound::rebound;
use impactlaw::contact::unloading::Unloading;
use impactlaw::dem::bodies::Mobility;
use impactlaw::dem::dynamics::Bed;
use impactlaw::dem::force::damping::{Viscous, steps_for};
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::grains::Grains;
use impactlaw::law::{FittedLaw, Form, LawFile};
use impactlaw::material::YIELD_PRESSURE_RATIO;
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::thornton::Thornton;
use impactlaw::theory::walton_braun::WaltonBraun;
use parry3d::math::Vector;
use std::path::Path;

const ASKED: [f64; 8] = [0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 0.95, 0.99];

/// Restitution of a grain dropped at `speed` (m/s) on a floor in `steps` a contact time of the law alone.
fn bounced(law: impl NormalLaw, asked: f64, speed: f64, steps: f64) -> f64 {
    let effects = Law::smooth().with(Viscous::new(asked));
    let velocity = Vector::new(0.0, 0.0, -speed);
    thrown(effects, law, &MATERIAL, velocity, steps)[0].z / speed
}

/// The same at the steps a scene takes for it, at its worst over where within a step the grain touches, relative.
fn worst_at_the_usual_steps(law: &impl NormalLaw, asked: f64, speed: f64, power: f64) -> f64 {
    let mass = MATERIAL.sphere_mass(RADIUS);
    let steps = steps_for(asked, power);
    let dt = rebound(law, RADIUS, mass, speed).contact_time / steps;
    let off = |part: u32| {
        let mut grains = Grains::default();
        let gap = speed * dt * f64::from(part) / 16.0;
        let place = Vector::new(0.0, 0.0, RADIUS + gap);
        grains.add(place, RADIUS, MATERIAL.density);
        grains.motions[0].velocity = Vector::new(0.0, 0.0, -speed);
        let effects = Law::smooth().with(Viscous::new(asked));
        let (pair, wall) = (Twins(law.clone()), Flat(law.clone()));
        let mut bed = bed(effects, pair, wall, grains, floor(Mobility::Fixed), dt);
        collide(&mut bed);
        bed.grains.motions[0].velocity.z / speed / asked - 1.0
    };
    (1..=16).map(off).fold(0.0, |worst, off| {
        if off.abs() > f64::abs(worst) {
            off
        } else {
            worst
        }
    })
}

fn assert_had(name: &str, law: &impl NormalLaw, power: f64) {
    for speed in [0.01, 10.0] {
        for asked in ASKED {
            let had = bounced(law.clone(), asked, speed, 400.0);
            println!("{name} at {speed} m/s: asked {asked}, had {had:.5}");
            assert!((had / asked - 1.0).abs() < 0.01, "{name}: {asked}: {had}");
            let off = worst_at_the_usual_steps(law, asked, speed, power);
            println!("    at the usual steps {off:+.5}");
            assert!(off.abs() < 0.01, "{name}: {asked}: {off}");
        }
    }
}

/// Yield units of a law that is Hertz's up to the flattening `x`.
fn hertz_to(x: f64) -> YieldUnits {
    YieldUnits {
        flattening: x,
        force: 4.0 / 3.0 * MATERIAL.contact_modulus() * x.powf(1.5),
    }
}

fn unloading() -> Unloading {
    Unloading::new(10.0, 0.5, 0.5, 0.0).unwrap()
}

#[test]
fn the_restitution_asked_for_is_had_at_any_speed_under_hertz_and_both_fitted_forms() {
    assert_had("hertz", &Hertz::of(&MATERIAL), 1.5);
    let closed = SoftenedHertz::new(1.0, 3.0, 0.8).unwrap();
    let closed = Elastoplastic::new(closed, unloading(), hertz_to(0.05), 0.5).unwrap();
    assert_had("closed form", &closed, 1.5);
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let model = LawFile::read(&model).unwrap().law_in(Form::Spline).unwrap();
    let FittedLaw::Spline(model) = model else {
        unreachable!("it was asked for");
    };
    let (loading, unloading) = (model.loading().clone(), *model.unloading());
    let spline = Elastoplastic::new(loading, unloading, hertz_to(0.2), 0.5).unwrap();
    assert_had("spline", &spline, 1.5);
}

#[test]
fn the_restitution_asked_for_is_had_under_a_linear_spring() {
    assert_had("spring", &WaltonBraun::new(1e10, 1e10, 0.0), 1.0);
}

#[test]
fn fifty_steps_a_contact_are_enough_for_it_wherever_in_a_step_they_touch() {
    for asked in ASKED {
        for speed in [0.01, 0.3, 10.0] {
            for steps in [50.0, 51.3, 53.7, 59.1] {
                let had = bounced(Hertz::of(&MATERIAL), asked, speed, steps);
                println!("asked {asked} at {speed} m/s, {steps} steps: had {had:.5}");
                assert!((had / asked - 1.0).abs() < 0.01, "{asked}: {had}");
            }
        }
    }
}

#[test]
fn a_law_that_yields_keeps_its_own_restitution_times_that_asked_for() {
    let law = WaltonBraun::new(1e9, 4e9, 0.0);
    for asked in ASKED {
        let had = bounced(law, asked, 1.0, 400.0);
        // both branches are straight, so that e of the law is the root of 1/4 at any speed
        let due = 0.5 * asked;
        println!("asked {asked}: had {had:.5}, {due} due");
        assert!((had / due - 1.0).abs() < 0.01, "{asked}: {had}, not {due}");
    }
}

#[test]
fn the_restitution_asked_for_is_had_in_a_scene_at_its_own_step() {
    for (speed, e) in [
        ("0.01", 0.05),
        ("0.01", 0.6),
        ("10", 0.05),
        ("10", 0.3),
        ("10", 0.95),
    ] {
        let text = format!(
            r#"seed = 1
gravity = "0 m/s2"
[material]
density = "7274 kg/m3"
young_modulus = "59.82 GPa"
poisson_ratio = 0.33
law = "hertz"
[grains]
count = 1
radius = "0.25 mm"
velocity = ["0 m/s", "0 m/s", "-{speed} m/s"]
region = {{ low = ["0.5 mm", "0.5 mm", "0.1 mm"], high = ["1.1 mm", "1.1 mm", "0.7 mm"] }}
[contact]
restitution = {e}
[box]
width = "1.6 mm"
depth = "1.6 mm"
height = "100 mm"
[[stage]]
kind = "run"
duration = "{} s"
[output]
rows = 5
frames = 0
film = 0
"#,
            1.2e-3 / speed.parse::<f64>().unwrap()
        );
        let scene = Scene::parse(&text, Path::new("thrown.toml")).unwrap();
        let (report, _folder) = run(&scene);
        let had = report.laws[0].grains.motions[0].velocity.z / speed.parse::<f64>().unwrap();
        println!("at {speed} m/s: asked {e}, had {had:.5}");
        assert!((had / e - 1.0).abs() < 0.01, "{speed} {e}: {had}");
        assert!(report.laws[0].summary.energy_closure < 0.01);
    }
}

#[test]
fn a_grain_at_rest_is_pressed_in_as_far_as_its_law_says_whatever_the_damping() {
    let law = Hertz::of(&MATERIAL);
    for asked in [0.05, 0.3, 0.8] {
        let mut grains = Grains::default();
        grains.add(Vector::new(0.0, 0.0, RADIUS), RADIUS, MATERIAL.density);
        let mass = MATERIAL.sphere_mass(RADIUS);
        let dt = rebound(&law, RADIUS, mass, 1.0).contact_time / steps_for(asked, 1.5);
        let effects = Law::smooth().with(Viscous::new(asked));
        let floor = floor(Mobility::Fixed);
        let mut bed = bed(effects, Alike(law), Flat(law), grains, floor, dt);
        bed.gravity = Vector::new(0.0, 0.0, -1e5);
        for _ in 0..20_000 {
            bed.step().unwrap();
        }
        bed.evaluate().unwrap();
        let row = bed.contact_rows()[0];
        let stiffness = 4.0 / 3.0 * MATERIAL.contact_modulus() * RADIUS.sqrt();
        let due = (mass * 1e5 / stiffness).powf(2.0 / 3.0);
        println!("{asked}: {:e} m, {due:e} due", row.overlap);
        assert!(
            (row.overlap / due - 1.0).abs() < 1e-6,
            "{asked}: {}",
            row.overlap
        );
        let speed = bed.grains.motions[0].velocity.length();
        assert!(speed < 1e-6, "{speed}");
    }
}

/// Largest change of the energy in flight, relative, of an undamped grain that bounces a hundred times at `steps` a contact, the
/// step longer by `more` in every other hundred steps of its flight.
fn drift(steps: f64, more: f64) -> f64 {
    let law = Hertz::of(&MATERIAL);
    let mass = MATERIAL.sphere_mass(RADIUS);
    let dt = rebound(&law, RADIUS, mass, 1.0).contact_time / steps;
    let gravity = 2.0 / (200.0 * steps * dt);
    let mut grains = Grains::default();
    grains.add(Vector::new(0.0, 0.0, RADIUS), RADIUS, MATERIAL.density);
    grains.motions[0].velocity = Vector::new(0.0, 0.0, 1.0);
    let mut bed = bed(
        smooth(),
        Alike(law),
        Flat(law),
        grains,
        floor(Mobility::Fixed),
        dt,
    );
    bed.gravity = Vector::new(0.0, 0.0, -gravity);
    bed.evaluate().unwrap();
    let first = bed.energies().balance();
    let mut worst = 0.0f64;
    for step in 0..(20_100.0 * steps) as u32 {
        bed.evaluate().unwrap();
        let energies = bed.energies();
        if energies.elastic == 0.0 {
            let base = -gravity * RADIUS * mass;
            worst = worst.max(((energies.balance() - first) / (first + base)).abs());
            bed.dt = dt * if step / 100 % 2 == 0 { 1.0 } else { 1.0 + more };
        }
        bed.advance().unwrap();
    }
    worst
}

#[test]
fn an_undamped_grain_keeps_its_energy_from_bounce_to_bounce_also_where_the_step_changes() {
    for (steps, more, most) in [(20.0, 0.0, 1e-3), (40.0, 0.0, 5e-5), (40.0, 0.5, 5e-4)] {
        let drift = drift(steps, more);
        println!("{steps} steps, step longer by {more}: {drift:e}");
        assert!(drift < most, "{steps} {more}: {drift:e}");
    }
}

#[test]
fn an_undamped_grain_that_bounces_for_a_second_closes_its_account() {
    for gravity in [9.81, 98.1] {
        let text = format!(
            r#"seed = 1
gravity = "{gravity} m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[grains]
count = 1
radius = "1 mm"
region = {{ low = ["3 mm", "3 mm", "3 mm"], high = ["5.4 mm", "5.4 mm", "5.4 mm"] }}
[box]
width = "8 mm"
depth = "8 mm"
height = "100 mm"
[[stage]]
kind = "run"
duration = "1 s"
[output]
rows = 400
frames = 0
film = 0
"#
        );
        let scene = Scene::parse(&text, Path::new("bounce.toml")).unwrap();
        let (report, _folder) = run(&scene);
        let closure = report.laws[0].summary.energy_closure;
        println!("at {gravity} m/s2: {closure:e}");
        // within a contact the account is off by up to (omega dt)^2/4, 6e-3 in twenty steps, and comes back
        assert!(closure < 8e-3, "{gravity}: {closure:e}");
    }
}

/// Two grains of a pair law thrown at each other, run until they part.
fn collided(law: impl NormalLaw, steps: f64, time: f64) -> Bed<Law> {
    let mut grains = Grains::default();
    for (side, x) in [(1.0, -1.0), (-1.0, 1.0)] {
        grains.add(
            Vector::new(x * RADIUS * (1.0 + 1e-9), 0.0, 0.0),
            RADIUS,
            MATERIAL.density,
        );
        grains.motions.last_mut().unwrap().velocity = Vector::new(side, 0.0, 0.0);
    }
    let pair = Twins(law.clone());
    let mut bed = bed(smooth(), pair, Flat(law), grains, empty(), time / steps);
    collide(&mut bed);
    // once more, so that the contact is over in the account too
    for _ in 0..steps as usize {
        bed.step().unwrap();
    }
    bed.evaluate().unwrap();
    bed
}

#[test]
fn plastic_flow_is_what_a_collision_has_lost_and_the_imbalance_falls_with_the_square_of_the_step() {
    let law = Thornton::of(&MATERIAL, YIELD_PRESSURE_RATIO).unwrap();
    let before = MATERIAL.sphere_mass(RADIUS);
    let off = |steps| {
        let energies = collided(law, steps, 1.5e-6).energies();
        assert!(energies.plastic > 0.2 * before && energies.elastic == 0.0);
        (energies.balance() / before - 1.0).abs()
    };
    let (coarse, fine) = (off(50.0), off(400.0));
    println!("imbalance {coarse:e} in 50 steps, {fine:e} in 400");
    assert!(coarse < 0.01 && fine < 3e-4, "{coarse:e} {fine:e}");
}

#[test]
fn an_elastic_bed_has_dissipated_exactly_nothing_by_plastic_flow() {
    let mut grains = Grains::default();
    for at in 0..27 {
        let place = [at % 3, at / 3 % 3, at / 9].map(|k| f64::from(k) * 2.05 * RADIUS);
        grains.add(Vector::from(place), RADIUS, MATERIAL.density);
        grains.motions.last_mut().unwrap().velocity = -Vector::from(place) * 2e3;
        grains.spins.last_mut().unwrap().rate = Vector::new(1e3, -2e3, 500.0);
    }
    let effects = Law::smooth()
        .with(Viscous::new(0.5))
        .with(Mindlin::new(&MATERIAL, 0.3));
    let law = Hertz::of(&MATERIAL);
    let mut bed = bed(effects, Alike(law), Flat(law), grains, empty(), 1e-8);
    bed.evaluate().unwrap();
    let first = bed.energies();
    for _ in 0..20_000 {
        bed.step().unwrap();
    }
    bed.evaluate().unwrap();
    let last = bed.energies();
    assert!(last.losses.damping > 0.1 * first.kinetic && last.losses.friction > 0.0);
    assert_eq!(last.plastic, 0.0);
    assert!(bed.plastic_by_grain().iter().all(|energy| *energy == 0.0));
    let off = (last.balance() - first.balance()).abs() / first.turnover();
    assert!(off < 1e-3, "{off:e}");
}
