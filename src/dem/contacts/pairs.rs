//! Contacts between grains: one law call a pair into its own slot, gathered by each grain in a fixed order.
//!
//! No two tasks write one place and every sum has one order, so a run is bitwise the same for any number of threads.

use crate::contact::Coverage;
use crate::contact::pair::Pressed;
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use crate::dem::force::meeting::{Meeting, Push};
use crate::dem::force::normal::{Histories, NormalModel, Squeeze};
use crate::dem::grains::Grains;
use crate::dem::grains::neighbours::HalfList;
use crate::dem::grains::periodic::IMAGES;
use parry3d::math::Vector;
use rayon::prelude::*;

/// Pairs evaluated by one task. Part of the result: sums of losses run over chunks of this size.
pub(in crate::dem) const CHUNK: usize = 512;
/// Pairs pressed by one call of the normal law: few enough to stay in the first cache.
const BLOCK: usize = 128;

/// All pairs of near grains with their histories and pushes.
pub struct Contacts<C: ContactLaw> {
    /// Pairs of near grains.
    pub list: HalfList,
    /// What each pair remembers beside its normal history.
    pub memory: Vec<C::Memory>,
    /// Push of each pair at the time of the positions, on its first grain; zero while apart.
    pub pushes: Vec<Push>,
    /// Whether each pair touched when it was last looked at.
    pub(in crate::dem) touching: Vec<bool>,
    pub(in crate::dem) model: Box<dyn NormalModel>,
    /// Normal histories of each chunk of pairs.
    pub(in crate::dem) histories: Vec<Box<dyn Histories>>,
    /// Losses of each chunk since the pairs were listed.
    pub(in crate::dem) chunks: Vec<Losses>,
    /// Losses before that.
    pub(in crate::dem) spent: Losses,
}

/// Pairs of one block that touch, in order, and those that have come apart since the step before.
struct Found {
    touching: [Near; BLOCK],
    parted: [Near; BLOCK],
    counts: [usize; 2],
}

/// A pair of a block between finding and pushing it.
#[derive(Clone, Copy, Default)]
struct Near {
    /// From the second to the first centre, m.
    line: Vector,
    /// Squared distance of the centres, m2.
    square: f64,
    /// Sum of the radii, m.
    reach: f64,
    /// Index within the chunk.
    at: u32,
}

/// What the normal law is told of the touching pairs of a block, and what it answers.
struct Pressing {
    at: [u32; BLOCK],
    squeezes: [Squeeze; BLOCK],
    inverse_distances: [f64; BLOCK],
    pressed: [Pressed; BLOCK],
}

/// One chunk of pairs, as one task sees it.
struct Chunk<'a, C: ContactLaw> {
    pairs: &'a [[u32; 2]],
    /// Image of each first grain; empty in an open room.
    images: &'a [u8],
    shifts: &'a [Vector; IMAGES],
    touching: &'a mut [bool],
    memory: &'a mut [C::Memory],
    pushes: &'a mut [Push],
    histories: &'a mut dyn Histories,
    losses: &'a mut Losses,
}

/// Kinematics of a pair of grains at `overlap` along `normal`.
#[inline(always)]
fn meeting<C: ContactLaw>(
    grains: &Grains,
    [i, j]: [u32; 2],
    squeeze: &Squeeze,
    normal: Vector,
    inverse_distance: f64,
    dt: f64,
) -> Meeting {
    let (i, j) = (i as usize, j as usize);
    let (a, b) = (&grains.motions[i], &grains.motions[j]);
    let velocity = a.velocity - b.velocity;
    Meeting {
        overlap: squeeze.overlap,
        normal,
        middle: normal - velocity * (0.5 * dt * inverse_distance),
        velocity,
        spins: [grains.spins[i].rate, grains.spins[j].rate],
        radii: squeeze.radii,
        inverse_mass: a.inverse_mass + b.inverse_mass,
        dt,
        materials: if C::BY_MATERIAL {
            [grains.material(i), grains.material(j)]
        } else {
            [0; 2]
        },
    }
}

impl<C: ContactLaw> Chunk<'_, C> {
    fn evaluate(&mut self, law: &C, grains: &Grains, dt: f64) {
        let mut found = Found {
            touching: [Near::default(); BLOCK],
            parted: [Near::default(); BLOCK],
            counts: [0; 2],
        };
        let mut pressing = Pressing {
            at: [0; BLOCK],
            squeezes: [Squeeze::default(); BLOCK],
            inverse_distances: [0.0; BLOCK],
            pressed: [Pressed::default(); BLOCK],
        };
        let mut losses = Losses::default();
        for first in (0..self.pairs.len()).step_by(BLOCK) {
            self.find(first, grains, &mut found);
            losses += self.part(law, grains, dt, &found.parted[..found.counts[1]]);
            let touching = &found.touching[..found.counts[0]];
            self.press(grains, touching, &mut pressing);
            for (k, near) in touching.iter().enumerate() {
                let at = near.at as usize;
                let inverse = pressing.inverse_distances[k];
                let meeting = meeting::<C>(
                    grains,
                    self.pairs[at],
                    &pressing.squeezes[k],
                    near.line * inverse,
                    inverse,
                    dt,
                );
                let (push, lost) = law.push(
                    &meeting,
                    &pressing.pressed[k],
                    &self.pushes[at],
                    &mut self.memory[at],
                );
                self.pushes[at] = push;
                losses += lost;
            }
        }
        *self.losses += losses;
    }

    /// Sorts the pairs of a block, without a branch: whether a listed pair touches cannot be foreseen.
    #[inline(always)]
    fn find(&mut self, first: usize, grains: &Grains, found: &mut Found) {
        let [mut touching, mut parted] = [0; 2];
        let open = self.images.is_empty();
        let last = (first + BLOCK).min(self.pairs.len());
        for at in first..last {
            let [a, b] = grains.both(self.pairs[at]);
            let (mut line, reach) = (a.centre - b.centre, a.radius + b.radius);
            if !open {
                line += self.shifts[self.images[at] as usize];
            }
            let square = line.length_squared();
            let near = Near {
                line,
                square,
                reach,
                at: at as u32,
            };
            let touches = square < reach * reach;
            found.touching[touching] = near;
            touching += usize::from(touches);
            found.parted[parted] = near;
            parted += usize::from(!touches & self.touching[at]);
            self.touching[at] = touches;
        }
        found.counts = [touching, parted];
    }

    /// Settles the account of pairs that have come apart.
    #[inline(always)]
    fn part(&mut self, law: &C, grains: &Grains, dt: f64, parted: &[Near]) -> Losses {
        let mut losses = Losses::default();
        for near in parted {
            let at = near.at as usize;
            let inverse = 1.0 / near.square.sqrt();
            let pair = self.pairs[at];
            let squeeze = Squeeze {
                overlap: 0.0,
                radii: grains.radii(pair),
            };
            let flowed = law.softening() * self.histories.dissipated(at, squeeze.radii);
            C::book_flow(&mut self.memory[at], flowed);
            self.histories.forget(at);
            let meeting = meeting::<C>(grains, pair, &squeeze, near.line * inverse, inverse, dt);
            let (push, lost) = law.push(
                &meeting,
                &Pressed::default(),
                &self.pushes[at],
                &mut self.memory[at],
            );
            self.pushes[at] = push;
            losses += lost;
        }
        losses
    }

    /// Calls the normal law for the touching pairs.
    #[inline(always)]
    fn press(&mut self, grains: &Grains, touching: &[Near], pressing: &mut Pressing) {
        for (k, near) in touching.iter().enumerate() {
            let distance = near.square.sqrt();
            let [i, j] = self.pairs[near.at as usize];
            pressing.at[k] = near.at;
            pressing.inverse_distances[k] = 1.0 / distance;
            pressing.squeezes[k] = Squeeze {
                overlap: near.reach - distance,
                radii: grains.radii([i, j]),
            };
        }
        let count = touching.len();
        self.histories.press(
            &pressing.at[..count],
            &pressing.squeezes[..count],
            &mut pressing.pressed[..count],
        );
    }
}

impl<C: ContactLaw> Contacts<C> {
    /// No contacts yet, under the normal law of `model`.
    #[must_use]
    pub fn new(model: Box<dyn NormalModel>) -> Self {
        Self {
            list: HalfList {
                start: vec![0],
                ..HalfList::default()
            },
            memory: Vec::new(),
            pushes: Vec::new(),
            touching: Vec::new(),
            model,
            histories: Vec::new(),
            chunks: Vec::new(),
            spent: Losses::default(),
        }
    }

    /// Evaluates the law for every pair.
    pub fn evaluate(&mut self, law: &C, grains: &Grains, dt: f64) {
        let (list, shifts) = (&self.list, &grains.room.shifts());
        let chunk =
            |at: usize, touching, memory, pushes, histories: &mut Box<dyn Histories>, losses| {
                let all = at * CHUNK..((at + 1) * CHUNK).min(list.pairs.len());
                let images = list.images.get(all.clone()).unwrap_or_default();
                let pairs = &list.pairs[all];
                let histories = &mut **histories;
                Chunk::<C> {
                    pairs,
                    images,
                    shifts,
                    touching,
                    memory,
                    pushes,
                    histories,
                    losses,
                }
                .evaluate(law, grains, dt);
            };
        if let [histories] = &mut self.histories[..] {
            chunk(
                0,
                &mut self.touching[..],
                &mut self.memory[..],
                &mut self.pushes[..],
                histories,
                &mut self.chunks[0],
            );
            return;
        }
        self.touching
            .par_chunks_mut(CHUNK)
            .zip(self.memory.par_chunks_mut(CHUNK))
            .zip(self.pushes.par_chunks_mut(CHUNK))
            .zip(self.histories.par_iter_mut())
            .zip(self.chunks.par_iter_mut())
            .enumerate()
            .for_each(
                |(at, ((((touching, memory), pushes), histories), losses))| {
                    chunk(at, touching, memory, pushes, histories, losses);
                },
            );
    }

    /// Whether one task does it all, so that other threads would only be waited for.
    #[must_use]
    pub fn is_small(&self) -> bool {
        self.chunks.len() <= 1
    }

    /// Lists the pairs anew; histories go with their pairs. A pair that leaves the list is apart: what its contact
    /// dissipated by plastic flow, its law `softening` times as stiff, is handed to its grains.
    pub fn relist(&mut self, grains: &mut Grains, skin: f64, softening: f64) {
        let list = HalfList::within(&grains.room, &grains.spheres, skin);
        for (at, &pair) in self.list.pairs.iter().enumerate() {
            if list.find(pair).is_none() {
                let radii = grains.radii(pair);
                let flowed = self.flowed(at, radii, softening);
                pair.iter()
                    .for_each(|&grain| grains.plastic[grain as usize] += 0.5 * flowed);
            }
        }
        let from: Vec<Option<usize>> = list
            .pairs
            .iter()
            .map(|&pair| self.list.find(pair))
            .collect();
        self.memory = from
            .iter()
            .map(|at| at.map_or_else(C::Memory::default, |at| self.memory[at]))
            .collect();
        self.pushes = from
            .iter()
            .map(|at| at.map_or_else(Push::default, |at| self.pushes[at]))
            .collect();
        self.touching = self.pushes.iter().map(Push::touches).collect();
        let materials = |at: usize| list.pairs[at].map(|grain| grains.material(grain as usize));
        self.histories = self.model.chunks(&self.histories, &from, CHUNK, &materials);
        self.spent = self.losses();
        self.chunks = vec![Losses::default(); list.pairs.len().div_ceil(CHUNK)];
        self.list = list;
    }

    /// Energy dissipated so far, plastic flow apart.
    #[must_use]
    pub fn losses(&self) -> Losses {
        let mut sum = self.spent;
        self.chunks.iter().for_each(|&chunk| sum += chunk);
        sum
    }

    /// Force and torque of all pairs on a grain, in the order of the list. Pairs that are apart add their zeros: less
    /// than a guess at which they are.
    #[inline(always)]
    #[must_use]
    pub fn load(&self, grain: usize) -> (Vector, Vector) {
        let (mut force, mut torque) = (Vector::ZERO, Vector::ZERO);
        let row = self.list.first(grain);
        for (push, memory) in self.pushes[row.clone()].iter().zip(&self.memory[row]) {
            force += push.force;
            if C::ROTATES {
                torque += push.couple * push.arms[0] + C::moment(memory);
            }
        }
        for &index in self.list.second(grain) {
            let push = &self.pushes[index as usize];
            force -= push.force;
            if C::ROTATES {
                torque += push.couple * push.arms[1] - C::moment(&self.memory[index as usize]);
            }
        }
        (force, torque)
    }

    /// Line (m) from the second to the first centre of a pair, by the way on which they meet.
    #[inline(always)]
    #[must_use]
    pub fn line(&self, index: usize, grains: &Grains) -> Vector {
        let [a, b] = grains
            .both(self.list.pairs[index])
            .map(|sphere| sphere.centre);
        match self.list.images.get(index) {
            None => a - b,
            Some(&image) => a - b + grains.room.shift(image),
        }
    }
}

/// Queries on a listed pair, for measures and output.
impl<C: ContactLaw> Contacts<C> {
    /// Recoverable energy (J) of a pair, its law at full stiffness.
    #[must_use]
    pub fn elastic_energy(&self, index: usize, squeeze: Squeeze) -> f64 {
        if squeeze.overlap > 0.0 {
            self.histories[index / CHUNK].elastic_energy(index % CHUNK, squeeze)
        } else {
            0.0
        }
    }

    /// Energy (J) plastic flow has dissipated between a pair of `radii` (m), its law `softening` times as stiff.
    #[must_use]
    pub fn flowed(&self, index: usize, radii: [f64; 2], softening: f64) -> f64 {
        C::flowed(&self.memory[index]) + softening * self.dissipated(index, radii)
    }

    /// The part of that which the normal history tells, its law at full stiffness.
    #[must_use]
    pub fn dissipated(&self, index: usize, radii: [f64; 2]) -> f64 {
        self.histories[index / CHUNK].dissipated(index % CHUNK, radii)
    }

    /// Largest stiffness (N/m) of a pair, its law at full stiffness.
    #[must_use]
    pub fn stiffest(&self, index: usize, squeeze: Squeeze) -> f64 {
        self.histories[index / CHUNK].stiffest(index % CHUNK, squeeze)
    }

    /// Largest overlap (m) so far of a pair, where its law remembers it.
    #[must_use]
    pub fn largest_overlap(&self, index: usize, radii: [f64; 2]) -> Option<f64> {
        self.histories[index / CHUNK].largest_overlap(index % CHUNK, radii)
    }

    /// What of a pair lies within the range of its law.
    #[must_use]
    pub fn coverage(&self, index: usize, squeeze: Squeeze) -> Coverage {
        self.histories[index / CHUNK].coverage(index % CHUNK, squeeze)
    }

    /// Whether both hold the same pairs, pushes and histories, bit for bit.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        let histories = self
            .histories
            .iter()
            .zip(&other.histories)
            .all(|(a, b)| a.same(&**b));
        histories
            && self.list == other.list
            && self.memory == other.memory
            && self.pushes == other.pushes
    }
}
