//! Slips of a stranger outside of case files: units in scenes and arguments, folders and laws that belong to something else.

use crate::program::{impactlaw, message};
use std::path::Path;

/// Grains that fall into a box.
pub const SCENE: &str = r#"
laws = ["hertz"]
seed = 7
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
[grains]
count = 8
radius = "1 mm"
[box]
width = "8 mm"
depth = "8 mm"
[[stage]]
kind = "run"
name = "fall"
duration = "4 ms"
[output]
rows = 7
frames = 3
film = 0
"#;

/// What a call says on stderr; its exit code is `code`.
fn said(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = impactlaw(folder, arguments);
    let text = message(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
    text
}

#[test]
fn slips_of_units_in_a_scene_are_refused_and_what_is_meant_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let write = |text: &str| std::fs::write(here.join("scene.toml"), text).unwrap();
    for (from, to, key) in [
        ("2500 kg/m3", "2500 g/cm3", "material.density"),
        ("2500 kg/m3", "2.5 kg/m3", "material.density"),
        ("50 MPa", "50000 GPa", "material.young_modulus"),
        ("50 MPa", "50 Pa", "material.young_modulus"),
        ("9.81 m/s2", "9.81 km/s2", "gravity"),
        ("\"1 mm\"", "\"1 nm\"", "grains.radius"),
    ] {
        write(&SCENE.replace(from, to));
        let text = said(here, &["bed", "scene.toml"], 2);
        let unit = format!("check the unit of {key}");
        assert!(text.contains(&unit), "{to}: {text}");
        assert!(!here.join("out").exists());
    }
    write(&SCENE.replace("4 ms", "4e9 s"));
    let text = said(here, &["bed", "scene.toml"], 2);
    assert!(
        text.contains("stage[0].duration") && text.contains("days"),
        "{text}"
    );

    let light = SCENE.replace("2500 kg/m3", "20 kg/m3");
    write(&format!("unusual = [\"material.density\"]\n{light}"));
    said(here, &["bed", "scene.toml"], 0);
    write(&format!("unusual = [\"grains.count\"]\n{SCENE}"));
    let text = said(here, &["bed", "scene.toml"], 2);
    assert!(text.contains("must be one of"), "{text}");
}

#[test]
fn the_last_frame_of_a_stage_is_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("scene.toml"), SCENE).unwrap();
    said(here, &["bed", "scene.toml"], 0);
    let read = |name: &str| std::fs::read_to_string(here.join("out/scene/bed/hertz").join(name));
    let rows = read("bed.csv").unwrap();
    let last: Vec<&str> = rows.lines().last().unwrap().split(',').collect();
    let frames = read("vtp/grains.pvd").unwrap();
    let times = frames.split("timestep=\"").skip(1);
    let times: Vec<f64> = times
        .map(|part| part.split('"').next().unwrap().parse().unwrap())
        .collect();
    let end: f64 = last[1].parse().unwrap();
    assert_eq!(times.last(), Some(&end), "{frames}");
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
}

#[test]
fn slips_of_units_in_arguments_of_a_law_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let law = |density: &str, young: &str| {
        let arguments = [
            "law",
            "--young",
            young,
            "--yield",
            "162MPa",
            "--poisson",
            "0.343",
            "--density",
            density,
            "--radius",
            "250um",
            "--out",
            "law.toml",
        ];
        said(
            here,
            &arguments,
            if density == "8960kg/m3" && young == "128GPa" {
                0
            } else {
                2
            },
        )
    };
    for (density, young, argument) in [
        ("8.96kg/m3", "128GPa", "--density"),
        ("8960kg/m3", "128TPa", "--young"),
    ] {
        let text = law(density, young);
        assert!(
            text.contains(argument) && text.contains("check the unit"),
            "{text}"
        );
        assert!(!here.join("law.toml").exists());
    }
    law("8960kg/m3", "128GPa");
    let eval = |displacement: &str, most: &[&str]| {
        let call = [
            "law",
            "eval",
            "law.toml",
            "--body",
            "250 um",
            "--displacements",
            displacement,
        ];
        said(here, &[&call[..], most].concat(), 2)
    };
    assert!(eval("300 um", &[]).contains("must be less than the radius"));
    let back = ["--max-displacement", "0.5 um"];
    assert!(eval("1 um", &back).contains("must be at most --max-displacement"));
}

#[test]
fn slips_of_units_in_arguments_of_inverse_are_refused_before_the_range_of_the_atlas() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("m.csv"), "velocity_m_s,restitution\n10,0.6\n").unwrap();
    let inverse = |density: &str, young: &str, radius: &str| {
        let arguments = [
            "inverse",
            "m.csv",
            "--young",
            young,
            "--poisson",
            "0.35",
            "--density",
            density,
            "--radius",
            radius,
            "--sigma-restitution",
            "0.01",
            "--draws",
            "200",
        ];
        let code = match [density, young, radius] {
            ["8000kg/m3", "100GPa", "250um"] => 0,
            _ => 2,
        };
        said(here, &arguments, code)
    };
    for (density, young, radius, argument) in [
        ("8kg/m3", "100GPa", "250um", "--density"),
        ("8000kg/m3", "100TPa", "250um", "--young"),
        ("8000kg/m3", "100GPa", "250m", "--radius"),
    ] {
        let text = inverse(density, young, radius);
        let named = text.contains(argument) && text.contains("check the unit");
        assert!(named, "{text}");
        assert!(!here.join("out").exists());
    }
    inverse("8000kg/m3", "100GPa", "250um");
}

#[test]
fn a_specific_heat_in_joules_per_gram_is_refused_and_one_speed_without_brackets_is_told_to_be_a_list()
 {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let case = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8960 kg/m3\"\nyoung_modulus = \"124 GPa\"\npoisson_ratio = 0.34\nyield_strength = \"90 MPa\"\nhardening_coefficient = \"292 MPa\"\nhardening_exponent = 0.31\nrate_sensitivity = 0.025\nsoftening_exponent = 1.09\nmelting_temperature = \"1356 K\"\nspecific_heat = \"383 J/(kg K)\"\n[impact]\nvelocities = [\"20 m/s\"]\n[accuracy]\ntolerance = 0.2\n";
    let plan = |text: String, code: i32| {
        std::fs::write(here.join("cu.toml"), text).unwrap();
        said(here, &["impact", "cu.toml"], code)
    };
    let text = plan(case.replace("383 J", "0.383 J"), 2);
    assert!(
        text.contains("check the unit of material.specific_heat"),
        "{text}"
    );
    let text = plan(case.replace("[\"20 m/s\"]", "\"20 m/s\""), 2);
    let told = text.contains("impact.velocities") && text.contains("expected a list");
    assert!(told, "{text}");
    // a study is still told to be one
    let axis = case.replace("0.34", "[0.3, 0.34]");
    let text = plan(axis.replace("[\"20 m/s\"]", "\"20 m/s\""), 2);
    assert!(text.contains("found a study file"), "{text}");
    assert!(!here.join("out").exists());
}

#[test]
fn a_list_of_grains_without_a_unit_is_not_read_in_metres_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let count = "count = 8\nradius = \"1 mm\"\n";
    let scene =
        |file: &str| SCENE.replace(count, &format!("file = {{ path = \"g.csv\"{file} }}\n"));
    let write = |file: &str, head: &str| {
        std::fs::write(here.join("scene.toml"), scene(file)).unwrap();
        std::fs::write(
            here.join("g.csv"),
            format!("{head}\n2,2,1.1,1\n6,6,1.1,1\n"),
        )
        .unwrap();
    };
    write("", "x,y,z,radius");
    let text = said(here, &["bed", "scene.toml"], 2);
    let told = text.contains("grains.file.path") && text.contains("`length = \"1 mm\"`");
    assert!(told && text.contains("a radius is 1 m;"), "{text}");
    assert!(!here.join("out").exists());
    for (file, head) in [
        (", length = \"1 mm\"", "x,y,z,radius"),
        ("", "x_mm,y_mm,z_mm,radius_mm"),
    ] {
        write(file, head);
        said(here, &["bed", "scene.toml"], 0);
        std::fs::remove_dir_all(here.join("out")).unwrap();
    }
}

#[test]
fn results_of_another_study_are_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let study = "particle.radius = \"1 mm\"\naccuracy.tolerance = 0.2\n[material]\ndensity = \"2700 kg/m3\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\nyield_strength = \"200 MPa\"\n[impact]\nvelocities = [\"5 m/s\"]\n";
    for name in ["a.toml", "b.toml"] {
        std::fs::write(here.join(name), study).unwrap();
    }
    said(here, &["study", "a.toml", "--out", "o"], 0);
    let results = || std::fs::read(here.join("o/results.csv")).unwrap();
    let before = results();
    let text = said(here, &["study", "b.toml", "--out", "o"], 2);
    assert!(text.contains("the results of a.toml"), "{text}");
    assert_eq!(results(), before);
}

const COPPER: &str = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8960 kg/m3\"\nyoung_modulus = \"128 GPa\"\npoisson_ratio = 0.343\nyield_strength = \"162 MPa\"\n[impact]\nvelocities = [\"20 m/s\"]\n[accuracy]\ntolerance = 0.2\n";

#[test]
fn a_comparison_with_another_law_leaves_that_of_the_own_one() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("cu.toml"), COPPER).unwrap();
    said(here, &["run", "cu.toml"], 0);
    let own = || std::fs::read(here.join("out/cu/compare.csv")).unwrap();
    let before = own();
    said(here, &["compare", "cu.toml", "--law", "atlas"], 0);
    assert_eq!(own(), before);
    let other = std::fs::read_to_string(here.join("out/cu/compare-atlas/compare.csv")).unwrap();
    assert!(
        other.contains("atlas,") && !other.contains("fitted,"),
        "{other}"
    );
    // two laws of one file name do not share a folder
    for folder in ["a", "b"] {
        std::fs::create_dir(here.join(folder)).unwrap();
        std::fs::copy(
            here.join("out/cu/law.toml"),
            here.join(folder).join("x.toml"),
        )
        .unwrap();
    }
    said(here, &["compare", "cu.toml", "--law", "a/x.toml"], 0);
    let of_a = || std::fs::read(here.join("out/cu/compare-x/compare.csv")).unwrap();
    let before = of_a();
    let text = said(here, &["compare", "cu.toml", "--law", "b/x.toml"], 2);
    assert!(text.contains("holds the comparison with"), "{text}");
    assert_eq!(of_a(), before);
    said(here, &["compare", "cu.toml", "--law", "a/x.toml"], 0);
    let elsewhere = ["compare", "cu.toml", "--law", "b/x.toml", "--out", "o"];
    said(here, &elsewhere, 0);
}

#[test]
fn a_damaged_file_of_a_run_is_told_by_what_is_wrong_in_it() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("cu.toml"), COPPER).unwrap();
    said(here, &["impact", "cu.toml"], 0);
    let summary = here.join("out/cu/impact_V20/summary.json");
    let curve = here.join("out/cu/impact_V20/curve.csv");
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    // files of versions without a sum, so that it is the text that is looked at
    let text = read(&summary);
    let (before, _) = text.split_once(",\n  \"sha256\"").unwrap();
    let plain = format!("{before}\n}}\n");
    for (file, from, to, wrong) in [
        (&summary, "\"radius_m\"", "\"radus_m\"", "radius_m"),
        (
            &summary,
            "\"poisson_ratio\"",
            "\"colour\": 1, \"poisson_ratio\"",
            "colour",
        ),
        (&curve, "time_s", "time_h", "time_h"),
    ] {
        std::fs::write(&summary, &plain).unwrap();
        let whole = read(file);
        assert!(whole.contains(from), "{whole}");
        std::fs::write(file, whole.replacen(from, to, 1)).unwrap();
        let text = said(here, &["fit", "cu.toml"], 2);
        assert!(text.contains(wrong) && !text.contains("TOML"), "{text}");
        std::fs::write(file, whole).unwrap();
    }
}

#[test]
fn a_file_that_is_no_toml_is_called_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("results.csv"), "a,b\n1,2\n").unwrap();
    std::fs::write(here.join("part.stl"), [0u8, 159, 146, 150]).unwrap();
    for file in ["results.csv", "part.stl"] {
        let text = said(here, &["run", file], 2);
        assert!(text.contains("must be a TOML file"), "{text}");
    }
}

#[test]
fn studies_and_beds_have_a_plan() {
    let folder = tempfile::tempdir().unwrap();
    let shipped = |name: &str| format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"));
    let plan = |name: &str| -> serde_json::Value {
        let output = impactlaw(folder.path(), &["plan", &shipped(name), "--json"]);
        assert_eq!(output.status.code(), Some(0), "{}", message(&output));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let study = plan("study-480.toml");
    assert_eq!(study["cases"], 480);
    assert!(study["runs"].as_u64().unwrap() < 480);
    assert!(study["predicted_core_s"].as_f64() > study["longest_run_core_s"].as_f64());
    let bed = plan("solder-bed.toml");
    assert_eq!(bed["grains"], 220.0);
    let stages = bed["stages"].as_array().unwrap();
    assert_eq!(stages.len(), 4);
    assert_eq!(stages[1]["steps"], 2000.0);
    assert!(stages[2]["steps"].is_null());
}
