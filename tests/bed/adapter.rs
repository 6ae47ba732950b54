//! Adapter: the same laws in a plain rapier scene move bodies as the bed moves grains.

use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Alike, Flat};
use impactlaw::dem::adapter::Ruled;
use impactlaw::dem::bodies::Body;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::grains::Grains;
use impactlaw::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::thornton::Thornton;
use parry3d::math::Vector;
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::ColliderBuilder;
use rapier3d::pipeline::PhysicsWorld;
use std::f64::consts::PI;

const RADIUS: f64 = 1e-3;
const EDGE: f64 = 8e-3;
const DT: f64 = 5e-6;
const GRAVITY: Vector = Vector::new(0.0, 0.0, -9.81);

const SOFT: Material = Material {
    density: 2500.0,
    young_modulus: 5e7,
    poisson_ratio: 0.3,
    flow: Some(Flow::perfectly_plastic(1e5)),
};

/// Places, radii and velocities of twenty grains above the floor of a box.
fn twenty() -> Vec<(Vector, f64, Vector)> {
    (0..20u32)
        .map(|k| {
            let place = [k % 3, k / 3 % 3, k / 9].map(|i| f64::from(i) * 2.3e-3 + 1.5e-3);
            let radius = if k % 4 == 0 { 0.8 } else { 1.0 } * RADIUS;
            let turn = f64::from(k);
            let velocity = 0.3 * Vector::new(turn.sin(), turn.cos(), -1.0);
            (Vector::from(place), radius, velocity)
        })
        .collect()
}

fn walls() -> Vec<Body> {
    let (e, t) = (EDGE, 4.0 * RADIUS);
    let block =
        |name: &str, low: [f64; 3], high: [f64; 3]| Body::block(name, low.into(), high.into());
    vec![
        block("floor", [-t, -t, -t], [e + t, e + t, 0.0]),
        block("left", [-t, -t, 0.0], [0.0, e + t, 4.0 * e]),
        block("right", [e, -t, 0.0], [e + t, e + t, 4.0 * e]),
        block("front", [-t, -t, 0.0], [e + t, 0.0, 4.0 * e]),
        block("back", [-t, e, 0.0], [e + t, e + t, 4.0 * e]),
    ]
}

fn bed<L: NormalLaw, C: ContactLaw>(law: &L, effects: C) -> Bed<C> {
    let mut grains = Grains::default();
    for (index, (place, radius, velocity)) in twenty().into_iter().enumerate() {
        grains.add(place, radius, SOFT.density);
        grains.motions[index].velocity = velocity;
    }
    let normals = Normals {
        pair: Box::new(Model(Alike(law.clone()))),
        wall: Box::new(Model(Flat(law.clone()))),
    };
    let parts = Parts {
        grains,
        machine: Machine::new(walls(), GRAVITY, RADIUS).unwrap(),
        gravity: GRAVITY,
        dt: DT,
        skin: 0.2 * RADIUS,
    };
    Bed::new(effects, normals, parts)
}

fn scene<L: NormalLaw, C: ContactLaw>(
    law: &L,
    effects: C,
) -> (PhysicsWorld, Ruled<L, C>, Vec<RigidBodyHandle>) {
    let mut world = PhysicsWorld::new();
    world.gravity = GRAVITY;
    let mut laws = Ruled::new(law.clone(), effects, RADIUS, &mut world);
    for wall in walls() {
        let impactlaw::dem::bodies::Solid::Cuboid(half) = wall.solid else {
            panic!("walls are blocks")
        };
        let body = RigidBodyBuilder::fixed().translation(wall.centre);
        let (_, collider) = world.insert(body, ColliderBuilder::cuboid(half.x, half.y, half.z));
        laws.rule(&mut world, collider).unwrap();
    }
    let mut handles = Vec::new();
    for (place, radius, velocity) in twenty() {
        let body = RigidBodyBuilder::dynamic()
            .translation(place)
            .linvel(velocity);
        let ball = ColliderBuilder::ball(radius).density(SOFT.density);
        let (handle, collider) = world.insert(body, ball);
        laws.rule(&mut world, collider).unwrap();
        handles.push(handle);
    }
    (world, laws, handles)
}

/// Largest distance between the grains of the bed and the balls of the rapier scene over `steps`, in radii.
fn apart<L: NormalLaw, C: ContactLaw>(
    law: &L,
    effects: C,
    steps: usize,
) -> (f64, Bed<C>, Ruled<L, C>) {
    let mut bed = bed(law, effects.clone());
    let (mut world, mut laws, handles) = scene(law, effects);
    let (mut most, mut meetings) = (0.0f64, 0);
    for _ in 0..steps {
        bed.step().unwrap();
        laws.step(&mut world, DT).unwrap();
        meetings = meetings.max(laws.contacts());
        for (sphere, &handle) in bed.grains.spheres.iter().zip(&handles) {
            let other = world.bodies[handle].translation();
            most = most.max((sphere.centre - other).length() / RADIUS);
        }
    }
    bed.evaluate().unwrap();
    println!(
        "{most:e} radii apart, {:?}, plastic {:e}",
        bed.energies(),
        laws.plastic()
    );
    assert!(meetings > 5, "at most {meetings} contacts at once");
    (most, bed, laws)
}

#[test]
fn bed_and_adapter_agree_under_hertz() {
    let (apart, bed, laws) = apart(&Hertz::of(&SOFT), Law::smooth(), 3000);
    assert!(apart < 1e-6, "{apart:e} radii apart");
    assert_eq!([laws.plastic(), bed.energies().plastic], [0.0; 2]);
}

#[test]
fn bed_and_adapter_agree_under_a_law_that_yields_with_friction_damping_and_rolling_resistance() {
    let law = Thornton::of(&SOFT, YIELD_PRESSURE_RATIO).unwrap();
    let effects = Law::smooth()
        .with(Viscous::new(0.7))
        .with(Mindlin::new(&SOFT, 0.4))
        .with(RollingSpring::new(&SOFT, 0.05));
    let (apart, bed, laws) = apart(&law, effects, 4000);
    assert!(apart < 1e-6, "{apart:e} radii apart");
    let energies = bed.energies();
    let same = |ours: f64, theirs: f64| (ours / theirs - 1.0).abs() < 1e-3;
    assert!(energies.plastic > 0.0 && same(laws.plastic(), energies.plastic));
    assert!(
        same(laws.losses().friction, energies.losses.friction),
        "{:?}",
        laws.losses()
    );
    assert!(same(laws.losses().damping, energies.losses.damping));
}

#[test]
fn rapier_own_contacts_and_forces_of_the_user_are_left_alone() {
    let mut world = PhysicsWorld::new();
    world.gravity = GRAVITY;
    let law = Hertz::of(&SOFT);
    let mut laws = Ruled::new(law, Law::smooth(), RADIUS, &mut world);
    let floor = RigidBodyBuilder::fixed().translation(Vector::new(0.0, 0.0, -5e-3));
    let (_, floor) = world.insert(floor, ColliderBuilder::cuboid(2e-2, 2e-2, 5e-3));
    laws.rule(&mut world, floor).unwrap();
    // a ball under the law that is also held up by the user, and a block that is rapier's own affair
    let mass = SOFT.density * 4.0 / 3.0 * PI * RADIUS.powi(3);
    let ball = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.0, 1.5e-3));
    let (ball, shell) = world.insert(ball, ColliderBuilder::ball(RADIUS).density(SOFT.density));
    laws.rule(&mut world, shell).unwrap();
    let lift = -GRAVITY * mass;
    world.bodies[ball].add_force(lift, true);
    let block = RigidBodyBuilder::dynamic().translation(Vector::new(1e-2, 0.0, 1.1e-3));
    let block = world
        .insert(
            block,
            ColliderBuilder::cuboid(1e-3, 1e-3, 1e-3).density(1e3),
        )
        .0;
    for _ in 0..4000 {
        laws.step(&mut world, DT).unwrap();
    }
    let place = world.bodies[ball].translation();
    assert!((place.z - 1.5e-3).abs() < 1e-9, "{place}");
    assert_eq!(world.bodies[ball].user_force(), lift);
    let height = world.bodies[block].translation().z;
    assert!(
        height > 0.8e-3,
        "the block fell through its floor: {height}"
    );
}

#[test]
fn two_rigid_flats_are_refused_and_a_curved_body_is_not() {
    let run = |radius: Option<f64>| {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let mut laws = Ruled::new(Hertz::of(&SOFT), Law::smooth(), RADIUS, &mut world);
        let floor = RigidBodyBuilder::fixed().translation(Vector::new(0.0, 0.0, -5e-3));
        let (_, floor) = world.insert(floor, ColliderBuilder::cuboid(2e-2, 2e-2, 5e-3));
        laws.rule(&mut world, floor).unwrap();
        let pin = RigidBodyBuilder::dynamic()
            .translation(Vector::new(0.0, 0.0, 2.1e-3))
            .linvel(Vector::new(0.0, 0.0, -0.5));
        let shape = ColliderBuilder::capsule_z(1e-3, RADIUS).density(SOFT.density);
        let (pin, tip) = world.insert(pin, shape);
        match radius {
            Some(radius) => laws.rule_curved(&mut world, tip, radius).unwrap(),
            None => laws.rule(&mut world, tip).unwrap(),
        }
        let mut speed = 0.0;
        for _ in 0..200 {
            laws.step(&mut world, DT).map_err(|e| e.to_string())?;
            speed = world.bodies[pin].linvel().z;
        }
        Ok::<f64, String>(speed)
    };
    assert!(run(None).unwrap_err().contains("rule_curved"));
    let rebound = run(Some(RADIUS)).unwrap();
    assert!((rebound - 0.5).abs() < 1e-3, "{rebound}");
}
