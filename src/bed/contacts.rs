//! Contacts between grains: one law call a pair into its own slot, gathered by each grain in a fixed order.
//!
//! No two tasks write one place and every sum has one order, so a run is bitwise the same for any number of threads.

use super::grains::Grains;
use super::law::{ContactLaw, Losses, Meeting, Push};
use super::neighbours::HalfList;
use super::normals::{Histories, NormalModel, Squeeze};
use super::periodic::IMAGES;
use crate::contact::pair::Pressed;
use parry3d::math::Vector;
use rayon::prelude::*;

/// Pairs evaluated by one task. Part of the result: sums of losses run over chunks of this size.
pub(super) const CHUNK: usize = 512;
/// Pairs pressed by one call of the normal law: few enough to stay in the first cache.
const BLOCK: usize = 128;

/// All pairs of near grains with their histories and pushes.
pub struct Contacts<C: ContactLaw> {
    /// Pairs of near grains.
    pub list: HalfList,
    /// What each pair remembers beside its normal history.
    pub memory: Vec<C::Memory>,
    /// Push of each pair at the time of the positions, on its first grain.
    pub pushes: Vec<Push>,
    pub(super) model: Box<dyn NormalModel>,
    /// Normal histories of each chunk of pairs.
    pub(super) histories: Vec<Box<dyn Histories>>,
    /// Losses of each chunk since the pairs were listed.
    pub(super) chunks: Vec<Losses>,
    /// Losses before that.
    pub(super) spent: Losses,
}

/// A touching pair between finding and pushing it.
#[derive(Clone, Copy, Default)]
struct Found {
    normal: Vector,
    at: u32,
}

/// One chunk of pairs, as one task sees it.
struct Chunk<'a, C: ContactLaw> {
    pairs: &'a [[u32; 2]],
    /// Image of each first grain; empty in an open room.
    images: &'a [u8],
    shifts: &'a [Vector; IMAGES],
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
    overlap: f64,
    normal: Vector,
    dt: f64,
) -> Meeting {
    let (i, j) = (i as usize, j as usize);
    let (a, b) = (&grains.motions[i], &grains.motions[j]);
    let radii = [grains.spheres[i].radius, grains.spheres[j].radius];
    Meeting {
        overlap,
        normal,
        velocity: a.velocity - b.velocity,
        spins: [grains.spins[i].rate, grains.spins[j].rate],
        radii,
        inverse_distance: 1.0 / (radii[0] + radii[1] - overlap),
        mass: 1.0 / (a.inverse_mass + b.inverse_mass),
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
        let mut at = [0; BLOCK];
        let mut found = [Found::default(); BLOCK];
        let mut squeezes = [Squeeze::default(); BLOCK];
        let mut pressed = [Pressed::default(); BLOCK];
        for first in (0..self.pairs.len()).step_by(BLOCK) {
            let count = self.find(first, law, grains, dt, &mut found, &mut squeezes);
            for (at, found) in at.iter_mut().zip(&found[..count]) {
                *at = found.at;
            }
            self.histories
                .press(&at[..count], &squeezes[..count], &mut pressed[..count]);
            for ((found, squeeze), pressed) in found[..count].iter().zip(&squeezes).zip(&pressed) {
                let at = found.at as usize;
                let meeting =
                    meeting::<C>(grains, self.pairs[at], squeeze.overlap, found.normal, dt);
                let (push, losses) =
                    law.push(&meeting, pressed, &self.pushes[at], &mut self.memory[at]);
                self.pushes[at] = push;
                *self.losses += losses;
            }
        }
    }

    /// Finds the touching pairs of a block; settles the account of those that have come apart. Returns their number.
    #[inline(always)]
    fn find(
        &mut self,
        first: usize,
        law: &C,
        grains: &Grains,
        dt: f64,
        found: &mut [Found; BLOCK],
        squeezes: &mut [Squeeze; BLOCK],
    ) -> usize {
        let mut count = 0;
        let open = self.images.is_empty();
        let last = (first + BLOCK).min(self.pairs.len());
        for at in first..last {
            let pair = self.pairs[at];
            let (a, b) = (
                &grains.spheres[pair[0] as usize],
                &grains.spheres[pair[1] as usize],
            );
            let (mut line, reach) = (a.centre - b.centre, a.radius + b.radius);
            if !open {
                line += self.shifts[self.images[at] as usize];
            }
            let square = line.length_squared();
            if square < reach * reach {
                let distance = square.sqrt();
                found[count] = Found {
                    normal: line * (1.0 / distance),
                    at: at as u32,
                };
                squeezes[count] = Squeeze {
                    overlap: reach - distance,
                    radii: [a.radius, b.radius],
                };
                count += 1;
            } else if self.pushes[at].touches() {
                self.histories.forget(at);
                let meeting = meeting::<C>(grains, pair, 0.0, line / square.sqrt(), dt);
                let (push, losses) = law.push(
                    &meeting,
                    &Pressed::default(),
                    &self.pushes[at],
                    &mut self.memory[at],
                );
                self.pushes[at] = push;
                *self.losses += losses;
            }
        }
        count
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
            model,
            histories: Vec::new(),
            chunks: Vec::new(),
            spent: Losses::default(),
        }
    }

    /// Evaluates the law for every pair.
    pub fn evaluate(&mut self, law: &C, grains: &Grains, dt: f64) {
        let (list, shifts) = (&self.list, &grains.room.shifts());
        let chunk = |at: usize, memory, pushes, histories: &mut Box<dyn Histories>, losses| {
            let all = at * CHUNK..((at + 1) * CHUNK).min(list.pairs.len());
            let images = list.images.get(all.clone()).unwrap_or_default();
            let pairs = &list.pairs[all];
            let histories = &mut **histories;
            Chunk::<C> {
                pairs,
                images,
                shifts,
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
                &mut self.memory[..],
                &mut self.pushes[..],
                histories,
                &mut self.chunks[0],
            );
            return;
        }
        self.memory
            .par_chunks_mut(CHUNK)
            .zip(self.pushes.par_chunks_mut(CHUNK))
            .zip(self.histories.par_iter_mut())
            .zip(self.chunks.par_iter_mut())
            .enumerate()
            .for_each(|(at, (((memory, pushes), histories), losses))| {
                chunk(at, memory, pushes, histories, losses);
            });
    }

    /// Whether one task does it all, so that other threads would only be waited for.
    #[must_use]
    pub fn is_small(&self) -> bool {
        self.chunks.len() <= 1
    }

    /// Lists the pairs anew; histories go with their pairs. A pair that leaves the list is apart: what its contact
    /// dissipated by plastic flow is handed to its grains.
    pub fn relist(&mut self, grains: &mut Grains, skin: f64) {
        let list = HalfList::within(&grains.room, &grains.spheres, skin);
        for (memory, &pair) in self.memory.iter().zip(&self.list.pairs) {
            if list.find(pair).is_none() {
                pair.iter()
                    .for_each(|&grain| grains.plastic[grain as usize] += 0.5 * C::work(memory));
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

    /// Force and torque of all pairs on a grain, in the order of the list.
    #[inline(always)]
    #[must_use]
    pub fn load(&self, grain: usize) -> (Vector, Vector) {
        let (mut force, mut torque) = (Vector::ZERO, Vector::ZERO);
        for index in self.list.first(grain) {
            let push = &self.pushes[index];
            if !push.touches() {
                continue;
            }
            force += push.force;
            if C::ROTATES {
                torque += push.couple * push.arms[0] + C::moment(&self.memory[index]);
            }
        }
        for &index in self.list.second(grain) {
            let push = &self.pushes[index as usize];
            if !push.touches() {
                continue;
            }
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
        let [a, b] = self.list.pairs[index].map(|grain| grains.spheres[grain as usize].centre);
        match self.list.images.get(index) {
            None => a - b,
            Some(&image) => a - b + grains.room.shift(image),
        }
    }

    /// Recoverable energy (J) of a pair, its law at full stiffness.
    #[must_use]
    pub fn elastic_energy(&self, index: usize, squeeze: Squeeze) -> f64 {
        if squeeze.overlap > 0.0 {
            self.histories[index / CHUNK].elastic_energy(index % CHUNK, squeeze)
        } else {
            0.0
        }
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

    /// Largest flattening over radius the normal law's source supports.
    #[must_use]
    pub fn valid_to(&self) -> f64 {
        self.model.valid_to()
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
