//! Interrupted beds through the real binary: killed, called again, they end with the same bits.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

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
    let mut command = Command::new(env!("CARGO_BIN_EXE_impactlaw"));
    command
        .args(["-v", "bed", "c.toml", "--out", "results"])
        .args(["--checkpoint", "20 ms"])
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// A results file without its first line, which names the command.
fn body(folder: &Path, name: &str) -> String {
    let text = std::fs::read_to_string(folder.join("results/bed").join(name)).unwrap();
    text.split_once('\n').unwrap().1.to_owned()
}

#[test]
fn a_killed_bed_goes_on_where_it_was_and_ends_with_the_same_bits() {
    let (killed, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    for folder in [&killed, &whole] {
        std::fs::write(folder.path().join("c.toml"), SCENE).unwrap();
    }
    let kept = killed.path().join("results/bed/packing/restart.bin");
    let mut child = bed(killed.path()).spawn().unwrap();
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
    assert!(!killed.path().join("results/bed/thornton/bed.csv").exists());

    let again = bed(killed.path()).output().unwrap();
    let said = String::from_utf8_lossy(&again.stderr).into_owned();
    assert!(again.status.success(), "{said}");
    assert!(said.contains("taken up at step"), "{said}");
    assert!(!kept.exists());

    let once = bed(whole.path()).output().unwrap();
    assert!(once.status.success());
    assert!(!String::from_utf8_lossy(&once.stderr).contains("taken up"));
    for name in ["packing/bed.csv", "thornton/bed.csv", "thornton/bodies.csv"] {
        assert_eq!(
            body(killed.path(), name),
            body(whole.path(), name),
            "{name}"
        );
    }
    let frame =
        |folder: &Path| std::fs::read(folder.join("results/bed/thornton/vtp/grains_0001.vtp"));
    assert_eq!(frame(killed.path()).unwrap(), frame(whole.path()).unwrap());
}
