//! Region: a block or an upright cylinder of space that grains come in through.

use super::written::vector;
use crate::Result;
use crate::document::Document;
use crate::document::keys::{key, keys};
use crate::unit::{Length, Quantity};
use parry3d::math::Vector;
use serde::Deserialize;

/// Part of space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Region {
    /// Block between two corners, m.
    Block {
        /// Lowest corner.
        low: Vector,
        /// Highest corner.
        high: Vector,
    },
    /// Cylinder along z.
    Cylinder {
        /// Middle of its bottom, m.
        base: Vector,
        /// Radius, m.
        radius: f64,
        /// Height, m.
        height: f64,
    },
}

impl Region {
    /// Lowest and highest corner of the block around it, m.
    #[must_use]
    pub fn corners(&self) -> [Vector; 2] {
        match *self {
            Region::Block { low, high } => [low, high],
            Region::Cylinder {
                base,
                radius,
                height,
            } => [
                base - Vector::new(radius, radius, 0.0),
                base + Vector::new(radius, radius, height),
            ],
        }
    }

    /// Whether a ball lies wholly inside.
    #[must_use]
    pub fn holds(&self, centre: Vector, radius: f64) -> bool {
        let [low, high] = self.corners();
        let boxed = (centre - radius).cmpge(low).all() && (centre + radius).cmple(high).all();
        let round = match *self {
            Region::Block { .. } => true,
            Region::Cylinder {
                base,
                radius: outer,
                ..
            } => (centre - base).truncate().length() + radius <= outer,
        };
        boxed && round
    }

    /// Volume, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        match *self {
            Region::Block { low, high } => (high - low).element_product(),
            Region::Cylinder { radius, height, .. } => {
                std::f64::consts::PI * radius * radius * height
            }
        }
    }
}

/// A block (`low`, `high`) or an upright cylinder (`base`, `radius`, `height`).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionTable {
    low: Option<[Quantity<Length>; 3]>,
    high: Option<[Quantity<Length>; 3]>,
    base: Option<[Quantity<Length>; 3]>,
    radius: Option<Quantity<Length>>,
    height: Option<Quantity<Length>>,
}

keys! {
    RegionTable "A block (`low`, `high`) or an upright cylinder (`base`, `radius`, `height`)." {
        low: key("lowest corner", "", "['0 mm', '0 mm', '5 mm']").or("needed for a block"),
        high: key("highest corner", "above `low`", "['5 mm', '5 mm', '9 mm']").or("needed for a block"),
        base: key("middle of its bottom", "", "['0 mm', '0 mm', '0 mm']").or("needed for a cylinder"),
        radius: key("radius", "> 0", "'24 mm'").or("needed for a cylinder"),
        height: key("height", "> 0", "'200 mm'").or("needed for a cylinder"),
    }
}

impl RegionTable {
    pub(super) fn check(&self, document: &Document, key: &str) -> Result<Region> {
        match (self.low, self.high, self.base, self.radius, self.height) {
            (Some(low), Some(high), None, None, None) => {
                let (low, high) = (vector(low), vector(high));
                if !(high - low).cmpgt(Vector::ZERO).all() {
                    let allowed = "must lie above `low` along every axis";
                    return Err(document.reject(&format!("{key}.high"), allowed));
                }
                Ok(Region::Block { low, high })
            }
            (None, None, Some(base), Some(radius), Some(height)) => Ok(Region::Cylinder {
                base: vector(base),
                radius: document.positive(&format!("{key}.radius"), radius)?,
                height: document.positive(&format!("{key}.height"), height)?,
            }),
            _ => Err(document.reject(
                key,
                "must hold `low` and `high` (a block), or `base`, `radius` and `height` (an upright cylinder)",
            )),
        }
    }
}
