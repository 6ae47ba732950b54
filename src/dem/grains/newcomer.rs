//! Newcomer: a grain about to come in.

use super::Grains;
use parry3d::math::Vector;
use std::f64::consts::PI;

/// A grain about to come in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Newcomer {
    /// Centre, m.
    pub centre: Vector,
    /// Radius, m.
    pub radius: f64,
    /// Density, kg/m3.
    pub density: f64,
    /// Material, as an index into those of the scene.
    pub material: u8,
    /// Group, as an index into those of the scene.
    pub group: u32,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
}

impl Newcomer {
    /// Mass, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3) * self.density
    }

    /// Kinetic and potential energy (J) it brings, in the form the bed counts them with the time step `dt` (s).
    #[must_use]
    pub fn energy(&self, gravity: Vector, dt: f64) -> f64 {
        let next = self.velocity + gravity * dt;
        let turning = 0.2 * self.radius * self.radius * self.spin.length_squared();
        self.mass() * (0.5 * self.velocity.dot(next) + turning - gravity.dot(self.centre))
    }

    /// Adds it to the grains.
    pub fn join(&self, grains: &mut Grains) {
        match self.material {
            0 => grains.add(self.centre, self.radius, self.density),
            material => grains.add_of(material, self.centre, self.radius, self.density),
        }
        if let Some(group) = grains.groups.last_mut() {
            *group = self.group;
        }
        if let Some(motion) = grains.motions.last_mut() {
            motion.velocity = self.velocity;
        }
        if let Some(spin) = grains.spins.last_mut() {
            spin.rate = self.spin;
        }
    }
}
