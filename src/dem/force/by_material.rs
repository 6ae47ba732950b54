//! Effects by material: one damping, friction or rolling resistance for each pair of materials.

use super::damping::{Damping, Viscous};
use super::effects::Law;
use super::friction::{Mindlin, Pull, Tangential};
use super::meeting::Meeting;
use super::named::Effects;
use super::rolling::{Rolling, RollingSpring};
use crate::contact::pair::Pressed;
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

    #[inline(always)]
    fn of(&self, meeting: &Meeting) -> &T {
        let [a, b] = meeting.materials.map(|material| material as usize);
        &self.rows[a * (self.materials + 1) + b.min(self.materials)]
    }
}

impl<D: Damping> Damping for Table<Option<D>> {
    type Memory = D::Memory;
    const ACTIVE: bool = true;
    const BY_MATERIAL: bool = true;

    #[inline(always)]
    fn add_to(&self, force: &mut f64, approach: f64, pressed: &Pressed, meeting: &Meeting) {
        if let Some(damping) = self.of(meeting) {
            damping.add_to(force, approach, pressed, meeting);
        }
    }

    #[inline(always)]
    fn add_slip_to(
        &self,
        force: &mut Vector,
        slip: Vector,
        stiffness: f64,
        meeting: &Meeting,
        limit: f64,
    ) {
        if let Some(damping) = self.of(meeting) {
            damping.add_slip_to(force, slip, stiffness, meeting, limit);
        }
    }

    #[inline(always)]
    fn law_force(memory: &D::Memory, total: f64) -> f64 {
        D::law_force(memory, total)
    }

    #[inline(always)]
    fn remember(memory: &mut D::Memory, force: f64) {
        D::remember(memory, force);
    }
}

impl<T: Tangential> Tangential for Table<Option<T>> {
    type Memory = T::Memory;
    const ACTIVE: bool = true;
    const BY_MATERIAL: bool = true;

    #[inline(always)]
    fn pull(
        &self,
        slip: Vector,
        force: f64,
        pressed: &Pressed,
        meeting: &Meeting,
        memory: &mut T::Memory,
    ) -> Pull {
        match self.of(meeting) {
            Some(friction) => friction.pull(slip, force, pressed, meeting, memory),
            None => Pull::default(),
        }
    }

    #[inline(always)]
    fn limit(&self, force: f64, meeting: &Meeting) -> f64 {
        match self.of(meeting) {
            Some(friction) => friction.limit(force, meeting),
            None => 0.0,
        }
    }

    fn soften(&mut self, factor: f64) {
        let all = self.rows.iter_mut().flatten();
        all.for_each(|friction| friction.soften(factor));
    }

    #[inline(always)]
    fn energy(memory: &T::Memory) -> f64 {
        T::energy(memory)
    }
}

impl<R: Rolling> Rolling for Table<Option<R>> {
    type Memory = R::Memory;
    const ACTIVE: bool = true;
    const BY_MATERIAL: bool = true;

    #[inline(always)]
    fn resist(
        &self,
        force: f64,
        pressed: &Pressed,
        meeting: &Meeting,
        memory: &mut R::Memory,
    ) -> f64 {
        match self.of(meeting) {
            Some(rolling) => rolling.resist(force, pressed, meeting, memory),
            None => 0.0,
        }
    }

    #[inline(always)]
    fn moment(memory: &R::Memory) -> Vector {
        R::moment(memory)
    }

    #[inline(always)]
    fn energy(memory: &R::Memory) -> f64 {
        R::energy(memory)
    }

    fn soften(&mut self, factor: f64) {
        let all = self.rows.iter_mut().flatten();
        all.for_each(|rolling| rolling.soften(factor));
    }
}

/// Effects of a mixture as one law.
pub type Mixed = Law<Table<Option<Viscous>>, Table<Option<Mindlin>>, Table<Option<RollingSpring>>>;

/// Law of the effects of each pair of materials.
#[must_use]
pub fn mixed(effects: &Table<Effects>) -> Mixed {
    let count = effects.materials;
    let at = |a: usize, b: Option<usize>| &effects.rows[a * (count + 1) + b.unwrap_or(count)];
    Law::new(
        Table::new(count, |a, b| at(a, b).damping),
        Table::new(count, |a, b| at(a, b).friction),
        Table::new(count, |a, b| at(a, b).rolling),
    )
}
