//! The C interface from C: the header is that of the source, and a C program presses contacts as this library does.

use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::export::check::driver::{FLAGS, compiler};
use impactlaw::export::check::{Ran, paths, run};
use impactlaw::export::source::portable::Portable;
use std::path::{Path, PathBuf};
use std::process::Command;

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn model() -> PathBuf {
    here().join("../../models/sac305-solder.toml")
}

/// The C program, linked with the library that was built with this test; none, said loudly, without a C compiler.
fn program(folder: &Path) -> Option<PathBuf> {
    let compiler = compiler()
        .map_err(|why| eprintln!("\n!! SKIPPED: the C interface was NOT run from C: {why}\n"))
        .ok()?;
    let libraries = std::env::current_exe().unwrap();
    let libraries = libraries.parent().unwrap();
    let program = folder.join("press");
    let mut command = Command::new(compiler);
    command.args(FLAGS);
    command.arg("-I").arg(here()).arg(here().join("press.c"));
    command.arg("-L").arg(libraries);
    command.arg(format!("-Wl,-rpath,{}", libraries.display()));
    command.args(["-limpactlaw_c", "-lm", "-o"]).arg(&program);
    let ran = run(&mut command, "").unwrap();
    assert!(ran.success, "{}", ran.stderr);
    Some(program)
}

/// Presses along a path of overlap (m) and rate (m/s).
fn press(program: &Path, radii: [f64; 2], path: &[[f64; 2]]) -> Ran {
    let mut input = String::new();
    for [overlap, rate] in path {
        input.push_str(&format!("{overlap:e} {rate:e}\n"));
    }
    let mut command = Command::new(program);
    command.arg(model()).args(radii.map(|r| format!("{r:e}")));
    let ran = run(&mut command, &input).unwrap();
    assert!(ran.success, "{}", ran.stderr);
    ran
}

#[test]
fn the_header_is_that_of_the_source() {
    let config = cbindgen::Config::from_file(here().join("cbindgen.toml")).unwrap();
    let made = cbindgen::Builder::new()
        .with_config(config)
        .with_src(here().join("lib.rs"))
        .generate()
        .unwrap();
    let mut text = Vec::new();
    made.write(&mut text);
    let text = String::from_utf8(text).unwrap();
    let file = here().join("impactlaw.h");
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    if std::env::var_os("IMPACTLAW_WRITE_HEADER").is_some() {
        std::fs::write(&file, &text).unwrap();
    } else {
        assert_eq!(
            kept, text,
            "make it anew: IMPACTLAW_WRITE_HEADER=1 cargo test -p impactlaw-c"
        );
    }
}

#[test]
fn random_paths_at_rest_are_bit_by_bit_those_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = program(folder.path()) else {
        return;
    };
    let law = Portable::read(&model(), None).unwrap();
    let radius = law.radius();
    for bodies in [paths::Bodies::Wall, paths::Bodies::Unequal(0.4)] {
        let radii = bodies.radii(radius);
        let most = law.file.valid.displacement_over_radius_max * (radii[0] + radii[1]);
        let path = paths::random(most, 20_000, 5);
        let ours = paths::pressed(&law.core, bodies, radius, &path);
        let rated: Vec<[f64; 2]> = path.iter().map(|overlap| [*overlap, 0.0]).collect();
        let ran = press(&program, radii, &rated);
        assert!(ran.stdout.starts_with("no law|"), "{}", &ran.stdout[..40]);
        assert_eq!(ran.stdout.lines().next().unwrap().len(), 7 + 11);
        let figures: Vec<[f64; 2]> = ran.rows().collect();
        let valid = law.file.valid.displacement_over_radius_max;
        assert_eq!(figures, [[valid, law.time_step_over_radius * radii[0]]]);
        let theirs: Vec<[f64; 6]> = ran.rows().collect();
        assert_eq!(theirs.len(), ours.len());
        for ((p, energy), theirs) in ours.iter().zip(&theirs) {
            let [a, b] = p.flattening;
            assert_eq!(
                [p.force, p.stiffness, p.contact_radius, a, b, *energy],
                *theirs
            );
        }
    }
}

#[test]
fn fast_first_loading_carries_inertia() {
    struct Added(f64);
    impl LawVisitor for Added {
        type Output = f64;
        fn visit<L: NormalLaw>(self, law: &L) -> f64 {
            law.inertia().force(0.05, self.0 * self.0)
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = program(folder.path()) else {
        return;
    };
    let law = Portable::read(&model(), None).unwrap();
    let (radius, speed) = (law.radius(), 20.0);
    let added = radius * radius * law.full.visit(Added(speed));
    assert!(added > 0.0);
    let at = 0.05 * radius;
    let path = [[at, speed], [at, 0.0], [at, -speed], [0.99 * at, speed]];
    let ran = press(&program, [radius, 0.0], &path);
    let force: Vec<f64> = ran.rows::<6>().map(|row| row[0]).collect();
    assert!((force[0] - force[1] - added).abs() < 1e-12 * force[0]);
    assert_eq!(force[1], force[2]);
    let unloaded = law.core.force(radius, 0.99 * at, at);
    assert!(unloaded > 0.0);
    // the span of the branch is a small part of its flattening: digits are lost
    assert!((force[3] - unloaded).abs() < 1e-12 * unloaded);
}
