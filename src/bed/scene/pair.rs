//! Pairs of materials whose contacts have effects of their own.

use super::material::GrainMaterial;
use crate::Result;
use crate::dem::force::named::Constants;
use crate::document::Document;
use serde::Deserialize;

/// Effects of the contacts of two materials; what is not named is as in `[contact]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairContact {
    /// Indices into the scene's materials.
    pub between: [usize; 2],
    /// Friction, rolling friction and restitution.
    pub contact: Constants,
}

impl PairContact {
    /// Whether it is about these two materials.
    #[must_use]
    pub fn is_of(&self, a: usize, b: usize) -> bool {
        self.between == [a, b] || self.between == [b, a]
    }
}

/// Table `[[pair]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PairTable {
    between: [String; 2],
    friction: Option<f64>,
    rolling: Option<f64>,
    restitution: Option<f64>,
}

pub(super) fn check_pairs(
    document: &Document,
    tables: Vec<PairTable>,
    materials: &[GrainMaterial],
    general: &Constants,
) -> Result<Vec<PairContact>> {
    let tables = tables.into_iter().enumerate();
    tables
        .map(|(index, table)| table.check(document, &format!("pair[{index}]"), materials, general))
        .collect()
}

impl PairTable {
    fn check(
        self,
        document: &Document,
        key: &str,
        materials: &[GrainMaterial],
        general: &Constants,
    ) -> Result<PairContact> {
        let mut between = [0; 2];
        for (place, name) in between.iter_mut().zip(&self.between) {
            let found = materials.iter().position(|material| material.name == *name);
            *place = found.ok_or_else(|| {
                let names: Vec<&str> = materials.iter().map(|m| &m.name[..]).collect();
                let allowed = format!("must be two of {}", names.join(", "));
                document.reject(&format!("{key}.between"), allowed)
            })?;
        }
        let check = |name: &str, value: Option<f64>, most: f64| {
            let must = "must be positive, and at most 1 for a restitution; leave it out for that of `[contact]`";
            let holds = |value| value > 0.0 && value <= most;
            value
                .map(|value| document.check(&format!("{key}.{name}"), value, holds, must))
                .transpose()
        };
        let contact = Constants {
            friction: check("friction", self.friction, f64::MAX)?.or(general.friction),
            rolling: check("rolling", self.rolling, f64::MAX)?.or(general.rolling),
            restitution: check("restitution", self.restitution, 1.0)?.or(general.restitution),
            stiffness: general.stiffness,
        };
        Ok(PairContact { between, contact })
    }
}
