//! Friction: a spring across the normal that slides at a limit.

use super::effects::{Contact, Effect, Named};
use super::losses::Losses;
use super::meeting::Meeting;
use super::slider::Slider;
use crate::document::keys::{Line, key};
use crate::material::Material;
use parry3d::math::Vector;

/// Mindlin's no-slip stiffness with Coulomb's limit.
///
/// $$ \dot T = -k_t \dot s, \quad k_t = 8 G^\ast a, \quad \frac{1}{G^\ast} = \sum_i \frac{2 - \nu_i}{G_i}, \quad |T| \le \mu F $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | s | m | slip at the point of contact |
/// | a | m | contact radius of the normal law |
/// | i | | deformable sides: two grains, or one grain on a rigid surface |
/// | mu | 1 | friction coefficient |
///
/// Source: Mindlin 1949; Johnson 1985, section 7.2 (no slip). Micro-slip before gross sliding is left out, as usual in DEM.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mindlin {
    friction: f64,
    /// $8 G^\ast$ of two grains and of a grain on a surface, Pa.
    stiffness: [f64; 2],
    /// Part of that stiffness in use.
    factor: f64,
}

impl Mindlin {
    /// Law of grains of `material` with friction coefficient `friction`, among rigid bodies.
    #[must_use]
    pub fn new(material: &Material, friction: f64) -> Self {
        Self {
            friction,
            stiffness: [
                shear_stiffness([Some(material); 2]),
                shear_stiffness([Some(material), None]),
            ],
            factor: 1.0,
        }
    }

    /// Law of contacts between two materials only, `None` being rigid.
    #[must_use]
    pub fn between(materials: [Option<&Material>; 2], friction: f64) -> Self {
        Self {
            friction,
            stiffness: [shear_stiffness(materials); 2],
            factor: 1.0,
        }
    }

    /// Stiffness k_t (N/m) at contact radius `a` (m).
    #[inline(always)]
    #[must_use]
    pub fn stiffness(&self, a: f64, meeting: &Meeting) -> f64 {
        self.stiffness[usize::from(meeting.with_surface())] * self.factor * a
    }
}

/// $8 G^\ast$ (Pa) of two sides, rigid if `None`; 0 if both are.
fn shear_stiffness(sides: [Option<&Material>; 2]) -> f64 {
    let compliance: f64 = sides
        .into_iter()
        .flatten()
        .map(|side| (2.0 - side.poisson_ratio) / side.shear_modulus())
        .sum();
    if compliance > 0.0 {
        8.0 / compliance
    } else {
        0.0
    }
}

impl Named for Mindlin {
    const LINE: Line = key(
        "Coulomb's friction coefficient, with Mindlin's spring",
        "> 0",
        "0.3",
    );
    const MUST: &'static str = "must be positive";
    const WITHOUT: &'static str = "smooth grains";
    const NEEDS: Option<(&'static str, &'static str)> = None;

    fn allows(friction: f64) -> bool {
        friction > 0.0
    }

    fn of(friction: f64, material: &Material) -> Self {
        Self::new(material, friction)
    }

    fn between(friction: f64, materials: [Option<&Material>; 2]) -> Self {
        Self::between(materials, friction)
    }
}

impl Effect for Mindlin {
    type Memory = Slider;
    const ACROSS: bool = true;
    const MOMENT: bool = false;

    /// A dashpot named beside friction damps the spring too, up to Coulomb's limit.
    #[inline(always)]
    fn act(&self, contact: &mut Contact, spring: &mut Slider, losses: &mut Losses) {
        let m = contact.meeting;
        let slip = contact.laid_across(contact.slip());
        let stiffness = if contact.normal_force > 0.0 {
            self.stiffness(contact.pressed.contact_radius, m)
        } else {
            0.0
        };
        let limit = self.friction * contact.normal_force;
        let held = contact.turned(spring.load);
        let slide = spring.advance(held, slip * m.dt, stiffness, limit);
        losses.friction += slide.loss;
        let mut force = spring.load;
        if contact.dashpot > 0.0 {
            force -= slip * (contact.dashpot * (stiffness / m.inverse_mass).sqrt());
            let size = force.length_squared();
            if size > limit * limit {
                force *= limit / size.sqrt();
            }
            let spent = -0.5 * m.dt * (contact.past_power(slip) + force.dot(slip));
            losses.damping += spent - slide.work;
        }
        contact.across += force;
    }

    #[inline(always)]
    fn moment(_: &Slider) -> Vector {
        Vector::ZERO
    }

    #[inline(always)]
    fn stored(spring: &Slider) -> f64 {
        spring.energy()
    }

    fn soften(&mut self, factor: f64) {
        self.factor = factor;
    }
}
