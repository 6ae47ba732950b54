//! Composition: from effects and laws to a bed of one concrete type; every choice is made here, once.

use super::any::AnyBed;
use super::{Bed, Normals, Parts};
use crate::contact::pair::{Alike, Flat, Twins};
use crate::contact::{LawVisitor, NormalLaw};
use crate::dem::force::by_material::{Table, mixed};
use crate::dem::force::effects::{ContactLaw, Law};
use crate::dem::force::named::Effects;
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
    match (effects.damping, effects.friction, effects.rolling) {
        (None, None, _) => boxed(Law::new((), (), ()), normals, parts),
        (Some(d), None, _) => boxed(Law::new(d, (), ()), normals, parts),
        (None, Some(t), None) => boxed(Law::new((), t, ()), normals, parts),
        (Some(d), Some(t), None) => boxed(Law::new(d, t, ()), normals, parts),
        (None, Some(t), Some(r)) => boxed(Law::new((), t, r), normals, parts),
        (Some(d), Some(t), Some(r)) => boxed(Law::new(d, t, r), normals, parts),
    }
}

fn boxed<C: ContactLaw>(law: C, normals: Normals, parts: Parts) -> Box<dyn AnyBed> {
    Box::new(Bed::new(law, normals, parts))
}

/// Bed of a mixture: `normals` from a [`crate::dem::force::mixture::Mixture`], effects by pair of materials.
#[must_use]
pub fn build_mixed(normals: Normals, effects: &Table<Effects>, parts: Parts) -> Box<dyn AnyBed> {
    Box::new(Bed::new(mixed(effects), normals, parts))
}
