//! Pair: a case whose wall is a deformable body, a type of its own so that nothing takes it for one of a rigid wall.

use super::{Case, slips};
use crate::document::Document;
use crate::material::{Effective, Material};
use crate::shape::Shape;
use crate::{Error, Result};
use std::path::Path;

/// Shape of the second body, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TargetShape {
    /// A sphere, free to move.
    Sphere {
        /// Its radius, m.
        radius: f64,
    },
    /// A plate, held at its back and wide enough that its rim is not felt.
    Plate {
        /// Its thickness, m.
        thickness: f64,
    },
    /// So deep and wide that no wave comes back.
    HalfSpace,
}

impl TargetShape {
    /// Name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            TargetShape::Sphere { .. } => "sphere",
            TargetShape::Plate { .. } => "plate",
            TargetShape::HalfSpace => "half-space",
        }
    }

    /// Radius of a sphere, m; none of what is flat.
    #[must_use]
    pub const fn radius(self) -> Option<f64> {
        match self {
            TargetShape::Sphere { radius } => Some(radius),
            TargetShape::Plate { .. } | TargetShape::HalfSpace => None,
        }
    }

    /// Thickness of a plate, m; none of others.
    #[must_use]
    pub const fn thickness(self) -> Option<f64> {
        match self {
            TargetShape::Plate { thickness } => Some(thickness),
            TargetShape::Sphere { .. } | TargetShape::HalfSpace => None,
        }
    }
}

/// The second body, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Its shape.
    pub shape: TargetShape,
    /// Its material.
    pub material: Material,
}

/// A checked case of two deformable bodies, SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct PairCase {
    /// The particle and its speeds; the impact is normal and frictionless.
    pub particle: Case,
    /// What it meets.
    pub target: Target,
}

/// What a case file asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum Asked {
    /// A particle on a rigid wall.
    RigidWall(Case),
    /// A particle on a deformable body.
    Pair(PairCase),
}

impl Asked {
    /// Read and check a case file.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be read; otherwise as [`Asked::from_document`].
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_document(&Document::read(path)?)
    }

    /// Check a case file that has been read already.
    ///
    /// # Errors
    /// As [`Case::parse`], and [`Error::Value`] for what is not done for two bodies.
    pub fn from_document(document: &Document) -> Result<Self> {
        let (case, target, unusual) = Case::with_wall(document)?;
        let Some(target) = target else {
            return Ok(Asked::RigidWall(case));
        };
        let pair = PairCase {
            particle: case,
            target,
        };
        pair.check(document)?;
        slips::check_target(&pair.target_as_particle(), document, &unusual)?;
        Ok(Asked::Pair(pair))
    }

    /// The particle, its speeds, and where it was asked.
    #[must_use]
    pub fn particle(&self) -> &Case {
        match self {
            Asked::RigidWall(case) => case,
            Asked::Pair(pair) => &pair.particle,
        }
    }

    /// The two bodies, where there are two.
    #[must_use]
    pub fn pair(&self) -> Option<&PairCase> {
        match self {
            Asked::RigidWall(_) => None,
            Asked::Pair(pair) => Some(pair),
        }
    }

    /// Either with the speeds of `--velocity`, when any are given.
    ///
    /// # Errors
    /// As [`Case::with_velocities`].
    pub fn with_velocities(self, texts: &[String]) -> Result<Self> {
        Ok(match self {
            Asked::RigidWall(case) => Asked::RigidWall(case.with_velocities(texts)?),
            Asked::Pair(PairCase { particle, target }) => Asked::Pair(PairCase {
                particle: particle.with_velocities(texts)?,
                target,
            }),
        })
    }
}

impl PairCase {
    /// The case of the sphere that meets a rigid wall as the two bodies meet each other ([`Effective`]), at the same speeds.
    #[must_use]
    pub fn effective(&self) -> Case {
        let Effective { radius, material } = Effective::of(
            &self.particle.material,
            self.particle.radius,
            &self.target.material,
            self.target.shape.radius(),
        );
        Case {
            radius,
            material,
            ..self.particle.clone()
        }
    }

    /// The second body as if it were the particle.
    fn target_as_particle(&self) -> Case {
        Case {
            radius: match self.target.shape {
                TargetShape::Sphere { radius } => radius,
                TargetShape::Plate { .. } | TargetShape::HalfSpace => self.particle.radius,
            },
            material: self.target.material,
            ..self.particle.clone()
        }
    }

    /// That nothing is asked of two bodies that is done on a rigid wall alone.
    fn check(&self, document: &Document) -> Result<()> {
        let rejected = |key, why: &str| {
            let allowed = format!("{why} beside `wall.material`");
            Err(document.reject(key, allowed))
        };
        // whoever adds to a case says here whether two bodies know it
        let Case {
            name: _,
            path: _,
            hash: _,
            shape,
            radius: _,
            material: _,
            velocities: _,
            angle,
            // keys of a rigid wall, which does not stand beside a deformable one
            friction: _,
            adhesion: _,
            tolerance: _,
            // refused as the case is read
            method: _,
            bed,
        } = &self.particle;
        if *shape != Shape::Sphere {
            return rejected("particle.shape", "must be \"sphere\"");
        }
        if *angle > 0.0 {
            return rejected("impact.angle", "must be 0");
        }
        if bed.is_some() {
            return rejected(
                "bed.scene",
                "must be left out: name the pair's law in a scene of both materials (`[[pair]] law`) and run it by `impactlaw bed`",
            );
        }
        Ok(())
    }
}

/// Refusal of a second body where a case of a rigid wall was to be read.
pub(super) fn refusal(document: &Document) -> Error {
    let allowed = "must be left out here: an impact on a deformable wall is planned, run, fitted, compared and exported by `impactlaw plan`, `impact`, `fit`, \
                   `compare`, `run` and `export`; all else is made of impacts on a rigid wall";
    document.reject("wall.material", allowed)
}
