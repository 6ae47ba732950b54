//! Elastic impacts against closed forms: restitution, the Hertz limit, convergence in cell size and time step.

use impactlaw::case::Case;
use impactlaw::curve::{Impact, MapPoint, Part, Status};
use impactlaw::impact::simulate;
use impactlaw::material::Material;
use impactlaw::plan::{Plan, plan};
use std::path::Path;

const RADIUS: f64 = 250e-6;

fn elastic() -> Material {
    Material {
        density: 8000.0,
        young_modulus: 100e9,
        poisson_ratio: 0.35,
        flow: None,
    }
}

/// Wave speed $\sqrt{E/\rho}$.
fn bar_speed() -> f64 {
    (elastic().young_modulus / elastic().density).sqrt()
}

fn planned(velocity: f64, tolerance: f64) -> Plan {
    let text = format!(
        "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"100 GPa\"\n\
         poisson_ratio = 0.35\n[impact]\nvelocities = [\"{velocity} m/s\"]\n[accuracy]\ntolerance = {tolerance}\n"
    );
    let case = Case::parse(&text, Path::new("elastic.toml")).unwrap();
    plan(&case, velocity)
}

fn run(plan: &Plan) -> Impact {
    let impact = simulate(&elastic(), RADIUS, plan).impact;
    assert_eq!(impact.summary.status, Status::Ok);
    assert!(
        impact.summary.energy_closure < 1e-3,
        "energy closure {}",
        impact.summary.energy_closure
    );
    impact
}

/// Hertz: F* and delta* (Johnson 1985, section 11.4).
fn hertz(velocity: f64) -> (f64, f64) {
    let e_star = elastic().contact_modulus();
    let mass = elastic().sphere_mass(RADIUS);
    let delta = (15.0 * mass * velocity * velocity / (16.0 * e_star * RADIUS.sqrt())).powf(0.4);
    (4.0 / 3.0 * e_star * RADIUS.sqrt() * delta.powf(1.5), delta)
}

fn change(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn the_pressure_below_an_elastic_contact_is_hertz_s() {
    // slow, for the sphere is no half-space: at a hundred times the speed the pressure is 5 % higher. A cell has one pressure, its
    // mean: from its middle to its edge Hertz's changes by 3 %.
    let plan = planned(1e-4 * bar_speed(), 0.01);
    let done = simulate(&elastic(), RADIUS, &plan);
    let force = done.impact.summary.max_force_n;
    let radius = (0.75 * force * RADIUS / elastic().contact_modulus()).cbrt();
    let peak = 1.5 * force / (std::f64::consts::PI * radius * radius);
    // on the axis, from Johnson 1985, equation 3.45: the three stresses add up to -2 (1 + nu) p_0 (1 - z/a atan(a/z))
    let near =
        |p: &&MapPoint| p.part == Part::Inside && p.r_m < 0.15 * radius && p.z_m < 2.0 * radius;
    let below: Vec<&MapPoint> = done.compressed.points.iter().filter(near).collect();
    assert!(below.len() > 20, "{}", below.len());
    for point in below {
        let depth = point.z_m / radius;
        let hertz = 2.0 / 3.0 * 1.35 * peak * (1.0 - depth * (1.0 / depth).atan());
        assert!(
            (point.pressure_pa - hertz).abs() < 0.05 * peak,
            "{} Pa, Hertz {hertz} at {depth} a",
            point.pressure_pa
        );
        assert_eq!(point.temperature_k, None);
    }
}

#[test]
fn slow_elastic_sphere_returns_with_restitution_above_0_999() {
    let velocity = 0.003 * bar_speed();
    let s = run(&planned(velocity, 0.02)).summary;
    assert!(
        s.restitution >= 0.999 && s.restitution <= 1.0,
        "e = {}",
        s.restitution
    );
    assert_eq!(s.plastic_work_ratio, 0.0);
    assert!(s.residual_displacement_m.abs() < 0.02 * s.max_displacement_m);
}

#[test]
fn halving_cells_changes_less_than_one_percent_and_halving_the_step_less_than_0_2() {
    let coarse = planned(0.003 * bar_speed(), 0.05);
    let mut fine = coarse.clone();
    fine.grid.fine *= 0.5;
    let mut short = coarse.clone();
    short.grid.dt_share *= 0.5;
    let (a, b, c) = (
        run(&coarse).summary,
        run(&fine).summary,
        run(&short).summary,
    );
    assert!(c.steps as f64 > 1.9 * a.steps as f64 && b.steps as f64 > 1.8 * a.steps as f64);
    for (name, x, y, z) in [
        ("F*", a.max_force_n, b.max_force_n, c.max_force_n),
        (
            "delta*",
            a.max_displacement_m,
            b.max_displacement_m,
            c.max_displacement_m,
        ),
        ("e", a.restitution, b.restitution, c.restitution),
        (
            "contact time",
            a.contact_time_s,
            b.contact_time_s,
            c.contact_time_s,
        ),
    ] {
        assert!(change(x, y) < 0.01, "{name}: {x} with h, {y} with h/2");
        assert!(change(x, z) < 0.002, "{name}: {x} with dt, {z} with dt/2");
    }
}

/// F* and delta* differ from Hertz by a term proportional to $\sqrt{\delta/R}$: Hertz's bodies are half-spaces of small strain,
/// the sphere is finite and strains by a/R. The linear problem (a sphere under the pressure of its contact and its own
/// uniform deceleration, solved by Legendre series with the solutions of Lur'e 1964) has
/// F = F_Hertz (1 + 0.92 sqrt(delta/R)) at delta/R = 1e-3 and nu = 0.35; finite strain lowers the coefficient.
/// Two speeds separate the term from the limit.
#[test]
fn force_and_displacement_tend_to_hertz_as_the_speed_vanishes() {
    let ratios = |velocity: f64| {
        // at a tolerance that tells the slower one from Hertz's impact
        let plan = planned(velocity, 0.02);
        assert!(!plan.similarity().is_on());
        let s = run(&plan).summary;
        let (force, delta) = hertz(velocity);
        let root = (s.max_displacement_m / RADIUS).sqrt();
        (root, s.max_force_n / force, s.max_displacement_m / delta)
    };
    let (fast, slow) = (ratios(1.8), ratios(0.34));
    assert!(slow.0.powi(2) < 1.0e-3, "delta/R = {}", slow.0.powi(2));
    let limit = |a: f64, b: f64| b - slow.0 * (a - b) / (fast.0 - slow.0);
    let (force, delta) = (limit(fast.1, slow.1), limit(fast.2, slow.2));
    assert!(
        change(force, 1.0) < 0.003,
        "F* -> {force} of Hertz; {fast:?} {slow:?}"
    );
    assert!(
        change(delta, 1.0) < 0.003,
        "delta* -> {delta} of Hertz; {fast:?} {slow:?}"
    );
    assert!(
        change(slow.2, 1.0) < 0.01,
        "delta* at delta/R = 1e-3: {}",
        slow.2
    );
    // one coefficient c in F = F_Hertz (1 + c sqrt(delta/R)) explains both deviations: +c/2 in F*, -c/3 in delta*
    let from_force = 2.0 * (slow.1 - 1.0) / slow.0;
    let from_delta = -3.0 * (slow.2 - 1.0) / slow.0;
    assert!(
        change(from_force, from_delta) < 0.1,
        "c = {from_force} and {from_delta}"
    );
    assert!((0.6..0.9).contains(&from_force), "c = {from_force}");
}

#[test]
fn wall_force_is_mass_times_acceleration_of_the_centre_of_mass() {
    let velocity = 0.003 * bar_speed();
    let impact = run(&planned(velocity, 0.05));
    let mass = elastic().sphere_mass(RADIUS);
    let samples = &impact.curve.samples;
    let impulse: f64 = samples
        .windows(2)
        .map(|w| 0.5 * (w[0].force_n + w[1].force_n) * (w[1].time_s - w[0].time_s))
        .sum();
    let exchanged = mass * velocity * (1.0 + impact.summary.restitution);
    assert!(
        change(impulse, exchanged) < 2e-3,
        "{impulse} against {exchanged}"
    );
    for w in samples.windows(21).step_by(20) {
        let (a, m, b) = (&w[0], &w[10], &w[20]);
        let (before, after) = (m.time_s - a.time_s, b.time_s - m.time_s);
        let (slow, fast) = (
            (m.displacement_m - a.displacement_m) / before,
            (b.displacement_m - m.displacement_m) / after,
        );
        let acceleration = 2.0 * (fast - slow) / (before + after);
        // a second difference is the acceleration averaged with triangular weights
        let weight = |k: usize| 1.0 - (k as f64 - 10.0).abs() / 10.0;
        let mean: f64 = w
            .iter()
            .enumerate()
            .map(|(k, s)| 0.1 * weight(k) * s.force_n)
            .sum();
        let error = (mean + mass * acceleration).abs() / impact.summary.max_force_n;
        assert!(error < 0.01, "{error} at {} s", m.time_s);
    }
}

#[test]
fn a_tenth_of_a_millimetre_a_second_is_hertz_s_impact_and_takes_seconds() {
    // V/c0 = 2.8e-8: at this speed itself a run takes twelve minutes and keeps no account of its energy
    let velocity = 1e-4;
    let plan = planned(velocity, 0.05);
    assert!(plan.similarity().is_on() && plan.seconds < 10.0, "{plan:?}");
    let impact = run(&plan);
    let s = &impact.summary;
    let (force, delta) = hertz(velocity);
    // contact time of Hertz's impact (Johnson 1985, equation 11.24)
    let time = 2.9432 * delta / velocity;
    let off = [
        s.max_force_n / force,
        s.max_displacement_m / delta,
        s.contact_time_s / time,
    ]
    .map(|ratio| ratio - 1.0);
    println!(
        "F*, delta* and contact time over Hertz's: {off:.4?}, {} s",
        s.wall_s
    );
    assert!(
        off.iter().all(|off| off.abs() < 0.5 * plan.tolerance),
        "{off:?}"
    );
    assert!(s.restitution > 0.999 && s.restitution <= 1.0);
    // the curve is of the same impact: its impulse turns the momentum
    let samples = &impact.curve.samples;
    let impulse: f64 = samples
        .windows(2)
        .map(|p| 0.5 * (p[0].force_n + p[1].force_n) * (p[1].time_s - p[0].time_s))
        .sum();
    let turned = elastic().sphere_mass(RADIUS) * velocity * (1.0 + s.restitution);
    assert!(change(impulse, turned) < 0.01, "{impulse:e} {turned:e}");
}
