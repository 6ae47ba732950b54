//! Stage: what a bed goes through, one after the other, as a scene says and checked.

use super::scene::ContactTable;
use crate::Result;
use crate::document::Document;
use crate::unit::{Pressure, Quantity, Time, Velocity};
use serde::Deserialize;

/// Stage as it is written.
#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum StageTable {
    Settle {
        stiffness: f64,
        friction: Option<f64>,
        restitution: Option<f64>,
        longest: Quantity<Time>,
        rest_speed: Quantity<Velocity>,
    },
    Relax {
        steps: u64,
    },
    Compress {
        speed: Quantity<Velocity>,
        seating_stress: Quantity<Pressure>,
        strain: f64,
    },
    Unload {
        speed: Quantity<Velocity>,
    },
}

/// A stage of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Fall and come to rest, with elastic contacts of `stiffness` times their true stiffness.
    Settle {
        /// Share of the true stiffness, in (0, 1].
        stiffness: f64,
        /// Effects while the packing is made: little friction packs densely, much damping quickly.
        contact: ContactTable,
        /// Time after which settling ends in any case, s.
        longest: f64,
        /// Root mean square speed of the grains below which the bed is at rest, m/s.
        rest_speed: f64,
    },
    /// Raise the stiffness to the true one, by the same factor every step.
    Relax {
        /// Time steps.
        steps: u64,
    },
    /// Lower the piston at constant speed.
    Compress {
        /// Speed, m/s.
        speed: f64,
        /// Stress on the piston at which strain is counted from, Pa.
        seating_stress: f64,
        /// Strain at which the stage ends.
        strain: f64,
    },
    /// Raise the piston at constant speed until it carries nothing.
    Unload {
        /// Speed, m/s.
        speed: f64,
    },
}

impl Stage {
    /// Name in files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Stage::Settle { .. } => "settle",
            Stage::Relax { .. } => "relax",
            Stage::Compress { .. } => "compress",
            Stage::Unload { .. } => "unload",
        }
    }

    /// Whether the stage makes the packing that all laws start from.
    #[must_use]
    pub fn prepares(&self) -> bool {
        matches!(self, Stage::Settle { .. } | Stage::Relax { .. })
    }
}

/// Checks stages one by one and their order; `contact` stands where a stage says nothing.
///
/// # Errors
/// [`crate::Error::Value`] naming the stage, what was found and what is allowed.
pub(super) fn check_stages(
    document: &Document,
    stages: &[StageTable],
    contact: &ContactTable,
) -> Result<Vec<Stage>> {
    let mut checked: Vec<Stage> = Vec::new();
    for (index, table) in stages.iter().enumerate() {
        let stage = table.check(document, &format!("stage[{index}]"), contact)?;
        let order_holds = match (checked.last(), stage) {
            (None, Stage::Settle { .. }) => true,
            (Some(last), Stage::Relax { .. }) => matches!(last, Stage::Settle { .. }),
            (Some(last), Stage::Compress { .. }) => !matches!(last, Stage::Compress { .. }),
            (Some(last), Stage::Unload { .. }) => matches!(last, Stage::Compress { .. }),
            _ => false,
        };
        if !order_holds {
            let order =
                "must follow the order settle, relax, then compress and unload, as often as wanted";
            return Err(document.reject(&format!("stage[{index}].kind"), order));
        }
        checked.push(stage);
    }
    if !matches!(checked.get(1), Some(Stage::Relax { .. })) {
        return Err(document.reject(
            "stage",
            "must begin with a stage \"settle\" and a stage \"relax\"",
        ));
    }
    Ok(checked)
}

impl StageTable {
    fn check(&self, document: &Document, at: &str, contact: &ContactTable) -> Result<Stage> {
        let key = |name: &str| format!("{at}.{name}");
        Ok(match *self {
            StageTable::Settle {
                stiffness,
                friction,
                restitution,
                longest,
                rest_speed,
            } => Stage::Settle {
                stiffness: document.check(
                    &key("stiffness"),
                    stiffness,
                    |s| s > 0.0 && s <= 1.0,
                    "must lie in (0, 1]",
                )?,
                contact: ContactTable {
                    friction: friction
                        .map(|mu| {
                            document.check(
                                &key("friction"),
                                mu,
                                |mu| mu >= 0.0,
                                "must not be negative",
                            )
                        })
                        .transpose()?
                        .or(contact.friction)
                        .filter(|mu| *mu > 0.0),
                    rolling: None,
                    restitution: restitution
                        .map(|e| {
                            document.check(
                                &key("restitution"),
                                e,
                                |e| e > 0.0 && e <= 1.0,
                                "must lie in (0, 1]",
                            )
                        })
                        .transpose()?
                        .or(contact.restitution),
                },
                longest: document.positive(&key("longest"), longest)?,
                rest_speed: document.positive(&key("rest_speed"), rest_speed)?,
            },
            StageTable::Relax { steps } => {
                if steps == 0 {
                    return Err(document.reject(&key("steps"), "must be at least 1"));
                }
                Stage::Relax { steps }
            }
            StageTable::Compress {
                speed,
                seating_stress,
                strain,
            } => Stage::Compress {
                speed: document.positive(&key("speed"), speed)?,
                seating_stress: document.positive(&key("seating_stress"), seating_stress)?,
                strain: document.check(
                    &key("strain"),
                    strain,
                    |s| s > 0.0 && s <= 0.2,
                    "must lie in (0, 0.2]",
                )?,
            },
            StageTable::Unload { speed } => Stage::Unload {
                speed: document.positive(&key("speed"), speed)?,
            },
        })
    }
}
