//! Oblique impacts of an elastic ball in the bed: in closed form where it sticks and where it slides throughout, beside the
//! theory with micro-slip, and beside published results.

use crate::collisions::{RADIUS, thrown};
use crate::maw_barber_fawcett::tangential_restitution;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::material::Material;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;
use std::f64::consts::PI;

const BALL: Material = Material {
    density: 7850.0,
    young_modulus: 208e9,
    poisson_ratio: 0.3,
    flow: None,
};
/// Slow enough for lever arms that are R to six digits, m/s.
const SLOW: f64 = 1e-4;

/// Tangential over normal stiffness of a Hertz contact, 2 (1 - nu)/(2 - nu).
fn kappa(nu: f64) -> f64 {
    2.0 * (1.0 - nu) / (2.0 - nu)
}

/// Speed of the ball's surface along the wall after an impact with `slip` before, at the normal speed [`SLOW`].
fn slip_after(friction: f64, slip: f64, steps: f64) -> f64 {
    let effects = Law::smooth().with(Mindlin::new(&BALL, friction));
    let velocity = Vector::new(slip, 0.0, -SLOW);
    let [velocity, spin] = thrown(effects, Hertz::of(&BALL), &BALL, velocity, steps);
    velocity.x - RADIUS * spin.y
}

/// Rebound number psi_2 of Maw, Barber and Fawcett 1976 to the incidence psi_1: psi = kappa v_s/(mu v_n).
fn rebound_number(psi: f64) -> f64 {
    let friction = 0.3;
    let scale = friction * SLOW / kappa(BALL.poisson_ratio);
    slip_after(friction, psi * scale, 4000.0) / scale
}

/// Gamma function: Stirling's series beyond 20, by recurrence below.
fn gamma(x: f64) -> f64 {
    if x < 20.0 {
        return gamma(x + 1.0) / x;
    }
    let series = 1.0 / (12.0 * x) - 1.0 / (360.0 * x.powi(3)) + 1.0 / (1260.0 * x.powi(5));
    (2.0 * PI / x).sqrt() * (x / std::f64::consts::E).powf(x) * series.exp()
}

/// Slip after over slip before an elastic impact that sticks throughout.
///
/// With x the normal speed over that of approach, from 1 to -1, Hertz's force makes $\delta^{5/2} \propto 1 - x^2$. Mindlin's
/// spring keeps its load while the contact grows and loses it in proportion while it shrinks, so that the slip s obeys
///
/// $$ (1 - x^2) s'' - \tfrac65 x s' + \tfrac65 \Lambda s = 0 \; (x > 0), \quad
/// (1 - x^2) s'' - \tfrac45 x s' + \tfrac65 \Lambda s = 0 \; (x < 0), \quad \Lambda = \kappa (1 + 1/K) $$
///
/// Both are Gegenbauer's equation. The first with $\dot s = 0$ at x = 1 is ${}_2F_1(-n, n + \frac15; \frac35; \frac{1-x}2)$,
/// $n (n + \frac15) = \frac65 \Lambda$, known at x = 0; the second is summed at x = -1 by Gauss's theorem.
fn sticking(nu: f64) -> f64 {
    let product = 1.2 * 3.5 * kappa(nu);
    let n = -0.1 + (0.01 + product).sqrt();
    let (a, b) = (-n, n + 0.2);
    let common = PI.sqrt() * gamma(0.6);
    let slip = common / (gamma(0.5 * (a + 1.0)) * gamma(0.5 * (b + 1.0)));
    let slope = -2.0 * common / (gamma(0.5 * a) * gamma(0.5 * b));
    let m = 0.1 + (0.01 + product).sqrt();
    let gauss =
        |a: f64, b: f64, c: f64| gamma(c) * gamma(c - a - b) / (gamma(c - a) * gamma(c - b));
    let even = gauss(-0.5 * m, 0.5 * (m - 0.2), 0.5);
    let odd = gauss(0.5 * (1.0 - m), 0.5 * (m + 0.8), 1.5);
    slip * even - slope * odd
}

#[test]
fn a_ball_that_sticks_gives_back_what_gegenbauers_equation_says() {
    // no friction's limit: Lambda = 2.88, e_t = -s_2/s_1
    let closed = sticking(BALL.poisson_ratio);
    let off = [4000.0, 16_000.0, 64_000.0].map(|steps| {
        let found = slip_after(1e9, SLOW, steps) / SLOW;
        println!("{steps} steps: slip after over before {found:.7}; closed form {closed:.7}");
        (found - closed).abs()
    });
    assert!(off[2] < 5e-5, "{off:?}");
    // first order in the step: the spring stretches under the stiffness of the step's end
    assert!(off[1] < 0.27 * off[0] && off[2] < 0.27 * off[1], "{off:?}");
}

#[test]
fn rebound_numbers_beside_maw_barber_and_fawcett() {
    let kappa = kappa(BALL.poisson_ratio);
    let chi = 0.5 * kappa * 3.5;
    println!("kappa {kappa:.4}, chi {chi:.4}\n  psi_1   psi_2 bed   with micro-slip");
    let mut worst = 0.0f64;
    for psi in [0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0] {
        let bed = rebound_number(psi);
        let (mu, normal) = (0.3, 1e-3);
        let along = psi * mu * normal / kappa;
        let theory = -psi * tangential_restitution(BALL.poisson_ratio, mu, normal, along);
        println!("{psi:7.2} {bed:11.5} {theory:11.3}");
        worst = worst.max((bed - theory).abs());
        if psi >= 4.0 * chi - 2.0 / 3.0 {
            assert!((bed - (psi - 4.0 * chi)).abs() < 1e-4, "{psi}: {bed}");
        }
    }
    println!("largest difference {worst:.3}");
}

#[test]
fn sliding_ends_where_the_spring_gives_back_faster_than_the_limit_falls() {
    // Slides throughout as long as 4 chi is taken from psi. With micro-slip that holds down to psi_2 = -1 (Maw, Barber and
    // Fawcett 1976): k_t v_s then falls as fast as mu F. A spring whose load falls in proportion to the contact radius has a
    // third of that already, since F goes with its cube: down to psi_2 = -2/3.
    let four_chi = 7.0 * kappa(BALL.poisson_ratio);
    for below in [0.2, 0.4, 0.6, 0.65] {
        let bed = rebound_number(four_chi - below);
        assert!((bed + below).abs() < 1e-4, "{bed} for {}", -below);
    }
    let bed = rebound_number(four_chi - 0.8);
    assert!((bed + 0.8).abs() > 1e-3, "{bed}");
    // and it sticks at first for psi_1 < 1, as in that theory: a ball with next to no slip has no sliding but the last
    let nearly = rebound_number(0.01) / 0.01;
    assert!(
        (nearly - sticking(BALL.poisson_ratio)).abs() < 0.05,
        "{nearly}"
    );
}
