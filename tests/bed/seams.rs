//! Seams: a surface made of several triangles or bodies pushes a grain as one plate does, and a thin wall as a thick one.

use crate::meshes::{binary, cube};
use crate::scene_run::quiet;
use impactlaw::bed::run::run_scene;
use impactlaw::bed::scene::Scene;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::{Body, Mobility, Solid};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::force::rolling::RollingSpring;
use impactlaw::dem::grains::Grains;
use impactlaw::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::thornton::Thornton;
use parry3d::math::{Rotation, Vector};
use std::path::Path;

type Facet = [[f64; 3]; 3];

/// Two triangles of a plate at z = 0 of edge 40, the second `gap` away from the first.
fn split_plate(gap: f64) -> Vec<Facet> {
    let corner = |x: f64, y: f64| [20.0 * x, 20.0 * y, 0.0];
    let apart = |[x, y, z]: [f64; 3]| [x - gap, y + gap, z];
    vec![
        [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
        [corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)].map(apart),
    ]
}

/// Skins of a plate of edge `2 half` and thickness `thick` (m), its upper one at z = 0.
fn shell(half: f64, thick: f64) -> Vec<Facet> {
    cube()
        .into_iter()
        .map(|facet| {
            facet.map(|[x, y, z]| [x / 5.0 * half, y / 5.0 * half, (z / 10.0 - 1.0) * thick])
        })
        .collect()
}

const SCENE: &str = r#"
seed = 1
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[grains]
count = 1
radius = "RADIUS"
region = { low = LOW, high = HIGH }
[contact]
friction = 0.4
restitution = 0.6
[domain]
low = ["-10 m", "-10 m", "-5 m"]
high = ["10 m", "10 m", "10 m"]
BODIES
[[stage]]
kind = "run"
duration = "DURATION"
[output]
rows = 4
frames = 4
film = 0
dump = true
"#;

/// Place, velocity and spin of a lone grain of `radius` (m) that fell by four of them on `bodies`, after its first rebound.
fn rebounded(radius: f64, bodies: &str, mesh: &[u8]) -> [Vector; 3] {
    let folder = tempfile::tempdir().unwrap();
    // the region leaves the grain little room, over the seam
    let region = |low: bool| {
        let (side, z) = if low { (-1.15, 3.0) } else { (1.15, 5.4) };
        let [side, z] = [side, z].map(|x| x * radius);
        format!("[\"{side} m\", \"{side} m\", \"{z} m\"]")
    };
    let duration = 1.5 * (2.0 * 3.2 * radius / 9.81).sqrt();
    let text = SCENE
        .replace("RADIUS", &format!("{radius} m"))
        .replace("LOW", &region(true))
        .replace("HIGH", &region(false))
        .replace("BODIES", bodies)
        .replace("DURATION", &format!("{duration} s"));
    std::fs::write(folder.path().join("part.stl"), mesh).unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text).unwrap();
    let scene = Scene::read(&file).unwrap();
    let out = folder.path().join("out");
    run_scene(&scene, None, &quiet(&out)).unwrap();
    last_frame(&out)
}

/// Grain of the last frame of the only dump below a folder.
fn last_frame(folder: &Path) -> [Vector; 3] {
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.ends_with("dump.lammpstrj") {
                let text = std::fs::read_to_string(path).unwrap();
                let line = text.lines().last().unwrap();
                let values: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
                let vector = |at: usize| Vector::from_slice(&values[at..at + 3]);
                return [vector(2), vector(6), vector(9)];
            }
        }
    }
    panic!("no dump")
}

const BLOCK: &str = "[[body]]\nname = \"block\"\nblock = { size = [\"4 m\", \"4 m\", \"1 m\"] }\nat = [\"0 m\", \"0 m\", \"-0.5 m\"]\n";
const PART: &str = "[[body]]\nname = \"part\"\nmesh = \"part.stl\"\nscale = \"1 mm\"\n";

/// Rebounds as from one block, within 1e-3 of the speed and the height.
fn as_on_a_block(radius: f64, bodies: &str, mesh: &[u8], what: &str) {
    let [place, velocity, spin] = rebounded(radius, BLOCK, &[]);
    assert!(velocity.z > 0.0 || place.z > radius, "it has not rebounded");
    let [there, speed, turn] = rebounded(radius, bodies, mesh);
    let (height, fast) = (place.z, (2.0 * 9.81 * 3.2 * radius).sqrt());
    assert!(
        (there - place).length() < 1e-3 * height,
        "{what}: {there} and not {place}"
    );
    assert!(
        (speed - velocity).length() < 1e-3 * fast,
        "{what}: {speed} and not {velocity}"
    );
    assert!(
        (turn - spin).length() * radius < 1e-3 * fast,
        "{what}: {turn} and not {spin}"
    );
}

#[test]
fn solids_without_a_name_and_several_solids_are_floors() {
    let plate = split_plate(0.0);
    let text = |name: &str, facets: &[Facet]| {
        let mut text = format!("solid{name}\n");
        for facet in facets {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in facet {
                text += &format!("vertex {x:e} {y:e} {z:e}\n");
            }
            text += "endloop\nendfacet\n";
        }
        text + "endsolid\n"
    };
    let far = [[[30.0, 0.0, 9.0], [31.0, 0.0, 9.0], [30.0, 1.0, 9.0]]];
    let files = [
        ("no name", text("", &plate)),
        (
            "no name, carriage returns",
            text("", &plate).replace('\n', "\r"),
        ),
        ("no name, capitals", text("", &plate).to_uppercase()),
        ("the floor last", text(" a", &far) + &text(" b", &plate)),
        ("empty first", text("", &[]) + &text(" b", &plate)),
        (
            "a part in each",
            text(" a", &plate[..1]) + &text(" a", &plate[1..]) + &text("", &far),
        ),
    ];
    for (what, file) in files {
        as_on_a_block(1e-3, PART, file.as_bytes(), what);
    }
}

#[test]
fn an_impact_on_the_gap_between_two_triangles_is_one_on_a_plate() {
    // the last bit, then more than corners are merged over
    for gap in [2e-6, 0.004, 0.03] {
        let mesh = binary(b"", &split_plate(gap));
        as_on_a_block(1e-3, PART, &mesh, &format!("gap of {gap} mm"));
    }
}

#[test]
fn an_impact_on_the_seam_of_flush_bodies_is_one_on_a_plate() {
    let block = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nblock = {{ size = [\"80 mm\", \"40 mm\", \"10 mm\"] }}\nat = [\"{x} mm\", \"0 mm\", \"-5 mm\"]\n"
        )
    };
    let two = block("a", -40.0) + &block("b", 40.0);
    as_on_a_block(1e-3, &two, &[], "two blocks");
    let overlapping = block("a", -39.0) + &block("b", 38.0);
    as_on_a_block(1e-3, &overlapping, &[], "overlapping blocks");
    let plate = binary(b"", &shell(20.0, 3.0));
    let beside = block("a", -40.0) + PART;
    as_on_a_block(1e-3, &beside, &plate, "a block in the plane of a mesh");
}

#[test]
fn a_thin_shell_pushes_as_a_block_does() {
    for thick in [0.5, 5.0, 12.0] {
        let mesh = binary(b"", &shell(1000.0, thick));
        as_on_a_block(150e-3, PART, &mesh, &format!("a shell of {thick} mm"));
    }
    // a plate of its own in front of a block
    let plate = "[[body]]\nname = \"plate\"\nblock = { size = [\"2 m\", \"2 m\", \"5 mm\"] }\nat = [\"0 m\", \"0 m\", \"-2.5 mm\"]\n";
    let behind = "[[body]]\nname = \"behind\"\nblock = { size = [\"2 m\", \"2 m\", \"1 m\"] }\nat = [\"0 m\", \"0 m\", \"-0.505 m\"]\n";
    as_on_a_block(
        150e-3,
        &(behind.to_owned() + plate),
        &[],
        "a plate before a block",
    );
}

const GLASS: Material = Material {
    density: 2500.0,
    young_modulus: 50e6,
    poisson_ratio: 0.3,
    flow: None,
};

fn block(x: [f64; 2]) -> Body {
    Body::block(
        "floor",
        Vector::new(x[0], -1e-2, -1e-2),
        Vector::new(x[1], 1e-2, 0.0),
    )
}

fn plate(x: [f64; 2]) -> Body {
    let corner = |x: f64, y: f64| Vector::new(x, y, 0.0);
    let solid = Solid::Mesh {
        vertices: vec![
            corner(x[0], -1e-2),
            corner(x[1], -1e-2),
            corner(x[1], 1e-2),
            corner(x[0], 1e-2),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    Body {
        name: "plate".to_owned(),
        solid,
        centre: Vector::ZERO,
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Fixed,
        material: None,
    }
}

type Frictional = Law<((((), Viscous), Mindlin), RollingSpring)>;

/// A grain thrown along floors with friction and rolling resistance.
fn slid(floors: Vec<Body>, yields: bool) -> Bed<Frictional> {
    let material = Material {
        flow: yields.then_some(Flow::perfectly_plastic(50e3)),
        ..GLASS
    };
    let mut grains = Grains::default();
    grains.add(Vector::new(-2e-3, 0.1e-3, 1e-3), 1e-3, GLASS.density);
    grains.motions[0].velocity = Vector::new(0.3, 0.02, -0.05);
    let gravity = Vector::new(0.0, 0.0, -9.81);
    let parts = Parts {
        grains,
        machine: Machine::new(floors, gravity, 1e-3).unwrap(),
        gravity,
        dt: 5e-6,
        skin: 0.5e-3,
    };
    let law = Law::smooth()
        .with(Viscous::new(0.7))
        .with(Mindlin::new(&GLASS, 0.4))
        .with(RollingSpring::new(&GLASS, 0.05));
    let normals = match yields {
        false => Normals {
            pair: Box::new(Model(Twins(Hertz::of(&GLASS)))),
            wall: Box::new(Model(Flat(Hertz::of(&GLASS)))),
        },
        true => {
            let law = Thornton::of(&material, YIELD_PRESSURE_RATIO).unwrap();
            Normals {
                pair: Box::new(Model(Twins(law))),
                wall: Box::new(Model(Flat(law))),
            }
        }
    };
    let mut bed = Bed::new(law, normals, parts);
    for _ in 0..8000 {
        bed.step().unwrap();
    }
    bed
}

#[test]
fn grains_slide_and_roll_over_seams_with_one_history() {
    for yields in [false, true] {
        let one = slid(vec![block([-2e-2, 2e-2])], yields);
        let place = one.grains.spheres[0].centre;
        assert!(place.x > 1e-3, "it hardly moved: {place}");
        type Make = fn([f64; 2]) -> Body;
        let kinds: [[Make; 2]; 4] = [
            [block, block],
            [plate, plate],
            [block, plate],
            [plate, block],
        ];
        for (index, kind) in kinds.iter().enumerate() {
            // every half millimetre another body
            let edges: Vec<f64> = (-8..=12).map(|at| f64::from(at) * 0.51e-3).collect();
            let mut floors: Vec<Body> = edges
                .windows(2)
                .enumerate()
                .map(|(at, edge)| kind[at % 2]([edge[0], edge[1]]))
                .collect();
            floors.push(block([edges[20], 2e-2]));
            let many = slid(floors, yields);
            let there = many.grains.spheres[0].centre;
            assert!(
                (there - place).length() < 1e-6 * place.x,
                "{index}: {there} {place}"
            );
            let turned = [&one, &many].map(|bed| bed.grains.spins[0].rate);
            assert!(
                (turned[0] - turned[1]).length() < 1e-5 * turned[0].length(),
                "{index}: {turned:?}"
            );
            let work = [&one, &many].map(|bed| bed.losses());
            assert!((work[0].friction - work[1].friction).abs() < 1e-4 * work[0].friction);
        }
    }
}
