//! Two bodies in the bed against closed forms and against the 1-D rebound of the same law.

use impactlaw::bed::bodies::{Body, Freedom, Mobility, Solid};
use impactlaw::bed::damping::Viscous;
use impactlaw::bed::friction::{Mindlin, RollingSpring};
use impactlaw::bed::grains::Grains;
use impactlaw::bed::law::{ContactLaw, Law};
use impactlaw::bed::machine::Machine;
use impactlaw::bed::normals::{Model, NormalModel};
use impactlaw::bed::step::{Bed, Normals, Parts};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Alike, Flat, Press, Twins};
use impactlaw::contact::rebound::rebound;
use impactlaw::material::{Flow, Material};
use impactlaw::theory::hertz::Hertz;
use parry3d::math::{Rotation, Vector};
use std::f64::consts::PI;

const RADIUS: f64 = 250e-6;
const MATERIAL: Material = Material {
    density: 7274.0,
    young_modulus: 59.82e9,
    poisson_ratio: 0.33,
    flow: Some(Flow {
        yield_strength: 97.59e6,
        hardening_modulus: 0.0,
    }),
};

/// Loads along Hertz, unloads along a stiffer straight line: a law with a closed form for everything.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Straight {
    loading: f64,
    unloading: f64,
}

impl NormalLaw for Straight {
    type History = f64;

    fn force(&self, x: f64, deepest: &mut f64) -> f64 {
        *deepest = deepest.max(x);
        let peak = self.loading * *deepest;
        (peak - self.unloading * (*deepest - x)).max(0.0)
    }

    fn stiffness(&self, x: f64, deepest: &f64) -> f64 {
        if x < *deepest {
            self.unloading
        } else {
            self.loading
        }
    }

    fn elastic_energy(&self, x: f64, deepest: &f64) -> f64 {
        let force = (self.loading * deepest - self.unloading * (deepest - x)).max(0.0);
        0.5 * force * force / self.unloading
    }

    fn contact_radius(&self, _: f64, _: &f64) -> Option<f64> {
        None
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// Contact radius over R of a [`Constant`] law.
const CONSTANT_RADIUS: f64 = 0.002;

/// A law whose contacts have one radius.
#[derive(Debug, Clone)]
struct Constant<L>(L);

impl<L: NormalLaw> NormalLaw for Constant<L> {
    type History = L::History;

    fn force(&self, x: f64, history: &mut L::History) -> f64 {
        self.0.force(x, history)
    }

    fn stiffness(&self, x: f64, history: &L::History) -> f64 {
        self.0.stiffness(x, history)
    }

    fn elastic_energy(&self, x: f64, history: &L::History) -> f64 {
        self.0.elastic_energy(x, history)
    }

    fn contact_radius(&self, _: f64, _: &L::History) -> Option<f64> {
        Some(CONSTANT_RADIUS)
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// Bed of `grains` whose pairs are pressed by `pair` and whose surface contacts by `wall`.
fn bed<C: ContactLaw>(
    effects: C,
    pair: impl Press,
    wall: impl Press,
    grains: Grains,
    machine: Machine,
    dt: f64,
) -> Bed<C> {
    let boxed = |model: Box<dyn NormalModel>| model;
    let normals = Normals {
        pair: boxed(Box::new(Model(pair))),
        wall: boxed(Box::new(Model(wall))),
    };
    let parts = Parts {
        grains,
        machine,
        gravity: Vector::ZERO,
        dt,
        skin: RADIUS,
    };
    Bed::new(effects, normals, parts)
}

fn smooth() -> Law {
    Law::new((), (), ())
}

fn empty() -> Machine {
    Machine::new(Vec::new(), Vector::ZERO, RADIUS).unwrap()
}

/// A block whose top is the plane z = 0.
fn floor(mobility: Mobility) -> Machine {
    let edge = 20.0 * RADIUS;
    let body = Body {
        name: "floor".to_owned(),
        solid: Solid::Cuboid(Vector::splat(edge)),
        centre: Vector::new(0.0, 0.0, -edge),
        rotation: Rotation::IDENTITY,
        mobility,
    };
    Machine::new(vec![body], Vector::ZERO, RADIUS).unwrap()
}

/// Runs until the first grain has been pushed and is free again.
fn collide<C: ContactLaw>(bed: &mut Bed<C>) {
    let touching = |bed: &Bed<C>| {
        bed.contacts
            .pushes
            .iter()
            .any(|push| push.force != Vector::ZERO)
            || bed
                .surfaces
                .all()
                .any(|held| held.patch.push.force != Vector::ZERO)
    };
    let mut touched = false;
    loop {
        bed.evaluate().unwrap();
        let now = touching(bed);
        if touched && !now {
            return;
        }
        touched |= now;
        bed.advance().unwrap();
    }
}

/// Speed after over speed before of a grain thrown on a fixed block, in `steps` a contact time.
fn wall_restitution(law: impl NormalLaw, contact_time: f64, speed: f64, steps: f64) -> f64 {
    let mut grains = Grains::default();
    grains.add(
        Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9)),
        RADIUS,
        MATERIAL.density,
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
    let e = wall_restitution(law, time, 1.0, 2000.0);
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
    let e = wall_restitution(law, reference.contact_time, 3.0, 8000.0);
    assert!(
        (e - reference.restitution).abs() < 1e-6,
        "{e} against {}",
        reference.restitution
    );
}

#[test]
fn restitution_converges_with_the_square_of_the_time_step() {
    let law = Hertz::of(&MATERIAL);
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), 1.0).contact_time;
    let error = |steps| (wall_restitution(law, time, 1.0, steps) - 1.0).abs();
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
    let wall = wall_restitution(law, time, 2.0, 4000.0);
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
        Law::new(Viscous::new(0.8), (), ()),
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
    // leaving out the pull at the end of the contact loses a little less
    assert!(fast > 0.8 && fast < 0.81, "{fast}");
}

/// Grain with a Mindlin law thrown obliquely on the floor; returns velocity and spin afterwards.
fn oblique(friction: f64, velocity: Vector) -> (Vector, Vector) {
    let effects = Law::new((), Mindlin::new(&MATERIAL, friction), ());
    let law = Hertz::of(&MATERIAL);
    let mut grains = Grains::default();
    grains.add(
        Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9)),
        RADIUS,
        MATERIAL.density,
    );
    grains.motions[0].velocity = velocity;
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), velocity.z.abs()).contact_time;
    let mut bed = bed(
        effects,
        Twins(law),
        Flat(law),
        grains,
        floor(Mobility::Fixed),
        time / 4000.0,
    );
    collide(&mut bed);
    (bed.grains.motions[0].velocity, bed.grains.spins[0].rate)
}

#[test]
fn a_grain_that_slides_through_the_impact_leaves_as_coulomb_says() {
    // sliding throughout needs tan(angle) > mu (1 + e) 7/2: dv_t = -mu (1 + e) v_n, R dw = 5/2 dv_t
    // (slow, because the lever arm R - delta is then R to 5 digits)
    let (mu, v_n, v_t) = (0.1, 1e-4, 2e-4);
    let (velocity, spin) = oblique(mu, Vector::new(v_t, 0.0, -v_n));
    let change = mu * 2.0 * v_n;
    assert!(
        (velocity.x - (v_t - change)).abs() < 1e-5 * v_t,
        "{velocity}"
    );
    assert!(
        (spin.y * RADIUS - 2.5 * change).abs() < 1e-5 * v_t,
        "{spin}"
    );
    assert!(velocity.y == 0.0 && spin.x == 0.0);
}

#[test]
fn oblique_rebounds_keep_spin_about_the_contact_lose_energy_and_recoil_at_medium_angles() {
    let v_n = 1e-4;
    let mut recoiled = false;
    for tangent in [0.05, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0] {
        let v_t = tangent * v_n;
        let (velocity, spin) = oblique(0.3, Vector::new(v_t, 0.0, -v_n));
        let about_contact = velocity.x + 0.4 * RADIUS * spin.y;
        assert!(
            (about_contact / v_t - 1.0).abs() < 1e-5,
            "{about_contact} {v_t}"
        );
        let energy = velocity.length_squared() + 0.4 * (RADIUS * spin.y).powi(2);
        assert!(
            energy < (v_n * v_n + v_t * v_t) * (1.0 + 1e-6),
            "tan {tangent}: {energy}"
        );
        recoiled |= velocity.x - RADIUS * spin.y < 0.0;
    }
    assert!(
        recoiled,
        "Maw, Barber and Fawcett: the contact point must swing back at some angle"
    );
}

#[test]
fn a_grain_that_sticks_to_linear_springs_turns_back_as_their_periods_say() {
    // both springs linear: the slip swings as cos(w t), w^2 = 7 k_t / 2 m, while the contact lasts half a period of
    // sqrt(k_n / m), so that e_t = -cos(pi sqrt(7 k_t / 2 k_n)) (Schaefer, Dippel and Wolf 1996, without friction's limit)
    let law = Straight {
        loading: 1e9,
        unloading: 1e9,
    };
    let normal = 1e9 * RADIUS;
    let shear = MATERIAL.young_modulus / (2.0 * (1.0 + MATERIAL.poisson_ratio));
    let constant = Constant(law);
    let tangential = 8.0 * shear / (2.0 - MATERIAL.poisson_ratio) * CONSTANT_RADIUS * RADIUS;
    let effects = Law::new((), Mindlin::new(&MATERIAL, 1e9), ());
    let mut grains = Grains::default();
    let place = Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-12));
    grains.add(place, RADIUS, MATERIAL.density);
    let (v_t, v_n) = (1e-5, 1e-5);
    grains.motions[0].velocity = Vector::new(v_t, 0.0, -v_n);
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), v_n).contact_time;
    let dt = time / 20_000.0;
    let floor = floor(Mobility::Fixed);
    let mut bed = bed(effects, Twins(law), Flat(constant), grains, floor, dt);
    collide(&mut bed);
    let slip = bed.grains.motions[0].velocity.x - RADIUS * bed.grains.spins[0].rate.y;
    let closed_form = (PI * (3.5 * tangential / normal).sqrt()).cos();
    assert!(
        (slip / v_t - closed_form).abs() < 1e-3,
        "{} against {closed_form}",
        slip / v_t
    );
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
    let effects = Law::new(
        Viscous::new(0.5),
        Mindlin::new(&soft, 0.5),
        RollingSpring::new(&soft, 0.1),
    );
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
    let effects = Law::new((), Mindlin::new(&MATERIAL, 0.4), ());
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
