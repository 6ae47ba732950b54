//! Complementarity: impulses that push, at points whose gap rates do not fall below zero, from a banded coupling.
//!
//! $$ 0 \le \lambda_c \perp b_c + \sum_d W_{cd} \lambda_d \ge 0 $$
//!
//! Solved by an active-set method, warm-started from the last solution, whose linear systems are banded because the points
//! are ordered; block pivoting keeps the sets from cycling, and projected Gauss-Seidel takes over if they do not close in
//! time.

use crate::impact::wall::banded::Banded;
use crate::tape::{Keep, Tape, keep_fields};

/// Active-set iterations before Gauss-Seidel takes over.
const MOST_CHANGES: usize = 200;
/// Iterations without fewer wrong points after which only one of them changes sides.
const PATIENCE: usize = 4;
/// Gauss-Seidel sweeps after which the remaining violation is accepted and reported.
const MOST_SWEEPS: usize = 200;
/// Share added to the diagonal of W: points closer than the splines can tell apart make it nearly singular. Between 1e-7 and
/// 1e-2 it changes F* and delta* in the fifth digit only.
const REGULAR: f64 = 1e-4;

/// What is sought at one point.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unknown {
    /// Gap rate b without impulses.
    pub free: f64,
    /// Impulse.
    pub impulse: f64,
    /// Whether the point is held.
    pub active: bool,
}

keep_fields!(Unknown: impulse, active; rebuilt free);

/// A complementarity problem and its last solution.
#[derive(Debug, Clone)]
pub struct Complementarity {
    /// One a point.
    pub unknowns: Vec<Unknown>,
    coupling: Banded,
    system: Banded,
    right: Vec<f64>,
    /// Impulse tolerance as a speed.
    tolerance: f64,
}

impl Keep for Complementarity {
    fn save(&self, tape: &mut Tape) {
        let Self {
            unknowns,
            coupling: _,
            system: _,
            right: _,
            tolerance: _,
        } = self;
        unknowns.as_slice().save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            unknowns,
            coupling: _,
            system: _,
            right: _,
            tolerance: _,
        } = self;
        unknowns.as_mut_slice().load(tape)
    }
}

impl Complementarity {
    /// No points yet; `tolerance` is the speed below which a violation counts as solved.
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Complementarity {
            unknowns: Vec::new(),
            coupling: Banded::default(),
            system: Banded::default(),
            right: Vec::new(),
            tolerance,
        }
    }

    /// Couple the points by `entry`, which is zero between points more than `band` apart in their order.
    pub fn couple(&mut self, band: usize, entry: impl Fn(usize, usize) -> f64) {
        let count = self.unknowns.len();
        let mut coupling = Banded::new(count, band);
        for c in 0..count {
            for d in c.saturating_sub(band)..=c {
                *coupling.at_mut(c, d) = entry(c, d);
            }
            *coupling.at_mut(c, c) *= 1.0 + REGULAR;
        }
        self.coupling = coupling;
    }

    /// Let a point go.
    #[inline(always)]
    pub fn release(&mut self, c: usize) {
        self.unknowns[c].impulse = 0.0;
        self.unknowns[c].active = false;
    }

    /// Impulses of the `candidates`; the others have none. Returns the largest violation left, 0 where the set closed.
    pub fn solve(&mut self, candidates: &[usize]) -> f64 {
        if self.close_active_set(candidates) {
            0.0
        } else {
            self.relax(candidates)
        }
    }

    /// Speed of point `c` after the present impulses, as a gap rate.
    #[inline(always)]
    fn speed_after(&self, c: usize) -> f64 {
        let band = self.coupling.band();
        let mut speed = self.unknowns[c].free;
        for d in c.saturating_sub(band)..(c + band + 1).min(self.unknowns.len()) {
            let impulse = self.unknowns[d].impulse;
            if impulse != 0.0 {
                speed += self.coupling.at(c, d) * impulse;
            }
        }
        speed
    }

    /// Solve on the active points, drop those that pull, add those that penetrate, until nothing changes.
    ///
    /// Block principal pivoting (Judice and Pires 1994): all that are wrong change sides at once as long as their number
    /// falls now and then, else only the last of them, which ends for any positive definite W (Murty 1974).
    fn close_active_set(&mut self, candidates: &[usize]) -> bool {
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        for _ in 0..MOST_CHANGES {
            self.solve_active(candidates);
            let wrong = |c: &usize| {
                let p = &self.unknowns[*c];
                (p.active && p.impulse <= 0.0)
                    || (!p.active && self.speed_after(*c) < -self.tolerance)
            };
            let all: Vec<usize> = candidates.iter().copied().filter(wrong).collect();
            let Some(last) = all.last() else {
                return true;
            };
            if all.len() < fewest {
                (fewest, patience) = (all.len(), PATIENCE);
            } else {
                patience = patience.saturating_sub(1);
            }
            let changed = if patience > 0 {
                &all
            } else {
                std::slice::from_ref(last)
            };
            for &c in changed {
                self.unknowns[c].active = !self.unknowns[c].active;
            }
        }
        false
    }

    /// Impulses that bring the active points exactly onto the wall; the others carry none.
    fn solve_active(&mut self, candidates: &[usize]) {
        let active: Vec<usize> = candidates
            .iter()
            .copied()
            .filter(|c| self.unknowns[*c].active)
            .collect();
        let band = self.coupling.band();
        self.system.reset(active.len(), band);
        self.right.clear();
        for (row, &c) in active.iter().enumerate() {
            self.right.push(-self.unknowns[c].free);
            for (column, &d) in active[..=row].iter().enumerate().rev().take(band + 1) {
                if c - d > band {
                    break;
                }
                *self.system.at_mut(row, column) = self.coupling.at(c, d);
            }
        }
        self.system.solve(&mut self.right);
        for &c in candidates {
            self.unknowns[c].impulse = 0.0;
        }
        for (&c, impulse) in active.iter().zip(&self.right) {
            self.unknowns[c].impulse = *impulse;
        }
    }

    /// Symmetric projected Gauss-Seidel sweeps until the largest correction is below the tolerance; returns it.
    #[cold]
    fn relax(&mut self, candidates: &[usize]) -> f64 {
        let mut worst = 0.0f64;
        for &c in candidates {
            self.unknowns[c].impulse = self.unknowns[c].impulse.max(0.0);
        }
        for sweep in 0..MOST_SWEEPS {
            worst = 0.0;
            for k in 0..candidates.len() {
                let c = if sweep % 2 == 0 {
                    candidates[k]
                } else {
                    candidates[candidates.len() - 1 - k]
                };
                let stiff = self.coupling.at(c, c);
                let old = self.unknowns[c].impulse;
                let new = (old - self.speed_after(c) / stiff).max(0.0);
                worst = worst.max(((new - old) * stiff).abs());
                self.unknowns[c].impulse = new;
            }
            if worst < self.tolerance {
                break;
            }
        }
        for &c in candidates {
            self.unknowns[c].active = self.unknowns[c].impulse > 0.0;
        }
        worst
    }

    /// Whether every impulse pushes and no gap rate falls below `-tolerance`, the held ones being zero within it.
    #[cfg(test)]
    pub fn holds(&self) -> bool {
        (0..self.unknowns.len()).all(|c| {
            let p = &self.unknowns[c];
            let rate = self.speed_after(c);
            let met = if p.active {
                rate.abs() < 1e-9
            } else {
                rate > -1e-9
            };
            p.impulse >= 0.0 && (p.impulse > 0.0) == p.active && met
        })
    }
}
