//! Normals: the normal law of many contacts at once, behind one interface for all laws.
//!
//! A law is called by chunks: the chunk's type is hidden, the loop inside it is not, so that the call costs nothing
//! and the rest of the bed is compiled once for all laws.

use crate::contact::Coverage;
use crate::contact::pair::{Press, Pressed};
use crate::tape::Tape;
use std::any::Any;

/// Relative step back from the present overlap at which the unloading stiffness is read.
pub(in crate::dem) const UNLOADING_PROBE: f64 = 1e-6;

/// A contact to be pressed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Squeeze {
    /// Overlap, m.
    pub overlap: f64,
    /// Radii, m; infinite for a surface.
    pub radii: [f64; 2],
}

/// Histories of a chunk of contacts, with the law they belong to.
pub trait Histories: Send + Sync {
    /// Presses the contacts `at` by `squeezes` into `pressed`.
    fn press(&mut self, at: &[u32], squeezes: &[Squeeze], pressed: &mut [Pressed]);

    /// Forgets a contact that is apart.
    fn forget(&mut self, at: usize);

    /// Takes a contact's history away; it is then as one that is apart.
    fn take(&mut self, at: usize) -> Box<dyn Any>;

    /// Gives a contact the history taken from another; it begins anew where that was between other materials.
    fn put(&mut self, at: usize, history: &dyn Any);

    /// Recoverable energy, J, of the law at full stiffness.
    fn elastic_energy(&self, at: usize, squeeze: Squeeze) -> f64;

    /// Energy (J) plastic flow has dissipated in a contact of `radii` (m), of the law at full stiffness.
    fn dissipated(&self, at: usize, radii: [f64; 2]) -> f64;

    /// Largest stiffness (N/m) the contact can show now, loading or unloading.
    fn stiffest(&self, at: usize, squeeze: Squeeze) -> f64;

    /// Largest overlap (m) so far of a contact of `radii` (m), where the law remembers it.
    fn largest_overlap(&self, at: usize, radii: [f64; 2]) -> Option<f64>;

    /// What of a contact lies within the range of its law.
    fn coverage(&self, at: usize, squeeze: Squeeze) -> Coverage;

    /// Writes the histories on a tape.
    fn save(&self, tape: &mut Tape);

    /// Takes back what [`Histories::save`] wrote of as many contacts; `None` when the tape does not fit.
    fn load(&mut self, tape: &mut Tape) -> Option<()>;

    /// Whether both hold the same histories, bit for bit.
    fn same(&self, other: &dyn Histories) -> bool;

    /// For finding the type again.
    fn any(&self) -> &dyn Any;
}

/// Makes histories of one law.
pub trait NormalModel: Send + Sync {
    /// Chunks of `chunk` contacts; contact `k` continues contact `from[k]` of `old`, or begins, between bodies of
    /// `materials(k)`.
    fn chunks(
        &self,
        old: &[Box<dyn Histories>],
        from: &[Option<usize>],
        chunk: usize,
        materials: &dyn Fn(usize) -> [u8; 2],
    ) -> Vec<Box<dyn Histories>>;
}

/// A [`Press`] as a model.
pub struct Model<P>(pub P);

struct Chunk<P: Press> {
    law: P,
    histories: Vec<P::History>,
}

impl<P: Press> NormalModel for Model<P> {
    fn chunks(
        &self,
        old: &[Box<dyn Histories>],
        from: &[Option<usize>],
        chunk: usize,
        _: &dyn Fn(usize) -> [u8; 2],
    ) -> Vec<Box<dyn Histories>> {
        let old: Vec<&Chunk<P>> = old
            .iter()
            .filter_map(|chunk| chunk.any().downcast_ref())
            .collect();
        let history = |from: &Option<usize>| {
            let kept = from.and_then(|at| old.get(at / chunk)?.histories.get(at % chunk));
            kept.copied().unwrap_or_default()
        };
        from.chunks(chunk)
            .map(|from| {
                let histories = from.iter().map(history).collect();
                Box::new(Chunk {
                    law: self.0.clone(),
                    histories,
                }) as Box<dyn Histories>
            })
            .collect()
    }
}

impl<P: Press> Histories for Chunk<P> {
    fn press(&mut self, at: &[u32], squeezes: &[Squeeze], pressed: &mut [Pressed]) {
        for ((&at, squeeze), pressed) in at.iter().zip(squeezes).zip(pressed) {
            *pressed = self.law.press(
                squeeze.overlap,
                squeeze.radii,
                &mut self.histories[at as usize],
            );
        }
    }

    fn forget(&mut self, at: usize) {
        self.histories[at] = P::History::default();
    }

    fn take(&mut self, at: usize) -> Box<dyn Any> {
        Box::new(std::mem::take(&mut self.histories[at]))
    }

    fn put(&mut self, at: usize, history: &dyn Any) {
        if let Some(history) = history.downcast_ref() {
            self.histories[at] = *history;
        }
    }

    fn elastic_energy(&self, at: usize, squeeze: Squeeze) -> f64 {
        self.law
            .elastic_energy(squeeze.overlap, squeeze.radii, &self.histories[at])
    }

    fn dissipated(&self, at: usize, radii: [f64; 2]) -> f64 {
        self.law.dissipated(radii, &self.histories[at])
    }

    fn stiffest(&self, at: usize, squeeze: Squeeze) -> f64 {
        let mut history = self.histories[at];
        let loading = self.law.press(squeeze.overlap, squeeze.radii, &mut history);
        let back = self.law.press(
            squeeze.overlap * (1.0 - UNLOADING_PROBE),
            squeeze.radii,
            &mut history,
        );
        loading.stiffness.max(back.stiffness)
    }

    fn largest_overlap(&self, at: usize, radii: [f64; 2]) -> Option<f64> {
        self.law.largest_overlap(radii, &self.histories[at])
    }

    fn coverage(&self, at: usize, squeeze: Squeeze) -> Coverage {
        self.law
            .coverage(squeeze.overlap, squeeze.radii, &self.histories[at])
    }

    fn save(&self, tape: &mut Tape) {
        tape.save_few(&self.histories);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        tape.load_few(&mut self.histories)
    }

    fn same(&self, other: &dyn Histories) -> bool {
        other
            .any()
            .downcast_ref::<Self>()
            .is_some_and(|other| self.histories == other.histories)
    }

    fn any(&self) -> &dyn Any {
        self
    }
}
