//! Checks through a shim: dialects whose code cannot run here, compiled and run in a stand-in for its interface.

use super::impacts::Found;
use super::process::{find_program, run};
use crate::Result;
use crate::export::check::{Agreement, Check, Finding, largest};
use crate::export::source::artifact::Artifact;
use crate::export::source::describe;
use crate::export::source::portable::Portable;
use crate::export::source::reference::Impact;
use crate::export::{deme, mercurydpm};
use crate::files::write_atomic;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Steps from touch to loss of contact.
const STEPS: f64 = 20_000.0;
/// Part of them that is run: the bodies are apart at the end.
const RUN: f64 = 1.05;

/// A dialect that is run through a shim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShimCheck {
    /// DEM-Engine.
    Deme,
    /// MercuryDPM.
    MercuryDpm,
}

/// Headers of MercuryDPM that the export includes.
const MERCURY_HEADERS: [&str; 3] = [
    "Interactions/BaseInteraction.h",
    "Particles/BaseParticle.h",
    "Species/NormalForceSpecies/BaseNormalForce.h",
];

impl ShimCheck {
    /// Relative deviation allowed of e, F* and delta*; histories of DEM-Engine are single precision.
    fn allowed(self) -> f64 {
        match self {
            ShimCheck::Deme => 1e-5,
            ShimCheck::MercuryDpm => 1e-6,
        }
    }

    /// Files to be compiled: the export, and the shim named `shim.cpp`.
    fn files(self, law: &Portable) -> Vec<Artifact> {
        match self {
            ShimCheck::Deme => {
                let mut files = deme::export(law);
                let text = include_str!("deme_shim.cpp")
                    .replace("@PREREQUISITES@", &files[0].name)
                    .replace("@FORCE@", &files[1].name);
                files.push(shim(text));
                files
            }
            ShimCheck::MercuryDpm => {
                let mut files = mercurydpm::export(law);
                let text = mercurydpm::named(include_str!("mercury_shim.cpp"), law);
                files.push(shim(text));
                for header in MERCURY_HEADERS {
                    files.push(Artifact {
                        name: format!("mercurydpm/Kernel/{header}"),
                        text: include_str!("mercury_kernel.h").to_owned(),
                    });
                }
                files
            }
        }
    }
}

fn shim(text: String) -> Artifact {
    Artifact {
        name: "shim.cpp".to_owned(),
        text,
    }
}

impl Check for ShimCheck {
    fn name(&self) -> &'static str {
        match self {
            ShimCheck::Deme => "DEM-Engine, through a shim",
            ShimCheck::MercuryDpm => "MercuryDPM, through a shim",
        }
    }

    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding> {
        let Some(compiler) = find_program("CXX", "c++") else {
            return Ok(Finding::Skipped {
                why: "no C++ compiler: install one, or name it in the environment variable CXX"
                    .to_owned(),
            });
        };
        let program = compile(&compiler, &self.files(law), scratch)?;
        let mut agreements = Vec::new();
        for impact in &law.reference.impacts {
            agreements.push(Agreement {
                subject: format!(
                    "{}, {} m/s: e, F*, delta*",
                    describe::bodies(impact),
                    impact.velocity
                ),
                deviation: deviation(&program, impact)?,
                allowed: self.allowed(),
            });
        }
        Ok(Finding::Ran {
            with: "not the code itself".to_owned(),
            agreements,
        })
    }
}

fn compile(compiler: &Path, files: &[Artifact], scratch: &Path) -> Result<PathBuf> {
    for file in files {
        write_atomic(&scratch.join(&file.name), file.text.as_bytes())?;
    }
    let source = scratch.join("shim.cpp");
    let program = scratch.join("shim");
    let mut command = Command::new(compiler);
    command.args(["-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror"]);
    command.arg("-Wno-unused-variable"); // a force model may leave names of the engine unused
    command.arg("-I").arg(scratch.join("mercurydpm/Kernel"));
    command.arg(&source).arg("-o").arg(&program);
    run(&mut command, "")?.or_fail("compile", &source)?;
    Ok(program)
}

/// Largest relative deviation of e, F* and delta* of one impact from the law's own.
fn deviation(program: &Path, impact: &Impact) -> Result<f64> {
    let figures = &impact.figures;
    let mut command = Command::new(program);
    command.args(impact.radii.map(|radius| format!("{radius:e}")));
    command.args([
        format!("{:e}", impact.mass),
        format!("{:e}", impact.velocity),
        format!("{:e}", figures.contact_time / STEPS),
        format!("{:.0}", RUN * STEPS),
    ]);
    let ran = run(&mut command, "")?.or_fail("run", program)?;
    Ok(largest(
        Found::of(&ran, impact.velocity, program)?.deviations(figures),
    ))
}
