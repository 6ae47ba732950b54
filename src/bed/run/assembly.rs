//! Assembly: the bed of a scene from its materials and their laws, its contact effects and where it starts.

use crate::Result;
use crate::bed::filling::feed::Feed;
use crate::bed::scene::{FITTED, GrainMaterial, OWN, PairContact};
use crate::dem::bodies::enclosure::Room;
use crate::dem::bodies::machine::BodyState;
use crate::dem::dynamics::any::AnyBed;
use crate::dem::dynamics::compose::{NormalsOf, build, build_mixed};
use crate::dem::dynamics::{Normals, Parts};
use crate::dem::force::by_material::Table;
use crate::dem::force::mixture::Mixture;
use crate::dem::force::named::{Constants, Effects};
use crate::dem::force::paired::OfPair;
use crate::dem::grains::Grains;
use crate::law::{AnyLaw, LawFile};
use crate::theory::Theory;

/// Where a bed starts from.
pub struct Start {
    /// Grains.
    pub grains: Grains,
    /// Bodies, if they are not where the scene puts them.
    pub bodies: Option<Vec<BodyState>>,
    /// Time the bodies have come to, s.
    pub time: f64,
    /// Grains to come.
    pub feed: Feed,
    /// Space of the bed.
    pub room: Room,
}

/// How the contacts of a bed are made up.
pub struct Recipe<'a> {
    /// Materials.
    pub materials: &'a [GrainMaterial],
    /// Law of each material.
    pub laws: Vec<AnyLaw>,
    /// Effects beside the laws.
    pub contact: &'a Constants,
    /// Pairs of materials with effects of their own.
    pub pairs: &'a [PairContact],
    /// Pairs of materials with a law of their own.
    pub pair_laws: Vec<PairedLaw>,
    /// Whether contacts of more than one kind can occur; if not, all are of `material`.
    pub is_mixture: bool,
    /// Material of the first group of grains.
    pub material: usize,
    /// Whether all grains, those to come included, have one radius.
    pub monodisperse: bool,
    /// Contact stiffness over that of the material.
    pub softening: f64,
}

/// Law of each material in the run called `name`, refused before the first step if one cannot be had; what is not `used`
/// needs none.
///
/// # Errors
/// As [`GrainMaterial::law_in`].
pub fn laws(
    materials: &[GrainMaterial],
    used: impl Fn(usize) -> bool,
    name: &str,
    given: Option<&LawFile>,
) -> Result<Vec<AnyLaw>> {
    let materials = materials.iter().enumerate();
    materials
        .map(|(index, material)| match used(index) {
            true => material.law_in(name, given),
            false => Ok(AnyLaw::Theory(Theory::Hertz, material.material)),
        })
        .collect()
}

/// The law of two materials together.
#[derive(Debug, Clone)]
pub struct PairedLaw {
    /// The materials, that of the particle of the law first.
    between: [usize; 2],
    /// The law.
    pub law: AnyLaw,
    /// Radius of the second body over that of the particle, infinite where it is flat.
    ratio: f64,
}

/// Laws of pairs of materials in the run called `name`: where the materials have fitted laws.
///
/// # Errors
/// As [`LawFile::law`].
pub fn pair_laws(pairs: &[PairContact], name: &str) -> Result<Vec<PairedLaw>> {
    let fitted = name == FITTED || name == OWN;
    let own = pairs.iter().filter(|_| fitted);
    own.filter_map(|pair| Some((pair.between, pair.law.as_ref()?)))
        .map(|(between, law)| {
            let bodies = law.bodies();
            let other = bodies.target_radius_m.unwrap_or(f64::INFINITY);
            Ok(PairedLaw {
                between,
                law: AnyLaw::Fitted(law.file().law()?),
                ratio: other / bodies.particle_radius_m,
            })
        })
        .collect()
}

/// Elastic law of each material.
#[must_use]
pub fn elastic(materials: &[GrainMaterial]) -> Vec<AnyLaw> {
    materials
        .iter()
        .map(|material| AnyLaw::Theory(Theory::Hertz, material.material))
        .collect()
}

/// Bed of these parts.
///
/// # Errors
/// Those of the laws.
pub fn assemble(recipe: &Recipe, parts: Parts) -> Result<Box<dyn AnyBed>> {
    let mut bed = match recipe.is_mixture {
        true => mixture(recipe, parts)?,
        false => {
            let normals = recipe.laws[recipe.material].visit(NormalsOf {
                monodisperse: recipe.monodisperse,
            })?;
            let material = &recipe.materials[recipe.material].material;
            build(normals, &Effects::of(recipe.contact, material), parts)
        }
    };
    bed.soften(recipe.softening);
    Ok(bed)
}

fn mixture(recipe: &Recipe, parts: Parts) -> Result<Box<dyn AnyBed>> {
    let materials = recipe.materials.iter().map(|material| &material.material);
    let own = recipe.pair_laws.iter();
    let mixture =
        Mixture::new(recipe.laws.iter().zip(materials))?.with_pairs(own.map(|own| OfPair {
            between: own.between,
            law: &own.law,
            ratio: own.ratio,
        }))?;
    let effects = Table::new(recipe.materials.len(), |a, b| {
        let pairs = recipe.pairs.iter().rev();
        let own = b.and_then(|b| pairs.clone().find(|pair| pair.is_of(a, b)));
        let contact = own.map_or(recipe.contact, |pair| &pair.contact);
        let material = |index: usize| &recipe.materials[index].material;
        Effects::between(contact, [Some(material(a)), b.map(material)])
    });
    let normals = Normals {
        pair: Box::new(mixture.clone()),
        wall: Box::new(mixture),
    };
    Ok(build_mixed(normals, &effects, parts))
}
