//! Contact law of the bed: the effects the scene names around a normal law, composed at compile time.
//!
//! The normal law itself is pressed before, for many contacts at once, in [`super::normal`].
//!
//! Signs: the normal points from the second body to the first, the force acts on the first.
//!
//! **Energy ledger.** Velocities live half a step before the positions, so the work a force does between two
//! evaluations is the mean of the forces of both times the slip of the step, exactly as the integrator spends it.
//! The work on the normal law, on the springs and the rest (damping) are booked apart.

use super::damping::Damping;
use super::friction::Tangential;
use super::meeting::{Losses, Meeting, Push};
use super::rolling::Rolling;
use crate::contact::pair::Pressed;
use crate::tape::Keep;
use parry3d::math::Vector;
use std::fmt::Debug;

/// Effects around a normal law, and their histories, in one.
pub trait ContactLaw: Clone + Send + Sync + 'static {
    /// What a contact remembers beside the history of its normal law.
    type Memory: Copy + Default + Send + Sync + PartialEq + Keep + Debug + 'static;
    /// Whether the law can turn bodies.
    const ROTATES: bool;
    /// Whether the law asks for the materials of a meeting.
    const BY_MATERIAL: bool;

    /// Push of this step, and the energy dissipated since the push of the step before, `before`.
    fn push(
        &self,
        meeting: &Meeting,
        pressed: &Pressed,
        before: &Push,
        memory: &mut Self::Memory,
    ) -> (Push, Losses);

    /// Rolling moment on the first body, N m.
    fn moment(memory: &Self::Memory) -> Vector;

    /// Energy in the springs, J.
    fn springs(memory: &Self::Memory) -> f64;

    /// Work put into the normal law so far, J: what is not recoverable has gone into plastic flow.
    fn work(memory: &Self::Memory) -> f64;

    /// Books energy (J) that a change of the law itself, not motion, put into the contact.
    fn book_work(memory: &mut Self::Memory, work: f64);

    /// Contact stiffness over that of the material.
    fn softening(&self) -> f64;

    /// Makes contacts `factor` times as stiff as the material's, springs included.
    fn soften(&mut self, factor: f64);
}

/// Damping `D`, tangential law `T` and rolling resistance `R` around any normal law; `()` is no effect, at no cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Law<D = (), T = (), R = ()> {
    damping: D,
    tangential: T,
    rolling: R,
    /// Contact stiffness over that of the material.
    softening: f64,
}

/// What a contact of a [`Law`] remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory<D, T, R> {
    /// Force of the normal law alone, where damping acts beside it.
    pub damping: D,
    /// Tangential spring.
    pub tangential: T,
    /// Rolling spring.
    pub rolling: R,
    /// Work put into the normal law, J.
    pub work: f64,
}

impl<D, T, R> Law<D, T, R> {
    /// Effects as given, at the material's full stiffness.
    #[must_use]
    pub fn new(damping: D, tangential: T, rolling: R) -> Self {
        Self {
            damping,
            tangential,
            rolling,
            softening: 1.0,
        }
    }
}

impl<D: Damping, T: Tangential, R: Rolling> ContactLaw for Law<D, T, R> {
    type Memory = Memory<D::Memory, T::Memory, R::Memory>;
    const ROTATES: bool = T::ACTIVE || R::ACTIVE;
    const BY_MATERIAL: bool = D::BY_MATERIAL || T::BY_MATERIAL || R::BY_MATERIAL;

    #[inline(always)]
    fn push(
        &self,
        meeting: &Meeting,
        pressed: &Pressed,
        before: &Push,
        memory: &mut Self::Memory,
    ) -> (Push, Losses) {
        let m = meeting;
        let pressed = Pressed {
            force: pressed.force * self.softening,
            stiffness: pressed.stiffness * self.softening,
            ..*pressed
        };
        let approach = -m.velocity.dot(m.normal);
        let passing = m.velocity + m.normal * approach;
        let mut normal_force = pressed.force;
        self.damping
            .add_to(&mut normal_force, approach, &pressed, m);

        let arms = lever_arms(m, &pressed);
        let mut tangential = Vector::ZERO;
        let mut losses = Losses::default();
        let mut spring_work = 0.0;
        let mut slip = Vector::ZERO;
        if T::ACTIVE {
            let turning = m.spins[0] * arms[0] + m.spins[1] * arms[1];
            slip = passing - turning.cross(m.normal);
            let pull =
                self.tangential
                    .pull(slip, normal_force, &pressed, m, &mut memory.tangential);
            losses.friction = pull.loss;
            spring_work = pull.work;
            tangential = pull.force;
            let limit = self.tangential.limit(normal_force, m);
            self.damping
                .add_slip_to(&mut tangential, slip, pull.stiffness, m, limit);
        }
        if R::ACTIVE {
            losses.rolling = self
                .rolling
                .resist(normal_force, &pressed, m, &mut memory.rolling);
        }
        let past = Past::of(m, before, approach, passing);
        let law_before = D::law_force(&memory.damping, past.normal_force);
        let law_work = 0.5 * m.dt * (law_before * past.approach + pressed.force * approach);
        memory.work += law_work;
        if D::ACTIVE {
            D::remember(&mut memory.damping, pressed.force);
            let normal_work = past.normal_force * past.approach + normal_force * approach;
            let spent = 0.5 * m.dt * (normal_work - (past.tangential + tangential).dot(slip));
            losses.damping = spent - law_work - spring_work;
        }
        if m.overlap <= 0.0 {
            return (Push::default(), losses);
        }
        let force = m.normal * normal_force + tangential;
        let couple = if T::ACTIVE {
            force.cross(m.normal)
        } else {
            Vector::ZERO
        };
        (
            Push {
                force,
                couple,
                arms,
            },
            losses,
        )
    }

    #[inline(always)]
    fn moment(memory: &Self::Memory) -> Vector {
        R::moment(&memory.rolling)
    }

    fn springs(memory: &Self::Memory) -> f64 {
        T::energy(&memory.tangential) + R::energy(&memory.rolling)
    }

    fn work(memory: &Self::Memory) -> f64 {
        memory.work
    }

    fn book_work(memory: &mut Self::Memory, work: f64) {
        memory.work += work;
    }

    fn softening(&self) -> f64 {
        self.softening
    }

    fn soften(&mut self, factor: f64) {
        self.softening = factor;
        self.tangential.soften(factor);
        self.rolling.soften(factor);
    }
}

/// The push of the step before, split along the normal it had then.
struct Past {
    normal_force: f64,
    tangential: Vector,
    /// Rate of approach of this step's motion along that normal.
    approach: f64,
}

impl Past {
    #[inline(always)]
    fn of(m: &Meeting, before: &Push, approach: f64, passing: Vector) -> Self {
        let turn = passing * (m.dt * m.inverse_distance);
        let normal = m.normal - turn;
        let normal_force = before.force.dot(normal);
        Self {
            normal_force,
            tangential: before.force - normal * normal_force,
            approach: approach + passing.dot(turn),
        }
    }
}

/// Distances from the centres to the point of contact; none for a surface, whose turning is in its velocity.
#[inline(always)]
fn lever_arms(m: &Meeting, pressed: &Pressed) -> [f64; 2] {
    let second = if m.radii[1].is_finite() {
        m.radii[1] - pressed.flattening[1]
    } else {
        0.0
    };
    [m.radii[0] - pressed.flattening[0], second]
}
