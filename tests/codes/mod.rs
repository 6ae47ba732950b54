//! Other codes in tests: laws exported and built for them, runs read, and a loud word where a code is not installed.

#![allow(dead_code, reason = "each test binary uses its part")]

use impactlaw::export::Artifact;
use impactlaw::export::check::{Check, Finding, run};
use impactlaw::export::portable::Portable;
use impactlaw::law::Form;
use std::fmt::Write;
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

/// A law of the repository for grains of 1 mm as soft as those of `tests/data/bed10k`: same E/Y and Poisson's ratio.
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

/// Writes the packing of `tests/data/bed10k` as a data file that LAMMPS and LIGGGHTS read.
pub fn put_packing(folder: &Path) {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bed10k/centres.u32");
    let bytes = std::fs::read(data).unwrap();
    let numbers = bytes
        .chunks_exact(4)
        .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let metres: Vec<f64> = numbers.map(|n| f64::from(n) * 2e-11).collect();
    let mut text = format!(
        "settled packing\n\n{} atoms\n1 atom types\n\n0 0.046 xlo xhi\n0 0.046 ylo yhi\n0 0.12 zlo zhi\n\nAtoms\n\n",
        metres.len() / 3
    );
    for (index, x) in metres.chunks_exact(3).enumerate() {
        let _ = writeln!(
            text,
            "{} 1 0.002 2500 {:.12} {:.12} {:.12}",
            index + 1,
            x[0],
            x[1],
            x[2]
        );
    }
    std::fs::write(folder.join("bed.data"), text).unwrap();
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

/// That two runs of the packing are one bed: equal while rounding has not grown, alike in the mean after 2000 steps. A
/// bed is chaotic: a grain displaced by 1e-15 m changes the energies' third digit within 200 steps.
pub fn same_bed(one: &[Vec<f64>], two: &[Vec<f64>]) {
    let (early, late) = (1, one.len() - 1);
    assert_eq!((one[early][0], one[late][0]), (50.0, 2000.0));
    assert_close(
        one[early][1],
        two[early][1],
        1e-8,
        "energy of motion after 50 steps",
    );
    assert_close(
        one[early][2],
        two[early][2],
        1e-8,
        "energy of spin after 50 steps",
    );
    assert_eq!(one[early][3], two[early][3], "contacts after 50 steps");
    assert!(one[late][3] > 40_000.0, "grains touch: {:?}", one[late]);
    assert_close(
        one[late][1],
        two[late][1],
        0.1,
        "energy of motion after 2000 steps",
    );
    assert_close(
        one[late][3],
        two[late][3],
        0.005,
        "contacts after 2000 steps",
    );
}
