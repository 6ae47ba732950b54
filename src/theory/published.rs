//! Published: what every model states in its own file, with or without a force law.

use crate::contact::NormalLaw;
use crate::material::Material;
use crate::material::constant::{Absent, Constant};
use crate::material::flow::YIELD_STRENGTH;
use crate::unit::engineering;

/// Coefficient of restitution of a material at a speed (m/s) in closed form; `None` where it does not hold.
pub type Restitution = fn(&Material, f64) -> Option<f64>;

/// Constants of a flow stress that a model takes; those it does not name play no part in it.
pub type FlowConstants = &'static [Constant];

/// A model of elastic bodies.
pub const ELASTIC: FlowConstants = &[];

/// A model of perfectly plastic bodies.
pub const YIELD_STRENGTH_ONLY: FlowConstants = &[YIELD_STRENGTH];

/// What the constants of a model rest on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// Derived anew, or seen in the paper or in sources that do not depend on each other.
    Checked,
    /// Written from memory or seen in one source that is not the paper, and confirmed by nothing but its own consistency. Such a
    /// model is had by its name, and stands in no comparison that did not ask for it.
    Unverified,
}

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
    /// What its constants rest on.
    const EVIDENCE: Evidence;
    /// Whether its source states it for two deformable bodies, with the E* of both and the strength of the softer one; else it is of
    /// one body on a rigid plane.
    const OF_PAIRS: bool;
    /// What it takes of the flow stress.
    const FLOW: FlowConstants;
    /// Restitution as the authors give it; `None` where they give none.
    const RESTITUTION: Option<Restitution>;
}

/// A published model that gives a force.
pub trait PublishedLaw: Published {
    /// Its law.
    type Law: NormalLaw;

    /// Law of a material; `None` where a constant of [`Published::FLOW`] is missing.
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
    /// [`Published::EVIDENCE`].
    pub evidence: Evidence,
    /// [`Published::OF_PAIRS`].
    pub of_pairs: bool,
    /// [`Published::FLOW`].
    pub flow: FlowConstants,
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
            evidence: P::EVIDENCE,
            of_pairs: P::OF_PAIRS,
            flow: P::FLOW,
            restitution: P::RESTITUTION,
        }
    }

    /// Whether it has no law of an elastic body.
    #[must_use]
    pub fn needs_yield(&self) -> bool {
        !self.flow.is_empty()
    }

    /// Constants with an effect in `material` that a model of yielding bodies does not know, with their values (SI).
    #[must_use]
    pub fn leaves_out(&self, material: &Material) -> Vec<(Constant, f64)> {
        let constants = material.flow.filter(|_| self.needs_yield());
        let unknown = |(constant, value): &(Constant, f64)| {
            let acts = match constant.absent {
                Absent::Other => true,
                Absent::Nothing => *value != 0.0,
                // it says how another one acts
                Absent::Usual(_) => false,
            };
            acts && !self.flow.contains(constant)
        };
        let constants = constants.map(|flow| flow.constants()).unwrap_or_default();
        constants.into_iter().filter(unknown).collect()
    }
}

/// What of the flow stress of `material` plays no part in which of `models`: a sentence for each constant.
///
/// ```
/// use impactlaw::material::{Flow, Material};
/// use impactlaw::theory::{Theory, published::left_out};
/// let flow = Some(Flow::perfectly_plastic(1e9));
/// let steel = Material { density: 7800.0, young_modulus: 2e11, poisson_ratio: 0.3, flow };
/// assert!(left_out(Theory::ALL.map(Theory::publication), &steel).is_empty());
/// ```
#[must_use]
pub fn left_out(models: impl IntoIterator<Item = Publication>, material: &Material) -> Vec<String> {
    let mut left: Vec<(Constant, f64, Vec<&str>)> = Vec::new();
    for model in models {
        for (constant, value) in model.leaves_out(material) {
            match left.iter_mut().find(|(known, ..)| *known == constant) {
                Some((.., names)) => names.push(model.name),
                None => left.push((constant, value, vec![model.name])),
            }
        }
    }
    let sentence = |(constant, value, names): (Constant, f64, Vec<&str>)| {
        let value = engineering(value, constant.dimension.unit(), 4);
        let (name, names) = (constant.name(), names.join(", "));
        format!(
            "The {name} ({value}) of this material plays no part in {names}: they were made for bodies without it."
        )
    };
    left.into_iter().map(sentence).collect()
}
