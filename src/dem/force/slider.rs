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

    /// Advances by `stretch` (m or rad) with the present `stiffness`, up to `limit`; `held` is the load turned to where it acts
    /// now. Both lie across the present normal.
    #[inline(always)]
    pub fn advance(&mut self, held: Vector, stretch: Vector, stiffness: f64, limit: f64) -> Slide {
        let stored = self.energy();
        let softened = (stiffness * self.compliance).min(1.0);
        let mut load = held * softened - stretch * stiffness;
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
        let work = -0.5 * (held + load).dot(stretch);
        Slide {
            work,
            loss: work + stored - self.energy(),
        }
    }
}
