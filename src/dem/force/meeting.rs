//! Meeting of two bodies, and what a contact does to them.

use parry3d::math::Vector;

/// Two bodies near each other, SI units; everything a contact law may depend on.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    /// Overlap of the undeformed bodies, m; negative if apart.
    pub overlap: f64,
    /// Unit normal from the second body to the first.
    pub normal: Vector,
    /// Velocity of the first centre relative to the second centre, or to the surface at the point of contact, m/s.
    pub velocity: Vector,
    /// Angular velocities, rad/s.
    pub spins: [Vector; 2],
    /// Radii, m; infinite for a surface.
    pub radii: [f64; 2],
    /// Inverse distance of the centres, by which the normal turns as the bodies pass each other, 1/m; 0 for a surface.
    pub inverse_distance: f64,
    /// Effective mass of the normal motion, kg.
    pub mass: f64,
    /// Time step, s.
    pub dt: f64,
    /// Materials, as indices; [`super::mixture::RIGID`] for a body without one. Told only to laws that ask
    /// ([`super::effects::ContactLaw::BY_MATERIAL`]).
    pub materials: [u8; 2],
}

/// What a contact does to its bodies; one line of the cache.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(64))]
pub struct Push {
    /// Force on the first body, N.
    pub force: Vector,
    /// Torque per lever arm, the same for both bodies: force x normal, N.
    pub couple: Vector,
    /// Lever arms of the bodies from centre to point of contact, m; 0 while apart.
    pub arms: [f64; 2],
}

impl Meeting {
    /// Whether the second body is a surface, not a grain.
    #[inline(always)]
    #[must_use]
    pub fn with_surface(&self) -> bool {
        self.radii[1].is_infinite()
    }

    /// Radius of curvature of the gap, m: $1/R_e = 1/R_1 + 1/R_2$.
    #[inline(always)]
    #[must_use]
    pub fn effective_radius(&self) -> f64 {
        1.0 / (1.0 / self.radii[0] + 1.0 / self.radii[1])
    }
}

impl Push {
    /// Whether the bodies overlap.
    #[inline(always)]
    #[must_use]
    pub fn touches(&self) -> bool {
        self.arms[0] > 0.0
    }
}
