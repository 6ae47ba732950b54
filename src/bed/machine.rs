//! Machine: everything that is not a grain, as rapier bodies; the only file that names rapier.
//!
//! rapier moves bodies (gravity, joints, driven motion), grains press on them, and rapier's own contacts are off.
//! Its tolerances are absolute lengths meant for metres, so that inside this file lengths count grain radii; masses
//! and times stay SI. Everything that comes out is SI.

use super::bodies::{Body, Mobility};
use super::mixture::RIGID;
use crate::tape::keep_fields;
use crate::{Error, Result};
use parry3d::math::{Pose, Vector};
use parry3d::shape::SharedShape;
use rapier3d::dynamics::{PrismaticJointBuilder, RigidBodyBuilder, RigidBodyHandle};
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
}

/// Surface of a body: lengths in the machine's unit.
#[derive(Clone)]
pub struct Surface {
    /// Shape.
    pub shape: SharedShape,
    /// Place and orientation of the shape.
    pub pose: Pose,
}

/// Force and torque of the grains on a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Force, N.
    pub force: Vector,
    /// Torque about the centre of mass, N m.
    pub torque: Vector,
}

/// Place and motion of one body, in the machine's unit: all that a restart needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    pose: Pose,
    velocity: Vector,
    spin: Vector,
}
keep_fields!(BodyState: pose, velocity, spin);

/// The bodies of a scene.
pub struct Machine {
    world: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
    bodies: Vec<Body>,
    /// Unit of length, m: a grain radius.
    pub unit: f64,
    /// Bodies as the grains meet them; one for each body of the scene, in its order.
    pub stations: Vec<Station>,
    /// Surfaces, one for each body.
    pub surfaces: Vec<Surface>,
    /// Material of each body, [`RIGID`] unless told otherwise.
    pub materials: Vec<u8>,
}

impl Machine {
    /// Puts `bodies` into a world with `gravity` (m/s2); `unit` (m) is a grain radius.
    ///
    /// # Errors
    /// [`Error::Bed`] for a broken mesh.
    pub fn new(bodies: Vec<Body>, gravity: Vector, unit: f64) -> Result<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = gravity / unit;
        tame(&mut world);
        let mut machine = Self {
            world,
            handles: Vec::new(),
            bodies: Vec::new(),
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

    fn add(&mut self, body: Body) -> Result<()> {
        let shape = body.solid.shape(self.unit)?;
        let pose = Pose::from_parts(body.centre / self.unit, body.rotation);
        let builder = match body.mobility {
            Mobility::Fixed => RigidBodyBuilder::fixed(),
            Mobility::Driven { velocity, spin } => RigidBodyBuilder::kinematic_velocity_based()
                .linvel(velocity / self.unit)
                .angvel(spin),
            Mobility::Free { mass, .. } => {
                let mut properties = shape.mass_properties(1.0);
                properties.set_mass(mass, true);
                RigidBodyBuilder::dynamic().additional_mass_properties(properties)
            }
        };
        let builder = builder
            .pose(pose)
            .can_sleep(false)
            .allow_fast_rotation(true);
        let collider = ColliderBuilder::new(shape.clone())
            .density(0.0)
            .collision_groups(InteractionGroups::none())
            .solver_groups(InteractionGroups::none());
        let (handle, _) = self.world.insert(builder, collider);
        if let Mobility::Free {
            slide: Some(axis), ..
        } = body.mobility
        {
            let ground = self.world.insert_body(RigidBodyBuilder::fixed().pose(pose));
            let axis = body.rotation.inverse() * axis.normalize();
            self.world
                .insert_impulse_joint(ground, handle, PrismaticJointBuilder::new(axis));
        }
        self.world.bodies[handle].recompute_mass_properties_from_colliders(&self.world.colliders);
        self.stations.push(Station {
            centre: Vector::ZERO,
            velocity: Vector::ZERO,
            spin: Vector::ZERO,
            inverse_mass: if let Mobility::Free { mass, .. } = body.mobility {
                1.0 / mass
            } else {
                0.0
            },
            driven: matches!(body.mobility, Mobility::Driven { .. }),
        });
        self.surfaces.push(Surface { shape, pose });
        self.materials.push(RIGID);
        self.handles.push(handle);
        self.bodies.push(body);
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

    /// Moves every body on by `dt` (s) under the loads of the grains.
    ///
    /// # Errors
    /// [`Error::Bed`] when a body's place is no longer a number.
    pub fn step(&mut self, loads: &[Load], dt: f64) -> Result<()> {
        if self.at_rest() {
            return Ok(());
        }
        for (&handle, load) in self.handles.iter().zip(loads) {
            let body = &mut self.world.bodies[handle];
            if body.is_dynamic() {
                body.reset_forces(false);
                body.reset_torques(false);
                body.add_force(load.force / self.unit, false);
                body.add_torque(load.torque / (self.unit * self.unit), false);
            }
        }
        self.world.integration_parameters.dt = dt;
        self.world.step();
        if self.world.quarantine().is_empty() {
            Ok(())
        } else {
            Err(Error::Bed {
                step: 0,
                reason: "a body's place is no longer a number; reduce the time step".to_owned(),
            })
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
        let furthest =
            self.surfaces
                .iter()
                .zip(poses)
                .fold(0.0f64, |furthest, (surface, before)| {
                    if surface.pose == *before {
                        return furthest;
                    }
                    let turn = surface.pose.rotation.angle_between(before.rotation);
                    let reach = surface.shape.compute_local_bounding_sphere();
                    let arm = reach.center().length() + reach.radius();
                    furthest
                        .max((surface.pose.translation - before.translation).length() + turn * arm)
                });
        furthest * self.unit
    }

    /// Sets the velocity (m/s) of a driven body.
    pub fn drive(&mut self, body: usize, velocity: Vector) {
        self.world.bodies[self.handles[body]].set_linvel(velocity / self.unit, true);
        self.view();
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

    /// Place and motion of every body, bit for bit.
    #[must_use]
    pub fn state(&self) -> Vec<BodyState> {
        self.handles
            .iter()
            .map(|&handle| {
                let body = &self.world.bodies[handle];
                BodyState {
                    pose: *body.position(),
                    velocity: body.linvel(),
                    spin: body.angvel(),
                }
            })
            .collect()
    }

    /// Puts every body where [`Machine::state`] found it.
    pub fn restore(&mut self, state: &[BodyState]) {
        for (&handle, state) in self.handles.iter().zip(state) {
            let body = &mut self.world.bodies[handle];
            body.set_position(state.pose, true);
            body.set_linvel(state.velocity, true);
            body.set_angvel(state.spin, true);
        }
        self.view();
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
        for ((&handle, station), load) in self.handles.iter().zip(&self.stations).zip(loads) {
            let body = &self.world.bodies[handle];
            if body.is_dynamic() {
                let mass = 1.0 / station.inverse_mass;
                let half_kick = 0.5 * dt * (load.force * station.inverse_mass + gravity);
                kinetic += body.kinetic_energy() * self.unit * self.unit
                    + mass * station.velocity.dot(half_kick)
                    + 0.5 * dt * load.torque.dot(station.spin);
                potential -= mass * gravity.dot(station.centre);
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
