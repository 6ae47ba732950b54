//! A file of grains that does not go with its scene is refused: grains in walls and bodies, keys that say what the file says.

use crate::grain_lists::{read, scene_with};
use crate::scene_run::quiet;
use impactlaw::bed::run::run_scene;

#[test]
fn a_grain_in_a_wall_or_a_body_is_refused_with_the_names_of_both() {
    let ball = "[[body]]\nname = \"boulder\"\nball = { radius = \"3 mm\" }\nat = [\"10 mm\", \"10 mm\", \"10 mm\"]\n";
    for (x, body) in [
        ("0.0005", "left"),
        ("0.009", "boulder"),
        ("0.0195", "right"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let text = format!("x,y,z,radius\n{x},0.01,0.01,0.001\n");
        std::fs::write(folder.path().join("a.csv"), text).unwrap();
        let grains = "material = \"glass\"\nfile = { path = \"a.csv\" }";
        let scene = scene_with(folder.path(), grains, ball).unwrap();
        let out = tempfile::tempdir().unwrap();
        let error = run_scene(&scene, None, &quiet(out.path()))
            .err()
            .unwrap()
            .to_string();
        let said = format!("\"{body}\" reaches into the grain of \"sand\"");
        assert!(error.contains(&said), "{error}");
        assert!(std::fs::read_dir(out.path()).unwrap().next().is_none());
    }
    // as deep as grains may overlap, which a packing that rests does
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("a.csv"),
        "x,y,z,radius\n0.00095,0.01,0.01,0.001\n",
    )
    .unwrap();
    let grains = "material = \"glass\"\nfile = { path = \"a.csv\" }";
    let scene = scene_with(folder.path(), grains, "").unwrap();
    let out = tempfile::tempdir().unwrap();
    run_scene(&scene, None, &quiet(out.path())).unwrap();
}

#[test]
fn keys_that_do_not_go_with_a_file_are_refused_by_name() {
    let csv = b"x,y,z,radius\n0.005,0.006,0.007,0.001\n";
    for key in [
        "count = 3",
        "mass = \"1 g\"",
        "spread = 0.1",
        "insertion = \"pour\"",
        "rate = \"1 g/s\"",
        "region = { low = [\"0 mm\", \"0 mm\", \"0 mm\"], high = [\"1 mm\", \"1 mm\", \"1 mm\"] }",
    ] {
        let error = read("a.csv", csv, &format!("material = \"glass\"\n{key}"), "").unwrap_err();
        let name = key.split(' ').next().unwrap();
        let said = format!("`grains[0].{name}`");
        assert!(
            error.contains(&said) && error.contains("beside `file`"),
            "{error}"
        );
    }
    let error = read("a.csv", csv, "", "").unwrap_err();
    assert!(
        error.contains("`grains[0].material`") && error.contains("glass, steel"),
        "{error}"
    );
    let error = read("a.csv", csv, "material = \"glass\"", ", overlap = 0.4").unwrap_err();
    assert!(error.contains("file.overlap"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let missing = scene_with(folder.path(), "file = { path = \"none.csv\" }", "");
    let error = missing.unwrap_err().to_string();
    assert!(
        error.contains("`grains[0].file.path`") && error.contains("none.csv"),
        "{error}"
    );
}
