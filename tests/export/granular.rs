//! The granular sub-model for builders of LAMMPS, compiled and run against a shim of its interface.

use crate::codes::{self, assert_close, laws, succeed, write};
use impactlaw::export::lammps;
use std::path::Path;
use std::process::Command;

#[test]
fn the_granular_sub_model_gives_the_impacts_of_rebound_in_both_registered_forms() {
    let Some(compiler) = impactlaw::export::check::find_program("CXX", "c++") else {
        return codes::skipped(
            "the shim of LAMMPS' granular model",
            "there is no C++ compiler",
        );
    };
    let shim = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/codes/granular_shim");
    for law in laws() {
        let scratch = tempfile::tempdir().unwrap();
        let folder = write(&lammps::export(&law), scratch.path());
        let name = &law.identifier;
        let header = folder.join(format!("gran_sub_mod_{name}.h"));
        let text = std::fs::read_to_string(&header).unwrap();
        let row = text
            .lines()
            .find(|line| line.contains("&creator<"))
            .unwrap();
        std::fs::write(folder.join("row.inc"), row.trim_start_matches(" *")).unwrap();
        let main = std::fs::read_to_string(shim.join("main.cpp")).unwrap();
        std::fs::write(folder.join("main.cpp"), main.replace("@NAME@", name)).unwrap();
        let program = folder.join("main");
        let mut build = Command::new(&compiler);
        build
            .args(["-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror", "-I"])
            .arg(&shim);
        build.arg("-I").arg(&folder).arg(folder.join("main.cpp"));
        build
            .arg(folder.join(format!("gran_sub_mod_{name}.cpp")))
            .arg("-o")
            .arg(&program);
        succeed(&mut build);
        for impact in &law.reference.impacts {
            let f = &impact.figures;
            let arguments = [
                impact.radii[0],
                impact.radii[1],
                impact.mass,
                impact.velocity,
                f.contact_time / 20_000.0,
            ];
            let mut run = Command::new(&program);
            let said = succeed(run.args(arguments.map(|number| format!("{number:e}"))));
            let found = &codes::rows(&said, 3)[0];
            assert_close(found[0], f.restitution, 1e-5, "restitution");
            assert_close(found[1], f.max_force, 1e-5, "largest force");
            assert_close(found[2], f.max_displacement, 1e-5, "largest overlap");
        }
    }
}
