//! Flow stresses that are a product: the strength at rest, which knows the strain, times a rate factor, times the share of it
//! that heat has left.
//!
//! The rate is that of the step itself, so the stress at the end of the step lies on the yield surface of the end of the step.
//!
//! With $\Delta$ the plastic strain of the step, what is left of the condition of the return,
//!
//! $$ h(\ln \Delta) = |s_{dev}| - \tfrac{k}{r} \Delta - r\ \sigma_y(\varepsilon + \Delta, \Delta / \Delta t), \qquad
//!    r = \sqrt{2/3}, $$
//!
//! falls and is concave in the logarithm of $\Delta$ for hardening by a power $n \le 1$ or a straight line times a rate factor that is
//! convex in the logarithm of the rate (Johnson and Cook's with its floor, Cowper and Symonds'). Newton's method from above,
//! where the body would flow as it does at rest without hardening, comes down to the root and cannot overshoot.

use super::{Constants, FlowStress, ROOT};
use crate::lanes::Lanes;
use crate::material::constant::Constant;
use crate::tape::Keep;
use std::fmt;

/// A flow stress that is a product; [`FlowStress`] follows.
pub trait Product: Constants + Send + Sync + 'static {
    /// As [`FlowStress::Memory`].
    type Memory: Copy + Default + fmt::Debug + Keep + Send + Sync;
    /// As [`FlowStress::COST`].
    const COST: f64;

    /// Strength at rest of a point that is not heated, and its slope over the strain.
    fn rest(&self, strain: f64) -> [f64; 2];

    /// Factor of a plastic strain `increment` in a time `dt`, 1 at rest, and its derivative with respect to the increment.
    fn rate_factor(&self, increment: f64, dt: f64) -> [f64; 2];

    /// Whether the factor grows with the rate: then nothing flows in no time.
    fn knows_rates(&self) -> bool {
        true
    }

    /// Share of the strength that heat has left.
    #[inline(always)]
    fn left(&self, _memory: &Self::Memory) -> Lanes {
        Lanes::splat(1.0)
    }

    /// As [`FlowStress::remember`].
    #[inline(always)]
    fn remember(&self, _work: Lanes, _memory: &mut Self::Memory) {}

    /// As [`FlowStress::heat_share`].
    fn heat_share(&self) -> f64 {
        0.0
    }

    /// As [`FlowStress::temperature`].
    fn temperature(&self, _memory: &Self::Memory) -> Option<Lanes> {
        None
    }

    /// As [`FlowStress::heat_to_melt`].
    fn heat_to_melt(&self) -> Option<f64> {
        None
    }

    /// As [`FlowStress::contradiction`].
    fn contradiction(&self) -> Option<(Constant, String)> {
        None
    }

    /// Stress of an unheated point at a `strain` that grew by the increment in `dt`, and its whole derivative.
    #[inline(always)]
    fn unheated(&self, strain: f64, increment: f64, dt: f64) -> [f64; 2] {
        let [rest, slope] = self.rest(strain);
        let [factor, growth] = self.rate_factor(increment, dt);
        [rest * factor, slope * factor + rest * growth]
    }
}

impl<P: Product> FlowStress for P {
    type Memory = P::Memory;
    const COST: f64 = P::COST;

    #[inline(always)]
    fn stress(&self, strain: Lanes, increment: Lanes, dt: f64, memory: &P::Memory) -> Lanes {
        let unheated = |strain, increment| self.unheated(strain, increment, dt)[0];
        strain.zip(increment, unheated) * self.left(memory)
    }

    #[inline(always)]
    fn slope(&self, strain: Lanes, increment: Lanes, dt: f64, memory: &P::Memory) -> Lanes {
        let unheated = |strain, increment| self.unheated(strain, increment, dt)[1];
        strain.zip(increment, unheated) * self.left(memory)
    }

    #[inline(always)]
    fn remember(&self, _: Lanes, _: f64, work: Lanes, memory: &mut P::Memory) {
        Product::remember(self, work, memory);
    }

    fn heat_share(&self) -> f64 {
        Product::heat_share(self)
    }

    fn temperature(&self, memory: &P::Memory) -> Option<Lanes> {
        Product::temperature(self, memory)
    }

    fn heat_to_melt(&self) -> Option<f64> {
        Product::heat_to_melt(self)
    }

    fn contradiction(&self) -> Option<(Constant, String)> {
        Product::contradiction(self)
    }

    #[inline(always)]
    fn length_of_return(
        &self,
        norm: Lanes,
        stiffness: Lanes,
        strain: Lanes,
        dt: f64,
        memory: &P::Memory,
    ) -> Lanes {
        if dt == 0.0 && self.knows_rates() {
            return Lanes::default();
        }
        let (norm, stiffness, strain) = (norm.array(), stiffness.array(), strain.array());
        let left = self.left(memory).array();
        Lanes::each(|k| {
            let hardening = |strain: f64| {
                let [rest, slope] = self.rest(strain);
                [left[k] * rest, left[k] * slope]
            };
            let factor = |increment: f64| self.rate_factor(increment, dt);
            let point = [norm[k], stiffness[k], strain[k]];
            length_of_return(point, hardening(strain[k]), hardening, factor)
        })
    }
}

/// Newton steps at most: far from the root each takes an n-th off the logarithm at least, and first yielding under a power of 0.1
/// starts within a hundred of it.
const STEPS: usize = 200;
/// Step in the logarithm after which the next changes nothing.
const ENOUGH: f64 = 1e-7;
/// Increment over the strain up to which hardening is nearly a straight line in a step.
const STRAIGHT: f64 = 0.1;
/// Distance over the strain within which the tangent of a power is the power, to rounding.
const TANGENT: f64 = 3e-8;

/// Length of the return of a deviator of size `norm` that loses `stiffness` times it, at the `strain` at which the stress at rest
/// and its slope are `rest`. `hardening`: the same at another strain; `factor`: what the stress of an increment is over that at
/// rest, and its derivative.
///
/// At strains far above the increment powers are taken by their tangent, along which the equation is solved, until the tangent is
/// that of the root: two powers a return in place of one a step.
#[inline(always)]
fn length_of_return(
    [norm, stiffness, strain]: [f64; 3],
    rest: [f64; 2],
    hardening: impl Fn(f64) -> [f64; 2],
    factor: impl Fn(f64) -> [f64; 2],
) -> f64 {
    let above = norm - ROOT * rest[0];
    // a point turned inside out has no size
    if !(above > 0.0) {
        return 0.0;
    }
    let loss = stiffness / ROOT;
    // step in the logarithm, given stress at rest and slope there
    let step = |increment: f64, [stress, slope]: [f64; 2]| {
        let [factor, growth] = factor(increment);
        let misfit = norm - loss * increment - ROOT * stress * factor;
        misfit / (increment * (loss + ROOT * (slope * factor + stress * growth)))
    };
    let mut increment = above / loss;
    if increment > STRAIGHT * strain {
        for _ in 0..STEPS {
            let step = step(increment, hardening(strain + increment));
            increment *= step.exp();
            if !(step.abs() > ENOUGH) {
                break;
            }
        }
        return increment / ROOT;
    }
    let (mut touching, [mut stress, mut slope]) = (0.0, rest);
    for _ in 0..STEPS {
        for _ in 0..STEPS {
            let along = stress + slope * (increment - touching);
            let step = step(increment, [along, slope]);
            increment *= step.exp();
            if !(step.abs() > ENOUGH) {
                break;
            }
        }
        if !((increment - touching).abs() > TANGENT * strain) {
            break;
        }
        touching = increment;
        [stress, slope] = hardening(strain + increment);
    }
    increment / ROOT
}
