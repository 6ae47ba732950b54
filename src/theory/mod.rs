//! Theories: published normal contact laws of a sphere on a rigid frictionless plane, one file a model.
//!
//! [`Theory`] is the one list of models; [`Theory::visit`] is the one match that turns a name into its law.

pub mod envelope;
pub mod hertz;
pub mod jackson_green;
pub mod johnson;
pub mod kogut_etsion;
pub mod luding;
pub mod spring;
pub mod thornton;
pub mod walton_braun;
pub mod wu_li_thornton;

use crate::contact::LawVisitor;
use crate::material::{Material, YIELD_PRESSURE_RATIO};
use crate::{Error, Result};
use hertz::Hertz;
use jackson_green::JacksonGreen;
use johnson::Johnson;
use kogut_etsion::KogutEtsion;
use luding::Luding;
use serde::{Deserialize, Serialize};
use thornton::Thornton;
use walton_braun::WaltonBraun;

/// Limiting pressure over yield strength of [`Theory::ThorntonHardness`]: Tabor's hardness, 2.8 Y.
const HARDNESS_RATIO: f64 = 2.8;

/// A published contact law, by the name it has in files and on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theory {
    /// [`Hertz`].
    Hertz,
    /// [`Johnson`].
    Johnson,
    /// [`Thornton`] with the pressure limited at first yield, 1.6 Y.
    Thornton,
    /// [`Thornton`] with the pressure limited at the hardness, 2.8 Y.
    ThorntonHardness,
    /// [`KogutEtsion`].
    KogutEtsion,
    /// [`JacksonGreen`].
    JacksonGreen,
    /// [`WaltonBraun::constant`].
    WaltonBraun,
    /// [`WaltonBraun::variable`].
    WaltonBraunVariable,
    /// [`Luding`].
    Luding,
}

impl Theory {
    /// Every theory, in the order of reports.
    pub const ALL: [Theory; 9] = [
        Theory::Hertz,
        Theory::Johnson,
        Theory::Thornton,
        Theory::ThorntonHardness,
        Theory::KogutEtsion,
        Theory::JacksonGreen,
        Theory::WaltonBraun,
        Theory::WaltonBraunVariable,
        Theory::Luding,
    ];

    /// Name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Theory::Hertz => "hertz",
            Theory::Johnson => "johnson",
            Theory::Thornton => "thornton",
            Theory::ThorntonHardness => "thornton-hardness",
            Theory::KogutEtsion => "kogut-etsion",
            Theory::JacksonGreen => "jackson-green",
            Theory::WaltonBraun => "walton-braun",
            Theory::WaltonBraunVariable => "walton-braun-variable",
            Theory::Luding => "luding",
        }
    }

    /// Papers, and what in the implementation is not theirs.
    #[must_use]
    pub fn reference(self) -> &'static str {
        match self {
            Theory::Hertz => "Hertz 1882; Johnson 1985, section 4.2",
            Theory::Johnson => {
                "Johnson 1985, sections 6.3 and 11.5, p = 3 Y; Hertzian until the plastic line is met (not in the book)"
            }
            Theory::Thornton => {
                "Thornton 1997, J. Appl. Mech. 64, 383, pressure limited at first yield, 1.6 Y"
            }
            Theory::ThorntonHardness => {
                "Thornton 1997, J. Appl. Mech. 64, 383, pressure limited at the hardness, 2.8 Y"
            }
            Theory::KogutEtsion => {
                "Kogut and Etsion 2002, J. Appl. Mech. 69, 657; unloading Etsion, Kligerman and Kadin 2005, Int. J. Solids Struct. 42, 3716 (unloading constants unverified)"
            }
            Theory::JacksonGreen => {
                "Jackson and Green 2005, J. Tribol. 127, 343; unloading Jackson, Green and Marghitu 2010, Nonlinear Dyn. 60, 217"
            }
            Theory::WaltonBraun => {
                "Walton and Braun 1986, J. Rheol. 30, 949, constant k2; k1 = 5 R Y (Walton 2006), k2 from Johnson's e at rho V^2/Y = 0.01"
            }
            Theory::WaltonBraunVariable => {
                "Walton and Braun 1986, J. Rheol. 30, 949, k2 growing with the force; k1 = 5 R Y (Walton 2006), k2 from Johnson's e at rho V^2/Y = 0.01"
            }
            Theory::Luding => {
                "Luding 2008, Granular Matter 10, 235, without adhesion; k1 = 5 R Y (Walton 2006), limit stiffness from Johnson's e at rho V^2/Y = 0.01"
            }
        }
    }

    /// Run `visitor` with this theory's law of `material`.
    ///
    /// # Errors
    /// [`Error::Argument`] when the theory needs a yield strength and the material has none.
    pub fn visit<V: LawVisitor>(self, material: &Material, visitor: V) -> Result<V::Output> {
        let hard = HARDNESS_RATIO;
        match self {
            Theory::Hertz => Some(visitor.visit(&Hertz::of(material))),
            Theory::Johnson => Johnson::of(material).map(|law| visitor.visit(&law)),
            Theory::Thornton => {
                Thornton::of(material, YIELD_PRESSURE_RATIO).map(|law| visitor.visit(&law))
            }
            Theory::ThorntonHardness => Thornton::of(material, hard).map(|law| visitor.visit(&law)),
            Theory::KogutEtsion => KogutEtsion::of(material).map(|law| visitor.visit(&law)),
            Theory::JacksonGreen => JacksonGreen::of(material).map(|law| visitor.visit(&law)),
            Theory::WaltonBraun => WaltonBraun::constant(material).map(|law| visitor.visit(&law)),
            Theory::WaltonBraunVariable => {
                WaltonBraun::variable(material).map(|law| visitor.visit(&law))
            }
            Theory::Luding => Luding::of(material).map(|law| visitor.visit(&law)),
        }
        .ok_or_else(|| Error::Argument {
            argument: "theory".to_owned(),
            found: self.name().to_owned(),
            allowed: "needs `material.yield_strength`; an elastic body has the law `hertz` only"
                .to_owned(),
        })
    }

    /// Coefficient of restitution at speed `velocity` (m/s) in closed form; `None` where there is none or it does
    /// not hold.
    #[must_use]
    pub fn restitution_closed_form(self, material: &Material, velocity: f64) -> Option<f64> {
        match self {
            Theory::Hertz => Some(1.0),
            Theory::Johnson => johnson::restitution(material, velocity),
            Theory::Thornton => thornton::restitution(material, YIELD_PRESSURE_RATIO, velocity),
            Theory::ThorntonHardness => thornton::restitution(material, HARDNESS_RATIO, velocity),
            Theory::KogutEtsion => None,
            Theory::JacksonGreen => jackson_green::restitution(material, velocity),
            Theory::WaltonBraun => {
                WaltonBraun::constant(material).map(|law| law.restitution(material, velocity))
            }
            Theory::WaltonBraunVariable => {
                WaltonBraun::variable(material).map(|law| law.restitution(material, velocity))
            }
            Theory::Luding => Luding::of(material)?.restitution(material, velocity),
        }
    }
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
            .ok_or_else(|| Error::Argument {
                argument: "theory".to_owned(),
                found: format!("`{text}`"),
                allowed: format!(
                    "must be one of {}",
                    Theory::ALL.map(Theory::name).join(", ")
                ),
            })
    }
}
