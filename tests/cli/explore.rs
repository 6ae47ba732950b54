//! The page of laws and theories: what it shows in a browser are the library's numbers, and its sliders move them.

use crate::browser;
use crate::program::{impactlaw, message};
use impactlaw::explore::answer;
use impactlaw::explore::page::{COMMANDS, MADE, MARK, html};
use impactlaw::law::{AnyLaw, LawFile};
use impactlaw::material::flow::LinearHardening;
use impactlaw::material::{Flow, Material};
use impactlaw::theory::Theory;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Relative difference that counts as rounding.
const ROUNDING: f64 = 1e-12;
/// Largest page, bytes.
const LARGEST: usize = 3_000_000;

/// Latest change of a Rust source below `folder`.
fn changed(folder: &Path) -> SystemTime {
    let entries = std::fs::read_dir(folder).unwrap().map(Result::unwrap);
    let of = |entry: std::fs::DirEntry| match entry.path() {
        path if path.is_dir() => changed(&path),
        path if path.extension().is_some_and(|end| end == "rs") => {
            entry.metadata().unwrap().modified().unwrap()
        }
        _ => SystemTime::UNIX_EPOCH,
    };
    entries.map(of).max().unwrap_or(SystemTime::UNIX_EPOCH)
}

/// The laws as WebAssembly; `None`, said loudly, where they are not made of the present sources.
fn wasm() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join(MADE);
    let made = path.metadata().and_then(|about| about.modified());
    match made {
        Ok(made) if made >= changed(&root.join("src")) => Some(path),
        Ok(_) => {
            eprintln!("!! SKIPPED: {MADE} is older than the sources; .ci/explorer makes it anew");
            None
        }
        Err(_) => {
            eprintln!(
                "!! SKIPPED: there is no {MADE}; .ci/explorer makes it, the page was not opened"
            );
            None
        }
    }
}

fn body(young: &str, strength: &str, hardening: &str) -> Value {
    json!({"young": young, "poisson": "0.343", "density": "8.96 g/cc", "strength": strength, "hardening": hardening,
        "radius": "250 um", "velocity": "10 m/s", "law": null})
}

/// The law and every theory.
fn names() -> Vec<&'static str> {
    std::iter::once("law")
        .chain(Theory::ALL.map(Theory::name))
        .collect()
}

fn asked(question: &Value) -> Value {
    serde_json::from_str(&answer(&question.to_string())).unwrap()
}

fn copper(flow: Flow) -> Material {
    Material {
        density: 8960.0,
        young_modulus: 128e9,
        poisson_ratio: 0.343,
        flow: Some(flow),
    }
}

#[test]
fn answers_are_those_of_the_laws() {
    let hardening = LinearHardening {
        strength: 162e6,
        modulus: 500e6,
    };
    for (flow, text) in [
        (Flow::perfectly_plastic(162e6), ""),
        (hardening.into(), "500 MPa"),
    ] {
        let body = body("128 GPa", "162 MPa", text);
        let impact = json!({"ask": "impact", "body": body, "laws": names(), "press": null});
        let velocities = [0.001, 3.0, 10.0];
        let restitution =
            json!({"ask": "restitution", "body": body, "laws": names(), "velocities": velocities});
        let (impact, restitution) = (asked(&impact), asked(&restitution));
        let material = copper(flow);
        let mass = material.sphere_mass(250e-6);
        for (i, name) in names().into_iter().enumerate() {
            let name = if name == "law" { "atlas" } else { name };
            let law = AnyLaw::named(name, None, &material).unwrap();
            let hits = law.rebounds(250e-6, mass, &velocities).unwrap();
            let told = &impact["laws"][i]["pressed"];
            assert_eq!(told["max_force_N"], hits[2].max_force, "{name}");
            assert_eq!(told["contact_time_s"], hits[2].contact_time, "{name}");
            let e: Vec<f64> = hits.iter().map(|hit| hit.restitution).collect();
            assert_eq!(
                restitution["laws"][i]["bounces"]["restitution"],
                json!(e),
                "{name}"
            );
        }
    }
}

#[test]
fn curves_hold_the_energy_of_the_impact() {
    let question = json!({"ask": "impact", "body": body("128 GPa", "162 MPa", ""), "laws": names(), "press": null});
    let told = asked(&question);
    let energy = 0.5 * told["about"]["mass_kg"].as_f64().unwrap() * 100.0;
    for law in told["laws"].as_array().unwrap() {
        let column = |key: &str| -> Vec<f64> {
            serde_json::from_value(law["pressed"][key].clone()).unwrap()
        };
        let (d, f) = (column("displacement_m"), column("force_N"));
        let work = |i: usize| 0.5 * (f[i] + f[i - 1]) * (d[i] - d[i - 1]);
        let (there, back): (Vec<usize>, Vec<usize>) = (1..d.len()).partition(|&i| d[i] > d[i - 1]);
        let sum = |steps: Vec<usize>| steps.into_iter().map(work).sum::<f64>();
        // straight lines between the points of the curve, inertia and all
        let (there, back) = (sum(there) / energy, -sum(back) / energy);
        let e = law["pressed"]["restitution"].as_f64().unwrap();
        let name = &law["name"];
        assert!((there - 1.0).abs() < 2e-3, "{name}: {there}");
        assert!((back - e * e).abs() < 2e-3, "{name}: {back} for {}", e * e);
    }
}

#[test]
fn a_slow_press_lets_go_where_the_law_does() {
    let question = json!({"ask": "impact", "body": body("128 GPa", "162 MPa", ""), "laws": names(), "press": "5 um"});
    let told = asked(&question);
    let material = copper(Flow::perfectly_plastic(162e6));
    for law in told["laws"].as_array().unwrap() {
        let name = match law["name"].as_str().unwrap() {
            "law" => "atlas",
            name => name,
        };
        let pressed = &law["pressed"];
        let residual = pressed["residual_displacement_m"].as_f64().unwrap();
        let at = [residual - 1e-10, residual + 1e-10, 5e-6];
        let forces = AnyLaw::named(name, None, &material).unwrap();
        let forces = forces.forces(250e-6, 5e-6, &at).unwrap();
        assert!(forces[0] <= 0.0 && forces[1] > 0.0, "{name}: {forces:?}");
        let force = pressed["max_force_N"].as_f64().unwrap();
        assert!((force / forces[2] - 1.0).abs() < 1e-14, "{name}: {force}");
        assert_eq!(pressed["restitution"], Value::Null);
    }
}

#[test]
fn what_is_wrong_is_said_in_the_words_of_the_program() {
    let error = |body: Value, press: Value| {
        let told = asked(&json!({"ask": "impact", "body": body, "laws": ["law"], "press": press}));
        told["error"].as_str().unwrap_or_default().to_owned()
    };
    let good = body("128 GPa", "162 MPa", "");
    assert_eq!(error(good.clone(), Value::Null), "");
    let no_unit = error(body("128", "162 MPa", ""), Value::Null);
    assert!(
        no_unit.starts_with("Young's modulus: found \"128\"; must be a pressure with its unit"),
        "{no_unit}"
    );
    let gone = error(good.clone(), json!("250 um"));
    assert!(
        gone.contains("displacement: found \"250 um\"; must be less than the radius"),
        "{gone}"
    );
    let mut pair = good.clone();
    pair["law"] = json!({"name": "own.toml", "text": "schema = 1\nname = 'x'\n"});
    assert!(error(pair, Value::Null).contains("own.toml"));
    let outside = json!({"ask": "impact", "body": body("128 GPa", "5 MPa", ""), "laws": ["law", "hertz"], "press": null});
    let told = asked(&outside);
    let said = told["laws"][0]["refused"].as_str().unwrap();
    assert!(
        said.contains("E/Y: found 25600; must lie in") && said.contains("range of the atlas"),
        "{said}"
    );
    assert_eq!(told["laws"][0]["pressed"], Value::Null);
    assert_eq!(told["laws"][1]["refused"], Value::Null);
    assert!(asked(&json!({"ask": "weather"}))["error"].is_string());
}

#[test]
fn downloads_are_the_files_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let made = impactlaw(
        folder.path(),
        &[
            "law",
            "--young",
            "128 GPa",
            "--yield",
            "162 MPa",
            "--poisson",
            "0.343",
            "--density",
            "8.96 g/cc",
            "--radius",
            "250 um",
            "-o",
            "copper.toml",
        ],
    );
    assert!(made.status.success(), "{}", message(&made));
    let exported = impactlaw(
        folder.path(),
        &["export", "copper.toml", "--to", "c", "-o", "."],
    );
    assert!(exported.status.success(), "{}", message(&exported));
    let body = body("128 GPa", "162 MPa", "");
    for (ask, name, path) in [
        ("file", "copper.toml", "copper.toml"),
        ("header", "copper.h", "c/copper.h"),
    ] {
        let told = asked(&json!({"ask": ask, "body": body, "name": "copper"}));
        assert_eq!(told["name"], name);
        let file = std::fs::read_to_string(folder.path().join(path)).unwrap();
        assert_eq!(told["text"].as_str().unwrap(), file, "{path}");
    }
}

#[test]
fn without_webassembly_the_verb_says_how_it_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("explorer.html");
    let output = impactlaw(folder.path(), &["explore"]);
    if option_env!("IMPACTLAW_EXPLORER").is_some() {
        assert!(output.status.success() && page.exists());
        return;
    }
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(COMMANDS.iter().all(|line| said.contains(line)), "{said}");
    for (text, found) in [
        ("\0asm", "the WebAssembly of something else"),
        ("<html>", "no WebAssembly"),
    ] {
        std::fs::write(folder.path().join("other.wasm"), text).unwrap();
        let output = impactlaw(folder.path(), &["explore", "--wasm", "other.wasm"]);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains("other.wasm") && said.contains(found),
            "{said}"
        );
    }
    assert!(!page.exists());
}

#[test]
fn the_page_names_no_address_and_fills_every_place() {
    let wasm = ["\0asm", MARK].concat();
    let page = html(wasm.as_bytes(), Path::new("x.wasm")).unwrap();
    let foreign = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!foreign.contains("://") && !page.contains("{{"));
    assert!(page.contains("default-src 'none'"));
    for name in names().into_iter().chain(["copper-soft", "sac305"]) {
        assert!(page.contains(&format!("\"name\":\"{name}\"")), "{name}");
    }
    // the two packages have one version
    let manifest = include_str!("../../src/explorer/Cargo.toml");
    let version = format!("version = \"{}\"\n", env!("CARGO_PKG_VERSION"));
    assert!(manifest.contains(&version));
}

/// Moves everything that can be moved, and tells what became of it.
const DRIVER: &str = include_str!("explore.html");

/// What a small screen shows: nothing is wider than it, and what is to be touched is large enough.
const SMALL: &str = r#"<script type="module">
do await new Promise((done) => setTimeout(done, 20)); while (document.documentElement.dataset.state !== "ready");
const width = document.documentElement.clientWidth;
const touched = [...document.querySelectorAll("input:not([type=file]), select, button:not([hidden])")];
const places = (one) => one.getBoundingClientRect();
parent.document.getElementById("found").textContent = JSON.stringify({ window: innerWidth, wide: Math.max(0, document.documentElement.scrollWidth - width),
  small: touched.filter((one) => places(one).height < 13).length, out: touched.filter((one) => places(one).right > width).length,
  curves: document.querySelectorAll("path.curve").length > 10 });
</script>"#;

/// What a page leaves behind as JSON.
fn driven(page: &str, browser: &Path) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let (document, said) = browser::open(browser, page, folder.path());
    let found = document.split_once(r#"<pre id="found">"#);
    let found = found.and_then(|(_, rest)| rest.split_once("</pre>"));
    let (found, _) = found.unwrap_or_else(|| panic!("{said}"));
    let found = found.replace("&lt;", "<").replace("&gt;", ">");
    let found = found.replace("&quot;", "\"").replace("&amp;", "&");
    serde_json::from_str(&found).unwrap_or_else(|why| panic!("{why}: {found}\n{said}"))
}

/// Largest relative difference of the numbers of two answers of the same shape.
fn apart(one: &[Option<f64>], other: &[Option<f64>]) -> f64 {
    assert_eq!(one.len(), other.len());
    let pairs = one.iter().zip(other);
    let difference = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
        (None, None) => 0.0,
        (Some(a), Some(b)) => (a - b).abs() / b.abs().max(f64::MIN_POSITIVE),
        _ => f64::INFINITY,
    };
    pairs.map(difference).fold(0.0, f64::max)
}

/// Columns of the table of the page.
fn columns(law: &Value) -> Vec<Option<f64>> {
    let pressed = |key: &str| law["pressed"][key].as_f64();
    vec![
        pressed("max_force_N"),
        pressed("max_displacement_m"),
        pressed("residual_displacement_m"),
        pressed("restitution"),
        law["restitution_closed_form"].as_f64(),
        pressed("contact_time_s"),
    ]
}

fn row(found: &Value) -> Vec<Option<f64>> {
    let cells = found.as_array().unwrap_or_else(|| panic!("{found}"));
    cells.iter().map(Value::as_f64).collect()
}

/// That two texts are the same but for the last digits of their numbers, and for sums over them.
fn same_text(one: &str, other: &str) {
    let words = |text: &str| -> Vec<String> {
        let apart = |c: char| !(c.is_ascii_alphanumeric() || "+-._".contains(c));
        text.split(apart).map(str::to_owned).collect()
    };
    let (one, other) = (words(one), words(other));
    assert_eq!(one.len(), other.len());
    for (a, b) in one.iter().zip(&other) {
        let sum = a.len() == 64 && b.len() == 64;
        let near = match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= 1e-10 * b.abs(),
            _ => a == b,
        };
        assert!(sum || near, "{a} for {b}");
    }
}

#[test]
fn in_a_browser_sliders_move_curves_and_numbers_are_those_of_the_library() {
    let (Some(wasm), Some(browser)) = (wasm(), browser::find()) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let wasm = wasm.to_str().unwrap();
    let written = impactlaw(
        folder.path(),
        &["explore", "--wasm", wasm, "-o", "page.html"],
    );
    assert!(written.status.success(), "{}", message(&written));
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.len() <= LARGEST, "{} bytes", page.len());
    let own = include_str!("../../models/sac305-solder.toml");
    let text = json!(own).to_string().replace('<', "\\u003c");
    let with = |driver: &str| page.replace("</body>", &[driver, "</body>"].concat());
    let found = driven(&with(&DRIVER.replace("OWN", &text)), &browser);
    assert_eq!(found["why"], Value::Null);
    let small = with(SMALL).replace('&', "&amp;").replace('"', "&quot;");
    let small = format!(
        r#"<!doctype html><pre id="found"></pre><iframe width="360" height="640" srcdoc="{small}"></iframe>"#
    );
    let small = driven(&small, &browser);
    assert_eq!(
        small,
        json!({"window": 360, "wide": 0, "small": 0, "out": 0, "curves": true})
    );

    let mut laws = names();
    laws.push("wu-li-thornton");
    let body = body("128 GPa", "162 MPa", "500 MPa");
    let told = asked(&json!({"ask": "impact", "body": body, "laws": laws, "press": null}));
    let mut most = 0.0_f64;
    for (i, name) in laws.iter().enumerate() {
        let difference = apart(&row(&found["figures"][name]), &columns(&told["laws"][i]));
        assert!(difference <= ROUNDING, "{name}: {difference:e}");
        most = most.max(difference);
    }
    println!("largest difference of a figure: {most:e}");
    let material = copper(Flow::perfectly_plastic(162e6));
    let first = material.yield_point(250e-6, 1.6).unwrap().velocity;
    assert!((found["yield"].as_f64().unwrap() / first - 1.0).abs() <= ROUNDING);

    let pressed = asked(&json!({"ask": "impact", "body": body, "laws": ["law"], "press": "5 um"}));
    assert!(apart(&row(&found["pressed"]), &columns(&pressed["laws"][0])) <= ROUNDING);

    // models that are unverified are shown on request
    let shown = found["laws"].as_array().unwrap();
    assert!(shown.contains(&json!("law")) && shown.contains(&json!("mdr")));
    assert!(!shown.contains(&json!("stronge")));
    for (id, moved) in found["moved"].as_object().unwrap() {
        // restitution does not depend on the radius
        let wanted = json!([true, id != "radius", true]);
        assert_eq!(*moved, wanted, "{id}");
    }
    assert_eq!(found["arrow"], "10.6 m/s");

    let outside = &found["outside"];
    let said = outside["said"].as_str().unwrap();
    assert!(said.contains("range of the atlas"), "{said}");
    assert_eq!(outside["hidden"], false);
    assert_eq!(
        (&outside["curves"], &outside["save"]),
        (&json!(0), &json!(true))
    );
    assert_ne!(outside["others"], 0);
    assert_eq!(found["nonsense"]["curves"], 0);
    let said = found["nonsense"]["said"].as_str().unwrap();
    assert!(
        said.starts_with("yield strength: found \"5 nonsense\""),
        "{said}"
    );

    for (key, ask) in [("file", "file"), ("header", "header")] {
        let told = asked(&json!({"ask": ask, "body": body, "name": "law"}));
        same_text(found[key].as_str().unwrap(), told["text"].as_str().unwrap());
    }
    let csv = found["csv"].as_str().unwrap();
    assert!(csv.starts_with("law,velocity_m_s,restitution,restitution_closed_form,supported\n"));
    assert_eq!(csv.lines().count(), 1 + 49 * laws.len());

    let file = LawFile::parse(&impactlaw::document::Document::new(
        "own.toml".as_ref(),
        own,
    ));
    let file = file.unwrap();
    let mass = file.material().sphere_mass(250e-6);
    let law = AnyLaw::Fitted(file.law().unwrap());
    let hit = law.rebounds(250e-6, mass, &[10.0]).unwrap()[0];
    let e = row(&found["own"]["figures"])[3].unwrap();
    assert!((e / hit.restitution - 1.0).abs() <= ROUNDING);
    assert_eq!(found["own"]["disabled"], true);
    assert_eq!(found["own"]["hidden"], true);

    assert_eq!(found["nameless"], 0);
    assert_eq!(found["wide"], 0, "the page is wider than its window");
    assert_eq!(found["asked"], 0, "the page asked for something");
}
