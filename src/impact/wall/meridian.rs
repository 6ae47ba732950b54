//! Contact of an axisymmetric body with a rigid frictionless plane: implicit, by Signorini's complementarity.
//!
//! At each surface point c the gap at the end of the step, $g_c + \Delta t\ v_c$, and the impulse $\lambda_c$ satisfy
//!
//! $$ 0 \le \lambda_c \perp b_c + \sum_d W_{cd} \lambda_d \ge 0, \qquad
//!    b_c = g_c / \Delta t + \sum_i N_{ci} v_i, \qquad W_{cd} = \sum_i N_{ci} N_{di} / m_i $$
//!
//! with the free nodal velocities $v_i$. There is no penalty, so no stiffness to choose, and the force does not depend on
//! the time step. Points are ordered along the meridian, so W is banded.
//!
//! Where the surface folds over, or its cells are crushed, it does not keep apart from the wall what lies behind it. In
//! bodies that are flattened the material points are therefore held too (`interior`): as long as none of them is
//! about to pass the wall, nothing but a look at those near it is done.

use crate::impact::wall::attraction::{Attraction, Pull};
use crate::impact::wall::complementarity::{Complementarity, Unknown};
use crate::impact::wall::contact_point::ContactPoint;
use crate::impact::wall::interior::Interior;
pub use crate::impact::wall::{Touch, Wall};
use crate::space::Space;
use crate::tape::keep_fields;

/// Surface points, material points near the wall, and their impulses.
#[derive(Debug, Clone)]
pub struct Contact<S: Space, const N: usize, A: Attraction = ()> {
    points: Vec<ContactPoint<N>>,
    offsets: [usize; N],
    surface: Complementarity,
    candidates: Vec<usize>,
    interior: Interior<N>,
    time: f64,
    attraction: A,
    /// Forces of attraction on the surface points within its reach.
    pulls: A::Forces,
    space: std::marker::PhantomData<S>,
}

keep_fields!(impl [S: Space, const N: usize, A: Attraction] Contact<S, N, A>: surface, candidates, interior, time;
    rebuilt points, offsets, attraction, pulls, space);

/// Speeds of surfaces that snap together, at most, over that of a wave with the traction of attraction.
const SNAPPING: f64 = 2.0;

impl<S: Space, const N: usize, A: Attraction> Wall<S> for Contact<S, N, A> {
    fn refresh(
        &mut self,
        u: &[S::Vector],
        speed: f64,
        horizon: f64,
        among: &dyn Fn(usize) -> bool,
    ) {
        self.candidates.clear();
        for c in 0..self.points.len() {
            let p = &self.points[c];
            let gap = p.height + p.at(&self.offsets, u, S::NORMAL);
            let near =
                gap < speed * horizon + self.attraction.range() || self.surface.unknowns[c].active;
            if near && self.offsets.iter().any(|offset| among(p.node + offset)) {
                self.candidates.push(c);
            } else {
                self.surface.release(c);
            }
        }
        let field = (u, S::NORMAL);
        (self.interior).refresh(&self.offsets, field, (speed, horizon), among);
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
            let p = &self.points[c];
            let gap = p.height + p.at(&self.offsets, u, S::NORMAL);
            let free = gap / dt + p.at(&self.offsets, v, S::NORMAL);
            let p = &mut self.surface.unknowns[c];
            p.free = free;
            p.impulse *= ratio;
            any |= free < 0.0;
            p.active |= free < 0.0 && p.impulse == 0.0;
        }
        let (offsets, axis) = (self.offsets, S::NORMAL);
        self.interior.prepare(&offsets, dt, (u, v, axis), ratio);
        let mut touch = Touch::default();
        let mut passes = self.interior.is_held();
        if !passes {
            if any {
                touch.residual = self.surface.solve(&candidates);
                self.press(&candidates, v, recip_mass, 1.0);
            } else {
                for &c in &candidates {
                    self.surface.release(c);
                }
            }
            passes = self.interior.passes(&offsets, (v, axis));
            if passes && any {
                self.press(&candidates, v, recip_mass, -1.0);
            }
        }
        if passes {
            let surface = (&mut self.surface, &self.points[..], &candidates[..]);
            touch.residual = self.interior.solve(&offsets, surface);
            self.press(&candidates, v, recip_mass, 1.0);
            for (p, impulse) in self.interior.pushing() {
                p.press(&offsets, impulse, v, recip_mass, axis);
            }
        }
        self.sum(&candidates, u, old, v, &mut touch);
        self.candidates = candidates;
        touch
    }

    fn pull(&mut self, u: &[S::Vector], force: &mut [S::Vector]) -> Pull {
        if !A::ON {
            return Pull::default();
        }
        // what lies beyond the outermost candidate and its neighbour is out of range
        let count = self.candidates.last().map_or(0, |last| last + 2);
        let points = &self.points[..count.min(self.points.len())];
        let offsets = &self.offsets;
        let places = points.iter().map(|p| {
            let [across, up] = [0, S::NORMAL].map(|axis| p.at(offsets, u, axis));
            [p.radius + across, p.height + up]
        });
        let pull = self.attraction.pull(places, &mut self.pulls);
        for (p, pulled) in points.iter().zip(self.pulls.as_ref()) {
            for (value, offset) in p.values.iter().zip(offsets) {
                let force = force[p.node + offset].as_mut();
                force[0] += value * pulled[0];
                force[S::NORMAL] += value * pulled[1];
            }
        }
        pull
    }

    fn range(&self) -> f64 {
        self.attraction.range()
    }

    fn snapping(&self) -> f64 {
        SNAPPING * self.attraction.strength()
    }

    fn outline(&self, u: &[S::Vector]) -> Vec<(f64, f64)> {
        let place = |p: &ContactPoint<N>| {
            let [across, up] = [0, S::NORMAL].map(|axis| p.at(&self.offsets, u, axis));
            (p.radius + across, p.height + up)
        };
        self.points.iter().map(place).collect()
    }
}

impl<S: Space, const N: usize> Contact<S, N> {
    /// No points yet, and a wall that does not attract them; `tolerance` is the speed below which a violation counts as solved.
    #[must_use]
    pub fn new(offsets: [usize; N], tolerance: f64) -> Self {
        Self::attracted(offsets, tolerance, ())
    }
}

impl<S: Space, const N: usize, A: Attraction> Contact<S, N, A> {
    /// The same with a wall that attracts.
    #[must_use]
    pub fn attracted(offsets: [usize; N], tolerance: f64, attraction: A) -> Self {
        Contact {
            points: Vec::new(),
            offsets,
            surface: Complementarity::new(tolerance),
            candidates: Vec::new(),
            interior: Interior::new(tolerance),
            time: 0.0,
            attraction,
            pulls: A::Forces::default(),
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
        });
        self.surface.unknowns.push(Unknown {
            free: height,
            ..Unknown::default()
        });
    }

    /// Surface points.
    #[must_use]
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Compute the coupling W from the nodes' reciprocal masses; call once all points are there.
    pub fn couple(&mut self, recip_mass: &[S::Vector]) {
        let points = &self.points;
        let along = |n: usize| recip_mass[n].as_ref()[S::NORMAL];
        let entry = |c: usize, d: usize| points[c].coupling(&points[d], &self.offsets, along);
        let count = points.len();
        let reaches = |c: usize, band: usize| c + band < count && entry(c, c + band) > 0.0;
        let mut band = 0;
        while (0..count).any(|c| reaches(c, band + 1)) {
            band += 1;
        }
        self.surface.couple(band, entry);
    }

    /// Hold the material points too (cell by cell), on nodes at these `places` with these reciprocal masses, `columns` a row;
    /// the smallest cells have the size `cell`.
    pub fn hold_interior(
        &mut self,
        points: Vec<ContactPoint<N>>,
        places: &[S::Vector],
        recip_mass: &[S::Vector],
        columns: usize,
        cell: f64,
    ) {
        let along = |field: &[S::Vector]| field.iter().map(|x| x.as_ref()[S::NORMAL]).collect();
        let (heights, recip_mass) = (along(places), along(recip_mass));
        (self.interior).watch(points, heights, recip_mass, columns, cell);
    }

    /// Give `share` of the surface's impulses to the nodes.
    fn press(
        &self,
        candidates: &[usize],
        v: &mut [S::Vector],
        recip_mass: &[S::Vector],
        share: f64,
    ) {
        for &c in candidates {
            let impulse = self.surface.unknowns[c].impulse;
            if impulse > 0.0 {
                self.points[c].press(&self.offsets, share * impulse, v, recip_mass, S::NORMAL);
            }
        }
    }

    /// Sum impulse, work and extent of the step.
    fn sum(
        &self,
        candidates: &[usize],
        u: &[S::Vector],
        old: &[S::Vector],
        v: &[S::Vector],
        touch: &mut Touch,
    ) {
        let surface = candidates
            .iter()
            .map(|c| (&self.points[*c], self.surface.unknowns[*c].impulse))
            .filter(|(_, impulse)| *impulse > 0.0);
        for (p, impulse) in surface.chain(self.interior.pushing()) {
            touch.impulse += impulse;
            touch.radius = touch.radius.max(p.radius + p.at(&self.offsets, u, 0));
            let at = |field: &[S::Vector]| p.at(&self.offsets, field, S::NORMAL);
            touch.work += 0.5 * impulse * (at(old) + at(v));
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
            assert!(contact.surface.holds());
        }
    }
}
