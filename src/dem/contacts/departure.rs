//! Departure: the contacts of grains that are taken out go with them, all others keep their place in the order.

use super::family::{CHUNK as CANDIDATES, Family, Patch, Tally, flowed};
use super::pairs::{CHUNK as PAIRS, Contacts};
use super::surfaces::Surfaces;
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use crate::dem::force::meeting::Push;
use crate::dem::force::mixture::RIGID;
use crate::dem::force::normal::NormalModel;
use crate::dem::grains::Grains;
use crate::dem::grains::neighbours::Staying;

impl<C: ContactLaw> Contacts<C> {
    /// Hands what plastic flow has dissipated in the pairs that end, their law `softening` times as stiff, to their grains.
    pub(in crate::dem) fn part_with(&self, stay: &Staying, grains: &mut Grains, softening: f64) {
        let stays = |grain: u32| stay.new[grain as usize].is_some();
        for (at, &pair) in self.list.pairs.iter().enumerate() {
            if pair.into_iter().all(stays) {
                continue;
            }
            let radii = pair.map(|grain| grains.spheres[grain as usize].radius);
            let flowed = self.flowed(at, radii, softening);
            pair.iter()
                .for_each(|&grain| grains.plastic[grain as usize] += 0.5 * flowed);
        }
    }

    /// Keeps the pairs of the grains that stay; `grains` are those.
    pub(in crate::dem) fn restrict(&mut self, stay: &Staying, grains: &Grains) {
        let (list, from) = self.list.of_those(stay);
        let kept = || from.iter().flatten();
        self.memory = kept().map(|&at| self.memory[at]).collect();
        self.pushes = kept().map(|&at| self.pushes[at]).collect();
        self.touching = self.pushes.iter().map(Push::touches).collect();
        let materials = |at: usize| list.pairs[at].map(|grain| grains.material(grain as usize));
        self.histories = self.model.chunks(&self.histories, &from, PAIRS, &materials);
        self.spent = self.losses();
        self.chunks = vec![Losses::default(); list.pairs.len().div_ceil(PAIRS)];
        self.list = list;
    }
}

impl<C: ContactLaw> Surfaces<C> {
    /// As [`Contacts::part_with`].
    pub(in crate::dem) fn part_with(&self, stay: &Staying, grains: &mut Grains, softening: f64) {
        let ended: Vec<(usize, f64)> = self
            .all()
            .filter(|held| stay.new[held.grain].is_none())
            .map(|held| (held.grain, flowed::<C>(&held, grains, softening)))
            .collect();
        for (grain, flowed) in ended {
            grains.plastic[grain] += flowed;
        }
    }

    /// As [`Contacts::restrict`], on bodies of these `materials`.
    pub(in crate::dem) fn restrict(
        &mut self,
        stay: &Staying,
        grains: &Grains,
        materials: &[Option<u8>],
    ) {
        let Self {
            model,
            solids,
            meshes,
            crowd: _, // seated anew
        } = self;
        solids.restrict(stay, grains, &**model, materials);
        meshes.restrict(stay, grains, &**model, materials);
        self.seat();
    }
}

impl<C: ContactLaw, const K: usize> Family<C, K> {
    fn restrict(
        &mut self,
        stay: &Staying,
        grains: &Grains,
        model: &dyn NormalModel,
        surfaces: &[Option<u8>],
    ) {
        let mut candidates = Vec::new();
        let mut patches: Vec<Patch<C::Memory>> = Vec::new();
        let mut from = Vec::new();
        self.start = vec![0; grains.len() + 1];
        for (at, &[grain, surface]) in self.candidates.iter().enumerate() {
            if let Some(grain) = stay.new[grain as usize] {
                candidates.push([grain, surface]);
                self.start[grain as usize + 1] += 1;
                patches.extend_from_slice(&self.patches[at * K..(at + 1) * K]);
                from.extend((at * K..(at + 1) * K).map(Some));
            }
        }
        (0..grains.len()).for_each(|grain| self.start[grain + 1] += self.start[grain]);
        let materials = |at: usize| {
            let [grain, surface] = candidates[at / K].map(|index| index as usize);
            [grains.material(grain), surfaces[surface].unwrap_or(RIGID)]
        };
        self.histories = model.chunks(&self.histories, &from, CANDIDATES * K, &materials);
        self.spent = self.losses();
        // points left out for want of room are told once, by the survey that comes after this
        let left_out = self.left_out();
        self.tallies = vec![Tally::default(); candidates.len().div_ceil(CANDIDATES)];
        if let Some(tally) = self.tallies.first_mut() {
            tally.left_out = left_out;
        }
        self.patches = patches;
        self.candidates = candidates;
    }
}
