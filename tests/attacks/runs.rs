//! Short runs of every verb that keeps what it has done, and what must be the same of two of them.

use crate::four_cases::FOUR_CASES;
use crate::program::{message, program};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Two impacts, a law, and a bed under it.
const CASE: &str = r#"
[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = "100 GPa"
poisson_ratio = 0.35
yield_strength = "1.25 GPa"
[impact]
velocities = ["10 m/s", "40 m/s"]
[accuracy]
tolerance = 0.1
[bed]
scene = "scene.toml"
"#;

const SCENE: &str = r#"
laws = ["thornton", "hertz"]
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
restitution = 0.7
[box]
width = "8 mm"
depth = "8 mm"
[[stage]]
kind = "settle"
stiffness = 0.1
longest = "100 ms"
rest_speed = "5 mm/s"
[[stage]]
kind = "relax"
steps = 300
[[stage]]
kind = "compress"
speed = "0.2 m/s"
seating_stress = "500 Pa"
strain = 0.03
[output]
rows = 20
frames = 2
film = 4
"#;

/// A verb that keeps its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    Impact,
    Run,
    Bed,
    Study,
}

impl Kept {
    /// The command in `folder`, whose input it writes there; results go to `results`.
    pub fn command(self, folder: &Path) -> Command {
        for (name, text) in [
            ("case.toml", CASE),
            ("scene.toml", SCENE),
            ("study.toml", FOUR_CASES),
        ] {
            std::fs::write(folder.join(name), text).unwrap();
        }
        let (verb, file) = match self {
            Kept::Impact => ("impact", "case.toml"),
            Kept::Run => ("run", "case.toml"),
            Kept::Bed => ("bed", "scene.toml"),
            Kept::Study => ("study", "study.toml"),
        };
        let mut command = program(folder);
        command.args([verb, file, "--out", "results", "--checkpoint", "5 ms"]);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command
    }

    /// Runs it to its end in `folder`.
    pub fn finish(self, folder: &Path) -> String {
        let output = self.command(folder).output().unwrap();
        let said = message(&output);
        assert!(
            matches!(output.status.code(), Some(0 | 1)),
            "{self:?}: {said}"
        );
        said
    }
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => walk(&path, found),
            // a log is times and the command line, and nothing reads it
            false if path.extension().is_some_and(|end| end == "log") => {}
            false => found.push(path),
        }
    }
}

/// Files below `folder`.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    walk(folder, &mut found);
    found.sort();
    found
}

/// Text without the seconds that a run took: lines of JSON, the column `wall_s` of tables.
fn without_seconds(path: &Path, bytes: Vec<u8>) -> Vec<u8> {
    let is = |end: &str| path.extension().is_some_and(|found| found == end);
    if is("html") || is("md") {
        return Vec::new();
    }
    if !is("json") && !path.ends_with("times.csv") {
        return bytes;
    }
    let text = String::from_utf8(bytes).unwrap();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let timed = ["\"wall_s\"", "\"particle_steps_per_s\"", "\"sha256\""];
    lines.retain(|line| !timed.iter().any(|key| line.contains(key)));
    if let Some(column) = lines
        .iter()
        .find_map(|line| line.split(',').position(|name| name == "wall_s"))
    {
        for line in &mut lines {
            let cells = line.split(',').enumerate().filter(|(k, _)| *k != column);
            *line = cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",");
        }
    }
    lines.join("\n").into_bytes()
}

/// Every file of the results in `folder`, without the seconds that it took.
pub fn results(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let home = folder.join("results");
    let content = |path: PathBuf| {
        let name = path.strip_prefix(&home).unwrap().to_owned();
        let bytes = without_seconds(&path, std::fs::read(&path).unwrap());
        (name, bytes)
    };
    files(&home).into_iter().map(content).collect()
}

/// That two folders hold the same results.
pub fn assert_same(one: &Path, two: &Path, what: &str) {
    let [one, two] = [results(one), results(two)];
    let names = |all: &BTreeMap<PathBuf, Vec<u8>>| all.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&one), names(&two), "{what}");
    for (name, bytes) in &one {
        assert!(two[name] == *bytes, "{what}: {} differs", name.display());
    }
}
