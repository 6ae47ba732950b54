//! Speed of the bed: time of one step of 10 000 settled grains on one thread, by law and effects, and with the fitted law on
//! all threads; elements are particle-steps.
//!
//! Fitted laws are the solder's of `models/`, its contacts softened until a grain's weight of the packing presses them as
//! far as the packing is pressed: far past yield.

mod packing;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::law::LawFile;
use impactlaw::law::file::Form;
use impactlaw::material::YIELD_PRESSURE_RATIO;
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::thornton::Thornton;
use packing::{GRAVITY, MATERIAL, RADIUS};
use std::path::Path;
use std::time::{Duration, Instant};

/// Steps before measuring: springs are wound up and a layer of plastic contacts is made.
const WARM_UP: usize = 1000;

fn bed<C: ContactLaw, L: NormalLaw>(effects: C, law: &L) -> Bed<C> {
    let parts = Parts {
        grains: packing::packing(1),
        machine: packing::walls(1),
        gravity: GRAVITY,
        dt: 0.2 * MATERIAL.rayleigh_time(RADIUS),
        skin: 0.2 * RADIUS,
    };
    let normals = Normals {
        pair: Box::new(Model(Twins(law.clone()))),
        wall: Box::new(Model(Flat(law.clone()))),
    };
    let mut bed = Bed::new(effects, normals, parts);
    for _ in 0..WARM_UP {
        bed.step().expect("the packing is at rest");
    }
    bed
}

/// Measures a bed of any law.
struct Measure<'a, C> {
    criterion: &'a mut Criterion,
    name: &'a str,
    effects: C,
    threads: usize,
}

impl<C: ContactLaw> LawVisitor for Measure<'_, C> {
    type Output = ();

    fn visit<L: NormalLaw>(self, law: &L) {
        let mut group = self.criterion.benchmark_group("bed step");
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        let mut bed = bed(self.effects, law);
        group.throughput(Throughput::Elements(bed.grains.len() as u64));
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .expect("threads start");
        group.bench_function(self.name, |bencher| {
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
}

fn steps(criterion: &mut Criterion) {
    let hertz = Hertz::of(&MATERIAL);
    let thornton = Thornton::of(&MATERIAL, YIELD_PRESSURE_RATIO).expect("it yields");
    let (damping, friction) = (Viscous::new(0.8), Mindlin::new(&MATERIAL, 0.5));
    let all = Law::smooth().with(damping).with(friction);
    for (name, threads) in [
        ("hertz, damping, Mindlin", 1),
        ("hertz, damping, Mindlin, 2 threads", 2),
    ] {
        let effects = all.clone();
        let measure = Measure {
            criterion: &mut *criterion,
            name,
            effects,
            threads,
        };
        measure.visit(&hertz);
    }
    let measure = Measure {
        criterion: &mut *criterion,
        name: "thornton, damping, Mindlin",
        effects: all,
        threads: 1,
    };
    measure.visit(&thornton);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let solder = LawFile::read(&file).expect("a law of the repository");
    let material = solder.material();
    let mut softened = Law::smooth().with(Mindlin::new(&material, 0.5));
    softened.soften(MATERIAL.young_modulus / material.young_modulus);
    for (name, form, threads) in [
        ("fitted (closed form), Mindlin", Form::ClosedForm, 1),
        (
            "fitted (closed form), Mindlin, 2 threads",
            Form::ClosedForm,
            2,
        ),
        ("fitted (spline), Mindlin", Form::Spline, 1),
    ] {
        let law = solder.law_in(form).expect("the file has both forms");
        law.visit(Measure {
            criterion: &mut *criterion,
            name,
            effects: softened.clone(),
            threads,
        });
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
