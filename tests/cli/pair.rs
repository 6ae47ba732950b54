//! Impacts on a deformable wall through the real binary: files, the same bytes on any number of threads, and what is refused.

use crate::program::{impactlaw, message, program};
use crate::reference::{assert_described, columns, keys};
use std::collections::BTreeSet;
use std::path::Path;

const CASE: &str = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"200 GPa\"\npoisson_ratio = 0.3\n\
    yield_strength = \"1 GPa\"\n[wall]\nthickness = \"3 mm\"\n[wall.material]\ndensity = \"2700 kg/m3\"\nyoung_modulus = \"70 GPa\"\n\
    poisson_ratio = 0.33\nyield_strength = \"300 MPa\"\n[impact]\nvelocities = [\"20 m/s\", \"30 m/s\"]\n[accuracy]\ntolerance = 0.2\n";

fn files(folder: &Path) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for name in [
        "curve.csv",
        "particle_compressed.csv",
        "particle_rebound.csv",
        "target_compressed.csv",
        "target_rebound.csv",
    ] {
        for speed in ["20", "30"] {
            let path = folder.join(format!("o/impact_V{speed}/{name}"));
            let text = std::fs::read_to_string(&path).unwrap();
            // the first line holds the command
            let body = text.split_once('\n').unwrap().1.to_owned();
            all.push((format!("{speed} {name}"), body));
        }
    }
    all
}

#[test]
fn a_ball_on_a_plate_leaves_files_as_described_the_same_on_any_number_of_threads() {
    let folders = [1, 2].map(|threads| {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("c.toml"), CASE).unwrap();
        let mut command = program(folder.path());
        command.args(["impact", "c.toml", "--out", "o"]);
        let output = command
            .env("RAYON_NUM_THREADS", threads.to_string())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", message(&output));
        folder
    });
    let [one, two] = folders.each_ref().map(|folder| files(folder.path()));
    assert_eq!(one, two);
    assert_described(&folders[0].path().join("o"));
    let path = folders[0].path().join("o/impact_V30/summary.json");
    let summary: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let target = &summary["target"];
    assert_eq!(target["shape"], "plate");
    assert!(target["residual_indentation_m"].as_f64().unwrap() > 1e-6);
    let all = keys(&target.to_string());
    let absent = ["radius_m", "heating"].map(str::to_owned);
    let written: BTreeSet<String> = all.into_iter().chain(absent).collect();
    assert_eq!(columns()["target of summary.json"], written);

    // nothing takes it for an impact on a rigid wall
    let rigid = CASE.replace("[wall]\nthickness = \"3 mm\"\n", "");
    let rigid: String = {
        let (head, rest) = rigid.split_once("[wall.material]").unwrap();
        head.to_owned() + &rest[rest.find("[impact]").unwrap()..]
    };
    let here = folders[0].path();
    std::fs::write(here.join("rigid.toml"), rigid).unwrap();
    let output = impactlaw(
        here,
        &["fit", "rigid.toml", "--impacts", "o", "--out", "law.toml"],
    );
    assert_eq!(output.status.code(), Some(2), "{}", message(&output));
    assert!(
        message(&output).contains("deformable plate"),
        "{}",
        message(&output)
    );
    assert!(!here.join("law.toml").exists());
}

/// The program's answer to a case; that it wrote nothing.
fn refused(verb: &[&str], text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), text).unwrap();
    let output = impactlaw(folder.path(), verb);
    assert_eq!(output.status.code(), Some(2), "{verb:?} {text}");
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 1, "{verb:?} has written something");
    message(&output)
}

#[test]
fn what_two_bodies_are_not_run_with_is_refused_by_name() {
    let wall = "[wall]\nthickness = \"3 mm\"\n";
    let sphere = |radius: &str| CASE.replace(wall, &format!("[wall]\nradius = \"{radius}\"\n"));
    let with = |from: &str, to: &str| {
        assert!(CASE.contains(from));
        CASE.replace(from, to)
    };
    let cases = [
        (with(wall, "[wall]\nfriction = 0.3\n"), "wall.friction"),
        (
            with(wall, "[wall]\nthickness = \"3 mm\"\nradius = \"1 mm\"\n"),
            "wall.radius",
        ),
        (
            with("thickness = \"3 mm\"", "thickness = \"0 mm\""),
            "wall.thickness",
        ),
        (
            with("thickness = \"3 mm\"", "thickness = \"1 um\""),
            "wall.thickness",
        ),
        (
            with("[impact]\n", "[impact]\nangle = \"10 deg\"\n"),
            "impact.angle",
        ),
        (
            with(
                "radius = \"1 mm\"\n",
                "radius = \"1 mm\"\nshape = \"cylinder\"\nlength = \"2 mm\"\n",
            ),
            "particle.shape",
        ),
        (with("\"20 m/s\", ", "\"200 m/s\", "), "impact.velocities"),
        (with("\"20 m/s\", ", "\"1 um/s\", "), "impact.velocities"),
        (
            with("tolerance = 0.2", "tolerance = 1e-4"),
            "accuracy.tolerance",
        ),
        (with("2700 kg/m3", "2.7 kg/m3"), "wall.material.density"),
        (
            with("poisson_ratio = 0.33", "poisson_ratio = 0.5"),
            "wall.material.poisson_ratio",
        ),
        (with("young_modulus = \"70 GPa\"\n", ""), "young_modulus"),
        (
            with("poisson_ratio = 0.33", "poisson_ratio = 0.495"),
            "wall.material.poisson_ratio",
        ),
        (sphere("1 m"), "wall.radius"),
        (sphere("10 um"), "wall.radius"),
        (sphere("-1 mm"), "wall.radius"),
    ];
    for (text, key) in cases {
        for verb in ["impact", "plan"] {
            let message = refused(&[verb, "c.toml"], &text);
            assert!(
                message.contains(&format!("`{key}`")) || message.contains(key),
                "{key}: {message}"
            );
        }
    }
    let (head, rest) = CASE.split_once(wall).unwrap();
    let rigid = head.to_owned() + &rest[rest.find("[impact]").unwrap()..];
    for (table, key) in [
        ("[wall]\nthickness = \"3 mm\"\n", "wall.thickness"),
        ("[wall]\nradius = \"3 mm\"\n", "wall.radius"),
        ("[wall]\n", "`wall`"),
    ] {
        let message = refused(&["impact", "c.toml"], &format!("{rigid}{table}"));
        assert!(message.contains(key), "{key}: {message}");
    }
}

#[test]
fn verbs_that_know_rigid_walls_alone_refuse_a_deformable_one() {
    for verb in [&["cost", "c.toml"][..], &["theory", "hertz", "c.toml"]] {
        let message = refused(verb, CASE);
        assert!(message.contains("wall.material"), "{verb:?}: {message}");
        assert!(message.contains("impactlaw plan"), "{verb:?}: {message}");
    }
    let study = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = [\"100 GPa\", \"200 GPa\"]\npoisson_ratio = 0.3\n\
        [wall]\nthickness = \"3 mm\"\n[impact]\nvelocities = [\"1 m/s\"]\n[accuracy]\ntolerance = 0.1\n";
    let message = refused(&["study", "c.toml"], study);
    assert!(message.contains("thickness"), "{message}");
}

#[test]
fn run_makes_the_law_of_a_pair_that_only_its_own_case_takes() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let write = |name: &str, text: &str| std::fs::write(here.join(name), text).unwrap();
    write("c.toml", CASE);
    let output = impactlaw(here, &["run", "c.toml", "--out", "o"]);
    // a tolerance of 0.2 is that of a test; whether the law meets it is not what is asked here
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{}",
        message(&output)
    );
    assert_described(&here.join("o"));
    let law = std::fs::read_to_string(here.join("o/law.toml")).unwrap();
    for said in [
        "[pair]",
        "target = \"plate\"",
        "target_thickness_m = 0.003",
        "# R is the effective radius",
        "radius_m = 0.001",
    ] {
        assert!(law.contains(said), "{said}: {law}");
    }
    let report = std::fs::read_to_string(here.join("o/report.html")).unwrap();
    for said in [
        "deformable plate",
        "plate of 3 mm, held at its back",
        "Density ρ, second body",
        "series",
    ] {
        assert!(report.contains(said), "{said}");
    }
    let rows = |path: &str| {
        let text = std::fs::read_to_string(here.join(path)).unwrap();
        let mut laws: Vec<String> = text
            .lines()
            .skip(2)
            .map(|row| row.split(',').next().unwrap().to_owned())
            .collect();
        laws.dedup();
        laws
    };
    let all = rows("o/compare.csv");
    for name in [
        "mpm",
        "fitted",
        "series",
        "effective",
        "hertz",
        "johnson",
        "thornton",
        "thornton-hardness",
    ] {
        assert!(all.iter().any(|law| law == name), "{name}: {all:?}");
    }
    assert!(!all.iter().any(|law| law == "jackson-green"), "{all:?}");

    // the parts give the same bytes as the whole
    let output = impactlaw(
        here,
        &["fit", "c.toml", "--impacts", "o", "--out", "again.toml"],
    );
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{}",
        message(&output)
    );
    assert_eq!(
        std::fs::read_to_string(here.join("again.toml")).unwrap(),
        law
    );
    let output = impactlaw(here, &["compare", "c.toml", "--impacts", "o", "--out", "p"]);
    assert!(output.status.success(), "{}", message(&output));
    let body = |path: &str| {
        let text = std::fs::read_to_string(here.join(path)).unwrap();
        text.split_once('\n').unwrap().1.to_owned()
    };
    assert_eq!(body("p/compare.csv"), body("o/compare.csv"));

    // a name for each body's own law; the wrong body's is refused
    let own = [
        ("8000kg/m3", "200GPa", "0.3", "1GPa", "steel.toml"),
        ("2700kg/m3", "70GPa", "0.33", "300MPa", "alu.toml"),
    ];
    for (density, young, poisson, strength, file) in own {
        let output = impactlaw(
            here,
            &[
                "law",
                "--density",
                density,
                "--young",
                young,
                "--poisson",
                poisson,
                "--yield",
                strength,
                "--radius",
                "1mm",
                "--out",
                file,
            ],
        );
        assert!(output.status.success(), "{}", message(&output));
    }
    let series = |files: [&str; 2]| {
        impactlaw(
            here,
            &[
                "compare",
                "c.toml",
                "--impacts",
                "o",
                "--out",
                "q",
                "--series",
                files[0],
                files[1],
            ],
        )
    };
    let output = series(["steel.toml", "alu.toml"]);
    assert!(output.status.success(), "{}", message(&output));
    assert_eq!(body("q/compare.csv"), body("o/compare.csv"));
    let output = series(["alu.toml", "steel.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", message(&output));
    assert!(message(&output).contains("density"), "{}", message(&output));

    // nothing else takes the law, nor the impacts, and this case none of others
    write(
        "thick.toml",
        &CASE.replace("thickness = \"3 mm\"", "thickness = \"4 mm\""),
    );
    let scene = "seed = 1\ngravity = \"9.81 m/s2\"\n[material]\nlaw = \"o/law.toml\"\n[grains]\nradius = \"1 mm\"\ncount = 2\n[box]\nwidth = \"10 mm\"\ndepth = \"10 mm\"\n\
        [[stage]]\nkind = \"relax\"\nsteps = 10\n";
    write("s.toml", scene);
    for (line, said) in [
        (
            &["fit", "thick.toml", "--impacts", "o", "--out", "x.toml"][..],
            "a plate of 3 mm instead of a plate of 4 mm",
        ),
        (
            &[
                "compare",
                "thick.toml",
                "--law",
                "o/law.toml",
                "--impacts",
                "o",
            ],
            "a plate of 3 mm instead of",
        ),
        (
            &["compare", "c.toml", "--law", "steel.toml", "--impacts", "o"],
            "must be the law of a pair",
        ),
        (
            &["compare", "c.toml", "--law", "atlas", "--impacts", "o"],
            "law file of the pair",
        ),
        (
            &[
                "law",
                "eval",
                "o/law.toml",
                "--body",
                "1 mm",
                "--displacements",
                "1 um",
            ],
            "the law of a pair",
        ),
        (&["export", "o/law.toml", "--to", "liggghts"], "goes to c"),
        (
            &["export", "o/law.toml", "--to", "c", "--with", "steel.toml"],
            "the law of both bodies already",
        ),
        (&["bed", "s.toml"], "the law of a pair"),
        (
            &["fit", "c.toml", "--impacts", "o", "--out", "c.toml"],
            "no law of this version",
        ),
    ] {
        let output = impactlaw(here, line);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{line:?}: {}",
            message(&output)
        );
        assert!(
            message(&output).contains(said),
            "{line:?}: {}",
            message(&output)
        );
    }
    assert!(!here.join("x.toml").exists());
    // a case of the same name on another wall says what it replaces
    let (density, young, poisson, strength, _) = own[0];
    let line = [
        "law",
        "--name",
        "c",
        "--density",
        density,
        "--young",
        young,
        "--poisson",
        poisson,
        "--yield",
        strength,
        "--radius",
        "1mm",
        "--out",
        "o/law.toml",
    ];
    let output = impactlaw(here, &line);
    assert!(output.status.success(), "{}", message(&output));
    assert!(
        message(&output).contains("instead of a rigid wall"),
        "{}",
        message(&output)
    );
}
