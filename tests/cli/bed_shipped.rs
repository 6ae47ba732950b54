//! Shipped scenes through the real binary, to their ends: every grain stays and the energy balance closes to 1 %.

use crate::program::{message, program};
use crate::reference::assert_described;
use std::path::Path;

/// Runs a scene of `cases/` and checks the summary of every run in it.
fn closes(name: &str) {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
    let scratch = tempfile::tempdir().unwrap();
    let mut command = program(scratch.path());
    command.arg("bed").arg(&case).arg("-o").arg(scratch.path());
    let output = command.output().unwrap();
    let said = message(&output);
    assert!(output.status.success(), "{name}: {said}");
    let mut runs = 0;
    for folder in std::fs::read_dir(scratch.path().join("bed")).unwrap() {
        let Ok(text) = std::fs::read_to_string(folder.unwrap().path().join("summary.json")) else {
            continue;
        };
        runs += 1;
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let closure = summary["energy_closure"].as_f64().unwrap();
        assert!(
            closure < 0.01,
            "{name}: the energy balance is off by {closure}"
        );
        assert_eq!(summary["lost_grains"], 0, "{name}");
        assert_eq!(summary["status"], "ok", "{name}");
    }
    assert!(runs > 0, "{name}: no run left a summary");
    // a bed that is not compressed is no oedometer
    let compresses = std::fs::read_to_string(&case)
        .unwrap()
        .contains("\"compress\"");
    let met = assert_described(scratch.path());
    assert_eq!(met.contains("oedometer.csv"), compresses, "{name}");
}

#[test]
#[ignore = "150 s of one core"]
fn the_oedometer_closes() {
    closes("bed-oedometer");
}

#[test]
#[ignore = "two minutes of one core"]
fn the_peening_closes() {
    closes("bed-peen");
}

#[test]
#[ignore = "two minutes of one core"]
fn the_impact_closes() {
    closes("bed-impact");
}

#[test]
#[ignore = "two minutes of one core"]
fn the_heap_closes() {
    closes("bed-repose");
}

#[test]
#[ignore = "35 s of one core"]
fn the_drum_closes() {
    closes("bed-drum");
}

#[test]
#[ignore = "60 s of one core"]
fn the_silo_closes() {
    closes("bed-hopper");
}

#[test]
#[ignore = "3 minutes of one core"]
fn the_silo_of_the_benchmark_closes() {
    closes("benchmark-silo");
}

#[test]
#[ignore = "a minute of one core"]
fn the_drum_of_the_benchmark_closes() {
    closes("benchmark-drum");
}

#[test]
#[ignore = "4 minutes of one core"]
fn the_penetration_of_the_benchmark_closes() {
    closes("benchmark-penetration");
}
