//! Rolling resistance of a contact.

use super::friction::{Mindlin, Tangential};
use super::meeting::Meeting;
use super::slider::Slider;
use crate::contact::pair::Pressed;
use crate::material::Material;
use crate::tape::Keep;
use parry3d::math::Vector;
use std::fmt::Debug;

/// Resistance of a contact to rolling; `()` is none.
pub trait Rolling: Clone + Send + Sync + 'static {
    /// What is remembered.
    type Memory: Copy + Default + Send + Sync + PartialEq + Keep + Debug;
    /// Whether there is a moment.
    const ACTIVE: bool;
    /// Whether it depends on the materials of the contact.
    const BY_MATERIAL: bool = false;

    /// Updates the moment under the normal `force` (N); returns the energy dissipated, J.
    fn resist(
        &self,
        force: f64,
        pressed: &Pressed,
        meeting: &Meeting,
        memory: &mut Self::Memory,
    ) -> f64;

    /// Moment on the first body, N m.
    fn moment(memory: &Self::Memory) -> Vector;

    /// Energy held, J.
    fn energy(memory: &Self::Memory) -> f64;

    /// Makes the spring `factor` times as stiff as the material says.
    fn soften(&mut self, factor: f64);
}

impl Rolling for () {
    type Memory = ();
    const ACTIVE: bool = false;

    #[inline(always)]
    fn resist(&self, _: f64, _: &Pressed, _: &Meeting, (): &mut ()) -> f64 {
        0.0
    }

    #[inline(always)]
    fn moment((): &()) -> Vector {
        Vector::ZERO
    }

    fn soften(&mut self, _: f64) {}

    #[inline(always)]
    fn energy((): &()) -> f64 {
        0.0
    }
}

/// Elastic-plastic rolling spring.
///
/// $$ \dot M = -k_r \omega_r, \quad k_r = k_t R_e^2, \quad |M| \le \mu_r R_e F $$
///
/// $\omega_r$ is the relative angular velocity across the normal, $R_e = R_1 R_2/(R_1 + R_2)$, $k_t$ Mindlin's
/// stiffness. Source: Ai, Chen, Rotter, Ooi 2011, type C, with the stiffness of the common variant without a rolling dashpot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingSpring {
    /// Rolling friction coefficient mu_r.
    resistance: f64,
    shear: Mindlin,
}

impl RollingSpring {
    /// Resistance of grains of `material` with rolling friction coefficient `resistance`, among rigid bodies.
    #[must_use]
    pub fn new(material: &Material, resistance: f64) -> Self {
        Self {
            resistance,
            shear: Mindlin::new(material, 0.0),
        }
    }

    /// Resistance of contacts between two materials only, `None` being rigid.
    #[must_use]
    pub fn between(materials: [Option<&Material>; 2], resistance: f64) -> Self {
        Self {
            resistance,
            shear: Mindlin::between(materials, 0.0),
        }
    }
}

impl Rolling for RollingSpring {
    type Memory = Slider;
    const ACTIVE: bool = true;

    #[inline(always)]
    fn resist(&self, force: f64, pressed: &Pressed, meeting: &Meeting, memory: &mut Slider) -> f64 {
        let radius = meeting.effective_radius();
        let relative = meeting.spins[0] - meeting.spins[1];
        let rolling = relative - meeting.normal * relative.dot(meeting.normal);
        let stiffness = if force > 0.0 {
            self.shear.stiffness(pressed.contact_radius, meeting) * radius * radius
        } else {
            0.0
        };
        memory
            .advance(
                rolling * meeting.dt,
                meeting.normal,
                stiffness,
                self.resistance * radius * force,
            )
            .loss
    }

    #[inline(always)]
    fn moment(memory: &Slider) -> Vector {
        memory.load
    }

    #[inline(always)]
    fn energy(memory: &Slider) -> f64 {
        memory.energy()
    }

    fn soften(&mut self, factor: f64) {
        self.shear.soften(factor);
    }
}
