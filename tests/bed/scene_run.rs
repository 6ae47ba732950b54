//! Scenes run to their end without a word.

use impactlaw::bed::run::{BedReport, Options, run_scene};
use impactlaw::bed::scene::Scene;
use std::path::Path;
use tempfile::TempDir;

/// A run into `folder` that keeps nothing and tells nobody.
pub fn quiet(folder: &Path) -> Options<'_> {
    Options {
        folder,
        provenance: "test",
        seed: None,
        checkpoint: None,
        progress: &|_, _| (),
    }
}

/// Runs a scene in a folder of its own.
pub fn run(scene: &Scene) -> (BedReport, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let report = run_scene(scene, None, &quiet(folder.path())).unwrap();
    (report, folder)
}
