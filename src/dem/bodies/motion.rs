//! Motion: where a driven body is told to be, as a function of time.

use parry3d::math::{Rotation, Vector};
use std::f64::consts::TAU;

/// Told motion of a body, from a start on; parts add up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Velocity of the body, or of the axis it turns about, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
    /// Point on the axis at the start, m; the body's own centre if none.
    pub about: Option<Vector>,
    /// Vibration, if any.
    pub oscillation: Option<Oscillation>,
    /// Velocity set from the force of the grains instead, if any.
    pub servo: Option<Servo>,
}

/// Drive that holds a force: the velocity falls to zero as the force of the grains comes up to it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Servo {
    /// Direction the body presses in.
    pub direction: Vector,
    /// Force to hold, N.
    pub force: f64,
    /// Speed without resistance, m/s.
    pub speed: f64,
}

impl Servo {
    /// Velocity (m/s) against the force `load` (N) of the grains on the body.
    ///
    /// $$ v = v_0\ \mathrm{clamp}(1 - F/F_0, -1, 1) $$
    #[must_use]
    pub fn velocity(&self, load: Vector) -> Vector {
        let reaction = -load.dot(self.direction);
        self.direction * (self.speed * (1.0 - reaction / self.force).clamp(-1.0, 1.0))
    }
}

/// Sinusoidal vibration along a line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Oscillation {
    /// Largest displacement from the middle, m.
    pub amplitude: Vector,
    /// Frequency, Hz.
    pub frequency: f64,
}

impl Motion {
    /// Straight motion at `velocity` (m/s).
    #[must_use]
    pub fn straight(velocity: Vector) -> Self {
        Self {
            velocity,
            ..Self::default()
        }
    }

    /// Whether velocity and spin of the centre never change, so that one setting serves.
    #[must_use]
    pub fn is_steady(&self) -> bool {
        let told = self.oscillation.is_none() && self.servo.is_none();
        told && (self.about.is_none() || self.spin == Vector::ZERO)
    }

    /// Centre (m) of a body that was at `start`, a time `after` (s) the start of the motion.
    ///
    /// $$ x(t) = v t + a + R(\omega t) (x_0 - a) + A \sin(2 \pi f t) $$
    ///
    /// ```
    /// use impactlaw::dem::bodies::motion::Motion;
    /// use parry3d::math::Vector;
    /// // half a turn in one second about the origin
    /// let turn = Motion { spin: Vector::Z * std::f64::consts::PI, about: Some(Vector::ZERO), ..Motion::default() };
    /// assert!((turn.centre(Vector::X, 1.0) + Vector::X).length() < 1e-15);
    /// ```
    #[must_use]
    pub fn centre(&self, start: Vector, after: f64) -> Vector {
        let turned = match self.about {
            Some(about) => about + Rotation::from_scaled_axis(self.spin * after) * (start - about),
            None => start,
        };
        let shaken = self.oscillation.map_or(Vector::ZERO, |o| {
            o.amplitude * (TAU * o.frequency * after).sin()
        });
        turned + self.velocity * after + shaken
    }

    /// Bound on the speed (m/s) of a point within `reach` (m) of the axis.
    #[must_use]
    pub fn fastest(&self, reach: f64) -> f64 {
        let shaken = self
            .oscillation
            .map_or(0.0, |o| TAU * o.frequency * o.amplitude.length());
        let served = self.servo.map_or(0.0, |servo| servo.speed);
        self.velocity.length() + served + self.spin.length() * reach + shaken
    }
}
