//! References of the guide: every key a reader accepts and every column a writer writes has its line, and no other.

use crate::program::{impactlaw, message};
use clap::CommandFactory;
use impactlaw::bed::scene::Scene;
use impactlaw::case::Case;
use impactlaw::cli::Cli;
use impactlaw::command::help::{self, markdown};
use impactlaw::command::schema::FILES;
use impactlaw::cost::accuracy::Line;
use impactlaw::curve::files::FromFiles;
use impactlaw::curve::{Adhering, Cylinder, Heating, SchemeFigures, Summary, Tangential};
use impactlaw::discover::file::EquationsFile;
use impactlaw::document::Document;
use impactlaw::document::reference::{Section as Place, sections, sentence};
use impactlaw::law::LawFile;
use impactlaw::material::Flow;
use impactlaw::material::flow::{InSi, Spelling};
use impactlaw::study::Study;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A chapter of the guide.
fn chapter(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("src/guide")
        .join(name);
    std::fs::read_to_string(path).unwrap()
}

/// A heading of a reference with the names its table explains.
struct Section {
    heading: String,
    names: BTreeSet<String>,
}

/// Code spans of a line.
fn spans(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Sections of a reference: each heading below `level`, with the names in the first cells of its table.
fn headings(text: &str, level: &str) -> Vec<Section> {
    let mut all: Vec<Section> = Vec::new();
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix(level) {
            all.push(Section {
                heading: heading.to_owned(),
                names: BTreeSet::new(),
            });
        } else if let (true, Some(section)) = (line.starts_with("| `"), all.last_mut()) {
            let cell = line.split('|').nth(1).unwrap();
            for name in spans(cell) {
                let new = section.names.insert(name.to_owned());
                assert!(new, "{}: {name} twice", section.heading);
            }
        }
    }
    all
}

/// What the reader of a kind of file says of a text it refuses.
fn refusal(kind: &str, text: &str) -> String {
    let text = match kind {
        "law" => format!("schema = 1\n{text}"),
        _ => text.to_owned(),
    };
    let document = Document::new(Path::new("file.toml"), &text[..]);
    let error = match kind {
        "case" => Case::from_document(&document).err(),
        "study" => Study::from_document(&document).err(),
        "scene" => Scene::parse(&text, Path::new("file.toml")).err(),
        "law" => LawFile::parse(&document).err(),
        "equations" => EquationsFile::parse(&document).err(),
        other => panic!("no reader of {other}"),
    };
    error
        .unwrap_or_else(|| panic!("accepted: {text}"))
        .to_string()
}

/// Names a reader says it would have taken instead of `wrong`.
fn expected(message: &str, wrong: &str) -> BTreeSet<String> {
    let (_, rest) = message
        .split_once(&format!("`{wrong}`, "))
        .unwrap_or_else(|| panic!("not about {wrong}: {message}"));
    spans(rest).into_iter().map(str::to_owned).collect()
}

#[test]
fn the_readers_know_every_key_that_is_described_and_no_other() {
    let mut count = 0;
    for file in FILES {
        let root = file.table();
        for section in sections(&root) {
            let opening = section.opening.join("\n");
            let said = refusal(file.name, &format!("{opening}\nzz = 0\n"));
            let described: BTreeSet<String> = section
                .table
                .keys
                .iter()
                .map(|key| key.name.clone())
                .collect();
            count += described.len();
            if described.is_empty() {
                assert!(said.contains("`zz`"), "{said}");
                continue;
            }
            assert_eq!(
                described,
                expected(&said, "zz"),
                "{}, {opening}: {said}",
                file.name
            );
        }
    }
    assert!(count > 250, "{count}");
}

/// The keys of a table that must be there with their examples, one left out; tables are left to their own sections.
fn without(section: &Place, left_out: &str) -> Option<String> {
    let mut text = section.opening.join("\n");
    for key in section
        .table
        .keys
        .iter()
        .filter(|key| key.line.default.is_none())
    {
        if !key.kind.tables().is_empty() {
            return None;
        }
        if key.name != left_out {
            text += &format!("\n{} = {}", key.name, key.line.example());
        }
    }
    Some(text + "\n")
}

#[test]
fn keys_without_a_default_must_be_there_and_no_other() {
    let mut count = 0;
    for file in FILES {
        let root = file.table();
        let all = sections(&root);
        for section in all.iter().filter(|section| !section.opening.is_empty()) {
            let Some(whole) = without(section, "") else {
                continue;
            };
            let (keys, inside) = (&section.table.keys, |said: &str, name: &str| {
                said.contains(&format!("missing field `{name}`"))
            });
            let said = refusal(file.name, &whole);
            for key in keys {
                let required = key.line.default.is_none();
                let outside = all[0].table.key(&key.name).is_some();
                assert!(outside || !inside(&said, &key.name), "{whole}: {said}");
                if required {
                    let text = without(section, &key.name).unwrap();
                    let said = refusal(file.name, &text);
                    assert!(inside(&said, &key.name), "{text}: {said}");
                    count += 1;
                }
            }
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn the_reference_of_the_guide_is_what_the_readers_are_made_of() {
    let text = markdown();
    assert!(
        chapter("keys.md") == text,
        "src/guide/keys.md is not `impactlaw help --markdown`: write it anew"
    );
    for line in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        assert_eq!(cells.len(), 8, "{line}");
        // type, default, example and meaning are never empty; a range may be
        for cell in [2, 4, 5, 6] {
            assert!(!cells[cell].is_empty() && cells[cell] != "``", "{line}");
        }
    }
}

/// "density is density: density" was said once.
#[test]
fn no_sentence_about_a_key_repeats_its_name_or_itself() {
    for file in FILES {
        let root = file.table();
        for section in sections(&root) {
            for key in &section.table.keys {
                let said = sentence(key);
                let twice = format!("{0}; {0},", key.line.meaning);
                assert!(!said.starts_with(&twice), "{}: {said}", key.name);
            }
        }
    }
}

#[test]
fn help_of_every_file_fits_a_terminal_of_80_columns() {
    for file in FILES {
        let text = help::text(Cli::command(), &[file.name.to_owned()]).unwrap();
        let keys = text.split("Keys of a ").nth(1).unwrap();
        for line in keys.lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
        let names = file.table().keys.into_iter().map(|key| key.name);
        for name in names {
            assert!(keys.contains(&format!("\n  {name} ")), "{name}");
        }
    }
    let part = help::text(
        Cli::command(),
        &["scene".to_owned(), "body.free".to_owned()],
    )
    .unwrap();
    assert!(
        part.contains("max_torque") && !part.contains("rayleigh"),
        "{part}"
    );
    assert!(help::text(Cli::command(), &["scene".to_owned(), "nothing".to_owned()]).is_err());
    let key = help::text(Cli::command(), &["restitution".to_owned()]).unwrap();
    for place in [
        "scene file  [contact]",
        "scene file  [[pair]]",
        "law file  [[closed_form.quality]]",
    ] {
        assert!(key.contains(place), "{place}: {key}");
    }
    assert!(help::text(Cli::command(), &["nothing".to_owned()]).is_err());
}

/// Names in the table under each heading of the reference of columns, by the code spans of the heading.
pub fn columns() -> BTreeMap<String, BTreeSet<String>> {
    headings(&chapter("columns.md"), "## ")
        .into_iter()
        .map(|section| (section.heading.replace('`', ""), section.names))
        .collect()
}

/// Keys of an impact's summary that a normal impact without incident lacks.
const MAY_BE_ABSENT: [&str; 7] = [
    "adhesion",
    "cylinder",
    "heating",
    "scheme",
    "tangential",
    "target",
    "warnings",
];
/// Keys of an impact's summary that are no figures, and not in `results.csv`; in the order of the alphabet.
const NO_FIGURES: [&str; 10] = [
    "adhesion",
    "cylinder",
    "heating",
    "particle",
    "scheme",
    "sha256",
    "tangential",
    "target",
    "wall_s",
    "warnings",
];

/// Heading under which the columns of a file stand.
fn heading(file: &Path) -> String {
    let name = file.file_name().unwrap().to_string_lossy().into_owned();
    let beds = file.iter().any(|part| part == "bed");
    match &name[..] {
        "summary.json" if beds => "summary.json of a bed".to_owned(),
        "summary.json" => "summary.json of an impact".to_owned(),
        "particle_compressed.csv"
        | "particle_rebound.csv"
        | "target_compressed.csv"
        | "target_rebound.csv" => "particle_compressed.csv, particle_rebound.csv".to_owned(),
        _ if name.starts_with("contacts_") => "contacts_NNNN.csv".to_owned(),
        _ if name.starts_with("cost_V") => "cost_V*.csv".to_owned(),
        _ => name,
    }
}

/// Columns of CSV text; none of a file without rows.
fn header(text: &str) -> BTreeSet<String> {
    let line = text.lines().find(|line| !line.starts_with('#'));
    line.map_or_else(BTreeSet::new, |line| {
        line.split(',').map(str::to_owned).collect()
    })
}

/// Keys of a JSON object.
pub fn keys(text: &str) -> BTreeSet<String> {
    let value: serde_json::Value = serde_json::from_str(text).unwrap();
    value.as_object().unwrap().keys().cloned().collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let is = |name: &str| path.extension().is_some_and(|end| end == name);
        if path.is_dir() {
            files(&path, found);
        } else if is("csv") || path.ends_with("summary.json") {
            found.push(path);
        }
    }
}

/// That the columns of every file below `folder` stand in the reference, and no other; the headings that were met.
pub fn assert_described(folder: &Path) -> BTreeSet<String> {
    let (reference, mut found, mut met) = (columns(), Vec::new(), BTreeSet::new());
    files(folder, &mut found);
    for file in found {
        let text = std::fs::read_to_string(&file).unwrap();
        if header(&text).is_empty() {
            continue;
        }
        let under = heading(&file);
        let described = reference
            .get(&under)
            .unwrap_or_else(|| panic!("no heading {under} for {}", file.display()));
        let impact = &reference["summary.json of an impact"];
        let written: BTreeSet<String> = match &under[..] {
            "summary.json of an impact" => {
                let absent = MAY_BE_ABSENT.map(str::to_owned);
                keys(&text).into_iter().chain(absent).collect()
            }
            "summary.json of a bed" => keys(&text),
            // friction alone has a force along the wall, a deformable wall alone a dent, adhesion alone an energy of the surfaces
            "curve.csv" => {
                let absent = ["surface_J", "tangential_force_N", "target_displacement_m"];
                let absent = absent.map(str::to_owned);
                header(&text).into_iter().chain(absent).collect()
            }
            "results.csv" => {
                let all = header(&text);
                let figures: BTreeSet<String> = all.intersection(impact).cloned().collect();
                let left_out = impact.difference(&figures).map(String::as_str);
                assert!(left_out.eq(NO_FIGURES), "{figures:?}");
                all.difference(impact).cloned().collect()
            }
            _ => header(&text),
        };
        assert_eq!(*described, written, "{}", file.display());
        met.insert(under);
    }
    met
}

const CASE: &str = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"100 GPa\"\n\
    poisson_ratio = 0.35\nyield_strength = \"1.25 GPa\"\n[impact]\nvelocities = [\"10 m/s\", \"20 m/s\"]\n[accuracy]\n\
    tolerance = 0.2\n[bed]\nscene = \"scene.toml\"\n";

const SCENE: &str = "laws = [\"fitted\", \"hertz\"]\nseed = 1\ngravity = \"9.81 m/s2\"\n[material]\ndensity = \"8000 kg/m3\"\n\
    young_modulus = \"100 GPa\"\npoisson_ratio = 0.35\nyield_strength = \"1.25 GPa\"\n[grains]\ncount = 8\n\
    radius = \"250 um\"\nvelocity = [\"0 m/s\", \"0 m/s\", \"-20 m/s\"]\n[box]\nwidth = \"1.2 mm\"\ndepth = \"1.2 mm\"\n[[stage]]\nkind = \"run\"\nsteps = 600\n[output]\n\
    rows = 4\nframes = 4\nfilm = 0\ncontacts = true\n";

const STUDY: &str = "[particle]\nradius = [\"250 um\"]\n[material]\ndensity = [\"8000 kg/m3\"]\nyoung_modulus = [\"100 GPa\"]\n\
    young_over_yield = [80]\npoisson_ratio = [0.35]\n[impact]\nvelocities = [\"20 m/s\"]\n[accuracy]\ntolerance = 0.2\n";

/// What the program prints for `arguments`.
fn printed(folder: &Path, arguments: &[&str]) -> String {
    let output = impactlaw(folder, arguments);
    assert!(output.status.code() != Some(2), "{}", message(&output));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_column_of_every_file_has_its_line_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for (name, text) in [
        ("case.toml", CASE),
        ("scene.toml", SCENE),
        ("s.toml", STUDY),
    ] {
        std::fs::write(here.join(name), text).unwrap();
    }
    printed(here, &["run", "case.toml", "--out", "out"]);
    printed(
        here,
        &["study", "s.toml", "--out", "study", "--refine", "1"],
    );
    let results = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/study-480.csv");
    let quick = ["--size", "2", "--rounds", "0", "--target", "restitution"];
    let discover = ["discover", results, "--out", "found"];
    printed(here, &[&discover[..], &quick].concat());
    printed(here, &["study", "report", results, "--out", "reported"]);
    printed(here, &["validate", "lead-nickel", "--out", "validated"]);
    let met = assert_described(here);

    let reference = columns();
    let theory = ["theory", "hertz", "case.toml"];
    let law = [
        "law",
        "eval",
        "out/law.toml",
        "--body",
        "250 um",
        "--displacements",
        "1 um",
    ];
    let tables = [
        (
            "Output of theory --displacements",
            printed(here, &[&theory[..], &["--displacements", "1 um"]].concat()),
        ),
        (
            "Output of theory --velocities",
            printed(here, &[&theory[..], &["--velocities", "1 m/s"]].concat()),
        ),
        ("Output of law eval", printed(here, &law)),
    ];
    for (heading, text) in &tables {
        assert_eq!(reference[*heading], header(text), "{heading}");
    }
    printed(
        here,
        &[
            "export",
            "out/law.toml",
            "--to",
            "table",
            "--out",
            "exported",
        ],
    );
    let table = std::fs::read_to_string(here.join("exported/table/case.csv")).unwrap();
    assert_eq!(reference["NAME.csv of target table"], header(&table));

    // the rest: a part of a summary, and the files of `cost`, which tests/cli/cost.rs writes
    let text = std::fs::read_to_string(here.join("out/impact_V10/summary.json")).unwrap();
    let mut summary: Summary = serde_json::from_str(&text).unwrap();
    summary.tangential = Some(Tangential {
        incident_velocity_m_s: 1.0,
        velocity_m_s: 1.0,
        restitution: Some(1.0),
        angular_velocity_rad_s: 1.0,
        impulse_ratio: 1.0,
    });
    summary.cylinder = Some(Cylinder {
        final_length_m: 1.0,
        foot_diameter_m: 1.0,
        diameter_at_fifth_m: 1.0,
    });
    summary.heating = Some(Heating {
        heat_ratio: 0.8,
        stored_work_ratio: 0.1,
        max_temperature_k: 400.0,
        mean_temperature_k: 300.0,
    });
    summary.adhesion = Some(Adhering {
        work_of_adhesion_j_m2: 1.0,
        range_m: 1.0,
        maugis_number: 1.0,
        sticking_velocity_m_s: 1.0,
        pull_off_force_n: 1.0,
        surface_energy_ratio: 1.0,
        contact_loss_ratio: 1.0,
    });
    let value = serde_json::to_value(&summary).unwrap();
    for part in ["adhesion", "cylinder", "heating", "tangential"] {
        let described = &reference[&format!("{part} of summary.json")];
        assert_eq!(*described, keys(&value[part].to_string()), "{part}");
    }
    // constants of a flow stress stand there where the particle has them
    let mut particle = keys(&value["particle"].to_string());
    particle.extend(Flow::all_constants().iter().map(InSi::key));
    // and the length where it is a cylinder
    particle.insert("length_m".to_owned());
    assert_eq!(reference["particle of summary.json"], particle);
    // tests/cli/preset.rs runs one
    let files = FromFiles {
        interval_s: 1.0,
        count: 1,
        max_force_n: 1.0,
        max_displacement_m: 1.0,
        contact_time_s: 1.0,
    };
    let scheme = SchemeFigures {
        preset: String::new(),
        settings: String::new(),
        time_step_s: Some(1.0),
        transfer_loss_ratio: 0.0,
        files: Some(files),
    };
    let of_scheme = serde_json::to_string(&scheme).unwrap();
    assert_eq!(reference["scheme of summary.json"], keys(&of_scheme));
    let of_files = serde_json::to_string(&files).unwrap();
    assert_eq!(reference["files of scheme"], keys(&of_files));
    let elsewhere = [
        "scheme of summary.json",
        "files of scheme",
        // tests/impact/cost_thesis.rs makes its rows
        "chapter_3.csv",
        "cylinder of summary.json",
        "adhesion of summary.json",
        "heating of summary.json",
        "particle of summary.json",
        "tangential of summary.json",
        // tests/cli/pair.rs writes one
        "target of summary.json",
        "NAME.csv of target table",
        "cost_V*.csv",
        "cost_accuracy.csv",
        // tests/cli/bed_shipped.rs runs one
        "oedometer.csv",
        "repeats.csv", // tests/cli/impact.rs throws a particle again
    ];
    let met: BTreeSet<String> = met
        .into_iter()
        .chain(tables.iter().map(|(heading, _)| (*heading).to_owned()))
        .chain(elsewhere.map(str::to_owned))
        .collect();
    assert_eq!(reference.into_keys().collect::<BTreeSet<_>>(), met);
}

#[test]
fn the_table_of_equal_accuracy_has_a_line_for_every_column() {
    let line = Line {
        velocity_m_s: 1.0,
        severity: None,
        lattice: String::new(),
        best_points: 1,
        best_error: 1.0,
        best_s: 1.0,
        same_s: None,
        same_ratio: None,
        same_solid_s: None,
        same_solid_ratio: None,
        order: 1.0,
        reached: true,
        target_s: None,
        planned_s: None,
        planned_error: None,
        target_ratio: None,
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.serialize(&line).unwrap();
    let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
    assert_eq!(columns()["cost_accuracy.csv"], header(&text));
}
