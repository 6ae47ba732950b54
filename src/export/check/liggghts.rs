//! Check of the LIGGGHTS export: the library loaded into the installed program, impacts compared with the law.

use super::impacts;
use super::process::find_program;
use crate::Result;
use crate::export::check::{Check, Finding};
use crate::export::liggghts;
use crate::export::source::portable::Portable;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Environment variable that names the folder `src` of LIGGGHTS' source.
pub const SOURCE: &str = "IMPACTLAW_LIGGGHTS_SRC";
/// Environment variable that names the program.
pub const PROGRAM: &str = "IMPACTLAW_LIGGGHTS";

/// The installed LIGGGHTS.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Installed {
    /// The program.
    pub program: PathBuf,
    /// Folder of its headers.
    pub source: PathBuf,
}

impl Installed {
    /// Where the environment says it is.
    ///
    /// # Errors
    /// What is missing and how to get it.
    pub fn find() -> std::result::Result<Self, String> {
        let program = find_program(PROGRAM, "liggghts").ok_or_else(|| {
            format!("no program: install LIGGGHTS 3.8 (Debian: apt install liggghts libopenmpi-dev), or name it in {PROGRAM}")
        })?;
        let source = std::env::var_os(SOURCE)
            .map(PathBuf::from)
            .filter(|folder| folder.join("normal_model_base.h").is_file())
            .ok_or_else(|| {
                format!("no headers: unpack LIGGGHTS' source (Debian: apt-get source --download-only liggghts) and name its folder src in {SOURCE}")
            })?;
        Ok(Installed { program, source })
    }

    /// The program with the exported law of `folder` loaded.
    #[must_use]
    pub fn command(&self, law: &Portable, folder: &Path) -> Command {
        let library = folder.join(format!("lib{}_liggghts.so", law.identifier));
        let mut command = Command::new(&self.program);
        command.env("LD_PRELOAD", OsStr::new(&library));
        command
    }

    /// The same on `ranks` processors.
    #[must_use]
    pub fn parallel_command(&self, law: &Portable, folder: &Path, ranks: usize) -> Command {
        let library = folder.join(format!("lib{}_liggghts.so", law.identifier));
        let mpirun = find_program(MPIRUN, "mpirun").unwrap_or_else(|| PathBuf::from("mpirun"));
        let mut preload = std::ffi::OsString::from("LD_PRELOAD=");
        preload.push(library);
        let mut command = Command::new(mpirun);
        // Open MPI refuses more processes than cores and the superuser unless told; containers have both.
        command
            .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
            .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
            // ranks that wait leave their core to those that work
            .env("OMPI_MCA_mpi_yield_when_idle", "1")
            .args(["--oversubscribe", "-np", &ranks.to_string(), "env"])
            .arg(preload)
            .arg(&self.program);
        command
    }
}

/// Environment variable that names the `mpirun` of the program's MPI.
pub const MPIRUN: &str = "IMPACTLAW_LIGGGHTS_MPIRUN";

/// The exported models in the installed program.
#[derive(Debug, Clone, Copy)]
pub struct LiggghtsCheck;

impl Check for LiggghtsCheck {
    fn name(&self) -> &'static str {
        "LIGGGHTS"
    }

    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding> {
        let installed = match Installed::find() {
            Ok(installed) => installed,
            Err(why) => return Ok(Finding::Skipped { why }),
        };
        let folder = impacts::write(&liggghts::export(law), scratch)?;
        impacts::build(&folder, &[&installed.source])?;
        let (with, agreements) = impacts::hold(law, &folder, || installed.command(law, &folder))?;
        Ok(Finding::Ran { with, agreements })
    }
}
