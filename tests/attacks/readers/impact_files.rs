//! Files of impacts, kept runs and footprints.

use super::{Accepted, same};
use crate::impacts;
use impactlaw::case::Case;
use impactlaw::curve::{Curve, Impact, ParticleMap};
use impactlaw::document::Document;
use impactlaw::fit::fit;
use impactlaw::law::LawFile;
use impactlaw::study::{KeptRun, group};
use std::path::Path;
use std::sync::LazyLock;

pub(super) const SPEEDS: [f64; 3] = [10.0, 20.0, 50.0];

/// An impact at 10 m/s, as its two files.
pub(super) fn impact_files() -> (Vec<u8>, Vec<u8>) {
    static FILES: LazyLock<(Vec<u8>, Vec<u8>)> = LazyLock::new(written_impact);
    FILES.clone()
}

pub(super) fn written_impact() -> (Vec<u8>, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let [mut slow, _] = impacts::references();
    slow.curve.samples = slow.curve.samples.into_iter().step_by(20).collect();
    slow.write(folder.path(), "seed").unwrap();
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    (read("curve.csv"), read("summary.json"))
}

pub(super) fn curve(bytes: &[u8], folder: &Path) -> Accepted {
    let path = folder.join("curve.csv");
    std::fs::write(&path, bytes).unwrap();
    let Ok(curve) = Curve::read(&path) else {
        return false;
    };
    if !curve.samples.is_empty() {
        let _ = curve.samples[curve.turning_point()];
    }
    assert_eq!(curve.squared_speeds(1.0, 1.0).len(), curve.samples.len());
    curve.write(&path, "again").unwrap();
    same(&Curve::read(&path).unwrap(), &curve);
    true
}

/// Figures as someone leaves them who has changed them on purpose.
pub(super) fn without_sum() -> Vec<u8> {
    let text = String::from_utf8(impact_files().1).unwrap();
    let (figures, _) = text.rsplit_once(",\n  \"sha256\"").unwrap();
    format!("{figures}\n}}\n").into_bytes()
}

pub(super) fn summary(bytes: &[u8], folder: &Path) -> Accepted {
    std::fs::write(folder.join("curve.csv"), impact_files().0).unwrap();
    std::fs::write(folder.join("summary.json"), bytes).unwrap();
    let Ok(impact) = Impact::read(folder) else {
        return false;
    };
    impact.write(folder, "again").unwrap();
    same(&Impact::read(folder).unwrap().summary, &impact.summary);
    true
}

/// The case whose runs a study keeps here.
pub(super) fn kept_case() -> Case {
    impacts::case(impacts::MATERIAL, &SPEEDS[..1])
}

pub(super) fn kept_run() -> Vec<u8> {
    let (folder, case) = (tempfile::tempdir().unwrap(), kept_case());
    KeptRun::of(&case, &group(&case))
        .write(folder.path())
        .unwrap();
    std::fs::read(folder.path().join(KeptRun::FILE)).unwrap()
}

/// A mark that carries its sum is taken as it was written or not at all.
pub(super) fn run_of_a_study(bytes: &[u8], folder: &Path) -> Accepted {
    let (curve, summary) = impact_files();
    std::fs::write(folder.join("curve.csv"), curve).unwrap();
    std::fs::write(folder.join("summary.json"), summary).unwrap();
    std::fs::write(folder.join(KeptRun::FILE), bytes).unwrap();
    let case = kept_case();
    let found = KeptRun::figures(folder, &group(&case), &case);
    assert!(found.is_none() || bytes == kept_run());
    found.is_some()
}

pub(super) const MAP: &str = "# seed\npart,r_m,z_m,size_m,equivalent_plastic_strain,von_mises_Pa,pressure_Pa,temperature_K\n\
                   inside,1e-6,2e-6,1e-7,0.1,1e9,-1e8,\nsurface,0.0,2.5e-4,0.0,0.0,-0.0,0,300\n";

pub(super) fn map(bytes: &[u8], folder: &Path) -> Accepted {
    let path = folder.join("map.csv");
    std::fs::write(&path, bytes).unwrap();
    let Ok(map) = ParticleMap::read(&path) else {
        return false;
    };
    map.write(&path, "again").unwrap();
    same(&ParticleMap::read(&path).unwrap(), &map);
    true
}

/// A fit of three impacts, the figures of one of which are the input.
pub(super) fn fitted(bytes: &[u8], _: &Path) -> Accepted {
    let [slow, fast] = impacts::references();
    let Ok(summary) = serde_json::from_slice(bytes) else {
        return false;
    };
    let middle = Impact {
        summary,
        curve: slow.curve.clone(),
    };
    let case = impacts::case(impacts::MATERIAL, &SPEEDS);
    let Ok(fit) = fit(&case, &[slow, middle, fast]) else {
        return false;
    };
    let file = LawFile::of(&fit, &case, "attacked");
    let document = Document::new("law.toml".as_ref(), file.text().unwrap());
    assert_eq!(LawFile::parse(&document).unwrap(), file);
    true
}

pub(super) const FOOTPRINT: &str = r#"{
  "memory_bytes": 123456,
  "transfer_loss": 1.5e-3,
  "cpu_s": 0.25
}"#;
