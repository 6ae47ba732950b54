//! Rebound with inertia, against an independent integration in time and against its own limits.

use approx::assert_relative_eq;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::elastoplastic::{ClosedForm, Elastoplastic, YieldUnits};
use impactlaw::contact::loading::SoftenedHertz;
use impactlaw::contact::rebound::{Rebound, rebound, trajectory};
use impactlaw::contact::unloading::Unloading;

const RADIUS: f64 = 250e-6;
const DENSITY: f64 = 8000.0;

fn mass() -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) * DENSITY
}

/// A law near that of the reference material, E/Y = 80.
fn still() -> ClosedForm {
    let units = YieldUnits {
        flattening: 7.6e-4,
        force: 3.18e6,
    };
    let curve = SoftenedHertz::new(0.8, 11.5, 1.2).unwrap();
    let unloading = Unloading::new(9.0, 0.65, -0.2, 7.0).unwrap();
    Elastoplastic::new(curve, unloading, units, 0.1).unwrap()
}

fn moving(kappa: f64) -> ClosedForm {
    still().with_inertia(kappa, DENSITY).unwrap()
}

/// The impact by classical Runge-Kutta steps in time, with the law called as a code that steps would: history kept,
/// inertia while the approach is the largest so far. Events are placed by shortening the last step.
fn stepped(law: &ClosedForm, velocity: f64, dt: f64) -> Rebound {
    let (mut time, mut x, mut v) = (0.0, 0.0, velocity);
    let mut history = Default::default();
    let (mut max_force, mut turn) = (0.0f64, 0.0);
    loop {
        let loading = v > 0.0;
        let force = |x: f64, v: f64| {
            let core = law.force(x / RADIUS, &mut { history });
            let added = if loading {
                law.inertia().force(x / RADIUS, v * v)
            } else {
                0.0
            };
            (core + added) * RADIUS * RADIUS
        };
        let step = |h: f64| {
            let a = |x: f64, v: f64| -force(x, v) / mass();
            let (k1, l1) = (v, a(x, v));
            let (k2, l2) = (v + 0.5 * h * l1, a(x + 0.5 * h * k1, v + 0.5 * h * l1));
            let (k3, l3) = (v + 0.5 * h * l2, a(x + 0.5 * h * k2, v + 0.5 * h * l2));
            let (k4, l4) = (v + h * l3, a(x + h * k3, v + h * l3));
            let sum = |a, b, c, d| h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
            (x + sum(k1, k2, k3, k4), v + sum(l1, l2, l3, l4))
        };
        let over = |(x, v): (f64, f64)| match loading {
            true => v <= 0.0,
            false => x / RADIUS <= law.residual(&history),
        };
        max_force = max_force.max(force(x, v));
        let (mut h, done) = (dt, over(step(dt)));
        if done {
            let mut short = 0.0;
            for _ in 0..60 {
                let middle = 0.5 * (short + h);
                if over(step(middle)) {
                    h = middle
                } else {
                    short = middle
                }
            }
        }
        (x, v) = step(h);
        time += h;
        law.force(x / RADIUS, &mut history);
        if done && loading {
            (turn, v) = (x, -0.0);
        } else if done {
            return Rebound {
                restitution: -v / velocity,
                max_force,
                max_displacement: turn,
                residual_displacement: x,
                contact_time: time,
            };
        }
    }
}

#[test]
fn rebound_with_inertia_is_the_impact_stepped_in_time() {
    // at 400 m/s and kappa = 30 the force is largest long before the turning point
    for (kappa, velocity) in [(8.0, 10.0), (8.0, 50.0), (30.0, 400.0)] {
        let law = moving(kappa);
        let exact = rebound(&law, RADIUS, mass(), velocity);
        let fine = stepped(&law, velocity, exact.contact_time / 40_000.0);
        let tolerance = 1e-6;
        assert_relative_eq!(
            exact.restitution,
            fine.restitution,
            max_relative = tolerance
        );
        assert_relative_eq!(exact.max_force, fine.max_force, max_relative = tolerance);
        assert_relative_eq!(
            exact.max_displacement,
            fine.max_displacement,
            max_relative = tolerance
        );
        assert_relative_eq!(
            exact.contact_time,
            fine.contact_time,
            max_relative = tolerance
        );
    }
}

#[test]
fn largest_force_of_a_very_fast_impact_lies_before_the_turning_point() {
    let law = moving(30.0);
    let hit = rebound(&law, RADIUS, mass(), 400.0);
    let at_turn = law.force(hit.max_displacement / RADIUS, &mut Default::default());
    assert!(hit.max_force > 1.5 * at_turn * RADIUS * RADIUS);
    let seen = trajectory(&law, RADIUS, mass(), 400.0);
    let seen = seen.iter().map(|s| s.force).fold(0.0, f64::max);
    assert!(seen <= hit.max_force && seen > 0.9 * hit.max_force);
}

#[test]
fn no_inertia_gives_the_same_bits_as_a_law_without_the_term() {
    for velocity in [0.01, 1.0, 50.0, 400.0] {
        let [a, b] = [moving(0.0), still()].map(|law| rebound(&law, RADIUS, mass(), velocity));
        assert_eq!(a, b);
    }
}

#[test]
fn inertia_takes_energy_and_shortens_the_approach() {
    for velocity in [10.0, 50.0, 200.0] {
        let hits = [0.0, 4.0, 8.0].map(|kappa| rebound(&moving(kappa), RADIUS, mass(), velocity));
        for pair in hits.windows(2) {
            assert!(pair[1].restitution < pair[0].restitution);
            assert!(pair[1].max_displacement < pair[0].max_displacement);
        }
    }
}

#[test]
fn an_impact_that_stays_elastic_knows_no_inertia() {
    let hits = [0.0, 8.0].map(|kappa| rebound(&moving(kappa), RADIUS, mass(), 0.05));
    assert_eq!(hits[0].max_displacement, hits[1].max_displacement);
    assert_relative_eq!(hits[1].restitution, 1.0, max_relative = 1e-12);
}
