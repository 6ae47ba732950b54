//! The exported law in LIGGGHTS: single impacts, what contacts remember under several processors, and a bed.

mod codes;

use codes::{assert_close, build, put_input, put_packing, rows, skipped, soft_law, succeed, write};
use impactlaw::export::check::liggghts::{Installed, LiggghtsCheck};
use impactlaw::export::liggghts;
use impactlaw::export::portable::Portable;
use std::path::{Path, PathBuf};

/// The library of a law, built in a folder of its own.
struct Library {
    installed: Installed,
    law: Portable,
    folder: PathBuf,
    _scratch: tempfile::TempDir,
}

impl Library {
    /// None, said loudly, where LIGGGHTS is not installed.
    fn of(law: Portable) -> Option<Self> {
        let installed = Installed::find()
            .map_err(|why| skipped("LIGGGHTS", &why))
            .ok()?;
        let scratch = tempfile::tempdir().unwrap();
        let folder = write(&liggghts::export(&law), scratch.path());
        build(&folder, &[&installed.source]);
        Some(Library {
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
        let mut command = match ranks {
            1 => self.installed.command(&self.law, &self.folder),
            _ => self
                .installed
                .parallel_command(&self.law, &self.folder, ranks),
        };
        command.current_dir(&self.folder).arg("-in").arg(input);
        for (name, value) in variables {
            command.args(["-var", name, value]);
        }
        rows(&succeed(&mut command), columns)
    }
}

#[test]
fn impacts_in_liggghts_are_those_of_rebound() {
    codes::every_law_agrees(&LiggghtsCheck);
}

#[test]
fn the_law_goes_with_the_tangential_and_rolling_models_of_liggghts_on_any_processors() {
    let solder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let Some(library) = Library::of(Portable::read(&solder, None).unwrap()) else {
        return;
    };
    let own = library.law.identifier.clone();
    for (tangential, rolling) in [
        ("off", "off"),
        ("no_history", "cdt"),
        ("history", "epsd"),
        ("history", "epsd3"),
        (own.as_str(), "epsd2"),
    ] {
        let mut ends = Vec::new();
        for (drift, ranks) in [("0", 1), ("0", 2), ("200", 2)] {
            let variables = [("U", drift), ("T", tangential), ("RF", rolling)];
            let rows = library.run("drift_liggghts.in", ranks, &variables, 5);
            ends.push(rows.last().unwrap().clone());
        }
        assert!(
            ends[0][3] > 100.0,
            "{tangential} {rolling}: grains touch at the end: {:?}",
            ends[0]
        );
        for end in &ends {
            assert_eq!(end[3], ends[0][3], "{tangential} {rolling}");
            // A drift is seen by what depends on the frame only through rounding of the coordinates.
            assert_close(end[1], ends[0][1], 1e-6, "energy of motion");
        }
    }
}

#[test]
fn a_bed_of_ten_thousand_grains_is_the_same_on_two_processors() {
    let Some(library) = Library::of(soft_law()) else {
        return;
    };
    put_packing(&library.folder);
    let [one, two] = [1, 2].map(|ranks| library.run("bed_liggghts.in", ranks, &[], 4));
    codes::same_bed(&one, &two);
}
