//! Theories: published models of a sphere on a rigid frictionless plane, one file a model.
//!
//! A model states itself in its own file: [`published::Published`], and [`PublishedLaw`] if it gives a force. The list at the end of
//! this file makes everything else of it: [`Theory`] with its names, its order and the one match from a name to a law, and
//! [`FORMULAS`]. A new theory is a new file, its `mod` line and one line of that list.

pub mod adhesive;
pub mod envelope;
pub mod ghaednia;
pub mod hertz;
pub mod jackson_green;
pub mod johnson;
pub mod kogut_etsion;
pub mod luding;
pub mod mdr;
pub mod published;
pub mod spring;
pub mod stronge;
pub mod thornton;
pub mod walton_braun;
pub mod wu_li_thornton;

use crate::contact::LawVisitor;
use crate::material::Material;
use crate::{Error, Result};
use published::{Evidence, Publication, PublishedLaw};
use serde::{Deserialize, Serialize};

/// Makes [`Theory`] and [`FORMULAS`] from the list of models.
macro_rules! theories {
    (laws { $($theory:ident => $law:ty,)+ } formulas { $($formula:ty,)* }) => {
        /// A published contact law, by the name it has in files and on the command line.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[serde(into = "&'static str", try_from = "String")]
        pub enum Theory {
            $(
                #[doc = concat!("[`", stringify!($law), "`].")]
                $theory,
            )+
        }

        impl Theory {
            /// Every theory, in the order of reports.
            pub const ALL: [Theory; [$(Theory::$theory),+].len()] = [$(Theory::$theory),+];

            /// What its file states.
            #[must_use]
            pub fn publication(self) -> Publication {
                match self {
                    $(Theory::$theory => Publication::of::<$law>(),)+
                }
            }

            /// Run `visitor` with this theory's law of `material`; `None` where there is none.
            fn visit_law<V: LawVisitor>(self, material: &Material, visitor: V) -> Option<V::Output> {
                match self {
                    $(Theory::$theory => <$law>::law(material).map(|law| visitor.visit(&law)),)+
                }
            }
        }

        /// Published models that give a restitution and no force.
        pub const FORMULAS: [Publication; [$(stringify!($formula)),*].len()] =
            [$(Publication::of::<$formula>()),*];
    };
}

impl Theory {
    /// Name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.publication().name
    }

    /// Papers, and what in the implementation is not theirs.
    #[must_use]
    pub fn reference(self) -> &'static str {
        self.publication().reference
    }

    /// Whether it has no law of an elastic body.
    #[must_use]
    pub fn needs_yield(self) -> bool {
        self.publication().needs_yield()
    }

    /// Place in [`Theory::ALL`].
    #[must_use]
    pub fn place(self) -> usize {
        self as usize
    }

    /// Whether it has a law of `material`.
    #[must_use]
    pub fn applies_to(self, material: &Material) -> bool {
        material.flow.is_some() || !self.needs_yield()
    }

    /// The theories that have a law of `material`, in the order of [`Theory::ALL`].
    pub fn of(material: &Material) -> impl Iterator<Item = Theory> {
        let material = *material;
        Theory::ALL
            .into_iter()
            .filter(move |theory| theory.applies_to(&material))
    }

    /// What its constants rest on.
    #[must_use]
    pub fn evidence(self) -> Evidence {
        self.publication().evidence
    }

    /// Whether its source states it for two deformable bodies.
    #[must_use]
    pub fn is_of_pairs(self) -> bool {
        self.publication().of_pairs
    }

    /// The theories that comparisons of `material` show unasked: all that have a law of it and are not unverified.
    pub fn compared(material: &Material) -> impl Iterator<Item = Theory> {
        Theory::of(material).filter(|theory| theory.evidence() == Evidence::Checked)
    }

    /// Names of the theories an elastic body has, each between two `quote`s.
    #[must_use]
    pub fn elastic(quote: char) -> String {
        let elastic = Theory::ALL
            .into_iter()
            .filter(|theory| !theory.needs_yield());
        let names: Vec<_> = elastic
            .map(|theory| format!("{quote}{theory}{quote}"))
            .collect();
        names.join(", ")
    }

    /// Run `visitor` with this theory's law of `material`.
    ///
    /// # Errors
    /// [`Error::Refused`] when the theory needs a yield strength and the material has none.
    pub fn visit<V: LawVisitor>(self, material: &Material, visitor: V) -> Result<V::Output> {
        self.visit_law(material, visitor)
            .ok_or_else(|| Error::Refused {
                what: "theory".to_owned(),
                found: self.name().to_owned(),
                allowed: format!(
                    "needs `material.yield_strength`; an elastic body has the law {} only",
                    Theory::elastic('`')
                ),
            })
    }

    /// Coefficient of restitution at speed `velocity` (m/s) in closed form; `None` where there is none or it does
    /// not hold.
    #[must_use]
    pub fn restitution_closed_form(self, material: &Material, velocity: f64) -> Option<f64> {
        self.publication().restitution?(material, velocity)
    }
}

/// The models whose authors give a formula for the restitution of a yielding body, theories first.
pub fn formulas() -> impl Iterator<Item = Publication> {
    let yielding = Theory::ALL
        .into_iter()
        .filter(|theory| theory.needs_yield());
    yielding
        .map(Theory::publication)
        .chain(FORMULAS)
        .filter(|model| model.restitution.is_some())
}

impl std::fmt::Display for Theory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Theory {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        Theory::ALL
            .into_iter()
            .find(|theory| theory.name() == text)
            .ok_or_else(|| Error::not_one_of("theory", text, Theory::ALL.map(Theory::name)))
    }
}

impl From<Theory> for &'static str {
    fn from(theory: Theory) -> Self {
        theory.name()
    }
}

impl TryFrom<String> for Theory {
    type Error = Error;

    fn try_from(text: String) -> Result<Self> {
        text.parse()
    }
}

theories! {
    laws {
        Hertz => hertz::Hertz,
        Johnson => johnson::Johnson,
        Thornton => thornton::AtFirstYield,
        ThorntonHardness => thornton::AtHardness,
        KogutEtsion => kogut_etsion::KogutEtsion,
        JacksonGreen => jackson_green::JacksonGreen,
        Mdr => mdr::Mdr,
        WaltonBraun => walton_braun::Constant,
        WaltonBraunVariable => walton_braun::Variable,
        Luding => luding::Luding,
        Ghaednia => ghaednia::Ghaednia,
        Stronge => stronge::Stronge,
        KogutEtsionHertzian => kogut_etsion::HertzianUnloading,
    }
    formulas {
        wu_li_thornton::WuLiThornton,
    }
}
