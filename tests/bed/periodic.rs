//! Periodic sides: a contact across a side is one inside, momentum stays, and nothing depends on where the sides are.

use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::grains::Grains;
use impactlaw::dem::grains::neighbours::HalfList;
use impactlaw::dem::grains::periodic::Periodic;
use impactlaw::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use impactlaw::theory::thornton::Thornton;
use parry3d::math::Vector;

const RADIUS: f64 = 1e-3;
const MATERIAL: Material = Material {
    density: 2500.0,
    young_modulus: 5e7,
    poisson_ratio: 0.3,
    flow: Some(Flow::perfectly_plastic(1e6)),
};

type Frictional = Law<(((), Viscous), Mindlin)>;

fn bed(grains: Grains, gravity: Vector) -> Bed<Frictional> {
    let law = Thornton::of(&MATERIAL, YIELD_PRESSURE_RATIO).unwrap();
    let normals = Normals {
        pair: Box::new(Model(Twins(law))),
        wall: Box::new(Model(Flat(law))),
    };
    let parts = Parts {
        grains,
        machine: Machine::new(Vec::new(), gravity, RADIUS).unwrap(),
        gravity,
        dt: 4e-6,
        skin: 0.2 * RADIUS,
    };
    let effects = Law::smooth()
        .with(Viscous::new(0.9))
        .with(Mindlin::new(&MATERIAL, 0.4));
    Bed::new(effects, normals, parts)
}

/// A gas of grains in a room `edges` wide that is periodic along the first `axes` axes, all shifted by `shift`.
fn gas(edges: Vector, axes: usize, shift: Vector) -> Grains {
    let mut grains = Grains::default();
    let period = std::array::from_fn(|axis| (axis < axes).then_some(edges[axis]));
    grains.room = Periodic::new(Vector::ZERO, period).unwrap();
    let count = (edges / (2.3 * RADIUS)).floor();
    for index in 0..(count.x * count.y * count.z) as usize {
        let (nx, ny) = (count.x as usize, count.y as usize);
        let place = [index % nx, index / nx % ny, index / (nx * ny)];
        let centre = Vector::from(place.map(|at| (at as f64 + 0.5) * 2.3 * RADIUS));
        grains.add(grains.room.inside(centre + shift), RADIUS, MATERIAL.density);
        let kick = |salt: usize| ((index * 7919 + salt * 104_729) % 1000) as f64 / 500.0 - 1.0;
        let last = grains.len() - 1;
        grains.motions[last].velocity = Vector::new(kick(1), kick(2), kick(3)) * 0.5;
        grains.spins[last].rate = Vector::new(kick(4), kick(5), kick(6)) * 100.0;
    }
    grains
}

fn momentum(bed: &Bed<Frictional>) -> Vector {
    bed.grains
        .motions
        .iter()
        .map(|motion| motion.velocity / motion.inverse_mass)
        .sum()
}

#[test]
fn neighbours_through_sides_are_those_of_all_images() {
    for axes in 1..=3 {
        for cells in [2.2, 3.1, 7.3] {
            let edge = cells * 2.2 * RADIUS;
            let edges = Vector::new(edge, edge * 1.1, edge * 1.2);
            let grains = gas(edges, axes, Vector::new(0.3, 0.7, 0.0) * RADIUS);
            let skin = 0.2 * RADIUS;
            let list = HalfList::within(&grains.room, &grains.spheres, skin);
            let mut expected = Vec::new();
            for i in 0..grains.len() {
                for j in i + 1..grains.len() {
                    let line = grains.spheres[i].centre - grains.spheres[j].centre;
                    if grains.room.shortest(line).length() < 2.0 * RADIUS + skin {
                        expected.push([i as u32, j as u32]);
                    }
                }
            }
            assert_eq!(list.pairs, expected, "{axes} axes, {cells} cells");
            let shifts = grains.room.shifts();
            for (pair, &image) in list.pairs.iter().zip(&list.images) {
                let [a, b] = pair.map(|grain| grains.spheres[grain as usize].centre);
                let off = a - b + shifts[image as usize] - grains.room.shortest(a - b);
                assert!(off.length() < 1e-12 * RADIUS);
            }
        }
    }
}

#[test]
fn a_contact_across_a_side_is_one_inside() {
    let run = |shift: f64| {
        let mut grains = Grains::default();
        let edge = 12.0 * RADIUS;
        grains.room = Periodic::new(Vector::ZERO, [Some(edge), None, None]).unwrap();
        for (x, y, speed) in [(-1.2, 0.0, 1.0), (1.2, 0.8, -1.0)] {
            let centre = Vector::new(x * RADIUS + shift, y * RADIUS, 0.0);
            grains.add(grains.room.inside(centre), RADIUS, MATERIAL.density);
            let last = grains.len() - 1;
            grains.motions[last].velocity = Vector::X * speed;
        }
        let mut bed = bed(grains, Vector::ZERO);
        for _ in 0..300 {
            bed.step().unwrap();
        }
        bed.evaluate().unwrap();
        bed
    };
    let (inside, across) = (run(6.0 * RADIUS), run(0.0));
    assert!(inside.losses().friction > 0.0);
    for (a, b) in inside.grains.motions.iter().zip(&across.grains.motions) {
        assert!((a.velocity - b.velocity).length() < 1e-9, "{a:?} {b:?}");
    }
    for (a, b) in inside.grains.spins.iter().zip(&across.grains.spins) {
        assert!((a.rate - b.rate).length() < 1e-6 * a.rate.length());
    }
    let (a, b) = (inside.energies(), across.energies());
    assert!((a.balance() - b.balance()).abs() < 1e-9 * a.balance());
}

#[test]
fn a_gas_without_sides_keeps_momentum_and_energy_and_stays_in_its_room() {
    let edges = Vector::splat(14.0 * RADIUS);
    let mut bed = bed(gas(edges, 3, Vector::ZERO), Vector::ZERO);
    bed.evaluate().unwrap();
    let (before, start) = (momentum(&bed), bed.energies());
    for _ in 0..3000 {
        bed.step().unwrap();
    }
    bed.list_again();
    bed.evaluate().unwrap();
    let end = bed.energies();
    assert!(end.dissipated() > 0.1 * start.kinetic, "too few collisions");
    let scale: f64 = bed
        .grains
        .motions
        .iter()
        .map(|motion| motion.velocity.length() / motion.inverse_mass)
        .sum();
    assert!((momentum(&bed) - before).length() < 1e-12 * scale);
    let off = (end.balance() - start.balance()).abs();
    assert!(off < 5e-3 * start.kinetic, "{off} of {}", start.kinetic);
    for sphere in &bed.grains.spheres {
        let inside = sphere.centre.cmpge(Vector::ZERO).all() && sphere.centre.cmplt(edges).all();
        assert!(inside, "{:?}", sphere.centre);
    }
}

#[test]
fn it_does_not_matter_where_the_sides_are() {
    let edges = Vector::new(14.0, 12.0, 9.0) * RADIUS;
    let shift = Vector::new(3.3, 7.7, 0.0) * RADIUS;
    let mut here = bed(gas(edges, 2, Vector::ZERO), Vector::ZERO);
    let mut there = bed(gas(edges, 2, shift), Vector::ZERO);
    let busy = |bed: &Bed<Frictional>| {
        let collided = bed.losses().friction > 0.0 && bed.losses().damping > 0.0;
        collided && bed.packing().contacts >= 3
    };
    for step in 0.. {
        here.evaluate().unwrap();
        there.evaluate().unwrap();
        if busy(&here) {
            break;
        }
        assert!(step < 500, "too few collisions");
        here.advance().unwrap();
        there.advance().unwrap();
    }
    for (a, b) in here.grains.spheres.iter().zip(&there.grains.spheres) {
        let off = here.grains.room.shortest(b.centre - shift - a.centre);
        assert!(off.length() < 1e-9 * RADIUS, "{off:?}");
    }
    let (a, b) = (here.packing().virial, there.packing().virial);
    assert!((a - b).norm() < 1e-6 * a.norm(), "{a} {b}");
}

#[test]
fn falling_through_a_side_books_the_work_of_gravity() {
    let gravity = Vector::new(3.0, 0.0, 0.0);
    let mut grains = Grains {
        room: Periodic::new(Vector::ZERO, [Some(8.0 * RADIUS), None, None]).unwrap(),
        ..Grains::default()
    };
    grains.add(
        Vector::new(4.0, 0.0, 0.0) * RADIUS,
        RADIUS,
        MATERIAL.density,
    );
    let mut bed = bed(grains, gravity);
    bed.evaluate().unwrap();
    let start = bed.energies();
    for _ in 0..40_000 {
        bed.step().unwrap();
    }
    bed.evaluate().unwrap();
    let end = bed.energies();
    assert!(end.driven > 0.0 && end.kinetic > 0.0);
    let off = (end.balance() - start.balance()).abs();
    assert!(off < 1e-9 * end.kinetic, "{off} of {}", end.kinetic);
}

#[test]
fn a_period_in_which_grains_would_meet_twice_is_refused() {
    let grains = |edge: f64| {
        let mut grains = Grains {
            room: Periodic::new(Vector::ZERO, [None, Some(edge), None]).unwrap(),
            ..Grains::default()
        };
        grains.add(Vector::ZERO, RADIUS, MATERIAL.density);
        grains
    };
    assert!(bed(grains(4.5 * RADIUS), Vector::ZERO).step().is_ok());
    let error = bed(grains(4.3 * RADIUS), Vector::ZERO).step().unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("0.0043 m along y") && text.contains("0.0044 m"),
        "{text}"
    );
    assert!(Periodic::new(Vector::ZERO, [Some(f64::NAN), None, None]).is_err());
}
