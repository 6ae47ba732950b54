//! Belt: the surface of a body moves along itself while the body stands, as that of a conveyor or a roller.

use parry3d::math::Vector;

/// Velocity of a surface that stands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Belt {
    /// Velocity, m/s; of it a surface has the part along itself.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
    /// Point on the axis of the spin, m.
    pub about: Vector,
}

impl Belt {
    /// Velocity (m/s) of the surface at a point (m) with a unit normal: along the surface, so that it neither comes nor goes.
    ///
    /// $$ u = (1 - n n) (v + \omega \times (x - a)) $$
    ///
    /// ```
    /// use impactlaw::dem::bodies::belt::Belt;
    /// use parry3d::math::Vector;
    /// let belt = Belt { velocity: Vector::new(1.0, 0.0, 1.0), ..Belt::default() };
    /// assert_eq!(belt.at(Vector::ZERO, Vector::Z), Vector::X);
    /// ```
    #[must_use]
    pub fn at(&self, point: Vector, normal: Vector) -> Vector {
        let velocity = self.velocity + self.spin.cross(point - self.about);
        velocity - normal * velocity.dot(normal)
    }

    /// Bound on its speed (m/s) within `reach` (m) of the axis.
    #[must_use]
    pub fn fastest(&self, reach: f64) -> f64 {
        // a plane has no end: without a turn its reach does not matter
        let turning = match self.spin == Vector::ZERO {
            true => 0.0,
            false => self.spin.length() * reach,
        };
        self.velocity.length() + turning
    }
}
