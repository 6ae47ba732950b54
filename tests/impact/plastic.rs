//! Elastic-plastic impacts against independent finite elements, their own refinement, and exact similarity.

use impactlaw::case::Case;
use impactlaw::curve::{Impact, Status};
use impactlaw::impact::simulate;
use impactlaw::material::flow::LinearHardening;
use impactlaw::plan::{fundamental_period, plan};
use serde::Deserialize;
use std::path::Path;

fn case(name: &str) -> Case {
    Case::read(&Path::new("cases").join(name)).unwrap()
}

fn run(case: &Case, velocity: f64) -> Impact {
    let impact = simulate(&case.material, case.radius, &plan(case, velocity)).impact;
    let s = &impact.summary;
    assert_eq!(s.status, Status::Ok);
    assert!(
        s.energy_closure < 1e-3,
        "energy closure {}",
        s.energy_closure
    );
    impact
}

fn change(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[derive(Deserialize)]
struct Reference {
    time_s: f64,
    displacement_m: f64,
    #[serde(rename = "force_N")]
    force_n: f64,
}

/// Independent finite-element impacts, see tests/data/reference/README.md: F*, delta* and e from its table.
struct Figures {
    velocity: f64,
    file: &'static str,
    force: f64,
    displacement: f64,
    centre_displacement: f64,
    restitution: f64,
    residual: f64,
    contact_time: f64,
    plastic_work: f64,
    compression: f64,
}

const FINITE_ELEMENTS: [Figures; 2] = [
    Figures {
        velocity: 10.0,
        file: "fe_impact_EY80_V10.csv",
        force: 14.72,
        displacement: 4.099e-6,
        centre_displacement: 4.113e-6,
        restitution: 0.6425,
        residual: 2.321e-6,
        contact_time: 1.030e-6,
        plastic_work: 0.5298,
        compression: 0.0047,
    },
    Figures {
        velocity: 50.0,
        file: "fe_impact_EY80_V50.csv",
        force: 76.4,
        displacement: 17.51e-6,
        centre_displacement: 17.95e-6,
        restitution: 0.3923,
        residual: 13.87e-6,
        contact_time: 0.809e-6,
        plastic_work: 0.791,
        compression: 0.0290,
    },
];

#[test]
fn force_displacement_and_restitution_agree_with_finite_elements_within_2_percent() {
    let case = case("thesis-4-4.toml");
    for fe in &FINITE_ELEMENTS {
        let s = run(&case, fe.velocity).summary;
        for (name, ours, theirs, tolerance) in [
            ("F*", s.max_force_n, fe.force, 0.02),
            ("delta*", s.max_displacement_m, fe.displacement, 0.02),
            (
                "delta* of the centre",
                s.max_centre_displacement_m,
                fe.centre_displacement,
                0.02,
            ),
            ("e", s.restitution, fe.restitution, 0.02),
            ("delta_res", s.residual_displacement_m, fe.residual, 0.02),
            ("contact time", s.contact_time_s, fe.contact_time, 0.02),
            ("W_p/W_i", s.plastic_work_ratio, fe.plastic_work, 0.02),
            ("1 - H_d/D", s.compression_ratio, fe.compression, 0.02),
        ] {
            assert!(
                change(ours, theirs) < tolerance,
                "{name} at {} m/s: {ours} against {theirs}",
                fe.velocity
            );
        }
    }
}

#[test]
fn force_displacement_curves_lie_within_3_percent_rms_of_finite_elements() {
    let case = case("thesis-4-4.toml");
    for fe in &FINITE_ELEMENTS {
        let impact = run(&case, fe.velocity);
        let path = Path::new("tests/data/reference").join(fe.file);
        let rows: Vec<Reference> = csv::Reader::from_path(path)
            .unwrap()
            .deserialize()
            .collect::<Result<_, _>>()
            .unwrap();
        let samples = &impact.curve.samples;
        let turn = impact.curve.turning_point();
        let top = rows
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.displacement_m.total_cmp(&b.1.displacement_m));
        let top = top.unwrap().0;
        // force at equal displacement, loading and unloading branch apart
        let ours = |delta: f64, loading: bool| {
            let branch = if loading {
                &samples[..=turn]
            } else {
                &samples[turn..]
            };
            branch
                .windows(2)
                .find(|w| (w[0].displacement_m - delta) * (w[1].displacement_m - delta) <= 0.0)
                .map(|w| {
                    let s =
                        (delta - w[0].displacement_m) / (w[1].displacement_m - w[0].displacement_m);
                    w[0].force_n + s * (w[1].force_n - w[0].force_n)
                })
        };
        let (mut sum, mut count) = (0.0, 0);
        for (k, row) in rows
            .iter()
            .enumerate()
            .filter(|(_, r)| r.time_s < fe.contact_time)
        {
            if let Some(force) = ours(row.displacement_m, k <= top) {
                sum += (force - row.force_n).powi(2);
                count += 1;
            }
        }
        assert!(count > 100);
        let rms = (sum / f64::from(count)).sqrt() / fe.force;
        assert!(rms < 0.03, "RMS {rms} of F* at {} m/s", fe.velocity);
    }
}

#[test]
fn own_refinement_changes_less_than_the_tolerance() {
    for (name, velocity) in [("thesis-4-4.toml", 50.0), ("solder-ball.toml", 20.0)] {
        let case = case(name);
        let mut finer = plan(&case, velocity);
        finer.grid.fine *= 0.5;
        let a = run(&case, velocity).summary;
        let b = simulate(&case.material, case.radius, &finer).impact.summary;
        assert!(
            change(a.max_force_n, b.max_force_n) < case.tolerance,
            "F* {} {}",
            a.max_force_n,
            b.max_force_n
        );
        assert!(change(a.max_displacement_m, b.max_displacement_m) < case.tolerance);
        assert!(
            change(a.restitution, b.restitution) < case.tolerance,
            "e {} {}",
            a.restitution,
            b.restitution
        );
    }
}

#[test]
fn equal_dimensionless_groups_are_the_same_run() {
    let text = |radius: &str, density: f64, modulus: f64, strength: f64, velocity: f64| {
        format!(
            "[particle]\nradius = \"{radius}\"\n[material]\ndensity = \"{density} kg/m3\"\nyoung_modulus = \"{modulus} GPa\"\n\
             poisson_ratio = 0.3\nyield_strength = \"{strength} MPa\"\n[impact]\nvelocities = [\"{velocity} m/s\"]\n\
             [accuracy]\ntolerance = 0.1\n"
        )
    };
    let read = |t: String| Case::parse(&t, Path::new("group.toml")).unwrap();
    let a = read(text("1 mm", 2000.0, 50.0, 250.0, 16.0));
    let b = read(text("4 mm", 8000.0, 50.0, 250.0, 8.0));
    let (x, y) = (run(&a, 16.0).summary, run(&b, 8.0).summary);
    assert_eq!(x.steps, y.steps);
    assert!(change(x.restitution, y.restitution) < 1e-9);
    assert!(change(x.max_force_n * 16.0, y.max_force_n) < 1e-9);
    assert!(change(x.max_displacement_m * 4.0, y.max_displacement_m) < 1e-9);
}

#[test]
fn hardening_stiffens_and_returns_more_energy() {
    let mut soft = case("thesis-4-4.toml");
    soft.tolerance = 0.08;
    let mut hard = soft.clone();
    let strength = soft.material.flow.unwrap().yield_strength();
    let modulus = 10e9;
    hard.material.flow = Some(LinearHardening { strength, modulus }.into());
    let (s, h) = (run(&soft, 30.0).summary, run(&hard, 30.0).summary);
    assert!(h.max_force_n > 1.05 * s.max_force_n);
    assert!(h.max_displacement_m < 0.98 * s.max_displacement_m);
    assert!(h.restitution > 1.05 * s.restitution);
}

#[test]
fn hardening_laws_give_the_same_impact_where_they_are_the_same_law() {
    let harder = |constants: &str| {
        let text = format!(
            "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
             poisson_ratio = 0.35\nyield_strength = \"5 MPa\"\n{constants}\n\
             [impact]\nvelocities = [\"10 m/s\"]\n[accuracy]\ntolerance = 0.1\n"
        );
        run(&Case::parse(&text, Path::new("harder.toml")).unwrap(), 10.0).summary
    };
    let figures =
        |s: &impactlaw::curve::Summary| [s.max_force_n, s.max_displacement_m, s.restitution];
    let linear = harder("hardening_modulus = \"20 MPa\"");
    let power = harder("hardening_coefficient = \"20 MPa\"\nhardening_exponent = 1.0");
    let voce = harder("saturation_stress = \"500 MPa\"\nsaturation_exponent = 0.04");
    for (name, other, within) in [("power", &power, 1e-6), ("voce", &voce, 2e-3)] {
        for (a, b) in figures(&linear).into_iter().zip(figures(other)) {
            assert!(change(a, b) < within, "{name}: {a} {b}");
        }
    }
    // n of a metal: stiff at once, soft later
    let metal = harder("hardening_coefficient = \"20 MPa\"\nhardening_exponent = 0.3");
    let perfect = harder("");
    assert!(metal.max_force_n > 1.2 * perfect.max_force_n, "{metal:?}");
    assert!(metal.max_displacement_m < perfect.max_displacement_m);
    // saturated: Voce's metal with a short way to saturation is perfectly plastic at Y + Q
    let saturated = harder("saturation_stress = \"5 MPa\"\nsaturation_exponent = 1e5");
    let strong = {
        let text = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
                    poisson_ratio = 0.35\nyield_strength = \"10 MPa\"\n[impact]\nvelocities = [\"10 m/s\"]\n\
                    [accuracy]\ntolerance = 0.1\n";
        run(&Case::parse(text, Path::new("strong.toml")).unwrap(), 10.0).summary
    };
    for (a, b) in figures(&saturated).into_iter().zip(figures(&strong)) {
        assert!(change(a, b) < 0.02, "saturated: {a} {b}");
    }
}

#[test]
fn thread_count_does_not_change_a_bit() {
    let mut case = case("thesis-4-4.toml");
    case.tolerance = 0.1;
    let in_pool = |threads: usize| {
        use rayon::prelude::*;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            [20.0, 30.0, 40.0, 50.0]
                .par_iter()
                .map(|v| {
                    simulate(&case.material, case.radius, &plan(&case, *v))
                        .impact
                        .curve
                })
                .collect::<Vec<_>>()
        })
    };
    assert!(in_pool(1) == in_pool(2));
}

#[test]
fn restitution_falls_smoothly_with_the_speed_from_below_the_yield_speed_on() {
    let mut case = case("thesis-4-4.toml");
    case.tolerance = 0.05;
    let limit = (case.material)
        .yield_point(case.radius, impactlaw::material::YIELD_PRESSURE_RATIO)
        .unwrap()
        .velocity;
    let e: Vec<f64> = (-1..14)
        .map(|k| {
            run(&case, 1.01 * limit * 1.25f64.powi(k))
                .summary
                .restitution
        })
        .collect();
    assert!(e[0] > 0.995 && e[14] < 0.8, "{e:?}");
    for three in e.windows(3) {
        assert!(three[1] < three[0] + 1e-3, "{e:?}");
        let bend = three[0] - 2.0 * three[1] + three[2];
        assert!(bend.abs() < 0.01, "{bend} in {e:?}");
    }
}

/// A millimetre sphere, perfectly plastic or with hardening modulus H; stresses in Pa.
fn sphere(young_modulus: f64, strength: f64, hardening: f64, nu: f64, severity: f64) -> Case {
    let velocity = (severity * strength / 8000.0).sqrt();
    let text = format!(
        "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"{young_modulus} Pa\"\n\
         poisson_ratio = {nu}\nyield_strength = \"{strength} Pa\"\nhardening_modulus = \"{hardening} Pa\"\n\
         [impact]\nvelocities = [\"{velocity} m/s\"]\n[accuracy]\ntolerance = 0.05\n"
    );
    Case::parse(&text, Path::new("sphere.toml")).unwrap()
}

#[test]
fn perfectly_plastic_work_is_the_yield_strength_times_the_mean_plastic_strain() {
    // the strain is the one that the Kirchhoff stress does its work on, averaged over the reference volume:
    // eps_p = rho V^2/(2 Y) W_p/W_i at every E/Y, where the length of the return is off by 0.93 Y/E
    for ratio in [20.0, 80.0, 1000.0] {
        let case = sphere(100e9, 100e9 / ratio, 0.0, 0.35, 0.02);
        let s = run(&case, case.velocities[0]).summary;
        let expected = 0.5 * 0.02 * s.plastic_work_ratio;
        assert!(
            change(s.equivalent_plastic_strain, expected) < 1e-3,
            "E/Y {ratio}: {} instead of {expected}",
            s.equivalent_plastic_strain
        );
    }
}

/// One row of tests/data/reference/fe_quasistatic_hardening.csv.
#[derive(Deserialize)]
struct Pressed {
    #[serde(rename = "E_GPa")]
    young_modulus: f64,
    nu: f64,
    #[serde(rename = "Y_MPa")]
    strength: f64,
    #[serde(rename = "H_MPa")]
    hardening: f64,
    #[serde(rename = "delta_over_R")]
    delta_over_r: f64,
    #[serde(rename = "F_N")]
    force: f64,
}

#[test]
fn hardening_spheres_resist_a_slow_impact_as_finite_elements_say_within_5_percent() {
    let path = "tests/data/reference/fe_quasistatic_hardening.csv";
    let rows: Vec<Pressed> = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap()
        .into_deserialize()
        .map(Result::unwrap)
        .collect();
    for set in rows.chunk_by(|a, b| a.strength == b.strength) {
        for size in [0.011, 0.02, 0.03, 0.05] {
            let (displacement, force) = pressed_to(&set[0], size);
            // between two rows the force is a power of the displacement
            let k = set.partition_point(|p| p.delta_over_r < displacement);
            let (a, b) = (&set[k - 1], &set[k.min(set.len() - 1)]);
            let (a, b) = if k < set.len() {
                (a, b)
            } else {
                (&set[k - 2], a)
            };
            let power = (b.force / a.force).ln() / (b.delta_over_r / a.delta_over_r).ln();
            let expected = a.force * (displacement / a.delta_over_r).powf(power);
            println!(
                "Y {} MPa, delta/R {displacement:.4}: {force:.1} N, finite elements {expected:.1} N, {:+.1} %",
                set[0].strength,
                100.0 * (force / expected - 1.0)
            );
            assert!(change(force, expected) < 0.05);
        }
    }
}

/// Largest displacement of the centre (as the equator's plane; over R) of an impact meant to reach `size`, and the force there:
/// at rest no inertia adds to it, and what the body rings with is averaged out over half a period.
fn pressed_to(p: &Pressed, size: f64) -> (f64, f64) {
    let (strength, hardening) = (1e6 * p.strength, 1e6 * p.hardening);
    // rho V^2/Y goes with the square of the displacement
    let severity = 0.0195 * (size / 0.055f64).powi(2);
    let modulus = 1e9 * p.young_modulus;
    let case = sphere(modulus, strength, hardening, p.nu, severity);
    let samples = run(&case, case.velocities[0]).curve.samples;
    let period = fundamental_period(p.nu) * case.radius / (modulus / 8000.0).sqrt();
    let most = samples
        .iter()
        .max_by(|a, b| (a.centre_displacement_m).total_cmp(&b.centre_displacement_m))
        .unwrap();
    let near: Vec<_> = samples
        .iter()
        .filter(|s| (s.time_s - most.time_s).abs() <= 0.25 * period)
        .collect();
    let force = near.iter().map(|s| s.force_n).sum::<f64>() / near.len() as f64;
    (most.centre_displacement_m / case.radius, force)
}

#[test]
fn heavy_small_cells_change_a_slow_impact_by_less_than_a_tenth_of_the_tolerance() {
    // a third above the yield speed at E/Y 250: V/c0 is 5e-6, and the contact radius 0.008 R
    let mut case = sphere(100e9, 0.4e9, 0.0, 0.35, 7e-9);
    case.tolerance = 0.1;
    let heavy = plan(&case, case.velocities[0]);
    assert!(heavy.plastic && heavy.grid.scaled > 2.0 * heavy.grid.fine);
    assert!(heavy.grid.added_mass() <= 0.05 * heavy.tolerance);
    let mut plain = heavy.clone();
    plain.grid.scaled = 0.0;
    let run = |plan| simulate(&case.material, case.radius, plan).impact.summary;
    let (a, b) = (run(&heavy), run(&plain));
    assert!((&a.status, &b.status) == (&Status::Ok, &Status::Ok));
    assert!(2 * a.steps < b.steps, "{} {}", a.steps, b.steps);
    let off = [
        change(a.max_force_n, b.max_force_n),
        change(a.max_displacement_m, b.max_displacement_m),
        change(a.contact_time_s, b.contact_time_s),
        (a.restitution - b.restitution).abs(),
    ];
    println!("heavy cells change F*, delta*, contact time and e by {off:.5?}");
    assert!(
        off.iter().all(|off| *off < 0.1 * heavy.tolerance),
        "{off:?}"
    );
}
