//! Mixture: normal laws of a bed of several materials, each contact two flattening laws in series, or one law of the pair.

use super::normal::{Histories, NormalModel, Squeeze, UNLOADING_PROBE};
use super::paired::{OTHER_RADII, OfPair, Paired};
use super::sides::{Empty, Flattened};
use crate::Result;
use crate::contact::Coverage;
use crate::contact::pair::{Pressed, balance, in_series};
use crate::law::AnyLaw;
use crate::material::Material;
use crate::tape::{Keep, Tape, keep_fields};
use std::any::Any;
use std::sync::Arc;

/// Material of a body that does not flatten.
pub const RIGID: u8 = u8::MAX;
/// Most materials of a mixture.
pub const MOST_MATERIALS: usize = RIGID as usize;

/// Laws of several materials; serves contacts between grains and of grains with bodies.
///
/// Materials are counted from 0 as given; a grain has its own in [`crate::dem::grains::Grains::materials`], a body in
/// [`crate::dem::bodies::machine::Machine::materials`]. How two laws share a contact: [`crate::contact::pair`]. Two materials may have
/// a law of their own instead, which is of both bodies: their whole overlap under the effective radius.
#[derive(Clone)]
pub struct Mixture {
    /// Laws of the materials, then those of pairs.
    kinds: Arc<[Kind]>,
    /// Pairs of materials that have a law of their own.
    pairs: Arc<[Paired]>,
}

/// One material.
struct Kind {
    /// Its law, without contacts.
    law: Box<dyn Flattened>,
    /// Contact modulus E*, Pa.
    modulus: f64,
}

impl Mixture {
    /// Laws of the materials in order, at most [`MOST_MATERIALS`].
    ///
    /// # Errors
    /// Those of [`AnyLaw::visit`].
    pub fn new<'a>(
        materials: impl IntoIterator<Item = (&'a AnyLaw, &'a Material)>,
    ) -> Result<Self> {
        let kinds: Result<Vec<Kind>> = materials
            .into_iter()
            .take(MOST_MATERIALS)
            .map(|(law, material)| {
                Ok(Kind {
                    law: law.visit(Empty)?,
                    modulus: material.contact_modulus(),
                })
            })
            .collect();
        Ok(Self {
            kinds: kinds?.into(),
            pairs: Arc::new([]),
        })
    }

    /// The same with laws for contacts of two materials, in place of the two laws in series; of several for the same two the last.
    ///
    /// # Errors
    /// Those of [`AnyLaw::visit`].
    pub fn with_pairs<'a>(self, laws: impl IntoIterator<Item = OfPair<'a>>) -> Result<Self> {
        let again = |kind: &Kind| Kind {
            law: kind.law.empty(),
            modulus: kind.modulus,
        };
        let mut kinds: Vec<Kind> = self.kinds.iter().map(again).collect();
        let mut pairs = Vec::new();
        for OfPair {
            between,
            law,
            ratio,
        } in laws
        {
            pairs.push(Paired {
                between: between.map(|material| material as u8),
                ratio,
                kind: kinds.len(),
            });
            kinds.push(Kind {
                law: law.visit(Empty)?,
                modulus: f64::INFINITY,
            });
        }
        pairs.reverse();
        Ok(Self {
            kinds: kinds.into(),
            pairs: pairs.into(),
        })
    }

    /// The law that two materials have of their own.
    fn of_pair(&self, [a, b]: [u8; 2]) -> Option<&Paired> {
        let mut pairs = self.pairs.iter();
        pairs.find(|pair| pair.between == [a, b] || pair.between == [b, a])
    }

    /// What flattens in contacts of two materials.
    fn bodies(&self, materials: [u8; 2]) -> Bodies {
        match (self.of_pair(materials), materials) {
            (Some(pair), _) => Bodies::Paired(pair.kind),
            (None, [_, RIGID]) => Bodies::OnRigid,
            (None, [a, b]) if a == b => Bodies::Alike,
            (None, _) => Bodies::Unlike,
        }
    }

    /// Kinds whose sides a contact of two materials has.
    fn sides(&self, materials: [u8; 2]) -> [Option<usize>; 2] {
        // a contact that is to be read from a file has no materials yet
        let count = self.kinds.len() - self.pairs.len();
        let held = |material: u8| Some(material as usize).filter(|kind| *kind < count);
        match self.bodies(materials) {
            Bodies::Paired(kind) => [Some(kind), None],
            Bodies::OnRigid | Bodies::Alike => [held(materials[0]), None],
            Bodies::Unlike => materials.map(held),
        }
    }

    fn modulus(&self, material: u8) -> f64 {
        self.kinds
            .get(material as usize)
            .map_or(f64::INFINITY, |kind| kind.modulus)
    }
}

/// A contact of a mixture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Contact {
    materials: [u8; 2],
    /// Sides among those of their materials; one and the same where both bodies are of one material.
    sides: [u32; 2],
    /// Share of the overlap the first side took last.
    share: f64,
}

keep_fields!(Contact: materials, sides, share);

/// Contacts of one task.
struct Chunk {
    mixture: Mixture,
    /// Sides of each material.
    flattened: Vec<Box<dyn Flattened>>,
    contacts: Vec<Contact>,
}

/// What a contact comes down to.
enum Bodies {
    /// One material: each side takes half.
    Alike,
    /// The second does not flatten.
    OnRigid,
    /// Two materials.
    Unlike,
    /// Two materials whose contact is of one law, of this kind.
    Paired(usize),
}

/// History of a contact on its way to another.
struct Taken {
    materials: [u8; 2],
    share: f64,
    sides: [Option<Box<dyn Any>>; 2],
}

impl Contact {
    /// Each flattening body with what it takes of `overlap`, and the radius against the plane it is pressed like:
    /// material, side, flattening, radius.
    fn loads(&self, mixture: &Mixture, squeeze: &Squeeze) -> [(usize, usize, f64, f64); 2] {
        let [first, second] = self.materials.map(|material| mixture.modulus(material));
        let effective = 1.0 / (1.0 / squeeze.radii[0] + 1.0 / squeeze.radii[1]);
        if let Some(pair) = mixture.of_pair(self.materials) {
            // one side stands for both
            return [(
                pair.kind,
                self.sides[0] as usize,
                squeeze.overlap,
                effective,
            ); 2];
        }
        let taken = self.share * squeeze.overlap;
        [
            (
                self.materials[0] as usize,
                self.sides[0] as usize,
                taken,
                effective * (1.0 + first / second),
            ),
            (
                self.materials[1] as usize,
                self.sides[1] as usize,
                squeeze.overlap - taken,
                effective * (1.0 + second / first),
            ),
        ]
    }
}

impl Chunk {
    /// Share of the first side by Hertz, with which the search of an elastic contact is over at once.
    fn hertz_share(mixture: &Mixture, materials: [u8; 2]) -> f64 {
        let [first, second] = materials.map(|material| mixture.modulus(material));
        1.0 / (1.0 + first / second)
    }

    fn add(&mut self, materials: [u8; 2], old: Option<(&Chunk, usize)>) {
        let kept = old.and_then(|(chunk, at)| Some((chunk, chunk.contacts.get(at)?)));
        let kept = kept.filter(|(_, contact)| contact.materials == materials);
        let mut contact = Contact {
            materials,
            sides: [0; 2],
            share: kept.map_or_else(
                || Self::hertz_share(&self.mixture, materials),
                |(_, contact)| contact.share,
            ),
        };
        for (body, kind) in self.mixture.sides(materials).into_iter().enumerate() {
            if let Some(kind) = kind {
                let old = kept.map(|(chunk, contact)| {
                    (&*chunk.flattened[kind], contact.sides[body] as usize)
                });
                contact.sides[body] = self.flattened[kind].add(old) as u32;
            }
        }
        if materials[0] == materials[1] {
            contact.sides[1] = contact.sides[0];
        }
        self.contacts.push(contact);
    }

    fn press_one(&mut self, at: usize, squeeze: &Squeeze) -> Pressed {
        let bodies = self.mixture.bodies(self.contacts[at].materials);
        if matches!(bodies, Bodies::Unlike) {
            self.find_share(at, squeeze);
        }
        let [first, second] = self.contacts[at].loads(&self.mixture, squeeze);
        let side = |(kind, side, flattening, radius): (usize, usize, f64, f64)| {
            self.flattened[kind].trial(side, flattening, radius)
        };
        let state = match bodies {
            Bodies::OnRigid | Bodies::Paired(_) => side(first),
            Bodies::Alike => {
                let half = side(first);
                in_series([half; 2])
            }
            Bodies::Unlike => in_series([side(first), side(second)]),
        };
        let mut remember = |(kind, side, flattening, radius): (usize, usize, f64, f64)| {
            self.flattened[kind].remember(side, flattening, radius)
        };
        let [mut radius, mut depth] = remember(first);
        match bodies {
            Bodies::OnRigid | Bodies::Paired(_) => {}
            Bodies::Alike => depth *= 2.0,
            Bodies::Unlike => {
                let other = remember(second);
                radius = 0.5 * (radius + other[0]);
                depth += other[1];
            }
        }
        let flattening = match bodies {
            // where the bodies meet within the overlap: as by Hertz, no law of both says it
            Bodies::Paired(_) => {
                let taken = self.contacts[at].share * squeeze.overlap;
                [taken, squeeze.overlap - taken]
            }
            Bodies::OnRigid | Bodies::Alike | Bodies::Unlike => [first.2, second.2],
        };
        Pressed {
            force: state.force,
            stiffness: state.stiffness,
            contact_radius: radius,
            flattening,
            depth,
        }
    }

    fn find_share(&mut self, at: usize, squeeze: &Squeeze) {
        let contact = &self.contacts[at];
        let [first, second] = contact.loads(&self.mixture, squeeze);
        let (taken, _) = balance(
            squeeze.overlap,
            first.2,
            |flattening| self.flattened[first.0].trial(first.1, flattening, first.3),
            |flattening| self.flattened[second.0].trial(second.1, flattening, second.3),
        );
        self.contacts[at].share = taken / squeeze.overlap;
    }

    /// Bodies that flatten, each with the number of sides it stands for.
    fn flattening(
        &self,
        at: usize,
        squeeze: &Squeeze,
    ) -> impl Iterator<Item = (f64, (usize, usize, f64, f64))> {
        let contact = &self.contacts[at];
        let loads = contact.loads(&self.mixture, squeeze);
        let counts = match self.mixture.bodies(contact.materials) {
            Bodies::OnRigid | Bodies::Paired(_) => [1.0, 0.0],
            Bodies::Alike => [2.0, 0.0],
            Bodies::Unlike => [1.0, 1.0],
        };
        counts
            .into_iter()
            .zip(loads)
            .filter(|(count, _)| *count > 0.0)
    }

    fn stiffness(&self, at: usize, squeeze: &Squeeze) -> f64 {
        let compliance: f64 = self
            .flattening(at, squeeze)
            .map(|(count, (kind, side, flattening, radius))| {
                count
                    / self.flattened[kind]
                        .trial(side, flattening, radius)
                        .stiffness
            })
            .sum();
        1.0 / compliance
    }
}

impl Chunk {
    /// A contact under the law of a pair made of bodies of other proportions, pressed further than those do not matter.
    fn beyond_its_radii(&self, at: usize, squeeze: &Squeeze) -> Option<Coverage> {
        let contact = &self.contacts[at];
        let pair = self.mixture.of_pair(contact.materials)?;
        if pair.is_made_of(contact.materials, squeeze.radii) {
            return None;
        }
        let [(kind, side, overlap, radius), _] = contact.loads(&self.mixture, squeeze);
        let most = self.flattened[kind]
            .largest(side, radius)
            .unwrap_or(overlap);
        (most > OTHER_RADII * radius).then(|| Coverage {
            beyond: true,
            ..Coverage::default()
        })
    }
}

impl Histories for Chunk {
    fn press(&mut self, at: &[u32], squeezes: &[Squeeze], pressed: &mut [Pressed]) {
        for ((&at, squeeze), pressed) in at.iter().zip(squeezes).zip(pressed) {
            *pressed = self.press_one(at as usize, squeeze);
        }
    }

    fn forget(&mut self, at: usize) {
        let contact = &mut self.contacts[at];
        contact.share = Self::hertz_share(&self.mixture, contact.materials);
        let kinds = self.mixture.sides(contact.materials);
        for (kind, &side) in kinds.into_iter().zip(&contact.sides) {
            if let Some(kind) = kind {
                self.flattened[kind].forget(side as usize);
            }
        }
    }

    fn take(&mut self, at: usize) -> Box<dyn Any> {
        let contact = &self.contacts[at];
        let (materials, share) = (contact.materials, contact.share);
        let kinds = self.mixture.sides(materials);
        let sides = std::array::from_fn(|body| {
            let side = contact.sides[body] as usize;
            Some(self.flattened[kinds[body]?].take(side))
        });
        self.forget(at);
        Box::new(Taken {
            materials,
            share,
            sides,
        })
    }

    fn put(&mut self, at: usize, history: &dyn Any) {
        let contact = &mut self.contacts[at];
        let Some(taken) = history.downcast_ref::<Taken>() else {
            return;
        };
        if taken.materials != contact.materials {
            return;
        }
        contact.share = taken.share;
        let kinds = self.mixture.sides(taken.materials);
        for (body, history) in taken.sides.iter().enumerate() {
            if let (Some(kind), Some(history)) = (kinds[body], history) {
                self.flattened[kind].put(contact.sides[body] as usize, &**history);
            }
        }
    }

    fn elastic_energy(&self, at: usize, squeeze: Squeeze) -> f64 {
        self.flattening(at, &squeeze)
            .map(|(count, (kind, side, flattening, radius))| {
                count * self.flattened[kind].elastic_energy(side, flattening, radius)
            })
            .sum()
    }

    fn dissipated(&self, at: usize, radii: [f64; 2]) -> f64 {
        let apart = Squeeze {
            overlap: 0.0,
            radii,
        };
        self.flattening(at, &apart)
            .map(|(count, (kind, side, _, radius))| {
                count * self.flattened[kind].dissipated(side, radius)
            })
            .sum()
    }

    fn stiffest(&self, at: usize, squeeze: Squeeze) -> f64 {
        let back = Squeeze {
            overlap: squeeze.overlap * (1.0 - UNLOADING_PROBE),
            ..squeeze
        };
        self.stiffness(at, &squeeze).max(self.stiffness(at, &back))
    }

    fn largest_overlap(&self, at: usize, radii: [f64; 2]) -> Option<f64> {
        let squeeze = Squeeze {
            overlap: 0.0,
            radii,
        };
        self.flattening(at, &squeeze)
            .map(|(count, (kind, side, _, radius))| {
                Some(count * self.flattened[kind].largest(side, radius)?)
            })
            .sum()
    }

    fn coverage(&self, at: usize, squeeze: Squeeze) -> Coverage {
        self.flattening(at, &squeeze)
            .map(|(count, (kind, side, flattening, radius))| {
                let side = self.flattened[kind].coverage(side, flattening, radius);
                side.times(count, 1.0)
            })
            .chain(self.beyond_its_radii(at, &squeeze))
            .fold(Coverage::default(), Coverage::and)
    }

    fn save(&self, tape: &mut Tape) {
        self.contacts.save(tape);
        self.flattened.iter().for_each(|sides| sides.save(tape));
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.contacts.load(tape)?;
        self.flattened
            .iter_mut()
            .try_for_each(|sides| sides.load(tape))
    }

    fn same(&self, other: &dyn Histories) -> bool {
        other.any().downcast_ref::<Self>().is_some_and(|other| {
            let mut sides = self.flattened.iter().zip(&other.flattened);
            self.contacts == other.contacts && sides.all(|(a, b)| a.same(&**b))
        })
    }

    fn any(&self) -> &dyn Any {
        self
    }
}

impl NormalModel for Mixture {
    fn chunks(
        &self,
        old: &[Box<dyn Histories>],
        from: &[Option<usize>],
        chunk: usize,
        materials: &dyn Fn(usize) -> [u8; 2],
    ) -> Vec<Box<dyn Histories>> {
        let old: Vec<&Chunk> = old
            .iter()
            .filter_map(|chunk| chunk.any().downcast_ref())
            .collect();
        let task = |(number, from): (usize, &[Option<usize>])| {
            let mut task = Chunk {
                mixture: self.clone(),
                flattened: self.kinds.iter().map(|kind| kind.law.empty()).collect(),
                contacts: Vec::with_capacity(from.len()),
            };
            for (at, from) in from.iter().enumerate() {
                let old = from.and_then(|at| Some((*old.get(at / chunk)?, at % chunk)));
                task.add(materials(number * chunk + at), old);
            }
            Box::new(task) as Box<dyn Histories>
        };
        from.chunks(chunk).enumerate().map(task).collect()
    }
}
