//! Joints of free bodies to the ground, and the work of their motors.

use crate::dem::bodies::machine::Machine;
use crate::dem::bodies::{Body, JointKind, Mobility};
use parry3d::math::Vector;
use rapier3d::dynamics::{
    FixedJointBuilder, GenericJoint, ImpulseJointHandle, JointAxis, PrismaticJointBuilder,
    RevoluteJointBuilder, RigidBodyBuilder, RigidBodyHandle, SphericalJointBuilder,
};

/// Gain of a motor: so large that it reaches its speed within a step, if it is strong enough.
const MOTOR_GAIN: f64 = 1e12;

/// A joint, with its axis in space.
pub(super) struct Tie {
    handle: ImpulseJointHandle,
    body: RigidBodyHandle,
    axis: Vector,
    motor: Option<JointAxis>,
}

impl Machine {
    /// Ties a free body to the ground as its joint says.
    pub(super) fn tie(&mut self, body: &Body, handle: RigidBodyHandle) -> Option<Tie> {
        let Mobility::Free(freedom) = body.mobility else {
            return None;
        };
        let joint = freedom.joint?;
        let pose = *self.world.bodies[handle].position();
        let ground = self.world.insert_body(RigidBodyBuilder::fixed().pose(pose));
        let point = joint.point.unwrap_or(body.centre) / self.unit;
        let anchor = pose.inverse_transform_point(point);
        let inner = |axis: Vector| body.rotation.inverse() * axis.normalize();
        let (axis, motor) = match joint.kind {
            JointKind::Prismatic(axis) => (axis.normalize(), Some(JointAxis::LinX)),
            JointKind::Revolute(axis) => (axis.normalize(), Some(JointAxis::AngX)),
            JointKind::Spherical | JointKind::Fixed => (Vector::ZERO, None),
        };
        let anchored: GenericJoint = match joint.kind {
            JointKind::Prismatic(axis) => PrismaticJointBuilder::new(inner(axis))
                .local_anchor1(anchor)
                .local_anchor2(anchor)
                .into(),
            JointKind::Revolute(axis) => RevoluteJointBuilder::new(inner(axis))
                .local_anchor1(anchor)
                .local_anchor2(anchor)
                .into(),
            JointKind::Spherical => SphericalJointBuilder::new()
                .local_anchor1(anchor)
                .local_anchor2(anchor)
                .into(),
            JointKind::Fixed => FixedJointBuilder::new().into(),
        };
        let mut built = anchored;
        let motor = motor.filter(|_| joint.motor.is_some());
        if let (Some(drive), Some(along)) = (joint.motor, motor) {
            let unit = match along {
                JointAxis::LinX => self.unit,
                _ => 1.0,
            };
            // forces count the unit of length once, torques twice
            let scale = match along {
                JointAxis::LinX => self.unit,
                _ => self.unit * self.unit,
            };
            built.set_motor_velocity(along, drive.speed / unit, MOTOR_GAIN);
            built.set_motor_max_force(along, drive.strength / scale);
        }
        Some(Tie {
            handle: self.world.insert_impulse_joint(ground, handle, built),
            body: handle,
            axis,
            motor,
        })
    }

    /// Rate of every motor along its axis, in the machine's unit.
    pub(super) fn motor_rates(&self) -> Vec<f64> {
        let driven = self.ties.iter().flatten().filter(|tie| tie.motor.is_some());
        driven.map(|tie| self.rate(tie)).collect()
    }

    fn rate(&self, tie: &Tie) -> f64 {
        let body = &self.world.bodies[tie.body];
        match tie.motor {
            Some(JointAxis::LinX) => body.linvel().dot(tie.axis),
            _ => body.angvel().dot(tie.axis),
        }
    }

    /// Work (J) of the motors in the last step: their impulses times the mean of the rates `before` and after it.
    pub(super) fn motor_work(&self, before: &[f64]) -> f64 {
        let driven = self.ties.iter().flatten().filter(|tie| tie.motor.is_some());
        let mut work = 0.0;
        for (tie, before) in driven.zip(before) {
            let joint = self.world.impulse_joints.get(tie.handle);
            if let (Some(joint), Some(along)) = (joint, tie.motor) {
                // rapier counts the impulse on the ground, the first body of the joint
                let impulse = -joint.data.motors[along as usize].impulse;
                work += 0.5 * impulse * (before + self.rate(tie)) * self.unit * self.unit;
            }
        }
        work
    }
}
