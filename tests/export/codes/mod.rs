//! Other codes in tests: laws exported and built for them, runs read, and a loud word where a code is not installed.

pub mod exported;

use impactlaw::export::c::kernel;
use impactlaw::export::check::{Check, Finding, run};
use impactlaw::export::source::artifact::Artifact;
use impactlaw::export::source::portable::Portable;
use impactlaw::law::Form;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Law files of the repository.
pub fn models() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    assert!(!files.is_empty());
    files
}

/// Every law of the repository in both fitted forms.
pub fn laws() -> Vec<Portable> {
    let forms = [Form::ClosedForm, Form::Spline];
    models()
        .iter()
        .flat_map(|file| forms.map(|form| Portable::read(file, Some(form)).unwrap()))
        .collect()
}

/// The law of solder balls in one of its forms.
pub fn solder(form: Option<Form>) -> Portable {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    Portable::read(&file, form).unwrap()
}

/// A law of the repository for grains of 1 mm as soft as those of the settled packing: same E/Y and Poisson's ratio.
pub fn soft_law() -> Portable {
    let folder = tempfile::tempdir().unwrap();
    let original =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("models/elastic-perfectly-plastic-ey80.toml");
    let text = std::fs::read_to_string(original).unwrap();
    let (modulus, soft) = (1e11, 5e7);
    let value = |key: &str| -> f64 {
        let line = text.lines().find(|line| line.starts_with(key)).unwrap();
        line.split(" = ").nth(1).unwrap().parse().unwrap()
    };
    assert_eq!(value("young_modulus_Pa"), modulus);
    let stresses = [
        "young_modulus_Pa",
        "yield_strength_Pa",
        "force_over_radius2_Pa",
    ];
    let mut scaled = text.clone();
    let mut put = |key: &str, number: f64| {
        let lines = scaled.lines().map(|line| match line.starts_with(key) {
            true => format!("{key} = {number:e}\n"),
            false => format!("{line}\n"),
        });
        scaled = lines.collect();
    };
    for key in stresses {
        put(key, value(key) * (soft / modulus));
    }
    put("density_kg_m3", 2500.0);
    put("radius_m", 1e-3);
    let speed = (soft / modulus * value("density_kg_m3") / 2500.0).sqrt();
    for key in ["velocity_min_m_s", "velocity_max_m_s"] {
        put(key, value(key) * speed);
    }
    let file = folder.path().join("law.toml");
    std::fs::write(&file, scaled).unwrap();
    Portable::read(&file, Some(Form::Spline)).unwrap()
}

/// Writes files of an export below a folder; returns the folder they are in.
pub fn write(files: &[Artifact], below: &Path) -> PathBuf {
    for file in files {
        let path = below.join(&file.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, &file.text).unwrap();
    }
    below.join(Path::new(&files[0].name).parent().unwrap())
}

/// Runs `build.sh` of a folder.
pub fn build(folder: &Path, arguments: &[&Path]) {
    let mut command = Command::new("sh");
    command.arg(folder.join("build.sh")).args(arguments);
    succeed(&mut command);
}

/// Standard output of a command that must succeed.
pub fn succeed(command: &mut Command) -> String {
    let ran = run(command, "").unwrap();
    assert!(ran.success, "{command:?}\n{}\n{}", ran.stdout, ran.stderr);
    ran.stdout
}

/// Copies an input of `tests/data/codes` into a folder, for a law.
pub fn put_input(name: &str, law: &Portable, folder: &Path) {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/codes");
    let text = std::fs::read_to_string(data.join(name)).unwrap();
    let text = kernel::named(&text, law).replace("@FILE@", &format!("{}.h", law.identifier));
    std::fs::write(folder.join(name), text.replace("@NAME@", &law.identifier)).unwrap();
}

/// Rows of `columns` numbers in what a code printed.
pub fn rows(output: &str, columns: usize) -> Vec<Vec<f64>> {
    let row = |line: &str| -> Option<Vec<f64>> {
        let words = line.split_whitespace().map(|word| word.parse().ok());
        words
            .collect::<Option<Vec<f64>>>()
            .filter(|row| row.len() == columns)
    };
    output.lines().filter_map(row).collect()
}

/// Runs a check for every law; true unless the code is not installed, which is said loudly.
pub fn every_law_agrees(check: &dyn Check) -> bool {
    for law in laws() {
        let scratch = tempfile::tempdir().unwrap();
        match check.run(&law, scratch.path()).unwrap() {
            Finding::Skipped { why } => {
                skipped(check.name(), &why);
                return false;
            }
            Finding::Ran { agreements, .. } => {
                assert_eq!(agreements.len(), law.reference.impacts.len());
                for agreement in agreements {
                    assert!(
                        agreement.holds(),
                        "{} {:?}: {agreement:?}",
                        law.name,
                        law.form
                    );
                }
            }
        }
    }
    true
}

/// Says that a code was not run.
pub fn skipped(code: &str, why: &str) {
    eprintln!("\n!! SKIPPED: the exported law was NOT run in {code}: {why}\n");
}

/// That two numbers agree within a relative deviation.
pub fn assert_close(a: f64, b: f64, allowed: f64, what: &str) {
    let deviation = (a / b - 1.0).abs();
    assert!(
        deviation <= allowed,
        "{what}: {a} and {b}, relative deviation {deviation:e}, allowed {allowed:e}"
    );
}
