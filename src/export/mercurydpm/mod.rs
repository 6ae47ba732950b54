//! Target `mercurydpm`: species and interaction for the kernel of MercuryDPM.
//!
//! Proved through a shim only (`check/mercury_shim.cpp`): the code is not in a package registry.

use crate::Result;
use crate::export::c;
use crate::export::c::{contact, kernel};
use crate::export::source::artifact::Artifact;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;

const INTERACTION: &str = include_str!("interaction.h");
const SPECIES: &str = include_str!("species.h");

/// Species and interaction of MercuryDPM.
#[derive(Debug, Clone, Copy)]
pub struct MercuryDpm;

impl Dialect for MercuryDpm {
    const NAME: &'static str = "mercurydpm";
    const PAIR: Option<PairExport> = None;
    const OF_PAIRS: bool = false;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        Ok(export(law))
    }
}

/// The law's header, the interaction and the species, in the folders of MercuryDPM where they belong.
#[must_use]
pub fn export(law: &Portable) -> Vec<Artifact> {
    let header = format!("{}.h", law.identifier);
    let class = contact::class(&law.identifier);
    let filled = |template: &str| named(template, law).replace("@FILE@", &header);
    let interactions = "mercurydpm/Kernel/Interactions/NormalForceInteractions";
    let species = "mercurydpm/Kernel/Species/NormalForceSpecies";
    vec![
        Artifact {
            name: format!("{interactions}/{header}"),
            text: c::header(law),
        },
        Artifact {
            name: format!("{interactions}/{class}Interaction.h"),
            text: filled(INTERACTION),
        },
        Artifact {
            name: format!("{species}/{class}NormalSpecies.h"),
            text: filled(SPECIES),
        },
    ]
}

/// `template` with the names of the law's functions and classes.
#[must_use]
pub fn named(template: &str, law: &Portable) -> String {
    kernel::named(template, law).replace("@CLASS@", &contact::class(&law.identifier))
}
