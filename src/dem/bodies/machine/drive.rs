//! Driving: bodies told to move, held, released or taken out, and their state for a restart.

use crate::dem::bodies::Mobility;
use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::machine::{Load, Machine};
use crate::dem::bodies::motion::{Motion, Oscillation, Servo};
use crate::tape::{Keep, Tape, keep_fields};
use parry3d::math::{Pose, Vector};
use rapier3d::dynamics::RigidBodyType;

/// Place and motion of one body, in the machine's unit: all that a restart needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    pose: Pose,
    velocity: Vector,
    spin: Vector,
    drive: Drive,
    mode: Mode,
    belt: Option<Belt>,
}

/// Told motion of a body with where and when it began, in the machine's unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Drive {
    pub(super) motion: Motion,
    pub(super) start: Vector,
    began: f64,
}

/// How a body stands in the bed at present.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Mode {
    /// As its mobility says.
    #[default]
    Usual,
    /// Held in place until it is released.
    Held,
    /// Driven by a stage, whatever its mobility says.
    Told,
    /// Taken out.
    Removed,
}

keep_fields!(Oscillation: amplitude, frequency);
keep_fields!(Servo: direction, force, speed);
keep_fields!(Motion: velocity, spin, about, oscillation, servo);
keep_fields!(Drive: motion, start, began);
keep_fields!(Belt: velocity, spin, about);
keep_fields!(BodyState: pose, velocity, spin, drive, mode, belt);

impl Mode {
    const ALL: [Mode; 4] = [Mode::Usual, Mode::Held, Mode::Told, Mode::Removed];
}

impl Keep for Mode {
    fn save(&self, tape: &mut Tape) {
        (*self as u64).save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut number = 0usize;
        number.load(tape)?;
        *self = *Self::ALL.get(number)?;
        Some(())
    }
}

impl Machine {
    pub(super) fn set_mode(&mut self, index: usize, mode: Mode) {
        self.modes[index] = mode;
        let body = &mut self.world.bodies[self.handles[index]];
        let (kind, free) = match (self.bodies[index].mobility, mode) {
            (Mobility::Free(freedom), Mode::Usual) => (RigidBodyType::Dynamic, 1.0 / freedom.mass),
            (Mobility::Driven(_), Mode::Usual) | (_, Mode::Told) => {
                (RigidBodyType::KinematicVelocityBased, 0.0)
            }
            _ => (RigidBodyType::Fixed, 0.0),
        };
        body.set_body_type(kind, true);
        let station = &mut self.stations[index];
        station.inverse_mass = free;
        station.driven = kind == RigidBodyType::KinematicVelocityBased;
        self.surfaces[index].removed = mode == Mode::Removed;
    }

    /// Lets a body that was held go.
    pub fn release(&mut self, index: usize) {
        self.set_mode(index, Mode::Usual);
        if let Mobility::Free(freedom) = self.bodies[index].mobility {
            let body = &mut self.world.bodies[self.handles[index]];
            body.set_linvel(freedom.velocity / self.unit, true);
            body.set_angvel(freedom.spin, true);
        }
        self.view();
    }

    /// Takes a body out of the bed.
    pub fn remove(&mut self, index: usize) {
        self.set_mode(index, Mode::Removed);
        self.view();
    }

    /// Drives a body by `motion` from now on; a fixed one becomes driven.
    pub fn drive_as(&mut self, index: usize, motion: Motion) {
        if !matches!(self.bodies[index].mobility, Mobility::Driven(_)) {
            self.set_mode(index, Mode::Told);
        }
        let start = self.world.bodies[self.handles[index]].translation();
        self.drives[index] = Drive {
            motion: Motion {
                velocity: motion.velocity / self.unit,
                about: motion.about.map(|about| about / self.unit),
                oscillation: motion.oscillation.map(|mut oscillation| {
                    oscillation.amplitude /= self.unit;
                    oscillation
                }),
                servo: motion.servo.map(|mut servo| {
                    servo.speed /= self.unit;
                    servo
                }),
                ..motion
            },
            start,
            began: self.time,
        };
        let body = &mut self.world.bodies[self.handles[index]];
        body.set_linvel(motion.velocity / self.unit, true);
        body.set_angvel(motion.spin, true);
        self.view();
    }

    /// Sets the velocities of driven bodies so that after a step of `dt` (s) they are where their motion says.
    pub(super) fn steer(&mut self, loads: &[Load], dt: f64) {
        for (index, drive) in self.drives.iter().enumerate() {
            if drive.motion.is_steady() || !self.stations[index].driven {
                continue;
            }
            let body = &mut self.world.bodies[self.handles[index]];
            let velocity = match drive.motion.servo {
                Some(servo) => servo.velocity(loads[index].force),
                None => {
                    let target = drive
                        .motion
                        .centre(drive.start, self.time + dt - drive.began);
                    (target - body.translation()) / dt
                }
            };
            body.set_linvel(velocity, true);
        }
    }

    /// Sets the velocity (m/s) of a driven body, which goes on in a straight line.
    pub fn drive(&mut self, body: usize, velocity: Vector) {
        self.drive_as(body, Motion::straight(velocity));
    }

    /// Place and motion of every body, bit for bit.
    #[must_use]
    pub fn state(&self) -> Vec<BodyState> {
        let handles = self.handles.iter().enumerate();
        handles
            .map(|(index, &handle)| {
                let body = &self.world.bodies[handle];
                BodyState {
                    pose: *body.position(),
                    velocity: body.linvel(),
                    spin: body.angvel(),
                    drive: self.drives[index],
                    mode: self.modes[index],
                    belt: self.stations[index].belt,
                }
            })
            .collect()
    }

    /// Puts every body where [`Machine::state`] found it, the clock of told motions to `time` (s).
    pub fn restore(&mut self, state: &[BodyState], time: f64) {
        self.time = time;
        for (index, state) in state.iter().enumerate() {
            self.drives[index] = state.drive;
            self.stations[index].belt = state.belt;
            self.set_mode(index, state.mode);
            let body = &mut self.world.bodies[self.handles[index]];
            body.set_position(state.pose, true);
            body.set_linvel(state.velocity, true);
            body.set_angvel(state.spin, true);
        }
        self.view();
    }
}
