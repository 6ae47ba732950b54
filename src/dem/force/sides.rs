//! Type-erased contact sides of one law.

use crate::contact::pair::Side;
use crate::contact::{Coverage, LawVisitor, NormalLaw};
use crate::tape::{Keep, Tape};
use std::any::Any;

/// Sides of contacts that are all of one law.
pub(in crate::dem) trait Flattened: Send + Sync {
    /// No sides, under the same law.
    fn empty(&self) -> Box<dyn Flattened>;
    /// Adds a side, which continues side `old.1` of `old.0` or begins; returns its index.
    fn add(&mut self, old: Option<(&dyn Flattened, usize)>) -> usize;
    /// State of a side at `flattening` of a sphere of `radius` (m), without remembering it.
    fn trial(&self, side: usize, flattening: f64, radius: f64) -> Side;
    /// As [`Flattened::trial`], remembered; returns contact radius and depth (m).
    fn remember(&mut self, side: usize, flattening: f64, radius: f64) -> [f64; 2];
    /// Begins a side anew.
    fn forget(&mut self, side: usize);
    /// Takes a side's history away, as if to forget it.
    fn take(&mut self, side: usize) -> Box<dyn Any>;
    /// Gives a side the history taken from another of the same law.
    fn put(&mut self, side: usize, history: &dyn Any);
    /// Recoverable energy, J.
    fn elastic_energy(&self, side: usize, flattening: f64, radius: f64) -> f64;
    /// Energy plastic flow has dissipated, J.
    fn dissipated(&self, side: usize, radius: f64) -> f64;
    /// Largest flattening (m) so far, where the law remembers it.
    fn largest(&self, side: usize, radius: f64) -> Option<f64>;
    /// What of a side lies within the range of its law.
    fn coverage(&self, side: usize, flattening: f64, radius: f64) -> Coverage;
    fn save(&self, tape: &mut Tape);
    fn load(&mut self, tape: &mut Tape) -> Option<()>;
    fn same(&self, other: &dyn Flattened) -> bool;
    fn any(&self) -> &dyn Any;
}

struct Sides<L: NormalLaw> {
    law: L,
    histories: Vec<L::History>,
}

/// Visits a law to begin its sides.
pub(in crate::dem) struct Empty;

impl LawVisitor for Empty {
    type Output = Box<dyn Flattened>;

    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
        Box::new(Sides {
            law: law.clone(),
            histories: Vec::new(),
        })
    }
}

impl<L: NormalLaw> Flattened for Sides<L> {
    fn empty(&self) -> Box<dyn Flattened> {
        Empty.visit(&self.law)
    }

    fn add(&mut self, old: Option<(&dyn Flattened, usize)>) -> usize {
        let kept = old.and_then(|(old, side)| {
            let old: &Self = old.any().downcast_ref()?;
            old.histories.get(side).copied()
        });
        self.histories.push(kept.unwrap_or_default());
        self.histories.len() - 1
    }

    fn trial(&self, side: usize, flattening: f64, radius: f64) -> Side {
        let mut history = self.histories[side];
        let x = flattening / radius;
        Side {
            force: radius * radius * self.law.force(x, &mut history),
            stiffness: radius * self.law.stiffness(x, &history),
        }
    }

    fn remember(&mut self, side: usize, flattening: f64, radius: f64) -> [f64; 2] {
        let state = self
            .law
            .state(flattening / radius, &mut self.histories[side]);
        [radius * state.contact_radius, radius * state.depth]
    }

    fn forget(&mut self, side: usize) {
        self.histories[side] = L::History::default();
    }

    fn take(&mut self, side: usize) -> Box<dyn Any> {
        Box::new(std::mem::take(&mut self.histories[side]))
    }

    fn put(&mut self, side: usize, history: &dyn Any) {
        if let Some(history) = history.downcast_ref() {
            self.histories[side] = *history;
        }
    }

    fn elastic_energy(&self, side: usize, flattening: f64, radius: f64) -> f64 {
        radius.powi(3)
            * self
                .law
                .elastic_energy(flattening / radius, &self.histories[side])
    }

    fn dissipated(&self, side: usize, radius: f64) -> f64 {
        radius.powi(3) * self.law.dissipated(&self.histories[side])
    }

    fn largest(&self, side: usize, radius: f64) -> Option<f64> {
        self.law.largest(&self.histories[side]).map(|x| x * radius)
    }

    fn coverage(&self, side: usize, flattening: f64, radius: f64) -> Coverage {
        Coverage::of(&self.law, flattening / radius, &self.histories[side])
            .times(1.0, radius.powi(3))
    }

    fn save(&self, tape: &mut Tape) {
        self.histories.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.histories.load(tape)
    }

    fn same(&self, other: &dyn Flattened) -> bool {
        other
            .any()
            .downcast_ref::<Self>()
            .is_some_and(|other| self.histories == other.histories)
    }

    fn any(&self) -> &dyn Any {
        self
    }
}
