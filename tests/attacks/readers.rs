//! Every reader of what comes from outside: its seeds, and what must hold of an input it accepts.
//!
//! The list is held to the source: a file of `src` that reads and stands in no line of it fails the test at the end.

mod checkpoints;
mod explorer;
mod grains;
mod impact_files;
mod inputs;
mod results;
mod shapes;
mod words;

use crate::four_cases::FOUR_CASES;
use crate::mutate::Kind;
use crate::sources::sources;
use impactlaw::cost::Footprint;
use impactlaw::dem::bodies::mesh::Format;
use impactlaw::listing;
use impactlaw::tape::{Keep, VERSION, sealed};
use impactlaw::unit::DIMENSIONS;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
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
        sources: &["case.rs", "case/pair.rs", "document.rs", "command/run.rs"],
        kind: Kind::Text,
        seeds: || [shipped("cases", "[impact]"), vec![inputs::UNUSUAL.into()]].concat(),
        read: inputs::case,
        share: 20,
    },
    Reader {
        name: "scene",
        sources: &["bed/scene/mod.rs"],
        kind: Kind::Text,
        seeds: || shipped("cases", "[[stage]]"),
        read: inputs::scene,
        share: 20,
    },
    Reader {
        name: "study",
        sources: &["study.rs"],
        kind: Kind::Text,
        seeds: || {
            vec![
                file("cases/study-480.toml"),
                FOUR_CASES.into(),
                inputs::MIXED_STUDY.into(),
            ]
        },
        read: inputs::study,
        share: 5,
    },
    Reader {
        name: "law",
        sources: &["law/file.rs", "export/source/portable.rs", "command/fit.rs"],
        kind: Kind::Text,
        seeds: || shipped("models", "schema"),
        read: inputs::law,
        share: 10,
    },
    Reader {
        name: "question of the explorer",
        sources: &["explore/answer.rs"],
        kind: Kind::Text,
        seeds: explorer::questions,
        read: explorer::question,
        share: 3,
    },
    Reader {
        name: "laws as WebAssembly",
        sources: &["command/explore.rs"],
        kind: Kind::Binary,
        seeds: explorer::modules,
        read: explorer::module,
        share: 1,
    },
    Reader {
        name: "law of a pair",
        sources: &["law/pair.rs"],
        kind: Kind::Text,
        seeds: inputs::laws_of_pairs,
        read: inputs::law_of_pair,
        share: 5,
    },
    Reader {
        name: "results.csv",
        sources: &[
            "discover/table.rs",
            "command/discover.rs",
            "command/discover_add.rs",
        ],
        kind: Kind::Text,
        seeds: || vec![results::RESULTS.into(), results::WRITTEN.into()],
        read: results::results,
        share: 5,
    },
    Reader {
        name: "results.csv of a report",
        sources: &["command/study_report.rs"],
        kind: Kind::Text,
        seeds: || vec![results::reported().into()],
        read: results::report,
        share: 5,
    },
    Reader {
        name: "measured impacts",
        sources: &["command/inverse.rs"],
        kind: Kind::Text,
        seeds: || vec![results::MEASURED.into(), results::FLATS.into()],
        read: results::measured,
        share: 5,
    },
    Reader {
        name: "measured speeds of a tester",
        sources: &["command/tester.rs"],
        kind: Kind::Text,
        seeds: || vec![results::THROWN.into()],
        read: results::thrown,
        share: 5,
    },
    Reader {
        name: "measurements of an experiment",
        sources: &["command/validate.rs"],
        kind: Kind::Text,
        seeds: || {
            vec![
                file("cases/experiments/balls.csv"),
                file("cases/experiments/impact-tester.csv"),
            ]
        },
        read: results::experiment,
        share: 5,
    },
    Reader {
        name: "equations",
        sources: &["discover/file.rs"],
        kind: Kind::Text,
        seeds: || vec![results::EQUATIONS.into()],
        read: results::equations,
        share: 5,
    },
    Reader {
        name: "curve.csv",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files::impact_files().0],
        read: impact_files::curve,
        share: 10,
    },
    Reader {
        name: "summary.json",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files::impact_files().1, impact_files::without_sum()],
        read: impact_files::summary,
        share: 10,
    },
    Reader {
        name: "run.json",
        sources: &["study/kept.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files::kept_run()],
        read: impact_files::run_of_a_study,
        share: 5,
    },
    Reader {
        name: "particle_rebound.csv",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files::MAP.into()],
        read: impact_files::map,
        share: 5,
    },
    Reader {
        name: "impacts of a fit",
        sources: &["curve.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files::impact_files().1],
        read: impact_files::fitted,
        share: 0,
    },
    Reader {
        name: "footprint.json",
        sources: &["command/cost.rs"],
        kind: Kind::Text,
        seeds: || vec![impact_files::FOOTPRINT.into()],
        read: |bytes, _| serde_json::from_slice::<Footprint>(bytes).is_ok(),
        share: 5,
    },
    Reader {
        name: "STL",
        sources: &["bed/scene/body.rs"],
        kind: Kind::Text,
        seeds: || vec![file("cases/drum.stl"), shapes::TETRAHEDRON.into()],
        read: |bytes, _| shapes::import(bytes, Format::Stl),
        share: 10,
    },
    Reader {
        name: "binary STL",
        sources: &["bed/scene/body.rs"],
        kind: Kind::Binary,
        seeds: || vec![shapes::binary_tetrahedron()],
        read: |bytes, _| shapes::import(bytes, Format::Stl),
        share: 10,
    },
    Reader {
        name: "OBJ",
        sources: &["bed/scene/body.rs"],
        kind: Kind::Text,
        seeds: || vec![shapes::OBJ.into()],
        read: |bytes, _| shapes::import(bytes, Format::Obj),
        share: 10,
    },
    Reader {
        name: "table of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || grains::TABLES.iter().map(|table| (*table).into()).collect(),
        read: |bytes, _| grains::listed(bytes, listing::Format::Csv),
        share: 5,
    },
    Reader {
        name: "LAMMPS dump of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || vec![grains::DUMP.into()],
        read: |bytes, _| grains::listed(bytes, listing::Format::LammpsDump),
        share: 5,
    },
    Reader {
        name: "LAMMPS data of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || vec![grains::DATA.into()],
        read: |bytes, _| grains::listed(bytes, listing::Format::LammpsData),
        share: 5,
    },
    Reader {
        name: "VTP of grains",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Text,
        seeds: || vec![grains::VTP.into()],
        read: |bytes, _| grains::listed(bytes, listing::Format::Vtp),
        share: 5,
    },
    Reader {
        name: "restart of grains below its sum",
        sources: &["bed/scene/given.rs"],
        kind: Kind::Binary,
        seeds: || vec![grains::kept_grains()[checkpoints::HEAD..].to_vec()],
        read: |bytes, _| grains::listed(&checkpoints::resealed(bytes), listing::Format::Restart),
        share: 5,
    },
    Reader {
        name: "checkpoint",
        sources: &["tape/checkpoint.rs"],
        kind: Kind::Binary,
        seeds: || vec![checkpoints::kept()],
        read: |bytes, folder| checkpoints::taken_up(bytes, folder) && bytes == checkpoints::kept(),
        share: 5,
    },
    Reader {
        name: "checkpoint below its sum",
        sources: &["tape/checkpoint.rs"],
        kind: Kind::Binary,
        seeds: || vec![checkpoints::kept()[checkpoints::HEAD..].to_vec()],
        read: |bytes, folder| checkpoints::taken_up(&checkpoints::resealed(bytes), folder),
        share: 10,
    },
    Reader {
        name: "film",
        sources: &["view/film.rs"],
        kind: Kind::Binary,
        seeds: || {
            vec![
                sealed(VERSION, |tape| checkpoints::frame().save(tape)).as_bytes()
                    [checkpoints::HEAD..]
                    .to_vec(),
            ]
        },
        read: checkpoints::film,
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
        read: words::quantity,
        share: 20,
    },
    Reader {
        name: "command line",
        sources: &[],
        kind: Kind::Text,
        seeds: || words::COMMANDS.iter().map(|line| (*line).into()).collect(),
        read: words::command_line,
        share: 10,
    },
];

/// Files of `src` that read, but nothing that anyone writes for the program or that it keeps.
const OTHERS: [(&str, &str); 9] = [
    ("files/text.rs", "text, which the readers above take"),
    (
        "case/named.rs",
        "constants of materials, which are part of the program",
    ),
    ("atlas/law.rs", "the atlas, which is part of the program"),
    (
        "command/study_merge.rs",
        "a kept run that was just read and is copied as it is",
    ),
    (
        "command/study_table.rs",
        "the first line of results, for the name of the study that they are of",
    ),
    (
        "command/compare.rs",
        "the first line of a comparison, for the law that it is with",
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
        texts.filter(|text| text.contains(word) && !text.starts_with("#:schema study"));
    let found: Vec<Vec<u8>> = of_this_kind.map(String::into_bytes).collect();
    assert!(!found.is_empty(), "{folder}");
    found
}

/// The text of an input, as far as it is one; a file that is not is refused before any of these readers.
fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Bits of numbers that may be NaN, as text.
fn same<T: std::fmt::Debug>(a: &T, b: &T) {
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}

/// Calls by which a file of `src` reads something: ends of paths, and `document.parse()`.
const CALLS: [[&str; 2]; 10] = [
    ["fs", "read"],
    ["fs", "read_to_string"],
    ["files", "read_text"],
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
