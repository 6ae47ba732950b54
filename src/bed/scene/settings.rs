//! Settings of a scene that are plain numbers: contact effects, time step, files.

use crate::Result;
use crate::dem::force::named::Constants;
use crate::document::Document;
use crate::unit::{Quantity, Time};
use serde::Deserialize;

/// Table `[contact]` as it is written: an effect that is not named does not act.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ContactTable {
    friction: Option<f64>,
    rolling: Option<f64>,
    restitution: Option<f64>,
    stiffness: Option<f64>,
}

impl ContactTable {
    pub(super) fn check(self, document: &Document) -> Result<Constants> {
        if let Some(friction) = self.friction {
            document.check(
                "contact.friction",
                friction,
                |f| f > 0.0,
                "must be positive; leave it out for smooth grains",
            )?;
        }
        if let Some(rolling) = self.rolling {
            document.check(
                "contact.rolling",
                rolling,
                |f| f > 0.0,
                "must be positive; leave it out for free rolling",
            )?;
            if self.friction.is_none() {
                return Err(document.reject(
                    "contact.rolling",
                    "needs `contact.friction` beside it: smooth grains do not roll",
                ));
            }
        }
        if let Some(restitution) = self.restitution {
            let must = "must lie in (0, 1]; leave it out for no damping";
            document.check(
                "contact.restitution",
                restitution,
                |e| e > 0.0 && e <= 1.0,
                must,
            )?;
        }
        if let Some(stiffness) = self.stiffness {
            let must = "must lie in (0, 1]; leave it out for the material's own stiffness";
            document.check(
                "contact.stiffness",
                stiffness,
                |s| s > 0.0 && s <= 1.0,
                must,
            )?;
        }
        let Self {
            friction,
            rolling,
            restitution,
            stiffness,
        } = self;
        Ok(Constants {
            friction,
            rolling,
            restitution,
            stiffness,
        })
    }
}

/// Table `[time]` as it is written.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TimeTable {
    rayleigh_fraction: Option<f64>,
    steps_per_contact: Option<f64>,
    step: Option<Quantity<Time>>,
}

/// How the time step follows from the stiffest contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStep {
    /// Largest share of the Rayleigh time.
    pub rayleigh_fraction: f64,
    /// Least number of steps in the half oscillation of a grain on its stiffest contact.
    pub steps_per_contact: f64,
    /// The scene's own time step, s: used as it is, and checked against the two limits.
    pub step: Option<f64>,
}

impl Default for TimeStep {
    /// Usual DEM practice: a fifth of the Rayleigh time, twenty steps a contact.
    fn default() -> Self {
        Self {
            rayleigh_fraction: 0.2,
            steps_per_contact: 20.0,
            step: None,
        }
    }
}

impl TimeTable {
    pub(super) fn check(self, document: &Document) -> Result<TimeStep> {
        let usual = TimeStep::default();
        Ok(TimeStep {
            rayleigh_fraction: document.check(
                "time.rayleigh_fraction",
                self.rayleigh_fraction.unwrap_or(usual.rayleigh_fraction),
                |f| f > 0.0 && f <= 0.5,
                "must lie in (0, 0.5], e.g. 0.2; a larger time step is unstable in a packing",
            )?,
            steps_per_contact: document.check(
                "time.steps_per_contact",
                self.steps_per_contact.unwrap_or(usual.steps_per_contact),
                |n| (8.0..=1e6).contains(&n),
                "must lie in [8, 1e6], e.g. 20; fewer steps cannot follow a contact",
            )?,
            step: self
                .step
                .map(|step| document.positive("time.step", step))
                .transpose()?,
        })
    }
}

/// Table `[output]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OutputTable {
    /// Rows of `bed.csv` in a stage.
    pub rows: usize,
    /// Frames of the VTP series in a stage.
    pub frames: usize,
    /// Frames of the page `bed.html` in a stage; none for no page.
    pub film: usize,
    /// Most frames of `animation.png`; none for no animation.
    pub animation: usize,
    /// Whether contacts are also written as `contacts/contacts_NNNN.csv`, one a VTP frame.
    pub contacts: bool,
    /// Whether grains are also written as `dump.lammpstrj`, with the VTP frames.
    pub dump: bool,
}

impl Default for OutputTable {
    fn default() -> Self {
        Self {
            rows: 100,
            frames: 4,
            film: 25,
            animation: 0,
            contacts: false,
            dump: false,
        }
    }
}

impl OutputTable {
    pub(super) fn check(self, document: &Document) -> Result<Self> {
        if self.rows == 0 {
            return Err(document.reject("output.rows", "must be at least 1"));
        }
        if self.animation > 0 && self.film == 0 {
            return Err(document.reject(
                "output.animation",
                "needs `output.film` above 0: it is made from that",
            ));
        }
        Ok(self)
    }
}
