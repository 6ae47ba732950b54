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
pub(super) fn length_of_return(
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
