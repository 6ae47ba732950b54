//! Slider: a spring that carries a load up to a limit and then slides; tangential and rolling springs are made of it.

use parry3d::math::Vector;

/// Spring that slides: the load it carries and how soft it is.
///
/// While the stiffness grows the load stays; while it falls the load falls with it. A spring that kept its stretch
/// instead would return more energy than it was given (Elata and Berryman 1996).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Slider {
    /// Force (N) or moment (N m) on the first body.
    pub load: Vector,
    /// Inverse stiffness, m/N or rad/(N m); 0 while apart, and then without load.
    pub compliance: f64,
}

/// What a step of a [`Slider`] did to the energy, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Slide {
    /// Work put in.
    pub work: f64,
    /// Part of it dissipated.
    pub loss: f64,
}

impl Slider {
    /// Energy held, J: $T^2 / 2k$.
    #[inline(always)]
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.5 * self.load.length_squared() * self.compliance
    }

    /// Advances by `stretch` (m or rad) in the plane of `normal`, with the present `stiffness`, up to `limit`.
    #[inline(always)]
    pub fn advance(
        &mut self,
        stretch: Vector,
        normal: Vector,
        stiffness: f64,
        limit: f64,
    ) -> Slide {
        let held = self.energy();
        let before = turned_into_plane(self.load, normal);
        let softened = (stiffness * self.compliance).min(1.0);
        let mut load = before * softened - stretch * stiffness;
        let size = load.length_squared();
        if size > limit * limit {
            load *= limit / size.sqrt();
        }
        let compliance = if stiffness > 0.0 {
            1.0 / stiffness
        } else {
            0.0
        };
        *self = Slider { load, compliance };
        let work = -0.5 * (before + load).dot(stretch);
        Slide {
            work,
            loss: work + held - self.energy(),
        }
    }
}

/// The vector laid into the plane of `normal`, its length kept: how a spring follows a contact that turns.
#[inline(always)]
fn turned_into_plane(vector: Vector, normal: Vector) -> Vector {
    let across = vector.dot(normal);
    let flat = vector - normal * across;
    let (length, lost) = (vector.length_squared(), across * across);
    if lost < 1e-5 * length {
        let part = lost / length;
        return flat * (1.0 + part * (0.5 + 0.375 * part));
    }
    let flat_length = flat.length_squared();
    if flat_length > 0.0 {
        flat * (length / flat_length).sqrt()
    } else {
        flat
    }
}
