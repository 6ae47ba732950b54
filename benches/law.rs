//! Cost of one force call: Hertz, and the fitted law in both forms, on loading, unloading and random paths.

use criterion::{Criterion, criterion_group, criterion_main};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::elastoplastic::{Elastoplastic, YieldUnits};
use impactlaw::contact::loading::SoftenedHertz;
use impactlaw::contact::spline::{Knot, SplineLoading};
use impactlaw::contact::unloading::Unloading;
use impactlaw::theory::hertz::Hertz;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::hint::black_box;

/// Calls of one measurement.
const CALLS: usize = 10_000;

/// A path in yield units for each kind of motion.
fn paths() -> [(&'static str, Vec<f64>); 3] {
    let mut random = Pcg64::seed_from_u64(7);
    let mut x = 50.0;
    let walk = (0..CALLS).map(|_| {
        x = f64::max(x + random.random_range(-3.0..3.0), 0.0);
        x
    });
    [
        ("random", walk.collect()),
        (
            "loading",
            (0..CALLS).map(|i| 0.02 * (i as f64 + 1.0)).collect(),
        ),
        (
            "unloading",
            (0..CALLS)
                .map(|i| 200.0 * (1.0 - 1e-5 * i as f64))
                .collect(),
        ),
    ]
}

fn measure<L: NormalLaw>(c: &mut Criterion, name: &str, law: &L, unit: f64) {
    for (kind, path) in paths() {
        let path: Vec<f64> = path.iter().map(|w| w * unit).collect();
        c.bench_function(&format!("{name}, {kind}, {CALLS} calls"), |b| {
            b.iter(|| {
                let mut history = L::History::default();
                path.iter()
                    .map(|x| law.force(black_box(*x), &mut history))
                    .sum::<f64>()
            });
        });
    }
}

fn laws(c: &mut Criterion) {
    // close to the fit of the reference material, E/Y = 80
    let units = YieldUnits {
        flattening: 7.6e-4,
        force: 3.18e6,
    };
    let curve = SoftenedHertz::new(0.87, 11.6, 1.28).expect("admissible");
    let unloading = Unloading::new(9.0, 0.66, -0.16, 8.0).expect("admissible");
    let knots = [
        [5.284, 11.528, 3.041],
        [13.71, 41.45, 3.903],
        [35.55, 134.9, 4.455],
        [92.21, 388.3, 4.397],
    ]
    .map(|[flattening, force, slope]| Knot {
        flattening,
        force,
        slope,
    });
    let spline = SplineLoading::new(2.037, &knots).expect("admissible");
    let closed = Elastoplastic::new(curve, unloading, units, 0.1).expect("admissible");
    let spline = Elastoplastic::new(spline, unloading, units, 0.1).expect("admissible");
    measure(c, "hertz", &Hertz::new(1.14e11), units.flattening);
    measure(c, "closed form", &closed, units.flattening);
    measure(c, "spline", &spline, units.flattening);
}

criterion_group!(benches, laws);
criterion_main!(benches);
