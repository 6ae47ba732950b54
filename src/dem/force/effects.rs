//! Contact law of the bed: a list of effects around a normal law, composed at compile time.
//!
//! The normal law itself is pressed before, for many contacts at once, in [`super::normal`]. What an effect is: [`Effect`];
//! which there are: `super::list`.
//!
//! Signs: the normal points from the second body to the first, the force acts on the first.
//!
//! **One time.** Velocities live half a step before the positions. Slip, rolling and approach are therefore measured along the
//! normal of that time, `Meeting::middle`: seen along the present normal, a grain that rolls slips by part of its spin about
//! the line of centres, always to the same side, and never rolls off. What springs hold turns with the normal.
//!
//! **Energy ledger.** The work a force does between two evaluations is the mean of the forces of both times the slip of the
//! step between, as the integrator spends it. Each effect
//! books what it dissipates and tells what it stores; the normal law tells both from its own state. Nothing is booked as what
//! is left over: that is the imbalance.

use super::edge::{edge, weight};
use super::losses::Losses;
use super::meeting::{Meeting, Push};
use crate::contact::pair::Pressed;
use crate::document::keys::Line;
use crate::material::Material;
use crate::tape::{Keep, keep_fields};
use parry3d::math::Vector;
use std::fmt::Debug;

/// Something that acts in a contact beside the normal law, with a memory, a stored and a lost energy of its own.
pub trait Effect: Clone + Send + Sync + 'static {
    /// What a contact remembers of it; all default while apart.
    type Memory: Copy + Default + Send + Sync + PartialEq + Keep + Debug + 'static;
    /// Whether it pushes across the normal.
    const ACROSS: bool;
    /// Whether it has a moment of its own ([`Effect::moment`]).
    const MOMENT: bool;
    /// Whether it depends on the materials of the contact.
    const BY_MATERIAL: bool = false;

    /// Acts in `contact`, on what the effects before it have made of the force, and books what is dissipated. Called once more
    /// after the bodies have come apart, with a normal law that is all zero.
    fn act(&self, contact: &mut Contact, memory: &mut Self::Memory, losses: &mut Losses);

    /// Moment on the first body, N m.
    fn moment(memory: &Self::Memory) -> Vector;

    /// Energy stored, J.
    fn stored(memory: &Self::Memory) -> f64;

    /// Makes its springs `factor` times as stiff as the material's.
    fn soften(&mut self, factor: f64);
}

/// An effect as scenes name it, by one constant.
pub trait Named: Effect {
    /// Its key in the reference: what it means, its range, a value.
    const LINE: Line;
    /// What its constant must be, for messages.
    const MUST: &'static str;
    /// What there is without it, for messages: "leave it out for ...".
    const WITHOUT: &'static str;
    /// Key of the effect without which it cannot be, and why.
    const NEEDS: Option<(&'static str, &'static str)>;

    /// Whether the constant is as it must be.
    fn allows(constant: f64) -> bool;

    /// Effect among grains of `material` and rigid bodies.
    fn of(constant: f64, material: &Material) -> Self;

    /// Effect between two bodies of these materials, rigid ones if none.
    fn between(constant: f64, materials: [Option<&Material>; 2]) -> Self;
}

/// A contact in one step, and what acts in it so far.
pub struct Contact<'a> {
    /// The two bodies.
    pub meeting: &'a Meeting,
    /// The normal law.
    pub pressed: Pressed,
    /// Push of the step before.
    pub before: &'a Push,
    /// Unit normal in the middle of the step.
    pub middle: Vector,
    /// Rate of approach along it, m/s.
    pub approach: f64,
    /// Relative velocity of the centres across it, m/s.
    pub passing: Vector,
    /// Distances from the centres to the point of contact, m; none for a surface, whose turning is in its velocity.
    pub arms: [f64; 2],
    /// Part of the step past since first touch, or left until they part; infinite within a contact.
    pub edge: f64,
    /// Normal force so far, N; that of the law stands for the whole step.
    pub normal_force: f64,
    /// Force across the normal so far, N.
    pub across: Vector,
    /// What springs across the normal are damped by, times the root of effective mass and stiffness; 0: not at all.
    pub dashpot: f64,
}

impl Contact<'_> {
    /// Relative velocity of the touching points across the normal, m/s.
    #[inline(always)]
    #[must_use]
    pub fn slip(&self) -> Vector {
        let m = self.meeting;
        let turning = m.spins[0] * self.arms[0] + m.spins[1] * self.arms[1];
        // over the distance of that time, to which the arms are scaled with it
        self.passing - turning.cross(m.middle)
    }

    /// A vector laid across the present normal.
    #[inline(always)]
    #[must_use]
    pub fn laid_across(&self, vector: Vector) -> Vector {
        let normal = self.meeting.normal;
        vector - normal * vector.dot(normal)
    }

    /// Power (W) of the force across the normal of the step before at this `slip` (m/s), which is laid across the present one.
    #[inline(always)]
    #[must_use]
    pub fn past_power(&self, slip: Vector) -> f64 {
        // what of the force before is not across the present normal is across the slip
        let before = self.before.force;
        let pushed = before - self.middle * (2.0 * before.dot(self.middle));
        pushed.dot(slip)
    }

    /// A vector across the normal of the step before, turned with the contact: as the normal has turned, and about it by what
    /// both bodies turned in the mean.
    ///
    /// A reflection across the plane of the middle turns such a vector by twice its angle to that plane, and keeps its length.
    /// What is not across the present normal, by rounding or where another normal came before, is taken off.
    #[inline(always)]
    #[must_use]
    pub fn turned(&self, vector: Vector) -> Vector {
        let m = self.meeting;
        let turned = vector - self.middle * (2.0 * vector.dot(self.middle));
        let across = self.laid_across(turned);
        let twist = 0.5 * m.dt * (m.spins[0] + m.spins[1]).dot(self.middle);
        across * (1.0 - 0.5 * twist * twist) + m.normal.cross(across) * twist
    }
}

/// Effects in the order in which they act: `()`, `((), A)`, `(((), A), B)` and so on.
pub trait EffectList: Clone + Send + Sync + 'static {
    /// What a contact remembers of them.
    type Memory: Copy + Default + Send + Sync + PartialEq + Keep + Debug + 'static;
    /// Whether one of them pushes across the normal.
    const ACROSS: bool;
    /// Whether one of them has a moment of its own.
    const MOMENT: bool;
    /// Whether one of them depends on the materials of the contact.
    const BY_MATERIAL: bool;

    /// See [`Effect::act`].
    fn act(&self, contact: &mut Contact, memory: &mut Self::Memory, losses: &mut Losses);
    /// Moment of all on the first body, N m.
    fn moment(memory: &Self::Memory) -> Vector;
    /// Energy stored by all, J.
    fn stored(memory: &Self::Memory) -> f64;
    /// See [`Effect::soften`].
    fn soften(&mut self, factor: f64);
}

impl EffectList for () {
    type Memory = ();
    const ACROSS: bool = false;
    const MOMENT: bool = false;
    const BY_MATERIAL: bool = false;

    #[inline(always)]
    fn act(&self, _: &mut Contact, (): &mut (), _: &mut Losses) {}

    #[inline(always)]
    fn moment((): &()) -> Vector {
        Vector::ZERO
    }

    #[inline(always)]
    fn stored((): &()) -> f64 {
        0.0
    }

    fn soften(&mut self, _: f64) {}
}

impl<L: EffectList, E: Effect> EffectList for (L, E) {
    type Memory = (L::Memory, E::Memory);
    const ACROSS: bool = L::ACROSS || E::ACROSS;
    const MOMENT: bool = L::MOMENT || E::MOMENT;
    const BY_MATERIAL: bool = L::BY_MATERIAL || E::BY_MATERIAL;

    #[inline(always)]
    fn act(&self, contact: &mut Contact, memory: &mut Self::Memory, losses: &mut Losses) {
        self.0.act(contact, &mut memory.0, losses);
        self.1.act(contact, &mut memory.1, losses);
    }

    #[inline(always)]
    fn moment(memory: &Self::Memory) -> Vector {
        match (L::MOMENT, E::MOMENT) {
            (true, true) => L::moment(&memory.0) + E::moment(&memory.1),
            (false, true) => E::moment(&memory.1),
            (_, false) => L::moment(&memory.0),
        }
    }

    #[inline(always)]
    fn stored(memory: &Self::Memory) -> f64 {
        L::stored(&memory.0) + E::stored(&memory.1)
    }

    fn soften(&mut self, factor: f64) {
        self.0.soften(factor);
        self.1.soften(factor);
    }
}

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

    /// Moment on the first body beside that of the push, N m.
    fn moment(memory: &Self::Memory) -> Vector;

    /// Energy the effects store, J.
    fn stored(memory: &Self::Memory) -> f64;

    /// Energy (J) that plastic flow has dissipated here beside what the normal law's history tells.
    fn flowed(memory: &Self::Memory) -> f64;

    /// Books such energy (J), of a contact that is over or was there before the account began.
    fn book_flow(memory: &mut Self::Memory, energy: f64);

    /// Contact stiffness over that of the material.
    fn softening(&self) -> f64;

    /// Makes contacts `factor` times as stiff as the material's, springs included.
    fn soften(&mut self, factor: f64);
}

/// The effects `L` around any normal law.
///
/// ```
/// use impactlaw::dem::force::damping::Viscous;
/// use impactlaw::dem::force::effects::Law;
/// let smooth = Law::smooth();
/// let damped = smooth.with(Viscous::new(0.8));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Law<L = ()> {
    effects: L,
    /// Contact stiffness over that of the material.
    softening: f64,
}

/// What a contact of a [`Law`] remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory<M> {
    /// Of its effects.
    pub effects: M,
    /// Energy plastic flow has dissipated beside what the history of the normal law tells, J.
    pub flowed: f64,
}
keep_fields!(impl [M: Keep] Memory<M>: effects, flowed);

impl Law {
    /// No effects, at the material's full stiffness.
    #[must_use]
    pub fn smooth() -> Self {
        Self::new(())
    }
}

impl<L> Law<L> {
    /// Effects as listed, at the material's full stiffness.
    #[must_use]
    pub fn new(effects: L) -> Self {
        Self {
            effects,
            softening: 1.0,
        }
    }

    /// The same with one effect more, which acts after the others; order: `super::list`.
    #[must_use]
    pub fn with<E>(self, effect: E) -> Law<(L, E)> {
        Law {
            effects: (self.effects, effect),
            softening: self.softening,
        }
    }
}

impl<L: EffectList> ContactLaw for Law<L> {
    type Memory = Memory<L::Memory>;
    const ROTATES: bool = L::ACROSS || L::MOMENT;
    const BY_MATERIAL: bool = L::BY_MATERIAL;

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
        let middle = m.middle * inverse_root_near_one(m.middle.length_squared());
        let approach = -m.velocity.dot(middle);
        let edge = edge(&pressed, approach, m.inverse_mass, m.dt, before.touches());
        let mut normal_force = pressed.force;
        if edge <= 1.0 {
            normal_force *= weight(pressed.stiffness * pressed.depth / pressed.force, edge);
        }
        let mut contact = Contact {
            meeting,
            pressed,
            before,
            middle,
            approach,
            passing: m.velocity + middle * approach,
            arms: lever_arms(m, &pressed),
            edge,
            normal_force,
            across: Vector::ZERO,
            dashpot: 0.0,
        };
        let mut losses = Losses::default();
        self.effects
            .act(&mut contact, &mut memory.effects, &mut losses);
        if m.overlap <= 0.0 {
            return (Push::default(), losses);
        }
        let force = m.normal * contact.normal_force + contact.across;
        let couple = if L::ACROSS {
            force.cross(m.normal)
        } else {
            Vector::ZERO
        };
        let arms = contact.arms;
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
        L::moment(&memory.effects)
    }

    fn stored(memory: &Self::Memory) -> f64 {
        L::stored(&memory.effects)
    }

    fn flowed(memory: &Self::Memory) -> f64 {
        memory.flowed
    }

    fn book_flow(memory: &mut Self::Memory, energy: f64) {
        memory.flowed += energy;
    }

    fn softening(&self) -> f64 {
        self.softening
    }

    fn soften(&mut self, factor: f64) {
        self.softening = factor;
        self.effects.soften(factor);
    }
}

/// $1/\sqrt{x}$ of a length that a step changes little, without a root and a division: two terms of the series and a step of
/// Newton's method, right to rounding.
#[inline(always)]
fn inverse_root_near_one(x: f64) -> f64 {
    let off = x - 1.0;
    if off.abs() > 1e-3 {
        return 1.0 / x.sqrt();
    }
    let near = 1.0 - off * (0.5 - 0.375 * off);
    near * (1.5 - 0.5 * x * near * near)
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
