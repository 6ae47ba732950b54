//! Scope: what a verb needs a case to be, refused by name where it is another.

use super::Case;
use crate::document::Document;
use crate::material::adhesion::Adhesion;
use crate::shape::Shape;
use crate::unit::significant;
use crate::{Error, Result};

impl Case {
    /// That nothing is asked of a cylinder that is done for spheres alone.
    pub(super) fn check_cylinder(&self, document: &Document) -> Result<()> {
        // whoever adds to a case says here whether cylinders know it
        let Case {
            name: _,
            path: _,
            hash: _,
            shape,
            radius: _,
            material: _,
            velocities: _,
            angle,
            friction,
            adhesion,
            tolerance: _,
            // refused as presets are
            method: _,
            bed,
        } = self;
        if *shape == Shape::Sphere {
            return Ok(());
        }
        let rejected = |key, what: &str| {
            let allowed = format!(
                "must be {what}: a cylinder flies along its axis against a frictionless wall without adhesion"
            );
            Err(document.reject(key, allowed))
        };
        if *angle > 0.0 {
            return rejected("impact.angle", "0");
        }
        if *friction > 0.0 {
            return rejected("wall.friction", "0");
        }
        if adhesion.is_some() {
            return rejected("wall.work_of_adhesion", "0");
        }
        if bed.is_some() {
            let allowed = "must be left out: beds are made of spheres";
            return Err(document.reject("bed.scene", allowed));
        }
        Ok(())
    }

    /// That the particle is a sphere and meets a wall that does not adhere, as `what` needs it.
    ///
    /// # Errors
    /// [`Error::Refused`] naming the shape or the adhesion.
    pub fn of_a_sphere(&self, what: &str) -> Result<()> {
        // whoever adds to a case says here whether a sphere's figures follow without it
        let Case {
            name: _,
            path: _,
            hash: _,
            shape,
            radius: _,
            material: _,
            velocities: _,
            // inputs of their own: what has none of them asks for a normal impact
            angle: _,
            friction: _,
            adhesion,
            tolerance: _,
            // asked for by `of_own_scheme`
            method: _,
            bed: _,
        } = self;
        if let Some(adhesion) = adhesion {
            return Err(self.refused(
                "wall.work_of_adhesion",
                format!("{} J/m2", significant(adhesion.work, 6)),
                format!(
                    "must be left out: {what} knows no adhesion; `impactlaw impact` runs this one"
                ),
            ));
        }
        match shape {
            Shape::Sphere => Ok(()),
            shape => Err(self.refused(
                "particle.shape",
                format!("\"{}\"", shape.name()),
                format!(
                    "{what} needs a sphere; `impactlaw impact` runs a {}",
                    shape.name()
                ),
            )),
        }
    }

    /// That the particle is a sphere and meets a frictionless wall without adhesion along its normal, as `what` needs it.
    ///
    /// # Errors
    /// [`Error::Refused`] naming the shape, the angle, the friction or the adhesion.
    pub fn of_a_normal_impact(&self, what: &str) -> Result<()> {
        self.of_a_sphere(what)?;
        for (key, found) in [
            ("impact.angle", self.angle.to_degrees()),
            ("wall.friction", self.friction),
        ] {
            if found != 0.0 {
                return Err(self.refused(key, significant(found, 6), format!(
                    "must be 0: {what} needs a normal impact on a frictionless wall; `impactlaw impact` and `study` run this one"
                )));
            }
        }
        Ok(())
    }

    /// The adhesion of a sphere that meets a frictionless wall along its normal, as `what` needs it.
    ///
    /// # Errors
    /// [`Error::Refused`] where there is none, and as [`Case::of_a_normal_impact`].
    pub fn of_a_normal_adhesive_impact(&self, what: &str) -> Result<Adhesion> {
        let Some(adhesion) = self.adhesion else {
            return Err(self.refused(
                "wall.work_of_adhesion",
                "none".to_owned(),
                format!("must be given: {what} is of a wall that adheres"),
            ));
        };
        let without = Case {
            adhesion: None,
            ..self.clone()
        };
        without.of_a_normal_impact(what)?;
        Ok(adhesion)
    }

    fn refused(&self, key: &str, found: String, allowed: String) -> Error {
        Error::Refused {
            what: format!("{}: `{key}`", self.path.display()),
            found,
            allowed,
        }
    }
}
