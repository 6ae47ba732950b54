//! `export` of a case: input decks of a finite-element code.

use super::{Context, Verdict, output_folder};
use crate::Result;
use crate::case::pair::Asked;
use crate::export::deck::{self, Code, Wanted};
use crate::files::write_atomic;
use std::fmt::Write;
use std::path::Path;

/// Writes the decks.
///
/// # Errors
/// Those of the case file, of a case that cannot be expressed, and of writing.
pub(super) fn run(
    file: &Path,
    code: Code,
    wanted: Wanted,
    out: Option<&Path>,
    context: &Context,
) -> Result<Verdict> {
    let asked = Asked::read(file)?;
    let case = asked.particle();
    let provenance = format!("{} (case sha256 {})", crate::PROGRAM, case.hash);
    let files = match &asked {
        Asked::RigidWall(case) => deck::export(case, code, wanted, &provenance)?,
        Asked::Pair(pair) => deck::export_pair(pair, code, wanted, &provenance)?,
    };
    let folder = output_folder(out, &case.name)?;
    let folder = match out {
        Some(_) => folder.to_path_buf(),
        None => folder.join("export"),
    };
    let mut said = String::new();
    for file in &files {
        let path = folder.join(&file.name);
        write_atomic(&path, file.text.as_bytes())?;
        let _ = writeln!(said, "{}", path.display());
    }
    let _ = writeln!(said, "in that folder, for each NAME.inp: {}", code.run());
    context.say(&said)?;
    Ok(Verdict::Met)
}
