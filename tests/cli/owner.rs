//! Whose impacts and whose law: fits and comparisons use the case's own, refuse others by name, and overwrite no law of another.

use crate::program::{impactlaw, message};
use impactlaw::law::LawFile;
use std::path::Path;
use tempfile::TempDir;

/// Impacts at 5 and 10 m/s, as coarse as can be asked for.
const CASE: &str = r#"[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = "100 GPa"
poisson_ratio = 0.35
yield_strength = "1.25 GPa"
[impact]
velocities = ["5 m/s", "10 m/s"]
[accuracy]
tolerance = 0.2
"#;

/// A folder with the case and its impacts in `o`.
fn simulated() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("steel.toml"), CASE).unwrap();
    run(folder.path(), &["impact", "steel.toml", "--out", "o"], 0);
    folder
}

/// What the program says on stderr when it ends with `code`.
fn run(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = impactlaw(folder, arguments);
    assert_eq!(output.status.code(), Some(code), "{}", message(&output));
    message(&output)
}

#[test]
fn a_law_is_made_of_its_own_impacts_and_no_other_law_is_overwritten() {
    let folder = simulated();
    let folder = folder.path();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let law = || LawFile::read(&folder.join("o/law.toml")).unwrap();
    run(folder, &["fit", "steel.toml", "--impacts", "o"], 0);
    assert_eq!(law().valid.velocity_min_m_s, 5.0);
    let thresholds = law().thresholds.unwrap();
    assert_eq!((thresholds.tolerance, thresholds.error), (0.2, 1.5 * 0.2));

    // another material, and another radius
    for (from, to, found) in [
        (
            "1.25 GPa",
            "1.2 GPa",
            "yield strength 1.25 GPa instead of 1.2 GPa",
        ),
        ("250 um", "1 mm", "radius 250 µm instead of 1 mm"),
    ] {
        write("other.toml", &CASE.replace(from, to));
        for verb in [
            &["fit", "other.toml", "--out", "other-law.toml"][..],
            &["compare", "other.toml", "--law", "o/law.toml"],
        ] {
            let said = run(folder, &[verb, &["--impacts", "o"]].concat(), 2);
            let named =
                said.contains(found) && (said.contains("impact_V5") || said.contains("law.toml"));
            assert!(named, "{said}");
        }
        assert!(!folder.join("other-law.toml").exists());
    }

    // the same particle in a case of another name
    write("same.toml", CASE);
    let said = run(folder, &["fit", "same.toml", "--impacts", "o"], 2);
    assert!(said.contains("the law of another case, steel"), "{said}");
    assert_eq!(law().provenance.case, "steel");

    // fewer speeds: the impact that is left over is named and not used
    write("steel.toml", &CASE.replace("\"5 m/s\", ", ""));
    let said = run(folder, &["fit", "steel.toml", "--impacts", "o"], 0);
    assert!(
        said.contains("left out, for their speeds are not the case's: impact_V5"),
        "{said}"
    );
    assert_eq!(law().valid.velocity_min_m_s, 10.0);

    // a speed without an impact
    write("steel.toml", &CASE.replace("10 m/s", "12 m/s"));
    let said = run(folder, &["fit", "steel.toml", "--impacts", "o"], 0);
    assert!(said.contains("no impacts at 12 m/s"), "{said}");

    // an impact that does not say whose it is
    let summary = folder.join("o/impact_V5/summary.json");
    let mut text: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&summary).unwrap()).unwrap();
    for key in ["particle", "sha256"] {
        text.as_object_mut().unwrap().remove(key);
    }
    std::fs::write(&summary, text.to_string()).unwrap();
    let said = run(folder, &["fit", "steel.toml", "--impacts", "o"], 2);
    assert!(said.contains("does not say whose it is"), "{said}");

    // a file that is no law
    std::fs::write(folder.join("notes.toml"), "mine").unwrap();
    let said = run(
        folder,
        &["fit", "steel.toml", "--impacts", "o", "--out", "notes.toml"],
        2,
    );
    assert!(said.contains("it is not overwritten"), "{said}");
}

#[test]
fn impact_prints_what_it_found_and_where_and_quiet_is_quiet() {
    let folder = simulated();
    let speeds = ["impact", "steel.toml", "--out", "o", "--velocity", "10 m/s"];
    let output = impactlaw(folder.path(), &speeds);
    let said = String::from_utf8(output.stdout).unwrap();
    let row = said.lines().nth(1).unwrap();
    assert!(
        row.contains("10 m/s") && row.ends_with("o/impact_V10"),
        "{said}"
    );
    for arguments in [
        &speeds[..],
        &["fit", "steel.toml", "--impacts", "o"],
        &["compare", "steel.toml", "--impacts", "o"],
    ] {
        let output = impactlaw(folder.path(), &[arguments, &["-q"]].concat());
        assert!(output.status.success(), "{}", message(&output));
        assert!(
            output.stdout.is_empty() && output.stderr.is_empty(),
            "{arguments:?}"
        );
    }
    let output = impactlaw(folder.path(), &[&speeds[..], &["-v"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        said.contains("10 m/s: ") && said.contains("steps in"),
        "{said}"
    );
    assert!(!said.contains('\u{1b}'), "colour codes in a pipe: {said:?}");
}

#[test]
fn two_fast_speeds_of_a_soft_metal_and_a_range_up_to_sticking_give_a_law() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, speeds) in [
        ("two", "\"100 m/s\", \"200 m/s\""),
        ("wide", "\"50 m/s\", \"200 m/s\", \"605 m/s\""),
    ] {
        let text = format!(
            "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"2700 kg/m3\"\nyoung_modulus = \"69 GPa\"\n\
             poisson_ratio = 0.33\nyield_strength = \"100 MPa\"\n[impact]\nvelocities = [{speeds}]\n[accuracy]\ntolerance = 0.1\n"
        );
        let file = format!("{name}.toml");
        std::fs::write(folder.join(&file), text).unwrap();
        run(folder, &["impact", &file, "--out", name], 0);
        let output = impactlaw(folder, &["fit", &file, "--impacts", name]);
        // whether the law is near enough is another question than whether there is one
        assert!(output.status.code() < Some(2), "{}", message(&output));
        LawFile::read(&folder.join(name).join("law.toml")).unwrap();
    }
}

#[test]
fn tolerances_and_numbers_of_threads_that_make_no_sense_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for tolerance in ["1e-12", "1e-30", "0.0005"] {
        let text = CASE.replace("0.2", tolerance);
        std::fs::write(folder.path().join("steel.toml"), text).unwrap();
        for verb in ["plan", "impact"] {
            let said = run(folder.path(), &[verb, "steel.toml"], 2);
            assert!(
                said.contains("accuracy.tolerance") && said.contains("must be at least 0.001"),
                "{said}"
            );
        }
    }
    std::fs::write(folder.path().join("steel.toml"), CASE).unwrap();
    let said = run(
        folder.path(),
        &["plan", "steel.toml", "--threads", "20000"],
        2,
    );
    assert!(
        said.contains("--threads: found 20000; must be at most 1024"),
        "{said}"
    );
}

#[cfg(unix)]
#[test]
fn a_path_that_is_not_utf_8_is_an_ordinary_error_and_a_case_can_come_through_a_pipe() {
    use std::io::Write;
    use std::os::unix::ffi::OsStrExt;
    use std::process::Stdio;
    let folder = tempfile::tempdir().unwrap();
    let path = std::ffi::OsStr::from_bytes(b"c\xff.toml");
    let output = crate::program::program(folder.path())
        .arg("plan")
        .arg(path)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        message(&output).contains("cannot read c"),
        "{}",
        message(&output)
    );
    let plan = |text: &str| {
        let mut child = crate::program::program(folder.path())
            .args(["plan", "/dev/stdin"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child
            .stdin
            .take()
            .unwrap()
            .write_all(text.as_bytes())
            .unwrap();
        child.wait_with_output().unwrap()
    };
    assert!(plan(CASE).status.success());
    let refused = plan(&CASE.replace("250 um", "0 um"));
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        message(&refused).contains("/dev/stdin:2:10"),
        "{}",
        message(&refused)
    );
}
