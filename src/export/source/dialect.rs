//! Dialect: what a target states in its own file, the form its code wants a law in.

use super::portable::Portable;
use crate::Result;
use crate::export::source::artifact::Artifact;

/// Files of the contact of two materials.
pub type PairExport = fn(&Portable, &Portable) -> Result<Vec<Artifact>>;

/// A form that a law can be written in.
pub trait Dialect {
    /// Name on the command line.
    const NAME: &'static str;
    /// Files of the contact of two materials; `None` where the form holds one law.
    const PAIR: Option<PairExport>;

    /// Whether the form holds the law of a pair of bodies too, with its effective radius; else it is refused by name.
    const OF_PAIRS: bool;

    /// The files of a law.
    ///
    /// # Errors
    /// [`crate::Error::Refused`] when the form cannot express the law.
    fn export(law: &Portable) -> Result<Vec<Artifact>>;
}
