//! Turning: lumped masses make a body harder to turn than it is; what contact turns is corrected for that.
//!
//! A node takes the mass of its function to one place. That keeps the mass and its centre, but not the moment of inertia: with
//! cells of size h in all directions it is too large by $m h^2/2$ for quadratic splines, 2.8 % of $2/5\ m R^2$ with cells of
//! 0.15 R, of which the effective mass of a sticking contact has five sevenths. The mass matrix is therefore
//! $M + \kappa\ (M r)(M r)^T$ with r the velocities of a turn at unit rate about the centre of mass, and $\kappa$ such that such a
//! turn has the moment of inertia of the sphere. Its inverse adds a turn of the whole body to what the lumped masses answer
//! (Sherman and Morrison 1950); stresses have no moment, so only contact does.

use super::Run;
use super::transfer::Remap;
use crate::impact::wall::meridian::Wall;
use crate::plan::Geometry;
use crate::space::Space;

/// Angular momentum and moment of inertia of the lumped masses about their centre.
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    momentum: f64,
    inertia: f64,
}

impl<S, W, T, const N: usize> Run<'_, S, W, T, N>
where
    S: Space,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    /// Whether the body can turn.
    fn turns(&self) -> bool {
        S::SLIDING.is_some() && self.plan.geometry == Geometry::Half
    }

    /// Centre of mass.
    fn centre(&self) -> S::Vector {
        let mut centre = S::Vector::default();
        for (k, x) in centre.as_mut().iter_mut().enumerate() {
            *x = self.mean(&self.u, k) + self.mean(&self.model.places, k);
        }
        centre
    }

    /// Way from `centre` to a node.
    #[inline(always)]
    fn arm(&self, centre: &S::Vector, n: usize) -> S::Vector {
        let mut arm = self.u[n];
        let places = self.model.places[n].as_ref().iter().zip(centre.as_ref());
        for (x, (place, centre)) in arm.as_mut().iter_mut().zip(places) {
            *x += place - centre;
        }
        arm
    }

    /// Moments of the lumped masses at the velocities that `velocity` gives each node.
    fn moments(&self, centre: &S::Vector, velocity: impl Fn(usize) -> S::Vector) -> Moments {
        let mut sum = Moments::default();
        for (n, mass) in self.model.mass.iter().enumerate() {
            let arm = self.arm(centre, n);
            sum.momentum += mass * S::moment(&arm, &velocity(n));
            sum.inertia += mass * S::moment(&arm, &S::turned(&arm));
        }
        sum
    }

    /// Moment of inertia of the undeformed body's lumped masses above that of the sphere, $2/5\ m R^2$; 0 where it does not turn.
    pub(super) fn excess_inertia(&self) -> f64 {
        if !self.turns() {
            return 0.0;
        }
        let still = |_| S::Vector::default();
        self.moments(&self.centre(), still).inertia - 0.4 * self.mass
    }

    /// Turn the body by what contact turned the lumped masses too little in this step; returns the work of contact in it.
    pub(super) fn turn(&mut self) -> f64 {
        if !self.turns() {
            return 0.0;
        }
        let centre = self.centre();
        let gained = |n: usize| {
            let mut gained = self.v[n];
            for (x, old) in gained.as_mut().iter_mut().zip(self.old[n].as_ref()) {
                *x -= old;
            }
            gained
        };
        let Moments { momentum, inertia } = self.moments(&centre, gained);
        let rate = momentum * ((inertia - self.excess).recip() - inertia.recip());
        for n in 0..self.v.len() {
            let turned = S::turned(&self.arm(&centre, n));
            for (v, x) in self.v[n].as_mut().iter_mut().zip(turned.as_ref()) {
                *v += rate * x;
            }
        }
        0.5 * rate * momentum
    }

    /// Kinetic energy of the lumped masses above that of the body, between the velocities before and after a step.
    pub(super) fn excess_kinetic(&self) -> f64 {
        if !self.turns() {
            return 0.0;
        }
        let centre = self.centre();
        let [before, after] = [&self.old, &self.v].map(|v| self.moments(&centre, |n| v[n]));
        0.5 * self.excess * before.momentum * after.momentum / after.inertia.powi(2)
    }

    /// Rate at which the body turns.
    pub(super) fn spin(&self) -> f64 {
        let Moments { momentum, inertia } = self.moments(&self.centre(), |n| self.v[n]);
        momentum / inertia
    }
}
