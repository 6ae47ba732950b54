//! Interrupted impacts through the real binary: killed, called again, they end with the same bits.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

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
    let mut command = Command::new(env!("CARGO_BIN_EXE_impactlaw"));
    command
        .args([
            "-v",
            "impact",
            "c.toml",
            "--out",
            "results",
            "--checkpoint",
            "50 ms",
        ])
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// A results file without its first line, which names the command.
fn body(folder: &Path, name: &str) -> String {
    let text = std::fs::read_to_string(folder.join("results/impact_V60").join(name)).unwrap();
    text.split_once('\n').unwrap().1.to_owned()
}

#[test]
fn a_killed_impact_goes_on_where_it_was_and_ends_with_the_same_bits() {
    let (killed, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for folder in [&killed, &whole] {
        std::fs::write(folder.path().join("c.toml"), CASE).unwrap();
    }
    let kept = killed.path().join("results/impact_V60/checkpoint.bin");
    let mut child = impact(killed.path()).spawn().unwrap();
    let started = Instant::now();
    while !kept.is_file() {
        assert!(
            child.try_wait().unwrap().is_none(),
            "ended before it was kept"
        );
        assert!(started.elapsed() < Duration::from_secs(120), "never kept");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!killed.path().join("results/impact_V60/curve.csv").exists());

    let again = impact(killed.path()).output().unwrap();
    let said = String::from_utf8_lossy(&again.stderr).into_owned();
    assert!(again.status.success(), "{said}");
    assert!(said.contains("taken up at step"), "{said}");
    assert!(!kept.exists());

    let once = impact(whole.path()).output().unwrap();
    assert!(once.status.success());
    assert!(!String::from_utf8_lossy(&once.stderr).contains("taken up"));
    for name in [
        "curve.csv",
        "particle_compressed.csv",
        "particle_rebound.csv",
    ] {
        assert_eq!(
            body(killed.path(), name),
            body(whole.path(), name),
            "{name}"
        );
    }
}

#[test]
fn a_checkpoint_of_another_impact_is_not_taken_up() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), CASE.replace("0.02", "0.1")).unwrap();
    let place = folder.path().join("results/impact_V60");
    std::fs::create_dir_all(&place).unwrap();
    std::fs::write(place.join("checkpoint.bin"), [7u8; 4096]).unwrap();
    let output = impact(folder.path()).output().unwrap();
    assert!(output.status.success());
    assert!(!String::from_utf8_lossy(&output.stderr).contains("taken up"));
    assert!(!place.join("checkpoint.bin").exists());
}

#[test]
fn a_bad_checkpoint_interval_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), CASE).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_impactlaw"))
        .args(["impact", "c.toml", "--checkpoint", "fast"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--checkpoint"));
    assert!(!folder.path().join("out").exists());
}
