//! Cost of a time step of the impact solver, in point-steps a second: elastic and J2 bodies, degrees 1 to 3;
//! quadratic in three dimensions.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use impactlaw::impact::kernel::{Purpose, made_of};
use impactlaw::impact::model::build;
use impactlaw::impact::model::solid;
use impactlaw::impact::model::solid::Mesh;
use impactlaw::impact::wall::surface::Frictionless;
use impactlaw::material::flow::PerfectlyPlastic;
use impactlaw::material::stress::{Constitutive, Elastic, J2, Moduli};
use impactlaw::plan::{Geometry, Grid};
use impactlaw::space::{Axisymmetric, Solid};
use std::hint::black_box;

fn grid(degree: usize) -> Grid {
    Grid {
        shape: impactlaw::shape::Shape::Sphere,
        degree,
        points_per_direction: degree.max(2),
        fine: 0.012,
        fine_width: 0.25,
        fine_depth: 0.12,
        growth: 1.15,
        coarse: 0.1,
        dt_share: 1.0,
        scaled: 0.0,
        remedies: impactlaw::plan::Remedies::NONE,
    }
}

/// One sweep over the points: gather, stress, scatter.
fn sweep<M: Constitutive<Axisymmetric>, const P: usize, const N: usize>(
    c: &mut Criterion,
    name: &str,
    material: M,
) {
    let mut model = build::<P, N>(
        &grid(P),
        impactlaw::scheme::Layout::Fitted,
        made_of(material),
        1e-9,
    );
    let nodes = model.mass.len();
    let u: Vec<[f64; 2]> = (0..nodes)
        .map(|n| [0.0, 1e-3 * (0.1 * n as f64).sin()])
        .collect();
    let mut force = vec![[0.0; 2]; nodes];
    let mut group = c.benchmark_group("sweep");
    group.throughput(Throughput::Elements(model.points.count() as u64));
    group.bench_function(name, |b| {
        b.iter(|| model.points.sweep(Purpose::Step, black_box(&u), &mut force));
    });
    group.finish();
}

/// The same in three dimensions: a quarter of the sphere, quadratic.
fn solid_sweep<M: Constitutive<Solid>>(c: &mut Criterion, name: &str, material: M) {
    let coarse = Grid {
        fine: 0.04,
        ..grid(2)
    };
    let mesh = Mesh {
        grid: &coarse,
        layout: impactlaw::scheme::Layout::Fitted,
        geometry: Geometry::Quarter,
    };
    let mut model = solid::build::<_, 2, 27>(mesh, made_of(material), Frictionless, 1e-9);
    let nodes = model.mass.len();
    let u: Vec<[f64; 3]> = (0..nodes)
        .map(|n| [0.0, 0.0, 1e-3 * (0.1 * n as f64).sin()])
        .collect();
    let mut force = vec![[0.0; 3]; nodes];
    let mut group = c.benchmark_group("sweep");
    group.throughput(Throughput::Elements(model.points.count() as u64));
    group.bench_function(name, |b| {
        b.iter(|| model.points.sweep(Purpose::Step, black_box(&u), &mut force));
    });
    group.finish();
}

fn sweeps(c: &mut Criterion) {
    let moduli = Moduli::new(1.0, 0.35);
    let elastic = Elastic { moduli };
    let flow = PerfectlyPlastic { strength: 0.0125 };
    let j2 = J2 { moduli, flow };
    // the same field yields everywhere here: the worst case of the return
    let soft = J2 {
        moduli,
        flow: PerfectlyPlastic { strength: 1e-5 },
    };
    sweep::<_, 2, 9>(c, "quadratic elastic", elastic);
    sweep::<_, 1, 4>(c, "linear J2", j2);
    sweep::<_, 2, 9>(c, "quadratic J2", j2);
    sweep::<_, 3, 16>(c, "cubic J2", j2);
    sweep::<_, 2, 9>(c, "quadratic J2, all points yielding", soft);
    solid_sweep(c, "quadratic J2, three dimensions", j2);
}

criterion_group!(benches, sweeps);
criterion_main!(benches);
