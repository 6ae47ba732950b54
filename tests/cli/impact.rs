//! Impacts through the real binary: files of the contract, and a run that cannot finish.

use crate::program::{impactlaw, message};
use crate::reference::assert_described;
use impactlaw::curve::{Impact, ParticleMap, Status};
use std::path::Path;
use std::process::Output;

/// A coarse impact that yields a little.
pub const STEEL: &str = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"100 GPa\"\n\
    poisson_ratio = 0.35\nyield_strength = \"1.25 GPa\"\n[impact]\nvelocities = [\"20 m/s\"]\n[accuracy]\ntolerance = 0.2\n";

fn case(modulus: &str, velocity: &str) -> String {
    format!(
        "unusual = [\"material.young_modulus\", \"impact.velocities\"]\n[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"{modulus}\"\n\
         poisson_ratio = 0.35\nyield_strength = \"10 kPa\"\n[impact]\nvelocities = [\"{velocity}\"]\n\
         [accuracy]\ntolerance = 0.2\n"
    )
}

/// `impact` of a case, into the folder `o`.
pub fn impact(folder: &Path, text: &str, more: &[&str]) -> Output {
    std::fs::write(folder.join("c.toml"), text).unwrap();
    let arguments = ["impact", "c.toml", "--out", "o"];
    impactlaw(folder, &[&arguments[..], more].concat())
}

#[test]
fn an_impact_leaves_curve_summary_and_maps() {
    let folder = tempfile::tempdir().unwrap();
    let output = impact(
        folder.path(),
        &case("1 MPa", "1 m/s"),
        &["--velocity", "0.5 m/s"],
    );
    assert!(output.status.success(), "{}", message(&output));
    let done = folder.path().join("o/impact_V0.5");
    let impact = Impact::read(&done).unwrap();
    assert_eq!(impact.summary.status, Status::Ok);
    let text = std::fs::read_to_string(done.join("curve.csv")).unwrap();
    let header = text.lines().find(|l| !l.starts_with('#')).unwrap();
    assert_eq!(
        header,
        "time_s,displacement_m,centre_displacement_m,force_N,contact_radius_m,kinetic_J,elastic_J,plastic_J"
    );
    for name in ["particle_compressed.csv", "particle_rebound.csv"] {
        assert!(ParticleMap::read(&done.join(name)).unwrap().points.len() > 500);
    }
}

#[test]
fn a_particle_thrown_again_gives_back_more_and_the_first_impact_is_that_of_one_alone() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("o/impact_V20");
    let body = |file: &str| {
        let text = std::fs::read_to_string(place.join(file)).unwrap();
        text.split_once('\n').unwrap().1.to_owned()
    };
    assert!(impact(folder.path(), STEEL, &[]).status.success());
    let alone = body("curve.csv");
    let output = impact(folder.path(), STEEL, &["--repeats", "4"]);
    assert!(output.status.success(), "{}", message(&output));
    assert_eq!(body("curve.csv"), alone);
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .contains("repeat_4")
    );
    assert!(assert_described(folder.path()).contains("repeats.csv"));
    let mut rows = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(place.join("repeats.csv"))
        .unwrap();
    let rows: Vec<Vec<f64>> = rows.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 4);
    for (row, number) in rows.iter().zip(1..) {
        let kept = match number {
            1 => Impact::read(&place),
            _ => Impact::read(&place.join(format!("repeat_{number}"))),
        };
        let summary = kept.unwrap().summary;
        assert_eq!((row[0], row[1]), (f64::from(number), summary.restitution));
    }
    // the flat that the first impact leaves carries the second with less plastic work, and so on
    for pair in rows.windows(2) {
        let [e, work, strain] = [1, 6, 7].map(|column| (pair[0][column], pair[1][column]));
        assert!(
            e.1 > e.0 && work.1 < work.0 && strain.1 > strain.0,
            "{rows:?}"
        );
    }

    assert!(
        impact(folder.path(), STEEL, &["--repeats", "2"])
            .status
            .success()
    );
    assert!(place.join("repeat_2").is_dir() && !place.join("repeat_3").exists());
    assert!(impact(folder.path(), STEEL, &[]).status.success());
    assert!(!place.join("repeat_2").exists() && !place.join("repeats.csv").exists());
    let refused = impact(folder.path(), STEEL, &["--repeats", "1"]);
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn a_run_that_cannot_finish_says_why_and_keeps_what_it_has() {
    let folder = tempfile::tempdir().unwrap();
    // twenty-seven times the wave speed: nothing elastic-plastic survives that
    let text = case("1 MPa", "300 m/s");
    let output = impact(folder.path(), &text, &[]);
    assert_eq!(output.status.code(), Some(2));
    let message = message(&output);
    assert!(
        message.contains("300 m/s") && message.contains("step"),
        "{message}"
    );
    let kept = Impact::read(&folder.path().join("o/impact_V300")).unwrap();
    assert!(
        matches!(kept.summary.status, Status::Failed(_)),
        "{:?}",
        kept.summary.status
    );
}

const COPPER: &str = "material = \"ofhc-copper\"\n[particle]\nradius = \"250 um\"\n[impact]\nvelocities = [\"20 m/s\"]\n[accuracy]\ntolerance = 0.2\n";

#[test]
fn what_no_law_holds_for_is_refused_by_name_before_the_first_step_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let bar = COPPER.replace(
        "[particle]",
        "[particle]\nshape = \"cylinder\"\nlength = \"1 mm\"",
    );
    let oblique = STEEL.replace("[accuracy]", "angle = \"60 deg\"\n[accuracy]");
    let rough = format!("{STEEL}[wall]\nfriction = 0.3\n");
    let again = ["impact", "c.toml", "--repeats", "2"];
    let cases: [(&str, &[&str], &str); 17] = [
        (COPPER, &["run", "c.toml"], "`reference_rate`"),
        (COPPER, &["fit", "c.toml"], "`reference_rate`"),
        (&bar, &["run", "c.toml"], "\"cylinder\""),
        (&bar, &["fit", "c.toml"], "\"cylinder\""),
        (&bar, &["cost", "c.toml"], "\"cylinder\""),
        (&bar, &["theory", "hertz", "c.toml"], "\"cylinder\""),
        (&oblique, &["run", "c.toml"], "`impact.angle`: found 60"),
        (&oblique, &["fit", "c.toml"], "`impact.angle`"),
        (&oblique, &["cost", "c.toml"], "`impact.angle`"),
        (&oblique, &["theory", "hertz", "c.toml"], "`impact.angle`"),
        (
            &oblique,
            &["compare", "c.toml", "--law", "atlas"],
            "`impact.angle`",
        ),
        (&rough, &["run", "c.toml"], "`wall.friction`: found 0.3"),
        (&bar, &again, "\"cylinder\""),
        (&oblique, &again, "`impact.angle`"),
        (&rough, &again, "`wall.friction`"),
        (&rough, &["theory", "hertz", "c.toml"], "`wall.friction`"),
        (
            &rough,
            &["compare", "c.toml", "--law", "atlas"],
            "`wall.friction`",
        ),
    ];
    for (text, arguments, named) in cases {
        std::fs::write(folder.path().join("c.toml"), text).unwrap();
        let output = impactlaw(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let message = message(&output);
        assert!(message.contains(named), "{arguments:?}: {message}");
        assert!(!folder.path().join("out").exists(), "{arguments:?}");
    }
    for (key, value, said) in [
        (
            "melting_temperature",
            "\"290 K\"",
            "must be above `room_temperature`",
        ),
        ("rate_sensitivity", "-0.1", "must lie in [0, 1]"),
        ("softening_exponent", "0", "must be positive"),
        ("specific_heat", "\"-3 J/(kg K)\"", "must be positive"),
        ("reference_rate", "\"0 1/s\"", "must be positive"),
        ("taylor_quinney_coefficient", "1.1", "must lie in [0, 1]"),
        ("hardening_exponent", "1.5", "at most 1"),
        (
            "hardening_coefficient",
            "\"-1 MPa\"",
            "must not be negative",
        ),
        ("doubling_rate", "\"1 1/s\"", "of one kind"),
    ] {
        let constants = [
            ("density", "\"8960 kg/m3\""),
            ("young_modulus", "\"124 GPa\""),
            ("poisson_ratio", "0.34"),
            ("yield_strength", "\"90 MPa\""),
            ("hardening_coefficient", "\"292 MPa\""),
            ("hardening_exponent", "0.31"),
            ("rate_sensitivity", "0.025"),
            ("softening_exponent", "1.09"),
            ("melting_temperature", "\"1356 K\""),
            ("specific_heat", "\"383 J/(kg K)\""),
        ];
        let mut table = String::from("[material]\n");
        for (name, usual) in constants.iter().filter(|(name, _)| *name != key) {
            table.push_str(&format!("{name} = {usual}\n"));
        }
        table.push_str(&format!("{key} = {value}\n[impact]"));
        let text = COPPER
            .replace("material = \"ofhc-copper\"\n", "")
            .replace("[impact]", &table);
        let output = impact(folder.path(), &text, &[]);
        assert_eq!(output.status.code(), Some(2), "{key}");
        let message = message(&output);
        assert!(
            message.contains(key) && message.contains(said),
            "{key}: {message}"
        );
        assert!(!folder.path().join("o").exists(), "{key}");
    }
    let unknown = COPPER.replace("ofhc-copper", "unobtainium");
    let output = impact(folder.path(), &unknown, &[]);
    assert_eq!(output.status.code(), Some(2));
    let message = message(&output);
    assert!(
        message.contains("unobtainium") && message.contains("steel-4340"),
        "{message}"
    );
}
