//! Damping: a viscous force beside the normal law, for the vibration a particle keeps and DEM does not resolve.

use super::meeting::Meeting;
use crate::contact::pair::Pressed;
use crate::tape::Keep;
use parry3d::math::Vector;
use std::f64::consts::PI;
use std::fmt::Debug;

/// Viscous force of a contact; `()` is none.
pub trait Damping: Clone + Send + Sync + 'static {
    /// What is remembered: the undamped force, to tell the work of the law from that of the damper.
    type Memory: Copy + Default + Send + Sync + PartialEq + Keep + Debug;
    /// Whether there is damping.
    const ACTIVE: bool;
    /// Whether it depends on the materials of the contact.
    const BY_MATERIAL: bool = false;

    /// Adds the damping of `approach` (m/s) to a normal `force` (N); the sum never pulls.
    fn add_to(&self, force: &mut f64, approach: f64, pressed: &Pressed, meeting: &Meeting);

    /// Adds the damping of `slip` (m/s) to a tangential `force` (N) on a spring of `stiffness` (N/m), up to `limit` (N).
    fn add_slip_to(
        &self,
        force: &mut Vector,
        slip: Vector,
        stiffness: f64,
        meeting: &Meeting,
        limit: f64,
    );

    /// Force of the law alone a step before, `total` being the whole normal force then.
    fn law_force(memory: &Self::Memory, total: f64) -> f64;

    /// Keeps the force of the law alone.
    fn remember(memory: &mut Self::Memory, force: f64);
}

impl Damping for () {
    type Memory = ();
    const ACTIVE: bool = false;

    #[inline(always)]
    fn add_to(&self, _: &mut f64, _: f64, _: &Pressed, _: &Meeting) {}

    #[inline(always)]
    fn add_slip_to(&self, _: &mut Vector, _: Vector, _: f64, _: &Meeting, _: f64) {}

    #[inline(always)]
    fn law_force((): &(), total: f64) -> f64 {
        total
    }

    #[inline(always)]
    fn remember((): &mut (), _: f64) {}
}

/// Dashpot that gives an elastic Hertz contact the same restitution at every speed.
///
/// $$ F_d = 2 \sqrt{\tfrac56}\ \beta \sqrt{m^\ast k}\ \dot\delta, \qquad \beta = \frac{-\ln e}{\sqrt{\pi^2 + \ln^2 e}} $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | e | 1 | restitution of the elastic contact; a law that yields loses more |
/// | m* | kg | effective mass |
/// | k | N/m | tangent stiffness of the law, dF/d(delta); tangentially that of the spring |
///
/// Source: Tsuji, Tanaka, Ishida 1992; e as a closed form from Antypov and Elliott 2011. The force that would pull at
/// the end of a contact is left out, so that the measured e is slightly above the nominal one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscous {
    /// $2 \sqrt{5/6}\ \beta$.
    factor: f64,
}

impl Viscous {
    /// Dashpot of nominal `restitution` e, 0 < e <= 1.
    #[must_use]
    pub fn new(restitution: f64) -> Self {
        let log = restitution.ln();
        Self {
            factor: 2.0 * (5.0f64 / 6.0).sqrt() * -log / (PI * PI + log * log).sqrt(),
        }
    }
}

impl Damping for Viscous {
    type Memory = f64;
    const ACTIVE: bool = true;

    #[inline(always)]
    fn add_to(&self, force: &mut f64, approach: f64, pressed: &Pressed, meeting: &Meeting) {
        if *force > 0.0 {
            let dashpot = self.factor * (meeting.mass * pressed.stiffness).sqrt() * approach;
            *force = (*force + dashpot).max(0.0);
        }
    }

    #[inline(always)]
    fn add_slip_to(
        &self,
        force: &mut Vector,
        slip: Vector,
        stiffness: f64,
        meeting: &Meeting,
        limit: f64,
    ) {
        let damped = *force - slip * (self.factor * (meeting.mass * stiffness).sqrt());
        let size = damped.length_squared();
        *force = if size > limit * limit {
            damped * (limit / size.sqrt())
        } else {
            damped
        };
    }

    #[inline(always)]
    fn law_force(memory: &f64, _: f64) -> f64 {
        *memory
    }

    #[inline(always)]
    fn remember(memory: &mut f64, force: f64) {
        *memory = force;
    }
}
