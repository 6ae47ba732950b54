//! Cost of a call of the exported C law beside the law itself, over one random path of a body on a wall: the published laws
//! in both forms, and Hertz's theory for each of their materials.
//!
//! C is compiled with `-std=c99 -O2` by the compiler that `CC` names, else `cc`, and runs its own loop in a process of its
//! own; force and stiffness are worked out in both. The check of `export --check` allows C 1.2 times ours.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use impactlaw::export::check::driver::{Driver, compiler};
use impactlaw::export::check::paths;
use impactlaw::export::source::portable::Portable;
use impactlaw::law::file::HertzTable;
use impactlaw::law::{Form, LawFile};
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

/// Overlaps of the path.
const CALLS: usize = 50_000;
const MODELS: [&str; 2] = ["elastic-perfectly-plastic-ey80", "sac305-solder"];

/// The law of a file, the elastic one of its material included.
fn law(model: &str, form: Form) -> Portable {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut file = LawFile::read(&folder.join(model).with_extension("toml")).expect("it is there");
    file.hertz = Some(HertzTable {
        reason: "the theory beside the fit".to_owned(),
        quality: Vec::new(),
    });
    Portable::new(file, Some(form), String::new()).expect("the file has the form")
}

fn laws(c: &mut Criterion) {
    let compiler = match compiler() {
        Ok(compiler) => compiler,
        Err(why) => return eprintln!("!! SKIPPED: {why}"),
    };
    for model in MODELS {
        for (form, name) in [
            (Form::ClosedForm, "closed form"),
            (Form::Spline, "spline"),
            (Form::Hertz, "hertz"),
        ] {
            let law = law(model, form);
            let radius = law.radius();
            let most = law.file.valid.displacement_over_radius_max * radius;
            let path = paths::random(most, CALLS, 12);
            let scratch = tempfile::tempdir().expect("a folder can be made");
            let driver = Driver::of(&law, &compiler, scratch.path()).expect("C compiles");
            let mut group = c.benchmark_group(format!("{model}, {name}"));
            group
                .throughput(Throughput::Elements(CALLS as u64))
                .sample_size(20);
            group.bench_function("Rust", |b| {
                b.iter(|| paths::sum(&law.core, radius, black_box(&path)));
            });
            group.bench_function("C", |b| {
                b.iter_custom(|passes| {
                    let seconds = driver.seconds(radius, &path, passes).expect("it runs");
                    Duration::from_secs_f64(seconds)
                });
            });
            group.finish();
        }
    }
}

criterion_group!(benches, laws);
criterion_main!(benches);
