//! A file of another kind than a verb reads: it is said what it is and which verb reads it, and nothing is written.

use crate::program::{impactlaw, message};
use impactlaw::command::schema::{FILES, FileKind};
use std::path::Path;

/// A shipped file of each kind.
fn shipped(kind: &str) -> String {
    let name = match kind {
        "case" => "cases/thesis-4-4.toml",
        "study" => "cases/study-480.toml",
        "scene" => "cases/bed-drum.toml",
        "law" => "models/sac305-solder.toml",
        "equations" => "tests/data/equations-480.toml",
        other => panic!("no file of kind {other}"),
    };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    path.to_str().unwrap().to_owned()
}

/// Command lines that read a file of a kind; `FILE` stands for it.
const READERS: [(&str, &[&str]); 17] = [
    ("case", &["run", "FILE"]),
    ("case", &["plan", "FILE"]),
    ("case", &["impact", "FILE"]),
    ("case", &["fit", "FILE"]),
    ("case", &["compare", "FILE"]),
    ("case", &["cost", "FILE"]),
    (
        "case",
        &["theory", "hertz", "FILE", "--velocities", "1 m/s"],
    ),
    ("scene", &["bed", "FILE"]),
    ("scene", &["bed", "export", "FILE", "--to", "lammps"]),
    ("law", &["bed", "SCENE", "--law", "FILE"]),
    (
        "law",
        &["bed", "export", "SCENE", "--to", "lammps", "--law", "FILE"],
    ),
    ("study", &["study", "FILE"]),
    ("law", &["export", "FILE", "--to", "c"]),
    ("law", &["export", "LAW", "--with", "FILE", "--to", "c"]),
    (
        "law",
        &[
            "law",
            "eval",
            "FILE",
            "--body",
            "1 mm",
            "--displacements",
            "1 um",
        ],
    ),
    ("law", &["compare", "CASE", "--law", "FILE"]),
    ("equations", &["predict", "CASE", "--equation", "FILE"]),
];

fn arguments(line: &[&str], file: &str) -> Vec<String> {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/solder-bed.toml");
    let word = |word: &&str| match *word {
        "FILE" => file.to_owned(),
        "SCENE" => scene.to_str().unwrap().to_owned(),
        "LAW" => shipped("law"),
        "CASE" => shipped("case"),
        word => word.to_owned(),
    };
    line.iter().map(word).collect()
}

#[test]
fn a_file_of_another_kind_is_called_what_it_is_by_every_verb() {
    let folder = tempfile::tempdir().unwrap();
    for (wanted, line) in READERS {
        // a case is a study of one, and studies and scenes have plans too
        let other = |kind: &&FileKind| {
            kind.name != wanted
                && [wanted, kind.name] != ["study", "case"]
                && !(line[0] == "plan" && ["study", "scene"].contains(&kind.name))
        };
        for given in FILES.iter().filter(other) {
            let file = shipped(given.name);
            let words = arguments(line, &file);
            let words: Vec<&str> = words.iter().map(|word| &word[..]).collect();
            let output = impactlaw(folder.path(), &words);
            let said = message(&output);
            assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
            let next = given.next.replace("FILE", &file);
            for part in [
                format!("found {}; must be {}", article(given.name), article(wanted)),
                format!("`{next}`"),
            ] {
                assert!(said.contains(&part), "{words:?}: no {part:?} in {said}");
            }
            let left = std::fs::read_dir(folder.path()).unwrap().count();
            assert_eq!(left, 0, "{words:?} wrote something");
        }
    }
}

#[test]
fn every_verb_that_reads_a_file_is_asked() {
    for kind in FILES {
        let verb = kind.next.split(' ').nth(1).unwrap();
        let asked = READERS
            .iter()
            .any(|(name, line)| *name == kind.name && line[0] == verb);
        assert!(asked, "{}: {verb}", kind.name);
    }
}

#[test]
fn a_slip_within_a_file_of_the_right_kind_is_still_a_slip() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, from, to, verb) in [
        ("case", "[accuracy]", "[acuracy]", "run"),
        ("scene", "[grains]", "[grain]", "bed"),
        ("study", "[accuracy]", "[acuracy]", "study"),
        ("law", "[valid]", "[vaild]", "export"),
    ] {
        let text = std::fs::read_to_string(shipped(kind)).unwrap();
        let wrong = text.replacen(from, to, 1);
        assert_ne!(wrong, text, "{kind}: no {from}");
        std::fs::write(folder.path().join("x.toml"), wrong).unwrap();
        let words: &[&str] = match verb {
            "export" => &["export", "x.toml", "--to", "c"],
            verb => &[verb, "x.toml"],
        };
        let said = message(&impactlaw(folder.path(), words));
        let key = to.trim_matches(['[', ']']);
        assert!(said.contains(&format!("unknown field `{key}`")), "{said}");
    }
    // neither of one kind nor of another
    std::fs::write(folder.path().join("x.toml"), "[package]\nname = \"x\"\n").unwrap();
    let said = message(&impactlaw(folder.path(), &["run", "x.toml"]));
    assert!(said.contains("unknown field `package`"), "{said}");
}

/// `a case file`, `an equations file`.
fn article(name: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {name} file")
}
