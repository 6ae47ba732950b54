//! Pairs of materials whose contacts have effects, or a law, of their own.

use super::material::{GrainMaterial, OWN};
use super::settings::PairTable;
use crate::bed::scene::{FITTED, Scene};
use crate::curve::Particle;
use crate::dem::force::named::Constants;
use crate::document::Document;
use crate::law::PairLaw;
use crate::law::pair::TargetName;
use crate::material::Material;
use crate::{Error, Result};

/// Effects and law of the contacts of two materials; what is not named is as in `[contact]`, and of the two laws in series.
#[derive(Debug, Clone, PartialEq)]
pub struct PairContact {
    /// Indices into the scene's materials; of a law that of its particle first.
    pub between: [usize; 2],
    /// Constants of their effects.
    pub contact: Constants,
    /// Law of both materials together, which takes the place of their two laws in series where laws are fitted ones.
    pub law: Option<Box<PairLaw>>,
}

impl PairContact {
    /// Whether it is about these two materials.
    #[must_use]
    pub fn is_of(&self, a: usize, b: usize) -> bool {
        self.between == [a, b] || self.between == [b, a]
    }
}

impl Scene {
    /// That a law of a pair has a run it is used in.
    pub(super) fn check_pair_laws(&self) -> Result<()> {
        let fitted = self.laws.iter().any(|law| law == FITTED || law == OWN);
        match self.pairs.iter().position(|pair| pair.law.is_some()) {
            Some(index) if !fitted => {
                let allowed = format!(
                    "must be left out, or `laws` name \"{FITTED}\": the law of a pair is used in runs under fitted laws alone, not under {}",
                    self.laws.join(", ")
                );
                Err(self.document.reject(&format!("pair[{index}].law"), allowed))
            }
            _ => Ok(()),
        }
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
        let Some(law) = self.law.as_deref() else {
            return Ok(PairContact {
                between,
                contact,
                law: None,
            });
        };
        let (law, between) = law_of(document, &format!("{key}.law"), law, between, materials)?;
        Ok(PairContact {
            between,
            contact,
            law: Some(Box::new(law)),
        })
    }
}

/// The law of a pair in a file, which must be of these two materials and of bodies that a bed has; with the materials, that of its
/// particle first.
fn law_of(
    document: &Document,
    key: &str,
    file: &str,
    between: [usize; 2],
    materials: &[GrainMaterial],
) -> Result<(PairLaw, [usize; 2])> {
    if !file.ends_with(".toml") {
        let allowed = "must be the law file of a pair, as `impactlaw fit` makes it of a case with `[wall.material]`";
        return Err(document.reject(key, allowed));
    }
    let law = PairLaw::read(&document.resolve(file)).map_err(|error| match error {
        Error::File { path, source, .. } => {
            let allowed = format!(
                "must name a law file that can be read: {}: {source}",
                path.display()
            );
            document.reject(key, allowed)
        }
        Error::Refused { found, allowed, .. } => {
            document.reject(key, format!("names {found}; {allowed}"))
        }
        other => other,
    })?;
    let bodies = law.bodies();
    if bodies.target == TargetName::Plate {
        let allowed = format!(
            "must be of two spheres or of a sphere on a half-space: this one is of {}, and how thick a body is behind a contact no bed knows",
            bodies.bodies()
        );
        return Err(document.reject(key, allowed));
    }
    let same = |a: &Material, b: &Material| {
        let of = |material: &Material| Particle::of(material, 1.0);
        of(a).differences(&of(b)).is_empty()
    };
    let [one, other] = bodies.materials();
    let [first, second] = between;
    let fits = |[a, b]: [usize; 2]| {
        same(&one, &materials[a].material) && same(&other, &materials[b].material)
    };
    let found = [[first, second], [second, first]]
        .into_iter()
        .find(|order| fits(*order));
    match found {
        Some(order) => Ok((law, order)),
        None => {
            let allowed = "must be the law of these two materials; those of the file are others";
            Err(document.reject(key, allowed))
        }
    }
}
