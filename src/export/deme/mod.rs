//! Target `deme`: a force model for DEM-Engine, as the two texts the engine compiles at run time.
//!
//! Proved through a shim only (`check/deme_shim.cpp`): the engine itself needs a CUDA device.

use crate::Result;
use crate::export::c;
use crate::export::c::{contact, kernel};
use crate::export::source::artifact::Artifact;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;

const FORCE: &str = include_str!("force.cu");

/// Force model of DEM-Engine.
#[derive(Debug, Clone, Copy)]
pub struct Deme;

impl Dialect for Deme {
    const NAME: &'static str = "deme";
    const PAIR: Option<PairExport> = None;
    const OF_PAIRS: bool = false;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        Ok(export(law))
    }
}

/// `<identifier>_deme_prerequisites.cu`, the law, and `<identifier>_deme_force.cu`, the body of the model.
#[must_use]
pub fn export(law: &Portable) -> Vec<Artifact> {
    let name = |part: &str| format!("{}_deme_{part}.cu", law.identifier);
    let prerequisites = format!(
        "{}#define {} __device__ __forceinline__\n\n{}",
        c::comment(law),
        kernel::named("LAW_FUNCTION", law),
        kernel::text(law)
    );
    let force = kernel::named(FORCE, law)
        .replace("@SHEAR@", &kernel::number(contact::shear(law)))
        .replace("@PREREQUISITES@", &name("prerequisites"))
        .replace("@FORCE@", &name("force"));
    vec![
        Artifact {
            name: name("prerequisites"),
            text: prerequisites,
        },
        Artifact {
            name: name("force"),
            text: force,
        },
    ]
}
