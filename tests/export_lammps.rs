//! The exported law in LAMMPS: single impacts, what contacts remember under several processors, and a bed.

mod codes;

use codes::{assert_close, build, put_input, put_packing, rows, skipped, soft_law, succeed, write};
use impactlaw::export::check::lammps::{Installed, LammpsCheck};
use impactlaw::export::lammps;
use impactlaw::export::portable::Portable;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The plugin of a law, built in a folder of its own.
struct Plugin {
    installed: Installed,
    law: Portable,
    folder: PathBuf,
    _scratch: tempfile::TempDir,
}

impl Plugin {
    /// None, said loudly, where LAMMPS is not installed.
    fn of(law: Portable) -> Option<Self> {
        let installed = Installed::find()
            .map_err(|why| skipped("LAMMPS", &why))
            .ok()?;
        let scratch = tempfile::tempdir().unwrap();
        let folder = write(&lammps::export(&law), scratch.path());
        build(
            &folder,
            &[&installed.include, &installed.mpi.join("include")],
        );
        Some(Plugin {
            installed,
            law,
            folder,
            _scratch: scratch,
        })
    }

    /// Rows of numbers printed by an input of `tests/data/codes` on so many processors.
    fn run(
        &self,
        input: &str,
        ranks: usize,
        variables: &[(&str, &str)],
        columns: usize,
    ) -> Vec<Vec<f64>> {
        put_input(input, &self.law, &self.folder);
        let mut command = Command::new(self.installed.mpi.join("bin/mpirun"));
        command
            .arg("-np")
            .arg(ranks.to_string())
            .arg(&self.installed.program);
        command.current_dir(&self.folder).arg("-in").arg(input);
        for (name, value) in variables {
            command.args(["-var", name, value]);
        }
        rows(&succeed(&mut command), columns)
    }
}

#[test]
fn impacts_in_lammps_are_those_of_rebound() {
    codes::every_law_agrees(&LammpsCheck);
}

#[test]
fn what_contacts_remember_follows_the_grains_between_processors() {
    let solder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let Some(plugin) = Plugin::of(Portable::read(&solder, None).unwrap()) else {
        return;
    };
    let mut ends = Vec::new();
    for (drift, ranks, newton) in [
        ("0", 1, "off"),
        ("0", 2, "off"),
        ("0", 2, "on"),
        ("200", 1, "on"),
        ("200", 2, "off"),
        ("200", 2, "on"),
    ] {
        let rows = plugin.run(
            "drift_lammps.in",
            ranks,
            &[("U", drift), ("newton", newton)],
            5,
        );
        ends.push(rows.last().unwrap().clone());
    }
    assert!(ends[0][3] > 100.0, "grains touch at the end: {:?}", ends[0]);
    assert!(ends[0][2] > 1e-6, "grains spin: {:?}", ends[0]);
    for end in &ends {
        assert_eq!(end[3], ends[0][3]);
        assert_close(end[1], ends[0][1], 1e-9, "energy of motion");
        assert_close(end[2], ends[0][2], 1e-9, "energy of spin");
    }
}

#[test]
fn a_bed_of_ten_thousand_grains_is_the_same_on_two_processors() {
    let Some(plugin) = Plugin::of(soft_law()) else {
        return;
    };
    put_packing(&plugin.folder);
    let [one, two] = [1, 2].map(|ranks| plugin.run("bed_lammps.in", ranks, &[], 4));
    codes::same_bed(&one, &two);
}
