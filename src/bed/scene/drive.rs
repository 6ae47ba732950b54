//! Ways a body may move, as they are written: driven, a belt, or free with joint and motor.

use super::at::At;
use super::written::vector;
use crate::Result;
use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::motion::{Motion, Oscillation, Servo};
use crate::dem::bodies::{Freedom, Joint, JointKind, Motor, Solid};
use crate::document::Document;
use crate::document::keys::{key, keys, names, table};
use crate::unit::{
    AngularVelocity, Density, Force, Frequency, Length, Mass, Quantity, Torque, Velocity,
};
use parry3d::math::Vector;
use serde::Deserialize;

/// Told motion, of a body or from a stage on.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DrivenTable {
    velocity: Option<[Quantity<Velocity>; 3]>,
    spin: Option<SpinTable>,
    oscillation: Option<OscillationTable>,
    servo: Option<ServoTable>,
}

keys! {
    DrivenTable "What is not given does not move." {
        velocity: key("steady velocity", "", "['0 m/s', '0 m/s', '25 mm/s']").or("0"),
        spin: table("steady turn").or("none"),
        oscillation: table("vibration on top").or("none"),
        servo: table("moves until the grains resist with a force").within("stands alone").or("none"),
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpinTable {
    axis: [f64; 3],
    rate: Quantity<AngularVelocity>,
    about: Option<[Quantity<Length>; 3]>,
}

keys! {
    SpinTable {
        axis: key("axis", "not 0", "[0.0, 1.0, 0.0]"),
        rate: key("angular velocity", "", "'30 rpm'"),
        about: key("point of the axis", "", "['0 mm', '0 mm', '0 mm']").or("its centre"),
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct OscillationTable {
    direction: [f64; 3],
    amplitude: Quantity<Length>,
    frequency: Quantity<Frequency>,
}

keys! {
    OscillationTable {
        direction: key("direction", "not 0", "[0.0, 0.0, 1.0]"),
        amplitude: key("amplitude", "> 0", "'0.5 mm'"),
        frequency: key("frequency", "> 0", "'50 Hz'"),
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct ServoTable {
    direction: [f64; 3],
    force: Quantity<Force>,
    speed: Quantity<Velocity>,
}

keys! {
    ServoTable {
        direction: key("direction it presses in", "not 0", "[0.0, 0.0, -1.0]"),
        force: key("force it presses with", "> 0", "'2 N'"),
        speed: key("largest speed", "> 0", "'0.1 m/s'"),
    }
}

/// Motion of a surface along itself.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BeltTable {
    velocity: Option<[Quantity<Velocity>; 3]>,
    spin: Option<SpinTable>,
}

keys! {
    BeltTable "Grains feel the surface move along itself; the body stands." {
        velocity: key("of the surface: its part along it counts", "", "['0.5 m/s', '0 m/s', '0 m/s']").or("0"),
        spin: table("turn of the surface, as of a roller").within("not of a plane").or("none"),
    }
}

/// Motion under forces.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FreeTable {
    mass: Option<Quantity<Mass>>,
    density: Option<Quantity<Density>>,
    velocity: Option<[Quantity<Velocity>; 3]>,
    force: Option<[Quantity<Force>; 3]>,
    joint: Option<JointTable>,
    #[serde(default)]
    held: bool,
}

keys! {
    FreeTable {
        mass: key("mass", "> 0", "'7 g'").or("or `density`"),
        density: key("density; the shape must be closed", "> 0", "'7800 kg/m3'").or("or `mass`"),
        velocity: key("to begin with", "", "['0 m/s', '0 m/s', '-1 m/s']").or("0"),
        force: key("steady load on top of gravity", "", "['0 N', '0 N', '-5 N']").or("0"),
        joint: table("joint to the ground").or("none"),
        held: key("stays where it is until a stage releases it", "", "true").or("false"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct JointTable {
    kind: JointName,
    axis: Option<[f64; 3]>,
    point: Option<[Quantity<Length>; 3]>,
    motor: Option<MotorTable>,
}

keys! {
    JointTable {
        kind: key("what it leaves free", "`\"prismatic\"`, `\"revolute\"`, `\"spherical\"`, `\"fixed\"`", "'prismatic'"),
        axis: key("axis to slide along or turn about", "not 0", "[0.0, 0.0, 1.0]").or("required for the first two"),
        point: key("where the joint is", "", "['0 mm', '0 mm', '0 mm']").or("the body's centre"),
        motor: table("drives the first two kinds").or("none"),
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum JointName {
    Prismatic,
    Revolute,
    Spherical,
    Fixed,
}

names! { JointName { Prismatic as "prismatic", Revolute as "revolute", Spherical as "spherical", Fixed as "fixed", } }

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MotorTable {
    velocity: Option<Quantity<Velocity>>,
    max_force: Option<Quantity<Force>>,
    rate: Option<Quantity<AngularVelocity>>,
    max_torque: Option<Quantity<Torque>>,
}

keys! {
    MotorTable {
        velocity: key("speed wanted", "", "'10 mm/s'").or("prismatic"),
        max_force: key("what it can do at most", "> 0", "'2 N'").or("prismatic"),
        rate: key("angular velocity wanted", "", "'30 rpm'").or("revolute"),
        max_torque: key("what it can do at most", "> 0", "'2.5 mN m'").or("revolute"),
    }
}

impl DrivenTable {
    pub(super) fn check(&self, document: &Document, key: &str) -> Result<Motion> {
        let at = At { document, key };
        let spin = match &self.spin {
            Some(spin) => at.direction("spin.axis", spin.axis)? * spin.rate.si(),
            None => Vector::ZERO,
        };
        let oscillation = match &self.oscillation {
            Some(table) => Some(Oscillation {
                amplitude: at.direction("oscillation.direction", table.direction)?
                    * at.positive("oscillation.amplitude", table.amplitude)?,
                frequency: at.positive("oscillation.frequency", table.frequency)?,
            }),
            None => None,
        };
        let servo = match &self.servo {
            Some(table) => Some(Servo {
                direction: at.direction("servo.direction", table.direction)?,
                force: at.positive("servo.force", table.force)?,
                speed: at.positive("servo.speed", table.speed)?,
            }),
            None => None,
        };
        if servo.is_some()
            && (self.velocity.is_some() || spin != Vector::ZERO || oscillation.is_some())
        {
            return Err(at.reject("servo", "must stand alone: the servo sets the velocity"));
        }
        Ok(Motion {
            velocity: self.velocity.map_or(Vector::ZERO, vector),
            spin,
            about: self.spin.and_then(|spin| spin.about).map(vector),
            oscillation,
            servo,
        })
    }
}

impl BeltTable {
    /// Belt of a body whose origin is `centre` (m).
    pub(super) fn check(&self, document: &Document, key: &str, centre: Vector) -> Result<Belt> {
        let at = At { document, key };
        let spin = match &self.spin {
            Some(spin) => at.direction("spin.axis", spin.axis)? * spin.rate.si(),
            None => Vector::ZERO,
        };
        Ok(Belt {
            velocity: self.velocity.map_or(Vector::ZERO, vector),
            spin,
            about: self.spin.and_then(|spin| spin.about).map_or(centre, vector),
        })
    }
}

impl FreeTable {
    pub(super) fn check(&self, at: &At, solid: &Solid) -> Result<Freedom> {
        if matches!(solid, Solid::HalfSpace) {
            return Err(at.reject("free", "must not be a plane: it has no mass"));
        }
        let mass = match (self.mass, self.density) {
            (Some(mass), None) => at.positive("free.mass", mass)?,
            (None, Some(density)) => {
                let density = at.positive("free.density", density)?;
                let volume = solid.volume(solid.reach())?.unwrap_or(0.0);
                at.document.check(
                    at.key,
                    density * volume,
                    |mass| mass > 0.0,
                    "must enclose a volume, or give the body a `mass`",
                )?
            }
            _ => return Err(at.reject("free", "must hold either `mass` or `density`")),
        };
        Ok(Freedom {
            mass,
            velocity: self.velocity.map_or(Vector::ZERO, vector),
            spin: Vector::ZERO,
            force: self.force.map_or(Vector::ZERO, vector),
            joint: match &self.joint {
                Some(joint) => Some(joint.check(at)?),
                None => None,
            },
            held: self.held,
        })
    }
}

impl JointTable {
    fn check(&self, at: &At) -> Result<Joint> {
        let axis = || match self.axis {
            Some(axis) => at.direction("free.joint.axis", axis),
            None => Err(at.reject("free.joint.axis", "must be there for this kind of joint")),
        };
        let kind = match self.kind {
            JointName::Prismatic => JointKind::Prismatic(axis()?),
            JointName::Revolute => JointKind::Revolute(axis()?),
            JointName::Spherical => JointKind::Spherical,
            JointName::Fixed => JointKind::Fixed,
        };
        Ok(Joint {
            kind,
            point: self.point.map(vector),
            motor: match &self.motor {
                Some(motor) => Some(motor.check(at, self.kind)?),
                None => None,
            },
        })
    }
}

impl MotorTable {
    fn check(&self, at: &At, joint: JointName) -> Result<Motor> {
        match (joint, self.velocity, self.max_force, self.rate, self.max_torque) {
            (JointName::Prismatic, Some(speed), Some(force), None, None) => Ok(Motor {
                speed: speed.si(),
                strength: at.positive("free.joint.motor.max_force", force)?,
            }),
            (JointName::Revolute, None, None, Some(rate), Some(torque)) => Ok(Motor {
                speed: rate.si(),
                strength: at.positive("free.joint.motor.max_torque", torque)?,
            }),
            _ => Err(at.reject(
                "free.joint.motor",
                "must hold `velocity` and `max_force` on a prismatic joint, `rate` and `max_torque` on a revolute one",
            )),
        }
    }
}
