//! Table `[wall]` of a case: a rigid wall with friction or adhesion, or a second deformable body in its place.

use super::named::Given;
use super::pair::{Target, TargetShape};
use crate::Result;
use crate::document::Document;
use crate::document::keys::{key, keys, table};
use crate::material::adhesion::Adhesion;
use crate::unit::{Length, Quantity, SurfaceEnergy};
use serde::Deserialize;

/// The table as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WallTable {
    friction: Option<f64>,
    work_of_adhesion: Option<Quantity<SurfaceEnergy>>,
    adhesion_range: Option<Quantity<Length>>,
    material: Option<Given>,
    thickness: Option<Quantity<Length>>,
    radius: Option<Quantity<Length>>,
}

keys! {
    WallTable {
        friction: key("Coulomb's friction coefficient of a rigid wall", "0 to 2", "0.3").or("0"),
        work_of_adhesion: key("work of adhesion w of particle and rigid wall, γ₁ + γ₂ - γ₁₂: energy that a unit of area gives as the surfaces meet; known to `impact`, `plan` and the adhesive models of `theory`", "≥ 0", "'50 mJ/m2'").or("0"),
        adhesion_range: key("gap h₀ up to which they attract each other, with the constant traction w/h₀ (Dugdale, Maugis)", "> 0", "'20 nm'").or("chosen: the limit of Johnson, Kendall and Roberts; of a body that yields, a traction of its yield strength"),
        material: table("what a deformable wall is made of: constants, or the name of one of `models/constants/`; with it the impact is one of two bodies, which `plan`, `impact`, `fit`, `compare`, `run` and `export` know").or("rigid"),
        thickness: key("of a deformable wall: a plate that is held at its back", "> 0", "'10 mm'").or("half-space"),
        radius: key("of a second sphere, which takes the place of the wall and is free to move", "> 0", "'1 mm'").or("a wall"),
    }
}

/// What stands in the way of the particle.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Wall {
    /// Friction coefficient of a rigid wall.
    pub friction: f64,
    /// Adhesion of a rigid wall, where it adheres.
    pub adhesion: Option<Adhesion>,
    /// The second body, where there is one.
    pub target: Option<Target>,
}

impl WallTable {
    /// The wall, or the second body in its place.
    ///
    /// # Errors
    /// [`crate::Error::Value`] for a value out of its range, or a key that does not go with another.
    pub(super) fn check(self, document: &Document) -> Result<Wall> {
        let adhesion = self.adhesion(document)?;
        let thickness = self.thickness.map(|t| ("wall.thickness", t.si()));
        let radius = self.radius.map(|r| ("wall.radius", r.si()));
        let Some(material) = self.material else {
            if let Some((key, _)) = thickness.or(radius) {
                let allowed =
                    "needs a `material` in `[wall]`: without one the wall is rigid and flat";
                return Err(document.reject(key, allowed));
            }
            if self.friction.is_none() && self.work_of_adhesion.is_none() {
                let allowed = "must have `friction`, `work_of_adhesion`, or a `material`";
                return Err(document.reject("wall", allowed));
            }
            let friction = document.within("wall.friction", self.friction.unwrap_or(0.0))?;
            if friction > 0.0 && adhesion.is_some() {
                let allowed = "must be left out beside `wall.work_of_adhesion`: a wall that adheres is frictionless";
                return Err(document.reject("wall.friction", allowed));
            }
            return Ok(Wall {
                friction,
                adhesion,
                target: None,
            });
        };
        if self.work_of_adhesion.is_some() {
            let allowed = "must be left out beside `wall.material`: two deformable bodies meet without adhesion";
            return Err(document.reject("wall.work_of_adhesion", allowed));
        }
        if self.friction.is_some() {
            let allowed = "must be left out beside `wall.material`: two deformable bodies meet without friction";
            return Err(document.reject("wall.friction", allowed));
        }
        let shape = match (thickness, radius) {
            (Some(_), Some((key, _))) => {
                let allowed = "must be left out beside `wall.thickness`: a second body is a plate or a sphere";
                return Err(document.reject(key, allowed));
            }
            (Some((key, thickness)), None) => TargetShape::Plate {
                thickness: document.within(key, thickness)?,
            },
            (None, Some((key, radius))) => TargetShape::Sphere {
                radius: document.within(key, radius)?,
            },
            (None, None) => TargetShape::HalfSpace,
        };
        let material = material.check(document, "wall.material")?;
        Ok(Wall {
            target: Some(Target { shape, material }),
            ..Wall::default()
        })
    }

    /// Adhesion, where the work of it is above 0.
    fn adhesion(&self, document: &Document) -> Result<Option<Adhesion>> {
        let range = (self.adhesion_range)
            .map(|range| document.within("wall.adhesion_range", range.si()))
            .transpose()?;
        let Some(work) = self.work_of_adhesion else {
            if range.is_some() {
                let allowed = "needs a `work_of_adhesion` beside it";
                return Err(document.reject("wall.adhesion_range", allowed));
            }
            return Ok(None);
        };
        let work = document.within("wall.work_of_adhesion", work.si())?;
        Ok((work > 0.0).then_some(Adhesion { work, range }))
    }
}
