//! Interrupted beds through the real binary: killed, called again, they end with the same bits.

use crate::killed::{body, kill_once_kept, was_resumed};
use crate::program::program;
use std::path::Path;
use std::process::Command;

/// A few seconds: long enough to be killed on its way.
const SCENE: &str = r#"
laws = ["thornton"]
seed = 7
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
yield_strength = "100 kPa"
[grains]
count = 400
radius = "1 mm"
stir = "0.2 m/s"
[contact]
friction = 0.4
restitution = 0.7
[box]
width = "12 mm"
depth = "12 mm"
[[stage]]
kind = "settle"
stiffness = 0.1
longest = "200 ms"
rest_speed = "5 mm/s"
[[stage]]
kind = "relax"
steps = 500
[[stage]]
kind = "compress"
speed = "0.2 m/s"
seating_stress = "500 Pa"
strain = 0.03
[output]
rows = 20
frames = 2
film = 0
"#;

fn bed(folder: &Path) -> Command {
    let mut command = program(folder);
    command.args(["-v", "bed", "c.toml", "--out", "results"]);
    command.args(["--checkpoint", "20 ms"]);
    command
}

#[test]
fn a_killed_bed_goes_on_where_it_was_and_ends_with_the_same_bits() {
    let (killed, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for folder in [&killed, &whole] {
        std::fs::write(folder.path().join("c.toml"), SCENE).unwrap();
    }
    let results = |folder: &Path| folder.join("results/bed");
    let kept = results(killed.path()).join("packing/restart.bin");
    kill_once_kept(bed(killed.path()), &kept);
    assert!(!results(killed.path()).join("thornton/bed.csv").exists());

    assert!(was_resumed(bed(killed.path())));
    assert!(!kept.exists());
    assert!(!was_resumed(bed(whole.path())));
    for name in ["packing/bed.csv", "thornton/bed.csv", "thornton/bodies.csv"] {
        let body = |folder: &Path| body(&results(folder).join(name));
        assert_eq!(body(killed.path()), body(whole.path()), "{name}");
    }
    let frame = |folder: &Path| std::fs::read(results(folder).join("thornton/vtp/grains_0001.vtp"));
    assert_eq!(frame(killed.path()).unwrap(), frame(whole.path()).unwrap());
}
