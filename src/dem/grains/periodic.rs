//! Periodic sides: what leaves the room on one side comes back on the other, and grains meet across.

use crate::{Error, Result};
use parry3d::math::Vector;

/// Images of a room along three axes: each grain and its 26 copies.
pub const IMAGES: usize = 27;

/// Sides of the room grains live in, each axis open (the default) or periodic.
///
/// Bodies have no images. One that spans a periodic axis (a floor under the whole room) must reach beyond the sides by
/// more than a grain's radius; one that does not must stay further from them than that.
///
/// ```
/// use impactlaw::dem::grains::periodic::Periodic;
/// use parry3d::math::Vector;
/// let room = Periodic::new(Vector::ZERO, [Some(10e-3), None, None])?;
/// let back = room.inside(Vector::new(10.5e-3, 20e-3, -1e-3));
/// assert!((back - Vector::new(0.5e-3, 20e-3, -1e-3)).length() < 1e-15);
/// // the shortest way between two points may lead through a side
/// let way = room.shortest(Vector::new(9e-3, 0.0, 0.0));
/// assert!((way - Vector::new(-1e-3, 0.0, 0.0)).length() < 1e-15);
/// # Ok::<(), impactlaw::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Periodic {
    low: Vector,
    /// Period along each axis, m; 0 for an open one.
    length: Vector,
}

impl Periodic {
    /// Room whose corner is `low` (m), with the `period` (m) of each axis that has one.
    ///
    /// # Errors
    /// [`Error::Refused`] unless every period is finite and above 0.
    pub fn new(low: Vector, period: [Option<f64>; 3]) -> Result<Self> {
        for period in period.into_iter().flatten() {
            if !(period > 0.0 && period.is_finite()) {
                return Err(Error::Refused {
                    what: "periodic".to_owned(),
                    found: format!("a period of {period} m"),
                    allowed: "must be finite and above 0".to_owned(),
                });
            }
        }
        let length = Vector::from(period.map(|period| period.unwrap_or(0.0)));
        Ok(Self { low, length })
    }

    /// Whether no axis is periodic.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.length == Vector::ZERO
    }

    /// Corner (m) and period (m) of an axis, if it has one.
    #[must_use]
    pub fn along(&self, axis: usize) -> Option<(f64, f64)> {
        (self.length[axis] > 0.0).then_some((self.low[axis], self.length[axis]))
    }

    /// The image of a point that lies inside.
    #[must_use]
    pub fn inside(&self, mut point: Vector) -> Vector {
        for axis in 0..3 {
            if let Some((low, length)) = self.along(axis) {
                point[axis] -= ((point[axis] - low) / length).floor() * length;
            }
        }
        point
    }

    /// The shortest of all images of the way between two points (m).
    #[must_use]
    pub fn shortest(&self, mut way: Vector) -> Vector {
        for axis in 0..3 {
            if let Some((_, length)) = self.along(axis) {
                way[axis] -= (way[axis] / length).round() * length;
            }
        }
        way
    }

    /// Number of the image `steps` (-1, 0 or 1) periods away along each axis.
    #[must_use]
    pub fn image(steps: [i8; 3]) -> u8 {
        steps
            .iter()
            .fold(0, |image, &step| 3 * image + (step + 1) as u8)
    }

    /// What an image adds to a place, m.
    #[must_use]
    pub fn shift(&self, image: u8) -> Vector {
        let steps = [image / 9, image / 3 % 3, image % 3].map(|step| f64::from(step) - 1.0);
        self.length * Vector::from(steps)
    }

    /// What each image adds to a place, m.
    #[must_use]
    pub fn shifts(&self) -> [Vector; IMAGES] {
        std::array::from_fn(|image| self.shift(image as u8))
    }

    /// Checks that no grain can meet another through two sides at once; `reach` (m) is the largest distance of two
    /// listed centres.
    ///
    /// # Errors
    /// [`Error::Refused`] when a period is not above twice the reach.
    pub fn admit(&self, reach: f64) -> Result<()> {
        for axis in 0..3 {
            if let Some((_, length)) = self.along(axis)
                && length <= 2.0 * reach
            {
                return Err(Error::Refused {
                    what: "periodic".to_owned(),
                    found: format!("a period of {length} m along {}", ["x", "y", "z"][axis]),
                    allowed: format!(
                        "must be above {} m, four radii of the largest grain and a margin, or two grains would meet through both sides",
                        2.0 * reach
                    ),
                });
            }
        }
        Ok(())
    }
}
