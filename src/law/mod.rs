//! Laws by name: the fitted law of a law file in one of its forms, two of them in series, or a theory, behind one visitor.

mod bodies;
pub mod file;
pub mod pair;
pub mod series;
mod table;
mod write;

pub use file::{Form, LawFile};
pub use pair::PairLaw;

use crate::contact::elastoplastic::{ClosedForm, Spline};
use crate::contact::rebound::{Rebound, State, rebound, trajectory};
use crate::contact::{LawVisitor, NormalLaw, Slowest};
use crate::material::Material;
use crate::theory::Theory;
use crate::theory::hertz::Hertz;
use crate::unit::engineering;
use crate::{Error, Result};
use series::Series;

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

/// Why a body of `radius` (m) has no force at `displacement` (m) on the way back from `most` (m), or on first loading; none where
/// it has one. Messages call the largest displacement `name_of_most`.
#[must_use]
pub fn beyond(
    radius: f64,
    displacement: f64,
    most: Option<f64>,
    name_of_most: &str,
) -> Option<String> {
    let length = |x: f64| engineering(x, "m", 4);
    if displacement >= radius {
        return Some(format!(
            "must be less than the radius, {}: a law describes a body that is flattened, not gone",
            length(radius)
        ));
    }
    let most = most.filter(|most| displacement > *most)?;
    Some(format!(
        "must be at most {name_of_most}, {}: on the way back no displacement is larger",
        length(most)
    ))
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

/// Forces at several displacements after a largest one.
struct Forces<'a> {
    radius: f64,
    most: f64,
    displacements: &'a [f64],
}

impl LawVisitor for Forces<'_> {
    type Output = Vec<f64>;

    fn visit<L: NormalLaw>(self, law: &L) -> Vec<f64> {
        let at = |&displacement: &f64| {
            let (radius, most) = (self.radius, self.most);
            ForceAt {
                radius,
                displacement,
                most,
            }
            .visit(law)
        };
        self.displacements.iter().map(at).collect()
    }
}

/// Impacts at several speeds.
struct Rebounds<'a> {
    radius: f64,
    mass: f64,
    velocities: &'a [f64],
}

impl LawVisitor for Rebounds<'_> {
    type Output = Vec<Rebound>;

    fn visit<L: NormalLaw>(self, law: &L) -> Vec<Rebound> {
        let at = |&velocity: &f64| rebound(law, self.radius, self.mass, velocity);
        self.velocities.iter().map(at).collect()
    }
}

/// One impact, instant by instant.
struct Path {
    radius: f64,
    mass: f64,
    velocity: f64,
}

impl LawVisitor for Path {
    type Output = Vec<State>;

    fn visit<L: NormalLaw>(self, law: &L) -> Vec<State> {
        trajectory(law, self.radius, self.mass, self.velocity)
    }
}

/// Largest flattening that is supported.
struct ValidTo;

impl LawVisitor for ValidTo {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        law.valid_to()
    }
}

/// Any law a comparison or a bed can be told to use.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyLaw {
    /// From a law file.
    Fitted(FittedLaw),
    /// A theory for a material.
    Theory(Theory, Material),
    /// Two flattenings in series, as a law of the sphere that stands for both bodies.
    Series(Box<Series>),
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
            AnyLaw::Series(law) => Ok(visitor.visit(&**law)),
        }
    }

    /// Forces (N) on a body of `radius` (m) at `displacements` (m), each after a largest displacement of `most` before, without
    /// inertia.
    ///
    /// # Errors
    /// As [`AnyLaw::visit`].
    pub fn forces(&self, radius: f64, most: f64, displacements: &[f64]) -> Result<Vec<f64>> {
        self.visit(Forces {
            radius,
            most,
            displacements,
        })
    }

    /// Impacts of a body of `radius` (m) and `mass` (kg) on a rigid plane at `velocities` (m/s).
    ///
    /// # Errors
    /// As [`AnyLaw::visit`].
    pub fn rebounds(&self, radius: f64, mass: f64, velocities: &[f64]) -> Result<Vec<Rebound>> {
        self.visit(Rebounds {
            radius,
            mass,
            velocities,
        })
    }

    /// Path of one of these impacts, as [`trajectory`] has it.
    ///
    /// # Errors
    /// As [`AnyLaw::visit`].
    pub fn trajectory(&self, radius: f64, mass: f64, velocity: f64) -> Result<Vec<State>> {
        self.visit(Path {
            radius,
            mass,
            velocity,
        })
    }

    /// Largest flattening $\delta/R$ that the law's source supports.
    ///
    /// # Errors
    /// As [`AnyLaw::visit`].
    pub fn valid_to(&self) -> Result<f64> {
        self.visit(ValidTo)
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
