//! Impacts in three dimensions: against the axisymmetric solver, and the impulses and spin of friction.

use crate::maw_barber_fawcett::tangential_restitution;
use impactlaw::case::Case;
use impactlaw::curve::{Impact, Sample, Status};
use impactlaw::impact::simulate;
use impactlaw::plan::{Geometry, Plan, plan};
use std::path::Path;

/// An elastic impact at a fiftieth of the wave speed on a coarse grid.
fn oblique(degrees: f64, friction: f64) -> (Case, Plan) {
    elastic(0.3, 20.0, degrees, friction)
}

/// An elastic impact of a material with c0 = 1000 m/s on a coarse grid.
fn elastic(poisson: f64, velocity: f64, degrees: f64, friction: f64) -> (Case, Plan) {
    let text = format!(
        "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
         poisson_ratio = {poisson}\n[impact]\nvelocities = [\"{velocity} m/s\"]\nangle = \"{degrees} deg\"\n\
         [wall]\nfriction = {friction}\n[accuracy]\ntolerance = 0.1\n"
    );
    let case = Case::parse(&text, Path::new("oblique.toml")).unwrap();
    let mut plan = plan(&case, velocity);
    if plan.geometry != Geometry::Axisymmetric {
        plan.grid.fine = plan.estimate.contact_radius / 4.0;
        plan.grid.growth = 1.6;
        plan.grid.coarse = 0.25;
    }
    (case, plan)
}

fn run(case: &Case, plan: &Plan) -> Impact {
    let impact = simulate(&case.material, case.radius, plan).impact;
    assert_eq!(impact.summary.status, Status::Ok);
    assert!(impact.summary.energy_closure < 0.01);
    impact
}

fn change(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn a_normal_impact_in_three_dimensions_agrees_with_the_axisymmetric_one() {
    let (case, mut plan) = oblique(0.0, 0.0);
    plan.grid.growth = 1.4;
    plan.grid.coarse = 0.2;
    let flat = run(&case, &plan).summary;
    plan.geometry = Geometry::Quarter;
    let solid = run(&case, &plan).summary;
    assert!(change(solid.max_force_n, flat.max_force_n) < 0.015);
    assert!(change(solid.max_displacement_m, flat.max_displacement_m) < 0.01);
    assert!(change(solid.restitution, flat.restitution) < 0.005);
    assert!(change(solid.contact_time_s, flat.contact_time_s) < 0.01);
    assert_eq!(solid.tangential, None);
}

#[test]
fn full_sliding_gives_the_friction_impulse_and_the_spin_that_follows_from_it() {
    let (case, plan) = oblique(70.0, 0.2);
    assert_eq!(plan.geometry, Geometry::Half);
    let impact = run(&case, &plan);
    let s = &impact.summary;
    let t = s.tangential.unwrap();
    assert!(change(t.impulse_ratio, 0.2) < 0.004, "{}", t.impulse_ratio);
    let normal = 20.0 * 70f64.to_radians().cos() * (1.0 + s.restitution);
    let lost = t.incident_velocity_m_s - t.velocity_m_s;
    assert!(
        change(lost, t.impulse_ratio * normal) < 2e-3,
        "{lost} {normal}"
    );
    // the curve has the force along the wall: it slides, so it is mu F throughout
    let samples = &impact.curve.samples;
    let drag = |s: &Sample| s.tangential_force_n.unwrap();
    let most = samples.iter().fold(0.0, |m: f64, s| m.max(s.force_n));
    for s in samples.iter().filter(|s| s.force_n > 0.5 * most) {
        assert!((drag(s) / s.force_n - 0.2).abs() < 0.02, "{s:?}");
    }
    // the lever is shorter than R by the flattening; the lumped masses of these coarse cells alone turn 4 % too slowly
    let lever = t.angular_velocity_rad_s * case.radius / (2.5 * lost);
    assert!(
        lever < 1.0 && lever > 0.99 - s.max_displacement_m / case.radius,
        "{lever}"
    );
}

#[test]
fn full_sliding_gives_mu_whatever_the_cells_and_the_material() {
    // elastic on rigid with mu at once after F is ill-posed: 10 to 25 % of the impulse went missing here, more with smaller
    // cells
    for (poisson, friction, cells) in [(0.35, 0.5, 3.0), (0.45, 0.5, 4.5), (0.3, 1.0, 3.5)] {
        let angle = (7.0 * friction * 1.5f64).atan().to_degrees();
        let (case, mut plan) = elastic(poisson, 20.0, angle, friction);
        plan.grid.fine = plan.estimate.contact_radius / cells;
        let t = run(&case, &plan).summary.tangential.unwrap();
        assert!(
            change(t.impulse_ratio, friction) < 0.004,
            "nu {poisson}, a/{cells}: {} of {friction}",
            t.impulse_ratio
        );
    }
}

#[test]
fn tangential_restitution_over_the_angle_has_the_shape_of_maw_barber_and_fawcett() {
    // The theory is for contacts small against the sphere whose normal and tangential tractions do not couple. A sticking
    // impact gives back more here: its phase of some two pi feels every per cent of stiffness. At delta/R = 0.01 the excess
    // was 0.24, 0.31 and 0.41 for nu = 0.48, 0.35 and 0; it falls with the contact radius, to about 0.07, 0.14 and 0.24 in
    // the limit, as the coupling (1 - 2 nu)/(2 - 2 nu) of an elastic body on a rigid one does.
    let (nu, mu, velocity) = (0.42, 0.3, 2.0);
    let theory = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let speed = velocity / 1000.0;
        tangential_restitution(nu, mu, speed * cos, speed * sin)
    };
    let mut back = Vec::new();
    for degrees in [15.0, 42.0] {
        let (case, mut plan) = elastic(nu, velocity, degrees, mu);
        plan.grid.growth = 1.5;
        plan.grid.coarse = 0.16;
        let t = run(&case, &plan).summary.tangential.unwrap();
        let e = t.restitution.unwrap();
        let expected = theory(degrees);
        println!(
            "{degrees} deg: {e:.3}, theory {expected:.3}, impulse ratio {:.4}",
            t.impulse_ratio
        );
        assert!((-0.02..0.3).contains(&(e - expected)), "{e} {expected}");
        back.push(e);
    }
    // full sliding: e_t = 7 mu / tan(theta) - 1 for a restitution of 1, as its impulse is mu times the normal one above
    let sliding = 7.0 * mu / 72f64.to_radians().tan() - 1.0;
    assert!((theory(72.0) - sliding).abs() < 1e-3);
    // most is given back where the contact sticks for half of the time; beyond, sliding takes it
    assert!(back[1] > back[0] && back[1] > sliding, "{back:?} {sliding}");
}

#[test]
fn threads_do_not_change_a_bit_and_steep_impacts_stick() {
    let (case, plan) = oblique(20.0, 0.5);
    let in_pool = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| run(&case, &plan))
    };
    let (one, two) = (in_pool(1), in_pool(2));
    assert!(one.curve == two.curve && one.summary.tangential == two.summary.tangential);
    // Maw, Barber and Fawcett 1976: the contact point of a steep impact sticks and springs back
    let t = one.summary.tangential.unwrap();
    let back = t.restitution.unwrap();
    assert!(
        t.impulse_ratio < 0.45 && (0.3..0.8).contains(&back),
        "{t:?}"
    );
}

#[test]
fn a_yielding_sphere_in_three_dimensions_agrees_with_the_axisymmetric_one() {
    let text = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
                yield_strength = \"12.5 MPa\"\npoisson_ratio = 0.35\n[impact]\nvelocities = [\"25 m/s\"]\n\
                [accuracy]\ntolerance = 0.05\n";
    let case = Case::parse(text, Path::new("flat.toml")).unwrap();
    let flat = run(&case, &plan(&case, 25.0)).summary;
    let text = format!("{text}[wall]\nfriction = 1e-9\n");
    let case = Case::parse(&text, Path::new("solid.toml")).unwrap();
    let mut plan = plan(&case, 25.0);
    assert_eq!(plan.geometry, Geometry::Quarter);
    plan.grid.growth = 1.5;
    let solid = run(&case, &plan).summary;
    let errors = [
        change(solid.max_force_n, flat.max_force_n),
        change(solid.max_displacement_m, flat.max_displacement_m),
        change(solid.restitution, flat.restitution),
    ];
    // cells twice as large as those of the axisymmetric run
    assert!(
        errors[0] < 0.03 && errors[1] < 0.02 && errors[2] < 0.05,
        "{errors:?}"
    );
}

/// The fine cells cover the contact and the way it rolls: half of what a sphere that ends up rolling turns in the contact time,
/// here from Hertz's closed form (Johnson 1985, section 11.4: 2.87 (m^2/(R E*^2 V))^(1/5)) in SI units.
#[test]
fn grids_in_three_dimensions_are_as_wide_as_contact_and_way_in_any_units() {
    let plan_of = |radius: f64, modulus: f64, density: f64, friction: f64| {
        let velocity = 0.02 * (modulus / density).sqrt();
        let text = format!(
            "[particle]\nradius = \"{radius} m\"\n[material]\ndensity = \"{density} kg/m3\"\nyoung_modulus = \"{modulus} Pa\"\n\
             poisson_ratio = 0.3\n[impact]\nvelocities = [\"{velocity} m/s\"]\nangle = \"45 deg\"\n\
             [wall]\nfriction = {friction}\n[accuracy]\ntolerance = 0.1\n"
        );
        let case = Case::parse(&text, Path::new("oblique.toml")).unwrap();
        (plan(&case, velocity), velocity)
    };
    for (radius, modulus, density) in [
        (1e-3, 1e9, 1000.0),
        (250e-6, 100e9, 8000.0),
        (0.5, 70e9, 2700.0),
    ] {
        let (plan, velocity) = plan_of(radius, modulus, density, 0.3);
        assert_eq!(plan.geometry, Geometry::Half);
        let normal = velocity * 45f64.to_radians().cos();
        let mass = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * density;
        let stiffness = modulus / (1.0 - 0.09);
        let time = 2.87 * (mass * mass / (radius * stiffness * stiffness * normal)).powf(0.2);
        let rolled = 0.5 * (5.0 / 7.0) * velocity * 45f64.to_radians().sin() * time / radius;
        let width = 1.2 * plan.estimate.contact_radius + rolled;
        let off = change(plan.grid.fine_width, width);
        assert!(
            off < 0.003,
            "{radius} m: {} for {width}",
            plan.grid.fine_width
        );
        // the way is a good part of it, so that a wrong unit shows
        assert!(rolled > 0.15 * width, "{rolled} of {width}");
    }
}
