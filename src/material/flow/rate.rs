//! Return of a flow stress that grows with the rate: the rate is that of the step itself, so the stress at the end of the step
//! lies on the yield surface of the end of the step.
//!
//! With $\Delta$ the plastic strain of the step, what is left of the condition of the return,
//!
//! $$ h(\ln \Delta) = |s_{dev}| - \tfrac{k}{r} \Delta - r\ \sigma_y(\varepsilon + \Delta, \Delta / \Delta t), \qquad
//!    r = \sqrt{2/3}, $$
//!
//! falls and is concave in the logarithm of $\Delta$ for hardening by a power $n \le 1$ or a straight line times a rate factor that is
//! convex in the logarithm of the rate (Johnson and Cook's with its floor, Cowper and Symonds'). Newton's method from above,
//! where the body would flow as it does at rest without hardening, comes down to the root and cannot overshoot.

use super::ROOT;

/// Newton steps at most: far from the root each takes an n-th off the logarithm at least, and first yielding under a power of 0.1
/// starts within a hundred of it.
const STEPS: usize = 200;
/// Step in the logarithm after which the next changes nothing.
const ENOUGH: f64 = 1e-9;

/// Length of the return of a deviator of size `norm` that loses `stiffness` times it; `rest`: stress at rest at the beginning of the
/// step; `stress`: that of an increment, with its whole derivative.
#[inline(always)]
pub(super) fn length_of_return(
    norm: f64,
    stiffness: f64,
    rest: f64,
    stress: impl Fn(f64) -> [f64; 2],
) -> f64 {
    let above = norm - ROOT * rest;
    // a point turned inside out has no size
    if !(above > 0.0) {
        return 0.0;
    }
    let mut increment = ROOT * above / stiffness;
    for _ in 0..STEPS {
        let [flow, slope] = stress(increment);
        let misfit = norm - stiffness / ROOT * increment - ROOT * flow;
        let step = misfit / (increment * (stiffness / ROOT + ROOT * slope));
        increment *= step.exp();
        if !(step.abs() > ENOUGH) {
            break;
        }
    }
    increment / ROOT
}
