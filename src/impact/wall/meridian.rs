//! Contact of the surface points with a rigid frictionless plane: implicit, by Signorini's complementarity.
//!
//! At each surface point c the gap at the end of the step, $g_c + \Delta t\ v_c$, and the impulse $\lambda_c$ satisfy
//!
//! $$ 0 \le \lambda_c \perp b_c + \sum_d W_{cd} \lambda_d \ge 0, \qquad
//!    b_c = g_c / \Delta t + \sum_i N_{ci} v_i, \qquad W_{cd} = \sum_i N_{ci} N_{di} / m_i $$
//!
//! with the free nodal velocities $v_i$. There is no penalty, so no stiffness to choose, and the force does not depend on
//! the time step. The problem is solved by an active-set method, warm-started from the last step, whose linear systems
//! are banded because the points are ordered along the meridian; block pivoting keeps the sets from cycling, and projected
//! Gauss-Seidel takes over if they do not close in time.

use super::banded::Banded;
pub use crate::impact::wall::{Touch, Wall};
use crate::space::Space;
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

/// Surface points and their impulses.
#[derive(Debug, Clone)]
pub struct Contact<S: Space, const N: usize> {
    points: Vec<ContactPoint<N>>,
    offsets: [usize; N],
    coupling: Banded,
    candidates: Vec<usize>,
    system: Banded,
    right: Vec<f64>,
    time: f64,
    /// Impulse tolerance as a speed.
    tolerance: f64,
    space: std::marker::PhantomData<S>,
}

/// One surface point.
#[derive(Debug, Clone, Copy)]
struct ContactPoint<const N: usize> {
    node: usize,
    values: [f64; N],
    height: f64,
    radius: f64,
    /// Right-hand side b of the present step.
    free: f64,
    impulse: f64,
    active: bool,
}

keep_fields!(impl [const N: usize] ContactPoint<N>: impulse, active; rebuilt node, values, height, radius, free);

impl<S: Space, const N: usize> Keep for Contact<S, N> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            points,
            candidates,
            time,
            offsets: _,
            coupling: _,
            system: _,
            right: _,
            tolerance: _,
            space: _,
        } = self;
        points.as_slice().save(tape);
        candidates.save(tape);
        time.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            points,
            candidates,
            time,
            offsets: _,
            coupling: _,
            system: _,
            right: _,
            tolerance: _,
            space: _,
        } = self;
        points.as_mut_slice().load(tape)?;
        candidates.load(tape)?;
        time.load(tape)
    }
}

impl<S: Space, const N: usize> Wall<S> for Contact<S, N> {
    fn refresh(
        &mut self,
        u: &[S::Vector],
        speed: f64,
        horizon: f64,
        among: &dyn Fn(usize) -> bool,
    ) {
        self.candidates.clear();
        for c in 0..self.points.len() {
            let gap = self.points[c].height + self.at(c, u, S::NORMAL);
            let near = gap < speed * horizon || self.points[c].active;
            let node = self.points[c].node;
            if near && self.offsets.iter().any(|offset| among(node + offset)) {
                self.candidates.push(c);
            } else {
                self.points[c].impulse = 0.0;
                self.points[c].active = false;
            }
        }
    }

    fn solve(
        &mut self,
        dt: f64,
        u: &[S::Vector],
        old: &[S::Vector],
        v: &mut [S::Vector],
        recip_mass: &[S::Vector],
    ) -> Touch {
        let ratio = if self.time > 0.0 { dt / self.time } else { 1.0 };
        self.time = dt;
        let candidates = std::mem::take(&mut self.candidates);
        let mut any = false;
        for &c in &candidates {
            let gap = self.points[c].height + self.at(c, u, S::NORMAL);
            let free = gap / dt + self.at(c, v, S::NORMAL);
            let p = &mut self.points[c];
            p.free = free;
            p.impulse *= ratio;
            any |= free < 0.0;
            p.active |= free < 0.0 && p.impulse == 0.0;
        }
        let mut touch = Touch::default();
        if any {
            if !self.close_active_set(&candidates) {
                touch.residual = self.relax(&candidates);
            }
            self.apply(&candidates, u, old, v, recip_mass, &mut touch);
        } else {
            for &c in &candidates {
                self.points[c].impulse = 0.0;
                self.points[c].active = false;
            }
        }
        self.candidates = candidates;
        touch
    }

    fn outline(&self, u: &[S::Vector]) -> Vec<(f64, f64)> {
        let place = |(c, p): (usize, &ContactPoint<N>)| {
            let (across, up) = (self.at(c, u, 0), self.at(c, u, S::NORMAL));
            (p.radius + across, p.height + up)
        };
        self.points.iter().enumerate().map(place).collect()
    }
}

impl<S: Space, const N: usize> Contact<S, N> {
    /// No points yet; `tolerance` is the speed below which a violation counts as solved.
    #[must_use]
    pub fn new(offsets: [usize; N], tolerance: f64) -> Self {
        Contact {
            points: Vec::new(),
            offsets,
            coupling: Banded::default(),
            candidates: Vec::new(),
            system: Banded::default(),
            right: Vec::new(),
            time: 0.0,
            tolerance,
            space: std::marker::PhantomData,
        }
    }

    /// Add a surface point (in order along the surface): first node, basis values, height above the wall and distance
    /// from the axis.
    pub fn push(&mut self, node: usize, values: [f64; N], height: f64, radius: f64) {
        self.points.push(ContactPoint {
            node,
            values,
            height,
            radius,
            free: height,
            impulse: 0.0,
            active: false,
        });
    }

    /// Surface points.
    #[must_use]
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Compute the coupling W from the nodes' reciprocal masses; call once all points are there.
    pub fn couple(&mut self, recip_mass: &[S::Vector]) {
        let entry = |c: usize, d: usize| {
            let (p, q) = (&self.points[c], &self.points[d]);
            let mut sum = 0.0;
            for a in 0..N {
                let n = p.node + self.offsets[a];
                for b in 0..N {
                    if q.node + self.offsets[b] == n {
                        sum += p.values[a] * q.values[b] * recip_mass[n].as_ref()[S::NORMAL];
                    }
                }
            }
            sum
        };
        let count = self.points.len();
        let reaches = |c: usize, band: usize| c + band < count && entry(c, c + band) > 0.0;
        let mut band = 0;
        while (0..count).any(|c| reaches(c, band + 1)) {
            band += 1;
        }
        let mut coupling = Banded::new(count, band);
        for c in 0..count {
            for d in c.saturating_sub(band)..=c {
                *coupling.at_mut(c, d) = entry(c, d);
            }
            *coupling.at_mut(c, c) *= 1.0 + REGULAR;
        }
        self.coupling = coupling;
    }

    /// Interpolate component `axis` of a nodal field at point `c`.
    #[inline(always)]
    fn at(&self, c: usize, field: &[S::Vector], axis: usize) -> f64 {
        let p = &self.points[c];
        let mut sum = 0.0;
        for a in 0..N {
            sum += p.values[a] * field[p.node + self.offsets[a]].as_ref()[axis];
        }
        sum
    }

    /// Speed of point `c` after the present impulses, as a gap rate.
    #[inline(always)]
    fn speed_after(&self, c: usize) -> f64 {
        let band = self.coupling.band();
        let mut speed = self.points[c].free;
        for d in c.saturating_sub(band)..(c + band + 1).min(self.points.len()) {
            let impulse = self.points[d].impulse;
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
                let p = &self.points[*c];
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
                self.points[c].active = !self.points[c].active;
            }
        }
        false
    }

    /// Impulses that bring the active points exactly onto the wall; the others carry none.
    fn solve_active(&mut self, candidates: &[usize]) {
        let active: Vec<usize> = candidates
            .iter()
            .copied()
            .filter(|c| self.points[*c].active)
            .collect();
        let band = self.coupling.band();
        self.system.reset(active.len(), band);
        self.right.clear();
        for (row, &c) in active.iter().enumerate() {
            self.right.push(-self.points[c].free);
            for (column, &d) in active[..=row].iter().enumerate().rev().take(band + 1) {
                if c - d > band {
                    break;
                }
                *self.system.at_mut(row, column) = self.coupling.at(c, d);
            }
        }
        self.system.solve(&mut self.right);
        for &c in candidates {
            self.points[c].impulse = 0.0;
        }
        for (&c, impulse) in active.iter().zip(&self.right) {
            self.points[c].impulse = *impulse;
        }
    }

    /// Symmetric projected Gauss-Seidel sweeps until the largest correction is below the tolerance; returns it.
    #[cold]
    fn relax(&mut self, candidates: &[usize]) -> f64 {
        let mut worst = 0.0f64;
        for &c in candidates {
            self.points[c].impulse = self.points[c].impulse.max(0.0);
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
                let old = self.points[c].impulse;
                let new = (old - self.speed_after(c) / stiff).max(0.0);
                worst = worst.max(((new - old) * stiff).abs());
                self.points[c].impulse = new;
            }
            if worst < self.tolerance {
                break;
            }
        }
        for &c in candidates {
            self.points[c].active = self.points[c].impulse > 0.0;
        }
        worst
    }

    /// Give the impulses to the nodes; sum impulse, work and extent of the step.
    fn apply(
        &self,
        candidates: &[usize],
        u: &[S::Vector],
        old: &[S::Vector],
        v: &mut [S::Vector],
        recip_mass: &[S::Vector],
        touch: &mut Touch,
    ) {
        for &c in candidates {
            let p = &self.points[c];
            if p.impulse > 0.0 {
                for a in 0..N {
                    let n = p.node + self.offsets[a];
                    v[n].as_mut()[S::NORMAL] +=
                        p.values[a] * p.impulse * recip_mass[n].as_ref()[S::NORMAL];
                }
                touch.impulse += p.impulse;
                touch.radius = touch.radius.max(p.radius + self.at(c, u, 0));
            }
        }
        for &c in candidates {
            let impulse = self.points[c].impulse;
            if impulse > 0.0 {
                let speeds = self.at(c, old, S::NORMAL) + self.at(c, v, S::NORMAL);
                touch.work += 0.5 * impulse * speeds;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impulses_and_gap_rates_are_complementary_for_any_approach() {
        let values = |s: f64| [0.5 * (1.0 - s).powi(2), 0.5 + s - s * s, 0.5 * s * s];
        let mut contact = Contact::<crate::space::Axisymmetric, 3>::new([0, 1, 2], 1e-9);
        for x in (0..56).map(|c| 0.5 * f64::from(c)) {
            contact.push(x as usize, values(x.fract()), 0.0, x);
        }
        let recip_mass: Vec<[f64; 2]> = (0..30).map(|n| [1.0, 1.0 + f64::from(n % 4)]).collect();
        contact.couple(&recip_mass);
        contact.candidates = (0..56).collect();
        for seed in 0..40 {
            let speed = |n: i32| (f64::from(n * n) * 1.7 + 0.31 * f64::from(seed)).sin() - 0.2;
            let still = [[0.0; 2]; 30];
            let mut v: Vec<[f64; 2]> = (0..30).map(|n| [0.0, speed(n)]).collect();
            let touch = contact.solve(1.0, &still, &still, &mut v, &recip_mass);
            assert_eq!(touch.residual, 0.0, "the active set closed");
            for (c, p) in contact.points.iter().enumerate() {
                assert!(p.impulse >= 0.0 && (p.impulse > 0.0) == p.active);
                let rate = contact.speed_after(c);
                assert!(
                    if p.active {
                        rate.abs() < 1e-9
                    } else {
                        rate > -1e-9
                    },
                    "{rate}"
                );
            }
        }
    }
}
