//! A small bed from a scene in code: its files go to a temporary folder, its figures are at hand.
//!
//! `cargo run --release --example small_bed`

use impactlaw::prelude::*;
use std::path::Path;

/// The same text as in a scene file.
const SCENE: &str = r#"
seed = 1
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.22
law = "hertz"
[grains]
count = 60
radius = "2 mm"
[contact]
friction = 0.4
restitution = 0.5
[box]
width = "16 mm"
depth = "16 mm"
[[stage]]
kind = "run"
duration = "0.4 s"
until = { rest_speed = "20 mm/s" }
[output]
film = 0
frames = 0
"#;

/// Runs the example.
///
/// # Errors
/// [`Error::File`] where no temporary folder can be written.
pub fn main() -> Result<()> {
    let scene = Scene::parse(SCENE, Path::new("small.toml"))?;
    let folder = std::env::temp_dir().join(format!("impactlaw-small-bed-{}", std::process::id()));
    let options = Options {
        folder: &folder,
        provenance: "example small_bed",
        seed: None,
        checkpoint: None,
        progress: &|_, _| {},
    };
    // on a worker of the pool parallel loops need no change of threads
    let mut report = None;
    rayon::scope(|_| report = Some(run_scene(&scene, None, &options)));
    let Some(report) = report.transpose()? else {
        return Ok(());
    };
    let run = &report.laws[0];
    let highest = run.grains.spheres.iter().map(|sphere| sphere.centre.z);
    let highest = highest.fold(0.0, f64::max);
    println!(
        "{} grains at rest, {:.1} mm high",
        run.grains.spheres.len(),
        1e3 * highest
    );
    assert_eq!(run.grains.spheres.len(), 60);
    assert!(highest < 30e-3);
    std::fs::remove_dir_all(&folder).map_err(Error::file("remove", &folder))
}
