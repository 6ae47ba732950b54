//! A fine grain that lands in the valley between two large cylinders runs down it and drops, at the default time step.

use crate::scene_run::run;
use impactlaw::bed::scene::Scene;
use std::path::Path;

/// Height (mm) of a grain of `radius` (mm) 0.4 s after it was laid upon the neck of two bodies, above a ground at
/// -10 mm.
fn height(radius: f64, bodies: &str) -> f64 {
    // above the neck at x = 5 mm, a little to the side, in a region of one place
    let centre = [
        5.0,
        0.4 * radius,
        ((5.0 + radius).powi(2) - 25.0f64).sqrt() + 0.1 * radius,
    ];
    let side = 1.15 * radius;
    let corner = |sign: f64| {
        centre
            .map(|x| format!("\"{} mm\"", x + sign * side))
            .join(", ")
    };
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n[material]\ndensity = \"2500 kg/m3\"\nyoung_modulus = \"500 MPa\"\npoisson_ratio = 0.3\nlaw = \"hertz\"\n\
         [[grains]]\ncount = 1\nradius = \"{radius} mm\"\nregion = {{ low = [{}], high = [{}] }}\n[contact]\nfriction = 0.5\nrestitution = 0.5\n\
         [domain]\nlow = [\"-50 mm\", \"-50 mm\", \"-40 mm\"]\nhigh = [\"50 mm\", \"50 mm\", \"60 mm\"]\n{bodies}\
         [[body]]\nname = \"ground\"\nplane = {{ normal = [0.0, 0.0, 1.0] }}\nat = [\"0 mm\", \"0 mm\", \"-10 mm\"]\n\
         [[stage]]\nkind = \"run\"\nduration = \"0.4 s\"\n[output]\nrows = 20\nframes = 0\nfilm = 0\n",
        corner(-1.0),
        corner(1.0)
    );
    let scene = Scene::parse(&text, Path::new("fine.toml")).unwrap_or_else(|e| panic!("{e}"));
    let (report, _folder) = run(&scene);
    let run = &report.laws[0];
    assert!(
        run.summary.energy_closure < 0.01,
        "{}",
        run.summary.energy_closure
    );
    1e3 * run.grains.spheres[0].centre.z
}

/// Two cylinders across: a neck that is a valley along y, open at its ends.
const CYLINDERS: &str = "[[body]]\nname = \"a\"\ncylinder = { radius = \"5 mm\", length = \"1 mm\", axis = [0.0, 1.0, 0.0] }\nturn = { axis = [1.0, 0.0, 0.0], angle = \"20 deg\" }\n\
    [[body]]\nname = \"b\"\ncylinder = { radius = \"5 mm\", length = \"1 mm\", axis = [0.0, 1.0, 0.0] }\nturn = { axis = [1.0, 0.0, 0.0], angle = \"20 deg\" }\nat = [\"10 mm\", \"0 mm\", \"0 mm\"]\n";

#[test]
fn a_fine_grain_runs_down_the_valley_between_two_tilted_cylinders() {
    for ratio in [12.5, 20.0] {
        let radius = 5.0 / ratio;
        let z = height(radius, CYLINDERS);
        assert!(z < -10.0 + 1.1 * radius, "ratio {ratio}: at {z} mm");
    }
}
