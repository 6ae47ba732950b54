//! Shape of a particle.

use std::f64::consts::PI;

/// Shape of a particle of radius R; lengths in the unit of the place where it stands (m in a case, R in a plan).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A sphere.
    Sphere,
    /// A cylinder whose axis points along its flight: it meets the wall with an end.
    Cylinder {
        /// Its length.
        length: f64,
    },
}

impl Shape {
    /// The same in units of `radius`.
    #[must_use]
    pub fn over(self, radius: f64) -> Self {
        match self {
            Shape::Sphere => Shape::Sphere,
            Shape::Cylinder { length } => Shape::Cylinder {
                length: length / radius,
            },
        }
    }

    /// Height along the flight of a particle of radius one.
    #[must_use]
    pub fn height(self) -> f64 {
        match self {
            Shape::Sphere => 2.0,
            Shape::Cylinder { length } => length,
        }
    }

    /// Volume of a particle of radius one.
    #[must_use]
    pub fn volume(self) -> f64 {
        match self {
            Shape::Sphere => 4.0 / 3.0 * PI,
            Shape::Cylinder { length } => PI * length,
        }
    }

    /// Name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Shape::Sphere => "sphere",
            Shape::Cylinder { .. } => "cylinder",
        }
    }
}
