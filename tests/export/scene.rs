//! Whole scenes in LAMMPS and LIGGGHTS: an oedometer exported, run there, and compared with the bed that runs here.

use crate::codes::exported::Installed;
use crate::codes::{self, assert_close, solder, succeed};
use crate::program::{message, program};
use impactlaw::export::scene::Code;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Allowed deviation: of stresses from the largest one (root mean square), of heights and contacts from ours.
const ALLOWED: f64 = 0.03;

fn model() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml")
}

/// The shipped oedometer under the fitted law alone, with rows close enough to follow unloading.
fn scene(folder: &Path) -> PathBuf {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bed-oedometer.toml");
    // the first compression and letting go, of fewer grains: as long as an exported run may take here
    let whole = std::fs::read_to_string(case).unwrap();
    let [head, first, _] = [0, 1, 2].map(|part| {
        whole
            .split("[[stage]]\nkind = \"compress\"")
            .nth(part)
            .unwrap()
    });
    let (_, output) = whole.split_once("[output]").unwrap();
    let shown = format!("{head}[[stage]]\nkind = \"compress\"{first}[output]{output}");
    let mut text = String::new();
    for line in shown.lines() {
        text.push_str(match line {
            _ if line.starts_with("laws =") => "laws = [\"fitted\"]",
            _ if line.starts_with("rows =") => "rows = 600",
            // strain from the first touch on, the same in both: where a stress begins to last depends on the rounding
            _ if line.starts_with("seating_stress =") => "seating_stress = \"5 kPa\"",
            _ if line.starts_with("approach =") => "",
            _ if line.starts_with("speed =") => "speed = \"0.5 m/s\"",
            _ if line.starts_with("count =") => "count = 800",
            _ if line.starts_with("width =") => "width = \"5 mm\"",
            _ if line.starts_with("depth =") => "depth = \"5 mm\"",
            // far past the seating: a packing that has just jammed answers a rounding error with another stress
            _ if line.starts_with("strain =") => "strain = 0.1",
            _ => line,
        });
        text.push('\n');
    }
    let text = text.replace(
        "../models/sac305-solder.toml",
        &model().display().to_string(),
    );
    let file = folder.join("oedometer.toml");
    std::fs::write(&file, text).unwrap();
    file
}

/// What is compared of one run.
#[derive(Debug)]
struct Curve {
    /// Height and stress from the seating stress on, in order of time.
    points: Vec<[f64; 2]>,
    /// Height at the seating stress.
    seated: f64,
    /// Contacts between grains per grain at the largest strain.
    coordination: f64,
}

impl Curve {
    /// Index of the lowest height.
    fn turn(&self) -> usize {
        let heights = self.points.iter().enumerate();
        heights.min_by(|a, b| a.1[0].total_cmp(&b.1[0])).unwrap().0
    }

    /// Stress at a travel of the piston from the turning point, on the way down or up.
    fn stress(&self, travel: f64, down: bool) -> Option<f64> {
        let turn = self.turn();
        let lowest = self.points[turn][0];
        let branch = if down {
            &self.points[..=turn]
        } else {
            &self.points[turn..]
        };
        let height = lowest + travel;
        branch.windows(2).find_map(|pair| {
            let [a, b] = [pair[0], pair[1]];
            let within = (a[0].min(b[0])..=a[0].max(b[0])).contains(&height) && a[0] != b[0];
            within.then(|| a[1] + (b[1] - a[1]) * (height - a[0]) / (b[0] - a[0]))
        })
    }

    fn largest(&self) -> f64 {
        self.points
            .iter()
            .fold(0.0, |most, point| most.max(point[1]))
    }
}

/// Columns of a CSV file by name, comments left out, with the first column as text.
fn columns(file: &Path, names: &[&str]) -> Vec<Vec<f64>> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(file)
        .unwrap();
    let header = reader.headers().unwrap().clone();
    let at: Vec<usize> = names
        .iter()
        .map(|name| header.iter().position(|column| column == *name).unwrap())
        .collect();
    let rows = reader.records().map(|row| row.unwrap());
    rows.map(|row| at.iter().map(|&k| row[k].parse().unwrap()).collect())
        .collect()
}

fn curve(rows: &[Vec<f64>], coordination: impl Fn(usize) -> f64) -> Curve {
    // strain is known once the stress has lasted; the curve begins where it began to last
    let known = rows.iter().position(|row| row[1] > 0.0).unwrap();
    let seated = rows[known][0] / (1.0 - rows[known][1]);
    let first = rows.iter().position(|row| row[0] <= seated).unwrap();
    let points: Vec<[f64; 2]> = rows[first..].iter().map(|row| [row[0], row[2]]).collect();
    let mut curve = Curve {
        points,
        seated,
        coordination: 0.0,
    };
    curve.coordination = coordination(first + curve.turn());
    curve
}

/// The scene run here, once for both codes.
fn ours() -> &'static Curve {
    static OURS: OnceLock<Curve> = OnceLock::new();
    OURS.get_or_init(|| {
        let scratch = tempfile::tempdir().unwrap();
        let (folder, scene) = (scratch.path(), scene(scratch.path()));
        succeed(program(folder).arg("bed").arg(scene).arg("-o").arg(folder));
        let names = ["height_m", "strain", "stress_Pa", "coordination"];
        let rows = columns(&folder.join("bed/fitted/bed.csv"), &names);
        curve(&rows, |row| rows[row][3])
    })
}

/// Exports the scene for a code; the folder it is in.
fn exported(scene: &Path, folder: &Path, code: &str) -> PathBuf {
    succeed(
        program(folder)
            .args(["bed", "export"])
            .arg(scene)
            .args(["--to", code, "-o"])
            .arg(folder),
    );
    folder.join(code)
}

fn assert_same(theirs: &Curve, ours: &Curve, code: &str) {
    assert_close(
        theirs.seated,
        ours.seated,
        ALLOWED,
        &format!("{code}: height at the seating stress"),
    );
    assert_close(
        theirs.coordination,
        ours.coordination,
        ALLOWED,
        &format!("{code}: contacts per grain"),
    );
    assert_close(
        theirs.largest(),
        ours.largest(),
        ALLOWED,
        &format!("{code}: largest stress"),
    );
    // the piston leaves the bed when it has gone back some 3 % of its way
    let depth = theirs.seated - theirs.points[theirs.turn()][0];
    for (down, from, to) in [(true, 0.005, 0.98), (false, 0.005, 0.03)] {
        let travels = (0..200).map(|k| depth * (from + (to - from) * f64::from(k) / 199.0));
        let pairs: Vec<[f64; 2]> = travels
            .filter_map(|travel| Some([theirs.stress(travel, down)?, ours.stress(travel, down)?]))
            .collect();
        assert!(
            pairs.len() > 150,
            "{code}: {} points to compare",
            pairs.len()
        );
        let sum: f64 = pairs.iter().map(|[a, b]| (a - b).powi(2)).sum();
        let deviation = (sum / pairs.len() as f64).sqrt() / ours.largest();
        println!(
            "{code}, {}: {deviation:.4}",
            if down { "compression" } else { "unloading" }
        );
        assert!(
            deviation < ALLOWED,
            "{code}: stress deviates by {deviation} of the largest"
        );
    }
    println!(
        "{code}: height {:.6e} {:.6e}, contacts per grain {:.3} {:.3}, largest stress {:.4e} {:.4e}",
        theirs.seated,
        ours.seated,
        theirs.coordination,
        ours.coordination,
        theirs.largest(),
        ours.largest()
    );
}

/// Folder of the scene's run in another code; none where that is not installed.
fn run(code: Code, name: &str, scratch: &Path) -> Option<PathBuf> {
    let installed = Installed::find(code)?;
    let scene = scene(scratch);
    let folder = exported(&scene, scratch, name);
    installed.build(&folder);
    let mut command = installed.command(&solder(None), &folder, 1);
    succeed(command.args(["-in", "scene.in", "-var", "rows", "20"]));
    Some(folder)
}

#[test]
fn an_oedometer_exported_to_lammps_is_the_one_that_runs_here() {
    let scratch = tempfile::tempdir().unwrap();
    let Some(folder) = run(Code::Lammps, "lammps", scratch.path()) else {
        return;
    };
    let names = ["height_m", "strain", "stress_Pa", "coordination"];
    let rows = columns(&folder.join("scene.csv"), &names);
    let theirs = curve(&rows, |row| rows[row][3]);
    assert_same(&theirs, ours(), "LAMMPS");
}

#[test]
fn an_oedometer_exported_to_liggghts_is_the_one_that_runs_here() {
    let scratch = tempfile::tempdir().unwrap();
    let Some(folder) = run(Code::Liggghts, "liggghts", scratch.path()) else {
        return;
    };
    let rows = columns(
        &folder.join("scene.csv"),
        &["height_m", "strain", "stress_Pa"],
    );
    let pairs = std::fs::read_to_string(folder.join("pairs_2_compress.txt")).unwrap();
    let pairs = codes::rows(&pairs, 5);
    let carrying = pairs
        .iter()
        .filter(|pair| pair[2..].iter().any(|force| *force != 0.0));
    let coordination = 2.0 * carrying.count() as f64 / 800.0;
    let theirs = curve(&rows, |_| coordination);
    assert_same(&theirs, ours(), "LIGGGHTS");
}

#[test]
fn what_is_not_exported_is_refused_by_name_and_nothing_is_written() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    for (scene, key) in [("bed-drum.toml", "box"), ("bed-impact.toml", "body[0]")] {
        let scratch = tempfile::tempdir().unwrap();
        let out = scratch.path().join("out");
        let mut command = program(scratch.path());
        command
            .args(["bed", "export"])
            .arg(cases.join(scene))
            .args(["--to", "lammps", "-o"])
            .arg(&out);
        let output = command.output().unwrap();
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(&format!("`{key}`")), "{scene}: {said}");
        assert!(!out.exists());
    }
}

#[test]
fn sides_pairs_domains_bodies_outlets_and_measures_are_refused_by_name_instead_of_left_out() {
    let text = std::fs::read_to_string(scene(tempfile::tempdir().unwrap().path())).unwrap();
    let pair = "\n[[pair]]\nbetween = [\"grains\", \"grains\"]\nfriction = 0.1\n";
    let corner = |edge| format!("[\"{edge} m\", \"{edge} m\", \"{edge} m\"]");
    let domain = format!("\n[domain]\nlow = {}\nhigh = {}\n", corner(-1), corner(1));
    let body = "\n[[body]]\nname = \"b\"\nball = { radius = \"1 mm\" }\nat = [\"1 m\", \"1 m\", \"1 m\"]\n";
    let outlet =
        "\n[[outlet]]\nplane = { at = [\"0 m\", \"0 m\", \"-1 m\"], normal = [0.0, 0.0, -1.0] }\n";
    let measure = "\n[[measure]]\nkind = \"flow\"\nheight = \"1 mm\"\n";
    for (key, text) in [
        ("body[0]", format!("{text}{body}")),
        ("body[0]", format!("{text}{body}belt = {{}}\n")),
        ("body[0]", format!("{text}{body}driven = {{}}\n")),
        ("outlet[0]", format!("{text}{outlet}")),
        ("measure[0]", format!("{text}{measure}")),
        ("periodic", format!("periodic = [\"x\"]\n{text}")),
        ("pair[0]", format!("{text}{pair}")),
        ("domain", format!("{text}{domain}")),
    ] {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("scene.toml");
        std::fs::write(&file, text).unwrap();
        let out = scratch.path().join("out");
        for code in Code::ALL {
            let mut command = program(scratch.path());
            command
                .args(["bed", "export"])
                .arg(&file)
                .arg("-o")
                .arg(&out);
            let output = command.args(["--to", code.name()]).output().unwrap();
            let said = message(&output);
            assert_eq!(output.status.code(), Some(2), "{said}");
            assert!(said.contains(&format!("`{key}`")), "{key}: {said}");
            assert!(!out.exists());
        }
    }
}

#[test]
fn grains_of_two_materials_are_refused_for_that_whatever_pairs_the_scene_names() {
    let text = std::fs::read_to_string(scene(tempfile::tempdir().unwrap().path())).unwrap();
    let law = "law = \"hertz\"\ndensity = \"2500 kg/m3\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.2\n";
    let pair = "\n[[pair]]\nbetween = [\"own\", \"glass\"]\nfriction = 0.1\n";
    let start = text.find("[material]").unwrap();
    let (head, rest) = text.split_at(start);
    let (own, rest) = rest.split_at(rest.find("[grains]").unwrap());
    let own = own.replace("[material]", "[materials.own]");
    let (grains, rest) = rest.split_at(1 + rest[1..].find("\n[").unwrap());
    let group = |name: &str, material: &str| {
        grains.replace(
            "[grains]",
            &format!("[[grains]]\nname = \"{name}\"\nmaterial = \"{material}\""),
        )
    };
    let (one, two) = (group("one", "own"), group("two", "glass"));
    let text = format!("{head}{own}\n[materials.glass]\n{law}\n{one}\n{two}\n{pair}\n{rest}");
    let text = text
        .replace("laws = [\"fitted\", \"hertz\"]\n", "")
        .replace("laws = [\"fitted\"]\n", "");
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("scene.toml");
    std::fs::write(&file, text).unwrap();
    let mut command = program(scratch.path());
    let output = command
        .args(["bed", "export"])
        .arg(&file)
        .args(["--to", "lammps"])
        .output()
        .unwrap();
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("`grains[1].material`") && said.contains("one law"),
        "{said}"
    );
}

#[test]
fn a_code_that_is_not_known_is_refused_with_those_that_are() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/bed-oedometer.toml");
    let scratch = tempfile::tempdir().unwrap();
    let output = program(scratch.path())
        .args(["bed", "export"])
        .arg(case)
        .args(["--to", "edem"])
        .output()
        .unwrap();
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("must be one of lammps, liggghts"), "{said}");
}
