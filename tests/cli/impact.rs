//! Impacts through the real binary: files of the contract, and a run that cannot finish.

use crate::program::{impactlaw, message};
use impactlaw::curve::{Impact, ParticleMap, Status};
use std::path::Path;
use std::process::Output;

fn case(modulus: &str, velocity: &str) -> String {
    format!(
        "unusual = [\"material.young_modulus\", \"impact.velocities\"]\n[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"{modulus}\"\n\
         poisson_ratio = 0.35\nyield_strength = \"10 kPa\"\n[impact]\nvelocities = [\"{velocity}\"]\n\
         [accuracy]\ntolerance = 0.2\n"
    )
}

fn impact(folder: &Path, text: &str, more: &[&str]) -> Output {
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
