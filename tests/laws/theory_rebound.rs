//! Rebound against closed forms: the elastic impact of Hertz (Johnson 1985, section 11.4) and a bilinear contact.

use crate::impacts::{ELASTIC, RADIUS};
use approx::assert_relative_eq;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::rebound::{rebound, trajectory};
use impactlaw::theory::hertz::Hertz;
use std::f64::consts::PI;

#[test]
fn hertz_impact_meets_the_closed_form() {
    let (law, mass) = (Hertz::of(&ELASTIC), ELASTIC.sphere_mass(RADIUS));
    for velocity in [1e-6, 1e-2, 10.0, 1000.0] {
        let hit = rebound(&law, RADIUS, mass, velocity);
        let e_star = ELASTIC.contact_modulus();
        let delta = (15.0 * mass * velocity * velocity / (16.0 * e_star * RADIUS.sqrt())).powf(0.4);
        assert_relative_eq!(hit.max_displacement, delta, max_relative = 1e-12);
        let force = 4.0 / 3.0 * e_star * RADIUS.sqrt() * delta.powf(1.5);
        assert_relative_eq!(hit.max_force, force, max_relative = 1e-12);
        // 2 sqrt(pi) Gamma(7/5) / Gamma(9/10)
        assert_relative_eq!(
            hit.contact_time * velocity / delta,
            2.943_275_184_324_706,
            max_relative = 1e-12
        );
        assert_relative_eq!(hit.restitution, 1.0, max_relative = 1e-13);
        assert!(hit.residual_displacement < 1e-15 * delta);
    }
    let hit = rebound(&law, RADIUS, mass, 10.0);
    assert_relative_eq!(
        hit.max_displacement,
        3.750_583_233_255_4e-6,
        max_relative = 1e-12
    );
    assert_relative_eq!(hit.max_force, 17.450_578_451_229, max_relative = 1e-12);
    assert_relative_eq!(hit.contact_time, 1.103_899_855_7e-6, max_relative = 1e-10);
}

/// Linear loading and unloading: both halves are quarter periods.
#[derive(Clone)]
struct Linear {
    load: f64,
    unload: f64,
}

impl NormalLaw for Linear {
    type History = f64;
    fn force(&self, x: f64, largest: &mut f64) -> f64 {
        *largest = largest.max(x);
        let residual = *largest * (1.0 - self.load / self.unload);
        (self.unload * (x - residual)).max(0.0)
    }
    fn stiffness(&self, _: f64, _: &f64) -> f64 {
        self.unload
    }
    fn depth(&self, x: f64, largest: &f64) -> f64 {
        (x - largest * (1.0 - self.load / self.unload)).max(0.0)
    }
    fn dissipated(&self, largest: &f64) -> f64 {
        0.5 * self.load * largest * largest * (1.0 - self.load / self.unload)
    }
    fn elastic_energy(&self, x: f64, largest: &f64) -> f64 {
        let force = self.force(x, &mut largest.clone());
        0.5 * force * force / self.unload
    }
    fn contact_radius(&self, _: f64, _: &f64) -> Option<f64> {
        None
    }
    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}

#[test]
fn linear_springs_take_two_quarter_periods() {
    let law = Linear {
        load: 1e6,
        unload: 4e6,
    };
    let (radius, mass) = (0.01, 0.02);
    let hit = rebound(&law, radius, mass, 0.3);
    let quarter = |stiffness: f64| 0.5 * PI * (mass / (stiffness * radius)).sqrt();
    assert_relative_eq!(hit.restitution, 0.5, max_relative = 1e-12);
    assert_relative_eq!(
        hit.contact_time,
        quarter(1e6) + quarter(4e6),
        max_relative = 1e-12
    );
    assert_relative_eq!(
        hit.residual_displacement,
        0.75 * hit.max_displacement,
        max_relative = 1e-12
    );
}

#[test]
fn trajectory_obeys_newton_and_ends_with_the_rebound_speed() {
    let (law, mass) = (Hertz::of(&ELASTIC), ELASTIC.sphere_mass(RADIUS));
    let hit = rebound(&law, RADIUS, mass, 10.0);
    let path = trajectory(&law, RADIUS, mass, 10.0);
    assert!(path.len() >= 16);
    let (first, last) = (path[0], path[path.len() - 1]);
    assert!(first.time.abs() < 1e-12 * hit.contact_time);
    assert_relative_eq!(first.velocity, 10.0, max_relative = 1e-12);
    assert_relative_eq!(last.time, hit.contact_time, max_relative = 1e-12);
    assert_relative_eq!(last.velocity, -10.0 * hit.restitution, max_relative = 1e-12);
    for state in &path {
        let kinetic = 0.5 * mass * state.velocity * state.velocity;
        let stored = 0.4 * state.force * state.displacement;
        assert_relative_eq!(kinetic + stored, 0.5 * mass * 100.0, max_relative = 1e-11);
    }
}

#[test]
fn senseless_arguments_give_nan_and_not_a_hang() {
    let law = Hertz::new(1e9);
    for (radius, mass, velocity) in [
        (0.0, 1.0, 1.0),
        (1.0, -1.0, 1.0),
        (1.0, 1.0, 0.0),
        (1.0, 1.0, f64::INFINITY),
    ] {
        assert!(rebound(&law, radius, mass, velocity).restitution.is_nan());
        assert!(trajectory(&law, radius, mass, velocity).is_empty());
    }
    let nothing = Linear {
        load: 0.0,
        unload: 0.0,
    };
    assert!(rebound(&nothing, 1.0, 1.0, 1.0).restitution.is_nan());
}
