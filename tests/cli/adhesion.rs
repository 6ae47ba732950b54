//! A wall that adheres through the real binary: its keys, what an impact writes, and that nothing takes it for another.

use crate::program::{impactlaw, message};
use crate::reference::assert_described;
use impactlaw::curve::{Impact, Status};
use std::path::Path;

/// A sphere so soft and small that its contact at rest is an eighth of its radius, at a coarse tolerance and a long range: seconds.
const STICKY: &str = "[particle]\nradius = \"1 um\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\npoisson_ratio = 0.3\n\
    [wall]\nwork_of_adhesion = \"100 mJ/m2\"\nadhesion_range = \"1.2 nm\"\n[impact]\nvelocities = [\"0.5 m/s\", \"3 m/s\"]\n\
    [accuracy]\ntolerance = 0.05\n";

fn refused(folder: &Path, text: &str, arguments: &[&str]) -> String {
    std::fs::write(folder.join("c.toml"), text).unwrap();
    let output = impactlaw(folder, arguments);
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?} {text}{said}");
    assert!(!folder.join("out").exists(), "{said}");
    said
}

#[test]
fn what_is_no_adhesion_is_one_clear_error() {
    let folder = tempfile::tempdir().unwrap();
    let with = |from: &str, to: &str| {
        assert!(STICKY.contains(from), "{from}");
        STICKY.replace(from, to)
    };
    let work = "work_of_adhesion = \"100 mJ/m2\"\n";
    let plastic = "poisson_ratio = 0.3\nyield_strength = \"20 MPa\"";
    for (text, key, said) in [
        (
            with("\"100 mJ/m2\"", "\"-100 mJ/m2\""),
            "wall.work_of_adhesion",
            "must not be negative",
        ),
        (
            with("\"100 mJ/m2\"", "\"100 mJ\""),
            "wall.work_of_adhesion",
            "an energy per area",
        ),
        (
            with("\"100 mJ/m2\"", "\"100 J/m2\""),
            "wall.work_of_adhesion",
            "check the unit",
        ),
        (
            with("\"100 mJ/m2\"", "\"2 J/m2\""),
            "wall.work_of_adhesion",
            "more than 0.25 R",
        ),
        (
            with("\"1.2 nm\"", "\"0 nm\""),
            "wall.adhesion_range",
            "must be positive",
        ),
        (
            with("\"1.2 nm\"", "\"200 nm\""),
            "wall.adhesion_range",
            "a tenth of the radius",
        ),
        (
            with("\"1.2 nm\"", "\"0.1 nm\""),
            "wall.adhesion_range",
            "must be at least",
        ),
        (
            with(work, ""),
            "wall.adhesion_range",
            "needs a `work_of_adhesion`",
        ),
        (
            with(work, "work_of_adhesion = \"100 mJ/m2\"\nfriction = 0.3\n"),
            "wall.friction",
            "frictionless",
        ),
        (
            with(
                "[impact]",
                "[wall.material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\npoisson_ratio = 0.3\n[impact]",
            ),
            "wall.work_of_adhesion",
            "beside `wall.material`",
        ),
        (
            with(
                "\"1 um\"",
                "\"1 um\"\nshape = \"cylinder\"\nlength = \"4 um\"",
            ),
            "wall.work_of_adhesion",
            "cylinder",
        ),
        (
            with("[accuracy]", "[scheme]\npreset = \"flip\"\n[accuracy]"),
            "wall.work_of_adhesion",
            "scheme.preset",
        ),
        (
            with("poisson_ratio = 0.3", plastic),
            "wall.adhesion_range",
            "tears its surface",
        ),
        (
            with("poisson_ratio = 0.3", plastic)
                .replace("\"1.2 nm\"", "\"5 nm\"")
                .replace("\"3 m/s\"", "\"60 m/s\""),
            "wall.work_of_adhesion",
            "flattened",
        ),
    ] {
        let found = refused(folder.path(), &text, &["impact", "c.toml"]);
        assert!(
            found.contains(&format!("`{key}`")) && found.contains(said),
            "{key}: {found}"
        );
    }
}

#[test]
fn what_knows_no_adhesion_refuses_it_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let yielding = STICKY.replace(
        "poisson_ratio = 0.3",
        "poisson_ratio = 0.3\nyield_strength = \"20 MPa\"",
    );
    for arguments in [
        &["run", "c.toml"][..],
        &["fit", "c.toml"],
        &["cost", "c.toml"],
        &["compare", "c.toml", "--law", "atlas"],
        &["theory", "hertz", "c.toml", "--velocities", "1 m/s"],
        &["export", "c.toml", "--to", "calculix"],
        &["predict", "c.toml", "--equation", "c.toml"],
        &["impact", "c.toml", "--repeats", "2"],
    ] {
        let said = refused(folder.path(), &yielding, arguments);
        assert!(
            said.contains("`wall.work_of_adhesion`"),
            "{arguments:?}: {said}"
        );
    }
    // a study has no key for it
    let study = "[particle]\nradius = \"1 um\"\n[material]\ndensity = [\"1 g/cc\", \"2 g/cc\"]\nyoung_modulus = \"1 GPa\"\npoisson_ratio = 0.3\n\
        [wall]\nwork_of_adhesion = \"100 mJ/m2\"\n[impact]\nvelocities = [\"1 m/s\"]\n[accuracy]\ntolerance = 0.05\n";
    let said = refused(folder.path(), study, &["study", "c.toml"]);
    assert!(said.contains("work_of_adhesion"), "{said}");
}

#[test]
fn a_slow_sphere_stays_on_the_wall_a_faster_one_comes_back_and_neither_is_taken_for_another() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("c.toml"), STICKY).unwrap();
    let plan = impactlaw(here, &["plan", "c.toml"]);
    let plan = String::from_utf8_lossy(&plan.stdout).into_owned();
    assert!(plan.contains("Maugis number"), "{plan}");
    let output = impactlaw(here, &["impact", "c.toml", "--out", "o"]);
    assert!(output.status.success(), "{}", message(&output));
    let said = format!(
        "{}{}",
        String::from_utf8_lossy(&output.stdout),
        message(&output)
    );
    assert!(said.contains("sticks"), "{said}");
    let [slow, fast] =
        ["o/impact_V0.5", "o/impact_V3"].map(|at| Impact::read_any(&here.join(at)).unwrap());
    assert_eq!(
        (slow.summary.status, slow.summary.restitution),
        (Status::Sticks, 0.0)
    );
    assert_eq!(fast.summary.status, Status::Ok);
    assert!(fast.summary.restitution > 0.5 && fast.summary.restitution < 1.0);
    let adhesion = fast.summary.adhesion.unwrap();
    assert!((adhesion.range_m / 1.2e-9 - 1.0).abs() < 1e-12);
    let samples = &fast.curve.samples;
    assert!(
        samples
            .iter()
            .all(|s| s.surface_j.is_some_and(|e| e <= 0.0))
    );
    assert!(samples.iter().any(|s| s.force_n < 0.0));
    let stuck = slow.curve.samples.last().unwrap();
    assert!(stuck.surface_j.unwrap() < 0.0);
    assert_described(&here.join("o"));
    // impacts with adhesion are no impacts of a case without
    let plain = STICKY.replace(
        "work_of_adhesion = \"100 mJ/m2\"\nadhesion_range = \"1.2 nm\"",
        "friction = 0",
    );
    std::fs::write(here.join("c.toml"), plain).unwrap();
    let fit = impactlaw(
        here,
        &["fit", "c.toml", "--impacts", "o", "--out", "law.toml"],
    );
    let said = message(&fit);
    assert_eq!(fit.status.code(), Some(2), "{said}");
    assert!(said.contains("a wall that adheres"), "{said}");
}
