//! The examples for users run and hold what they assert.

#[path = "../../src/examples/export_law.rs"]
mod export_law;
#[path = "../../src/examples/law_in_code.rs"]
mod law_in_code;
#[path = "../../src/examples/own_law.rs"]
mod own_law;
#[path = "../../src/examples/small_bed.rs"]
mod small_bed;
#[path = "../../src/examples/theories.rs"]
mod theories;

#[test]
fn the_example_export_law_runs() {
    export_law::main().unwrap();
}

#[test]
fn the_example_law_in_code_runs() {
    law_in_code::main().unwrap();
}

#[test]
fn the_example_own_law_runs() {
    own_law::main().unwrap();
}

#[test]
fn the_example_small_bed_runs() {
    small_bed::main().unwrap();
}

#[test]
fn the_example_theories_runs() {
    theories::main().unwrap();
}

#[test]
fn every_example_is_run_here() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/examples");
    let here = include_str!("examples.rs");
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry
            .unwrap()
            .path()
            .file_stem()
            .unwrap()
            .to_string_lossy()
            .into_owned();
        assert!(here.contains(&format!("{name}::main()")), "{name}");
    }
}
