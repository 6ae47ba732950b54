//! Schemas: what is shipped holds to them, and they refuse what the readers refuse.

use impactlaw::command::schema::FILES;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where the schema of a kind of file is shipped.
fn shipped(kind: &str) -> PathBuf {
    let folder = if kind == "law" { "models" } else { "cases" };
    root().join(folder).join(format!("{kind}.schema.json"))
}

#[test]
fn the_schemas_that_are_shipped_are_those_of_the_readers() {
    for file in FILES {
        let path = shipped(file.name);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(
            text == file.schema(),
            "{} is not `impactlaw schema {}`: write it anew",
            path.display(),
            file.name
        );
    }
}

/// Shipped files with the kind that their first line names.
fn files() -> Vec<(PathBuf, String)> {
    let folders = ["cases", "cases/experiments", "models"];
    let folders = folders.map(|name| std::fs::read_dir(root().join(name)).unwrap());
    let paths = folders
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().path());
    let tables = paths.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    let kind = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap();
        let first = text.lines().next().unwrap().strip_prefix("#:schema ");
        let name = first.unwrap_or_else(|| panic!("{}: no schema on top", path.display()));
        assert!(
            path.with_file_name(name).is_file(),
            "{}: {name}",
            path.display()
        );
        let file = name.rsplit('/').next().unwrap();
        (path, file.split('.').next().unwrap().to_owned())
    };
    tables.map(kind).collect()
}

/// A validator that knows draft 7, and is not ours: whether each text, as JSON, holds to its schema; none where it is missing.
fn validate(texts: &[(&Path, String)]) -> Option<Vec<Option<String>>> {
    const SCRIPT: &str = "import json, sys, jsonschema\nfor schema, value in json.load(sys.stdin):\n    \
        schema = json.load(open(schema)); jsonschema.Draft7Validator.check_schema(schema)\n    \
        error = next(jsonschema.Draft7Validator(schema).iter_errors(value), None)\n    \
        print(json.dumps(None if error is None else '/'.join(map(str, error.absolute_path)) + ': ' + error.message))\n";
    let there = Command::new("python3")
        .args(["-c", "import jsonschema"])
        .output();
    if !there.is_ok_and(|output| output.status.success()) {
        eprintln!("!! SKIPPED: no python3 with jsonschema, the shipped files are NOT validated");
        return None;
    }
    let jobs: Vec<serde_json::Value> = texts
        .iter()
        .map(|(schema, text)| {
            let value: serde_json::Value = toml::from_str(text).unwrap();
            serde_json::json!([schema, value])
        })
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("input.json");
    std::fs::write(&input, serde_json::to_string(&jobs).unwrap()).unwrap();
    let mut python = Command::new("python3");
    let output = python
        .args(["-c", SCRIPT])
        .stdin(std::fs::File::open(&input).unwrap())
        .output();
    let output = output.unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let lines = String::from_utf8(output.stdout).unwrap();
    Some(
        lines
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect(),
    )
}

#[test]
fn shipped_files_hold_to_their_schemas_and_slips_do_not() {
    let files = files();
    let kinds: std::collections::BTreeSet<&str> = files.iter().map(|(_, kind)| &kind[..]).collect();
    // equations are results: none is shipped
    assert_eq!(kinds.len() + 1, FILES.len());
    let schemas = FILES.map(|file| (file.name, shipped(file.name)));
    let schema = |kind: &str| &schemas.iter().find(|(name, _)| *name == kind).unwrap().1;
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let mut texts: Vec<(&Path, String)> = files
        .iter()
        .map(|(path, kind)| (schema(kind).as_path(), read(path)))
        .collect();
    let good = texts.len();
    // a wrong key, a wrong type, a wrong unit, a missing unit, a sign, a bound, a name, a missing key
    let slips = [
        (
            "case",
            "thesis-4-4",
            "radius = ",
            "radus = ",
            "particle/radus",
        ),
        (
            "case",
            "thesis-4-4",
            "poisson_ratio = 0.35",
            "poisson_ratio = \"0.35\"",
            "material/poisson_ratio",
        ),
        (
            "case",
            "thesis-4-4",
            "radius = \"250 um\"",
            "radius = \"250 kg\"",
            "particle/radius",
        ),
        (
            "case",
            "thesis-4-4",
            "radius = \"250 um\"",
            "radius = 250e-6",
            "particle/radius",
        ),
        (
            "case",
            "thesis-4-4",
            "radius = \"250 um\"",
            "radius = \"-250 um\"",
            "particle/radius",
        ),
        (
            "case",
            "thesis-4-4",
            "poisson_ratio = 0.35",
            "poisson_ratio = 0.5",
            "material/poisson_ratio",
        ),
        ("case", "thesis-4-4", "tolerance = ", "# ", "accuracy"),
        (
            "study",
            "study-480",
            "tolerance = ",
            "toleranz = ",
            "accuracy",
        ),
        (
            "scene",
            "bed-drum",
            "kind = \"slope\"",
            "kind = \"slop\"",
            "measure/0/kind",
        ),
        // a wrong key is blamed itself, not the table it stands in, whatever chose the table
        (
            "scene",
            "bed-drum",
            "duration = ",
            "duratoin = ",
            "stage/0/duratoin",
        ),
        (
            "scene",
            "bed-drum",
            "insertion = ",
            "insertoin = ",
            "grains/insertoin",
        ),
        ("scene", "bed-drum", "seed = 1", "seed = 1.5", "seed"),
        ("law", "sac305-solder", "form = \"", "form = \"x", "form"),
    ];
    for (kind, name, from, to, _) in slips {
        let (path, _) = files
            .iter()
            .find(|(path, _)| path.file_stem().unwrap() == name)
            .unwrap();
        let text = read(path);
        let slip = text.replacen(from, to, 1);
        assert_ne!(slip, text, "{name}: no {from}");
        texts.push((schema(kind).as_path(), slip));
    }
    let Some(said) = validate(&texts) else { return };
    assert_eq!(said.len(), texts.len());
    for ((path, _), said) in files.iter().zip(&said) {
        assert_eq!(*said, None, "{}", path.display());
    }
    for ((_, name, _, to, place), said) in slips.iter().zip(&said[good..]) {
        let said = said
            .as_ref()
            .unwrap_or_else(|| panic!("{name}: {to} is taken"));
        assert!(said.starts_with(place), "{to}: {said}");
    }
}
