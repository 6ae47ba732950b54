//! Composition: from effects and laws to a bed of one concrete type; every choice is made here, once.

use super::any::AnyBed;
use super::{Bed, Normals, Parts};
use crate::contact::pair::{Alike, Flat, Twins};
use crate::contact::{LawVisitor, NormalLaw};
use crate::dem::force::by_material::Table;
use crate::dem::force::effects::{EffectList, Law};
use crate::dem::force::named::{Effects, Pick, mixed};
use crate::dem::force::normal::{Model, NormalModel};

/// Builds the normal laws of a bed from a concrete law; use with anything that visits laws by name.
pub struct NormalsOf {
    /// Whether all grains, those to come included, have one radius.
    pub monodisperse: bool,
}

impl LawVisitor for NormalsOf {
    type Output = Normals;

    fn visit<L: NormalLaw>(self, law: &L) -> Normals {
        let pair: Box<dyn NormalModel> = if self.monodisperse {
            Box::new(Model(Twins(law.clone())))
        } else {
            Box::new(Model(Alike(law.clone())))
        };
        Normals {
            pair,
            wall: Box::new(Model(Flat(law.clone()))),
        }
    }
}

/// Bed with the effects named.
#[must_use]
pub fn build(normals: Normals, effects: &Effects, parts: Parts) -> Box<dyn AnyBed> {
    effects.pick(Build { normals, parts })
}

/// A bed to be built, its effects apart.
struct Build {
    normals: Normals,
    parts: Parts,
}

impl Pick for Build {
    type Output = Box<dyn AnyBed>;

    fn pick<L: EffectList>(self, effects: L) -> Box<dyn AnyBed> {
        Box::new(Bed::new(Law::new(effects), self.normals, self.parts))
    }
}

/// Bed of a mixture: `normals` from a [`crate::dem::force::mixture::Mixture`], effects by pair of materials.
#[must_use]
pub fn build_mixed(normals: Normals, effects: &Table<Effects>, parts: Parts) -> Box<dyn AnyBed> {
    Box::new(Bed::new(mixed(effects), normals, parts))
}
