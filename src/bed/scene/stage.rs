//! Stages of a scene: what a bed goes through, one after the other.

use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::motion::Motion;
use crate::dem::force::named::Constants;

/// A stage of the run.
#[derive(Debug, Clone, PartialEq)]
pub enum Stage {
    /// Fall and come to rest, with elastic contacts of `stiffness` times their true stiffness.
    Settle {
        /// Share of the material's stiffness, in (0, 1].
        stiffness: f64,
        /// Effects while the packing is made: little friction packs densely, much damping quickly.
        contact: Constants,
        /// Time after which settling ends in any case, s.
        longest: f64,
        /// Root mean square speed of the grains below which the bed is at rest, m/s.
        rest_speed: f64,
    },
    /// Raise the stiffness to that of the scene's contacts, by the same factor every step.
    Relax {
        /// Time steps.
        steps: u64,
    },
    /// Lower the piston at constant speed.
    Compress {
        /// Speed, m/s.
        speed: f64,
        /// Speed of the piston far from the seating stress, m/s; it falls to `speed` as the stress comes up to that.
        approach: f64,
        /// Piston stress that starts the strain measurement, once sustained, Pa.
        seating_stress: f64,
        /// Piston travel (m) over which that stress must be sustained: a few grains above the rest carry more for a while, then
        /// give way.
        seating_travel: f64,
        /// Strain at which the stage ends.
        strain: f64,
    },
    /// Raise the piston at constant speed until it carries nothing.
    Unload {
        /// Speed, m/s.
        speed: f64,
    },
    /// Go on, with changes at its start, until the time is over or a condition holds.
    Run(RunStage),
}

/// A stage of any kind of motion.
#[derive(Debug, Clone, PartialEq)]
pub struct RunStage {
    /// Name in files.
    pub name: String,
    /// Groups of grains that come in from its start on.
    pub insert: Vec<usize>,
    /// Changes of bodies at its start.
    pub moves: Vec<Move>,
    /// Longest duration.
    pub longest: Duration,
    /// Conditions that end it earlier, any of them.
    pub until: Until,
}

/// How long a stage may last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Duration {
    /// s.
    Time(f64),
    /// Time steps.
    Steps(u64),
}

/// Change of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Move {
    /// Name of the body.
    pub body: String,
    /// What happens to it.
    pub change: Change,
}

/// What happens to a body at the start of a stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// A driven body goes on with this motion.
    Drive(Motion),
    /// The surface of a belt goes on with this motion.
    Belt(Belt),
    /// It is taken out of the bed.
    Remove,
    /// A held body is let go.
    Release,
}

/// Conditions that end a stage.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Until {
    /// All grains are in and their root mean square speed is below, m/s.
    pub rest_speed: Option<f64>,
    /// All grains are in and the kinetic energy is below, J.
    pub kinetic_energy: Option<f64>,
    /// The stress on the piston is above, Pa.
    pub stress: Option<f64>,
    /// The force of the grains on a body is above, N.
    pub force: Option<(String, f64)>,
    /// No grain has gone through the plane of the measure "flow" for this time (s), after the first one.
    pub flow_ended: Option<f64>,
}

impl Stage {
    /// Name in files.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Stage::Settle { .. } => "settle",
            Stage::Relax { .. } => "relax",
            Stage::Compress { .. } => "compress",
            Stage::Unload { .. } => "unload",
            Stage::Run(run) => &run.name,
        }
    }

    /// Whether the stage makes the packing that all laws start from.
    #[must_use]
    pub fn prepares(&self) -> bool {
        matches!(self, Stage::Settle { .. } | Stage::Relax { .. })
    }
}
