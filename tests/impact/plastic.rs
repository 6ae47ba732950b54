//! Elastic-plastic impacts against independent finite elements, their own refinement, and exact similarity.

use impactlaw::case::Case;
use impactlaw::curve::{Impact, Status};
use impactlaw::impact::simulate;
use impactlaw::material::flow::LinearHardening;
use impactlaw::plan::plan;
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
    let case = case("thesis-4-4.toml");
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
