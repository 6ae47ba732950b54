//! Flipped bits in kept files: found, or without any effect. Law, case, scene and study files are meant to be edited by hand
//! and carry no sum; what they say is checked when they are read.

use crate::impacts;
use crate::program::{impactlaw, message, program};
use crate::runs::{Kept, assert_same, files};
use impactlaw::curve::Impact;
use impactlaw::files::{Sum, sum_of, with_sum};
use impactlaw::study::{KeptRun, group};
use impactlaw::tape::unsealed;
use impactlaw::view::film::Film;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Flips of each kind of kept file: together a thousand.
const FLIPS: usize = 167;

/// Flips bits of `path`, each alone, and asks of each whether it `holds`; the file is as it was afterwards.
fn flip(path: &Path, seed: u64, holds: impl Fn() -> bool) -> usize {
    let bytes = std::fs::read(path).unwrap();
    let mut random = Pcg64::seed_from_u64(seed);
    for _ in 0..FLIPS {
        let bit = random.random_range(0..8 * bytes.len());
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(path, flipped).unwrap();
        assert!(holds(), "bit {bit} of {}", path.display());
    }
    std::fs::write(path, bytes).unwrap();
    FLIPS
}

/// Kills a run of `verb` once the file that `kept` finds is there.
fn interrupt(verb: Kept, folder: &Path, kept: impl Fn() -> Option<PathBuf>) -> PathBuf {
    let mut child = verb.command(folder).spawn().unwrap();
    let began = Instant::now();
    let found = loop {
        if let Some(path) = kept() {
            break path;
        }
        assert!(child.try_wait().unwrap().is_none(), "{verb:?} ended before");
        assert!(
            began.elapsed() < Duration::from_secs(60),
            "{verb:?} keeps nothing"
        );
    };
    child.kill().unwrap();
    child.wait().unwrap();
    found
}

/// A file of this name below the results.
fn below(folder: &Path, name: &str) -> Option<PathBuf> {
    let home = folder.join("results");
    let all = if home.exists() {
        found(&home)
    } else {
        Vec::new()
    };
    all.into_iter().find(|path| path.ends_with(name))
}

/// Files below a folder that is being written to.
fn found(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    paths
        .flat_map(|path| match path.is_dir() {
            true => found(&path),
            false => vec![path],
        })
        .collect()
}

#[test]
fn none_of_a_thousand_flipped_bits_changes_a_result_in_silence() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut flips = 0;
    // runs under way
    for (verb, name) in [(Kept::Impact, "checkpoint.bin"), (Kept::Bed, "restart.bin")] {
        let kept = interrupt(verb, folder, || below(folder, name));
        let is_refused = || unsealed(std::fs::read(&kept).unwrap()).is_none();
        assert!(!is_refused(), "{name} is whole");
        flips += flip(&kept, 1, is_refused);
    }
    let film = below(folder, "film/00000.bin").unwrap();
    let frames = Film::new(film.parent().unwrap());
    assert!(frames.frame(0).is_ok());
    flips += flip(&film, 2, || frames.frame(0).is_err());
    // finished impacts, as `fit` and `compare` read them
    Kept::Impact.finish(folder);
    let home = folder.join("results/impact_V40");
    let whole = Impact::read(&home).unwrap();
    let is_refused_or_same = || Impact::read(&home).ok().is_none_or(|found| found == whole);
    for name in ["curve.csv", "summary.json"] {
        flips += flip(&home.join(name), 3, is_refused_or_same);
    }
    // marks of a study's finished runs
    let case = impacts::case(impacts::MATERIAL, &[40.0]);
    let name = group(&case);
    KeptRun::of(&case, &name).write(&home).unwrap();
    let own = KeptRun::figures(&home, &name, &case).unwrap();
    let found = || KeptRun::figures(&home, &name, &case);
    flips += flip(&home.join(KeptRun::FILE), 4, || {
        found().is_none_or(|found| found == own)
    });
    assert!(flips >= 1000, "{flips}");
}

#[test]
fn footprints_of_a_cost_study_carry_their_sum() {
    let text = with_sum(&impacts::summary(1.0, [1.0; 5]), b"").unwrap();
    assert_eq!(sum_of(&text, b""), Sum::Fits);
    assert_eq!(sum_of(&text.replace("1.0", "1.5"), b""), Sum::Differs);
}

/// Flips a bit in the middle of a file.
fn damage(path: &Path) {
    let mut bytes = std::fs::read(path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn damaged_files_are_refused_or_made_again_in_words_that_say_so() {
    let (folder, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let folder = folder.path();
    // a bed is not thrown away: its user decides
    let kept = interrupt(Kept::Bed, folder, || below(folder, "restart.bin"));
    damage(&kept);
    let output = Kept::Bed.command(folder).output().unwrap();
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("restart.bin") && said.contains("damaged"),
        "{said}"
    );
    std::fs::remove_dir_all(folder.join("results")).unwrap();
    // an impact is begun anew
    let kept = interrupt(Kept::Impact, folder, || below(folder, "checkpoint.bin"));
    damage(&kept);
    let said = Kept::Impact.finish(folder);
    assert!(said.contains("is damaged: begun anew"), "{said}");
    Kept::Impact.finish(whole.path());
    assert_same(folder, whole.path(), "after a damaged checkpoint");
    // and no law is fitted to a damaged one
    damage(&folder.join("results/impact_V40/curve.csv"));
    let output = impactlaw(folder, &["fit", "case.toml", "--impacts", "results"]);
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("`sha256` does not fit"), "{said}");
    std::fs::remove_dir_all(folder.join("results")).unwrap();
    std::fs::remove_dir_all(whole.path().join("results")).unwrap();
    // a run of a study is made again
    Kept::Study.finish(folder);
    Kept::Study.finish(whole.path());
    damage(&below(folder, "curve.csv").unwrap());
    let said = Kept::Study.finish(folder);
    assert!(said.contains("the run is begun anew"), "{said}");
    assert_same(folder, whole.path(), "after a damaged run of a study");
    assert!(files(folder).len() > 5);
}

#[test]
fn figures_without_a_sum_are_used_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    Kept::Impact.finish(folder.path());
    let summary = folder.path().join("results/impact_V40/summary.json");
    let text = std::fs::read_to_string(&summary).unwrap();
    let (figures, _) = text.rsplit_once(",\n  \"sha256\"").unwrap();
    std::fs::write(&summary, format!("{figures}\n}}\n")).unwrap();
    let mut command = program(folder.path());
    command.args(["fit", "case.toml", "--impacts", "results"]);
    let said = message(&command.output().unwrap());
    assert!(said.contains("has no `sha256`"), "{said}");
}
