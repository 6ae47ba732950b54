//! Every reader of what comes from outside: its seeds, and what must hold of an input it accepts.
//!
//! The list is held to the source: a file of `src` that reads and stands in no line of it fails the test at the end.

use crate::impacts;
use crate::mutate::Kind;
use crate::sources::sources;
use clap::Parser;
use impactlaw::bed::filling::insert;
use impactlaw::bed::scene::{Amount, Scene};
use impactlaw::bed::stages::time_step;
use impactlaw::case::Case;
use impactlaw::cli::Cli;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::elastoplastic::Elastoplastic;
use impactlaw::contact::loading::Loading;
use impactlaw::cost::Footprint;
use impactlaw::curve::{Curve, Impact, ParticleMap};
use impactlaw::dem::bodies::Body;
use impactlaw::dem::bodies::mesh::{self, Format};
use impactlaw::dem::grains::Grains;
use impactlaw::discover::bound::Bound;
use impactlaw::discover::file::EquationsFile;
use impactlaw::discover::infix::Infix;
use impactlaw::discover::problem::{Inputs, Runs};
use impactlaw::discover::table::Table;
use impactlaw::document::Document;
use impactlaw::export::Target;
use impactlaw::export::source::portable::Portable;
use impactlaw::fit::fit;
use impactlaw::law::{FittedLaw, LawFile};
use impactlaw::listing;
use impactlaw::plan::plans;
use impactlaw::study::{KeptRun, Study, group};
use impactlaw::tape::{Checkpoint, Keep, Keeper, TakenUp, Tape, VERSION, sealed};
use impactlaw::unit::{self, DIMENSIONS, engineering};
use impactlaw::view::film::{Film, Frame};
use parry3d::math::Vector;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::Duration;
use syn::visit::{self, Visit};

/// What a reader makes of an input: accepted, or refused. Whatever does not hold of what it accepts panics.
pub type Accepted = bool;

/// A reader.
pub struct Reader {
    /// What it reads.
    pub name: &'static str,
    /// Files of `src` that read it.
    pub sources: &'static [&'static str],
    /// Bytes or text.
    pub kind: Kind,
    /// Inputs it accepts.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Reads an input; the folder is scratch.
    pub read: fn(&[u8], &Path) -> Accepted,
    /// Share of all inputs, about: less for what takes longer.
    pub share: u64,
}

/// All readers.
pub const READERS: &[Reader] = &[
    Reader {
        name: "case",
        sources: &["case.rs", "document.rs", "command/run.rs"],
        kind: Kind::Text,
        seeds: || [shipped("cases", "[impact]"), vec![UNUSUAL.into()]].concat(),
        read: case,
        share: 20,
    },
    Reader {
        name: "scene",
        sources: &["bed/scene/mod.rs"],
        kind: Kind::Text,
        seeds: || shipped("cases", "[[stage]]"),
        read: scene,
        share: 20,
    },
    Reader {
        name: "study",
        sources: &["study.rs"],
        kind: Kind::Text,
        seeds: || {
            vec![
                file("cases/study-480.toml"),
                STUDY.into(),
                MIXED_STUDY.into(),
            ]
        },
        read: study,
        share: 5,
    },
    Reader {
        name: "law",
        sources: &["law/file.rs", "export/source/portable.rs", "command/fit.rs"],
        kind: Kind::Text,
        seeds: || shipped("models", "schema"),
        read: law,
        share: 10,
    },
    Reader {
        name: "results.csv",
        sources: &["discover/table.rs", "command/discover.rs"],
        kind: Kind::Text,
        seeds: || vec![RESULTS.into()],
        read: results,
        share: 5,
    },
    Reader {
        name: "equations",
        sources: &["discover/file.rs"],
        kind: Kind::Text,
        seeds: || vec![EQUATIONS.into()],
        read: equations,
        share: 5,
    },
    Reader {
        name: "curve.csv",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files().0],
        read: curve,
        share: 10,
    },
    Reader {
        name: "summary.json",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files().1, without_sum()],
        read: summary,
        share: 10,
    },
    Reader {
        name: "run.json",
        sources: &["study/kept.rs"],
        kind: Kind::Text,
        seeds: || vec![kept_run()],
        read: run_of_a_study,
        share: 5,
    },
    Reader {
        name: "particle_rebound.csv",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![MAP.into()],
        read: map,
        share: 5,
    },
    Reader {
        name: "impacts of a fit",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files().1],
        read: fitted,
        share: 0,
    },
    Reader {
        name: "footprint.json",
        sources: &["command/cost.rs"],
        kind: Kind::Text,
        seeds: || vec![FOOTPRINT.into()],
        read: |bytes, _| serde_json::from_slice::<Footprint>(bytes).is_ok(),
        share: 5,
    },
    Reader {
        name: "STL",
        sources: &["bed/scene/body.rs"],
        kind: Kind::Text,
        seeds: || vec![file("cases/drum.stl"), TETRAHEDRON.into()],
        read: |bytes, _| import(bytes, Format::Stl),
        share: 10,
    },
    Reader {
        name: "binary STL",
        sources: &["bed/scene/body.rs"],
        kind: Kind::Binary,
        seeds: || vec![binary_tetrahedron()],
        read: |bytes, _| import(bytes, Format::Stl),
        share: 10,
    },
    Reader {
        name: "OBJ",
        sources: &["bed/scene/body.rs"],
        kind: Kind::Text,
        seeds: || vec![OBJ.into()],
        read: |bytes, _| import(bytes, Format::Obj),
        share: 10,
    },
    Reader {
        name: "table of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || GRAIN_TABLES.iter().map(|table| (*table).into()).collect(),
        read: |bytes, _| listed(bytes, listing::Format::Csv),
        share: 5,
    },
    Reader {
        name: "LAMMPS dump of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || vec![GRAIN_DUMP.into()],
        read: |bytes, _| listed(bytes, listing::Format::LammpsDump),
        share: 5,
    },
    Reader {
        name: "LAMMPS data of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || vec![GRAIN_DATA.into()],
        read: |bytes, _| listed(bytes, listing::Format::LammpsData),
        share: 5,
    },
    Reader {
        name: "VTP of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || vec![GRAIN_VTP.into()],
        read: |bytes, _| listed(bytes, listing::Format::Vtp),
        share: 5,
    },
    Reader {
        name: "restart of grains below its sum",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Binary,
        seeds: || vec![kept_grains()[HEAD..].to_vec()],
        read: |bytes, _| listed(&resealed(bytes), listing::Format::Restart),
        share: 5,
    },
    Reader {
        name: "checkpoint",
        sources: &["tape/checkpoint.rs"],
        kind: Kind::Binary,
        seeds: || vec![kept()],
        read: |bytes, folder| taken_up(bytes, folder) && bytes == kept(),
        share: 5,
    },
    Reader {
        name: "checkpoint below its sum",
        sources: &["tape/checkpoint.rs"],
        kind: Kind::Binary,
        seeds: || vec![kept()[HEAD..].to_vec()],
        read: |bytes, folder| taken_up(&resealed(bytes), folder),
        share: 10,
    },
    Reader {
        name: "film",
        sources: &["view/film.rs"],
        kind: Kind::Binary,
        seeds: || vec![sealed(VERSION, |tape| frame().save(tape)).as_bytes()[HEAD..].to_vec()],
        read: film,
        share: 10,
    },
    Reader {
        name: "quantity",
        sources: &["unit.rs"],
        kind: Kind::Text,
        seeds: || {
            DIMENSIONS
                .iter()
                .map(|known| known.example.into())
                .collect()
        },
        read: quantity,
        share: 20,
    },
    Reader {
        name: "command line",
        sources: &[],
        kind: Kind::Text,
        seeds: || COMMANDS.iter().map(|line| (*line).into()).collect(),
        read: command_line,
        share: 10,
    },
];

/// Files of `src` that read, but nothing that anyone writes for the program or that it keeps.
const OTHERS: [(&str, &str); 4] = [
    (
        "command/study_merge.rs",
        "a kept run that was just read and is copied as it is",
    ),
    ("bed/filling/memory.rs", "the system's account of memory"),
    (
        "bed/record/mod.rs",
        "frames of the dump, which are put together as they are",
    ),
    ("command/show/bed.rs", "the picture that was just drawn"),
];

/// A file of the repository.
fn file(name: &str) -> Vec<u8> {
    std::fs::read(root().join(name)).unwrap()
}

fn root() -> PathBuf {
    env!("CARGO_MANIFEST_DIR").into()
}

/// Shipped files of a folder that hold `word`.
fn shipped(folder: &str, word: &str) -> Vec<Vec<u8>> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    paths.sort();
    let texts = paths
        .iter()
        .map(|path| std::fs::read_to_string(path).unwrap());
    let of_this_kind =
        texts.filter(|text| text.contains(word) && !text.contains("young_over_yield"));
    let found: Vec<Vec<u8>> = of_this_kind.map(String::into_bytes).collect();
    assert!(!found.is_empty(), "{folder}");
    found
}

/// The text of an input, as far as it is one; a file that is not is refused before any of these readers.
fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A case that means whatever it says, of a material that hardens, obliquely.
const UNUSUAL: &str = r#"
unusual = ["particle.radius", "material.density", "material.young_modulus", "material.poisson_ratio",
    "material.yield_strength", "material.hardening_modulus", "impact.velocities"]
[particle]
radius = "1 mm"
[material]
density = "2500 kg/m3"
young_modulus = "70 GPa"
poisson_ratio = 0.3
yield_strength = "200 MPa"
hardening_modulus = "1 GPa"
[impact]
velocities = ["1 m/s", "20 m/s"]
angle = "20 deg"
[wall]
friction = 0.3
[accuracy]
tolerance = 0.05
"#;

fn case(bytes: &[u8], _: &Path) -> Accepted {
    let path = root().join("cases/case.toml");
    let Ok(case) = Case::parse(&text(bytes), &path) else {
        return false;
    };
    for plan in plans(&case).unwrap_or_default() {
        assert!(plan.seconds.is_finite() && plan.seconds >= 0.0);
        assert!(plan.estimate.displacement > 0.0 && plan.longest_time.is_finite());
    }
    true
}

/// Results of a study, as far as `discover` looks at them.
const RESULTS: &str = "# made by a test\n\
density_kg_m3,young_modulus_Pa,yield_strength_Pa,poisson_ratio,radius_m,velocity_m_s,restitution,max_force_N,points,status\n\
1000,1e9,1e7,0.3,1e-4,10,0.5,0.01,1200,ok\n\
2000,1e9,1e7,0.3,1e-4,10,0.4,0.015,1200,ok\n\
2000,4e9,1e7,0.3,1e-4,20,0.2,0.03,1300,ok\n\
2000,4e9,2e7,0.3,1e-4,30,0.25,0.05,1300,failed: sheet\n";

fn results(bytes: &[u8], _: &Path) -> Accepted {
    let Ok(table) = Table::parse(&text(bytes), Path::new("results.csv")) else {
        return false;
    };
    let figures: Vec<_> = table.figure("restitution").into_iter().collect();
    if let Ok(inputs) = Inputs::of(&table, &figures) {
        let runs = Runs::of(&table, &inputs);
        assert_eq!(runs.counts.iter().sum::<usize>(), table.rows());
    }
    for bound in ["rho V^2/Y <= 3", &text(bytes)] {
        if let Ok(bound) = Bound::parse(bound, &table) {
            assert!(bound.rows(&table).len() <= table.rows());
        }
    }
    true
}

/// A file of equations.
const EQUATIONS: &str = r#"schema = 1
[provenance]
program = "impactlaw 0.1.0"
results_sha256 = "00ff"
cases = 445
runs = 337
seed = 1
[[group]]
name = "E_Y"
text = "E/Y"
columns = ["young_modulus_Pa", "yield_strength_Pa"]
exponents = [1, -1]
min = 20.0
max = 2560.0
[[undetermined]]
column = "poisson_ratio"
value = 0.35
[[equation]]
figure = "restitution"
chosen = true
formula = "(1 + c1 * E_Y^(1/4) * (1 - V_Vy^(-1))^3 * exp(-c2))^(-1/2)"
scale_columns = []
scale_exponents = []
constants = [0.5, 2.0]
low = [0.4, 1.9]
high = [0.6, 2.1]
bits = 60.0
misfit_bits = 10.0
seen = { mae = 0.01, r2 = 0.99, median_rel = 0.01, p90_rel = 0.05 }
levels = { mae = 0.01, r2 = 0.99, median_rel = 0.01, p90_rel = 0.05 }
materials = { mae = 0.01, r2 = 0.99, median_rel = 0.01, p90_rel = 0.05 }
"#;

fn equations(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new(Path::new("equations.toml"), &text(bytes)[..]);
    let Ok(file) = EquationsFile::parse(&document) else {
        return false;
    };
    for equation in &file.equation {
        let formula = Infix::parse(&equation.formula).unwrap();
        let _ = formula.value(&|name| equation.constant(name).or(Some(2.0)));
    }
    true
}

fn scene(bytes: &[u8], _: &Path) -> Accepted {
    let path = root().join("cases/scene.toml");
    let Ok(scene) = Scene::parse(&text(bytes), &path) else {
        return false;
    };
    let few = |amount: Amount| matches!(amount, Amount::Count(count) if count < 3000);
    let _ = time_step::check(&scene);
    let _ = impactlaw::export::scene::check(&scene);
    if scene.groups.iter().all(|group| few(group.amount))
        && let Ok((grains, _, room)) = insert(&scene, 1)
    {
        assert!(
            grains
                .spheres
                .iter()
                .all(|s| s.centre.is_finite() && s.radius > 0.0)
        );
        for body in scene.all_bodies(&room) {
            let _ = Body::corners(&body);
        }
    }
    true
}

const STUDY: &str = r#"
[particle]
radius = ["250 um"]
[material]
density = ["2000 kg/m3", "8000 kg/m3"]
young_modulus = ["100 GPa"]
young_over_yield = [80]
poisson_ratio = [0.35]
[impact]
velocities = ["20 m/s", "40 m/s"]
[accuracy]
tolerance = 0.2
"#;

/// Ranges, groups in place of quantities, and cases of their own.
const MIXED_STUDY: &str = r#"
samples = [20, 10]
seed = 3
[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = { from = "1 GPa", to = "100 GPa", scale = "log" }
young_over_yield = { from = 20, to = 2560, scale = "log" }
hardening_over_young = [0, 0.01]
poisson_ratio = 0.35
[impact]
rho_V2_over_Y = { from = 0.01, to = 1 }
angle = "30 deg"
[wall]
friction = 0.2
[accuracy]
tolerance = 0.2
[[case]]
name = "one"
[[case]]
material = { yield_strength = "200 MPa", young_modulus = "10 GPa" }
impact = { V_over_Vy = [2, 20] }
"#;

fn study(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new("study.toml".as_ref(), text(bytes));
    let Ok(study) = Study::from_document(&document) else {
        return false;
    };
    for case in study.cases.iter().take(100) {
        assert!(group(case).len() < 200);
    }
    for case in study.cases.iter().take(3) {
        let _ = plans(case);
    }
    true
}

fn law(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new("law.toml".as_ref(), text(bytes));
    let Ok(file) = LawFile::parse(&document) else {
        return false;
    };
    let again = Document::new("again.toml".as_ref(), file.text().unwrap());
    same(&LawFile::parse(&again).unwrap(), &file);
    match file.law().unwrap() {
        FittedLaw::Hertz(_) => {}
        FittedLaw::ClosedForm(law) => yields_no_energy(&law),
        FittedLaw::Spline(law) => yields_no_energy(&law),
    }
    let portable = Portable::new(file, None, document.hash()).unwrap();
    for target in [Target::C, Target::Liggghts] {
        for artifact in target.export(&portable).unwrap() {
            let parts = Path::new(&artifact.name).components();
            let is_below = |part| matches!(part, std::path::Component::Normal(_));
            assert!(parts.into_iter().all(is_below), "{}", artifact.name);
        }
    }
    true
}

/// Unloading stays between nothing and the loading curve, and a later branch below an earlier one.
fn yields_no_energy<L: Loading>(law: &Elastoplastic<L>) {
    let departure = law.loading().departure() * law.units().flattening;
    let deepest = 2.0f64.max(1.0001 * departure);
    let ladder = |k: f64| departure * (deepest / departure).powf(k / 12.0);
    for k in 0..12 {
        let (early, late) = (ladder(f64::from(k) + 1e-6), ladder(f64::from(k) + 1.0));
        for part in [0.999_999, 0.99, 0.7, 0.3, 0.01] {
            let at = early * part;
            let [mut a, mut b] = [law.memory(early), law.memory(late)];
            let [upper, lower] = [law.force(at, &mut a), law.force(at, &mut b)];
            let loading = law.force(at, &mut law.memory(0.0));
            let margin = 1.0 + 1e-9;
            assert!(upper >= 0.0 && lower >= 0.0, "tensile at {at:e}");
            assert!(
                upper <= loading * margin,
                "above loading at {at:e} after {early:e}"
            );
            assert!(
                lower <= upper * margin,
                "branches cross at {at:e} after {late:e}"
            );
            assert!(law.stiffness(at, &a).is_finite());
        }
        assert!(
            law.dissipated(&law.memory(late))
                >= -1e-9 * law.force(late, &mut law.memory(0.0)) * late
        );
    }
}

const SPEEDS: [f64; 3] = [10.0, 20.0, 50.0];

/// An impact at 10 m/s, as its two files.
fn impact_files() -> (Vec<u8>, Vec<u8>) {
    static FILES: LazyLock<(Vec<u8>, Vec<u8>)> = LazyLock::new(written_impact);
    FILES.clone()
}

fn written_impact() -> (Vec<u8>, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let [mut slow, _] = impacts::references();
    slow.curve.samples = slow.curve.samples.into_iter().step_by(20).collect();
    slow.write(folder.path(), "seed").unwrap();
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    (read("curve.csv"), read("summary.json"))
}

/// Bits of numbers that may be NaN, as text.
fn same<T: std::fmt::Debug>(a: &T, b: &T) {
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}

fn curve(bytes: &[u8], folder: &Path) -> Accepted {
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
fn without_sum() -> Vec<u8> {
    let text = String::from_utf8(impact_files().1).unwrap();
    let (figures, _) = text.rsplit_once(",\n  \"sha256\"").unwrap();
    format!("{figures}\n}}\n").into_bytes()
}

fn summary(bytes: &[u8], folder: &Path) -> Accepted {
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
fn kept_case() -> Case {
    impacts::case(impacts::MATERIAL, &SPEEDS[..1])
}

fn kept_run() -> Vec<u8> {
    let (folder, case) = (tempfile::tempdir().unwrap(), kept_case());
    KeptRun::of(&case, &group(&case))
        .write(folder.path())
        .unwrap();
    std::fs::read(folder.path().join(KeptRun::FILE)).unwrap()
}

/// A mark that carries its sum is taken as it was written or not at all.
fn run_of_a_study(bytes: &[u8], folder: &Path) -> Accepted {
    let (curve, summary) = impact_files();
    std::fs::write(folder.join("curve.csv"), curve).unwrap();
    std::fs::write(folder.join("summary.json"), summary).unwrap();
    std::fs::write(folder.join(KeptRun::FILE), bytes).unwrap();
    let case = kept_case();
    let found = KeptRun::figures(folder, &group(&case), &case);
    assert!(found.is_none() || bytes == kept_run());
    found.is_some()
}

const MAP: &str = "# seed\npart,r_m,z_m,size_m,equivalent_plastic_strain,von_mises_Pa\n\
                   inside,1e-6,2e-6,1e-7,0.1,1e9\nsurface,0.0,2.5e-4,0.0,0.0,-0.0\n";

fn map(bytes: &[u8], folder: &Path) -> Accepted {
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
fn fitted(bytes: &[u8], _: &Path) -> Accepted {
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

const FOOTPRINT: &str = r#"{
  "memory_bytes": 123456,
  "transfer_loss": 1.5e-3,
  "cpu_s": 0.25
}"#;

const TETRAHEDRON: &str = "solid t
facet normal 0 0 -1
 outer loop
  vertex 0 0 0
  vertex 0 1 0
  vertex 1 0 0
 endloop
endfacet
facet normal 0 -1 0
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 0 0 1
 endloop
endfacet
facet normal -1 0 0
 outer loop
  vertex 0 0 0
  vertex 0 0 1
  vertex 0 1 0
 endloop
endfacet
facet normal 1 1 1
 outer loop
  vertex 1 0 0
  vertex 0 1 0
  vertex 0 0 1
 endloop
endfacet
endsolid t
";

const OBJ: &str = "# t
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vn 0 0 1
f 1 3 2
f 1/1 2/1 4/1
f 1//1 4//1 3//1
f -3/1/1 -2/1/1 -1/1/1
";

/// The tetrahedron as single-precision facets.
fn binary_tetrahedron() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(4u32.to_le_bytes());
    for corners in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
        bytes.extend([0; 12]);
        for corner in corners {
            for axis in 1..4 {
                bytes.extend(f32::from(u8::from(corner == axis)).to_le_bytes());
            }
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn import(bytes: &[u8], format: Format) -> Accepted {
    let Ok(import) = mesh::read(bytes, format, 1e-3, 1e-7) else {
        return false;
    };
    assert!(import.solid.extent().is_finite() && import.solid.reach().is_finite());
    if let Ok(Some(volume)) = import.solid.volume(1e-3) {
        assert!(volume.is_finite());
    }
    true
}

/// Grains in a table: with units, with blanks, with types.
const GRAIN_TABLES: [&str; 3] = [
    "x (mm),y (mm),z (mm),radius (mm),material\n5,6,7,1,glass\n10,12.5,20,1.5,steel\n",
    "# packing\nid x y z diameter vx vy vz\n1 0.1 0.2 0.3 0.01 0 0 -1\n2 0.2 0.2 0.3 0.01 1 0 0\n",
    "type;x;y;z;r\r\n1;0;0;0;1e-3\r\n2;1;0;0;1e-3\r\n",
];

const GRAIN_DUMP: &str = "ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 1
0 1
0 2
ITEM: ATOMS id type xs ys zs radius vx vy vz
1 1 0.25 0.5 0.25 0.01 0 0 -1
2 2 0.5 0.5 0.75 0.02 0 0 0
";

const GRAIN_DATA: &str = "grains

2 atoms
2 atom types

0 1 xlo xhi
0 1 ylo yhi
0 2 zlo zhi

Atoms # sphere

1 1 0.02 2500 0.25 0.5 0.5
2 2 0.04 2500 0.5 0.5 1.5

Velocities

1 0 0 -1 0 0 0
2 0 0 0 0 0 0
";

const GRAIN_VTP: &str = r#"<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="2" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0</DataArray></Points>
<PointData><DataArray type="Float64" Name="radius" format="ascii">0.25 0.5</DataArray></PointData>
</Piece></PolyData></VTKFile>
"#;

/// What an interrupted bed keeps first: its grains.
fn kept_grains() -> Vec<u8> {
    let mut grains = Grains::default();
    grains.add(Vector::new(0.0, 0.0, 1.0), 0.25, 2500.0);
    grains.add(Vector::new(1.0, 0.0, 1.0), 0.5, 2500.0);
    let run = |tape: &mut Tape| {
        [0u64; 4].save(tape); // whose it is
        0f64.save(tape); // seconds so far
        grains.save(tape);
    };
    sealed(VERSION, run).as_bytes().to_vec()
}

/// Grains of a file: numbers that a bed can use.
fn listed(bytes: &[u8], format: listing::Format) -> Accepted {
    let Ok(listing) = listing::read(bytes, format, &listing::Meaning::default()) else {
        return false;
    };
    for grain in &listing.grains {
        let vectors = [grain.centre, grain.velocity, grain.spin];
        assert!(vectors.iter().all(|vector| vector.is_finite()), "{grain:?}");
        let sizes = [grain.radius, grain.density, grain.mass];
        let sound = |size: &f64| size.is_finite() && *size > 0.0;
        assert!(sizes.iter().flatten().all(sound), "{grain:?}");
        let known = |kind: &usize| *kind < listing.kinds.len();
        assert!(grain.kind.iter().all(known), "{grain:?}");
    }
    true
}

/// Bytes of a checkpoint up to the version: what marks it, and its sum.
const HEAD: usize = 40;
const PLAN: &str = "plan";

/// What a run keeps: numbers, names, lists of lists, things that may be absent.
#[derive(Debug, Clone, Default, PartialEq)]
struct Run {
    frame: Frame,
    lists: Vec<Vec<u32>>,
    place: Option<(f64, usize)>,
}

impl Keep for Run {
    fn save(&self, tape: &mut Tape) {
        self.frame.save(tape);
        self.lists.save(tape);
        self.place.save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.frame.load(tape)?;
        self.lists.load(tape)?;
        self.place.load(tape)
    }
}

fn frame() -> Frame {
    Frame {
        time: 0.5,
        stage: "settle".to_owned(),
        ids: (0..9).collect(),
        centres: vec![[1.0, -2.0, 3.5]; 9],
        radii: vec![0.5; 9],
        materials: vec![1; 9],
        groups: vec![0; 9],
        speed: vec![0.25; 9],
        plastic: vec![0.0; 9],
        squeeze: vec![1.0; 9],
        poses: vec![[0.0; 7]; 2],
        gone: vec![1],
    }
}

fn kept() -> Vec<u8> {
    static KEPT: LazyLock<Vec<u8>> = LazyLock::new(written_checkpoint);
    KEPT.clone()
}

fn written_checkpoint() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let checkpoint = Checkpoint::new(&folder.path().join("c.bin"), Duration::ZERO);
    let run = Run {
        frame: frame(),
        lists: vec![vec![1, 2, 3], Vec::new(), vec![7]],
        place: Some((1e-3, 5)),
    };
    Keeper::new(&checkpoint, PLAN).keep(&run).unwrap();
    std::fs::read(checkpoint.path()).unwrap()
}

/// What stands below the sum of a checkpoint, under a sum that fits.
fn resealed(below: &[u8]) -> Vec<u8> {
    let head = &kept()[..8];
    [head, &Sha256::digest(below)[..], below].concat()
}

fn taken_up(bytes: &[u8], folder: &Path) -> Accepted {
    let checkpoint = Checkpoint::new(&folder.join("c.bin"), Duration::ZERO);
    std::fs::write(checkpoint.path(), bytes).unwrap();
    let mut run = Run::default();
    Keeper::new(&checkpoint, PLAN).take_up_into(&mut run) == TakenUp::Run
}

/// A frame below its sum.
fn film(bytes: &[u8], folder: &Path) -> Accepted {
    std::fs::write(folder.join("00000.bin"), resealed(bytes)).unwrap();
    Film::new(folder).frame(0).is_ok()
}

fn quantity(bytes: &[u8], _: &Path) -> Accepted {
    let text = text(bytes);
    let mut accepted = false;
    for known in DIMENSIONS {
        match (known.parse)(&text) {
            Ok(value) => {
                assert!(value.is_finite());
                accepted = true;
                let _ = (engineering(value, "m", 3), unit::significant(value, 4));
            }
            Err(error) => assert!(error.allowed.contains(known.example)),
        }
    }
    accepted
}

/// Command lines, a word a line.
const COMMANDS: [&str; 6] = [
    "impactlaw\nrun\ncases/solder-ball.toml\n--out\no\n--no-bed\n--seed\n3",
    "impactlaw\n-v\nimpact\nc.toml\n--velocity\n10 m/s\n--checkpoint\n30 s\n--threads\n2",
    "impactlaw\nbed\ns.toml\n--law\nlaw.toml\n--seed\n18446744073709551615",
    "impactlaw\nbed\nexport\ns.toml\n--to\nlammps",
    "impactlaw\nexport\nlaw.toml\n--to\nc\n--check",
    "impactlaw\nstudy\ns.toml\n--refine\n20",
];

fn command_line(bytes: &[u8], _: &Path) -> Accepted {
    let text = text(bytes);
    match Cli::try_parse_from(text.split('\n')) {
        Ok(_) => true,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

/// Calls by which a file of `src` reads something: ends of paths, and `document.parse()`.
const CALLS: [[&str; 2]; 9] = [
    ["fs", "read"],
    ["fs", "read_to_string"],
    ["File", "open"],
    ["Document", "read"],
    ["serde_json", "from_str"],
    ["serde_json", "from_slice"],
    ["serde_json", "from_reader"],
    ["toml", "from_str"],
    ["mesh", "read"],
];

/// Whether the code of a file, its tests left out, reads.
#[derive(Default)]
struct Reads(bool);

impl<'ast> Visit<'ast> for Reads {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !item
            .attrs
            .iter()
            .any(|attribute| attribute.path().is_ident("cfg"))
        {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.0 |= CALLS
            .iter()
            .any(|call| names.ends_with(&call.map(str::to_owned)));
        visit::visit_path(self, path);
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        if let syn::Expr::Path(receiver) = &*call.receiver {
            self.0 |= call.method == "parse" && receiver.path.is_ident("document");
        }
        visit::visit_expr_method_call(self, call);
    }
}

#[test]
fn every_file_that_reads_stands_in_the_list() {
    let reads = |text: &str| {
        let mut found = Reads::default();
        found.visit_file(&syn::parse_file(text).unwrap());
        found.0
    };
    assert!(reads("fn f() { std::fs::read(p).map(g) }"));
    assert!(!reads(
        "#[cfg(test)] mod t { fn f() { std::fs::read(p); } }"
    ));
    let all = sources().into_iter().filter(|(_, text)| reads(text));
    let found: BTreeSet<String> = all.map(|(path, _)| path.display().to_string()).collect();
    let listed = READERS
        .iter()
        .flat_map(|reader| reader.sources.iter().copied());
    let listed = listed.filter(|source| *source != "unit.rs");
    let listed = listed.chain(OTHERS.iter().map(|(source, _)| *source));
    let listed: BTreeSet<String> = listed.map(str::to_owned).collect();
    assert_eq!(found, listed);
}
