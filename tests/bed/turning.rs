//! Contacts that turn: rolling and slip are seen at one time, and what a contact holds turns with it.

use crate::collisions::{MATERIAL, RADIUS, bed, empty};
use crate::scene_run::run;
use impactlaw::bed::scene::Scene;
use impactlaw::contact::pair::{Alike, Flat};
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::motion::Motion;
use impactlaw::dem::bodies::{Body, Mobility, Solid};
use impactlaw::dem::dynamics::Bed;
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::grains::Grains;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::{Rotation, Vector};
use std::f64::consts::TAU;
use std::path::Path;

/// Height (mm) at which a grain ends that starts beside the neck of two fixed balls of 5 mm, `ratio` times its radius.
fn height_after_the_neck(ratio: f64) -> f64 {
    let (large, small) = (5.0, 5.0 / ratio);
    let neck = f64::sqrt((large + small) * (large + small) - large * large) + 0.5 * small;
    let [y, room] = [0.4 * small, 1.15 * small];
    let scene = format!(
        r#"seed = 1
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "500 MPa"
poisson_ratio = 0.3
law = "hertz"
[grains]
count = 1
radius = "{small} mm"
region = {{ low = ["{} mm", "{} mm", "{} mm"], high = ["{} mm", "{} mm", "{} mm"] }}
[contact]
friction = 0.5
restitution = 0.5
[domain]
low = ["-50 mm", "-50 mm", "-40 mm"]
high = ["50 mm", "50 mm", "60 mm"]
[[body]]
name = "ballA"
ball = {{ radius = "5 mm" }}
at = ["0 mm", "0 mm", "0 mm"]
[[body]]
name = "ballB"
ball = {{ radius = "5 mm" }}
at = ["10 mm", "0 mm", "0 mm"]
[[body]]
name = "ground"
plane = {{ normal = [0.0, 0.0, 1.0] }}
at = ["0 mm", "0 mm", "-10 mm"]
[[stage]]
kind = "run"
duration = "0.3 s"
[output]
rows = 4
frames = 0
film = 0
"#,
        5.0 - room,
        y - room,
        neck - room,
        5.0 + room,
        y + room,
        neck + room
    );
    let scene = Scene::parse(&scene, Path::new("neck.toml")).unwrap();
    let (report, _folder) = run(&scene);
    1e3 * report.laws[0].grains.spheres[0].centre.z
}

#[test]
fn a_grain_of_any_size_rolls_off_the_neck_of_two_balls_and_drops() {
    for ratio in [1.0, 2.0, 5.0, 10.0, 12.5, 20.0, 50.0, 100.0] {
        let height = height_after_the_neck(ratio);
        println!("ratio {ratio}: {height:.3} mm");
        // below the balls, or on the ground
        let small = 5.0 / ratio;
        let dropped = f64::max(-5.0 - 2.0 * small, -10.0 + 1.2 * small);
        assert!(height < dropped, "ratio {ratio}: {height} mm");
    }
}

/// Damping, friction and rolling resistance.
type Sticking = Law<((((), Viscous), Mindlin), RollingSpring)>;

fn sticking() -> Sticking {
    Law::smooth()
        .with(Viscous::new(0.5))
        .with(Mindlin::new(&MATERIAL, 0.5))
        .with(RollingSpring::new(&MATERIAL, 0.2))
}

fn laid(places: &[Vector], machine: Machine, dt: f64) -> Bed<impl ContactLaw> {
    let mut grains = Grains::default();
    for &place in places {
        grains.add(place, RADIUS, MATERIAL.density);
    }
    let law = Hertz::of(&MATERIAL);
    bed(sticking(), Alike(law), Flat(law), grains, machine, dt)
}

/// Moves grains from where they were to where they are `now`, turning by `spin` (rad/s), and brings forces there.
fn carry(bed: &mut Bed<impl ContactLaw>, spin: Vector, from: &[Vector], now: &[Vector]) {
    let dt = bed.dt;
    for (grain, (&from, &now)) in from.iter().zip(now).enumerate() {
        bed.grains.spheres[grain].centre = now;
        bed.grains.motions[grain].velocity = (now - from) / dt;
        bed.grains.spins[grain].rate = spin;
    }
    bed.renew();
    bed.evaluate().unwrap();
}

/// Force over normal force of a contact sheared by `shear` (m) and then turned once by `spin`: of two grains, or of one and a
/// ball that turns.
fn before_and_after_a_turn(spin: Vector, shear: f64, steps: u32, on_ball: bool) -> [Vector; 2] {
    let dt = TAU / spin.length() / f64::from(steps);
    let depth = 1e-3 * RADIUS;
    let touching = Vector::new(2.0 * RADIUS - depth, 0.0, 0.0);
    let (start, machine) = if on_ball {
        let ball = Body {
            name: "ball".to_owned(),
            solid: Solid::Ball(RADIUS),
            centre: Vector::ZERO,
            rotation: Rotation::IDENTITY,
            mobility: Mobility::Driven(Motion::default()),
            material: None,
        };
        let machine = Machine::new(vec![ball], Vector::ZERO, RADIUS).unwrap();
        (vec![touching], machine)
    } else {
        (vec![Vector::ZERO, touching], empty())
    };
    let mut bed = laid(&start, machine, dt);
    bed.evaluate().unwrap();
    let mut sheared = start.clone();
    *sheared.last_mut().unwrap() += Vector::new(0.0, 0.0, shear);
    carry(&mut bed, Vector::ZERO, &start, &sheared);
    // so long that the damping has learned what holds them
    for _ in 0..200 {
        carry(&mut bed, Vector::ZERO, &sheared, &sheared);
    }
    let force = |bed: &Bed<_>| {
        let row = bed.contact_rows()[0];
        row.force / row.normal_force()
    };
    let first = force(&bed);
    if on_ball {
        let motion = Motion {
            spin,
            ..Motion::default()
        };
        bed.machine.drive_as(0, motion);
    }
    let at = |step: u32| {
        let turn = Rotation::from_scaled_axis(spin * (dt * f64::from(step)));
        sheared
            .iter()
            .map(|&place| turn * place)
            .collect::<Vec<_>>()
    };
    for step in 0..steps {
        bed.advance().unwrap();
        carry(&mut bed, spin, &at(step), &at(step + 1));
    }
    [first, force(&bed)]
}

fn assert_turns_as_one(on_ball: bool) {
    // about an axis across the line of centres, and about one that also twists the contact
    for axis in [Vector::Y, Vector::new(1.0, 2.0, -0.5)] {
        for shear in [0.0, 1e-5 * RADIUS] {
            let off = |steps: u32| {
                let [before, after] = before_and_after_a_turn(axis * 1e3, shear, steps, on_ball);
                (after - before).length()
            };
            let (coarse, fine) = (off(4000), off(8000));
            println!("about {axis}, shear {shear:e}: {coarse:e}, {fine:e} in twice the steps");
            // d (Omega dt)^2/12 of slip in each step
            assert!(coarse < 4.4e-3 && fine < 1.1e-3, "{coarse:e} {fine:e}");
        }
    }
    // the shear was felt
    let [before, _] = before_and_after_a_turn(Vector::Y * 1e3, 1e-5 * RADIUS, 4000, on_ball);
    assert!(before.z.abs() > 1e-3, "{before}");
}

#[test]
fn a_pair_that_turns_as_one_gains_no_force_across_it_and_keeps_what_it_had() {
    assert_turns_as_one(false);
}

#[test]
fn a_grain_carried_by_a_body_that_turns_gains_no_force_across_and_keeps_what_it_had() {
    assert_turns_as_one(true);
}
