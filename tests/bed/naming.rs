//! Names are the user's own: any text that does no harm where it is printed, in messages, CSV, JSON and pages.

use crate::browser;
use crate::page::visit;
use crate::scene_run::run;
use impactlaw::bed::scene::Scene;
use std::collections::BTreeSet;
use std::path::Path;

/// A ball dropped on a body called NAME, in a domain or box.
fn scene(name: &str, room: &str) -> String {
    let name = toml::Value::String(name.to_owned()).to_string();
    format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n[material]\ndensity = \"2500 kg/m3\"\nyoung_modulus = \"10 MPa\"\npoisson_ratio = 0.25\nlaw = \"hertz\"\n\
         [grains]\ncount = 4\nradius = \"1 mm\"\nregion = {{ low = [\"2 mm\", \"2 mm\", \"4 mm\"], high = [\"12 mm\", \"12 mm\", \"12 mm\"] }}\n{room}\n\
         [[body]]\nname = {name}\nblock = {{ size = [\"30 mm\", \"30 mm\", \"2 mm\"] }}\nat = [\"7 mm\", \"7 mm\", \"2 mm\"]\ndriven = {{}}\n\
         [[outlet]]\nname = {name}\nplane = {{ at = [\"0 mm\", \"0 mm\", \"-50 mm\"], normal = [0.0, 0.0, -1.0] }}\n\
         [[stage]]\nkind = \"run\"\nname = {name}\nduration = \"40 ms\"\nmove = [{{ body = {name}, driven = {{ velocity = [\"0 m/s\", \"0 m/s\", \"10 mm/s\"] }} }}]\n\
         until = {{ force = {{ body = {name}, above = \"1 kN\" }} }}\n[[measure]]\nkind = \"plunge\"\nbody = {name}\n[output]\nrows = 4\nframes = 1\nfilm = 2\n"
    )
}

const DOMAIN: &str = "[domain]\nlow = [\"-30 mm\", \"-30 mm\", \"-60 mm\"]\nhigh = [\"50 mm\", \"50 mm\", \"60 mm\"]";
const BOX: &str = "[box]\nwidth = \"14 mm\"\ndepth = \"14 mm\"\nheight = \"40 mm\"";

#[test]
fn a_body_may_be_called_anything_that_does_no_harm() {
    let names = [
        "floor",
        "piston",
        "left",
        "a b",
        "a,b;c",
        "\"quoted\"",
        "it's",
        "</script><script>complaints.push('hacked')</script>",
        "<!-- <script>",
        "{{data}}",
        "Förderband №1 搬送",
        "=1+2",
        "../up",
        "%s\\n",
        "nan",
    ];
    let browser = browser::find();
    for name in names {
        let checked = Scene::parse(&scene(name, DOMAIN), Path::new("named.toml"));
        let checked = checked.unwrap_or_else(|error| panic!("{name}: {error}"));
        let (report, folder) = run(&checked);
        let inside = folder.path().join("bed/hertz");
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_path(inside.join("bodies.csv"))
            .unwrap();
        let bodies: BTreeSet<String> = reader
            .records()
            .map(|row| row.unwrap()[2].to_owned())
            .collect();
        assert_eq!(bodies, BTreeSet::from([name.to_owned()]));
        let text = std::fs::read_to_string(inside.join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let told = format!("grains out at {name}");
        let findings = summary["findings"].as_array().unwrap();
        assert!(findings.iter().any(|found| found["name"] == told), "{name}");
        // a body that bears the name of a piston or wall is none where there is no box
        for row in &report.laws[0].rows {
            assert_eq!((row.stress_pa, row.lateral_stress_pa), (0.0, 0.0), "{name}");
        }
        let page = std::fs::read_to_string(inside.join("bed.html")).unwrap();
        if let Some(browser) = browser
            .as_deref()
            .filter(|_| name.contains('<') || name.contains('{'))
        {
            let told = visit(browser, &page);
            assert_eq!(told["complaints"], serde_json::json!([]), "{name}: {told}");
        }
    }
}

#[test]
fn names_that_could_do_harm_or_are_taken_are_refused() {
    let refused = |text: &str, says: &[&str]| {
        let error = Scene::parse(text, Path::new("named.toml"))
            .unwrap_err()
            .to_string();
        for say in says {
            assert!(error.contains(say), "{say:?} is not in: {error}");
        }
    };
    for harm in [
        "",
        "  ",
        "a\nb",
        "a\rb",
        "\u{1b}[31mred",
        "\0",
        "bell\u{7}",
        "\u{9b}2J",
    ] {
        refused(
            &scene(harm, DOMAIN),
            &["`body[0].name`", "control characters"],
        );
    }
    for wall in ["floor", "left", "right", "front", "back", "piston"] {
        refused(&scene(wall, BOX), &["`body[0].name`", "wall of the box"]);
    }
    // a side that is periodic has no wall, and its name is free
    let open = scene("left", BOX).replacen("seed", "periodic = [\"x\"]\nseed", 1);
    Scene::parse(&open, Path::new("named.toml")).unwrap();
    let group = scene("a", DOMAIN).replace("count = 4", "name = \"a\\tb\"\ncount = 4");
    refused(&group, &["`grains.name`", "control characters"]);
    let stage = scene("a", DOMAIN).replace(
        "kind = \"run\"\nname = \"a\"",
        "kind = \"run\"\nname = \"\\u001b[2J\"",
    );
    refused(&stage, &["`stage[0].name`", "control characters"]);
}
