//! Effects by material: one of each kind for each pair of materials.

use super::effects::{Contact, Effect};
use super::losses::Losses;
use super::meeting::Meeting;
use parry3d::math::Vector;

/// An effect for each pair of materials, the second of which may be [`super::mixture::RIGID`].
#[derive(Debug, Clone, PartialEq)]
pub struct Table<T> {
    /// Rows by the first material, with the rigid one last.
    rows: Vec<T>,
    materials: usize,
}

impl<T> Table<T> {
    /// Table of `of(a, b)` for materials `a` and `b`, or rigid bodies if `None`.
    pub fn new(materials: usize, mut of: impl FnMut(usize, Option<usize>) -> T) -> Self {
        let mut rows = Vec::with_capacity(materials * (materials + 1));
        for a in 0..materials {
            for b in 0..=materials {
                rows.push(of(a, (b < materials).then_some(b)));
            }
        }
        Self { rows, materials }
    }

    /// What `of` makes of each entry.
    pub(super) fn map<U>(&self, of: impl Fn(&T) -> U) -> Table<U> {
        Table {
            rows: self.rows.iter().map(of).collect(),
            materials: self.materials,
        }
    }

    #[inline(always)]
    fn of(&self, meeting: &Meeting) -> &T {
        let [a, b] = meeting.materials.map(|material| material as usize);
        &self.rows[a * (self.materials + 1) + b.min(self.materials)]
    }
}

impl<E: Effect> Effect for Table<Option<E>> {
    type Memory = E::Memory;
    const ACROSS: bool = E::ACROSS;
    const MOMENT: bool = E::MOMENT;
    const BY_MATERIAL: bool = true;

    #[inline(always)]
    fn act(&self, contact: &mut Contact, memory: &mut E::Memory, losses: &mut Losses) {
        if let Some(effect) = self.of(contact.meeting) {
            effect.act(contact, memory, losses);
        }
    }

    #[inline(always)]
    fn moment(memory: &E::Memory) -> Vector {
        E::moment(memory)
    }

    #[inline(always)]
    fn stored(memory: &E::Memory) -> f64 {
        E::stored(memory)
    }

    fn soften(&mut self, factor: f64) {
        let all = self.rows.iter_mut().flatten();
        all.for_each(|effect| effect.soften(factor));
    }
}
