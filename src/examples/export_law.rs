//! A law file as the sources of another code, without writing a file.
//!
//! `cargo run --release --example export_law`

use impactlaw::document::Document;
use impactlaw::prelude::*;
use std::path::Path;

/// Runs the example.
///
/// # Errors
/// None with the law of the repository.
pub fn main() -> Result<()> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let document = Document::read(&path)?;
    let file = LawFile::parse(&document)?;
    // the form the file names, and the hash of the file for the head of what is written
    let law = Portable::new(file, None, document.hash())?;
    for target in [Target::C, Target::Liggghts, Target::Lammps] {
        let files = target.export(&law)?;
        for artifact in &files {
            println!("{:<40} {:>6} bytes", artifact.name, artifact.text.len());
        }
        assert!(
            files
                .iter()
                .any(|artifact| artifact.text.contains(&document.hash()))
        );
    }
    Ok(())
}
