//! Cost ladders through the real binary: table, CSV and figure; finished runs are kept; unknown ladders are refused.

use crate::program::impactlaw;
use crate::reference;
use std::path::Path;
use std::process::Output;

const CASE: &str = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"100 GPa\"\n\
    poisson_ratio = 0.35\nyield_strength = \"1.25 GPa\"\n[impact]\nvelocities = [\"50 m/s\"]\n[accuracy]\ntolerance = 0.02\n";

fn cost(folder: &Path, ladder: &str) -> Output {
    std::fs::write(folder.join("c.toml"), CASE).unwrap();
    let arguments = [
        "cost", "c.toml", "--quick", "--out", "o", "--ladder", ladder,
    ];
    impactlaw(folder, &arguments)
}

#[test]
fn errors_fall_along_the_ladder_and_a_second_call_repeats_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let output = cost(folder.path(), "cells, degree 2");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let done = folder.path().join("o/cost");
    let first = std::fs::read_to_string(done.join("cost_V50.csv")).unwrap();
    let rows: Vec<Vec<&str>> = first
        .lines()
        .filter(|l| !l.starts_with('#'))
        .map(|l| l.split(',').collect())
        .collect();
    let column = |key: &str| rows[0].iter().position(|k| *k == key).unwrap();
    // a ladder's name holds a comma and is quoted: one more cell than the header
    let cell = |row: usize, key: &str| -> f64 { rows[row][column(key) + 1].parse().unwrap() };
    assert_eq!(rows.len(), 7, "{first}");
    let last = rows.len() - 1;
    assert!(cell(last, "cpu_s") > cell(2, "cpu_s"));
    assert!(cell(last, "mae_displacement") < 0.5 * cell(2, "mae_displacement"));
    assert!(cell(last, "error") < 0.02);
    let log = std::fs::read_to_string(folder.path().join("o/cost.log")).unwrap();
    assert!(log.contains("impactlaw cost c.toml --quick"), "{log}");
    assert!(done.join("cost_V50.svg").is_file() && done.join("cost_V50.md").is_file());
    assert!(reference::assert_described(&done).contains("cost_V*.csv"));
    assert!(cost(folder.path(), "cells, degree 2").status.success());
    let second = std::fs::read_to_string(done.join("cost_V50.csv")).unwrap();
    assert_eq!(first, second);
}

#[test]
fn an_unknown_ladder_is_refused_with_the_names_of_all() {
    let folder = tempfile::tempdir().unwrap();
    let output = cost(folder.path(), "nonsense");
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        text.contains("--ladder") && text.contains("thesis"),
        "{text}"
    );
    assert!(!folder.path().join("o").exists());
}

#[test]
fn chapter_3_is_of_the_sphere_of_the_thesis_alone() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), CASE).unwrap();
    let output = impactlaw(
        folder.path(),
        &["cost", "c.toml", "--chapter-3", "--out", "o"],
    );
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        text.contains("--chapter-3") && text.contains("cases/thesis-3.toml"),
        "{text}"
    );
    assert!(!folder.path().join("o").exists());
}
