//! Viscosity: coefficients of the viscous stress in shocks (`impact/kernel/shock.rs`), and the time step it leaves.

/// Coefficient $c_2$ of the squared speed at which the sides of a cell close in.
pub const QUADRATIC: f64 = 1.5;
/// Coefficient $c_1$ of the speed.
pub const LINEAR: f64 = 0.06;

/// Share of the stable step of an undamped body that viscous stresses leave to one that hits the wall at `mach` times its
/// dilatational wave speed: $\sqrt{1 + \zeta^2} - \zeta$ with the damping ratio $\zeta = c_1 + c_2 w/c_d$ of the fastest mode and
/// w = V, over what the estimate of the step keeps in hand.
#[must_use]
pub fn stable_share(mach: f64) -> f64 {
    let damping = LINEAR + QUADRATIC * mach;
    ((damping.hypot(1.0) - damping) / IN_HAND).min(1.0)
}

/// Share of the stability limit that estimates use at most.
const IN_HAND: f64 = 0.9;
