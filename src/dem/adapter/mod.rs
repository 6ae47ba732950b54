//! Adapter: the contact laws of the bed between bodies of any rapier scene.
//!
//! rapier's own contacts are constraints and carry no force law. Colliders given to [`Ruled::rule`] no longer push
//! each other through rapier's solver: before every step the law's forces are worked out from where they are and handed
//! to rapier as forces. Everything else of the scene (joints, motors, other contacts, forces of the user) stays
//! rapier's. Made for tens of bodies; for beds of grains, [`crate::dem::dynamics::Bed`] is 20 to 40 times faster.
//!
//! ```
//! use impactlaw::dem::adapter::Ruled;
//! use impactlaw::dem::force::effects::Law;
//! use impactlaw::theory::hertz::Hertz;
//! use rapier3d::prelude::*;
//!
//! // A ball of 1 mm dropped onto a fixed block at 1 m/s, under Hertz's law with E* = 50 MPa.
//! let mut world = PhysicsWorld::new();
//! world.gravity = Vector::ZERO;
//! let block = ColliderBuilder::cuboid(0.01, 0.01, 0.01);
//! let (_, block) = world.insert(RigidBodyBuilder::fixed().translation(Vector::new(0.0, 0.0, -0.01)), block);
//! let falling = RigidBodyBuilder::dynamic()
//!     .translation(Vector::new(0.0, 0.0, 1.1e-3))
//!     .linvel(Vector::new(0.0, 0.0, -1.0));
//! let (ball, shell) = world.insert(falling, ColliderBuilder::ball(1e-3).density(2500.0));
//!
//! let mut laws = Ruled::new(Hertz::new(5e7), Law::smooth(), 1e-3, &mut world);
//! laws.rule(&mut world, block)?;
//! laws.rule(&mut world, shell)?;
//! for _ in 0..1000 {
//!     laws.step(&mut world, 5e-7)?;
//! }
//! // An elastic law gives the speed back.
//! assert!((world.bodies[ball].linvel().z - 1.0).abs() < 1e-3);
//! # Ok::<(), impactlaw::Error>(())
//! ```

use crate::contact::NormalLaw;
use crate::contact::pair::{Alike, Flat, Press, Pressed};
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use crate::dem::force::meeting::Push;
use crate::{Error, Result};
use parry3d::math::Vector;
use rapier3d::dynamics::{IntegrationParameters, RigidBodyActivation, RigidBodyHandle};
use rapier3d::geometry::{ColliderHandle, Group, InteractionGroups};
use rapier3d::pipeline::PhysicsWorld;
use std::collections::BTreeMap;

mod near;

use near::{Near, meeting};

/// The one solver group of the colliders under the law, and the one they do not meet in rapier's solver.
const RULED: Group = Group::GROUP_32;

/// Name of a collider that can be put in order.
type Key = (u32, u32);

fn key(collider: ColliderHandle) -> Key {
    collider.into_raw_parts()
}

/// A collider under the law.
#[derive(Debug, Clone, Copy)]
struct Subject {
    body: RigidBodyHandle,
    collider: ColliderHandle,
    /// Radius of curvature where it is touched, m; infinite for a flat one, which is then rigid.
    radius: f64,
    ball: bool,
}

/// A contact under way.
#[derive(Debug, Clone, Copy)]
struct Touching<H, M> {
    history: H,
    memory: M,
    push: Push,
    normal: Vector,
    overlap: f64,
    radii: [f64; 2],
}

/// Force and torque (about the centre of mass) of the law on a body.
#[derive(Debug, Clone, Copy, Default)]
struct Load {
    force: Vector,
    torque: Vector,
}

/// Bodies of a rapier scene that touch under the normal law `L` with the effects `C`.
///
/// Two balls, or a ball and any shape, touch as in the bed. Two other shapes touch at the one pair of points nearest
/// to each other, with the radii of curvature given by [`Ruled::rule_curved`]: right for convex bodies that meet at one
/// place, not for a block lying flat on another. Rolling resistance acts on balls.
pub struct Ruled<L: NormalLaw, C: ContactLaw> {
    pair: Alike<L>,
    wall: Flat<L>,
    effects: C,
    subjects: BTreeMap<Key, Subject>,
    touching: BTreeMap<[Key; 2], Touching<L::History, C::Memory>>,
    losses: Losses,
    /// Energy plastic flow has dissipated in contacts that are over, J.
    flowed: f64,
    seen: bool,
}

/// Settings without which rapier spoils a force law, for bodies of about `radius` (m).
///
/// | setting | why |
/// |---|---|
/// | length unit: the radius | margins of rapier's pairs are parts of it |
/// | one solver iteration | with more, a force constant over the step breaks the symplectic integrator: +9 % energy with 4 |
/// | no contact recycling, no clustering | they freeze or move points of contact |
/// | no continuous collision | it stops fast bodies at each other's surface |
/// | no cap on speed | the cap counts length units: 400 a second |
pub fn tame(settings: &mut IntegrationParameters, radius: f64) {
    settings.length_unit = radius;
    settings.num_solver_iterations = 1;
    settings.max_ccd_substeps = 0;
    settings.contact_recycling = false;
    settings.contact_clustering = false;
    settings.normalized_max_linear_velocity = f64::MAX;
}

impl<L: NormalLaw, C: ContactLaw> Ruled<L, C> {
    /// No bodies under the law yet; sets up `world` by [`tame`] for bodies of about `radius` (m).
    #[must_use]
    pub fn new(normal: L, effects: C, radius: f64, world: &mut PhysicsWorld) -> Self {
        tame(&mut world.integration_parameters, radius);
        Self {
            pair: Alike(normal.clone()),
            wall: Flat(normal),
            effects,
            subjects: BTreeMap::new(),
            touching: BTreeMap::new(),
            losses: Losses::default(),
            flowed: 0.0,
            seen: false,
        }
    }

    /// Puts a collider under the law: a ball with its radius, anything else as a rigid flat.
    ///
    /// # Errors
    /// [`Error::Bodies`] when the collider belongs to no body or is not there.
    pub fn rule(&mut self, world: &mut PhysicsWorld, collider: ColliderHandle) -> Result<()> {
        let shape = world
            .colliders
            .get(collider)
            .map(|c| c.shared_shape().clone());
        let ball = shape.and_then(|shape| shape.as_ball().map(|ball| ball.radius));
        self.subject(
            world,
            collider,
            ball.unwrap_or(f64::INFINITY),
            ball.is_some(),
        )
    }

    /// Puts a collider of any shape under the law, with the `radius` of curvature (m) it has where it will be touched.
    ///
    /// # Errors
    /// As [`Ruled::rule`], and when the radius is not positive.
    pub fn rule_curved(
        &mut self,
        world: &mut PhysicsWorld,
        collider: ColliderHandle,
        radius: f64,
    ) -> Result<()> {
        if !(radius > 0.0) {
            return Err(stop(format!(
                "a radius of curvature of {radius} m was given; it must be positive"
            )));
        }
        self.subject(world, collider, radius, false)
    }

    fn subject(
        &mut self,
        world: &mut PhysicsWorld,
        collider: ColliderHandle,
        radius: f64,
        ball: bool,
    ) -> Result<()> {
        let Some(part) = world.colliders.get_mut(collider) else {
            return Err(stop(
                "a collider that is not in the scene was put under a law".to_owned(),
            ));
        };
        let Some(body) = part.parent() else {
            return Err(stop(
                "a collider without a body was put under a law; attach it to a fixed body"
                    .to_owned(),
            ));
        };
        let groups = part.solver_groups();
        part.set_solver_groups(InteractionGroups::new(
            RULED,
            groups.filter & !RULED,
            groups.test_mode,
        ));
        if let Some(body) = world.bodies.get_mut(body) {
            *body.activation_mut() = RigidBodyActivation::cannot_sleep();
        }
        let subject = Subject {
            body,
            collider,
            radius,
            ball,
        };
        self.subjects.insert(key(collider), subject);
        self.seen = false;
        Ok(())
    }

    /// One step of `dt` (s) of the whole scene.
    ///
    /// # Errors
    /// [`Error::Bodies`] when two rigid flats touch, or a place is no longer a number.
    pub fn step(&mut self, world: &mut PhysicsWorld, dt: f64) -> Result<()> {
        if !self.seen {
            // a step of no length only finds the pairs
            world.integration_parameters.dt = 0.0;
            world.step();
            self.seen = true;
        }
        let mut loads = BTreeMap::new();
        for near in self.near(world) {
            self.meet(world, near, dt, &mut loads)?;
        }
        let before: Vec<(RigidBodyHandle, Load)> = loads
            .keys()
            .filter_map(|&name| {
                let handle = RigidBodyHandle::from_raw_parts(name.0, name.1);
                let body = world.bodies.get(handle)?;
                Some((
                    handle,
                    Load {
                        force: body.user_force(),
                        torque: body.user_torque(),
                    },
                ))
            })
            .collect();
        for (&name, load) in &loads {
            let handle = RigidBodyHandle::from_raw_parts(name.0, name.1);
            if let Some(body) = world.bodies.get_mut(handle) {
                body.add_force(load.force, false);
                body.add_torque(load.torque, false);
            }
        }
        world.integration_parameters.dt = dt;
        world.step();
        // forces added to a rapier body stay: the law's are taken off again, the user's are put back to the bit
        for (handle, load) in before {
            if let Some(body) = world.bodies.get_mut(handle) {
                body.reset_forces(false);
                body.reset_torques(false);
                body.add_force(load.force, false);
                body.add_torque(load.torque, false);
            }
        }
        match world.quarantine().is_empty() {
            true => Ok(()),
            false => Err(stop(
                "a body's place is no longer a number; reduce the time step".to_owned(),
            )),
        }
    }

    /// Calls the law for a pair and adds its loads.
    fn meet(
        &mut self,
        world: &PhysicsWorld,
        near: Near,
        dt: f64,
        loads: &mut BTreeMap<Key, Load>,
    ) -> Result<()> {
        let (first, second) = (near.first, near.second);
        let [name_a, name_b] = [first, second].map(|subject| key(subject.collider));
        let names = [name_a.min(name_b), name_a.max(name_b)];
        if first.radius.is_infinite() {
            return Err(stop(
                "two rigid flats touch; give one a radius of curvature (`rule_curved`)".to_owned(),
            ));
        }
        let mut held = self.touching.remove(&names).unwrap_or(Touching {
            history: L::History::default(),
            memory: C::Memory::default(),
            push: Push::default(),
            normal: near.normal,
            overlap: 0.0,
            radii: [first.radius, second.radius],
        });
        let meeting = meeting(world, &near, dt);
        let pressed = match near.overlap > 0.0 {
            false => Pressed::default(),
            true if second.radius.is_finite() => {
                self.pair
                    .press(near.overlap, meeting.radii, &mut held.history)
            }
            true => self
                .wall
                .press(near.overlap, meeting.radii, &mut held.history),
        };
        let (push, losses) = self
            .effects
            .push(&meeting, &pressed, &held.push, &mut held.memory);
        self.losses += losses;
        if near.overlap <= 0.0 {
            self.flowed += self.flowed(&held);
            return Ok(());
        }
        self.load(world, &near, &push, C::moment(&held.memory), loads);
        held.push = push;
        held.normal = near.normal;
        held.overlap = near.overlap;
        self.touching.insert(names, held);
        Ok(())
    }

    fn load(
        &self,
        world: &PhysicsWorld,
        near: &Near,
        push: &Push,
        moment: Vector,
        loads: &mut BTreeMap<Key, Load>,
    ) {
        for (side, subject, sign) in [(0, near.first, 1.0), (1, near.second, -1.0)] {
            let Some(body) = world.bodies.get(subject.body) else {
                continue;
            };
            // a ball is pushed in its centre and turned by the couple; any other body is pushed where it is touched
            let (place, couple) = match (subject.ball, world.colliders.get(subject.collider)) {
                (true, Some(ball)) => (ball.translation(), push.couple * push.arms[side]),
                _ => (near.point, Vector::ZERO),
            };
            let torque = couple + sign * (place - body.center_of_mass()).cross(push.force);
            let load = loads.entry(subject.body.into_raw_parts()).or_default();
            load.force += sign * push.force;
            load.torque += torque + sign * moment;
        }
    }

    /// Contacts under way.
    #[must_use]
    pub fn contacts(&self) -> usize {
        self.touching.len()
    }

    /// Energy dissipated by effects so far; plastic flow is told by [`Ruled::plastic`].
    #[must_use]
    pub fn losses(&self) -> Losses {
        self.losses
    }

    /// Recoverable energy in normal contact, J.
    #[must_use]
    pub fn elastic(&self) -> f64 {
        let energy = |held: &Touching<L::History, C::Memory>| match held.radii[1].is_finite() {
            true => self
                .pair
                .elastic_energy(held.overlap, held.radii, &held.history),
            false => self
                .wall
                .elastic_energy(held.overlap, held.radii, &held.history),
        };
        self.touching.values().map(energy).sum()
    }

    /// Energy dissipated by plastic flow, J.
    #[must_use]
    pub fn plastic(&self) -> f64 {
        let now: f64 = self.touching.values().map(|held| self.flowed(held)).sum();
        self.flowed + now
    }

    /// Energy plastic flow has dissipated in a contact, J.
    fn flowed(&self, held: &Touching<L::History, C::Memory>) -> f64 {
        let dissipated = match held.radii[1].is_finite() {
            true => self.pair.dissipated(held.radii, &held.history),
            false => self.wall.dissipated(held.radii, &held.history),
        };
        C::flowed(&held.memory) + self.effects.softening() * dissipated
    }
}

fn stop(reason: String) -> Error {
    Error::Bodies { reason }
}
