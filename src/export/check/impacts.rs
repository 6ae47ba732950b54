//! Impacts of the reference run in another code by its example input, and compared with the law's own figures.

use super::process::{Ran, run};
use crate::contact::rebound::Rebound;
use crate::export::check::{Agreement, largest};
use crate::export::source::artifact::Artifact;
use crate::export::source::describe;
use crate::export::source::portable::Portable;
use crate::export::source::reference::Impact;
use crate::files::write_atomic;
use crate::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Steps from touch to loss of contact.
const STEPS: f64 = 5_000.0;
/// Part of them that is run: the bodies are apart at the end.
const RUN: f64 = 1.05;
/// Steps between rows.
const EVERY: usize = 5;
/// Relative deviation allowed: that of so many steps is a tenth of it (velocity Verlet, second order).
const ALLOWED: f64 = 1e-5;

/// Writes an export below `scratch` and returns its folder.
pub(super) fn write(files: &[Artifact], scratch: &Path) -> Result<PathBuf> {
    for file in files {
        write_atomic(&scratch.join(&file.name), file.text.as_bytes())?;
    }
    let folder = files
        .first()
        .and_then(|file| Path::new(&file.name).parent());
    Ok(folder.map_or_else(|| scratch.to_owned(), |folder| scratch.join(folder)))
}

/// Builds what is in `folder` with its `build.sh`.
pub(super) fn build(folder: &Path, arguments: &[&Path]) -> Result<()> {
    let script = folder.join("build.sh");
    let mut command = Command::new("sh");
    run(command.arg(&script).args(arguments), "")?
        .or_fail("build with", &script)
        .map(drop)
}

/// What a code found out of one impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    pub(super) restitution: f64,
    pub(super) max_force: f64,
    pub(super) max_overlap: f64,
}

impl Found {
    /// Figures from the rows `step overlap rate force` that `program` printed of an impact at `velocity` (m/s).
    ///
    /// # Errors
    /// [`Error::File`] without rows.
    pub(super) fn of(ran: &Ran, velocity: f64, program: &Path) -> Result<Self> {
        let mut found = None;
        for [_, overlap, rate, force] in ran.rows() {
            let so_far = found.unwrap_or(Found {
                restitution: 0.0,
                max_force: 0.0,
                max_overlap: 0.0,
            });
            found = Some(Found {
                restitution: -rate / velocity,
                max_force: so_far.max_force.max(force),
                max_overlap: so_far.max_overlap.max(overlap),
            });
        }
        found.ok_or_else(|| {
            let cause = std::io::Error::other(ran.stdout.clone());
            Error::file("read the rows of", program)(cause)
        })
    }

    /// Relative deviations of e, F* and delta*.
    pub(super) fn deviations(&self, figures: &Rebound) -> [f64; 3] {
        [
            (self.restitution, figures.restitution),
            (self.max_force, figures.max_force),
            (self.max_overlap, figures.max_displacement),
        ]
        .map(|(found, expected)| (found / expected - 1.0).abs())
    }
}

/// Runs every reference impact with the program and arguments `start` makes; first line of its output, and how well it agrees.
pub(super) fn hold(
    law: &Portable,
    folder: &Path,
    start: impl Fn() -> Command,
) -> Result<(String, Vec<Agreement>)> {
    let mut version = String::new();
    let mut agreements = Vec::new();
    for impact in &law.reference.impacts {
        let mut command = start();
        command.current_dir(folder).args(["-in", "impact.in"]);
        for (name, value) in variables(impact) {
            command.arg("-var").arg(name).arg(value);
        }
        let input = folder.join("impact.in");
        let ran = run(&mut command, "")?.or_fail("run", &input)?;
        version = ran.stdout.lines().next().unwrap_or_default().to_owned();
        let found = Found::of(&ran, impact.velocity, &input)?;
        agreements.push(Agreement {
            subject: format!(
                "{}, {} m/s: e, F*, delta*",
                describe::bodies(impact),
                impact.velocity
            ),
            deviation: largest(found.deviations(&impact.figures)),
            allowed: ALLOWED,
        });
    }
    Ok((version, agreements))
}

fn variables(impact: &Impact) -> [(&'static str, String); 6] {
    let dt = impact.figures.contact_time / STEPS;
    [
        ("r1", format!("{:e}", impact.radii[0])),
        ("r2", format!("{:e}", impact.radii[1])),
        ("v", format!("{:e}", impact.velocity)),
        ("dt", format!("{dt:e}")),
        ("steps", format!("{:.0}", RUN * STEPS)),
        ("every", EVERY.to_string()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_read_from_the_rows_alone() {
        let stdout = "LAMMPS (1 Jan)\nStep v_overlap v_rate v_force\n 0 0.0 2.0 0.0\n 5 3e-6 0.5 7.0\n 10 -1e-6 -1.5 0\nLoop time of 1 on 1\n";
        let ran = Ran {
            success: true,
            stdout: stdout.to_owned(),
            stderr: String::new(),
        };
        let found = Found::of(&ran, 2.0, Path::new("in")).unwrap();
        assert_eq!(
            found,
            Found {
                restitution: 0.75,
                max_force: 7.0,
                max_overlap: 3e-6
            }
        );
    }
}
