//! Interrupted impacts through the real binary: killed, called again, they end with the same bits.

use crate::killed::{body, kill_once_kept, was_resumed};
use crate::program::{impactlaw, message, program};
use std::path::Path;
use std::process::Command;

/// A second or two: long enough to be killed on its way.
const CASE: &str = r#"
[particle]
radius = "1 mm"
[material]
density = "1000 kg/m3"
young_modulus = "1 GPa"
poisson_ratio = 0.35
yield_strength = "4 MPa"
[impact]
velocities = ["60 m/s"]
[accuracy]
tolerance = 0.02
"#;

fn impact(folder: &Path) -> Command {
    let mut command = program(folder);
    command.args(["-v", "impact", "c.toml", "--out", "results"]);
    command.args(["--checkpoint", "50 ms", "--film", "6"]);
    command
}

#[test]
fn a_killed_impact_goes_on_where_it_was_and_ends_with_the_same_bits() {
    let (killed, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for folder in [&killed, &whole] {
        std::fs::write(folder.path().join("c.toml"), CASE).unwrap();
    }
    let results = |folder: &Path| folder.join("results/impact_V60");
    let kept = results(killed.path()).join("checkpoint.bin");
    kill_once_kept(impact(killed.path()), &kept);
    assert!(!results(killed.path()).join("curve.csv").exists());

    assert!(was_resumed(impact(killed.path())));
    assert!(!kept.exists());
    assert!(!was_resumed(impact(whole.path())));
    for name in [
        "curve.csv",
        "particle_compressed.csv",
        "particle_rebound.csv",
        "film/points.pvd",
        "film/points_0004.vtp",
    ] {
        let body = |folder: &Path| body(&results(folder).join(name));
        assert_eq!(body(killed.path()), body(whole.path()), "{name}");
    }
}

#[test]
fn a_checkpoint_of_another_impact_is_not_taken_up() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), CASE.replace("0.02", "0.1")).unwrap();
    let place = folder.path().join("results/impact_V60");
    std::fs::create_dir_all(&place).unwrap();
    std::fs::write(place.join("checkpoint.bin"), [7u8; 4096]).unwrap();
    assert!(!was_resumed(impact(folder.path())));
    assert!(!place.join("checkpoint.bin").exists());
}

#[test]
fn a_bad_checkpoint_interval_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), CASE).unwrap();
    let arguments = ["impact", "c.toml", "--checkpoint", "fast"];
    let output = impactlaw(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(2));
    assert!(message(&output).contains("--checkpoint"));
    assert!(!folder.path().join("out").exists());
}
