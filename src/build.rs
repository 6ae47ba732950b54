//! Build: takes the laws as WebAssembly into the program, where IMPACTLAW_EXPLORER names their file; else `impactlaw explore` asks for it.

use std::path::PathBuf;

fn main() {
    println!("cargo::rerun-if-env-changed=IMPACTLAW_EXPLORER");
    let bytes = std::env::var_os("IMPACTLAW_EXPLORER").map_or_else(Vec::new, |path| {
        println!("cargo::rerun-if-changed={}", PathBuf::from(&path).display());
        std::fs::read(&path).unwrap_or_else(|why| {
            panic!(
                "IMPACTLAW_EXPLORER names {}: {why}",
                PathBuf::from(&path).display()
            )
        })
    });
    let out = std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    std::fs::write(PathBuf::from(out).join("explorer.wasm"), bytes)
        .expect("OUT_DIR can be written");
}
