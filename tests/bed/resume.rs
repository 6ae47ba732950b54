//! Resumed beds: a scene stopped in its packing and under its laws ends with the same bytes as one that was not.

use crate::scene_run::quiet;
use impactlaw::bed::run::{Options, run_scene};
use impactlaw::bed::scene::Scene;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Friction and a law that yields, so that contacts have histories; a free block on a joint, so that rapier moves.
const SCENE: &str = r#"
laws = ["hertz", "thornton"]
seed = 7
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
yield_strength = "100 kPa"
[grains]
count = 60
radius = "1 mm"
stir = "0.2 m/s"
[contact]
friction = 0.4
rolling = 0.02
restitution = 0.7
[box]
width = "8 mm"
depth = "8 mm"
[[stage]]
kind = "settle"
stiffness = 0.1
longest = "150 ms"
rest_speed = "5 mm/s"
[[stage]]
kind = "relax"
steps = 300
[[stage]]
kind = "compress"
speed = "0.4 m/s"
seating_stress = "100 Pa"
strain = 0.03
[[stage]]
kind = "unload"
speed = "0.4 m/s"
[output]
rows = 12
frames = 2
film = 6
contacts = true
dump = true
"#;

/// Runs the scene into `folder`; stops it, as a kill would, before row number `stop` of the run named.
pub fn run(text: &str, folder: &Path, (name, stop): (&str, usize)) -> bool {
    let scene = Scene::parse(text, Path::new("resume.toml")).unwrap();
    let rows = AtomicUsize::new(0);
    let options = Options {
        checkpoint: Some(Duration::ZERO),
        progress: &|run, _| {
            let seen = if run == name {
                rows.fetch_add(1, Ordering::Relaxed)
            } else {
                0
            };
            assert!(run != name || seen < stop, "stopped");
        },
        ..quiet(folder)
    };
    let ran = catch_unwind(AssertUnwindSafe(|| run_scene(&scene, None, &options)));
    ran.is_ok_and(|report| report.map(drop).map_err(|e| panic!("{e}")).is_ok())
}

/// Never stopped.
pub const WHOLE: (&str, usize) = ("", 0);

/// All files by their path in `folder`; a wall time may differ.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(inside) = folders.pop() {
        for entry in std::fs::read_dir(inside).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(folder).unwrap().display().to_string();
            let mut bytes = std::fs::read(&path).unwrap();
            if name.ends_with("summary.json") {
                let text = String::from_utf8(bytes).unwrap();
                let lines = text
                    .lines()
                    .filter(|l| !l.contains("wall_s") && !l.contains("_per_s"));
                bytes = lines.collect::<Vec<_>>().join("\n").into_bytes();
            }
            found.insert(name, bytes);
        }
    }
    found
}

#[test]
fn a_scene_stopped_twice_ends_with_the_same_files() {
    let whole = tempfile::tempdir().unwrap();
    assert!(run(SCENE, whole.path(), WHOLE));
    let whole = files(whole.path());
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    // in the packing, then under one law; the other one, beside it, is resumed as ended or under way
    for stops in [
        [("packing", 9), ("hertz", 7)],
        [("packing", 9), ("thornton", 5)],
    ] {
        let stopped = tempfile::tempdir().unwrap();
        for (run_under_way, rows) in stops {
            assert!(!run(SCENE, stopped.path(), (run_under_way, rows)));
            let folder = stopped.path().join("bed").join(run_under_way);
            assert!(
                folder.join("restart.bin").is_file(),
                "{run_under_way} was not kept"
            );
        }
        assert!(run(SCENE, stopped.path(), WHOLE));
        let stopped = files(stopped.path());
        assert_eq!(names(&whole), names(&stopped), "{stops:?}");
        for (name, bytes) in &whole {
            assert!(stopped[name] == *bytes, "{stops:?}: {name} differs");
        }
    }
    assert!(
        whole.keys().all(|name| !name.ends_with(".bin")),
        "{:?}",
        names(&whole)
    );
    assert!(whole["bed/thornton/bed.csv"].len() > 1000);
}

#[test]
fn what_was_kept_of_another_scene_is_not_taken_up_and_damage_is_reported() {
    let (fresh, changed) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let other = SCENE.replace("seed = 7", "seed = 8");
    assert!(run(&other, fresh.path(), WHOLE));
    assert!(!run(SCENE, changed.path(), ("packing", 9)));
    assert!(run(&other, changed.path(), WHOLE));
    let (fresh, changed) = (files(fresh.path()), files(changed.path()));
    assert!(fresh == changed, "the scene of seed 7 was gone on with");

    let damaged = tempfile::tempdir().unwrap();
    assert!(!run(SCENE, damaged.path(), ("packing", 9)));
    let kept = damaged.path().join("bed/packing/restart.bin");
    let bytes = std::fs::read(&kept).unwrap();
    let scene = Scene::parse(SCENE, Path::new("resume.toml")).unwrap();
    let options = Options {
        checkpoint: Some(Duration::from_secs(60)),
        ..quiet(damaged.path())
    };
    let refused = |damaged: &[u8]| {
        std::fs::write(&kept, damaged).unwrap();
        let text = run_scene(&scene, None, &options).err().unwrap().to_string();
        let named = text.contains("restart.bin") && text.contains("damaged; remove it");
        assert!(named, "{text}");
    };
    refused(&bytes[..bytes.len() / 2]);
    for k in 0..20 {
        let bit = k * 8 * bytes.len() / 20 + 3;
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        refused(&flipped);
    }
}
