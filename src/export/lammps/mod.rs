//! Target `lammps`: a pair style and a fix for walls as a plugin of a released LAMMPS, and a granular sub-model for those
//! who build it.

use crate::Result;
use crate::export::c::contact::{filled, headers};
use crate::export::source::artifact::Artifact;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;

const STYLE: &str = include_str!("style.h");
const HISTORY: &str = include_str!("history.cpp");
const PAIR: &str = include_str!("pair.cpp");
const WALL: &str = include_str!("wall.cpp");
const PLUGIN: &str = include_str!("plugin.cpp");
const SUB_MODEL_HEADER: &str = include_str!("gran_sub_mod.h");
const SUB_MODEL: &str = include_str!("gran_sub_mod.cpp");
const BUILD: &str = include_str!("build.sh");
const IMPACT: &str = include_str!("impact.in");

/// Plugin and sub-model for LAMMPS.
#[derive(Debug, Clone, Copy)]
pub struct Lammps;

impl Dialect for Lammps {
    const NAME: &'static str = "lammps";
    const PAIR: Option<PairExport> = None;
    const OF_PAIRS: bool = false;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        Ok(export(law))
    }
}

/// The files, in a folder `lammps`.
#[must_use]
pub fn export(law: &Portable) -> Vec<Artifact> {
    let name = &law.identifier;
    let mut files = headers(law, "lammps");
    files.extend(
        [
            (format!("{name}_lammps.h"), STYLE),
            (format!("{name}_history.cpp"), HISTORY),
            (format!("{name}_pair.cpp"), PAIR),
            (format!("{name}_wall.cpp"), WALL),
            (format!("{name}_plugin.cpp"), PLUGIN),
            (format!("gran_sub_mod_{name}.h"), SUB_MODEL_HEADER),
            (format!("gran_sub_mod_{name}.cpp"), SUB_MODEL),
            ("build.sh".to_owned(), BUILD),
            ("impact.in".to_owned(), IMPACT),
        ]
        .map(|(file, template)| Artifact {
            name: format!("lammps/{file}"),
            text: filled(template, law),
        }),
    );
    files
}
