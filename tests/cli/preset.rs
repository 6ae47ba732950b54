//! `[scheme]` through the real binary: what a preset says of itself, what is not run under it, and that its runs are never taken for
//! others.

use crate::program::{impactlaw, message};
use impactlaw::curve::Impact;
use impactlaw::law::LawFile;
use std::path::Path;
use std::process::Output;

/// Slow and coarse: seconds in the section.
const ELASTIC: &str = "[particle]\nradius = \"12.5 mm\"\n[material]\ndensity = \"1404 kg/m3\"\nyoung_modulus = \"4.9 MPa\"\n\
    poisson_ratio = 0.25\n[impact]\nvelocities = [\"5 m/s\"]\n[accuracy]\ntolerance = 0.2\n";

const THESIS: &str = "[scheme]\npreset = \"thesis\"\npoints = 13\ndimensions = 2\n";

fn run(folder: &Path, text: &str, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("c.toml"), text).unwrap();
    impactlaw(folder, arguments)
}

fn refused(text: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), text, arguments);
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{text}{said}");
    assert!(!folder.path().join("o").exists(), "{said}");
    said
}

#[test]
fn what_is_not_run_under_a_preset_is_refused_by_its_key() {
    let with = |from: &str, to: &str| {
        assert!(ELASTIC.contains(from));
        format!("{}{THESIS}", ELASTIC.replace(from, to))
    };
    let radius = "radius = \"12.5 mm\"\n";
    let ratio = "poisson_ratio = 0.25\n";
    let cases = [
        (
            with(
                radius,
                "radius = \"12.5 mm\"\nshape = \"cylinder\"\nlength = \"25 mm\"\n",
            ),
            "`particle.shape`",
        ),
        (
            with("[accuracy]", "angle = \"20 deg\"\n[accuracy]"),
            "`impact.angle`",
        ),
        (
            with("[accuracy]", "[wall]\nfriction = 0.2\n[accuracy]"),
            "`wall.friction`",
        ),
        (
            with(
                "[accuracy]",
                "[wall.material]\ndensity = \"1404 kg/m3\"\nyoung_modulus = \"4.9 MPa\"\npoisson_ratio = 0.25\n[accuracy]",
            ),
            "`wall.material`",
        ),
        (
            with(
                ratio,
                "poisson_ratio = 0.25\nyield_strength = \"50 kPa\"\nsaturation_stress = \"20 kPa\"\nsaturation_exponent = 5\n",
            ),
            "`material.saturation_stress`",
        ),
        (
            format!("{ELASTIC}{THESIS}[bed]\nscene = \"c.toml\"\n"),
            "`bed.scene`",
        ),
        (
            format!("{ELASTIC}[scheme]\npreset = \"nonsense\"\n"),
            "`scheme.preset`",
        ),
        (
            format!("{ELASTIC}[scheme]\npreset = \"flip\"\npoints = 50\n"),
            "`scheme.points`",
        ),
        (
            format!("{ELASTIC}[scheme]\npreset = \"ulmpm\"\ndimensions = 3\n"),
            "`scheme.dimensions`",
        ),
        (
            format!("{ELASTIC}[scheme]\npreset = \"thesis\"\nratio = 0.5\n"),
            "`scheme.ratio`",
        ),
        (
            format!("{ELASTIC}[scheme]\npreset = \"thesis\"\npoints = 4\n"),
            "`scheme.points`",
        ),
        (
            format!("{ELASTIC}[scheme]\npreset = \"thesis\"\ntime_step = 0\n"),
            "`scheme.time_step`",
        ),
        (
            // the planner's remedies against large deformation were not shown with transfers
            with(
                ratio,
                "poisson_ratio = 0.25\nyield_strength = \"100 kPa\"\n",
            )
            .replace(THESIS, "[scheme]\npreset = \"pic\"\n"),
            "`scheme.preset`",
        ),
        (
            // pressed by less than a lattice point sees
            with("5 m/s", "1 mm/s"),
            "`scheme.preset`",
        ),
    ];
    for (text, key) in cases {
        let said = refused(&text, &["impact", "c.toml", "--out", "o"]);
        assert!(said.contains(key), "{key}: {said}");
    }
    let text = format!("{ELASTIC}{THESIS}");
    for more in [&["--film", "20"][..], &["--repeats", "3"]] {
        let arguments = [&["impact", "c.toml", "--out", "o"], more].concat();
        let said = refused(&text, &arguments);
        assert!(
            said.contains(more[0]) && said.contains("`scheme.preset`"),
            "{said}"
        );
    }
    let said = refused(&text, &["cost", "c.toml", "--out", "o"]);
    assert!(said.contains("`scheme.preset`"), "{said}");
}

#[test]
fn a_preset_is_named_in_plan_summary_and_law_and_its_impacts_are_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = format!("{ELASTIC}{THESIS}");
    let output = run(here, &text, &["plan", "c.toml"]);
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(plan.contains("thesis, 13 points a diameter"), "{plan}");
    let output = run(here, &text, &["impact", "c.toml", "--out", "o"]);
    assert!(output.status.success(), "{}", message(&output));
    let scheme = Impact::read(&here.join("o/impact_V5"))
        .unwrap()
        .summary
        .scheme
        .unwrap();
    assert_eq!(scheme.preset, "thesis");
    let files = scheme.files.unwrap();
    // three distances of the points in ten files
    assert!((files.interval_s / (0.3 * 25e-3 / 13.0 / 5.0) - 1.0).abs() < 1e-9);
    let fit = ["fit", "c.toml", "--impacts", "o", "--out", "o/law.toml"];
    let output = run(here, &text, &fit);
    assert!(output.status.code() != Some(2), "{}", message(&output));
    let law = LawFile::read(&here.join("o/law.toml")).unwrap();
    assert!(
        law.warnings.iter().any(|w| w.contains("preset thesis")),
        "{:?}",
        law.warnings
    );
    // neither of another preset's settings nor of the crate's own scheme
    for other in [
        ELASTIC.to_owned(),
        text.replace("points = 13", "points = 14"),
        text.replace("thesis", "tlmpm"),
    ] {
        let output = run(here, &other, &fit);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("an impact by thesis"), "{said}");
    }
}

#[test]
fn an_impact_that_the_lattice_of_a_preset_cannot_see_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("{ELASTIC}{THESIS}").replace("5 m/s", "1 m/s");
    let output = run(folder.path(), &text, &["impact", "c.toml", "--out", "o"]);
    let said = message(&output);
    assert!(output.status.success(), "{said}");
    let unseen = "0.42 of the distance of the points";
    assert!(said.contains(unseen), "{said}");
    let summary = Impact::read(&folder.path().join("o/impact_V1"))
        .unwrap()
        .summary;
    assert!(
        summary.warnings.iter().any(|w| w.contains(unseen)),
        "{:?}",
        summary.warnings
    );
}

#[test]
fn a_study_keeps_runs_of_a_preset_apart_from_others_and_from_those_with_other_steps() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let runs = || std::fs::read_dir(here.join("o/runs")).map_or(0, Iterator::count);
    let text = ELASTIC.replace("\"12.5 mm\"", "[\"12.5 mm\", \"12.6 mm\"]");
    let study = |text: &str| {
        let output = run(here, text, &["study", "c.toml", "--out", "o"]);
        assert!(output.status.success(), "{}", message(&output));
        std::fs::read_to_string(here.join("o/results.csv")).unwrap()
    };
    study(&text);
    assert_eq!(runs(), 1);
    let under = study(&format!("{text}{THESIS}"));
    assert!(
        under.starts_with("# ") && under.contains("scheme preset thesis"),
        "{under}"
    );
    // a step is a power of ten in seconds: 12.6 mm take others than 12.5 mm
    assert_eq!(runs(), 3);
    study(&format!("{text}[scheme]\npreset = \"flip\"\n"));
    assert_eq!(runs(), 4);
    let refused = run(
        here,
        &format!("{text}{THESIS}"),
        &["study", "c.toml", "--out", "p", "--refine", "1"],
    );
    assert_eq!(refused.status.code(), Some(2), "{}", message(&refused));
}

#[test]
fn results_of_a_preset_are_given_no_further_runs_of_the_crates_own_scheme() {
    let folder = tempfile::tempdir().unwrap();
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/study-480.csv");
    let text = std::fs::read_to_string(shipped).unwrap();
    let with_tolerance = |(k, line): (usize, &str)| match k {
        0 => format!("{line},tolerance\n"),
        _ => format!("{line},0.02\n"),
    };
    let rows: String = text
        .lines()
        .skip(1)
        .enumerate()
        .map(with_tolerance)
        .collect();
    let first = "# impactlaw; case sha256 0; scheme preset thesis, section; impactlaw study s.toml";
    std::fs::write(folder.path().join("r.csv"), format!("{first}\n{rows}")).unwrap();
    let quick = ["--size", "2", "--rounds", "0", "--target", "restitution"];
    let discover = ["discover", "r.csv", "--out", "o", "--add", "2"];
    let output = impactlaw(folder.path(), &[&discover[..], &quick].concat());
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("results of a preset"), "{said}");
}
