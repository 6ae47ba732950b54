//! Restart: a bed resumed from a tape goes on with the same bits as one that was never stopped.

use impactlaw::bed::measures::fabric::Fabric;
use impactlaw::contact::pair::{Alike, Flat};
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::motion::Motion;
use impactlaw::dem::bodies::{Body, Freedom, Mobility, Solid};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::grains::Grains;
use impactlaw::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use impactlaw::tape::{Keep, Tape};
use impactlaw::theory::thornton::Thornton;
use parry3d::math::{Rotation, Vector};

const RADIUS: f64 = 1e-3;
/// Edge of the box, in radii.
const EDGE: f64 = 12.0;

type Frictional = Bed<Law<((((), Viscous), Mindlin), RollingSpring)>>;

fn soft() -> Material {
    Material {
        density: 2500.0,
        young_modulus: 5e7,
        poisson_ratio: 0.3,
        flow: Some(Flow::perfectly_plastic(1e5)),
    }
}

/// A square floor of two triangles.
fn mesh_floor() -> Body {
    let e = EDGE * RADIUS;
    let corner = |x: f64, y: f64| Vector::new(x * e, y * e, 0.0);
    Body {
        name: "floor".to_owned(),
        solid: Solid::Mesh {
            vertices: vec![
                corner(-1.0, -1.0),
                corner(2.0, -1.0),
                corner(2.0, 2.0),
                corner(-1.0, 2.0),
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        },
        centre: Vector::ZERO,
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Fixed,
        material: None,
    }
}

/// Every kind of body: a mesh, blocks, a driven block that turns, a lid on a joint and a ball that is free.
fn bodies() -> Vec<Body> {
    let e = EDGE * RADIUS;
    let block = |name: &str, low: [f64; 3], high: [f64; 3]| {
        let corner = |c: [f64; 3]| Vector::from(c.map(|x| x * e));
        Body::block(name, corner(low), corner(high))
    };
    let mut stirrer = block("stirrer", [0.3, 0.3, 0.1], [0.7, 0.35, 0.3]);
    stirrer.mobility = Mobility::Driven(Motion {
        velocity: Vector::new(0.0, 0.01, 0.0),
        spin: Vector::new(0.0, 0.0, 20.0),
        ..Motion::default()
    });
    let mut lid = block("lid", [0.0, 0.0, 1.2], [1.0, 1.0, 1.3]);
    lid.mobility = Mobility::Free(Freedom::of_mass(1e-3).sliding(Vector::Z));
    let ball = Body {
        name: "ball".to_owned(),
        solid: Solid::Ball(3.0 * RADIUS),
        centre: Vector::new(0.5, 0.4, 1.0) * e,
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Free(Freedom::of_mass(2e-4)),
        material: None,
    };
    vec![
        mesh_floor(),
        block("left", [-1.0, -1.0, 0.0], [0.0, 2.0, 3.0]),
        block("right", [1.0, -1.0, 0.0], [2.0, 2.0, 3.0]),
        block("front", [-1.0, -1.0, 0.0], [2.0, 0.0, 3.0]),
        block("back", [-1.0, 1.0, 0.0], [2.0, 2.0, 3.0]),
        stirrer,
        lid,
        ball,
    ]
}

/// Layers of grains of two sizes above the stirrer, thrown about.
fn bed() -> Frictional {
    let material = soft();
    let mut grains = Grains::default();
    for index in 0..100 {
        let place = [index % 5, index / 5 % 5, index / 25].map(|k| f64::from(k) + 0.6);
        let radius = if index % 3 == 0 { 0.8 } else { 1.0 } * RADIUS;
        let lift = Vector::Z * 3.5 * RADIUS;
        grains.add(
            Vector::from(place.map(|k| 2.2 * k * RADIUS)) + lift,
            radius,
            material.density,
        );
        let turn = f64::from(index);
        grains.motions[index as usize].velocity = 0.3 * Vector::new(turn.sin(), turn.cos(), -1.0);
    }
    let gravity = Vector::new(0.0, 0.0, -9.81);
    let law = Thornton::of(&material, YIELD_PRESSURE_RATIO).unwrap();
    let normals = Normals {
        pair: Box::new(Model(Alike(law))),
        wall: Box::new(Model(Flat(law))),
    };
    let effects = Law::smooth()
        .with(Viscous::new(0.7))
        .with(Mindlin::new(&material, 0.4))
        .with(RollingSpring::new(&material, 0.05));
    let parts = Parts {
        grains,
        machine: Machine::new(bodies(), gravity, RADIUS).unwrap(),
        gravity,
        dt: 1e-5,
        skin: 0.2 * RADIUS,
    };
    Bed::new(effects, normals, parts)
}

fn tape(bed: &Frictional) -> Tape {
    let mut tape = Tape::default();
    bed.save(&mut tape);
    tape
}

fn take_up(tape: &mut Tape) -> Option<Frictional> {
    let mut bed = bed();
    Keep::load(&mut bed, tape)?;
    Some(bed)
}

fn run(bed: &mut Frictional, steps: usize) {
    for _ in 0..steps {
        bed.step().unwrap();
    }
}

#[test]
fn a_bed_taken_up_at_any_step_ends_with_the_same_bits() {
    let mut whole = bed();
    for steps in [0, 1, 1200, 1801] {
        run(&mut whole, steps);
        let mut kept = tape(&whole);
        let mut resumed = take_up(&mut kept).unwrap();
        run(&mut resumed, 700);
        let again = take_up(&mut tape(&whole)).unwrap();
        assert_eq!(
            tape(&again),
            tape(&whole),
            "what was resumed is not what was kept"
        );
        run(&mut whole, 700);
        assert_eq!(tape(&resumed), tape(&whole), "after {steps} steps");
    }
    assert!(whole.contacts.list.pairs.len() > 100);
    let touches = whole.surfaces.all().filter(|h| h.patch.push.touches());
    let touched: std::collections::BTreeSet<usize> = touches.map(|held| held.surface).collect();
    assert!(touched.contains(&0) && touched.contains(&6), "{touched:?}");
    let energies = whole.energies();
    let losses = energies.losses;
    assert!(energies.plastic > 0.0 && losses.friction > 0.0 && losses.rolling > 0.0);
    assert_ne!(energies.driven, 0.0);
}

#[test]
fn the_sum_of_branches_times_forces_is_that_of_places_times_forces_on_grains_and_surfaces() {
    let mut bed = bed();
    run(&mut bed, 3000);
    bed.evaluate().unwrap();
    let column = |v: Vector| nalgebra::Vector3::from(v.to_array());
    let product = |a: Vector, b: Vector| column(a) * column(b).transpose();
    let mut sum = nalgebra::Matrix3::zeros();
    for (grain, sphere) in bed.grains.spheres.iter().enumerate() {
        sum += product(sphere.centre, bed.load(grain).0);
    }
    for held in bed.surfaces.all().filter(|h| h.patch.push.touches()) {
        sum -= product(held.patch.point, held.patch.push.force);
    }
    let fabric = Fabric::of(&bed.contact_rows(), &bed.grains);
    assert!(fabric.contacts > 20 && fabric.wall_contacts > 5);
    assert!(
        (fabric.contact - sum).norm() < 1e-12 * sum.norm(),
        "{sum} {}",
        fabric.contact
    );
}

#[test]
fn a_tape_of_another_bed_or_cut_short_is_refused() {
    let mut whole = bed();
    run(&mut whole, 300);
    let mut long = tape(&whole);
    assert!(take_up(&mut long).is_some());
    assert!(take_up(&mut long).is_none(), "the tape is at its end");
    let mut empty = Tape::default();
    assert!(take_up(&mut empty).is_none());
}
