//! Check of the C header: random paths against the law, its own self-test, and what a call costs.

use super::driver::{Driver, FLAGS, Row, compiler, row, version};
use super::pair_law;
use super::paths::{self, Bodies};
use super::process::run;
use crate::Result;
use crate::export::c::kernel;
use crate::export::check::{Agreement, Check, Finding};
use crate::export::source::portable::Portable;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Relative deviation allowed along paths.
pub(super) const PATH_ALLOWED: f64 = 1e-12;
/// Steps of a random path.
pub(super) const STEPS: usize = 50_000;
/// Cost of a call of the C law over that of the law itself.
const COST_ALLOWED: f64 = 1.2;
/// Runs of which the fastest counts, and passes over the path in each.
const PASSES: (usize, u64) = (5, 4);

/// The header through the C compiler that `CC` names, else `cc`.
#[derive(Debug, Clone, Copy)]
pub struct CompilerCheck;

impl Check for CompilerCheck {
    fn name(&self) -> &'static str {
        "C"
    }

    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding> {
        let compiler = match compiler() {
            Ok(compiler) => compiler,
            Err(why) => return Ok(Finding::Skipped { why }),
        };
        if let Some(bodies) = law.pair() {
            let mut agreements =
                pair_law::along_paths(law, bodies, &compiler, scratch, (STEPS, PATH_ALLOWED))?;
            agreements.push(self_test(&compiler, law, scratch)?);
            return Ok(Finding::Ran {
                with: version(&compiler)?,
                agreements,
            });
        }
        let driver = Driver::of(law, &compiler, scratch)?;
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

fn along_paths(driver: &Driver, law: &Portable, bodies: Bodies, name: &str) -> Result<Agreement> {
    let radius = law.radius();
    let radii = bodies.radii(radius);
    let sides = radii[0] + radii[1];
    let path = paths::random(
        law.file.valid.displacement_over_radius_max * sides,
        STEPS,
        11,
    );
    let ours = paths::pressed(&law.core, bodies, radius, &path);
    let ours: Vec<Row> = ours.iter().map(row).collect();
    Ok(Agreement {
        subject: paths::subject(name, STEPS),
        deviation: driver.deviation(radii, &path, &ours, &ours)?,
        allowed: PATH_ALLOWED,
    })
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
fn cost(driver: &Driver, law: &Portable) -> Result<Agreement> {
    let radius = law.radius();
    let most = law.file.valid.displacement_over_radius_max * radius;
    let path = paths::random(most, STEPS, 12);
    let (runs, passes) = PASSES;
    let calls = passes as f64 * path.len() as f64;
    let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..runs {
        theirs = theirs.min(driver.seconds(radius, &path, passes)? / calls);
        let start = Instant::now();
        for _ in 0..passes {
            black_box(paths::sum(&law.core, radius, black_box(&path)));
        }
        ours = ours.min(start.elapsed().as_secs_f64() / calls);
    }
    Ok(Agreement {
        subject: format!(
            "cost of a call over ours ({:.1} ns over {:.1} ns)",
            theirs * 1e9,
            ours * 1e9
        ),
        deviation: theirs / ours,
        allowed: COST_ALLOWED,
    })
}
