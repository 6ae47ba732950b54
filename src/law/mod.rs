//! Laws by name: the fitted law of a law file in one of its forms, or a theory, behind one visitor.

pub mod file;
mod table;
mod write;

pub use file::{Form, LawFile};

use crate::contact::elastoplastic::{ClosedForm, Spline};
use crate::contact::{LawVisitor, NormalLaw, Slowest};
use crate::material::Material;
use crate::theory::Theory;
use crate::theory::hertz::Hertz;
use crate::{Error, Result};

/// Name of the law that the atlas has for a material.
pub const ATLAS: &str = "atlas";

/// Law of a law file.
#[derive(Debug, Clone, PartialEq)]
pub enum FittedLaw {
    /// Nothing yielded: Hertz.
    Hertz(Hertz),
    /// Closed form.
    ClosedForm(ClosedForm),
    /// Spline.
    Spline(Spline),
}

impl FittedLaw {
    /// Run `visitor` with the concrete law.
    pub fn visit<V: LawVisitor>(&self, visitor: V) -> V::Output {
        match self {
            FittedLaw::Hertz(law) => visitor.visit(law),
            FittedLaw::ClosedForm(law) => visitor.visit(law),
            FittedLaw::Spline(law) => visitor.visit(law),
        }
    }

    /// Force (N) on a body of `radius` at `displacement` (m) after a largest displacement of `most` before, without
    /// inertia.
    #[must_use]
    pub fn force(&self, radius: f64, displacement: f64, most: f64) -> f64 {
        self.visit(ForceAt {
            radius,
            displacement,
            most,
        })
    }
}

/// Force at one displacement after a largest one.
struct ForceAt {
    radius: f64,
    displacement: f64,
    most: f64,
}

impl LawVisitor for ForceAt {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let mut history = L::History::default();
        law.force(self.most / self.radius, &mut history);
        let reduced = law.force(self.displacement / self.radius, &mut history);
        reduced * self.radius * self.radius
    }
}

/// Any law a comparison or a bed can be told to use.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyLaw {
    /// From a law file.
    Fitted(FittedLaw),
    /// A theory for a material.
    Theory(Theory, Material),
}

impl AnyLaw {
    /// Run `visitor` with the concrete law.
    ///
    /// # Errors
    /// [`Error::Refused`] when a theory needs a yield strength and the material has none.
    pub fn visit<V: LawVisitor>(&self, visitor: V) -> Result<V::Output> {
        match self {
            AnyLaw::Fitted(law) => Ok(law.visit(visitor)),
            AnyLaw::Theory(theory, material) => theory.visit(material, visitor),
        }
    }

    /// Slowest impact the law rests on, where it has one in which the body yields.
    #[must_use]
    pub fn slowest(&self) -> Option<Slowest> {
        struct Ask;
        impl LawVisitor for Ask {
            type Output = Option<Slowest>;
            fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
                law.slowest()
            }
        }
        self.visit(Ask).ok().flatten()
    }

    /// Law called `name`: `fitted` is that of `file`, [`ATLAS`] that of the atlas, any other name a theory of `material`.
    ///
    /// # Errors
    /// [`Error::Refused`] for an unknown name, `fitted` without a law file, or a material that lies outside the atlas.
    pub fn named(name: &str, file: Option<&LawFile>, material: &Material) -> Result<Self> {
        if name == ATLAS {
            return Ok(AnyLaw::Fitted(
                LawFile::of_atlas(ATLAS, material, 1.0)?.law()?,
            ));
        }
        if name != "fitted" {
            return Ok(AnyLaw::Theory(name.parse()?, *material));
        }
        let file = file.ok_or_else(|| Error::Refused {
            what: "law".to_owned(),
            found: "`fitted`".to_owned(),
            allowed: "needs a law file, e.g. `--law law.toml`".to_owned(),
        })?;
        Ok(AnyLaw::Fitted(file.law()?))
    }
}
