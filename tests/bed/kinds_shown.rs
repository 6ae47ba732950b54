//! Material and group of each grain stand in VTP, in the dump and on the page, with their names in the summary.

use crate::browser;
use crate::page::visit;
use crate::scene_run::run;
use impactlaw::bed::scene::Scene;
use std::path::Path;
use vtkio::model::{Attribute, DataSet, Piece, Vtk};

const SCENE: &str = r#"
seed = 1
gravity = "9.81 m/s2"
[materials.glass]
density = "2500 kg/m3"
young_modulus = "10 MPa"
poisson_ratio = 0.25
law = "hertz"
[materials."heavy steel"]
density = "7800 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.3
law = "hertz"
[[grains]]
name = "beads"
material = "glass"
count = 20
radius = "1 mm"
region = { low = ["0 mm", "0 mm", "1 mm"], high = ["12 mm", "12 mm", "8 mm"] }
[[grains]]
name = "balls"
material = "heavy steel"
count = 9
radius = "1.5 mm"
region = { low = ["0 mm", "0 mm", "9 mm"], high = ["12 mm", "12 mm", "20 mm"] }
[[grains]]
name = "more beads"
material = "glass"
count = 15
radius = "1 mm"
insertion = "stream"
rate = "5 g/s"
region = { low = ["0 mm", "0 mm", "21 mm"], high = ["12 mm", "12 mm", "29 mm"] }
[box]
width = "12 mm"
depth = "12 mm"
height = "36 mm"
[[stage]]
kind = "run"
duration = "40 ms"
[output]
rows = 10
frames = 5
film = 10
dump = true
"#;

#[test]
fn material_and_group_stand_in_every_file_that_lists_grains() {
    let scene = Scene::parse(SCENE, Path::new("kinds.toml")).unwrap();
    let (report, folder) = run(&scene);
    let inside = folder.path().join("bed/hertz");
    let summary = &report.laws[0].summary;
    assert_eq!(summary.materials, ["glass", "heavy steel"]);
    assert_eq!(summary.groups, ["beads", "balls", "more beads"]);
    assert!(summary.grains > 30, "{}", summary.grains);
    let frames = std::fs::read_dir(inside.join("vtp")).unwrap();
    let last = frames
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().contains("grains_"))
        .max()
        .unwrap();
    let vtk = Vtk::parse_xml(&std::fs::read(last).unwrap()[..]).unwrap();
    let DataSet::PolyData { pieces, .. } = vtk.data else {
        panic!()
    };
    let Piece::Inline(piece) = &pieces[0] else {
        panic!()
    };
    let column = |name: &str| -> Vec<f64> {
        let array = piece
            .data
            .point
            .iter()
            .find_map(|attribute| match attribute {
                Attribute::DataArray(array) if array.name == name => Some(array),
                _ => None,
            });
        array.unwrap().data.clone().cast_into().unwrap()
    };
    let (radii, materials, groups) = (column("radius_m"), column("material"), column("group"));
    let mut seen = [0; 3];
    for ((radius, material), group) in radii.iter().zip(&materials).zip(&groups) {
        seen[*group as usize] += 1;
        let right = if *group == 1.0 {
            [1.5e-3, 1.0]
        } else {
            [1e-3, 0.0]
        };
        assert_eq!([*radius, *material], right);
    }
    assert_eq!(seen[..2], [20, 9]);
    assert!(seen[2] > 0);
    let dump = std::fs::read_to_string(inside.join("dump.lammpstrj")).unwrap();
    let frame = dump.rsplit("ITEM: ATOMS ").next().unwrap();
    let names: Vec<&str> = frame.lines().next().unwrap().split(' ').collect();
    let at = |name: &str| names.iter().position(|n| *n == name).unwrap();
    let mut seen = [0; 3];
    for line in frame.lines().skip(1) {
        let words: Vec<&str> = line.split(' ').collect();
        let group: usize = words[at("group")].parse().unwrap();
        seen[group - 1] += 1;
        assert_eq!(words[at("type")], if group == 2 { "2" } else { "1" });
        assert_eq!(
            words[at("radius")],
            if group == 2 { "1.5e-3" } else { "1e-3" }
        );
    }
    assert_eq!(seen[..2], [20, 9]);
}

#[test]
fn the_page_colours_by_material_and_group() {
    let scene = Scene::parse(SCENE, Path::new("kinds.toml")).unwrap();
    let (_, folder) = run(&scene);
    let page = std::fs::read_to_string(folder.path().join("bed/hertz/bed.html")).unwrap();
    assert!(page.contains("\"names\":[\"glass\",\"heavy steel\"]"));
    assert!(page.contains("\"names\":[\"beads\",\"balls\",\"more beads\"]"));
    let Some(browser) = browser::find() else {
        return;
    };
    // the visitor looks at what is called plastic: let that be the materials, then the groups
    let mut sums = Vec::new();
    for kind in ["plastic", "material", "group"] {
        let listener = "<script>addEventListener('change', (event) => { if (event.target.id === 'colour') window.shown = \
            document.getElementById('ticks').textContent; });</script></body>";
        let script = page.replace("</body>", listener);
        let told = visit_with(&browser, &script, kind);
        assert_eq!(told["complaints"], serde_json::json!([]), "{told}");
        sums.push(told["plastic"]["sum"].as_u64().unwrap());
    }
    assert!(
        sums[0] != sums[1] && sums[1] != sums[2] && sums[0] != sums[2],
        "{sums:?}"
    );
}

/// A visit in which the colours chosen are those of `kind`.
fn visit_with(browser: &Path, page: &str, kind: &str) -> serde_json::Value {
    // the value that the visitor chooses is set in the page's own list of colours
    let page = page.replace(
        "</body>",
        &format!(
            "<script>{{ const own = document.getElementById('colour'); own.addEventListener('change', (event) => {{ if (own.value === 'plastic') own.value = '{kind}'; }}, true); }}</script></body>"
        ),
    );
    visit(browser, &page)
}
