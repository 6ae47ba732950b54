//! Friction: springs that slide at a limit, for tangential force and rolling moment.

use super::law::Meeting;
use crate::contact::pair::Pressed;
use crate::material::Material;
use crate::tape::Keep;
use parry3d::math::Vector;
use std::fmt::Debug;

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
