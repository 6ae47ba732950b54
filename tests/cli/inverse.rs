//! `inverse` through the real binary: a material from real impacts, what it writes, and what it refuses.

use crate::program::{impactlaw, message, program};
use impactlaw::case::Case;
use std::path::Path;
use std::process::Output;

const KNOWN: [&str; 8] = [
    "--young",
    "128GPa",
    "--poisson",
    "0.343",
    "--density",
    "8960kg/m3",
    "--radius",
    "250um",
];

const TABLE: &str = "# made by a test\nvelocity_m_s,restitution,restitution_sigma\n3,0.264,0.02\n10,0.145,0.01\n30,0.085,0.005\n";

fn inverse(folder: &Path, table: &str, more: &[&str]) -> Output {
    std::fs::write(folder.join("m.csv"), table).unwrap();
    let all = [&["inverse", "m.csv"][..], &KNOWN, more].concat();
    impactlaw(folder, &all)
}

fn json(output: &Output) -> serde_json::Value {
    assert_eq!(output.status.code(), Some(0), "{}", message(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn what_is_found_is_said_written_and_a_case_that_reads() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let output = inverse(here, TABLE, &["--sigma-young", "0.03"]);
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let said = String::from_utf8(output.stdout).unwrap();
    for part in [
        "Y = ",
        "95 % interval",
        "by the measurements alone",
        "chi-square",
        "--refine removes it",
    ] {
        assert!(said.contains(part), "no {part:?} in {said}");
    }
    let out = here.join("out/m");
    let text = std::fs::read_to_string(out.join("inverse.toml")).unwrap();
    let written: toml::Table = toml::from_str(&text).unwrap();
    let same = json(&inverse(
        here,
        TABLE,
        &["--sigma-young", "0.03", "--json", "--out", "o"],
    ));
    let strength = same["estimate"]["yield_strength_Pa"].as_f64().unwrap();
    assert_eq!(
        written["estimate"]["yield_strength_Pa"].as_float(),
        Some(strength)
    );
    assert_eq!(written["row"].as_array().unwrap().len(), 3);
    assert_eq!(same["row"][1]["line"], 4);
    let ends = |key: &str| [0, 1].map(|k| same["estimate"][key][k].as_f64().unwrap());
    let whole = ends("yield_strength_interval_Pa");
    let own = ends("yield_strength_interval_of_the_measurements_Pa");
    assert!(whole[0] < own[0] && own[0] < strength && strength < own[1] && own[1] < whole[1]);
    // the case has the strength, and the speeds that were measured
    let case = Case::read(&out.join("case.toml")).unwrap();
    let found = case.material.flow.unwrap().yield_strength();
    assert!((found / strength - 1.0).abs() < 1e-12);
    assert_eq!(case.velocities, [3.0, 10.0, 30.0]);
    // on any number of threads
    let again = program(here)
        .env("RAYON_NUM_THREADS", "3")
        .args(
            [
                &["inverse", "m.csv"][..],
                &KNOWN,
                &["--sigma-young", "0.03"],
            ]
            .concat(),
        )
        .output()
        .unwrap();
    assert!(again.status.success());
    assert_eq!(
        text,
        std::fs::read_to_string(out.join("inverse.toml")).unwrap()
    );
    // the modulus' uncertainty is part of the interval
    let exact = json(&inverse(here, TABLE, &["--json"]));
    let low = exact["estimate"]["yield_strength_interval_of_the_measurements_Pa"][0]
        .as_f64()
        .unwrap();
    assert!(low > own[0]);
}

#[test]
fn what_cannot_be_used_is_one_clear_error_and_nothing_is_written() {
    let one = "velocity_m_s,restitution,restitution_sigma\n3,0.3,0.01\n3,0.29,0.01\n";
    let both = &["--estimate", "yield,hardening"][..];
    let cases: Vec<(&str, &[&str], &str)> = vec![
        (
            "velocity_m_s,restitution\n1,1.1\n",
            &[],
            "`line 2, restitution`: found `1.1`; must be below 1",
        ),
        ("velocity_m_s,restitution\n1,1\n", &[], "stayed elastic"),
        (
            "velocity,restitution\n1,0.5\n",
            &[],
            "`velocity`: found no column of this name",
        ),
        (
            "velocity_m_s,restitution\n1,0.5\n",
            &[],
            "more rows than unknowns",
        ),
        (one, both, "two speeds at least"),
        (
            TABLE,
            &["--estimate", "hardening"],
            "--estimate: found `hardening`",
        ),
        (
            TABLE,
            &["--estimate", "yield,hardening", "--hardening", "1GPa"],
            "--hardening",
        ),
        (TABLE, &["--hardening", "100GPa"], "H/E"),
        (
            TABLE,
            &["--sigma-young", "3"],
            "--sigma-young: found 3; is a share",
        ),
        (TABLE, &["--sigma-velocity=-0.1"], "--sigma-velocity"),
        (TABLE, &["--sigma-restitution", "0"], "--sigma-restitution"),
        (TABLE, &["--tolerance", "0"], "--tolerance"),
        (TABLE, &["--draws", "3"], "--draws"),
        (
            "velocity_mm_s,restitution\n1,0.4\n2,0.3\n",
            &["--sigma-restitution", "0.01"],
            "no strength has all of them",
        ),
        ("", &[], "no such column"),
    ];
    for (table, more, part) in cases {
        let folder = tempfile::tempdir().unwrap();
        let output = inverse(folder.path(), table, more);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{part}: {said}");
        assert!(said.contains(part), "no {part:?} in {said}");
        assert!(!folder.path().join("out").exists(), "{part}");
    }
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("m.csv"), TABLE).unwrap();
    let with = |from: &str, to: &str| {
        let known = KNOWN.map(|word| if word == from { to } else { word });
        let output = impactlaw(here, &[&["inverse", "m.csv"][..], &known].concat());
        assert_eq!(output.status.code(), Some(2), "{to}: {}", message(&output));
        message(&output)
    };
    assert!(with("0.343", "0.495").contains("Poisson's ratio"));
    assert!(with("0.343", "0.6").contains("poisson_ratio"));
    assert!(with("128GPa", "128").contains("--young"));
    assert!(with("250um", "250m").contains("check the unit"));
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/thesis-4-4.toml");
    let case = std::fs::read_to_string(shipped).unwrap();
    let oblique = case.replace("velocities =", "angle = \"30 deg\"\nvelocities =");
    std::fs::write(here.join("oblique.toml"), oblique).unwrap();
    let output = impactlaw(here, &["inverse", "m.csv", "--case", "oblique.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", message(&output));
    assert!(message(&output).contains("impact.angle"));
    assert!(!here.join("out").exists());
}

/// Real impacts of a material whose strength the program does not get to see: from the table that `study` writes.
#[test]
fn refined_by_runs_the_strength_of_real_impacts_comes_back_within_2_per_cent() {
    const STUDY: &str = "[particle]\nradius = \"0.2 mm\"\n[material]\ndensity = \"2700 kg/m3\"\nyoung_modulus = \"70 GPa\"\n\
        poisson_ratio = 0.33\nyield_strength = \"300 MPa\"\n[impact]\nvelocities = [\"10 m/s\", \"40 m/s\"]\n[accuracy]\ntolerance = 0.05\n";
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("s.toml"), STUDY).unwrap();
    let case = STUDY.replace("300 MPa", "100 MPa");
    std::fs::write(here.join("guess.toml"), case).unwrap();
    let output = impactlaw(here, &["study", "s.toml", "-q"]);
    assert!(output.status.success(), "{}", message(&output));
    let run = |more: &[&str]| {
        let known = [
            "inverse",
            "out/s/results.csv",
            "--case",
            "guess.toml",
            "--json",
            "--tolerance",
            "0.05",
        ];
        let sigma = [
            "--sigma-restitution",
            "0.002",
            "--sigma-compression-ratio",
            "0.0005",
        ];
        json(&impactlaw(here, &[&known[..], &sigma, more].concat()))
    };
    let error = |found: &serde_json::Value| {
        found["estimate"]["yield_strength_Pa"].as_f64().unwrap() / 300e6 - 1.0
    };
    let plain = run(&[]);
    let refined = run(&["--refine"]);
    println!("{} {}", error(&plain), error(&refined));
    assert!(error(&plain).abs() < 0.08, "{plain}");
    assert!(error(&refined).abs() < 5e-3, "{refined}");
    assert!(refined["refinement"].as_array().unwrap().len() >= 2);
    assert!(
        refined["assumed"]["notes"][0]
            .as_str()
            .unwrap()
            .contains("tolerance 0.05")
    );
    // what was run is kept: the same command answers from the folder
    let started = std::time::Instant::now();
    let again = run(&["--refine"]);
    assert_eq!(refined, again);
    assert!(here.join("out/results/runs").read_dir().unwrap().count() >= 4);
    assert!(started.elapsed().as_secs() < 20);
}
