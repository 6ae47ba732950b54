//! Scope: what a verb needs a case to be, refused by name where it is another.

use super::Case;
use crate::shape::Shape;
use crate::unit::significant;
use crate::{Error, Result};

impl Case {
    /// That the particle is a sphere, as `what` needs it.
    ///
    /// # Errors
    /// [`Error::Refused`] naming the shape.
    pub fn of_a_sphere(&self, what: &str) -> Result<()> {
        match self.shape {
            Shape::Sphere => Ok(()),
            shape => Err(Error::Refused {
                what: format!("{}: `particle.shape`", self.path.display()),
                found: format!("\"{}\"", shape.name()),
                allowed: format!(
                    "{what} needs a sphere; `impactlaw impact` runs a {}",
                    shape.name()
                ),
            }),
        }
    }

    /// That the particle is a sphere and meets a frictionless wall along its normal, as `what` needs it.
    ///
    /// # Errors
    /// [`Error::Refused`] naming the shape, the angle or the friction.
    pub fn of_a_normal_impact(&self, what: &str) -> Result<()> {
        self.of_a_sphere(what)?;
        for (key, found) in [
            ("impact.angle", self.angle.to_degrees()),
            ("wall.friction", self.friction),
        ] {
            if found != 0.0 {
                return Err(Error::Refused {
                    what: format!("{}: `{key}`", self.path.display()),
                    found: significant(found, 6),
                    allowed: format!(
                        "must be 0: {what} needs a normal impact on a frictionless wall; `impactlaw impact` and `study` run this one"
                    ),
                });
            }
        }
        Ok(())
    }
}
