//! Grains and bodies: momentum, sliding over meshes, rolling to rest, and the weight of a lid on a joint.

use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::{Body, Freedom, Mobility, Solid};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::grains::Grains;
use impactlaw::material::Material;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::{Rotation, Vector};

type Frictional = Law<((((), Viscous), Mindlin), RollingSpring)>;

const GLASS: Material = Material {
    density: 2500.0,
    young_modulus: 50e6,
    poisson_ratio: 0.3,
    flow: None,
};

fn frictional() -> Frictional {
    Law::smooth()
        .with(Viscous::new(0.7))
        .with(Mindlin::new(&GLASS, 0.4))
        .with(RollingSpring::new(&GLASS, 0.05))
}

fn weightless<C: ContactLaw>(
    effects: C,
    grains: Grains,
    bodies: Vec<Body>,
    gravity: Vector,
) -> Bed<C> {
    let parts = Parts {
        grains,
        machine: Machine::new(bodies, gravity, 1e-3).unwrap(),
        gravity,
        dt: 5e-6,
        skin: 0.5e-3,
    };
    let law = Hertz::of(&GLASS);
    let normals = Normals {
        pair: Box::new(Model(Twins(law))),
        wall: Box::new(Model(Flat(law))),
    };
    Bed::new(effects, normals, parts)
}

#[test]
fn grains_and_a_free_block_keep_their_momentum() {
    let mut grains = Grains::default();
    for index in 0..60 {
        let place = Vector::new(
            (index % 4) as f64,
            (index / 4 % 4) as f64,
            (index / 16) as f64,
        );
        grains.add(
            2.1e-3 * (place + Vector::new(-1.5, -1.5, 0.6)),
            1e-3,
            GLASS.density,
        );
        grains.motions[index].velocity =
            Vector::new(0.01, -0.02, -0.5) * (1.0 + index as f64 / 60.0);
    }
    let block = Body {
        name: "block".to_owned(),
        solid: Solid::Cuboid(Vector::new(5e-3, 4e-3, 2e-3)),
        centre: Vector::new(0.0, 0.0, -2e-3),
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Free(Freedom::of_mass(1e-3)),
        material: None,
    };
    let mut bed = weightless(frictional(), grains, vec![block], Vector::ZERO);
    let momentum = |bed: &Bed<Frictional>| {
        let of_grains: Vector = bed
            .grains
            .motions
            .iter()
            .map(|m| m.velocity / m.inverse_mass)
            .sum();
        (
            of_grains,
            of_grains + bed.machine.stations[0].velocity / bed.machine.stations[0].inverse_mass,
        )
    };
    let (first, total) = momentum(&bed);
    for _ in 0..4000 {
        bed.step().unwrap();
    }
    let (last, after) = momentum(&bed);
    assert!(
        (last - first).length() > 0.5 * first.length(),
        "the grains hardly hit the block"
    );
    assert!(
        (after - total).length() < 1e-12 * total.length(),
        "{}",
        (after - total).length() / total.length()
    );
}

/// A grain thrown along a floor of two materials' making: solid, or a mesh with many inner edges.
fn slid(solid: Solid, steps: usize) -> Bed<Frictional> {
    let mut grains = Grains::default();
    grains.add(Vector::new(0.0, 0.1e-3, 1e-3), 1e-3, GLASS.density);
    grains.motions[0].velocity = Vector::new(0.3, 0.02, 0.0);
    let centre = if matches!(solid, Solid::Cuboid(_)) {
        Vector::new(0.0, 0.0, -1e-2)
    } else {
        Vector::ZERO
    };
    let floor = Body {
        name: "floor".to_owned(),
        solid,
        centre,
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Fixed,
        material: None,
    };
    let mut bed = weightless(
        frictional(),
        grains,
        vec![floor],
        Vector::new(0.0, 0.0, -9.81),
    );
    for _ in 0..steps {
        bed.step().unwrap();
    }
    bed
}

fn flat_mesh() -> Solid {
    let (cells, edge) = (40, 0.7e-3);
    let corner = |x: u32, y: u32| y * (cells + 1) + x;
    let place = |i: u32| (f64::from(i) - 0.25 * f64::from(cells)) * edge;
    let vertices = (0..=cells)
        .flat_map(|y| (0..=cells).map(move |x| Vector::new(place(x), place(y), 0.0)))
        .collect();
    let triangles = (0..cells)
        .flat_map(|y| (0..cells).map(move |x| (x, y)))
        .flat_map(|(x, y)| {
            let [a, b, c, d] = [
                corner(x, y),
                corner(x + 1, y),
                corner(x + 1, y + 1),
                corner(x, y + 1),
            ];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    Solid::Mesh {
        vertices,
        triangles,
    }
}

#[test]
fn a_grain_slides_over_the_inner_edges_of_a_mesh_as_over_a_block() {
    let block = slid(Solid::Cuboid(Vector::new(0.1, 0.1, 1e-2)), 8000);
    let mesh = slid(flat_mesh(), 8000);
    let (a, b) = (
        block.grains.spheres[0].centre,
        mesh.grains.spheres[0].centre,
    );
    assert!(a.x > 3e-3, "it hardly moved: {a}");
    assert!((a - b).length() < 1e-9 * a.x, "{a} {b}");
    let spins = (block.grains.spins[0].rate, mesh.grains.spins[0].rate);
    assert!(
        (spins.0 - spins.1).length() < 1e-6 * spins.0.length(),
        "{spins:?}"
    );
}

#[test]
fn a_grain_that_rolls_comes_to_rest_and_stays() {
    let mut bed = slid(Solid::Cuboid(Vector::new(0.1, 0.1, 1e-2)), 400_000);
    let place = bed.grains.spheres[0].centre;
    let speed = bed.grains.motions[0].velocity.length() + 1e-3 * bed.grains.spins[0].rate.length();
    assert!(speed < 1e-9, "still at {speed} m/s");
    for _ in 0..200_000 {
        bed.step().unwrap();
    }
    assert!(
        (bed.grains.spheres[0].centre - place).length() < 1e-12,
        "drifts"
    );
    let weight = 9.81 * GLASS.sphere_mass(1e-3);
    bed.evaluate().unwrap();
    assert!((bed.loads[0].force.z / -weight - 1.0).abs() < 1e-6);
}

#[test]
fn a_lid_on_a_prismatic_joint_rests_on_grains_with_its_weight() {
    let mut grains = Grains::default();
    for index in 0..9 {
        let place = Vector::new((index % 3) as f64 - 1.0, (index / 3) as f64 - 1.0, 0.0);
        grains.add(
            2.2e-3 * place + Vector::new(0.0, 0.0, 1e-3),
            1e-3,
            GLASS.density,
        );
    }
    let block = |name: &str, z: f64, mobility| Body {
        name: name.to_owned(),
        solid: Solid::Cuboid(Vector::new(5e-3, 5e-3, 1e-3)),
        centre: Vector::new(0.0, 0.0, z),
        rotation: Rotation::IDENTITY,
        mobility,
        material: None,
    };
    let lid = Mobility::Free(Freedom::of_mass(1e-3).sliding(Vector::Z));
    let bodies = vec![
        block("floor", -1e-3, Mobility::Fixed),
        block("lid", 3.01e-3, lid),
    ];
    let mut bed = weightless(frictional(), grains, bodies, Vector::new(0.0, 0.0, -9.81));
    let (mut force, mut sideways) = (0.0, 0.0f64);
    for step in 0..60_000 {
        bed.step().unwrap();
        if step >= 20_000 {
            force += bed.loads[1].force.z / 40_000.0;
        }
        let lid = &bed.machine.stations[1];
        sideways = sideways.max(lid.centre.x.abs() + lid.centre.y.abs() + lid.spin.length());
    }
    assert!((force / (9.81 * 1e-3) - 1.0).abs() < 1e-3, "{force}");
    assert!(sideways < 1e-9, "the joint lets go: {sideways}");
}
