//! Films of impacts: what ParaView reads, and the page in a real browser.

use crate::browser;
use crate::impact::{STEEL, impact};
use crate::program::message;
use impactlaw::curve::{Impact, Part, ParticleMap};

#[test]
fn a_film_shows_the_particle_at_rising_times_and_goes_with_its_impact() {
    let folder = tempfile::tempdir().unwrap();
    let output = impact(folder.path(), STEEL, &["--film", "20"]);
    assert!(output.status.success(), "{}", message(&output));
    let film = folder.path().join("o/impact_V20/film");
    let times: Vec<f64> = std::fs::read_to_string(film.join("points.pvd"))
        .unwrap()
        .split("timestep=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect();
    assert!(
        times[0] == 0.0 && times.is_sorted() && times.len() > 20,
        "{times:?}"
    );
    let compressed = ParticleMap::read(&film.with_file_name("particle_compressed.csv")).unwrap();
    let inside = compressed
        .points
        .iter()
        .filter(|p| p.part == Part::Inside)
        .count();
    let lowest = |frame: usize| {
        let bytes = std::fs::read(film.join(format!("points_{frame:04}.vtp"))).unwrap();
        let vtkio::model::DataSet::PolyData { pieces, .. } =
            vtkio::Vtk::parse_xml(&bytes[..]).unwrap().data
        else {
            panic!("not poly data")
        };
        let vtkio::model::Piece::Inline(piece) = &pieces[0] else {
            panic!("not inline")
        };
        let places: Vec<f64> = piece.points.cast_into().unwrap();
        assert_eq!(places.len(), 3 * inside);
        places
            .chunks(3)
            .map(|place| place[2])
            .fold(f64::INFINITY, f64::min)
    };
    let heights: Vec<f64> = (0..times.len()).map(lowest).collect();
    // it touches, is pressed flat, and has left in the end
    let summary = Impact::read(film.parent().unwrap()).unwrap().summary;
    assert!(
        heights
            .iter()
            .all(|height| *height > -1e-3 * summary.max_displacement_m),
        "{heights:?}"
    );
    assert!(
        *heights.last().unwrap() > 0.1 * summary.max_displacement_m,
        "{heights:?}"
    );

    let page = std::fs::read_to_string(film.join("film.html")).unwrap();
    assert!(page.contains("equivalent plastic strain") && !page.contains("http"));

    // an impact without a film leaves none of an earlier one
    assert!(impact(folder.path(), STEEL, &[]).status.success());
    assert!(!film.join("film.html").exists());
    assert!(!film.join("points.pvd").exists() && !film.join("surface_0003.vtp").exists());
    for refused in ["0", "401", "many"] {
        let output = impact(folder.path(), STEEL, &["--film", refused]);
        assert_eq!(output.status.code(), Some(2), "{refused}");
    }
}

const LISTEN: &str = "<script>var complaints = []; addEventListener('error', (e) => complaints.push(e.message));</script>";
const VISIT: &str = r"<script>
const look = () => {
  const view = document.getElementById('view');
  const data = view.getContext('2d').getImageData(0, 0, view.width, view.height).data;
  let [drawn, sum] = [0, 0];
  for (let i = 0; i < data.length; i += 4) if (data[i + 3]) { drawn++; sum += data[i] + 2 * data[i + 1] + 3 * data[i + 2]; }
  return { drawn, sum };
};
const set = (id, value, event) => { const it = document.getElementById(id); it.value = value; it.dispatchEvent(new Event(event)); };
const said = (id) => document.getElementById(id).textContent;
const told = { complaints, last: Number(document.getElementById('frame').max) };
told.peak = { at: Number(document.getElementById('frame').value), ...look() };
set('frame', 0, 'input');
told.first = { ...look(), clock: said('clock') };
set('frame', told.last, 'input');
told.end = look();
set('colour', 1, 'change');
told.mises = { ...look(), scale: said('quantity') + ' ' + said('ticks') };
document.getElementById('view').dispatchEvent(new WheelEvent('wheel', { deltaY: -600, clientX: 300, clientY: 300, cancelable: true }));
told.near = { ...look(), ruler: said('length') };
document.getElementById('reset').click();
told.whole = look();
document.getElementById('play').click();
told.play = said('play');
document.getElementById('play').click();
told.stopped = said('play');
const out = document.createElement('pre');
out.id = 'told';
out.textContent = JSON.stringify(told);
document.body.append(out);
</script>";

#[test]
fn the_page_of_a_film_draws_the_particle_and_follows_every_control() {
    let folder = tempfile::tempdir().unwrap();
    let output = impact(folder.path(), STEEL, &["--film", "20"]);
    assert!(output.status.success(), "{}", message(&output));
    let page = folder.path().join("o/impact_V20/film/film.html");
    let page = std::fs::read_to_string(page).unwrap();
    let Some(browser) = browser::find() else {
        return;
    };
    let visited = page
        .replace("<head>", &format!("<head>{LISTEN}"))
        .replace("</body>", &format!("{VISIT}</body>"));
    let (page, said) = browser::open(&browser, &visited, folder.path());
    let told = page
        .split_once("<pre id=\"told\">")
        .and_then(|(_, rest)| rest.split_once("</pre>"))
        .unwrap_or_else(|| panic!("the page told nothing: {said}"));
    let told: serde_json::Value = serde_json::from_str(told.0).unwrap();
    assert_eq!(told["complaints"], serde_json::json!([]), "{told}");
    let number = |step: &str, what: &str| told[step][what].as_f64().unwrap();
    // it opens on the way, where the force is largest
    let last = told["last"].as_f64().unwrap();
    assert!(
        last > 20.0 && number("peak", "at") > 0.0 && number("peak", "at") < last,
        "{told}"
    );
    assert!(
        ["peak", "first", "end"]
            .iter()
            .all(|step| number(step, "drawn") > 5000.0),
        "{told}"
    );
    assert_ne!(told["peak"]["sum"], told["first"]["sum"], "{told}");
    assert_ne!(told["end"]["sum"], told["mises"]["sum"], "{told}");
    assert_ne!(told["near"]["sum"], told["mises"]["sum"], "{told}");
    assert_eq!(told["whole"]["sum"], told["mises"]["sum"], "{told}");
    assert!(
        told["first"]["clock"].as_str().unwrap().starts_with("0 s"),
        "{told}"
    );
    let scale = told["mises"]["scale"].as_str().unwrap();
    assert!(
        scale.starts_with("von Mises stress 0 Pa") && scale.ends_with("Pa"),
        "{told}"
    );
    assert!(
        told["near"]["ruler"].as_str().unwrap().ends_with("µm"),
        "{told}"
    );
    assert_eq!([&told["play"], &told["stopped"]], ["Pause", "Play"]);
}
