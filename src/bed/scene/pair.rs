//! Pairs of materials whose contacts have effects of their own.

use super::material::GrainMaterial;
use super::settings::PairTable;
use crate::Result;
use crate::dem::force::named::Constants;
use crate::document::Document;

/// Effects of the contacts of two materials; what is not named is as in `[contact]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairContact {
    /// Indices into the scene's materials.
    pub between: [usize; 2],
    /// Constants of their effects.
    pub contact: Constants,
}

impl PairContact {
    /// Whether it is about these two materials.
    #[must_use]
    pub fn is_of(&self, a: usize, b: usize) -> bool {
        self.between == [a, b] || self.between == [b, a]
    }
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
        let contact = self.constants(document, key, general)?;
        Ok(PairContact { between, contact })
    }
}
