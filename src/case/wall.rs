//! Table `[wall]` of a case: a rigid wall with friction, or a second deformable body in its place.

use super::named::Given;
use super::pair::{Target, TargetShape};
use crate::Result;
use crate::document::Document;
use crate::document::keys::{key, keys, table};
use crate::unit::{Length, Quantity};
use serde::Deserialize;

/// The table as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WallTable {
    friction: Option<f64>,
    material: Option<Given>,
    thickness: Option<Quantity<Length>>,
    radius: Option<Quantity<Length>>,
}

keys! {
    WallTable {
        friction: key("Coulomb's friction coefficient of a rigid wall", "0 to 2", "0.3").or("0"),
        material: table("what a deformable wall is made of: constants, or the name of one of `models/constants/`; with it the impact is one of two bodies, which `plan`, `impact`, `fit`, `compare` and `run` know").or("rigid"),
        thickness: key("of a deformable wall: a plate that is held at its back", "> 0", "'10 mm'").or("half-space"),
        radius: key("of a second sphere, which takes the place of the wall and is free to move", "> 0", "'1 mm'").or("a wall"),
    }
}

impl WallTable {
    /// Friction coefficient, and the second body where there is one.
    ///
    /// # Errors
    /// [`crate::Error::Value`] for a value out of its range, or a key that does not go with another.
    pub(super) fn check(self, document: &Document) -> Result<(f64, Option<Target>)> {
        let thickness = self.thickness.map(|t| ("wall.thickness", t.si()));
        let radius = self.radius.map(|r| ("wall.radius", r.si()));
        let Some(material) = self.material else {
            if let Some((key, _)) = thickness.or(radius) {
                let allowed =
                    "needs a `material` in `[wall]`: without one the wall is rigid and flat";
                return Err(document.reject(key, allowed));
            }
            let Some(friction) = self.friction else {
                return Err(document.reject("wall", "must have `friction`, or a `material`"));
            };
            return Ok((document.within("wall.friction", friction)?, None));
        };
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
        Ok((0.0, Some(Target { shape, material })))
    }
}
