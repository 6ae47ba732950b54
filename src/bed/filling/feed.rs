//! Feed: the grains that are still to come, and when.

use super::lattice::{Source, lattice, random_of};
use super::space::Space;
use crate::bed::scene::{Amount, Insertion, Scene, Stage};
use crate::dem::bodies::machine::Machine;
use crate::dem::grains::Grains;
use crate::dem::grains::newcomer::Newcomer;
use crate::tape::keep_fields;
use parry3d::math::Vector;
use rand::RngExt;

/// Places tried for one grain of a stream before it has to wait.
const TRIES: u64 = 32;

/// How far a group has come in.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Inflow {
    /// Whether it comes in now.
    pub active: bool,
    /// Grains that are in.
    pub grains: usize,
    /// Their mass, kg.
    pub mass: f64,
    /// Batches begun.
    pub batches: u64,
    /// Time its stream began, s.
    pub began: f64,
}
keep_fields!(Inflow: active, grains, mass, batches, began);

/// Grains to come, group by group.
#[derive(Debug, Clone, PartialEq)]
pub struct Feed {
    seed: u64,
    sources: Vec<Source>,
    /// One for each group of the scene.
    pub inflows: Vec<Inflow>,
}
keep_fields!(Feed: inflows; rebuilt seed, sources);

impl Feed {
    /// Nothing has come in; groups that no stage inserts are active.
    #[must_use]
    pub fn new(scene: &Scene, seed: u64) -> Self {
        let later = |index: usize| {
            scene.stages.iter().any(|stage| match stage {
                Stage::Run(run) => run.insert.contains(&index),
                _ => false,
            })
        };
        let inflow = |index| Inflow {
            active: !later(index),
            ..Inflow::default()
        };
        Self {
            seed,
            sources: (0..scene.groups.len())
                .map(|index| Source::of(scene, index))
                .collect(),
            inflows: (0..scene.groups.len()).map(inflow).collect(),
        }
    }

    /// Groups that stand on their lattices before the first step.
    #[must_use]
    pub fn initial(&self) -> Vec<usize> {
        let sources = self.sources.iter().zip(&self.inflows).enumerate();
        let initial = sources.filter(|(_, (source, inflow))| {
            inflow.active && source.group.insertion == Insertion::Lattice
        });
        initial.map(|(index, _)| index).collect()
    }

    /// Lets groups come in from `time` (s) on.
    pub fn begin(&mut self, groups: &[usize], time: f64) {
        for &group in groups {
            self.inflows[group].active = true;
            self.inflows[group].began = time;
        }
    }

    /// Counts time from `now` (s) on, as a bed does that goes on from a packing.
    pub fn restart_clock(&mut self, now: f64) {
        self.inflows
            .iter_mut()
            .for_each(|inflow| inflow.began -= now);
    }

    /// Whether all grains of a group are in.
    #[must_use]
    pub fn is_complete(&self, group: usize) -> bool {
        is_reached(self.sources[group].group.amount, &self.inflows[group])
    }

    /// Whether no active group has grains to come.
    #[must_use]
    pub fn is_done(&self) -> bool {
        (0..self.inflows.len()).all(|group| !self.inflows[group].active || self.is_complete(group))
    }

    /// Share of the radius by which grains of a group may overlap with what is there as they come in.
    #[must_use]
    pub fn overlap_of(&self, group: usize) -> f64 {
        self.sources[group].overlap()
    }

    /// Group of a grain that was there from the start, by its name.
    #[must_use]
    pub fn group_of(&self, id: u32) -> usize {
        let mut last = 0;
        let among = |inflow: &Inflow| {
            last += inflow.grains;
            (id as usize) < last
        };
        self.inflows.iter().position(among).unwrap_or(0)
    }

    /// What active groups lack, and which bodies are in their way: a sentence for each group.
    #[must_use]
    pub fn missing(&self, machine: &Machine) -> Vec<String> {
        let groups = self.sources.iter().zip(&self.inflows);
        let missing = groups
            .filter(|(source, inflow)| inflow.active && !is_reached(source.group.amount, inflow));
        let sentence = |(source, inflow): (&Source, &Inflow)| {
            let space = Space::of(source.corners, &Grains::default(), &[], machine);
            let bodies = space.bodies();
            let way = match bodies.is_empty() {
                true => String::new(),
                false => format!("; in the way of its region: {}", bodies.join(", ")),
            };
            let name = &source.group.name;
            format!(
                "not all grains of the group \"{name}\" came in, only {}{way}",
                inflow.grains
            )
        };
        missing.map(sentence).collect()
    }

    /// Next lattice of a group, counted in; places that are not `free` are left out.
    pub fn lattice(&mut self, group: usize, free: impl Fn(Vector, f64) -> bool) -> Vec<Newcomer> {
        let (source, inflow) = (&self.sources[group], &mut self.inflows[group]);
        let mut random = random_of(self.seed, group, inflow.batches);
        inflow.batches += 1;
        lattice(source, &mut random, free, |last| {
            if let Some(grain) = last {
                inflow.count(grain);
            }
            is_reached(source.group.amount, inflow)
        })
    }

    /// Grains that come in at `time` (s), clear of grains, their images and bodies; what finds no room waits.
    pub fn due(&mut self, grains: &Grains, machine: &Machine, time: f64) -> Vec<Newcomer> {
        let mut newcomers = Vec::new();
        for index in 0..self.sources.len() {
            if !self.inflows[index].active || self.is_complete(index) {
                continue;
            }
            let source = &self.sources[index];
            let insertion = source.group.insertion;
            let mut space = Space::of(source.corners, grains, &newcomers, machine);
            match insertion {
                Insertion::Lattice => newcomers.extend(self.whole(index, &space)),
                Insertion::Pour if space.is_clear_of_grains() => {
                    let free = |centre, radius| space.body_at(centre, radius).is_none();
                    newcomers.extend(self.lattice(index, free));
                }
                Insertion::Pour => {}
                Insertion::Stream(rate) => {
                    let due = rate * (time - self.inflows[index].began);
                    while self.inflows[index].mass < due && !self.is_complete(index) {
                        let Some(newcomer) = self.one(index, &space) else {
                            break;
                        };
                        space.take(&newcomer);
                        newcomers.push(newcomer);
                    }
                }
            }
        }
        newcomers
    }

    /// All grains of a lattice, or none while one of them has no room.
    fn whole(&mut self, index: usize, space: &Space) -> Vec<Newcomer> {
        let before = self.inflows[index];
        let all = self.lattice(index, |_, _| true);
        let share = 1.0 - self.sources[index].overlap();
        let is_free = |one: &Newcomer| space.is_free(one.centre, share * one.radius);
        if all.iter().all(is_free) {
            return all;
        }
        self.inflows[index] = before;
        Vec::new()
    }

    /// One grain of a stream at a random free place, if one is found.
    fn one(&mut self, index: usize, space: &Space) -> Option<Newcomer> {
        let (source, inflow) = (&self.sources[index], &mut self.inflows[index]);
        let mut random = random_of(self.seed, index, inflow.batches);
        let radius = source.group.sizes.draw(&mut random);
        let velocity = source.velocity(&mut random);
        let region = source.group.region?;
        let [low, high] = region.corners();
        for _ in 0..TRIES {
            let mut share = || random.random_range(0.0..=1.0);
            let centre = low + (high - low) * Vector::new(share(), share(), share());
            if region.holds(centre, radius) && space.is_free(centre, radius) {
                let newcomer = source.newcomer(centre, radius, velocity);
                inflow.batches += 1;
                inflow.count(&newcomer);
                return Some(newcomer);
            }
        }
        None
    }
}

impl Inflow {
    /// Counts a grain in.
    fn count(&mut self, grain: &Newcomer) {
        self.grains += 1;
        self.mass += grain.mass();
    }
}

/// Whether a group has come in by its amount.
fn is_reached(amount: Amount, inflow: &Inflow) -> bool {
    match amount {
        Amount::Count(count) => inflow.grains >= count,
        Amount::Mass(mass) => inflow.mass >= mass,
    }
}
