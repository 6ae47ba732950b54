//! Published: what every model states in its own file, with or without a force law.

use crate::contact::NormalLaw;
use crate::material::Material;

/// Coefficient of restitution of a material at a speed (m/s) in closed form; `None` where it does not hold.
pub type Restitution = fn(&Material, f64) -> Option<f64>;

/// A published model, as its file states it.
pub trait Published {
    /// Name in files and on the command line.
    const NAME: &'static str;
    /// Loading and unloading in a few words; stands in the table of the README.
    const SUMMARY: &'static str;
    /// Keys of its papers in `references.bib`.
    const PAPERS: &'static [&'static str];
    /// Papers, and what in the implementation is not theirs.
    const REFERENCE: &'static str;
    /// Restitution as the authors give it; `None` where they give none.
    const RESTITUTION: Option<Restitution>;
}

/// A published model that gives a force.
pub trait PublishedLaw: Published {
    /// Its law.
    type Law: NormalLaw;
    /// Whether it has no law of an elastic body.
    const NEEDS_YIELD: bool;

    /// Law of a material; `None` where a yield strength is needed and there is none.
    fn law(material: &Material) -> Option<Self::Law>;
}

/// What [`Published`] states, as a value.
#[derive(Debug, Clone, Copy)]
pub struct Publication {
    /// [`Published::NAME`].
    pub name: &'static str,
    /// [`Published::SUMMARY`].
    pub summary: &'static str,
    /// [`Published::PAPERS`].
    pub papers: &'static [&'static str],
    /// [`Published::REFERENCE`].
    pub reference: &'static str,
    /// [`Published::RESTITUTION`].
    pub restitution: Option<Restitution>,
}

impl Publication {
    /// What `P` states.
    #[must_use]
    pub const fn of<P: Published>() -> Self {
        Self {
            name: P::NAME,
            summary: P::SUMMARY,
            papers: P::PAPERS,
            reference: P::REFERENCE,
            restitution: P::RESTITUTION,
        }
    }
}
