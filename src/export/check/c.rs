//! Check of the C header: random paths against the law, its own self-test, and what a call costs.

use super::paths::{self, Bodies};
use super::process::{Ran, find_program, run};
use super::{Agreement, Check, Finding, largest};
use crate::contact::pair::Pressed;
use crate::export::portable::Portable;
use crate::export::{c, kernel};
use crate::files::write_atomic;
use crate::{Error, Result};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// What is compiled, with warnings as errors.
const DRIVER: &str = include_str!("driver.c");
const FLAGS: [&str; 6] = [
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-pedantic",
];
/// Relative deviation allowed along paths.
const PATH_ALLOWED: f64 = 1e-12;
/// Steps of a random path.
const STEPS: usize = 50_000;
/// Cost of a call of the C law over that of the law itself.
const COST_ALLOWED: f64 = 1.2;
/// Passes over the path of which the fastest counts.
const PASSES: usize = 9;

/// The header through the C compiler that `CC` names, else `cc`.
#[derive(Debug, Clone, Copy)]
pub struct CompilerCheck;

impl Check for CompilerCheck {
    fn name(&self) -> &'static str {
        "C"
    }

    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding> {
        let Some(compiler) = find_program("CC", "cc") else {
            return Ok(Finding::Skipped {
                why: "no C compiler: install one, or name it in the environment variable CC"
                    .to_owned(),
            });
        };
        let driver = compile_driver(&compiler, law, scratch)?;
        let mut agreements = Vec::new();
        for (bodies, name) in [
            (Bodies::Wall, "wall"),
            (Bodies::Twins, "equal spheres"),
            (Bodies::Unequal(0.4), "unequal spheres"),
        ] {
            agreements.push(along_paths(&driver, law, bodies, name)?);
        }
        agreements.push(self_test(&compiler, law, scratch)?);
        agreements.push(cost(&driver, law)?);
        Ok(Finding::Ran {
            with: version(&compiler)?,
            agreements,
        })
    }
}

/// First line of what the compiler says about itself.
fn version(compiler: &Path) -> Result<String> {
    let ran = run(Command::new(compiler).arg("--version"), "")?;
    Ok(ran.stdout.lines().next().unwrap_or_default().to_owned())
}

fn compile_driver(compiler: &Path, law: &Portable, scratch: &Path) -> Result<PathBuf> {
    let header = format!("{}.h", law.identifier);
    write_atomic(&scratch.join(&header), c::header(law).as_bytes())?;
    let source = scratch.join("driver.c");
    let text = kernel::named(DRIVER, law).replace("@FILE@", &header);
    write_atomic(&source, text.as_bytes())?;
    let driver = scratch.join("driver");
    let mut command = Command::new(compiler);
    command.args(FLAGS).arg(&source).arg("-o").arg(&driver);
    run(command.arg("-lm"), "")?.or_fail("compile", &source)?;
    Ok(driver)
}

/// Radii and overlaps as the driver reads them.
fn input(radii: [f64; 2], path: &[f64]) -> String {
    let mut text = format!("{:e} {:e}\n", radii[0], radii[1]);
    for overlap in path {
        text.push_str(&format!("{overlap:e}\n"));
    }
    text
}

fn along_paths(driver: &Path, law: &Portable, bodies: Bodies, name: &str) -> Result<Agreement> {
    let radius = law.radius();
    let radii = bodies.radii(radius);
    let sides = radii[0] + radii[1];
    let path = paths::random(
        law.file.valid.displacement_over_radius_max * sides,
        STEPS,
        11,
    );
    let ours = paths::pressed(&law.core, bodies, radius, &path);
    let ran = run(&mut Command::new(driver), &input(radii, &path))?.or_fail("run", driver)?;
    let theirs = rows(&ran, driver)?;
    let deviation = match theirs.len() == ours.len() {
        true => largest(
            ours.iter()
                .zip(&theirs)
                .map(|(ours, theirs)| farthest(ours, theirs)),
        ),
        false => f64::NAN,
    };
    Ok(Agreement {
        subject: format!(
            "random paths, {name}, {STEPS} steps: force, stiffness, radius, flattening, energy"
        ),
        deviation,
        allowed: PATH_ALLOWED,
    })
}

/// Largest relative deviation of the six numbers of a step.
fn farthest((ours, energy): &(Pressed, f64), theirs: &[f64; 6]) -> f64 {
    let [a, b] = ours.flattening;
    let ours = [
        ours.force,
        ours.stiffness,
        ours.contact_radius,
        a,
        b,
        *energy,
    ];
    let off = |(ours, theirs): (&f64, &f64)| match theirs == ours {
        true => 0.0,
        false => (theirs - ours).abs() / ours.abs(),
    };
    largest(ours.iter().zip(theirs).map(off))
}

fn rows(ran: &Ran, driver: &Path) -> Result<Vec<[f64; 6]>> {
    let row = |line: &str| -> Option<[f64; 6]> {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map_while(|word| word.parse().ok())
            .collect();
        numbers.try_into().ok()
    };
    ran.stdout
        .lines()
        .map(|line| row(line).ok_or_else(|| unreadable(driver, line)))
        .collect()
}

fn unreadable(program: &Path, line: &str) -> Error {
    let cause = std::io::Error::other(format!("unexpected output: {line}"));
    Error::file("read output of", program)(cause)
}

/// The header's own test; the deviation is the number of figures that miss.
fn self_test(compiler: &Path, law: &Portable, scratch: &Path) -> Result<Agreement> {
    let header = scratch.join(format!("{}.h", law.identifier));
    let program = scratch.join("self_test");
    let macro_name = kernel::named("-DLAW_SELF_TEST", law);
    let mut command = Command::new(compiler);
    command.args(FLAGS).arg(macro_name).args(["-x", "c"]);
    command.arg(&header).arg("-o").arg(&program).arg("-lm");
    run(&mut command, "")?.or_fail("compile", &header)?;
    let ran = run(&mut Command::new(&program), "")?;
    let misses = ran.stdout.matches("MISS").count();
    let done = ran.stdout.lines().count() == law.reference.impacts.len();
    Ok(Agreement {
        subject: "self-test: figures of the reference impacts that miss".to_owned(),
        deviation: match done && ran.success == (misses == 0) {
            true => misses as f64,
            false => f64::NAN,
        },
        allowed: 0.0,
    })
}

/// Time of a call of the C law over that of a call of the law itself, on the random path of a body on a wall.
fn cost(driver: &Path, law: &Portable) -> Result<Agreement> {
    let radius = law.radius();
    let most = law.file.valid.displacement_over_radius_max * radius;
    let path = paths::random(most, STEPS, 12);
    let text = input([radius, 0.0], &path);
    let ran = run(Command::new(driver).arg(PASSES.to_string()), &text)?.or_fail("run", driver)?;
    let theirs: f64 = ran
        .stdout
        .split_whitespace()
        .next()
        .and_then(|word| word.parse().ok())
        .ok_or_else(|| unreadable(driver, &ran.stdout))?;
    let mut ours = f64::INFINITY;
    for _ in 0..PASSES {
        let start = Instant::now();
        black_box(paths::sum(&law.core, radius, black_box(&path)));
        ours = ours.min(start.elapsed().as_secs_f64() / path.len() as f64);
    }
    Ok(Agreement {
        subject: format!(
            "cost of a call over ours ({:.0} ns over {:.0} ns)",
            theirs * 1e9,
            ours * 1e9
        ),
        deviation: theirs / ours,
        allowed: COST_ALLOWED,
    })
}
