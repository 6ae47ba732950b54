//! Friction: springs that slide at a limit, for tangential force and rolling moment.

use super::meeting::Meeting;
use super::slider::Slider;
use crate::contact::pair::Pressed;
use crate::material::Material;
use crate::tape::Keep;
use parry3d::math::Vector;
use std::fmt::Debug;

/// Result of a tangential law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pull {
    /// Force of the spring on the first body, N.
    pub force: Vector,
    /// Stiffness of the spring, N/m.
    pub stiffness: f64,
    /// Work put into the spring, J.
    pub work: f64,
    /// Part of it dissipated, J.
    pub loss: f64,
}

/// Tangential force of a contact; `()` is a frictionless one.
pub trait Tangential: Clone + Send + Sync + 'static {
    /// What is remembered.
    type Memory: Copy + Default + Send + Sync + PartialEq + Keep + Debug;
    /// Whether there is a tangential force.
    const ACTIVE: bool;
    /// Whether it depends on the materials of the contact.
    const BY_MATERIAL: bool = false;

    /// Force against `slip` (m/s) under the normal `force` (N).
    fn pull(
        &self,
        slip: Vector,
        force: f64,
        pressed: &Pressed,
        meeting: &Meeting,
        memory: &mut Self::Memory,
    ) -> Pull;

    /// Largest tangential force (N) under the normal `force` (N).
    fn limit(&self, force: f64, meeting: &Meeting) -> f64;

    /// Makes the spring `factor` times as stiff as the material says.
    fn soften(&mut self, factor: f64);

    /// Energy held, J.
    fn energy(memory: &Self::Memory) -> f64;
}

impl Tangential for () {
    type Memory = ();
    const ACTIVE: bool = false;

    #[inline(always)]
    fn pull(&self, _: Vector, _: f64, _: &Pressed, _: &Meeting, (): &mut ()) -> Pull {
        Pull::default()
    }

    #[inline(always)]
    fn limit(&self, _: f64, _: &Meeting) -> f64 {
        0.0
    }

    fn soften(&mut self, _: f64) {}

    #[inline(always)]
    fn energy((): &()) -> f64 {
        0.0
    }
}

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

impl Tangential for Mindlin {
    type Memory = Slider;
    const ACTIVE: bool = true;

    #[inline(always)]
    fn pull(
        &self,
        slip: Vector,
        force: f64,
        pressed: &Pressed,
        meeting: &Meeting,
        memory: &mut Slider,
    ) -> Pull {
        let stiffness = if force > 0.0 {
            self.stiffness(pressed.contact_radius, meeting)
        } else {
            0.0
        };
        let slide = memory.advance(
            slip * meeting.dt,
            meeting.normal,
            stiffness,
            self.friction * force,
        );
        Pull {
            force: memory.load,
            stiffness,
            work: slide.work,
            loss: slide.loss,
        }
    }

    #[inline(always)]
    fn limit(&self, force: f64, _: &Meeting) -> f64 {
        self.friction * force
    }

    fn soften(&mut self, factor: f64) {
        self.factor = factor;
    }

    #[inline(always)]
    fn energy(memory: &Slider) -> f64 {
        memory.energy()
    }
}
