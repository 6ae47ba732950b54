//! Restitution by damping, and where the energy of a contact goes.

use crate::collisions::{MATERIAL, RADIUS, bed, collide, empty, smooth, thrown};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::elastoplastic::{Elastoplastic, YieldUnits};
use impactlaw::contact::loading::SoftenedHertz;
use impactlaw::contact::pair::{Alike, Flat, Twins};
use impactlaw::contact::unloading::Unloading;
use impactlaw::dem::dynamics::Bed;
use impactlaw::dem::force::damping::Viscous;
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

fn assert_had(name: &str, law: &impl NormalLaw) {
    for speed in [0.01, 10.0] {
        for asked in ASKED {
            let had = bounced(law.clone(), asked, speed, 400.0);
            println!("{name} at {speed} m/s: asked {asked}, had {had:.5}");
            assert!((had / asked - 1.0).abs() < 0.01, "{name}: {asked}: {had}");
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
    assert_had("hertz", &Hertz::of(&MATERIAL));
    let closed = SoftenedHertz::new(1.0, 3.0, 0.8).unwrap();
    let closed = Elastoplastic::new(closed, unloading(), hertz_to(0.05), 0.5).unwrap();
    assert_had("closed form", &closed);
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let model = LawFile::read(&model).unwrap().law_in(Form::Spline).unwrap();
    let FittedLaw::Spline(model) = model else {
        unreachable!("it was asked for");
    };
    let (loading, unloading) = (model.loading().clone(), *model.unloading());
    let spline = Elastoplastic::new(loading, unloading, hertz_to(0.2), 0.5).unwrap();
    assert_had("spline", &spline);
}

#[test]
fn the_restitution_asked_for_is_had_under_a_linear_spring() {
    assert_had("spring", &WaltonBraun::new(1e10, 1e10, 0.0));
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
