//! Studies through the real binary: the file contract, equal groups run once, finished runs kept.

use crate::program::{impactlaw, message};
use impactlaw::curve::Impact;
use std::path::Path;
use std::process::Output;

const STUDY: &str = r#"
[particle]
radius = ["250 um"]
[material]
density = ["2000 kg/m3", "8000 kg/m3"]
young_modulus = ["100 GPa"]
young_over_yield = [80]
poisson_ratio = [0.35]
[impact]
velocities = ["20 m/s", "40 m/s"]
[accuracy]
tolerance = 0.2
"#;

fn study(folder: &Path) -> Output {
    impactlaw(folder, &["study", "s.toml", "--out", "results"])
}

#[test]
fn equal_groups_run_once_and_a_second_call_repeats_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), STUDY).unwrap();
    let output = study(folder.path());
    assert!(output.status.success(), "{}", message(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    // 2000 kg/m3 at 40 m/s is 8000 kg/m3 at 20 m/s
    assert!(
        text.starts_with("4 cases, 3 runs, 4 with status ok"),
        "{text}"
    );
    let results = folder.path().join("results/results.csv");
    let first = std::fs::read_to_string(&results).unwrap();
    let rows: Vec<&str> = first.lines().filter(|l| !l.starts_with('#')).collect();
    assert!(rows[0].starts_with(
        "density_kg_m3,young_modulus_Pa,yield_strength_Pa,hardening_modulus_Pa,poisson_ratio,radius_m,velocity_m_s,restitution,max_force_N"
    ));
    assert!(rows[0].ends_with("points,steps,wall_s,status"));
    assert_eq!(rows.len(), 5);
    let cell = |row: usize, key: &str| -> f64 {
        let column = rows[0].split(',').position(|k| k == key).unwrap();
        rows[row].split(',').nth(column).unwrap().parse().unwrap()
    };
    assert_eq!(
        (cell(2, "velocity_m_s"), cell(3, "velocity_m_s")),
        (40.0, 20.0)
    );
    assert_eq!(cell(2, "restitution"), cell(3, "restitution"));
    assert!((cell(3, "contact_time_s") / cell(2, "contact_time_s") - 2.0).abs() < 1e-12);
    let overview = std::fs::read_to_string(folder.path().join("results/study.md")).unwrap();
    assert!(overview.contains("| all | 3 | 3 |"), "{overview}");
    // the wall times in the second table are those of the first: nothing was run again
    assert!(study(folder.path()).status.success());
    assert_eq!(first, std::fs::read_to_string(&results).unwrap());
}

/// One run of 8000 kg/m3 at 20 m/s in `folder`: F*, delta*, contact time, and the wall time that tells whether it was run again.
fn figures(folder: &Path, radius: &str, density: &str, modulus: &str, speed: &str) -> [f64; 4] {
    let text = STUDY
        .replace("[\"250 um\"]", &format!("[\"{radius}\"]"))
        .replace(
            "[\"2000 kg/m3\", \"8000 kg/m3\"]",
            &format!("[\"{density}\"]"),
        )
        .replace("[\"100 GPa\"]", &format!("[\"{modulus}\"]"))
        .replace("[\"20 m/s\", \"40 m/s\"]", &format!("[\"{speed}\"]"));
    std::fs::write(folder.join("s.toml"), text).unwrap();
    assert!(study(folder).status.success());
    let table = std::fs::read_to_string(folder.join("results/results.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|l| !l.starts_with('#'))
        .map(|l| l.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 2);
    [
        "max_force_N",
        "max_displacement_m",
        "contact_time_s",
        "wall_s",
    ]
    .map(|key| {
        let column = rows[0].iter().position(|k| *k == key).unwrap();
        rows[1][column].parse().unwrap()
    })
}

#[test]
fn kept_runs_are_shared_through_their_groups_and_scaled_by_the_file_s_own_units() {
    let folder = tempfile::tempdir().unwrap();
    let first = figures(folder.path(), "250 um", "8000 kg/m3", "100 GPa", "20 m/s");
    // the same groups: four times the radius, a quarter of the density, twice the modulus
    let speed = format!("{} m/s", 20.0 * 8f64.sqrt());
    let scaled = figures(folder.path(), "1 mm", "2000 kg/m3", "200 GPa", &speed);
    assert_eq!(scaled[3], first[3], "the kept run is shared");
    for (k, factor) in [32.0, 4.0, 4.0 / 8f64.sqrt()].into_iter().enumerate() {
        assert!((scaled[k] / first[k] / factor - 1.0).abs() < 1e-12, "{k}");
    }
    // a run of its own, elsewhere, gives the same
    let alone = tempfile::tempdir().unwrap();
    let own = figures(alone.path(), "1 mm", "2000 kg/m3", "200 GPa", &speed);
    for k in 0..3 {
        assert!((own[k] / scaled[k] - 1.0).abs() < 1e-9, "{k}");
    }
    // back again: what was kept is as it was
    let back = figures(folder.path(), "250 um", "8000 kg/m3", "100 GPa", "20 m/s");
    assert_eq!(back, first);
}

#[test]
fn runs_of_another_version_are_not_taken_over() {
    let folder = tempfile::tempdir().unwrap();
    figures(folder.path(), "250 um", "8000 kg/m3", "100 GPa", "20 m/s");
    let runs = folder.path().join("results/runs");
    let run = std::fs::read_dir(&runs)
        .unwrap()
        .next()
        .unwrap()
        .unwrap()
        .path();
    let points = || Impact::read(&run).unwrap().summary.points;
    let made = points();
    let mut other = Impact::read(&run).unwrap();
    other.summary.points = made + 1;
    other.write(&run, "another").unwrap();
    let again = || {
        let output = study(folder.path());
        assert!(output.status.success());
        (points() == made + 1, message(&output))
    };
    assert!(again().0, "a kept run of this version is read");
    let mark = run.join("run.json");
    let text = std::fs::read_to_string(&mark).unwrap();
    std::fs::write(&mark, text.replace(impactlaw::PROGRAM, "impactlaw 0.0.1")).unwrap();
    assert!(!again().0, "one of another version is made again");
    // a figure that was changed by hand, or by a disk
    let summary = run.join("summary.json");
    let text = std::fs::read_to_string(&summary).unwrap();
    let changed = text.replace("\"points\": ", "\"points\": 9");
    std::fs::write(&summary, changed).unwrap();
    let (taken, said) = again();
    assert!(!taken && said.contains("is damaged"), "{said}");
    assert_eq!(points(), made);
}

#[test]
fn refinement_runs_the_drawn_cases_again_with_finer_cells() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), STUDY).unwrap();
    let arguments = ["study", "s.toml", "--out", "results", "--refine", "2"];
    let output = impactlaw(folder.path(), &arguments);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("2 of 2 runs change by less"), "{said}");
    let table = std::fs::read_to_string(folder.path().join("results/refinement.csv")).unwrap();
    let rows: Vec<&str> = table.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!(rows.len(), 3);
    let changes: Vec<f64> = rows[1]
        .split(',')
        .skip(2)
        .take(3)
        .map(|x| x.parse().unwrap())
        .collect();
    assert!(changes.iter().any(|c| *c != 0.0) && changes.iter().all(|c| c.abs() < 0.2));
}

#[test]
fn a_bad_study_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("s.toml"),
        STUDY.replace("[80]", "[80, 0]"),
    )
    .unwrap();
    let output = study(folder.path());
    assert_eq!(output.status.code(), Some(2));
    let text = message(&output);
    assert!(text.contains("material.young_over_yield[1]"), "{text}");
    assert!(!folder.path().join("results").exists());
}
