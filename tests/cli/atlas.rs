//! The atlas from outside: laws of materials without a simulation, by command line, by study and by name in scenes.

use crate::program::{impactlaw, message};
use crate::slips::SCENE;
use impactlaw::law::LawFile;
use std::path::Path;
use std::process::Output;

const COPPER: [&str; 11] = [
    "law",
    "--young",
    "128GPa",
    "--yield",
    "162MPa",
    "--poisson",
    "0.343",
    "--density",
    "8960kg/m3",
    "--radius",
    "250um",
];

fn run(folder: &Path, arguments: &[&str]) -> Output {
    impactlaw(folder, arguments)
}

/// The arguments of copper with one value in place of another, into `law.toml`.
fn copper_but(from: &str, to: &str) -> Vec<String> {
    let swapped = COPPER.map(|word| if word == from { to } else { word });
    let all = swapped.iter().chain(&["-o", "law.toml"]);
    all.map(|word| (*word).to_owned()).collect()
}

#[test]
fn a_law_of_the_command_line_says_its_error_and_goes_into_an_export_and_an_evaluation() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let words = copper_but("", "");
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let made = run(folder, &words);
    assert_eq!(made.status.code(), Some(0), "{}", message(&made));
    let said = String::from_utf8(made.stdout).unwrap();
    assert!(
        said.contains("with the material left out the median error is"),
        "{said}"
    );
    let law = LawFile::read(&folder.join("law.toml")).unwrap();
    assert_eq!(law.material.young_modulus_pa, 128e9);
    assert_eq!(law.provenance.radius_m, 250e-6);
    assert!(law.warnings[0].contains("from the atlas"));
    let evaluated = run(
        folder,
        &[
            "law",
            "eval",
            "law.toml",
            "--body",
            "250 um",
            "--displacements",
            "1 um",
        ],
    );
    assert_eq!(evaluated.status.code(), Some(0), "{}", message(&evaluated));
    let exported = run(
        folder,
        &["export", "law.toml", "--to", "all", "--out", "deck"],
    );
    assert_eq!(exported.status.code(), Some(0), "{}", message(&exported));
    assert!(std::fs::read_dir(folder.join("deck")).unwrap().count() > 5);
    // the same words make the same bytes
    let first = std::fs::read(folder.join("law.toml")).unwrap();
    run(folder, &words);
    assert_eq!(first, std::fs::read(folder.join("law.toml")).unwrap());
}

#[test]
fn what_the_atlas_does_not_hold_is_refused_by_name_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (from, to, parts) in [
        (
            "162MPa",
            "10MPa",
            &["E/Y", "must lie in", "range of the atlas"][..],
        ),
        ("162MPa", "50GPa", &["E/Y", "must lie in"]),
        ("0.343", "0.495", &["Poisson's ratio", "must lie in"]),
        ("0.343", "0.6", &["poisson_ratio"]),
        ("0.343", "x", &["--poisson", "must be a number"]),
        ("128GPa", "128", &["--young"]),
        ("162MPa", "-162MPa", &["yield_strength"]),
        ("8960kg/m3", "0kg/m3", &["density"]),
        ("250um", "0um", &["radius"]),
        ("250um", "250s", &["--radius"]),
    ] {
        // a sign would pass for an option
        let words = copper_but(from, to)
            .join(" ")
            .replace("--yield -", "--yield=-");
        let words: Vec<&str> = words.split(' ').collect();
        let refused = run(folder, &words);
        let said = message(&refused);
        assert_eq!(refused.status.code(), Some(2), "{from} {to}: {said}");
        for part in parts {
            assert!(said.contains(part), "{to}: {said}");
        }
        assert!(!folder.join("law.toml").exists(), "{to}");
    }
}

#[test]
fn an_atlas_of_oblique_impacts_is_refused_before_the_first_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("cases/atlas.toml").unwrap();
    let text = text.replace("[impact]\n", "[impact]\nangle = \"30 deg\"\n");
    std::fs::write(folder.path().join("oblique.toml"), text).unwrap();
    for words in [
        &["atlas", "oblique.toml"][..],
        &["atlas", "oblique.toml", "--compare"],
    ] {
        let refused = run(folder.path(), words);
        assert_eq!(refused.status.code(), Some(2), "{words:?}");
        assert!(
            message(&refused).contains("impact.angle"),
            "{}",
            message(&refused)
        );
        assert!(!folder.path().join("out").exists(), "{words:?}");
    }
}

#[test]
fn the_laws_of_the_shipped_materials_are_what_one_command_makes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    let study = root.join("cases/materials.toml");
    let words = ["law", "--study", study.to_str().unwrap(), "--out", "laws"];
    let made = run(folder.path(), &words);
    assert_eq!(made.status.code(), Some(0), "{}", message(&made));
    let mut count = 0;
    for entry in std::fs::read_dir(root.join("models/materials")).unwrap() {
        let shipped = entry.unwrap().path();
        let own = folder
            .path()
            .join("laws")
            .join(shipped.file_name().unwrap());
        let [shipped_text, own] =
            [&shipped, &own].map(|path| std::fs::read_to_string(path).unwrap());
        assert_eq!(shipped_text, own, "{}", shipped.display());
        LawFile::read(&shipped).unwrap();
        count += 1;
    }
    let made = std::fs::read_dir(folder.path().join("laws"))
        .unwrap()
        .count();
    assert!(count >= 14 && count == made, "{count} shipped, {made} made");
}

/// `bed.csv`, without its first line, of falling grains with a list of laws or a law of their material, or what is said where it is
/// refused.
fn bed(laws: &str, own: &str, strength: &str) -> Result<String, String> {
    let folder = tempfile::tempdir().unwrap();
    let material = format!("poisson_ratio = 0.3\nyield_strength = \"{strength}\"\n{own}");
    let scene = SCENE
        .replace("laws = [\"hertz\"]", laws)
        .replace("poisson_ratio = 0.3", &material)
        .replace("4 ms", "20 ms");
    std::fs::write(folder.path().join("s.toml"), scene).unwrap();
    let output = run(folder.path(), &["bed", "s.toml", "--out", "o"]);
    if output.status.code() == Some(2) {
        assert!(!folder.path().join("o").exists());
        return Err(message(&output));
    }
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
    let beds = std::fs::read_dir(folder.path().join("o/bed")).unwrap();
    let tables: Vec<String> = beds
        .filter_map(|entry| std::fs::read_to_string(entry.unwrap().path().join("bed.csv")).ok())
        .map(|text| text.split_once('\n').unwrap().1.to_owned())
        .collect();
    assert_eq!(tables.len(), 1);
    Ok(tables[0].clone())
}

#[test]
fn a_scene_names_the_atlas_for_its_material_or_among_its_laws() {
    let listed = bed(r#"laws = ["atlas"]"#, "", "100 kPa").unwrap();
    let own = bed("", r#"law = "atlas""#, "100 kPa").unwrap();
    assert!(listed.lines().count() > 5);
    assert_eq!(listed, own);
    let theory = bed(r#"laws = ["thornton"]"#, "", "100 kPa").unwrap();
    assert_ne!(listed, theory);
    for (laws, own, key) in [
        (r#"laws = ["atlas"]"#, "", "laws[0]"),
        ("", r#"law = "atlas""#, "material.law"),
    ] {
        let said = bed(laws, own, "5 kPa").unwrap_err();
        let named =
            said.contains(key) && said.contains("E/Y") && said.contains("range of the atlas");
        assert!(named, "{said}");
    }
}
