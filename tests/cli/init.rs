//! What `init` writes runs, nothing is overwritten; `--json` is JSON; runs leave a log.

use crate::program::{impactlaw, message, program};
use impactlaw::bed::scene::Scene;
use impactlaw::command::init::{PRESETS, text};
use serde_json::Value;
use std::path::Path;

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = impactlaw(folder, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        message(&output)
    );
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_preset_is_written_and_read_and_nothing_is_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    for preset in PRESETS {
        let name = format!("{}.toml", preset.name);
        done(folder.path(), &["init", preset.kind, "--like", preset.name]);
        let written = std::fs::read_to_string(folder.path().join(&name)).unwrap();
        assert_eq!(written, text(&preset));
        assert!(
            written.lines().filter(|line| line.contains('#')).count() > 2,
            "{name}: no comments"
        );
        match preset.kind {
            "case" => assert!(done(folder.path(), &["plan", &name]).contains("predicted")),
            _ => drop(Scene::read(&folder.path().join(&name)).unwrap()),
        }
        let again = impactlaw(folder.path(), &["init", preset.kind, "--like", preset.name]);
        assert_eq!(again.status.code(), Some(2), "{name}");
        assert!(
            message(&again).contains("nothing is overwritten"),
            "{}",
            message(&again)
        );
    }
    let wrong = impactlaw(folder.path(), &["init", "case", "--like", "drum"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(
        message(&wrong).contains("copper, solder, steel"),
        "{}",
        message(&wrong)
    );
}

#[test]
fn the_guide_shows_the_scene_that_is_written() {
    let preset = PRESETS
        .iter()
        .find(|preset| preset.name == "mixture")
        .unwrap();
    let written = text(preset);
    let (_, body) = written.split_once("explains every key.\n").unwrap();
    let guide = include_str!("../../src/guide/bed.md");
    assert!(guide.contains(&format!("```toml\n{body}```")), "{body}");
}

#[test]
fn a_new_scene_of_two_materials_runs_to_its_end_and_leaves_a_log() {
    let folder = tempfile::tempdir().unwrap();
    done(folder.path(), &["init", "scene", "--out", "mine.toml"]);
    let output = program(folder.path())
        .args(["bed", "mine.toml", "--out", "out"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", message(&output));
    // grains that yield: the law of a material is what the program is about
    let summary = folder.path().join("out/bed/own/summary.json");
    let summary: Value = serde_json::from_str(&std::fs::read_to_string(summary).unwrap()).unwrap();
    assert!(
        summary["plastic_share"].as_f64().unwrap() > 0.1,
        "{summary}"
    );
    let log = std::fs::read_to_string(folder.path().join("out/bed.log")).unwrap();
    for part in [
        "impactlaw bed mine.toml --out out",
        "version  impactlaw",
        "sha256",
        "exit code 0",
        " s\n",
    ] {
        assert!(log.contains(part), "{part}: {log}");
    }
}

#[test]
fn what_is_printed_can_be_had_as_json_and_a_run_leaves_its_plan_and_warnings_in_its_log() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    done(here, &["init", "case", "--out", "c.toml"]);
    let text = std::fs::read_to_string(here.join("c.toml")).unwrap();
    let rough = text.replace("tolerance = 0.05", "tolerance = 0.2");
    std::fs::write(
        here.join("c.toml"),
        rough.replace("\"4 m/s\", \"6 m/s\", \"8 m/s\", ", ""),
    )
    .unwrap();
    done(here, &["-q", "run", "c.toml", "--out", "out"]);
    let log = std::fs::read_to_string(here.join("out/run.log")).unwrap();
    for part in ["plan\nPlan of c", "exit code 0", "said on stderr", "sha256"] {
        assert!(log.contains(part), "{part}: {log}");
    }
    let json = |arguments: &[&str]| -> Value {
        let text = done(here, &[arguments, &["--json"]].concat());
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{arguments:?}: {error}: {text}"))
    };
    assert_eq!(
        json(&["plan", "c.toml"])["impacts"]
            .as_array()
            .unwrap()
            .len(),
        2
    );
    let force = json(&["theory", "hertz", "c.toml", "--displacements", "1 um"]);
    assert!(force[0]["force_N"].as_f64().unwrap() > 0.0);
    let eval = [
        "law",
        "eval",
        "out/law.toml",
        "--body",
        "1 mm",
        "--displacements",
        "1 um",
    ];
    assert!(json(&eval)[0]["force_N"].as_f64().unwrap() > 0.0);
    assert_eq!(json(&["fit", "c.toml", "--impacts", "out"])["name"], "c");
    let rows = json(&["compare", "c.toml", "--impacts", "out"]);
    assert!(
        rows.as_array()
            .unwrap()
            .iter()
            .any(|row| row["law"] == "mpm")
    );
}

#[test]
fn a_refused_run_leaves_no_log() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), "[particle]\n").unwrap();
    let output = impactlaw(folder.path(), &["run", "c.toml", "--out", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!folder.path().join("out").exists());
}
