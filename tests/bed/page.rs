//! Page of a bed in a real browser: drawn, moved in time, turned, and without a word of complaint.
//!
//! Needs Chromium or Chrome; where there is none the test says so and proves nothing.

use crate::browser;
use crate::scene_run::run;
use impactlaw::bed::scene::Scene;
use std::path::Path;

const SCENE: &str = r#"
laws = ["thornton"]
seed = 3
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
restitution = 0.5
[box]
width = "8 mm"
depth = "8 mm"
[[body]]
name = "<!--<script>"
at = ["-12 mm", "0 mm", "5 mm"]
ball.radius = "2 mm"
[[stage]]
kind = "settle"
stiffness = 0.1
longest = "150 ms"
rest_speed = "5 mm/s"
[[stage]]
kind = "relax"
steps = 200
[[stage]]
kind = "compress"
speed = "0.2 m/s"
seating_stress = "500 Pa"
strain = 0.03
[output]
rows = 10
frames = 0
"#;

/// Set before the page's own script: keeps every complaint.
const LISTEN: &str = "<script>window.complaints = [];
window.addEventListener('error', (event) => complaints.push(String(event.message)));
for (const kind of ['error', 'warn']) console[kind] = (...words) => complaints.push(words.join(' '));</script>";

/// Put after it: a visitor who looks, moves the slider, turns the bed, cuts it, takes the bodies away, and reports.
const VISIT: &str = "<script>(async () => {
const view = document.getElementById('view');
const wait = () => new Promise((done) => setTimeout(done, 100));
let before = null;
const look = async () => {
  let seen = picture();
  for (let tries = 0; tries < 50 && seen.sum === before; tries++) {
    await wait();
    seen = picture();
  }
  before = seen.sum;
  return seen;
};
const picture = () => {
  const copy = document.createElement('canvas');
  [copy.width, copy.height] = [view.width, view.height];
  const pen = copy.getContext('2d');
  pen.drawImage(view, 0, 0);
  const { data } = pen.getImageData(0, 0, copy.width, copy.height);
  let drawn = 0, sum = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] > 200) drawn++;
    sum = (sum * 31 + data[i] + 7 * data[i + 1] + 13 * data[i + 2] + data[i + 3]) % 2147483647;
  }
  return { drawn, sum, clock: document.getElementById('clock').textContent };
};
const set = (id, value, kind) => {
  const control = document.getElementById(id);
  if (control.type === 'checkbox') control.checked = value; else control.value = value;
  control.dispatchEvent(new Event(kind));
};
const told = { pixels: view.width * view.height, complaints };
told.frames = Number(document.getElementById('frame').max) + 1;
told.opened = await look();
told.ruler = [document.getElementById('length').textContent, document.getElementById('bar').clientWidth];
set('frame', '0', 'input');
told.first = await look();
set('frame', String(told.frames - 1), 'input');
told.last = await look();
set('colour', 'plastic', 'change');
told.plastic = await look();
set('bodies', false, 'input');
told.bare = await look();
set('cut', '60', 'input');
told.cut = await look();
document.getElementById('reset').click();
told.whole = await look();
const at = (kind, x) => view.dispatchEvent(new PointerEvent(kind, { pointerId: 1, clientX: x, clientY: 200, buttons: 1 }));
view.setPointerCapture = () => {};
at('pointerdown', 100); at('pointermove', 260); at('pointerup', 260);
told.turned = await look();
view.dispatchEvent(new WheelEvent('wheel', { deltaY: -600, cancelable: true }));
told.near = await look();
document.getElementById('play').click();
await wait();
told.playing = document.getElementById('play').textContent;
told.during = await look();
const out = document.createElement('pre');
out.id = 'told';
out.textContent = JSON.stringify(told);
document.body.append(out);
})();</script>";

/// The page as the visitor left it: what it told.
pub fn visit(browser: &Path, page: &str) -> serde_json::Value {
    let folder = tempfile::tempdir().unwrap();
    let visited = page
        .replace("<head>", &format!("<head>{LISTEN}"))
        .replace("</body>", &format!("{VISIT}</body>"));
    let (page, said) = browser::open(browser, &visited, folder.path());
    let told = page
        .split_once("<pre id=\"told\">")
        .and_then(|(_, rest)| rest.split_once("</pre>"))
        .unwrap_or_else(|| panic!("the page told nothing: {said}"));
    let text = told
        .0
        .replace("&amp;", "&")
        .replace("&lt;", "<")
        .replace("&gt;", ">");
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_page_draws_the_bed_and_follows_every_control() {
    let scene = Scene::parse(SCENE, Path::new("page.toml")).unwrap();
    let (_, folder) = run(&scene);
    let page = std::fs::read_to_string(folder.path().join("bed/thornton/bed.html")).unwrap();
    for outside in ["http:", "https:", "src=", "@import"] {
        assert!(!page.contains(outside), "{outside} in the page");
    }
    // the body's name is in the data, and opens no script
    assert!(page.contains("\\u003c!--\\u003cscript>") && !page.contains("<!--<script"));
    let Some(browser) = browser::find() else {
        return;
    };
    let told = visit(&browser, &page);
    assert_eq!(told["complaints"], serde_json::json!([]), "{told}");
    assert!(told["frames"].as_u64().unwrap() >= 10, "{told}");
    let drawn = |step: &str| told[step]["drawn"].as_u64().unwrap();
    let share = drawn("first") as f64 / told["pixels"].as_f64().unwrap();
    assert!(
        share > 0.05 && share < 0.9,
        "{share} of the pixels are grains: {told}"
    );
    // the page opens on the compressed bed, and says how large it is
    let opened = told["opened"]["clock"].as_str().unwrap();
    assert!(opened.ends_with("compress"), "{told}");
    let length = told["ruler"][0].as_str().unwrap();
    assert!(["1 mm", "2 mm", "5 mm"].contains(&length), "{told}");
    let wide = told["ruler"][1].as_f64().unwrap();
    assert!((40.0..128.0).contains(&wide), "{told}");
    let steps = [
        "first", "last", "plastic", "bare", "cut", "whole", "turned", "near", "during",
    ];
    for pair in steps.windows(2) {
        assert_ne!(
            told[pair[0]]["sum"], told[pair[1]]["sum"],
            "{pair:?} look the same: {told}"
        );
    }
    assert_ne!(told["first"]["clock"], told["last"]["clock"]);
    assert!(
        drawn("cut") < drawn("bare") && drawn("near") > drawn("turned"),
        "{told}"
    );
    assert_eq!(told["playing"], "Pause");
}
