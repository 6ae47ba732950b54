//! Command line through the real binary: bad input gives one clear error, exit code 2 and writes nothing.

use crate::program::{impactlaw, message};
use clap::CommandFactory;
use impactlaw::cli::Cli;
use impactlaw::export::Target;
use std::path::Path;
use tempfile::TempDir;

const CASE: &str = r#"[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = "100 GPa"
poisson_ratio = 0.35
yield_strength = "1.25 GPa"
[impact]
velocities = ["10 m/s"]
[accuracy]
tolerance = 0.02
"#;

/// The verbs that read a case file.
const READERS: [&[&str]; 6] = [
    &["run", "case.toml", "--out", "out"],
    &["compare", "case.toml", "--impacts", "out"],
    &["plan", "case.toml"],
    &["impact", "case.toml", "--out", "out"],
    &["fit", "case.toml", "--impacts", "out"],
    &["theory", "hertz", "case.toml", "--velocities", "10 m/s"],
];

fn folder_with(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// The command ends with code 2, says each of `parts`, prints no result and leaves the folder as it was.
fn assert_refused(folder: &TempDir, arguments: &[&str], parts: &[&str]) {
    let before = names_in(folder.path());
    let output = impactlaw(folder.path(), arguments);
    let message = message(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    for part in parts {
        assert!(
            message.contains(part),
            "{arguments:?}: no {part:?} in {message}"
        );
    }
    assert_eq!(
        message.matches("Error").count(),
        0,
        "raw error shown: {message}"
    );
    assert!(!message.contains("panicked"), "{message}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed a result");
    assert_eq!(
        names_in(folder.path()),
        before,
        "{arguments:?} wrote something"
    );
}

#[test]
fn a_bad_case_is_refused_with_place_found_and_remedy() {
    // From, to; line and column of the value; key, found, allowed.
    let bad = [
        (
            "radius =",
            "radus =",
            "case.toml:2:1",
            "`particle.radus`",
            "expected one of `radius`",
        ),
        (
            "\"250 um\"",
            "\"250\"",
            "case.toml:2:10",
            "found \"250\"",
            "\"250 um\"",
        ),
        (
            "\"250 um\"",
            "250",
            "case.toml:2:10",
            "`particle.radius`",
            "\"250 um\"",
        ),
        (
            "\"250 um\"",
            "\"-250 um\"",
            "case.toml:2:10",
            "found \"-250 um\"",
            "must be positive",
        ),
        (
            "\"250 um\"",
            "\"inf m\"",
            "case.toml:2:10",
            "found \"inf m\"",
            "\"250 um\"",
        ),
        (
            "\"100 GPa\"",
            "\"100 kg\"",
            "case.toml:5:17",
            "found \"100 kg\"",
            "\"70 GPa\"",
        ),
        (
            "\"8000 kg/m3\"",
            "\"0 kg/m3\"",
            "case.toml:4:11",
            "`material.density`",
            "must be positive",
        ),
        (
            "0.35",
            "0.5",
            "case.toml:6:17",
            "found 0.5",
            "must lie in [0, 0.5)",
        ),
        (
            "0.35",
            "nan",
            "case.toml:6:17",
            "found nan",
            "must lie in [0, 0.5)",
        ),
        (
            "\"1.25 GPa\"",
            "\"120 GPa\"",
            "case.toml:7:18",
            "found \"120 GPa\"",
            "below young_modulus (100 GPa)",
        ),
        (
            "\"10 m/s\"",
            "\"0 m/s\"",
            "case.toml:9:15",
            "`impact.velocities[0]`",
            "must be positive",
        ),
        (
            "0.02",
            "2",
            "case.toml:11:13",
            "`accuracy.tolerance`",
            "must lie in (0, 0.2]",
        ),
        (
            "[accuracy]",
            "[acuracy]",
            "case.toml:10:2",
            "`acuracy`",
            "expected one of",
        ),
        (
            "tolerance = 0.02\n",
            "",
            "case.toml:10:1",
            "`accuracy`",
            "missing field `tolerance`",
        ),
        (
            "[particle]",
            "[particle",
            "case.toml:1:10",
            "case.toml:",
            "]",
        ),
        (
            "0.02\n",
            "0.02\n[bed]\nscene = \"no.toml\"\n",
            "case.toml:13:9",
            "`bed.scene`",
            "existing file",
        ),
    ];
    for (from, to, place, key, allowed) in bad {
        assert!(CASE.contains(from), "{from}");
        let folder = folder_with(&[("case.toml", &CASE.replace(from, to))]);
        for reader in READERS {
            assert_refused(&folder, reader, &[place, key, allowed]);
        }
    }
}

#[test]
fn an_unreadable_case_is_named() {
    let folder = folder_with(&[]);
    for reader in READERS {
        assert_refused(&folder, reader, &["cannot read case.toml"]);
    }
    std::fs::write(folder.path().join("case.toml"), [0xff, 0xfe, 0x00]).unwrap();
    for reader in READERS {
        assert_refused(&folder, reader, &["cannot read case.toml", "UTF-8"]);
    }
}

#[test]
fn an_unknown_theory_is_refused_with_those_there_are() {
    let folder = folder_with(&[("case.toml", CASE)]);
    let arguments = ["theory", "herz", "case.toml", "--velocities", "1 m/s"];
    assert_refused(
        &folder,
        &arguments,
        &["found `herz`", "hertz", "kogut-etsion"],
    );
}

#[test]
fn quantities_on_the_command_line_need_units() {
    let folder = folder_with(&[("case.toml", CASE)]);
    let arguments = ["theory", "hertz", "case.toml", "--displacements", "1e-6"];
    assert_refused(
        &folder,
        &arguments,
        &["--displacements", "found \"1e-6\"", "\"250 um\""],
    );
}

#[test]
fn an_unknown_verb_or_flag_is_refused_with_usage() {
    let folder = folder_with(&[]);
    for arguments in [&["impct"][..], &["plan"], &["theory", "--colour"]] {
        let output = impactlaw(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(message(&output).contains("Usage"), "{arguments:?}");
    }
}

#[test]
fn a_verb_with_a_slip_of_the_finger_is_guessed() {
    let folder = folder_with(&[]);
    for (typed, meant) in [
        ("rnu", "run"),
        ("fti", "fit"),
        ("bd", "bed"),
        ("bedd", "bed"),
        ("impct", "impact"),
    ] {
        let said = message(&impactlaw(folder.path(), &[typed, "case.toml"]));
        assert!(said.contains(&format!("'{meant}'")), "{typed}: {said}");
    }
    let said = message(&impactlaw(folder.path(), &["xyz"]));
    assert!(!said.contains("similar"), "{said}");
}

#[test]
fn a_law_file_of_another_schema_is_refused() {
    let folder = folder_with(&[("law.toml", "schema = 99\n")]);
    let arguments = [
        "law",
        "eval",
        "law.toml",
        "--body",
        "1 mm",
        "--displacements",
        "1 um",
    ];
    assert_refused(
        &folder,
        &arguments,
        &["law.toml:1:10", "found 99", "must be 1"],
    );
    std::fs::write(folder.path().join("law.toml"), "name = \"x\"\n").unwrap();
    assert_refused(&folder, &arguments, &["`schema`", "must be 1"]);
}

#[test]
fn an_output_folder_that_cannot_be_written_is_refused_before_work_starts() {
    let folder = folder_with(&[("case.toml", CASE), ("file", "")]);
    let impact = ["impact", "case.toml", "--out", "file/out"];
    let parts = ["cannot write into output folder file/out"];
    assert_refused(&folder, &impact, &parts);
}

#[test]
fn speeds_on_the_command_line_are_checked_like_those_of_the_case() {
    let folder = folder_with(&[("case.toml", CASE)]);
    for (text, allowed) in [
        ("10", "with its unit"),
        ("0 m/s", "must be positive"),
        ("nan m/s", "\"10 m/s\""),
    ] {
        for verb in ["plan", "impact"] {
            let found = format!("--velocity: found \"{text}\"");
            assert_refused(
                &folder,
                &[verb, "case.toml", "--velocity", text],
                &[&found, allowed],
            );
        }
    }
}

#[test]
fn a_theory_prints_its_contract() {
    let folder = folder_with(&[("case.toml", CASE)]);
    let force = ["theory", "hertz", "case.toml", "--displacements", "1 um"];
    let output = impactlaw(folder.path(), &force);
    assert!(output.status.success(), "{}", message(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    let mut rows = text.lines().filter(|line| !line.starts_with('#'));
    assert_eq!(rows.next(), Some("displacement_m,force_N,contact_radius_m"));
    let row: Vec<f64> = rows
        .next()
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    // Hertz: 4/3 E* sqrt(R) delta^(3/2).
    let expected = 4.0 / 3.0 * 100e9 / (1.0 - 0.35 * 0.35) * 250e-6f64.sqrt() * 1e-6f64.powf(1.5);
    approx::assert_relative_eq!(row[1], expected, max_relative = 1e-12);
}

#[test]
fn the_whole_path_leaves_files_that_a_person_can_open() {
    let folder = folder_with(&[("case.toml", &CASE.replace("0.02", "0.1"))]);
    let output = impactlaw(folder.path(), &["run", "case.toml", "--out", "out", "-q"]);
    assert!(output.status.success(), "{}", message(&output));
    assert!(output.stderr.is_empty(), "{}", message(&output));
    let out = folder.path().join("out");
    for name in [
        "impact_V10/curve.csv",
        "impact_V10/summary.json",
        "law.toml",
        "compare.csv",
        "compare.md",
        "plots/force_displacement_V10.svg",
    ] {
        assert!(out.join(name).is_file(), "{name} is missing");
    }
    let html = std::fs::read_to_string(out.join("report.html")).unwrap();
    for text in [
        "Fitted law",
        "jackson-green",
        "impactlaw run case.toml",
        "0.1",
    ] {
        assert!(html.contains(text), "{text}");
    }
    for fetched in ["<script", "<link", "src=\"http", "href=\"http"] {
        assert!(!html.contains(fetched), "{fetched}");
    }
}

/// What a program prints when a run has ended, and the logs that every verb leaves beside its results.
#[test]
fn a_run_ends_with_its_figures_for_people_and_for_programs_and_every_verb_leaves_a_log() {
    let folder = folder_with(&[("case.toml", &CASE.replace("0.02", "0.1"))]);
    let printed = |arguments: &[&str]| {
        let output = impactlaw(folder.path(), arguments);
        assert!(output.status.success(), "{}", message(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    let text = printed(&["run", "case.toml", "--out", "out"]);
    let summary = std::fs::read_to_string(folder.path().join("out/impact_V10/summary.json"));
    let summary: serde_json::Value = serde_json::from_str(&summary.unwrap()).unwrap();
    let figure = |key: &str| summary[key].as_f64().unwrap();
    let row = text
        .lines()
        .find(|line| line.trim_start().starts_with("10 m/s"))
        .unwrap();
    let shown = impactlaw::unit::significant(figure("restitution"), 4);
    assert!(row.contains(&shown), "{row}: no {shown}");
    for (key, unit) in [("max_force_N", "N"), ("max_displacement_m", "m")] {
        let shown = impactlaw::unit::engineering(figure(key), unit, 4);
        assert!(row.contains(&shown), "{row}: no {shown}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&printed(&["run", "case.toml", "--out", "out", "--json"])).unwrap();
    assert_eq!(json["impacts"][0]["restitution"], summary["restitution"]);
    assert!(json["worst_error"].as_f64().unwrap() < 0.2);
    assert!(json["comparison"].as_array().unwrap().len() > 3);
    assert_eq!(printed(&["run", "case.toml", "--out", "out", "-q"]), "");
    let unverified = printed(&["run", "case.toml", "--out", "out", "--unverified"]);
    assert!(unverified.contains("| stronge"), "{unverified}");
    for verb in ["fit", "compare"] {
        printed(&[verb, "case.toml", "--impacts", "out"]);
    }
    for verb in ["run", "fit", "compare"] {
        let log = folder.path().join(format!("out/{verb}.log"));
        let log = std::fs::read_to_string(log).unwrap();
        assert!(
            log.contains(&format!("impactlaw {verb} case.toml")),
            "{log}"
        );
        assert!(log.contains("exit code 0"), "{log}");
    }
}

#[test]
fn curves_are_the_same_for_any_number_of_threads() {
    let curves = |threads: &str| {
        let folder = folder_with(&[("case.toml", &CASE.replace("0.02", "0.1"))]);
        let speeds = ["--velocity", "20 m/s", "--velocity", "50 m/s"];
        let arguments = [
            &["impact", "case.toml", "--out", "out", "--threads", threads][..],
            &speeds,
        ]
        .concat();
        let output = impactlaw(folder.path(), &arguments);
        assert!(output.status.success(), "{}", message(&output));
        ["20", "50"].map(|v| {
            let path = folder.path().join(format!("out/impact_V{v}/curve.csv"));
            let text = std::fs::read_to_string(path).unwrap();
            // The first line names the command, and with it the number of threads.
            text.split_once('\n').unwrap().1.to_owned()
        })
    };
    assert_eq!(curves("1"), curves("2"));
}

#[test]
fn the_tables_of_the_readme_have_every_verb_and_every_target_of_an_export() {
    let readme = include_str!("../../README.md");
    for verb in Cli::command().get_subcommands() {
        let named = |row: &str| {
            let words = row.split('|').nth(1).unwrap_or_default().replace('`', " ");
            row.starts_with("| `") && words.split([' ', ',']).any(|word| word == verb.get_name())
        };
        assert!(readme.lines().any(named), "{}", verb.get_name());
    }
    for target in Target::ALL {
        assert!(readme.contains(&format!("\n| `{target}` | ")), "{target}");
    }
}
