//! The exported C law is the law: compiled without a warning and run along random paths; and what `export` refuses.

use impactlaw::export::c;
use impactlaw::export::check::{Check, CompilerCheck, Finding};
use impactlaw::export::portable::Portable;
use impactlaw::law::{Form, LawFile};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn models() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

/// Every form of every published law, and the elastic law of each material.
fn laws() -> Vec<Portable> {
    let mut laws = Vec::new();
    for path in models() {
        for form in [Form::ClosedForm, Form::Spline] {
            laws.push(Portable::read(&path, Some(form)).unwrap());
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let elastic = LawFile {
            hertz: Some(impactlaw::law::file::HertzTable {
                reason: "elastic".to_owned(),
                quality: Vec::new(),
            }),
            ..toml::from_str(&text).unwrap()
        };
        laws.push(Portable::new(elastic, Some(Form::Hertz), "none".to_owned()).unwrap());
    }
    laws
}

/// Deviations of the check by subject; `None` without a compiler.
fn agreements(law: &Portable) -> Option<Vec<(String, f64, bool)>> {
    let folder = tempfile::tempdir().unwrap();
    match CompilerCheck.run(law, folder.path()).unwrap() {
        Finding::Ran { agreements, .. } => Some(
            agreements
                .into_iter()
                .map(|a| (a.subject.clone(), a.deviation, a.holds()))
                .collect(),
        ),
        Finding::Skipped { why } => {
            eprintln!("SKIPPED: {why}");
            None
        }
    }
}

#[test]
fn every_published_law_in_c_agrees_with_rust_to_1e_12_and_gives_its_reference_impacts() {
    for law in laws() {
        let Some(agreements) = agreements(&law) else {
            return;
        };
        assert_eq!(agreements.len(), 5);
        // the cost depends on what else the machine does
        for (subject, deviation, holds) in agreements {
            let timed = subject.starts_with("cost");
            assert!(
                holds || timed,
                "{} {:?} {subject}: {deviation:e}",
                law.name,
                law.form
            );
        }
    }
}

#[test]
fn a_wrong_constant_is_found_by_the_check() {
    let file = LawFile::read(&models()[0]).unwrap();
    let right = Portable::new(file.clone(), Some(Form::ClosedForm), String::new()).unwrap();
    let mut other = file;
    if let Some(table) = &mut other.closed_form {
        table.unloading.exponent_strain *= 1.0 + 1e-4;
    }
    let wrong = Portable {
        core: other.law_in(Form::ClosedForm).unwrap(),
        reference: right.reference.clone(),
        ..right
    };
    // the header is written from `core`, the reference from the right law: its self-test must miss, not the paths
    if let Some(agreements) = agreements(&wrong) {
        assert!(agreements[0].2);
        assert!(!agreements[3].2, "{agreements:?}");
    }
}

#[test]
fn the_header_says_what_a_user_of_it_has_to_know() {
    let law = Portable::read(&models()[0], None).unwrap();
    let text = c::header(&law);
    for words in [
        "Units: SI",
        "E* = E/(1 - nu^2)",
        "Valid: delta/R up to 0.0699",
        "from 10 to 50 m/s",
        "Suggested time step",
        "Reset: to 0 when the bodies no longer overlap",
        &law.hash,
        "Reference impacts",
        "Trajectory",
        "THESIS_4_4_SELF_TEST",
        "thesis_4_4_wall",
        "thesis_4_4_inertia",
    ] {
        assert!(text.contains(words), "{words}");
    }
    assert!(!text.contains("law_") && !text.contains("LAW_FUNCTION_"));
}

fn impactlaw(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_impactlaw"))
        .args(arguments)
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .output()
        .unwrap()
}

#[test]
fn bad_arguments_give_one_error_and_write_nothing() {
    let model = models()[0].display().to_string();
    let folder = tempfile::tempdir().unwrap();
    for (arguments, words) in [
        (vec!["--to", "abaqus"], "must be one of c,"),
        (vec![], "name one or more of c,"),
        (
            vec!["--to", "c", "--form", "cubic"],
            "closed_form, spline, hertz",
        ),
        (
            vec!["--to", "c", "--form", "hertz"],
            "is not in the law file, which holds closed_form, spline",
        ),
    ] {
        let mut all = vec!["export", &model, "-o", "out"];
        all.extend(arguments);
        let output = impactlaw(folder.path(), &all);
        assert_eq!(output.status.code(), Some(2));
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(message.contains(words), "{message}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

#[test]
fn the_table_gives_the_law_back() {
    let folder = tempfile::tempdir().unwrap();
    let model = models()[0].display().to_string();
    let output = impactlaw(folder.path(), &["export", &model, "--to", "table"]);
    assert_eq!(output.status.code(), Some(0));
    let path = folder.path().join("out/thesis-4-4/export/thesis_4_4.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let law = LawFile::read(&models()[0]).unwrap().law().unwrap();
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let rows: Vec<[f64; 3]> = reader.deserialize().map(|row| row.unwrap()).collect();
    assert_eq!(rows.len(), 40 * 41);
    for branch in rows.chunks(41) {
        assert!(branch[0][2].abs() < 1e-9 * branch[40][2]);
        for [most, x, force] in branch {
            let radius = 1e-3;
            let ours = law.force(radius, x * radius, most * radius);
            approx::assert_abs_diff_eq!(
                force * radius * radius,
                ours,
                epsilon = 1e-9 * branch[40][2] * radius * radius
            );
        }
    }
}
