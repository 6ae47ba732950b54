//! Rolling resistance of a contact.

use super::effects::{Contact, Effect, Named};
use super::friction::Mindlin;
use super::losses::Losses;
use super::slider::Slider;
use crate::document::keys::{Line, key};
use crate::material::Material;
use parry3d::math::Vector;

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

impl Named for RollingSpring {
    const LINE: Line = key(
        "rolling friction coefficient; needs `friction`",
        "> 0",
        "0.05",
    );
    const MUST: &'static str = "must be positive";
    const WITHOUT: &'static str = "free rolling";
    const NEEDS: Option<(&'static str, &'static str)> =
        Some(("friction", "smooth grains do not roll"));

    fn allows(resistance: f64) -> bool {
        resistance > 0.0
    }

    fn of(resistance: f64, material: &Material) -> Self {
        Self::new(material, resistance)
    }

    fn between(resistance: f64, materials: [Option<&Material>; 2]) -> Self {
        Self::between(materials, resistance)
    }
}

impl Effect for RollingSpring {
    type Memory = Slider;
    const ACROSS: bool = false;
    const MOMENT: bool = true;

    #[inline(always)]
    fn act(&self, contact: &mut Contact, spring: &mut Slider, losses: &mut Losses) {
        let (m, force) = (contact.meeting, contact.normal_force);
        let radius = m.effective_radius();
        let relative = m.spins[0] - m.spins[1];
        let rolling = relative - contact.middle * relative.dot(contact.middle);
        let rolling = contact.laid_across(rolling);
        let stiffness = if force > 0.0 {
            self.shear.stiffness(contact.pressed.contact_radius, m) * radius * radius
        } else {
            0.0
        };
        let limit = self.resistance * radius * force;
        let held = contact.turned(spring.load);
        let slide = spring.advance(held, rolling * m.dt, stiffness, limit);
        losses.rolling += slide.loss;
    }

    #[inline(always)]
    fn moment(spring: &Slider) -> Vector {
        spring.load
    }

    #[inline(always)]
    fn stored(spring: &Slider) -> f64 {
        spring.energy()
    }

    fn soften(&mut self, factor: f64) {
        self.shear.soften(factor);
    }
}
