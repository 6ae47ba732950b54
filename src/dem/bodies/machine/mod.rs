//! Machine: everything that is not a grain, as rapier bodies; nothing outside this folder names rapier.
//!
//! rapier moves bodies (gravity, joints, driven motion), grains press on them, and rapier's own contacts are off.
//! Its tolerances are absolute lengths meant for metres, so that inside this file lengths count grain radii; masses
//! and times stay SI. Everything that comes out is SI.

mod drive;
mod encounter;
mod joint;

pub use drive::BodyState;
pub use encounter::Fall;

use crate::Result;
use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::{Body, Freedom, Mobility};
use drive::{Drive, Mode};
use joint::Tie;
use parry3d::math::{Pose, Vector};
use parry3d::shape::SharedShape;
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::{ColliderBuilder, InteractionGroups};
use rapier3d::pipeline::PhysicsWorld;

/// A body as the grains meet it, at the time of the positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Centre of mass, m.
    pub centre: Vector,
    /// Velocity of the centre of mass half a step before, m/s.
    pub velocity: Vector,
    /// Angular velocity half a step before, rad/s.
    pub spin: Vector,
    /// 1/kg; 0 for a body that does not yield to forces.
    pub inverse_mass: f64,
    /// Moves as told: what it does to the grains is work from outside.
    pub driven: bool,
    /// How its surface moves beside the body: work from outside too.
    pub belt: Option<Belt>,
}

impl Station {
    /// Velocity (m/s) of the surface at a point (m) with a unit normal.
    #[inline(always)]
    #[must_use]
    pub fn surface_velocity(&self, point: Vector, normal: Vector) -> Vector {
        let velocity = self.velocity + self.spin.cross(point - self.centre);
        match &self.belt {
            None => velocity,
            Some(belt) => velocity + belt.at(point, normal),
        }
    }

    /// The same half a step of `dt` (s) before, the time of its velocities.
    #[inline(always)]
    #[must_use]
    pub fn half_before(&self, dt: f64) -> Self {
        Self {
            centre: self.centre - self.velocity * (0.5 * dt),
            ..*self
        }
    }

    /// Angular velocity (rad/s) of the surface.
    #[inline(always)]
    #[must_use]
    pub fn surface_spin(&self) -> Vector {
        self.belt.map_or(self.spin, |belt| self.spin + belt.spin)
    }
}

/// Surface of a body: lengths in the machine's unit.
#[derive(Clone)]
pub struct Surface {
    /// Shape.
    pub shape: SharedShape,
    /// Place and orientation of the shape.
    pub pose: Pose,
    /// Taken out of the bed: it touches nothing any more.
    pub removed: bool,
}

/// Force and torque of the grains on a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Force, N.
    pub force: Vector,
    /// Torque about the centre of mass, N m.
    pub torque: Vector,
    /// Power of its belt on the grains, W.
    pub power: f64,
}

/// The bodies of a scene.
pub struct Machine {
    world: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
    bodies: Vec<Body>,
    drives: Vec<Drive>,
    modes: Vec<Mode>,
    ties: Vec<Option<Tie>>,
    pub(in crate::dem) time: f64,
    pub(in crate::dem) motors: f64,
    /// Unit of length, m: a grain radius.
    pub unit: f64,
    /// Bodies as the grains meet them; one for each body of the scene, in its order.
    pub stations: Vec<Station>,
    /// Surfaces, one for each body.
    pub surfaces: Vec<Surface>,
    /// Material of each body, none if rigid.
    pub materials: Vec<Option<u8>>,
}

impl Machine {
    /// Puts `bodies` into a world with `gravity` (m/s2); `unit` (m) is a grain radius.
    ///
    /// # Errors
    /// As [`crate::dem::bodies::Solid::shape`].
    pub fn new(bodies: Vec<Body>, gravity: Vector, unit: f64) -> Result<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = gravity / unit;
        tame(&mut world);
        let mut machine = Self {
            world,
            handles: Vec::new(),
            bodies: Vec::new(),
            drives: Vec::new(),
            modes: Vec::new(),
            ties: Vec::new(),
            time: 0.0,
            motors: 0.0,
            unit,
            stations: Vec::new(),
            surfaces: Vec::new(),
            materials: Vec::new(),
        };
        for body in bodies {
            machine.add(body)?;
        }
        machine.view();
        Ok(machine)
    }

    /// rapier's body for `body` of this shape.
    fn builder(&self, body: &Body, shape: &SharedShape) -> RigidBodyBuilder {
        let builder = match body.mobility {
            Mobility::Fixed | Mobility::Belt(_) => RigidBodyBuilder::fixed(),
            Mobility::Driven(_) => RigidBodyBuilder::kinematic_velocity_based(),
            Mobility::Free(Freedom {
                mass,
                velocity,
                spin,
                ..
            }) => {
                let mut properties = shape.mass_properties(1.0);
                properties.set_mass(mass, true);
                RigidBodyBuilder::dynamic()
                    .additional_mass_properties(properties)
                    .linvel(velocity / self.unit)
                    .angvel(spin)
            }
        };
        builder.can_sleep(false).allow_fast_rotation(true)
    }

    fn add(&mut self, body: Body) -> Result<()> {
        let shape = body.solid.shape(self.unit)?;
        let pose = Pose::from_parts(body.centre / self.unit, body.rotation);
        let builder = self.builder(&body, &shape).pose(pose);
        let collider = ColliderBuilder::new(shape.clone())
            .density(0.0)
            .collision_groups(InteractionGroups::none())
            .solver_groups(InteractionGroups::none());
        let (handle, _) = self.world.insert(builder, collider);
        let tie = self.tie(&body, handle);
        self.ties.push(tie);
        self.world.bodies[handle].recompute_mass_properties_from_colliders(&self.world.colliders);
        self.stations.push(Station {
            centre: Vector::ZERO,
            velocity: Vector::ZERO,
            spin: Vector::ZERO,
            inverse_mass: match body.mobility {
                Mobility::Free(freedom) => 1.0 / freedom.mass,
                _ => 0.0,
            },
            driven: matches!(body.mobility, Mobility::Driven(_)),
            belt: match body.mobility {
                Mobility::Belt(belt) => Some(belt),
                Mobility::Fixed | Mobility::Driven(_) | Mobility::Free(_) => None,
            },
        });
        self.surfaces.push(Surface {
            shape,
            pose,
            removed: false,
        });
        self.materials.push(body.material);
        self.handles.push(handle);
        self.drives.push(Drive::default());
        self.modes.push(Mode::Usual);
        let index = self.bodies.len();
        let mobility = body.mobility;
        self.bodies.push(body);
        match mobility {
            Mobility::Driven(motion) => self.drive_as(index, motion),
            Mobility::Free(freedom) if freedom.held => self.set_mode(index, Mode::Held),
            _ => {}
        }
        Ok(())
    }

    /// Reads places and velocities off rapier.
    pub fn view(&mut self) {
        for ((&handle, station), surface) in self
            .handles
            .iter()
            .zip(&mut self.stations)
            .zip(&mut self.surfaces)
        {
            let body = &self.world.bodies[handle];
            surface.pose = *body.position();
            station.centre = body.center_of_mass() * self.unit;
            station.velocity = body.linvel() * self.unit;
            station.spin = body.angvel();
        }
    }

    /// Moves every body on by `dt` (s) under the loads of the grains; what forces it changes velocities over the `kick` (s) from
    /// the middle of the last step to that of this one.
    ///
    /// # Errors
    /// The index of a body whose place is no longer a number.
    pub fn step(&mut self, loads: &[Load], kick: f64, dt: f64) -> std::result::Result<(), usize> {
        self.steer(loads, dt);
        self.time += dt;
        if self.at_rest() {
            return Ok(());
        }
        // rapier knows one length of a step: forces and gravity are scaled for the other
        let scale = kick / dt;
        for ((&handle, load), body) in self.handles.iter().zip(loads).zip(&self.bodies) {
            let rigid = &mut self.world.bodies[handle];
            if let Mobility::Free(freedom) = body.mobility
                && rigid.is_dynamic()
            {
                rigid.reset_forces(false);
                rigid.reset_torques(false);
                rigid.add_force((load.force + freedom.force) * (scale / self.unit), false);
                rigid.add_torque(load.torque * (scale / (self.unit * self.unit)), false);
            }
        }
        let before = self.motor_rates();
        let gravity = self.world.gravity;
        self.world.gravity = gravity * scale;
        self.world.integration_parameters.dt = dt;
        self.world.step();
        self.world.gravity = gravity;
        self.motors += self.motor_work(&before);
        let broken =
            |handle: &RigidBodyHandle| !self.world.bodies[*handle].translation().is_finite();
        match self.world.quarantine().is_empty() {
            true => Ok(()),
            false => Err(self.handles.iter().position(broken).unwrap_or(0)),
        }
    }

    /// Whether nothing here can move.
    fn at_rest(&self) -> bool {
        self.handles.iter().all(|&handle| {
            let body = &self.world.bodies[handle];
            !body.is_dynamic() && body.linvel() == Vector::ZERO && body.angvel() == Vector::ZERO
        })
    }

    /// Bound on how far (m) any point of a surface has moved since it stood at `poses`.
    #[must_use]
    pub fn moved_since(&self, poses: &[Pose]) -> f64 {
        let moved = (0..poses.len()).map(|index| self.way_since(poses, index));
        moved.fold(0.0, f64::max)
    }

    /// The same of one surface.
    #[must_use]
    pub fn way_since(&self, poses: &[Pose], index: usize) -> f64 {
        let (surface, before) = (&self.surfaces[index], &poses[index]);
        if surface.pose == *before {
            return 0.0;
        }
        let turn = surface.pose.rotation.angle_between(before.rotation);
        let reach = surface.shape.compute_local_bounding_sphere();
        let arm = reach.center().length() + reach.radius();
        // a plane has no end: without a turn its arm does not matter
        let turned = if turn > 0.0 { turn * arm } else { 0.0 };
        ((surface.pose.translation - before.translation).length() + turned) * self.unit
    }

    /// Work (J) the motors of joints have done.
    #[must_use]
    pub fn motor_energy(&self) -> f64 {
        self.motors
    }

    /// Puts a body's centre of mass at a height (m) without moving it sideways; it must not touch a grain there.
    pub fn lift(&mut self, body: usize, z: f64) {
        let handle = self.handles[body];
        let mut place = self.world.bodies[handle].translation();
        place.z = z / self.unit;
        self.world.bodies[handle].set_translation(place, true);
        self.view();
    }

    /// Bodies as described.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Index of the body called `name`.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    /// Angular momentum of the free bodies about `origin` (m), kg m2/s.
    #[must_use]
    pub fn angular_momentum(&self, origin: Vector) -> Vector {
        let mut sum = Vector::ZERO;
        for (&handle, station) in self.handles.iter().zip(&self.stations) {
            let body = &self.world.bodies[handle];
            if body.is_dynamic() {
                let properties = &body.mass_properties().local_mprops;
                let frame = body.rotation() * properties.principal_inertia_local_frame;
                let turning =
                    frame * (properties.principal_inertia() * (frame.inverse() * station.spin));
                let passing =
                    (station.centre - origin).cross(station.velocity) / station.inverse_mass;
                sum += turning * (self.unit * self.unit) + passing;
            }
        }
        sum
    }

    /// Potential and kinetic energy of the free bodies, J, their velocities taken at the time of the positions.
    #[must_use]
    pub fn energy(&self, loads: &[Load], dt: f64) -> (f64, f64) {
        let gravity = self.world.gravity * self.unit;
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for (index, (station, load)) in self.stations.iter().zip(loads).enumerate() {
            let body = &self.world.bodies[self.handles[index]];
            if let Mobility::Free(freedom) = self.bodies[index].mobility
                && body.is_dynamic()
            {
                let mass = 1.0 / station.inverse_mass;
                let force = load.force + freedom.force;
                let half_kick = 0.5 * dt * (force * station.inverse_mass + gravity);
                kinetic += body.kinetic_energy() * self.unit * self.unit
                    + mass * station.velocity.dot(half_kick)
                    + 0.5 * dt * load.torque.dot(station.spin);
                potential -= (mass * gravity + freedom.force).dot(station.centre);
            }
        }
        (kinetic, potential)
    }
}

/// rapier's settings for bodies that a force law acts on.
///
/// One solver iteration makes its integrator the symplectic Euler of the grains; with more, the force would be spread
/// over substeps it was not made for. Continuous collision, contact recycling and clustering belong to rapier's own
/// contacts, which are off; the speed cap would brake fast bodies.
fn tame(world: &mut PhysicsWorld) {
    let settings = &mut world.integration_parameters;
    settings.length_unit = 1.0;
    settings.num_solver_iterations = 1;
    settings.max_ccd_substeps = 0;
    settings.contact_recycling = false;
    settings.contact_clustering = false;
    settings.normalized_max_linear_velocity = f64::MAX;
}
