//! Driver: a C program around an exported header that presses a contact along overlaps it reads.

use super::process::{Ran, find_program, run};
use crate::contact::pair::Pressed;
use crate::export::c;
use crate::export::c::kernel;
use crate::export::check::largest;
use crate::export::source::artifact::Artifact;
use crate::export::source::portable::Portable;
use crate::files::write_atomic;
use crate::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// How C is compiled: warnings are errors.
pub const FLAGS: [&str; 6] = [
    "-std=c99",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-pedantic",
];

/// The C compiler that `CC` names, else `cc`.
///
/// # Errors
/// What to do where there is none.
pub fn compiler() -> std::result::Result<PathBuf, String> {
    find_program("CC", "cc").ok_or_else(|| {
        "no C compiler: install one, or name it in the environment variable CC".to_owned()
    })
}

/// First line of what the compiler says about itself.
pub(super) fn version(compiler: &Path) -> Result<String> {
    let ran = run(Command::new(compiler).arg("--version"), "")?;
    Ok(ran.stdout.lines().next().unwrap_or_default().to_owned())
}

/// A compiled driver.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Driver {
    program: PathBuf,
}

impl Driver {
    /// Driver of the C law, its files in the existing folder `scratch`.
    ///
    /// # Errors
    /// Those of writing and compiling.
    pub fn of(law: &Portable, compiler: &Path, scratch: &Path) -> Result<Self> {
        let headers = c::export(law);
        let text = kernel::named(include_str!("driver.c"), law);
        let text = text.replace("@FILE@", &headers[0].name);
        Self::compile(&headers, &text, compiler, scratch)
    }

    /// The driver `text` beside `headers`.
    pub(super) fn compile(
        headers: &[Artifact],
        text: &str,
        compiler: &Path,
        scratch: &Path,
    ) -> Result<Self> {
        for header in headers {
            write_atomic(&scratch.join(&header.name), header.text.as_bytes())?;
        }
        let source = scratch.join("driver.c");
        write_atomic(&source, text.as_bytes())?;
        let program = scratch.join("driver");
        let mut command = Command::new(compiler);
        command.args(FLAGS).arg(&source).arg("-o").arg(&program);
        run(command.arg("-lm"), "")?.or_fail("compile", &source)?;
        Ok(Driver { program })
    }

    /// Largest deviation along a path (m) of bodies of `radii` (m; second 0: a surface) from the rows of the law, each number
    /// over its scale. NaN where rows are missing.
    pub(super) fn deviation(
        &self,
        radii: [f64; 2],
        path: &[f64],
        ours: &[Row],
        scales: &[Row],
    ) -> Result<f64> {
        let ran = self.run(&[], radii, path)?;
        let theirs: Vec<Row> = ran.rows().collect();
        if theirs.len() != ours.len() {
            return Ok(f64::NAN);
        }
        let rows = ours.iter().zip(&theirs).zip(scales);
        Ok(largest(rows.flat_map(|((ours, theirs), scale)| {
            (0..6).map(|k| off(ours[k], theirs[k], scale[k]))
        })))
    }

    /// Seconds that `passes` over a path (m) of a body of `radius` (m) on a wall take, in one loop.
    ///
    /// # Errors
    /// Those of running the driver.
    pub fn seconds(&self, radius: f64, path: &[f64], passes: u64) -> Result<f64> {
        let ran = self.run(&[passes.to_string()], [radius, 0.0], path)?;
        let row: Option<[f64; 2]> = ran.rows().next();
        row.map(|[seconds, _]| seconds).ok_or_else(|| {
            let cause = std::io::Error::other(format!("unexpected output: {}", ran.stdout));
            Error::file("read output of", &self.program)(cause)
        })
    }

    fn run(&self, arguments: &[String], radii: [f64; 2], path: &[f64]) -> Result<Ran> {
        let mut input = format!("{:e} {:e}\n", radii[0], radii[1]);
        for overlap in path {
            input.push_str(&format!("{overlap:e}\n"));
        }
        run(Command::new(&self.program).args(arguments), &input)?.or_fail("run", &self.program)
    }
}

/// What a driver prints of a step: force, stiffness, contact radius, both flattenings, depth, recoverable energy.
pub(super) type Row = [f64; 7];

/// The row of a pressed contact and its recoverable energy.
pub(super) fn row((p, energy): &(Pressed, f64)) -> Row {
    let [a, b] = p.flattening;
    [
        p.force,
        p.stiffness,
        p.contact_radius,
        a,
        b,
        p.depth,
        *energy,
    ]
}

fn off(ours: f64, theirs: f64, scale: f64) -> f64 {
    match theirs == ours {
        true => 0.0,
        false => (theirs - ours).abs() / scale,
    }
}
