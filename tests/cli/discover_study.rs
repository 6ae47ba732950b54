//! `discover` on the results of a study: its table as it is, and runs added to it.

use crate::discover::{HEAD, known, number, rows, write};
use crate::program::{impactlaw, message};
use std::path::Path;

const STUDY: &str = r#"
[particle]
radius = "0.5 mm"
[material]
density = ["4 g/cm3", "8 g/cm3"]
young_modulus = ["50 GPa", "100000 MPa"]
poisson_ratio = 0.3
yield_strength = ["500 MPa", "1000 MPa"]
[impact]
velocities = ["10 m/s", "40 m/s"]
[accuracy]
tolerance = 0.2
"#;

/// Runs the study in `here`, into `out/s`.
fn run_study(here: &Path) {
    std::fs::write(here.join("s.toml"), STUDY).unwrap();
    let output = impactlaw(here, &["study", "s.toml", "-q"]);
    assert!(output.status.success(), "{}", message(&output));
}

/// What `study` writes is what `discover` reads: all columns as they stand, and the same table in other units.
#[test]
fn a_study_is_run_looked_at_and_predicted_with_its_table_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    run_study(here);
    let search = ["--size", "2", "--rounds", "0", "--target", "restitution"];
    let said = |results: &str| {
        let output = impactlaw(here, &[&["discover", results][..], &search].concat());
        assert!(output.status.success(), "{}", message(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    let first = said("out/s");
    assert!(
        first.contains(
            "inputs that vary: density_kg_m3, young_modulus_Pa, yield_strength_Pa, velocity_m_s"
        ),
        "{first}"
    );
    assert!(first.contains("groups: "), "{first}");
    let results = std::fs::read_to_string(here.join("out/s/results.csv")).unwrap();
    for column in ["angle_deg", "friction", "hardening_modulus_Pa"] {
        assert!(results.contains(column));
        assert!(
            first.contains(&format!("{column} never changes")),
            "{first}"
        );
    }
    // the groups say nothing that the inputs beside them do not
    assert!(!first.contains("_over_"), "{first}");

    // the same in mm, MPa and mm/s, whose end is that of seconds too
    let mut lines = results.lines().map(str::to_owned).collect::<Vec<_>>();
    let renamed = [
        ("yield_strength_Pa", "yield_strength_MPa", 1e-6),
        ("radius_m", "radius_mm", 1e3),
        ("velocity_m_s", "velocity_mm_s", 1e3),
    ];
    for (si, other, factor) in renamed {
        let names: Vec<&str> = lines[1].split(',').collect();
        let at = names.iter().position(|name| *name == si).unwrap();
        lines[1] = names
            .iter()
            .map(|name| if *name == si { other } else { name })
            .collect::<Vec<_>>()
            .join(",");
        for line in &mut lines[2..] {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            cells[at] = (cells[at].parse::<f64>().unwrap() * factor).to_string();
            *line = cells.join(",");
        }
    }
    std::fs::create_dir(here.join("mm")).unwrap();
    std::fs::write(here.join("mm/results.csv"), lines.join("\n")).unwrap();
    let second = said("mm");
    assert!(
        second.contains("velocity_mm_s is read as velocity_m_s"),
        "{second}"
    );
    let line = |text: &str, start: &str| {
        text.lines()
            .find(|line| line.starts_with(start))
            .unwrap()
            .to_owned()
    };
    for start in ["groups:", "inputs that vary:", "| **chosen**"] {
        assert_eq!(line(&first, start), line(&second, start));
    }

    // a case of the table is predicted; what never changed in it may not change
    let case = STUDY
        .replace(r#"["4 g/cm3", "8 g/cm3"]"#, r#""8 g/cm3""#)
        .replace(r#"["50 GPa", "100000 MPa"]"#, r#""100 GPa""#)
        .replace(r#"["500 MPa", "1000 MPa"]"#, r#""1000 MPa""#);
    std::fs::write(here.join("case.toml"), &case).unwrap();
    let predict = [
        "predict",
        "case.toml",
        "--equation",
        "out/s/discover/equations.toml",
    ];
    let output = impactlaw(here, &predict);
    assert!(output.status.success(), "{}", message(&output));
    std::fs::write(here.join("p.csv"), &output.stdout).unwrap();
    assert_eq!(rows(&here.join("p.csv")).len(), 2);
    let rough = format!("{case}[wall]\nfriction = 0.3\n");
    std::fs::write(here.join("case.toml"), rough).unwrap();
    let output = impactlaw(here, &predict);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        message(&output).contains("friction"),
        "{}",
        message(&output)
    );

    // runs of two tolerances have no one error
    let mixed = STUDY.replace("tolerance = 0.2", "tolerance = [0.2, 0.1]");
    std::fs::write(here.join("mixed.toml"), mixed).unwrap();
    let output = impactlaw(here, &["study", "mixed.toml", "-q", "--out", "out/m"]);
    assert!(output.status.success(), "{}", message(&output));
    let output = impactlaw(here, &["discover", "out/m"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        message(&output).contains("`tolerance`: found 0.1 to 0.2"),
        "{}",
        message(&output)
    );
}

#[test]
fn runs_are_added_within_the_range_of_the_study_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    run_study(here);
    let before = std::fs::read(here.join("out/s/results.csv")).unwrap();
    let search = [
        "discover",
        "out/s",
        "--size",
        "3",
        "--rounds",
        "0",
        "--target",
        "restitution",
    ];
    let add = |count: &str| {
        let output = impactlaw(here, &[&search[..], &["--add", count]].concat());
        assert!(output.status.success(), "{}", message(&output));
        let said = String::from_utf8(output.stdout).unwrap();
        let found = std::fs::read(here.join("out/s/discover/equations.toml")).unwrap();
        (said, rows(&here.join("out/s/added.csv")), found)
    };
    let (said, added, found) = add("3");
    assert!(
        said.contains("16 cases") && said.contains("3 runs added") && said.contains("19 cases"),
        "{said}"
    );
    assert_eq!(added.len(), 3);
    // what they were chosen from stands on top
    let hash = |file: &str| {
        let text = std::fs::read_to_string(here.join("out/s").join(file)).unwrap();
        let (_, hash) = text.split_once("case sha256 ").unwrap();
        hash[..64].to_owned()
    };
    assert_eq!(hash("added.csv"), hash("discover/discover.csv"));
    assert_ne!(hash("added.csv"), "0".repeat(64));
    for row in &added {
        let (q, ratio) = (
            number(row, "rho_V2_over_Y"),
            number(row, "young_over_yield"),
        );
        assert!((50.0 * 0.999..=200.0 * 1.001).contains(&ratio), "{row:?}");
        // 4000 kg/m3, 10 m/s at 1 GPa to 8000 kg/m3, 40 m/s at 500 MPa
        assert!((4e-4 * 0.999..=2.56e-2 * 1.001).contains(&q), "{row:?}");
        assert_eq!(row["status"], "ok");
        assert_eq!(number(row, "tolerance"), 0.2);
    }
    assert_eq!(
        before,
        std::fs::read(here.join("out/s/results.csv")).unwrap()
    );
    // the same again, from what is kept
    let runs = || here.join("out/s/runs").read_dir().unwrap().count();
    let count = runs();
    let (_, again, same) = add("3");
    assert_eq!((&added, &found), (&again, &same));
    assert_eq!(runs(), count);
    // the first of more are those of fewer
    let (_, more, _) = add("4");
    assert_eq!(more[..3], added);
    // a table that is not a study's own is refused before anything is run
    write(here, HEAD, &known());
    let output = impactlaw(
        here,
        &[
            "discover",
            "results.csv",
            "--size",
            "2",
            "--rounds",
            "0",
            "--target",
            "restitution",
            "--add",
            "2",
        ],
    );
    assert_eq!(output.status.code(), Some(2));
    let said = message(&output);
    assert!(
        said.contains("tolerance") && said.contains("results.csv of a study as it is"),
        "{said}"
    );
    assert!(!here.join("runs").exists());
}
