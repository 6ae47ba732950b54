//! Hard cases: the corners of the range and beyond, each against bounds that can be derived.

use impactlaw::case::Case;
use impactlaw::curve::{Impact, MapPoint, Part, Status};
use impactlaw::impact::{Simulated, simulate, simulate_repeated};
use impactlaw::plan::{Plan, plan};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

const DENSITY: f64 = 1000.0;
const MODULUS: f64 = 1e9;

/// What makes an impact; the rest is fixed.
#[derive(Clone, Copy)]
struct Body {
    radius: f64,
    poisson_ratio: f64,
    /// E/Y, or elastic.
    ratio: Option<f64>,
    velocity: f64,
    tolerance: f64,
}

impl Body {
    /// A millimetre grain of Poisson's ratio 0.35 with E/Y and rho V^2/Y.
    fn yielding(ratio: f64, severity: f64) -> Self {
        Body {
            radius: 1e-3,
            poisson_ratio: 0.35,
            ratio: Some(ratio),
            velocity: (severity * MODULUS / ratio / DENSITY).sqrt(),
            tolerance: 0.02,
        }
    }

    /// The same without yield, at V/c0.
    fn elastic(poisson_ratio: f64, speed: f64) -> Self {
        Body {
            radius: 1e-3,
            poisson_ratio,
            ratio: None,
            velocity: speed * (MODULUS / DENSITY).sqrt(),
            tolerance: 0.02,
        }
    }

    fn case(&self) -> Case {
        self.written("").unwrap()
    }

    /// The case file that begins with `first`, read.
    fn written(&self, first: &str) -> impactlaw::Result<Case> {
        let strength = self.ratio.map_or(String::new(), |r| {
            format!("yield_strength = \"{} Pa\"\n", MODULUS / r)
        });
        let text = format!(
            "{first}[particle]\nradius = \"{} m\"\n[material]\ndensity = \"{DENSITY} kg/m3\"\nyoung_modulus = \"{MODULUS} Pa\"\n\
             poisson_ratio = {}\n{strength}[impact]\nvelocities = [\"{} m/s\"]\n[accuracy]\ntolerance = {}\n",
            self.radius, self.poisson_ratio, self.velocity, self.tolerance
        );
        Case::parse(&text, Path::new("hard.toml"))
    }

    fn planned(&self) -> (Case, Plan) {
        let case = self.case();
        let plan = plan(&case, self.velocity);
        (case, plan)
    }

    fn simulated(&self) -> Impact {
        let (case, plan) = self.planned();
        let impact = simulate(&case.material, case.radius, &plan).impact;
        check(self, &impact);
        impact
    }

    fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3) * DENSITY
    }

    /// Hertz's largest displacement and force on a rigid plane (Johnson 1985, equations 11.21 and 4.23).
    fn hertz(&self) -> (f64, f64) {
        let modulus = MODULUS / (1.0 - self.poisson_ratio.powi(2));
        let energy = self.mass() * self.velocity.powi(2);
        let root = self.radius.sqrt();
        let displacement = (15.0 * energy / (16.0 * root * modulus)).powf(0.4);
        let force = 4.0 / 3.0 * modulus * root * displacement.powf(1.5);
        (displacement, force)
    }
}

/// Bounds that hold for any impact: energy is kept, nothing is gained, and the force has turned the momentum.
fn check(body: &Body, impact: &Impact) {
    let s = &impact.summary;
    assert_eq!(s.status, Status::Ok);
    assert!(s.energy_closure < 0.01, "closure {}", s.energy_closure);
    assert!((0.0..1.0).contains(&s.restitution), "e {}", s.restitution);
    assert!(s.plastic_work_ratio <= 1.0 - s.restitution.powi(2) + 0.01);
    assert!(s.max_displacement_m < body.radius);
    let samples = &impact.curve.samples;
    let impulse: f64 = samples
        .windows(2)
        .map(|p| 0.5 * (p[0].force_n + p[1].force_n) * (p[1].time_s - p[0].time_s))
        .sum();
    let turned = body.mass() * body.velocity * (1.0 + s.restitution);
    assert!(
        (impulse / turned - 1.0).abs() < 0.02,
        "impulse {impulse:e} against {turned:e}"
    );
}

fn change(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn a_modulus_of_twenty_thousand_yield_strengths_loses_more_than_one_of_two_thousand() {
    let (soft, stiff) = (
        Body::yielding(2e3, 0.01).simulated().summary,
        Body::yielding(2e4, 0.01).simulated().summary,
    );
    assert!(stiff.restitution < 0.7 * soft.restitution && stiff.restitution > 0.0);
    assert!(stiff.plastic_work_ratio > soft.plastic_work_ratio);
    // fully plastic: the displacement follows from rho V^2/Y alone
    assert!(change(stiff.max_displacement_m, soft.max_displacement_m) < 0.05);
}

#[test]
fn poisson_ratios_of_0_and_of_almost_a_half_follow_hertz() {
    for nu in [0.0, 0.49] {
        // slow: the sphere differs from a half-space by some sqrt(delta/R)
        let body = Body::elastic(nu, 2e-4);
        let s = body.simulated().summary;
        let (displacement, force) = body.hertz();
        assert!(
            change(s.max_displacement_m, displacement) < 0.03,
            "nu {nu}: {} against {displacement}",
            s.max_displacement_m
        );
        assert!(
            change(s.max_force_n, force) < 0.03,
            "nu {nu}: {} against {force}",
            s.max_force_n
        );
        assert!(s.restitution > 0.99, "nu {nu}: {}", s.restitution);
    }
}

#[test]
fn almost_incompressible_and_fully_compressible_particles_yield_without_locking() {
    let at = |poisson_ratio: f64| {
        let body = Body {
            poisson_ratio,
            ..Body::yielding(100.0, 0.05)
        };
        body.simulated().summary
    };
    let (none, usual, almost) = (at(0.0), at(0.35), at(0.49));
    // plastic flow is isochoric at any nu: a locked sphere would be far stiffer
    assert!(change(none.max_displacement_m, usual.max_displacement_m) < 0.05);
    assert!(change(almost.max_displacement_m, usual.max_displacement_m) < 0.05);
}

#[test]
fn just_above_the_yield_speed_the_impact_is_that_just_below_it() {
    let probe = Body::yielding(100.0, 0.01);
    let limit = (probe.case().material)
        .yield_point(probe.radius, impactlaw::material::YIELD_PRESSURE_RATIO)
        .unwrap()
        .velocity;
    let at = |share: f64| Body {
        velocity: share * limit,
        ..probe
    };
    let slow = at(0.3).simulated().summary;
    assert!(slow.restitution > 0.995 && slow.plastic_work_ratio == 0.0);
    assert_eq!(slow.compression_ratio, 0.0);
    let (displacement, _) = at(0.3).hertz();
    assert!(change(slow.max_displacement_m, displacement) < 0.03);
    let (below, above) = (at(0.99).simulated().summary, at(1.01).simulated().summary);
    assert!(below.plastic_work_ratio == 0.0 && above.plastic_work_ratio < 2e-3);
    assert!((below.restitution - above.restitution).abs() < 2e-3);
    // F ~ V^(6/5) between them
    let expected = (1.01f64 / 0.99).powf(1.2);
    assert!(change(above.max_force_n / below.max_force_n, expected) < 0.01);
}

#[test]
fn a_micrometre_and_a_metre_are_the_same_impact() {
    let at = |radius: f64| {
        let body = Body {
            radius,
            ..Body::yielding(80.0, 0.02)
        };
        (body.simulated().summary, radius)
    };
    let ((small, r), (large, big)) = (at(1e-6), at(1.0));
    let scale = big / r;
    for (a, b, power) in [
        (small.max_force_n, large.max_force_n, 2),
        (small.max_displacement_m, large.max_displacement_m, 1),
        (small.contact_time_s, large.contact_time_s, 1),
        (small.restitution, large.restitution, 0),
    ] {
        assert!(change(a * scale.powi(power), b) < 1e-9, "{a:e} {b:e}");
    }
}

#[test]
fn a_contact_of_many_vibration_periods_gives_all_energy_back() {
    let body = Body {
        tolerance: 0.05,
        ..Body::elastic(0.35, 1e-5)
    };
    let impact = body.simulated();
    let s = &impact.summary;
    let period =
        impactlaw::plan::fundamental_period(0.35) * body.radius / (MODULUS / DENSITY).sqrt();
    assert!(s.contact_time_s > 8.0 * period);
    assert!(s.restitution > 0.998, "{}", s.restitution);
    let (displacement, force) = body.hertz();
    assert!(change(s.max_displacement_m, displacement) < 0.05);
    assert!(change(s.max_force_n, force) < 0.05);
    assert!(s.energy_closure < 1e-3);
}

#[test]
fn fifty_times_the_strength_in_dynamic_pressure_spreads_into_a_sheet() {
    let body = Body::yielding(2560.0, 51.2);
    let impact = body.simulated();
    let s = &impact.summary;
    // flat to the tolerance, and the rim alone has lost its strength
    assert!(s.max_displacement_m > 0.97 * body.radius);
    assert_eq!(s.restitution, 0.0);
    assert!(s.eroded_volume_ratio < 0.2, "{}", s.eroded_volume_ratio);
    // the force of a drop of the same dynamic pressure is 0.85 rho V^2 D^2 at its peak (Gordillo, Sun and Cheng 2018)
    let drop = 0.85 * DENSITY * body.velocity.powi(2) * 4.0 * body.radius.powi(2);
    assert!(s.max_force_n > drop && s.max_force_n < 1.4 * drop);
}

#[test]
fn a_crushed_rim_is_found_by_the_time_step_although_another_mode_was_the_fastest_before() {
    // at a fifth of the speed of sound single cells are crushed to a quarter of their volume within some fifty steps
    let body = Body {
        poisson_ratio: 0.229,
        tolerance: 0.0116,
        ..Body::yielding(26.9, 1.25)
    };
    let s = body.simulated().summary;
    assert!((0.6..0.63).contains(&(s.max_displacement_m / body.radius)));
    assert!(s.eroded_volume_ratio < 0.01);
}

#[test]
fn a_surface_that_folds_over_leaves_no_material_below_the_wall() {
    for (ratio, severity, poisson_ratio) in [
        (40.0, 9.0, 0.3),
        (100.0, 9.0, 0.3),
        (400.0, 14.0, 0.0),
        (100.0, 15.0, 0.3),
    ] {
        let body = Body {
            poisson_ratio,
            tolerance: 0.1,
            ..Body::yielding(ratio, severity)
        };
        let (case, plan) = body.planned();
        let done = simulate(&case.material, case.radius, &plan);
        let s = &done.impact.summary;
        assert_eq!(s.status, Status::Ok);
        assert!(s.max_displacement_m < body.radius && s.max_force_n > 0.0);
        assert!((0.0..1.0).contains(&s.restitution) && s.energy_closure < 0.01);
        // more than 1 % of the body is eroded, and the figures say so
        assert!(s.eroded_volume_ratio > 0.01 && s.warnings[0].contains("lost its strength"));
        let cell = plan.grid.fine * body.radius;
        let inside = |p: &&MapPoint| p.part == Part::Inside;
        for map in [&done.compressed, &done.rebound] {
            for p in map.points.iter().filter(inside) {
                assert!(p.z_m > -0.05 * cell, "{} m below the wall", -p.z_m);
            }
        }
    }
}

#[test]
fn an_impact_too_slow_for_numbers_is_not_ok() {
    let body = Body::elastic(0.3, 1e-200);
    let refused = body.written("").unwrap_err().to_string();
    assert!(refused.contains("is rest"), "{refused}");
    let meant = "unusual = [\"impact.velocities\"]\n";
    let case = body.written(meant).unwrap();
    let plan = plan(&case, body.velocity);
    let s = simulate(&case.material, case.radius, &plan).impact.summary;
    assert!(matches!(s.status, Status::Failed(_)), "{:?}", s.status);
}

#[test]
fn a_second_impact_meets_a_flattened_particle() {
    let body = Body::yielding(80.0, 0.008);
    let (case, plan) = body.planned();
    let all = simulate_repeated(&case.material, case.radius, &plan, 2);
    let [first, second] = [&all[0].impact, &all[1].impact];
    check(&body, first);
    check(&body, second);
    let (a, b) = (&first.summary, &second.summary);
    assert!(b.restitution > a.restitution);
    assert!(b.max_force_n > a.max_force_n);
    assert!(b.max_displacement_m < a.max_displacement_m);
    assert!(b.plastic_work_ratio < a.plastic_work_ratio);
    assert!(b.equivalent_plastic_strain > a.equivalent_plastic_strain);
    // one impact alone is the first of two
    let alone = simulate(&case.material, case.radius, &plan).impact;
    assert_eq!(alone.curve, first.curve);
}

#[test]
fn an_elastic_particle_does_not_remember_its_first_impact() {
    let body = Body::elastic(0.35, 0.01);
    let (case, plan) = body.planned();
    let all = simulate_repeated(&case.material, case.radius, &plan, 2);
    let (a, b) = (&all[0].impact.summary, &all[1].impact.summary);
    // the shape at the end of the first still vibrates a little, and is held as it is
    assert!(change(a.max_force_n, b.max_force_n) < 0.02);
    assert!(change(a.max_displacement_m, b.max_displacement_m) < 0.02);
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let bodies = [
        Body::yielding(80.0, 0.01),
        Body::yielding(320.0, 0.3),
        Body::elastic(0.2, 0.02),
        Body::yielding(640.0, 1.5),
    ];
    let with = |threads: usize| -> Vec<Simulated> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let run = |body: &Body| {
            let (case, plan) = body.planned();
            simulate(&case.material, case.radius, &plan)
        };
        pool.install(|| bodies.par_iter().with_max_len(1).map(run).collect())
    };
    for (one, two) in with(1).into_iter().zip(with(2)) {
        assert_eq!(one.impact.curve, two.impact.curve);
        assert_eq!(one.compressed, two.compressed);
        assert_eq!(one.rebound, two.rebound);
    }
}
