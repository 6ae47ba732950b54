//! Refusals: a bad scene ends with one error that names place and remedy, exit code 2, and writes nothing.

use crate::program::{impactlaw, message};

const SCENE: &str = r#"laws = ["hertz"]
seed = 3
gravity = "9.81 m/s2"

[material]
density = "2500 kg/m3"
young_modulus = "2 MPa"
poisson_ratio = 0.3
yield_strength = "10 kPa"

[[grains]]
count = 60
radius = "1 mm"

[contact]
friction = 0.4

[box]
width = "10 mm"
depth = "10 mm"
height = "40 mm"

[[body]]
name = "thing"
ball = { radius = "2 mm" }
at = ["5 mm", "5 mm", "36 mm"]
free = { mass = "1 g" }

[[stage]]
kind = "run"
duration = "1 ms"
"#;

/// Binary STL of `triangles`.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![0u8; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0u8; 12]);
        triangle
            .iter()
            .flatten()
            .for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes.extend([0u8; 2]);
    }
    bytes
}

const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

/// Runs the scene with some of its text replaced; `mesh` is beside it as `mesh.stl`.
fn refused_beside(mesh: &[u8], replacements: &[(&str, &str)], says: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let mut text = SCENE.to_owned();
    for (from, to) in replacements {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    std::fs::write(folder.path().join("scene.toml"), text).unwrap();
    std::fs::write(folder.path().join("mesh.stl"), mesh).unwrap();
    let output = impactlaw(folder.path(), &["bed", "scene.toml"]);
    let flat = message(&output);
    assert_eq!(output.status.code(), Some(2), "{flat}");
    for say in says {
        assert!(flat.contains(say), "{say:?} is not in: {flat}");
    }
    assert!(!folder.path().join("out").exists(), "something was written");
}

fn refused(from: &str, to: &str, says: &[&str]) {
    refused_beside(&[], &[(from, to)], says);
}

const BALL: &str = "ball = { radius = \"2 mm\" }";
const MESH: &str = "mesh = \"mesh.stl\"\nscale = \"1 mm\"";

#[test]
fn the_scene_itself_runs() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let output = impactlaw(folder.path(), &["bed", "scene.toml"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let summary =
        std::fs::read_to_string(folder.path().join("out/scene/bed/hertz/summary.json")).unwrap();
    for key in [
        "grains",
        "steps",
        "wall_s",
        "particle_steps_per_s",
        "energy_closure",
        "lost_grains",
        "max_overlap_ratio",
        "status",
    ] {
        assert!(
            summary.contains(&format!("\"{key}\"")),
            "{key} is not in {summary}"
        );
    }
}

#[test]
fn grains_without_room_are_refused() {
    refused(
        "count = 60",
        "count = 6000",
        &["box.height", "larger", "pour"],
    );
    refused(
        "radius = \"1 mm\"",
        "radius = \"1 mm\"\nregion = { low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"2 mm\", \"2 mm\", \"2 mm\"] }",
        &["grains[0].region", "larger"],
    );
    refused(
        "radius = \"1 mm\"",
        "radius = \"1 mm\"\nregion = { low = [\"5 mm\", \"0 mm\", \"0 mm\"], high = [\"2 mm\", \"2 mm\", \"2 mm\"] }",
        &["grains[0].region.high", "above `low`"],
    );
    let second = "[[grains]]\nname = \"more\"\ncount = 4\nradius = \"1 mm\"\nregion = { low = [\"2 mm\", \"2 mm\", \"1 mm\"], high = [\"9 mm\", \"9 mm\", \"6 mm\"] }\n\n[contact]";
    refused(
        "[contact]",
        second,
        &["grains[1].region", "overlap", "pour"],
    );
    refused(
        "radius = \"1 mm\"",
        "radius = \"1 mm\"\ninsertion = \"stream\"",
        &["grains[0].rate", "5 g/s"],
    );
}

#[test]
fn bodies_in_the_way_of_grains_or_without_mass_are_refused() {
    refused(
        "\"36 mm\"",
        "\"2 mm\"",
        &[
            "body[0]",
            "\"thing\" reaches into the grain",
            "move the body",
        ],
    );
    refused("\"1 g\"", "\"0 g\"", &["body[0].free.mass", "positive"]);
    refused(
        "mass = \"1 g\"",
        "mass = \"1 g\", density = \"2 g/cm3\"",
        &["body[0].free", "either `mass` or `density`"],
    );
    refused(BALL, "", &["body[0]", "one shape"]);
    refused(
        "free = {",
        "driven = {}\nfree = {",
        &["body[0].free", "one body, one way to move"],
    );
    refused(
        "\"thing\"",
        "\"left\"",
        &["body[0].name", "wall of the box"],
    );
}

#[test]
fn broken_meshes_are_refused() {
    let whole = stl(&[TRIANGLE]);
    let with_mesh = [(BALL, MESH)];
    refused_beside(
        &whole,
        &with_mesh,
        &["body[0]", "closed surface", "3 edges", "close the mesh"],
    );
    refused_beside(
        &whole[..100],
        &with_mesh,
        &["body[0].mesh", "mesh.stl", "cut off", "export it again"],
    );
    refused_beside(&stl(&[]), &with_mesh, &["body[0].mesh", "no triangle"]);
    let mut nan = TRIANGLE;
    nan[1][1] = f32::NAN;
    refused_beside(
        &stl(&[nan]),
        &with_mesh,
        &["body[0].mesh", "no number", "repair"],
    );
    refused_beside(
        &whole,
        &[(BALL, "mesh = \"mesh.stl\"")],
        &["body[0].scale", "1 mm"],
    );
    refused_beside(
        &whole,
        &[(BALL, "mesh = \"no.stl\"\nscale = \"1 mm\"")],
        &["body[0].mesh", "no.stl", "can be read"],
    );
    refused_beside(
        &whole,
        &[
            (BALL, "mesh = \"mesh.stl\"\nscale = \"1 um\""),
            ("free = { mass = \"1 g\" }", ""),
        ],
        &["body[0].mesh", "smaller than the grains"],
    );
    refused_beside(
        &whole,
        &[
            (
                BALL,
                "mesh = \"mesh.stl\"\nscale = \"10 m\"\ntolerance = \"0.1 mm\"",
            ),
            ("free = { mass = \"1 g\" }", ""),
        ],
        &["body[0].mesh", "larger than the box", "`scale`"],
    );
}

#[test]
fn laws_without_data_are_refused() {
    refused(
        "[\"hertz\"]",
        "[\"fitted\"]",
        &["--law", "`[material]`", "`law`"],
    );
    refused(
        "laws = [\"hertz\"]\n",
        "",
        &["laws", "every material its own `law`"],
    );
    refused(
        "yield_strength = \"10 kPa\"",
        "law = \"johnson\"",
        &["material.law", "yield_strength"],
    );
    refused(
        "yield_strength = \"10 kPa\"",
        "law = \"no.toml\"",
        &["material.law", "no.toml", "can be read"],
    );
    refused(
        "yield_strength = \"10 kPa\"",
        "law = \"hurtz\"",
        &["material.law", "hurtz", "thornton"],
    );
    refused(
        "density = \"2500 kg/m3\"\n",
        "",
        &["material.density", "law file"],
    );
}

#[test]
fn time_steps_that_are_too_large_are_refused() {
    refused(
        "[contact]",
        "[time]\nstep = \"1 ms\"\n\n[contact]",
        &["time.step", "1 ms", "at most", "Rayleigh", "leave it out"],
    );
}

#[test]
fn stages_that_cannot_be_are_refused() {
    let stage = |to: &str, says: &[&str]| refused("duration = \"1 ms\"", to, says);
    stage("", &["stage[0].duration", "either `duration` or `steps`"]);
    stage(
        "duration = \"1 ms\"\nmove = [{ body = \"lid\", remove = true }]",
        &["stage[0].move[0].body", "must be one of thing, floor"],
    );
    stage(
        "duration = \"1 ms\"\nmove = [{ body = \"thing\", release = true }]",
        &["stage[0].move[0].release", "held = true"],
    );
    stage(
        "duration = \"1 ms\"\nmove = [{ body = \"thing\", driven = {} }]",
        &["stage[0].move[0]", "free body"],
    );
    stage(
        "duration = \"1 ms\"\ninsert = [\"shot\"]",
        &["stage[0].insert", "must be one of grains"],
    );
    stage(
        "duration = \"1 ms\"\nduratoin = \"1 ms\"",
        &["duratoin", "unknown field"],
    );
    refused(
        "seed = 3",
        "seed = 3\nperiodic = [\"w\"]",
        &["periodic[0]", "sides of the box"],
    );
    refused(
        "gravity = \"9.81 m/s2\"",
        "gravity = \"9.81\"",
        &["gravity", "acceleration"],
    );
}
