//! Assembly: the bed of a scene from its materials and their laws, its contact effects and where it starts.

use crate::Result;
use crate::bed::filling::feed::Feed;
use crate::bed::scene::Scene;
use crate::bed::stages::time_step::Limits;
use crate::dem::bodies::enclosure::Room;
use crate::dem::bodies::machine::{BodyState, Machine};
use crate::dem::dynamics::any::AnyBed;
use crate::dem::dynamics::compose::{NormalsOf, build, build_mixed};
use crate::dem::dynamics::{Normals, Parts};
use crate::dem::force::by_material::Table;
use crate::dem::force::mixture::Mixture;
use crate::dem::force::named::{Constants, Effects};
use crate::dem::grains::Grains;
use crate::law::{AnyLaw, LawFile};
use crate::theory::Theory;

/// Distance up to which neighbours are listed, over the largest radius: the best of a scan between lists that are
/// short and lists that last.
const SKIN: f64 = 0.15;

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
    /// Law of each material.
    pub laws: Vec<AnyLaw>,
    /// Effects beside the laws.
    pub contact: &'a Constants,
    /// Whether pairs of materials have effects of their own.
    pub by_pair: bool,
}

/// Law of each material in the run called `name`, refused before the first step if one cannot be had.
///
/// # Errors
/// As [`crate::bed::scene::GrainMaterial::law_in`].
pub fn laws(scene: &Scene, name: &str, given: Option<&LawFile>) -> Result<Vec<AnyLaw>> {
    let materials = scene.materials.iter().enumerate();
    materials
        .map(|(index, material)| match scene.uses(index) {
            true => material.law_in(name, given),
            false => Ok(AnyLaw::Theory(Theory::Hertz, material.material)),
        })
        .collect()
}

/// Elastic law of each material.
#[must_use]
pub fn elastic(scene: &Scene) -> Vec<AnyLaw> {
    let materials = scene.materials.iter();
    materials
        .map(|material| AnyLaw::Theory(Theory::Hertz, material.material))
        .collect()
}

/// Bodies of a scene in their room.
///
/// # Errors
/// As [`Machine::new`].
pub fn machine(scene: &Scene, room: &Room) -> Result<Machine> {
    Machine::new(scene.all_bodies(room), scene.gravity, scene.radius())
}

/// Bed as it is at the start.
///
/// # Errors
/// As [`Machine::new`], and those of the laws.
pub fn assemble(scene: &Scene, start: &Start, recipe: &Recipe) -> Result<Box<dyn AnyBed>> {
    let mut machine = machine(scene, &start.room)?;
    if let Some(bodies) = &start.bodies {
        machine.restore(bodies, start.time);
    }
    let mut grains = start.grains.clone();
    grains.plastic.fill(0.0);
    let parts = Parts {
        grains,
        machine,
        gravity: scene.gravity,
        dt: Limits::of(scene).rayleigh(1.0),
        skin: SKIN * scene.radii()[1],
    };
    let mut bed = match scene.is_mixture() {
        true => mixture(scene, recipe, parts)?,
        false => {
            let [smallest, largest] = scene.radii();
            let normals = recipe.laws[scene.groups[0].material].visit(NormalsOf {
                monodisperse: smallest == largest,
            })?;
            build(
                normals,
                &Effects::of(recipe.contact, scene.material()),
                parts,
            )
        }
    };
    bed.soften(scene.contact.softening());
    Ok(bed)
}

fn mixture(scene: &Scene, recipe: &Recipe, parts: Parts) -> Result<Box<dyn AnyBed>> {
    let materials = scene.materials.iter().map(|material| &material.material);
    let mixture = Mixture::new(recipe.laws.iter().zip(materials))?;
    let effects = Table::new(scene.materials.len(), |a, b| {
        let contact = match b {
            Some(b) if recipe.by_pair => scene.contact_of(a, b),
            _ => *recipe.contact,
        };
        let material = |index: usize| &scene.materials[index].material;
        Effects::between(&contact, [Some(material(a)), b.map(material)])
    });
    let normals = Normals {
        pair: Box::new(mixture.clone()),
        wall: Box::new(mixture),
    };
    Ok(build_mixed(normals, &effects, parts))
}
