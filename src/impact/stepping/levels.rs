//! Local time step: the few cells that would shorten the step for all are stepped on their own.
//!
//! In a body that is flattened, a sheet of some tens of cells along the wall is squeezed so thin that it needs a twentieth of
//! the step that all others could take. Cells are therefore sorted into levels, of which each takes steps half as long as the
//! one before; the forces of a level act on its nodes as one impulse at the beginning of its step: the impulse method of
//! multiple time steps (Grubmuller and others 1991; r-RESPA, Tuckerman, Berne and Martyna 1992), which is symplectic.
//! Displacements follow the shortest steps. The method has resonances where a fast mode is kicked near its half period; with
//! a factor of two from level to level and a row of cells in between they are faint.

use super::erosion::{Erosion, REFRESH};
use super::stability::StabilityLimit;
use crate::impact::kernel::{Part, Points};
use crate::impact::wall::meridian::{Touch, Wall};
use crate::plan::Remedies;
use crate::space::Space;
use crate::tape::{Keep, Tape, keep_fields};
use std::ops::Range;

/// Refreshes after which the stable steps are measured anew; in between they follow the steepness of the cells.
const MOST_AGE: u64 = 3;

/// Steps of a level in one of the first.
fn parts(level: usize) -> f64 {
    (1u64 << level) as f64
}

/// What cells of one level beyond the first need.
#[derive(Debug, Clone)]
pub struct Level<S: Space, W> {
    /// Estimator of their stable step.
    limit: StabilityLimit<S>,
    /// Their contact.
    contact: W,
    /// Their forces.
    force: Vec<S::Vector>,
    /// Velocities before these, as far as they are kept.
    old: Vec<S::Vector>,
    /// Nodes whose velocities before these are kept: all that a contact candidate reaches; every node until that is known.
    kept: Range<usize>,
}

keep_fields!(impl [S: Space, W: Wall<S>] Level<S, W>: limit, contact; rebuilt force, old, kept);

/// Levels of a run.
#[derive(Debug, Clone)]
pub struct LocalStep<S: Space, W> {
    /// Least longest step, as a share of the undeformed body's stable step.
    share: f64,
    /// Largest steepness of the undeformed body's cells.
    first: f64,
    /// Measured stable step of each level with its largest steepness then, and how many refreshes ago.
    steps: Vec<(f64, f64)>,
    age: u64,
    /// Levels beyond the first, as many as could be needed; none: one step for all.
    levels: Vec<Level<S, W>>,
}

impl<S: Space, W: Wall<S>> Keep for LocalStep<S, W> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            first,
            steps,
            age,
            levels,
            share: _,
        } = self;
        first.save(tape);
        steps.save(tape);
        age.save(tape);
        levels.as_slice().save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            first,
            steps,
            age,
            levels,
            share: _,
        } = self;
        first.load(tape)?;
        steps.load(tape)?;
        age.load(tape)?;
        levels.as_mut_slice().load(tape)
    }
}

impl<S: Space, W: Wall<S>> LocalStep<S, W> {
    /// Levels enough to reach the shortest step of `remedies`; `contact` as in the longest step.
    pub fn new(remedies: &Remedies, contact: &W, nodes: usize) -> Self {
        let share = remedies.long_step;
        let count = if share > 0.0 && remedies.least_step > 0.0 {
            (share / remedies.least_step).log2().ceil().max(0.0) as usize
        } else {
            0
        };
        let level = || Level {
            limit: StabilityLimit::new(nodes),
            contact: contact.clone(),
            force: vec![S::Vector::default(); nodes],
            old: vec![S::Vector::default(); nodes],
            kept: 0..nodes,
        };
        LocalStep {
            share,
            first: 0.0,
            steps: Vec::new(),
            age: 0,
            levels: (0..count).map(|_| level()).collect(),
        }
    }

    /// The stable longest step, after cells that would make it too short have gone to deeper levels, and those that would
    /// make the deepest too short have been weakened. `limit` estimates the step of the first level.
    ///
    /// # Errors
    /// Those of [`Erosion::stable_step`].
    pub fn stable_step<const N: usize>(
        &mut self,
        limit: &mut StabilityLimit<S>,
        erosion: &mut Erosion,
        points: &mut Points<S, N>,
        u: &[S::Vector],
        recip_mass: &[S::Vector],
    ) -> Result<f64, String> {
        if self.levels.is_empty() || erosion.first() == 0.0 {
            return erosion.stable_step(limit, points, Part::All, u, recip_mass);
        }
        let steepest = self.sort(points, u, recip_mass);
        self.age += 1;
        let short = self.step(self.levels.len(), &steepest) < erosion.least_step();
        if self.steps.len() != steepest.len() || self.age >= MOST_AGE || short {
            self.measure(limit, erosion, points, &steepest, (u, recip_mass))?;
        }
        let longest = (0..steepest.len()).map(|level| self.step(level, &steepest) * parts(level));
        Ok(longest.fold(f64::INFINITY, f64::min))
    }

    /// Estimate the stable step of every level.
    fn measure<const N: usize>(
        &mut self,
        limit: &mut StabilityLimit<S>,
        erosion: &mut Erosion,
        points: &mut Points<S, N>,
        steepest: &[f64],
        (u, recip_mass): (&[S::Vector], &[S::Vector]),
    ) -> Result<(), String> {
        let last = self.levels.len();
        self.steps.clear();
        self.age = 0;
        for (level, steepness) in steepest.iter().enumerate() {
            let limit = match level {
                0 => &mut *limit,
                _ => &mut self.levels[level - 1].limit,
            };
            let part = Part::Level(level);
            let step = if level < last {
                limit.estimate(points, part, u, recip_mass, REFRESH)
            } else {
                erosion.stable_step(limit, points, part, u, recip_mass)?
            };
            self.steps.push((step, *steepness));
        }
        Ok(())
    }

    /// Stable step of a level as measured, or shorter by what its steepest cell has gained since; infinite where it has no
    /// cells. Longer steps have to be measured: the steepest cell need not be the one that limits them.
    fn step(&self, level: usize, steepest: &[f64]) -> f64 {
        match (self.steps.get(level), steepest.get(level)) {
            (Some((step, then)), Some(now)) if *now > 0.0 => step * (then / now).sqrt().min(1.0),
            _ => f64::INFINITY,
        }
    }

    /// Cells by the step they need: those within the longest step first, then an octave a level. Returns the largest
    /// steepness of each level; forgets the measured steps where a cell changed its level.
    fn sort<const N: usize>(
        &mut self,
        points: &mut Points<S, N>,
        u: &[S::Vector],
        recip_mass: &[S::Vector],
    ) -> Vec<f64> {
        let steepness = points.steepness(u, recip_mass);
        if self.first == 0.0 {
            self.first = steepness.iter().fold(0.0, |a, x| a.max(*x));
        }
        let (first, share, last) = (self.first, self.share, self.levels.len());
        let level = |steepness: &f64| {
            let octaves = ((steepness / first).sqrt() * share).log2().ceil();
            octaves.clamp(0.0, last as f64) as usize
        };
        let levels: Vec<usize> = steepness.iter().map(level).collect();
        if points.deepen(&levels, u.len()) {
            self.steps.clear();
        }
        points.steepest()
    }

    /// Contact candidates of the levels beyond the first, as [`Wall::refresh`].
    pub fn refresh<const N: usize>(
        &mut self,
        u: &[S::Vector],
        speed: f64,
        horizon: f64,
        points: &Points<S, N>,
    ) {
        for (k, level) in self.levels.iter_mut().enumerate().take(points.deepest()) {
            let nodes = points.nodes_of(k + 1);
            // a candidate shares a node with the level: its others are no farther than a cell's first from its last
            let reach = points.offsets()[N - 1];
            if let (Some(first), Some(last)) = (nodes.first(), nodes.last()) {
                level.kept = first.saturating_sub(reach)..(last + reach + 1).min(u.len());
            }
            let among = |node| nodes.binary_search(&node).is_ok();
            level.contact.refresh(u, speed, horizon, &among);
        }
    }

    /// Forces of a level beyond the first, to be written.
    pub fn force(&mut self, level: usize) -> &mut [S::Vector] {
        &mut self.levels[level - 1].force
    }

    /// Velocities after forces and contact of a step of a level beyond the first.
    pub fn kick(
        &mut self,
        level: usize,
        dt: f64,
        nodes: &[usize],
        u: &[S::Vector],
        v: &mut [S::Vector],
        recip_mass: &[S::Vector],
    ) -> Touch {
        let level = &mut self.levels[level - 1];
        level.old[level.kept.clone()].copy_from_slice(&v[level.kept.clone()]);
        for &n in nodes {
            push(&mut v[n], dt, &level.force[n], &recip_mass[n]);
        }
        level.contact.solve(dt, u, &level.old, v, recip_mass)
    }
}

/// Velocity gained by a node in `dt`.
#[inline(always)]
pub fn push<V: AsRef<[f64]> + AsMut<[f64]>>(v: &mut V, dt: f64, force: &V, recip_mass: &V) {
    let (force, recip_mass) = (force.as_ref(), recip_mass.as_ref());
    for (k, v) in v.as_mut().iter_mut().enumerate() {
        *v += dt * force[k] * recip_mass[k];
    }
}
