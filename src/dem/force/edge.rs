//! Edge of a contact: the step in which it begins, and that in which it ends.
//!
//! The force of a step stands for the time from half a step before to half a step after it. In the step in which bodies touch
//! for the first time a part of that time is over before they do, and in the last one they come apart within it. There a force
//! that grows like $t^p$ from the first touch, a part $\theta$ of the step ago, has to give the impulse that makes the sum over
//! all steps what its integral is, which is Hurwitz's zeta function:
//!
//! $$ \theta^p - \zeta(-p, \theta) = a^{p+1} \left( \frac{1}{p + 1} - \frac{p}{24 a^2} + \frac{7 p (p-1) (p-2)}{5760 a^4} - \dots \right),
//!    \quad a = \theta + \tfrac12 $$
//!
//! Left as it is, an undamped grain gains or loses up to $10^{-3}$ of its energy in an impact of twenty steps, by where within a
//! step it touches; so weighed, some $10^{-5}$, and as much when it leaves as when it came, turned round: what is left of the error
//! does not add up from bounce to bounce.

use crate::contact::pair::Pressed;

/// What a way may be longer by for the rounding of places: bodies that touched a whole step ago did so within it.
const ROUNDING: f64 = 1e-6;

/// Part of the step that is past since bodies touched, or left until they part, at the closing speed `approach` (m/s) of the
/// step that led here, `inverse_mass` (1/kg) being that of their effective mass and `dt` (s) the step; infinite within a contact.
/// `touched`: they did a step ago.
#[inline(always)]
pub(super) fn edge(
    pressed: &Pressed,
    approach: f64,
    inverse_mass: f64,
    dt: f64,
    touched: bool,
) -> f64 {
    let kick = pressed.force * dt * inverse_mass;
    if pressed.depth > (approach.abs() + kick) * dt * (1.0 + ROUNDING) {
        return f64::INFINITY;
    }
    near_an_edge(pressed, [approach, kick], dt, touched)
}

/// The same for a contact shallow enough.
#[cold]
#[inline(never)]
fn near_an_edge(pressed: &Pressed, [approach, kick]: [f64; 2], dt: f64, touched: bool) -> f64 {
    // going apart, the step to come is the one in question: as long as it will be under this force
    let speed = if approach > 0.0 {
        approach
    } else {
        kick - approach
    };
    let way = speed * dt * (1.0 + ROUNDING);
    let begins_or_ends = approach <= 0.0 || !touched;
    if pressed.depth <= way && begins_or_ends && pressed.force > 0.0 {
        pressed.depth / way
    } else {
        f64::INFINITY
    }
}

/// What a force that grows like $t^p$, p = `power`, is multiplied by where a `part` of the step is past since first touch.
#[cold]
#[inline(never)]
pub(super) fn weight(power: f64, part: f64) -> f64 {
    let (p, a) = (power, part + 0.5);
    let square = 1.0 / (a * a);
    let third = 7.0 * p * (p - 1.0) * (p - 2.0) / 5760.0;
    let series = 1.0 / (p + 1.0) + square * (third * square - p / 24.0);
    a * series * (a / part).powf(p)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weighed_first_step_makes_the_sum_of_the_steps_the_integral() {
        for power in [0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5] {
            for part in [1e-6, 0.1, 0.5, 0.9, 1.0] {
                let steps = 1000;
                let rest: f64 = (1..=steps).map(|k| (part + f64::from(k)).powf(power)).sum();
                let sum = weight(power, part) * part.powf(power) + rest;
                let end = part + f64::from(steps) + 0.5;
                // the midpoint rule's own error at the far end
                let far = end.powf(power - 1.0) * power / 24.0;
                let off = sum + far - end.powf(power + 1.0) / (power + 1.0);
                assert!(off.abs() < 2e-3, "{power} {part}: {off}");
            }
        }
    }
}
