//! Feed: the grains that are still to come, and when.

use crate::bed::filling::{lattice, random_of, velocity_of};
use crate::bed::scene::region::Region;
use crate::bed::scene::{Amount, Group, Insertion, Scene, Stage};
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
    /// One for each group of the scene.
    pub inflows: Vec<Inflow>,
}
keep_fields!(Feed: inflows);

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
            inflows: (0..scene.groups.len()).map(inflow).collect(),
        }
    }

    /// Groups that stand on their lattices before the first step.
    #[must_use]
    pub fn initial(&self, scene: &Scene) -> Vec<usize> {
        let groups = scene.groups.iter().zip(&self.inflows).enumerate();
        let initial = groups
            .filter(|(_, (group, inflow))| inflow.active && group.insertion == Insertion::Lattice);
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
    pub fn is_complete(&self, scene: &Scene, group: usize) -> bool {
        let inflow = &self.inflows[group];
        match scene.groups[group].amount {
            Amount::Count(count) => inflow.grains >= count,
            Amount::Mass(mass) => inflow.mass >= mass,
        }
    }

    /// Whether no active group has grains to come.
    #[must_use]
    pub fn is_done(&self, scene: &Scene) -> bool {
        (0..self.inflows.len())
            .all(|group| !self.inflows[group].active || self.is_complete(scene, group))
    }

    /// Counts a grain of `group` in; whether the group is then complete.
    pub fn count(&mut self, scene: &Scene, group: usize, grain: Option<&Newcomer>) -> bool {
        if let Some(grain) = grain {
            let inflow = &mut self.inflows[group];
            inflow.grains += 1;
            inflow.mass += grain.mass();
        }
        self.is_complete(scene, group)
    }

    /// Next lattice of a group, counted in.
    pub fn lattice(&mut self, scene: &Scene, group: usize) -> Vec<Newcomer> {
        let mut random = random_of(self.seed, group, self.inflows[group].batches);
        self.inflows[group].batches += 1;
        let all = &scene.groups[group];
        lattice(scene, all, &mut random, |last| {
            self.count(scene, group, last)
        })
    }

    /// Grains that come in at `time` (s), clear of those that are there.
    pub fn due(&mut self, scene: &Scene, grains: &Grains, time: f64) -> Vec<Newcomer> {
        let mut newcomers = Vec::new();
        for (index, group) in scene.groups.iter().enumerate() {
            if !self.inflows[index].active || self.is_complete(scene, index) {
                continue;
            }
            let Some(region) = group.region else {
                newcomers.extend(self.lattice(scene, index));
                continue;
            };
            let mut near = near(&region, grains, &newcomers);
            match group.insertion {
                Insertion::Lattice => newcomers.extend(self.lattice(scene, index)),
                Insertion::Pour if near.is_empty() => newcomers.extend(self.lattice(scene, index)),
                Insertion::Pour => {}
                Insertion::Stream(rate) => {
                    let due = rate * (time - self.inflows[index].began);
                    while self.inflows[index].mass < due && !self.is_complete(scene, index) {
                        let Some(newcomer) = self.one(scene, group, index, &region, &near) else {
                            break;
                        };
                        near.push((newcomer.centre, newcomer.radius));
                        newcomers.push(newcomer);
                    }
                }
            }
        }
        newcomers
    }

    /// One grain of a stream at a random free place, if one is found.
    fn one(
        &mut self,
        scene: &Scene,
        group: &Group,
        index: usize,
        region: &Region,
        near: &[(Vector, f64)],
    ) -> Option<Newcomer> {
        let mut random = random_of(self.seed, index, self.inflows[index].batches);
        let radius = group.sizes.draw(&mut random);
        let velocity = velocity_of(group, &mut random);
        let [low, high] = region.corners();
        for _ in 0..TRIES {
            let mut share = || random.random_range(0.0..=1.0);
            let centre = low + (high - low) * Vector::new(share(), share(), share());
            let free = near
                .iter()
                .all(|(other, size)| (*other - centre).length() > size + radius);
            if free && region.holds(centre, radius) {
                let newcomer = Newcomer {
                    centre,
                    radius,
                    density: scene.materials[group.material].material.density,
                    material: group.material as u8,
                    velocity,
                };
                self.inflows[index].batches += 1;
                self.count(scene, index, Some(&newcomer));
                return Some(newcomer);
            }
        }
        None
    }
}

/// Centres and radii of all grains that reach into a region.
fn near(region: &Region, grains: &Grains, newcomers: &[Newcomer]) -> Vec<(Vector, f64)> {
    let [low, high] = region.corners();
    let here = grains.spheres.iter().map(|s| (s.centre, s.radius));
    let new = newcomers.iter().map(|one| (one.centre, one.radius));
    here.chain(new)
        .filter(|(centre, radius)| {
            let nearest = centre.clamp(low, high);
            (nearest - *centre).length_squared() < radius * radius
        })
        .collect()
}
