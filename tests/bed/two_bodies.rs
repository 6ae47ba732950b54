//! Two bodies in the bed against closed forms and against the 1-D rebound of the same law.

use crate::collisions::{Bare, MATERIAL, RADIUS, Straight, bed, collide, empty, floor, smooth};
use impactlaw::contact::pair::{Alike, Flat, Press, Twins};
use impactlaw::contact::rebound::rebound;
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::dem::bodies::{Freedom, Mobility};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::grains::Grains;
use impactlaw::law::LawFile;
use impactlaw::law::file::Form;
use impactlaw::material::Material;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;
use std::path::Path;

/// Speed after over speed before of a grain thrown on a fixed block, in `steps` a contact time.
fn wall_restitution(
    law: impl NormalLaw,
    density: f64,
    contact_time: f64,
    speed: f64,
    steps: f64,
) -> f64 {
    let mut grains = Grains::default();
    grains.add(
        Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9)),
        RADIUS,
        density,
    );
    grains.motions[0].velocity = Vector::new(0.0, 0.0, -speed);
    let machine = floor(Mobility::Fixed);
    let mut bed = bed(
        smooth(),
        Twins(law.clone()),
        Flat(law),
        grains,
        machine,
        contact_time / steps,
    );
    collide(&mut bed);
    bed.grains.motions[0].velocity.z / speed
}

/// The same for two grains that fly at each other.
fn pair_restitution<C: ContactLaw>(
    effects: C,
    law: impl Press,
    radii: [f64; 2],
    contact_time: f64,
    speed: f64,
    steps: f64,
) -> f64 {
    let mut grains = Grains::default();
    grains.add(Vector::ZERO, radii[0], MATERIAL.density);
    grains.add(
        Vector::new(0.0, 0.0, (radii[0] + radii[1]) * (1.0 + 1e-9)),
        radii[1],
        MATERIAL.density,
    );
    grains.motions[0].velocity = Vector::new(0.0, 0.0, speed);
    grains.motions[1].velocity = Vector::new(0.0, 0.0, -speed);
    let wall = Flat(Hertz::of(&MATERIAL));
    let mut bed = bed(effects, law, wall, grains, empty(), contact_time / steps);
    collide(&mut bed);
    (bed.grains.motions[1].velocity.z - bed.grains.motions[0].velocity.z) / (2.0 * speed)
}

#[test]
fn an_elastic_grain_rebounds_as_fast_as_it_came() {
    let law = Hertz::of(&MATERIAL);
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), 1.0).contact_time;
    let e = wall_restitution(law, MATERIAL.density, time, 1.0, 2000.0);
    assert!((e - 1.0).abs() < 1e-6, "e = {e}");
}

#[test]
fn a_yielding_grain_rebounds_as_its_law_says() {
    let law = Straight {
        loading: 1e9,
        unloading: 4e9,
    };
    let reference = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), 3.0);
    assert!((reference.restitution - 0.5).abs() < 1e-9);
    let e = wall_restitution(law, MATERIAL.density, reference.contact_time, 3.0, 8000.0);
    assert!(
        (e - reference.restitution).abs() < 1e-6,
        "{e} against {}",
        reference.restitution
    );
}

/// Restitution in the bed and by [`rebound`] of a law at rest, at each of its speeds.
struct AtSpeeds<'a>(&'a [f64], &'a Material);

impl LawVisitor for AtSpeeds<'_> {
    type Output = Vec<[f64; 2]>;

    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
        let mass = self.1.sphere_mass(RADIUS);
        let each = |&speed: &f64| {
            let bare = Bare {
                law: law.clone(),
                contact_radius: None,
            };
            let alone = rebound(&bare, RADIUS, mass, speed);
            let bed = wall_restitution(
                law.clone(),
                self.1.density,
                alone.contact_time,
                speed,
                40_000.0,
            );
            [bed, alone.restitution]
        };
        self.0.iter().map(each).collect()
    }
}

#[test]
fn published_fitted_laws_rebound_in_the_bed_as_they_do_alone() {
    for name in ["sac305-solder", "elastic-perfectly-plastic-ey80"] {
        let file = format!("{}/models/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let file = LawFile::read(Path::new(&file)).unwrap();
        let material = file.material();
        for form in [Form::ClosedForm, Form::Spline] {
            let law = file.law_in(form).unwrap();
            let speeds = [0.5, 5.0, 20.0];
            for ([bed, alone], speed) in law.visit(AtSpeeds(&speeds, &material)).iter().zip(speeds)
            {
                println!("{name}, {form:?}, {speed} m/s: {bed} {alone}");
                assert!(
                    (bed - alone).abs() < 1e-6,
                    "{name}, {form:?}, {speed} m/s: {bed} in the bed, {alone} alone"
                );
            }
        }
    }
}

#[test]
fn restitution_converges_with_the_square_of_the_time_step() {
    let law = Hertz::of(&MATERIAL);
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), 1.0).contact_time;
    let error = |steps| (wall_restitution(law, MATERIAL.density, time, 1.0, steps) - 1.0).abs();
    assert!(error(50.0) < 2e-3, "{}", error(50.0));
    assert!(
        error(400.0) < error(50.0) / 16.0,
        "{} {}",
        error(400.0),
        error(50.0)
    );
}

#[test]
fn two_equal_grains_meet_like_one_on_a_wall() {
    let law = Straight {
        loading: 1e9,
        unloading: 3e9,
    };
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), 2.0).contact_time;
    let wall = wall_restitution(law, MATERIAL.density, time, 2.0, 4000.0);
    let twins = pair_restitution(smooth(), Twins(law), [RADIUS; 2], time, 2.0, 4000.0);
    assert!((wall - twins).abs() < 1e-9, "{wall} {twins}");
}

#[test]
fn grains_of_one_radius_and_of_any_radii_are_pressed_alike_where_radii_agree() {
    let law = Straight {
        loading: 1e9,
        unloading: 3e9,
    };
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), 2.0).contact_time;
    let twins = pair_restitution(smooth(), Twins(law), [RADIUS; 2], time, 2.0, 1000.0);
    let alike = pair_restitution(smooth(), Alike(law), [RADIUS; 2], time, 2.0, 1000.0);
    assert!((alike - twins).abs() < 1e-12, "{alike} {twins}");
}

#[test]
fn unequal_elastic_grains_are_pressed_as_hertz_says() {
    let law = Hertz::of(&MATERIAL);
    let (radii, overlap): ([f64; 2], f64) = ([RADIUS, 3.0 * RADIUS], 1e-7);
    let pressed = Alike(law).press(overlap, radii, &mut ());
    // Johnson 1985, section 4.2: 1/R = 1/R1 + 1/R2 and 1/E* = 2 (1 - nu^2)/E
    let (effective, modulus) = (0.75 * RADIUS, 0.5 * MATERIAL.contact_modulus());
    let force = 4.0 / 3.0 * modulus * effective.sqrt() * overlap.powf(1.5);
    assert!((pressed.force / force - 1.0).abs() < 1e-12);
    assert!((pressed.stiffness * overlap / (1.5 * force) - 1.0).abs() < 1e-12);
    let contact_radius = (effective * overlap).sqrt();
    assert!((pressed.contact_radius / contact_radius - 1.0).abs() < 1e-12);
}

#[test]
fn damping_gives_the_restitution_asked_for() {
    let (effects, law) = (
        Law::smooth().with(Viscous::new(0.8)),
        Twins(Hertz::of(&MATERIAL)),
    );
    let time = rebound(
        &Hertz::of(&MATERIAL),
        RADIUS,
        MATERIAL.sphere_mass(RADIUS),
        1.0,
    )
    .contact_time;
    let slow = pair_restitution(
        effects.clone(),
        law.clone(),
        [RADIUS; 2],
        time * 1.6,
        0.1,
        4000.0,
    );
    let fast = pair_restitution(effects, law, [RADIUS; 2], time, 1.0, 4000.0);
    assert!(
        (fast - slow).abs() < 1e-4,
        "depends on speed: {slow} {fast}"
    );
    assert!((fast - 0.8).abs() < 1e-4, "{fast}");
}

#[test]
fn resting_grains_rest() {
    let soft = Material {
        young_modulus: 5e7,
        ..MATERIAL
    };
    let mut grains = Grains::default();
    let beside = RADIUS / 3f64.sqrt();
    for (x, y, z) in [
        (2.0 * beside, 0.0, RADIUS),
        (-beside, RADIUS, RADIUS),
        (-beside, -RADIUS, RADIUS),
        (0.0, 0.0, RADIUS * (1.0 + (8.0f64 / 3.0).sqrt())),
    ] {
        grains.add(Vector::new(x, y, z), RADIUS, soft.density);
    }
    let law = Hertz::of(&soft);
    let effects = Law::smooth()
        .with(Viscous::new(0.5))
        .with(Mindlin::new(&soft, 0.5))
        .with(RollingSpring::new(&soft, 0.1));
    let machine = floor(Mobility::Fixed);
    let mut bed = bed(effects, Twins(law), Flat(law), grains, machine, 1e-5);
    bed.gravity = Vector::new(0.0, 0.0, -9.81);
    let mut run = |steps| {
        for _ in 0..steps {
            bed.step().unwrap();
        }
        bed.grains.spheres.clone()
    };
    let settled = run(30_000);
    let later = run(100_000);
    for (a, b) in settled.iter().zip(&later) {
        let drift = (a.centre - b.centre).length();
        assert!(drift < 1e-9 * RADIUS, "{} R in 1 s", drift / RADIUS);
    }
}

#[test]
fn a_free_body_takes_the_momentum_the_grain_loses() {
    let mass = 5.0 * MATERIAL.sphere_mass(RADIUS);
    let machine = floor(Mobility::Free(Freedom::of_mass(mass)));
    let effects = Law::smooth().with(Mindlin::new(&MATERIAL, 0.4));
    let law = Hertz::of(&MATERIAL);
    let mut grains = Grains::default();
    grains.add(
        Vector::new(3.0 * RADIUS, 0.0, RADIUS * (1.0 + 1e-9)),
        RADIUS,
        MATERIAL.density,
    );
    grains.motions[0].velocity = Vector::new(0.3, 0.2, -1.0);
    let m = MATERIAL.sphere_mass(RADIUS);
    let time = rebound(&law, RADIUS, m, 1.0).contact_time;
    let mut bed = bed(
        effects,
        Twins(law),
        Flat(law),
        grains,
        machine,
        time / 500.0,
    );
    let before = m * bed.grains.motions[0].velocity;
    let spin_before =
        bed.machine.angular_momentum(Vector::ZERO) + bed.grains.spheres[0].centre.cross(before);
    collide(&mut bed);
    let grain = m * bed.grains.motions[0].velocity;
    let body = mass * bed.machine.stations[0].velocity;
    assert!(body.length() > 0.1 * before.length());
    assert!(
        (grain + body - before).length() < 1e-12 * before.length(),
        "{}",
        (grain + body - before).length()
    );
    let turning = bed.grains.spins[0].rate / bed.grains.spins[0].inverse_inertia;
    let spin_after = bed.machine.angular_momentum(Vector::ZERO)
        + bed.grains.spheres[0].centre.cross(grain)
        + turning;
    let scale = before.length() * 3.0 * RADIUS;
    assert!(
        (spin_after - spin_before).length() < 1e-12 * scale,
        "{}",
        (spin_after - spin_before).length() / scale
    );
}
