//! `tester` through the real binary: speeds, what they do, a case that reads, constants from measured speeds, and what is refused.

use crate::program::{impactlaw, message};
use impactlaw::case::Case;
use std::path::Path;
use std::process::Output;

const SOLDER: [&str; 5] = ["tester", "--diameter", "500um", "--density", "7274kg/m3"];

const MATERIAL: [&str; 6] = [
    "--young",
    "59.82GPa",
    "--poisson",
    "0.33",
    "--yield",
    "97.59MPa",
];

fn tester(folder: &Path, more: &[&str]) -> Output {
    impactlaw(folder, &[&SOLDER[..], more].concat())
}

fn json(output: &Output) -> serde_json::Value {
    assert_eq!(output.status.code(), Some(0), "{}", message(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn synthetic() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/inverse/tester-synthetic.csv");
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn solder_balls_are_thrown_at_the_speeds_of_both_printed_sets() {
    let folder = tempfile::tempdir().unwrap();
    for (set, speed) in [("solder", 18.8), ("polymers", 16.9)] {
        let output = tester(
            folder.path(),
            &["--pressure", "10kPa", "--constants", set, "--json"],
        );
        let found = json(&output)["throws"][0]["velocity_m_s"].as_f64().unwrap();
        assert!((found - speed).abs() < 0.05, "{set}: {found}");
    }
}

#[test]
fn a_throw_gives_interval_restitution_compression_and_a_case_of_its_speeds() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let asked = [
        &[
            "--pressure",
            "0kPa,10kPa,20kPa",
            "--sigma-diameter",
            "0.02",
            "--json",
            "-o",
            "c.toml",
        ][..],
        &MATERIAL,
    ];
    let found = json(&tester(here, &asked.concat()));
    let throws = found["throws"].as_array().unwrap();
    // without a vacuum it falls: slower by its drag than in nothing, 2.805 m/s
    let fallen = throws[0]["velocity_m_s"].as_f64().unwrap();
    assert!((2.6..2.7).contains(&fallen), "{fallen}");
    assert!(throws[0]["interval_m_s"].is_null());
    let of = |k: usize, key: &str| throws[k][key].as_f64().unwrap();
    assert!(of(1, "restitution") > of(2, "restitution"));
    assert!(of(1, "compression_ratio") < of(2, "compression_ratio"));
    // the speed goes with D^-0.221
    let ends = throws[1]["interval_m_s"].as_array().unwrap();
    let wide = (ends[1].as_f64().unwrap() / ends[0].as_f64().unwrap()).ln();
    assert!((wide / (2.0 * 1.959_964 * 0.221 * 0.02) - 1.0).abs() < 1e-9);
    let case = Case::read(&here.join("c.toml")).unwrap();
    let speeds: Vec<f64> = (0..3).map(|k| of(k, "velocity_m_s")).collect();
    assert_eq!(case.velocities, speeds);
    assert_eq!(case.radius, 250e-6);
    let flow = case.material.flow.unwrap();
    assert_eq!(flow.yield_strength(), 97.59e6);
}

#[test]
fn what_the_constants_are_not_from_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let dust = ["tester", "--diameter", "63um", "--density", "2700kg/m3"];
    let output = impactlaw(
        folder.path(),
        &[&dust[..], &["--pressure", "10kPa"]].concat(),
    );
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("extrapolated: diameter outside"), "{said}");
    let output = tester(folder.path(), &["--pressure", "1Pa"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("slower than a fall"), "{said}");
}

#[test]
fn constants_are_found_from_speeds_and_used() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("m.csv"), synthetic()).unwrap();
    let found = json(&impactlaw(
        here,
        &["tester", "--measured", "m.csv", "--json"],
    ));
    let known = [371.23, 0.464, 0.673, 0.235];
    for (k, known) in known.into_iter().enumerate().skip(1) {
        let off = (found["constants"][k].as_f64().unwrap() - known).abs();
        let half = found["found"]["half_widths_95"][k].as_f64().unwrap();
        assert!(off < 1.5 * half, "{k}: {off} {half}");
    }
    let scatter = found["found"]["scatter"].as_f64().unwrap();
    assert!((0.025..0.035).contains(&scatter), "{scatter}");
    let used = json(&tester(
        here,
        &["--measured", "m.csv", "--pressure", "10kPa", "--json"],
    ));
    assert_eq!(used["constants"], found["constants"]);
    // the same table as a spreadsheet writes it elsewhere, with a column that means nothing here
    let numbers = synthetic();
    let numbers = numbers.lines().filter(|line| !line.starts_with('#'));
    let mut other = "\u{feff}".to_owned();
    for (row, line) in numbers.enumerate() {
        let line = match row {
            0 => line
                .replace("density_kg_m3", "Density (kg/m\u{b3})")
                .replace("diameter_um", "Diameter [\u{b5}m]")
                .replace("gauge_pressure_kPa", "Gauge pressure (kPa)"),
            _ => line.to_owned(),
        };
        other += &format!("{};{row}\r\n", line.replace(',', ";"));
    }
    std::fs::write(here.join("m2.csv"), other.replacen(";0\r", ";number\r", 1)).unwrap();
    let same = impactlaw(here, &["tester", "--measured", "m2.csv", "--json"]);
    assert_eq!(json(&same)["constants"], found["constants"]);
    let throw = &used["throws"][0];
    let speed = throw["velocity_m_s"].as_f64().unwrap();
    assert!((speed / 16.9 - 1.0).abs() < 0.05, "{speed}");
    assert!(
        throw["notes"][0]
            .as_str()
            .unwrap()
            .contains("density outside")
    );
    assert!(throw["interval_m_s"].is_array());
}

#[test]
fn measured_speeds_that_are_none_or_tell_too_little_are_refused_by_line_or_name() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let whole = synthetic();
    let head = "density_kg_m3,diameter_um,gauge_pressure_kPa,velocity_m_s\n";
    for (text, said) in [
        (whole.replace("velocity_m_s", "rate_m_s"), "velocity_m_s"),
        (
            whole.replacen(",4,", ",0,", 1),
            "line 4, gauge_pressure_kPa",
        ),
        (whole.replacen(",4,", ",four,", 1), "line 4"),
        (
            format!("{head}745,500,4,8\n745,500,8,11\n745,710,4,7\n745,710,8,10\n745,710,12,12\n"),
            "needs two densities",
        ),
        (
            format!("{head}745,500,4,8\n859,710,4,8\n745,710,4,7\n859,500,4,9\n745,500,4,8.1\n"),
            "needs two pressures",
        ),
        (String::new(), "measured speeds"),
        (head.to_owned(), "measured speeds"),
    ] {
        std::fs::write(here.join("m.csv"), text).unwrap();
        let output = impactlaw(here, &["tester", "--measured", "m.csv"]);
        let message = message(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(said), "no {said:?} in {message}");
    }
}

#[test]
fn slips_are_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for (more, said) in [
        (&["--pressure", "10MPa"][..], "--pressure"),
        (&["--pressure=-10kPa"], "--pressure"),
        (&["--pressure", "10"], "unit"),
        (&["--pressure", "10kPa,100mbar"], "must be given once"),
        (&[], "--pressure"),
        (&["--pressure", "10kPa", "--scatter", "3"], "--scatter"),
        (
            &["--pressure", "10kPa", "--air-density", "0 kg/m3"],
            "--air-density",
        ),
        (&["--pressure", "10kPa", "--young", "59.82GPa"], "--poisson"),
        (
            &[
                "--pressure",
                "10kPa",
                "--young",
                "59.82MPa",
                "--poisson",
                "0.33",
                "--yield",
                "97.59MPa",
                "-o",
                "c.toml",
            ],
            "yield_strength",
        ),
    ] {
        let output = tester(here, more);
        let message = message(&output);
        assert_eq!(output.status.code(), Some(2), "{more:?}: {message}");
        assert!(message.contains(said), "{more:?}: no {said:?} in {message}");
    }
    assert_eq!(std::fs::read_dir(here).unwrap().count(), 0);
}
