//! Outlets: grains that reach one leave, are counted, and take their energy out of the account; all else goes on as if they
//! had never been there.

use crate::browser;
use crate::same_bits::assert_same_bits;
use crate::scene_run::quiet;
use impactlaw::bed::run::{BedReport, run_scene};
use impactlaw::bed::scene::Scene;
use std::collections::BTreeSet;
use std::path::Path;

/// A column of grains that yield, which slumps to the side where grains press each other into the outlet.
const SLUMP: &str = r#"
laws = ["thornton"]
seed = 5
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.3
yield_strength = "40 kPa"
[grains]
name = "sand"
count = 400
radius = "1 mm"
spread = 0.2
region = { low = ["0 mm", "0 mm", "0 mm"], high = ["14 mm", "12 mm", "95 mm"] }
[contact]
friction = 0.3
rolling = 0.02
restitution = 0.6
[box]
width = "40 mm"
depth = "12 mm"
height = "110 mm"
[[outlet]]
name = "edge"
plane = { at = ["22 mm", "0 mm", "0 mm"], normal = [1.0, 0.0, 0.0] }
[[stage]]
kind = "run"
duration = "0.25 s"
[output]
rows = 30
frames = 3
film = 10
dump = true
"#;

fn scene(text: &str) -> Result<Scene, impactlaw::Error> {
    Scene::parse(text, Path::new("outlet.toml"))
}

fn ran(text: &str) -> (BedReport, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let report = run_scene(&scene(text).unwrap(), None, &quiet(folder.path()))
        .unwrap_or_else(|error| panic!("{error}"));
    (report, folder)
}

#[test]
fn what_leaves_is_counted_and_its_energy_booked_while_grains_press_each_other_out() {
    let (report, folder) = ran(SLUMP);
    let run = &report.laws[0];
    let (summary, rows) = (&run.summary, &run.rows);
    assert!(
        summary.outlet_grains > 100,
        "{} grains left",
        summary.outlet_grains
    );
    assert_eq!(summary.outlet_grains + summary.grains, 400);
    assert_eq!(summary.grains, run.grains.len());
    assert_eq!(summary.lost_grains, 0);
    assert!(summary.energy_closure < 1e-3, "{}", summary.energy_closure);
    let names: BTreeSet<u32> = run.grains.ids.iter().copied().collect();
    assert_eq!(names.len(), run.grains.len());
    // nothing of the heap is beyond the edge
    assert!(run.grains.spheres.iter().all(|s| s.centre.x <= 22.5e-3));

    let last = rows.last().unwrap();
    assert_eq!(last.outlet_grains, summary.outlet_grains);
    let mass = |grain: f64| 4.0 / 3.0 * std::f64::consts::PI * grain.powi(3) * 2500.0;
    let kept: f64 = run.grains.spheres.iter().map(|s| mass(s.radius)).sum();
    let first = rows[0].solid_fraction * rows[0].height_m * 40e-3 * 12e-3 * 2500.0;
    let whole = last.outlet_mass_kg + kept;
    assert!((whole / first - 1.0).abs() < 1e-9, "{whole} {first}");
    // the rate is the change of the mass, and what has been dissipated never comes back
    for pair in rows.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let passed = b.outlet_rate_kg_s * (b.time_s - a.time_s);
        let change = b.outlet_mass_kg - a.outlet_mass_kg;
        assert!(
            (passed - change).abs() < 1e-12 || a.time_s == b.time_s,
            "{passed} {change}"
        );
        assert!(b.plastic_j >= a.plastic_j * (1.0 - 1e-12));
        assert!(b.dissipated() >= a.dissipated() * (1.0 - 1e-9));
    }
    assert!(last.outlet_j > 0.0);
    let found = |name: &str| {
        let found = summary.findings.iter().find(|found| found.name == name);
        found.unwrap().value
    };
    assert_eq!(found("grains out at edge"), summary.outlet_grains as f64);
    assert_eq!(found("mass out at edge"), last.outlet_mass_kg);

    let dump = std::fs::read_to_string(folder.path().join("bed/thornton/dump.lammpstrj")).unwrap();
    let counts: Vec<&str> = dump
        .split("NUMBER OF ATOMS\n")
        .skip(1)
        .map(|rest| rest.lines().next().unwrap())
        .collect();
    assert_eq!(counts[0], "400");
    assert!(counts.last().unwrap().parse::<usize>().unwrap() < 400);
}

#[test]
fn a_bed_with_an_outlet_has_the_same_bits_on_any_threads_and_resumed() {
    assert_same_bits(SLUMP, ("thornton", 17));
}

/// Grains that nothing but gravity acts on.
const RAIN: &str = r#"
seed = 1
gravity = "9.81 m/s2"
[material]
density = "1000 kg/m3"
young_modulus = "5 MPa"
poisson_ratio = 0.25
law = "hertz"
[grains]
name = "rain"
count = 90
radius = "1 mm"
insertion = "stream"
rate = "2 g/s"
region = { low = ["0 mm", "0 mm", "60 mm"], high = ["20 mm", "20 mm", "70 mm"] }
[box]
width = "20 mm"
depth = "20 mm"
height = "80 mm"
[[outlet]]
name = "drain"
region = { low = ["0 mm", "0 mm", "0 mm"], high = ["20 mm", "20 mm", "10 mm"] }
[[stage]]
kind = "run"
duration = "0.5 s"
[[measure]]
kind = "flow"
height = "20 mm"
[output]
rows = 50
frames = 2
film = 0
"#;

#[test]
fn a_steady_stream_leaves_at_the_rate_at_which_it_comes_in() {
    let (report, _) = ran(RAIN);
    let run = &report.laws[0];
    assert_eq!(run.summary.outlet_grains, 90);
    assert_eq!(run.summary.grains, 0);
    assert_eq!(run.summary.lost_grains, 0);
    assert!(
        run.summary.warnings.is_empty(),
        "{:?}",
        run.summary.warnings
    );
    // 2 g/s for as long as it lasts: 90 * 4.19 mg / 2 g/s = 0.188 s, then a fall of 0.1 s
    let rates = run
        .rows
        .iter()
        .filter(|row| (0.13..0.28).contains(&row.time_s));
    let rates: Vec<f64> = rates.map(|row| row.outlet_rate_kg_s).collect();
    let mean = rates.iter().sum::<f64>() / rates.len() as f64;
    assert!((mean / 2e-3 - 1.0).abs() < 0.1, "{mean} kg/s");
    // without a grain in the room every figure is still one
    for row in &run.rows {
        for value in [
            row.coordination,
            row.solid_fraction,
            row.height_m,
            row.virial_stress_pa,
        ] {
            assert!(value.is_finite(), "{row:?}");
        }
    }
    // a flow through a plane above counts those that have left
    let passed = run
        .summary
        .findings
        .iter()
        .find(|found| found.name == "mass discharged");
    let mass = 90.0 * 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    assert!((passed.unwrap().value / mass - 1.0).abs() < 1e-9);
}

#[test]
fn two_outlets_count_their_own_and_a_fast_grain_is_not_missed() {
    // grains at 40 m/s through a region five radii thick: a quarter of a millisecond
    let text = RAIN
        .replace("insertion = \"stream\"\nrate = \"2 g/s\"\n", "velocity = [\"0 m/s\", \"0 m/s\", \"-40 m/s\"]\n")
        .replace("count = 90", "count = 100")
        .replace("young_modulus = \"5 MPa\"", "young_modulus = \"5 GPa\"")
        .replace("\"70 mm\"", "\"74 mm\"")
        .replace(
            "high = [\"20 mm\", \"20 mm\", \"10 mm\"]",
            "high = [\"10 mm\", \"20 mm\", \"10 mm\"]",
        )
        .replace(
            "[[stage]]",
            "[[outlet]]\nname = \"other\"\nregion = { low = [\"10 mm\", \"0 mm\", \"5 mm\"], high = [\"20 mm\", \"20 mm\", \"10 mm\"] }\n[[stage]]",
        )
        .replace("0.5 s", "3 ms");
    let (report, _) = ran(&text);
    let summary = &report.laws[0].summary;
    assert_eq!(summary.outlet_grains, 100);
    assert!(summary.energy_closure < 1e-9, "{}", summary.energy_closure);
    let of = |name: &str| {
        let found = summary.findings.iter().find(|found| found.name == name);
        found.unwrap().value
    };
    let (left, right) = (of("grains out at drain"), of("grains out at other"));
    assert_eq!(left + right, 100.0);
    assert!(left > 20.0 && right > 20.0, "{left} {right}");
}

#[test]
fn outlets_that_cannot_be_are_refused_by_name() {
    let refused = |from: &str, to: &str, says: &[&str]| {
        assert!(RAIN.contains(from), "{from}");
        let text = RAIN.replace(from, to);
        let folder = tempfile::tempdir().unwrap();
        let error = scene(&text).and_then(|scene| run_scene(&scene, None, &quiet(folder.path())));
        let Err(error) = error else {
            panic!("not refused: {to}")
        };
        let error = error.to_string();
        for say in says {
            assert!(error.contains(say), "{say:?} is not in: {error}");
        }
    };
    let region = "region = { low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"20 mm\", \"20 mm\", \"10 mm\"] }";
    refused(region, "", &["`outlet[0]`", "`region` or `plane`"]);
    refused(
        region,
        &format!(
            "{region}\nplane = {{ at = [\"0 mm\", \"0 mm\", \"0 mm\"], normal = [0.0, 0.0, -1.0] }}"
        ),
        &["`outlet[0]`", "must hold one place"],
    );
    refused(
        region,
        &region.replace("\"10 mm\"", "\"4 mm\""),
        &["`outlet[0].region`", "fly through it"],
    );
    refused(
        region,
        &region.replace("\"10 mm\"", "\"61 mm\""),
        &["`outlet[0]`", "\"rain\"", "stay clear"],
    );
    refused(
        region,
        "plane = { at = [\"0 mm\", \"0 mm\", \"65 mm\"], normal = [0.0, 0.0, -1.0] }",
        &["`outlet[0]`", "\"rain\"", "stay clear"],
    );
    refused(
        region,
        "plane = { at = [\"0 mm\", \"0 mm\", \"5 mm\"], normal = [0.0, 0.0, 0.0] }",
        &["`outlet[0].plane.normal`", "other than zero"],
    );
    // across a periodic side, twice the same name, and grains that stand in it from the start
    let across = "seed = 1\nperiodic = [\"x\"]\n";
    let plane = "plane = { at = [\"10 mm\", \"0 mm\", \"0 mm\"], normal = [1.0, 0.0, -1.0] }";
    let text = RAIN.replace("seed = 1\n", across).replace(region, plane);
    let error = scene(&text).unwrap_err().to_string();
    assert!(
        error.contains("`outlet[0].plane.normal`") && error.contains("across x"),
        "{error}"
    );
    let again = format!("name = \"drain\"\n{region}\n[[outlet]]\nname = \"drain\"\n{region}");
    refused(
        &format!("name = \"drain\"\n{region}"),
        &again,
        &["`outlet[1].name`"],
    );
    let stood = RAIN
        .replace("insertion = \"stream\"\nrate = \"2 g/s\"\n", "")
        .replace("region = { low = [\"0 mm\", \"0 mm\", \"60 mm\"], high = [\"20 mm\", \"20 mm\", \"70 mm\"] }", "");
    let folder = tempfile::tempdir().unwrap();
    let error = run_scene(&scene(&stood).unwrap(), None, &quiet(folder.path()));
    let error = error.err().unwrap().to_string();
    assert!(
        error.contains("`outlet[0]`") && error.contains("\"rain\""),
        "{error}"
    );
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}

#[test]
fn the_page_of_a_bed_that_empties_shows_the_grains_that_are_there() {
    let (_, folder) = ran(SLUMP);
    let page = std::fs::read_to_string(folder.path().join("bed/thornton/bed.html")).unwrap();
    assert!(page.contains("\"who\":null") && page.contains("\"who\":\""));
    let Some(browser) = browser::find() else {
        return;
    };
    let told = crate::page::visit(&browser, &page);
    assert_eq!(told["complaints"], serde_json::json!([]), "{told}");
    let drawn = |step: &str| told[step]["drawn"].as_u64().unwrap();
    assert!(drawn("first") > 1000 && drawn("last") > 1000, "{told}");
    assert_ne!(told["first"]["sum"], told["last"]["sum"]);
}
