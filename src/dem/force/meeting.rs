//! Meeting of two bodies, and what a contact does to them.

use parry3d::math::Vector;

/// Two bodies near each other, SI units; everything a contact law may depend on.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    /// Overlap of the undeformed bodies, m; negative if apart.
    pub overlap: f64,
    /// Unit normal from the second body to the first.
    pub normal: Vector,
    /// From the second centre, or the point of contact on a surface, to the first centre in the middle of the step that led
    /// here, over the present distance. That is the time of the velocities: slip and approach are seen along it.
    pub middle: Vector,
    /// Velocity of the first centre relative to the second centre, or to the surface at the point of contact, m/s; that of
    /// the step that led here.
    pub velocity: Vector,
    /// Angular velocities, rad/s.
    pub spins: [Vector; 2],
    /// Radii, m; infinite for a surface.
    pub radii: [f64; 2],
    /// Inverse of the effective mass of the normal motion, 1/kg.
    pub inverse_mass: f64,
    /// Length of that step, s.
    pub dt: f64,
    /// Materials, as indices; [`super::mixture::RIGID`] for a body without one. Told only to laws that ask
    /// ([`super::effects::ContactLaw::BY_MATERIAL`]).
    pub materials: [u8; 2],
}

/// Where something is and how it moves: place (m) now, velocities of the step that led there.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    /// Centre of mass, m.
    pub centre: Vector,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
}

impl Course {
    /// Centre half a step of `dt` (s) before, m.
    #[inline(always)]
    #[must_use]
    pub fn halfway(&self, dt: f64) -> Vector {
        self.centre - self.velocity * (0.5 * dt)
    }
}

/// A grain at `distance` (m) from a surface, in the middle of the step that led there: [`Meeting::middle`] and
/// [`Meeting::velocity`]. `surface` is the velocity at a point of it with its normal, both of that time; `normals` are the present one and
/// that of the step before, the same where there was no contact.
#[inline(always)]
#[must_use]
pub fn over_surface(
    grain: &Course,
    surface: impl Fn(Vector, Vector) -> Vector,
    normals: [Vector; 2],
    distance: f64,
    dt: f64,
) -> [Vector; 2] {
    let [normal, before] = normals;
    let sum = normal + before;
    let twice = sum.length();
    // normals more than a right angle apart are not those of one point that moves on
    let middle = if twice > 2f64.sqrt() {
        sum / twice
    } else {
        normal
    };
    let at = |distance: f64| surface(grain.halfway(dt) - middle * distance, middle);
    // a point further along the normal moves as fast along it
    let approach = (at(distance) - grain.velocity).dot(middle);
    let then = distance + 0.5 * dt * approach;
    [middle * (then / distance), grain.velocity - at(then)]
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
