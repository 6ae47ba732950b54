//! Region: a block or an upright cylinder of space that grains come in through.

use parry3d::math::Vector;

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
