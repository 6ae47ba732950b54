//! An exported law built in a folder of its own, and inputs run with it on any number of processors.

use super::{build, put_input, rows, skipped, succeed, write};
use impactlaw::export::check::{lammps as check_lammps, liggghts as check_liggghts};
use impactlaw::export::scene::Code;
use impactlaw::export::source::artifact::Artifact;
use impactlaw::export::source::portable::Portable;
use impactlaw::export::{lammps, liggghts};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex, OnceLock};

/// What a build leaves beside its sources: names and contents.
type Built = Vec<(String, Vec<u8>)>;

/// What was built, by its sources: several tests take the same law, and a compiler takes up to a quarter of a minute for it.
static BUILT: Mutex<BTreeMap<String, Arc<OnceLock<Built>>>> = Mutex::new(BTreeMap::new());

/// Files of a folder with one of these endings; all of them for none.
fn files(folder: &Path, endings: &[&str]) -> Built {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Built = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            let ends = |ending: &&str| path.extension().is_some_and(|it| it == *ending);
            path.is_file() && (endings.is_empty() || endings.iter().any(ends))
        })
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, std::fs::read(path).unwrap())
        })
        .collect();
    files.sort();
    files
}

/// A code that is installed.
pub enum Installed {
    Lammps(check_lammps::Installed),
    Liggghts(check_liggghts::Installed),
}

impl Installed {
    /// None, said loudly, where the code is not installed.
    pub fn find(code: Code) -> Option<Self> {
        match code {
            Code::Lammps => check_lammps::Installed::find()
                .map_err(|why| skipped("LAMMPS", &why))
                .map(Installed::Lammps)
                .ok(),
            Code::Liggghts => check_liggghts::Installed::find()
                .map_err(|why| skipped("LIGGGHTS", &why))
                .map(Installed::Liggghts)
                .ok(),
        }
    }

    fn exported(&self, law: &Portable) -> Vec<Artifact> {
        match self {
            Installed::Lammps(_) => lammps::export(law),
            Installed::Liggghts(_) => liggghts::export(law),
        }
    }

    /// Builds the exported law in `folder`, or puts there what the same sources were built to before.
    pub fn build(&self, folder: &Path) {
        let sources = files(folder, &["h", "cpp", "sh"]);
        let built = BUILT
            .lock()
            .unwrap()
            .entry(format!("{sources:?}"))
            .or_default()
            .clone();
        let built = built.get_or_init(|| {
            let before = files(folder, &[]);
            self.compile(folder);
            let mut after = files(folder, &[]);
            after.retain(|file| !before.contains(file));
            assert!(!after.is_empty(), "build.sh leaves something");
            after
        });
        for (name, content) in built {
            std::fs::write(folder.join(name), content).unwrap();
        }
    }

    fn compile(&self, folder: &Path) {
        match self {
            Installed::Lammps(code) => build(folder, &[&code.include, &code.mpi.join("include")]),
            Installed::Liggghts(code) => build(folder, &[&code.source]),
        }
    }

    /// The program with the law of `folder` on so many processors.
    pub fn command(&self, law: &Portable, folder: &Path, ranks: usize) -> Command {
        let mut command = match self {
            Installed::Lammps(code) => {
                let mut command = Command::new(code.mpi.join("bin/mpirun"));
                command.arg("-np").arg(ranks.to_string());
                command.arg(&code.program);
                command
            }
            Installed::Liggghts(code) if ranks == 1 => code.command(law, folder),
            Installed::Liggghts(code) => code.parallel_command(law, folder, ranks),
        };
        command.current_dir(folder);
        command
    }

    /// Name of the inputs of `tests/data/codes` for this code.
    fn input(&self, kind: &str) -> String {
        match self {
            Installed::Lammps(_) => format!("{kind}_lammps.in"),
            Installed::Liggghts(_) => format!("{kind}_liggghts.in"),
        }
    }
}

/// An exported law, built.
pub struct Exported {
    pub law: Portable,
    pub folder: PathBuf,
    installed: Installed,
    _scratch: tempfile::TempDir,
}

impl Exported {
    /// None, said loudly, where the code is not installed.
    pub fn of(law: Portable, code: Code) -> Option<Self> {
        let installed = Installed::find(code)?;
        let scratch = tempfile::tempdir().unwrap();
        let folder = write(&installed.exported(&law), scratch.path());
        installed.build(&folder);
        Some(Exported {
            law,
            folder,
            installed,
            _scratch: scratch,
        })
    }

    /// The program with the law on so many processors.
    pub fn command(&self, ranks: usize) -> Command {
        self.installed.command(&self.law, &self.folder, ranks)
    }

    /// Rows of `columns` numbers printed by the input `kind` of `tests/data/codes` on so many processors.
    pub fn run(
        &self,
        kind: &str,
        ranks: usize,
        variables: &[(&str, &str)],
        columns: usize,
    ) -> Vec<Vec<f64>> {
        let mut command = self.input(kind, ranks);
        for (name, value) in variables {
            command.args(["-var", name, value]);
        }
        rows(&succeed(&mut command), columns)
    }

    /// The same on one processor of an input that goes through lists of values.
    pub fn run_each(
        &self,
        kind: &str,
        variables: &[(&str, Vec<String>)],
        columns: usize,
    ) -> Vec<Vec<f64>> {
        let mut command = self.input(kind, 1);
        for (name, values) in variables {
            command.args(["-var", name]).args(values);
        }
        rows(&succeed(&mut command), columns)
    }

    fn input(&self, kind: &str, ranks: usize) -> Command {
        let input = self.installed.input(kind);
        put_input(&input, &self.law, &self.folder);
        let mut command = self.command(ranks);
        command.arg("-in").arg(input);
        command
    }
}
