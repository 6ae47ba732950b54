//! Speed of the bed: time of one step of 10 000 touching grains, by law and effects; elements are particle-steps.
//!
//! `BED_XYZR=file` measures a packing of your own instead of the lattice: lines of `x y z radius`, in metres, in a box
//! from 0 to 46 mm.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use impactlaw::bed::damping::Viscous;
use impactlaw::bed::friction::Mindlin;
use impactlaw::bed::grains::Grains;
use impactlaw::bed::law::{ContactLaw, Law};
use impactlaw::bed::machine::Machine;
use impactlaw::bed::neighbours::Cells;
use impactlaw::bed::normals::Model;
use impactlaw::bed::room::Room;
use impactlaw::bed::step::{Bed, Normals, Parts};
use impactlaw::bed::time_step::rayleigh_time;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::thornton::Thornton;
use parry3d::math::Vector;
use std::time::Instant;

const RADIUS: f64 = 1e-3;
const EDGE: f64 = 46e-3;
const MATERIAL: Material = Material {
    density: 2500.0,
    young_modulus: 5e7,
    poisson_ratio: 0.3,
    flow: Some(Flow {
        yield_strength: 1e6,
        hardening_modulus: 0.0,
    }),
};

/// Simple cubic lattice, pressed so that every grain touches its six neighbours.
fn lattice() -> Grains {
    let mut grains = Grains::default();
    let spacing = EDGE / 23.0;
    for index in 0..10_000 {
        let place = [index % 23, index / 23 % 23, index / 529].map(|i| i as f64 + 0.5);
        grains.add(
            Vector::from(place) * spacing - Vector::Z * 1e-6 * place[2],
            RADIUS,
            MATERIAL.density,
        );
    }
    for sphere in &mut grains.spheres {
        sphere.radius *= 1.0005;
    }
    grains
}

fn packing() -> Grains {
    let Ok(path) = std::env::var("BED_XYZR") else {
        return lattice();
    };
    let text = std::fs::read_to_string(path).expect("BED_XYZR must name a readable file");
    let mut grains = Grains::default();
    for line in text.lines() {
        let [x, y, z, radius] = line
            .split_whitespace()
            .filter_map(|w| w.parse().ok())
            .collect::<Vec<f64>>()[..]
        else {
            continue;
        };
        grains.add(Vector::new(x, y, z), radius, MATERIAL.density);
    }
    grains
}

fn bed<C: ContactLaw, L: NormalLaw>(effects: C, law: &L) -> Bed<C> {
    let room = Room::open_box(EDGE, EDGE, 80e-3, 4e-3);
    let gravity = Vector::new(0.0, 0.0, -9.81);
    let mut grains = packing();
    grains.reorder(&Cells::new(&grains.spheres, 2.0 * RADIUS).order());
    let parts = Parts {
        grains,
        machine: Machine::new(room.bodies(), gravity, RADIUS).expect("a box of blocks is sound"),
        gravity,
        dt: 0.2 * rayleigh_time(&MATERIAL, RADIUS),
        skin: 0.2 * RADIUS,
    };
    let normals = Normals {
        pair: Box::new(Model(Twins(law.clone()))),
        wall: Box::new(Model(Flat(law.clone()))),
    };
    let mut bed = Bed::new(effects, normals, parts);
    for _ in 0..300 {
        bed.step().expect("the packing is at rest");
    }
    bed
}

fn measure<C: ContactLaw, L: NormalLaw>(
    criterion: &mut Criterion,
    name: &str,
    effects: C,
    law: &L,
) {
    let mut group = criterion.benchmark_group("bed step");
    let mut bed = bed(effects, law);
    group.throughput(Throughput::Elements(bed.grains.len() as u64));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("one thread starts");
    group.bench_function(name, |bencher| {
        bencher.iter_custom(|steps| {
            pool.install(|| {
                let began = Instant::now();
                for _ in 0..steps {
                    bed.step().expect("the packing is at rest");
                }
                began.elapsed()
            })
        });
    });
    group.finish();
}

fn steps(criterion: &mut Criterion) {
    let (hertz, yielding) = (
        Hertz::of(&MATERIAL),
        Thornton::of(&MATERIAL, YIELD_PRESSURE_RATIO).expect("it yields"),
    );
    let (damping, friction) = (Viscous::new(0.8), Mindlin::new(&MATERIAL, 0.5));
    measure(criterion, "hertz", Law::new((), (), ()), &hertz);
    measure(
        criterion,
        "hertz, damping",
        Law::new(damping, (), ()),
        &hertz,
    );
    measure(
        criterion,
        "hertz, Mindlin",
        Law::new((), friction, ()),
        &hertz,
    );
    measure(
        criterion,
        "hertz, damping, Mindlin",
        Law::new(damping, friction, ()),
        &hertz,
    );
    measure(
        criterion,
        "thornton, damping, Mindlin",
        Law::new(damping, friction, ()),
        &yielding,
    );
}

criterion_group!(benches, steps);
criterion_main!(benches);
