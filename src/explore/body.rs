//! Body: the sphere of a question, its quantities as the texts that a case file has, or the material of a law file.

use crate::atlas::Atlas;
use crate::case::{Case, slips};
use crate::document::Document;
use crate::law::{AnyLaw, FittedLaw, LawFile};
use crate::material::flow::LinearHardening;
use crate::material::{Flow, Material};
use crate::unit::{Density, Length, Pressure, Velocity, argument};
use crate::{Error, Result};
use serde::Deserialize;
use std::path::Path;
use std::sync::OnceLock;

/// Tolerance of the case that checks a sphere's constants; nothing is run with it.
const TOLERANCE: f64 = 0.02;

/// A sphere as texts: quantities with their units.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    young: String,
    poisson: String,
    density: String,
    /// Empty for an elastic body.
    strength: String,
    /// Empty for a perfectly plastic body.
    hardening: String,
    radius: String,
    velocity: String,
    /// A law file, whose material stands for the constants above.
    law: Option<Opened>,
}

/// A law file that was opened.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Opened {
    name: String,
    text: String,
}

/// A sphere in SI units, checked as that of a case file.
#[derive(Debug)]
pub(super) struct Sphere {
    pub material: Material,
    pub radius: f64,
    pub mass: f64,
    pub velocity: f64,
    /// What looks like a slip of its unit.
    pub slips: Vec<String>,
    /// The law file, and its text.
    opened: Option<(LawFile, Document)>,
}

impl Body {
    /// The sphere that the texts tell.
    ///
    /// # Errors
    /// [`Error::Refused`] for what is no such quantity or what no case may have; those of [`LawFile::parse`].
    pub fn sphere(&self) -> Result<Sphere> {
        let opened = match &self.law {
            Some(Opened { name, text }) => {
                let document = Document::new(Path::new(name), text.as_str());
                Some((LawFile::parse(&document)?, document))
            }
            None => None,
        };
        let material = match &opened {
            Some((file, _)) => file.material(),
            None => self.material()?,
        };
        let radius = argument::<Length>("radius", &self.radius)?;
        let velocity = argument::<Velocity>("speed", &self.velocity)?;
        let case = Case::of("explorer", radius, material, &[velocity], TOLERANCE)?;
        let slips = slips::reasons(&case, &case.velocities);
        Ok(Sphere {
            material,
            radius,
            mass: material.sphere_mass(radius),
            velocity,
            slips: slips
                .into_iter()
                .map(|(key, _, why)| format!("check the unit of {key}: {why}"))
                .collect(),
            opened,
        })
    }

    fn material(&self) -> Result<Material> {
        let poisson = self.poisson.trim();
        let flow = match self.strength.trim() {
            "" => None,
            text => Some(self.flow(argument::<Pressure>("yield strength", text)?)?),
        };
        Ok(Material {
            density: argument::<Density>("density", &self.density)?,
            young_modulus: argument::<Pressure>("Young's modulus", &self.young)?,
            poisson_ratio: poisson.parse().map_err(|_| Error::Refused {
                what: "Poisson's ratio".to_owned(),
                found: format!("\"{poisson}\""),
                allowed: "must be a number in [0, 0.5)".to_owned(),
            })?,
            flow,
        })
    }

    fn flow(&self, strength: f64) -> Result<Flow> {
        let modulus = match self.hardening.trim() {
            "" | "0" => 0.0,
            text => argument::<Pressure>("hardening modulus", text)?,
        };
        Ok(match modulus == 0.0 {
            true => Flow::perfectly_plastic(strength),
            false => LinearHardening { strength, modulus }.into(),
        })
    }
}

impl Sphere {
    /// Law of the file that was opened, else that of the atlas.
    ///
    /// # Errors
    /// Those of [`LawFile::law`] and [`Atlas::law`].
    pub fn law(&self) -> Result<AnyLaw> {
        Ok(AnyLaw::Fitted(match &self.opened {
            Some((file, _)) => file.law()?,
            None => FittedLaw::Spline(atlas()?.law(&self.material)?),
        }))
    }

    /// Slowest and fastest impact that this law rests on, m/s.
    ///
    /// # Errors
    /// Those of [`Atlas::built_in`].
    pub fn speeds(&self) -> Result<[f64; 2]> {
        Ok(match &self.opened {
            Some((file, _)) => [file.valid.velocity_min_m_s, file.valid.velocity_max_m_s],
            None => atlas()?.velocities(&self.material),
        })
    }

    /// What a user of this law has to know.
    ///
    /// # Errors
    /// Those of [`Atlas::built_in`].
    pub fn to_know(&self) -> Result<Vec<String>> {
        Ok(match &self.opened {
            Some((file, _)) => file.warnings.clone(),
            None => vec![atlas()?.provenance(&self.material)],
        })
    }

    /// The law as a file, with its text as it is kept; one of the atlas is called `name`.
    ///
    /// # Errors
    /// Those of [`LawFile::of_atlas`] and [`LawFile::text`].
    pub fn file(&self, name: &str) -> Result<(LawFile, Document)> {
        if let Some(opened) = &self.opened {
            return Ok(opened.clone());
        }
        let file = LawFile::of_atlas(name, &self.material, self.radius)?;
        let document = Document::new(Path::new(name), file.text()?);
        Ok((file, document))
    }
}

/// The atlas of the program, read once.
fn atlas() -> Result<&'static Atlas> {
    static KEPT: OnceLock<Atlas> = OnceLock::new();
    if let Some(atlas) = KEPT.get() {
        return Ok(atlas);
    }
    let atlas = Atlas::built_in()?;
    Ok(KEPT.get_or_init(|| atlas))
}
