//! Patches: the contacts of grains with one kind of surface, evaluated by chunks; each keeps its own history.

use super::member::{ALONE, Member, Place, Turnover};
pub use super::patch::{Held, Patch};
use crate::contact::pair::Pressed;
use crate::dem::bodies::machine::{Machine, Surface};
use crate::dem::bodies::touching::{Scratch, Touch, Touches, closest, minima};
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use crate::dem::force::meeting::{Course, Meeting, over_surface};
use crate::dem::force::mixture::RIGID;
use crate::dem::force::normal::{Histories, NormalModel, Squeeze};
use crate::dem::grains::Grains;
use parry3d::math::Vector;
use rayon::prelude::*;
use std::any::Any;

/// Candidates evaluated by one task. Part of the result: sums of losses run over chunks of this size.
pub(in crate::dem) const CHUNK: usize = 128;
/// Least cosine between the normals of one contact at two steps: a contact that turned more is another one.
pub(super) const SAME_CONTACT: f64 = 0.9;

/// What a task sums up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::dem) struct Tally {
    pub(in crate::dem) losses: Losses,
    pub(in crate::dem) left_out: u32,
}

/// Candidates of one kind of surface: `K` patches for each pair of a grain and a surface near it.
pub(in crate::dem) struct Family<C: ContactLaw, const K: usize> {
    /// Grain and surface of each candidate, in order.
    pub(in crate::dem) candidates: Vec<[u32; 2]>,
    /// Seat of each candidate among the members of a crowd.
    pub(in crate::dem) seats: Vec<u32>,
    /// Row of each grain: `candidates[start[i]..start[i + 1]]`.
    pub(in crate::dem) start: Vec<u32>,
    /// `K` patches for each candidate.
    pub(in crate::dem) patches: Vec<Patch<C::Memory>>,
    /// Normal histories of each chunk of patches.
    pub(in crate::dem) histories: Vec<Box<dyn Histories>>,
    pub(in crate::dem) tallies: Vec<Tally>,
    pub(in crate::dem) spent: Losses,
}

impl<C: ContactLaw, const K: usize> Default for Family<C, K> {
    fn default() -> Self {
        Self {
            candidates: Vec::new(),
            seats: Vec::new(),
            start: vec![0],
            patches: Vec::new(),
            histories: Vec::new(),
            tallies: Vec::new(),
            spent: Losses::default(),
        }
    }
}

/// What a task writes beside its patches.
struct Task<'a> {
    histories: &'a mut dyn Histories,
    tally: &'a mut Tally,
    scratch: Scratch,
    /// First patch of the present candidate within the chunk.
    first: usize,
}

/// What an evaluation reads.
pub(in crate::dem) struct Situation<'a, C> {
    /// Effects of the contacts.
    pub law: &'a C,
    /// Grains.
    pub grains: &'a Grains,
    /// Bodies.
    pub machine: &'a Machine,
    /// Time step, s.
    pub dt: f64,
}

impl<C: ContactLaw> Situation<'_, C> {
    /// Touched points of one grain on one surface.
    pub(super) fn touches(
        &self,
        [grain, surface]: [usize; 2],
        is_mesh: bool,
        scratch: &mut Scratch,
    ) -> Touches {
        let sphere = &self.grains.spheres[grain];
        let unit = self.machine.unit;
        let body = &self.machine.surfaces[surface];
        let centre = body.pose.inverse_transform_point(sphere.centre / unit);
        let reach = sphere.radius / unit;
        match body.shape.as_trimesh() {
            Some(mesh) if is_mesh => minima(mesh, centre, reach, scratch),
            _ => Touches::one(closest(&*body.shape, centre, reach)),
        }
    }

    /// Evaluates one chunk of candidates, with their seats in the crowd.
    fn meet_all<const K: usize>(
        &self,
        crowd: &[Member],
        (candidates, seats): (&[[u32; 2]], &[u32]),
        patches: &mut [Patch<C::Memory>],
        histories: &mut dyn Histories,
        tally: &mut Tally,
    ) {
        let mut task = Task {
            histories,
            tally,
            scratch: Scratch::default(),
            first: 0,
        };
        let candidates = candidates.iter().zip(seats);
        for ((&pair, &seat), patches) in candidates.zip(patches.chunks_exact_mut(K)) {
            let found = match seat {
                ALONE => None,
                _ => Some(&crowd[seat as usize].touches),
            };
            self.meet::<K>(pair, found, patches, &mut task);
            task.first += K;
        }
    }

    /// Evaluates the contacts of one grain with one surface; its points are `found` already if others are near.
    fn meet<const K: usize>(
        &self,
        pair: [u32; 2],
        found: Option<&Touches>,
        patches: &mut [Patch<C::Memory>],
        task: &mut Task,
    ) {
        let (grain, surface) = (pair[0] as usize, pair[1] as usize);
        let unit = self.machine.unit;
        let body = &self.machine.surfaces[surface];
        let place = |task: &mut Task,
                     k: usize,
                     patch: &mut Patch<C::Memory>,
                     touch: Option<&Touch>| {
            if touch.is_some() || patch.push.touches() {
                let near = touch.map(|t| (body.pose.transform_vector(t.normal), t.distance * unit));
                task.tally.losses += self.push(pair, near, patch, task.histories, task.first + k);
            }
        };
        if K == 1 {
            let touch = match found {
                Some(touches) => touches.as_slice().first().copied(),
                None => {
                    let sphere = &self.grains.spheres[grain];
                    let centre = body.pose.inverse_transform_point(sphere.centre / unit);
                    closest(&*body.shape, centre, sphere.radius / unit)
                }
            };
            place(task, 0, &mut patches[0], touch.as_ref());
            return;
        }
        let own;
        let touches = match found {
            Some(touches) => touches,
            None => {
                own = self.touches([grain, surface], true, &mut task.scratch);
                &own
            }
        };
        task.tally.left_out += touches.left_out;
        let chosen = assign::<C::Memory, K>(touches.as_slice(), patches, |n| {
            body.pose.transform_vector(n)
        });
        for (k, (patch, touch)) in patches.iter_mut().zip(chosen).enumerate() {
            place(task, k, patch, touch.map(|at| &touches.as_slice()[at]));
        }
    }

    /// Calls the law for a grain whose surface point lies at `near` (normal, distance in m), or has gone away.
    fn push(
        &self,
        pair: [u32; 2],
        near: Option<(Vector, f64)>,
        patch: &mut Patch<C::Memory>,
        histories: &mut dyn Histories,
        at: usize,
    ) -> Losses {
        let (grain, surface) = (pair[0] as usize, pair[1] as usize);
        let sphere = &self.grains.spheres[grain];
        let motion = &self.grains.motions[grain];
        let body = &self.machine.stations[surface];
        let (normal, distance) = near.unwrap_or((patch.normal, sphere.radius));
        let point = sphere.centre - normal * distance;
        let before = patch.push.touches().then_some(patch.normal);
        let course = Course {
            centre: sphere.centre,
            velocity: motion.velocity,
            spin: self.grains.spins[grain].rate,
        };
        let then = body.half_before(self.dt);
        let [middle, velocity] = over_surface(
            &course,
            |point, normal| then.surface_velocity(point, normal),
            [normal, before.unwrap_or(normal)],
            distance,
            self.dt,
        );
        let meeting = Meeting {
            overlap: sphere.radius - distance,
            normal,
            middle,
            velocity,
            spins: [course.spin, body.surface_spin()],
            radii: [sphere.radius, f64::INFINITY],
            inverse_mass: motion.inverse_mass + body.inverse_mass,
            dt: self.dt,
            materials: [
                self.grains.material(grain),
                self.machine.materials[surface].unwrap_or(RIGID),
            ],
        };
        let mut pressed = [Pressed::default()];
        if meeting.overlap > 0.0 {
            let squeeze = Squeeze {
                overlap: meeting.overlap,
                radii: meeting.radii,
            };
            histories.press(&[at as u32], &[squeeze], &mut pressed);
        } else {
            let flowed = self.law.softening() * histories.dissipated(at, meeting.radii);
            C::book_flow(&mut patch.memory, flowed);
            histories.forget(at);
        }
        let (push, losses) = self
            .law
            .push(&meeting, &pressed[0], &patch.push, &mut patch.memory);
        patch.push = push;
        patch.point = point;
        patch.normal = normal;
        losses
    }
}

/// Touch of each patch: a contact keeps its patch while its normal turns little, a new one takes a free patch.
fn assign<M, const K: usize>(
    touches: &[Touch],
    patches: &[Patch<M>],
    to_world: impl Fn(Vector) -> Vector,
) -> [Option<usize>; K] {
    let mut chosen = [None; K];
    let mut homeless = [false; K];
    for (at, touch) in touches.iter().enumerate() {
        let normal = to_world(touch.normal);
        let likeness = |k: &usize| patches[*k].normal.dot(normal);
        let home = (0..K)
            .filter(|&k| {
                chosen[k].is_none() && patches[k].push.touches() && likeness(&k) > SAME_CONTACT
            })
            .max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
        match home {
            Some(k) => chosen[k] = Some(at),
            None => homeless[at] = true,
        }
    }
    for (at, _) in homeless
        .iter()
        .enumerate()
        .filter(|&(_, &homeless)| homeless)
    {
        let free = (0..K)
            .find(|&k| chosen[k].is_none() && !patches[k].push.touches())
            .or_else(|| (0..K).find(|&k| chosen[k].is_none()));
        if let Some(k) = free {
            chosen[k] = Some(at);
        }
    }
    chosen
}

/// Energy (J) plastic flow has dissipated in a surface contact, its law `softening` times as stiff.
pub(in crate::dem) fn flowed<C: ContactLaw>(
    held: &Held<C::Memory>,
    grains: &Grains,
    softening: f64,
) -> f64 {
    C::flowed(&held.patch.memory) + softening * held.dissipated(grains)
}

impl<C: ContactLaw, const K: usize> Family<C, K> {
    pub(in crate::dem) fn evaluate(&mut self, situation: &Situation<C>, crowd: &[Member]) {
        if let [histories] = &mut self.histories[..] {
            situation.meet_all::<K>(
                crowd,
                (&self.candidates, &self.seats),
                &mut self.patches,
                &mut **histories,
                &mut self.tallies[0],
            );
            return;
        }
        self.candidates
            .par_chunks(CHUNK)
            .zip(self.seats.par_chunks(CHUNK))
            .zip(self.patches.par_chunks_mut(CHUNK * K))
            .zip(self.histories.par_iter_mut())
            .zip(self.tallies.par_iter_mut())
            .for_each(|(((candidates, patches), histories), tally)| {
                situation.meet_all::<K>(crowd, candidates, patches, &mut **histories, tally);
            });
    }

    /// Patches of a candidate whose contacts end or begin when it is touched at `touches`.
    pub(super) fn turnover(&self, candidate: usize, touches: &Touches, body: &Surface) -> Turnover {
        let first = candidate * K;
        let patches = &self.patches[first..first + K];
        let to_world = |n| body.pose.transform_vector(n);
        let chosen = match K {
            // a solid is touched at one point, whichever way its normal turns
            1 => [(!touches.as_slice().is_empty()).then_some(0); K],
            _ => assign::<C::Memory, K>(touches.as_slice(), patches, to_world),
        };
        let mut turnover = Turnover::default();
        for (k, (patch, touch)) in patches.iter().zip(chosen).enumerate() {
            let place = |normal| Place {
                patch: first + k,
                normal,
            };
            match (patch.push.touches(), touch) {
                (true, None) => turnover.ending.push(place(patch.normal)),
                (false, Some(at)) => {
                    let normal = to_world(touches.as_slice()[at].normal);
                    turnover.beginning.push(place(normal));
                }
                _ => {}
            }
        }
        turnover
    }

    /// Takes the contact out of a patch.
    pub(super) fn take(&mut self, at: usize) -> (Patch<C::Memory>, Box<dyn Any>) {
        let history = self.histories[at / (CHUNK * K)].take(at % (CHUNK * K));
        (std::mem::take(&mut self.patches[at]), history)
    }

    /// Puts a contact taken elsewhere into a patch.
    pub(super) fn put(&mut self, at: usize, contact: (Patch<C::Memory>, Box<dyn Any>)) {
        self.patches[at] = contact.0;
        self.histories[at / (CHUNK * K)].put(at % (CHUNK * K), &*contact.1);
    }

    /// Lists the candidates anew; patches go with them.
    pub(in crate::dem) fn relist(
        &mut self,
        candidates: Vec<[u32; 2]>,
        grains: &mut Grains,
        model: &dyn NormalModel,
        surfaces: &[Option<u8>],
        softening: f64,
    ) {
        let mut patches = vec![Patch::default(); candidates.len() * K];
        let mut from = vec![None; candidates.len() * K];
        for (old, pair) in self.candidates.iter().enumerate() {
            let kept = &self.patches[old * K..(old + 1) * K];
            match candidates.binary_search(pair) {
                Ok(new) => {
                    patches[new * K..(new + 1) * K].copy_from_slice(kept);
                    (0..K).for_each(|k| from[new * K + k] = Some(old * K + k));
                }
                Err(_) => {
                    let radii = [grains.spheres[pair[0] as usize].radius, f64::INFINITY];
                    let flowed: f64 = (old * K..)
                        .zip(kept)
                        .map(|(at, patch)| {
                            let history = &self.histories[at / (CHUNK * K)];
                            C::flowed(&patch.memory)
                                + softening * history.dissipated(at % (CHUNK * K), radii)
                        })
                        .sum();
                    grains.plastic[pair[0] as usize] += flowed;
                }
            }
        }
        let materials = |at: usize| {
            let [grain, surface] = candidates[at / K];
            let (grain, surface) = (grain as usize, surface as usize);
            [grains.material(grain), surfaces[surface].unwrap_or(RIGID)]
        };
        self.histories = model.chunks(&self.histories, &from, CHUNK * K, &materials);
        self.spent = self.losses();
        self.tallies = vec![Tally::default(); candidates.len().div_ceil(CHUNK)];
        self.start = vec![0; grains.len() + 1];
        candidates
            .iter()
            .for_each(|pair| self.start[pair[0] as usize + 1] += 1);
        (0..grains.len()).for_each(|grain| self.start[grain + 1] += self.start[grain]);
        self.patches = patches;
        self.candidates = candidates;
    }

    pub(in crate::dem) fn release(&mut self, surface: usize, grains: &mut Grains, softening: f64) {
        let plastic: Vec<(usize, usize, f64)> = self
            .all()
            .enumerate()
            .filter(|(_, held)| held.surface == surface)
            .map(|(at, held)| (at, held.grain, flowed::<C>(&held, grains, softening)))
            .collect();
        for (at, grain, lost) in plastic {
            grains.plastic[grain] += lost;
            self.patches[at] = Patch::default();
            self.histories[at / (CHUNK * K)].forget(at % (CHUNK * K));
        }
    }

    pub(in crate::dem) fn start_account(&mut self, grains: &Grains, softening: f64) {
        let before: Vec<f64> = self
            .all()
            .map(|held| flowed::<C>(&held, grains, softening))
            .collect();
        for (patch, before) in self.patches.iter_mut().zip(before) {
            C::book_flow(&mut patch.memory, -before);
        }
    }

    pub(in crate::dem) fn law_work(&self, grains: &Grains) -> f64 {
        let work = |held: Held<'_, _>| held.elastic_energy(grains) + held.dissipated(grains);
        self.all().map(work).sum()
    }

    pub(in crate::dem) fn same(&self, other: &Self) -> bool {
        let histories = self
            .histories
            .iter()
            .zip(&other.histories)
            .all(|(a, b)| a.same(&**b));
        histories && self.candidates == other.candidates && self.patches == other.patches
    }

    pub(in crate::dem) fn losses(&self) -> Losses {
        let mut sum = self.spent;
        self.tallies.iter().for_each(|tally| sum += tally.losses);
        sum
    }

    #[inline(always)]
    pub(in crate::dem) fn of(&self, grain: usize) -> &[Patch<C::Memory>] {
        &self.patches[self.start[grain] as usize * K..self.start[grain + 1] as usize * K]
    }

    pub(in crate::dem) fn all(&self) -> impl Iterator<Item = Held<'_, C::Memory>> {
        self.patches.iter().enumerate().map(|(at, patch)| {
            let [grain, surface] = self.candidates[at / K];
            let (grain, surface) = (grain as usize, surface as usize);
            let history = (&*self.histories[at / (CHUNK * K)], at % (CHUNK * K));
            Held {
                grain,
                surface,
                patch,
                history,
            }
        })
    }

    /// Touching points left out for want of room since the last listing.
    pub(in crate::dem) fn left_out(&self) -> u32 {
        self.tallies.iter().map(|tally| tally.left_out).sum()
    }
}
