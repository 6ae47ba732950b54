//! Fit to independent finite-element impacts (`tests/data/reference/README.md`): F*, delta*, e within 3 %.

use impactlaw::case::Case;
use impactlaw::contact::NormalLaw;
use impactlaw::curve::{Curve, Impact, Sample, Status, Summary};
use impactlaw::fit::{Fit, Outcome, fit};
use impactlaw::material::{Flow, Material};
use std::path::Path;

const RADIUS: f64 = 250e-6;

fn case(velocities: &[f64]) -> Case {
    Case {
        name: "reference".into(),
        path: "reference.toml".into(),
        hash: String::new(),
        radius: RADIUS,
        material: Material {
            density: 8000.0,
            young_modulus: 100e9,
            poisson_ratio: 0.35,
            flow: Some(Flow {
                yield_strength: 1.25e9,
                hardening_modulus: 0.0,
            }),
        },
        velocities: velocities.to_vec(),
        tolerance: 0.02,
        angle: 0.0,
        friction: 0.0,
        bed: None,
    }
}

/// One row of the reference's time series.
#[derive(serde::Deserialize)]
struct Row {
    time_s: f64,
    displacement_m: f64,
    centre_displacement_m: f64,
    #[serde(rename = "force_N")]
    force: f64,
}

/// A reference impact; figures from the table in its README (centre of mass).
fn impact(velocity: f64, f: f64, delta: f64, e: f64, residual: f64, time: f64) -> Impact {
    let name = format!("tests/data/reference/fe_impact_EY80_V{velocity}.csv");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let rows = csv::Reader::from_path(path)
        .unwrap()
        .into_deserialize::<Row>();
    let sample = |row: Row| Sample {
        time_s: row.time_s,
        displacement_m: row.displacement_m,
        centre_displacement_m: row.centre_displacement_m,
        force_n: row.force,
        contact_radius_m: 0.0,
        kinetic_j: 0.0,
        elastic_j: 0.0,
        plastic_j: 0.0,
    };
    Impact {
        summary: Summary {
            velocity_m_s: velocity,
            restitution: e,
            max_force_n: f,
            max_displacement_m: delta,
            max_centre_displacement_m: delta,
            residual_displacement_m: residual,
            contact_time_s: time,
            compression_ratio: 0.0,
            height_at_max_compression_ratio: 0.0,
            equivalent_plastic_strain: 0.0,
            plastic_work_ratio: 0.0,
            energy_closure: 0.0,
            eroded_volume_ratio: 0.0,
            points: 0,
            steps: 0,
            wall_s: 0.0,
            tangential: None,
            status: Status::Ok,
        },
        curve: Curve {
            samples: rows.map(|r| sample(r.unwrap())).collect(),
        },
    }
}

fn slow() -> Impact {
    impact(10.0, 14.72, 4.099e-6, 0.6425, 2.321e-6, 1.030e-6)
}

fn fast() -> Impact {
    impact(50.0, 76.4, 17.51e-6, 0.3923, 13.87e-6, 0.809e-6)
}

fn print(fit: &Fit) {
    let Outcome::Yielding {
        closed_form,
        spline,
    } = &fit.outcome
    else {
        panic!("the reference yields");
    };
    println!(
        "{:?}\n{:?}",
        closed_form.law.loading(),
        closed_form.law.unloading()
    );
    println!(
        "{:?}\n{:?}",
        spline.law.loading().knots(),
        spline.law.unloading()
    );
    println!(
        "{:?}\n{:?}",
        closed_form.law.inertia(),
        spline.law.inertia()
    );
    for q in closed_form.quality.iter().chain(&spline.quality) {
        println!("{q:.4?}");
    }
    println!("{:.3?}\n{:.3?}", closed_form.intervals, spline.intervals);
    println!("{:.3?}\n{:.3?}", closed_form.left_out, spline.left_out);
}

#[test]
fn both_forms_return_the_figures_within_three_per_cent() {
    let fit = fit(&case(&[10.0, 50.0]), &[slow(), fast()]).unwrap();
    print(&fit);
    let Outcome::Yielding {
        closed_form,
        spline,
    } = &fit.outcome
    else {
        panic!("the reference yields");
    };
    for q in closed_form.quality.iter().chain(&spline.quality) {
        assert!(q.worst() < 0.01, "{q:?}");
        assert!(q.loading_force < 0.03 && q.unloading_force < 0.03, "{q:?}");
    }
}

#[test]
fn one_speed_has_neither_intervals_nor_left_out_errors() {
    let fit = fit(&case(&[50.0]), &[fast()]).unwrap();
    let Outcome::Yielding { closed_form, .. } = &fit.outcome else {
        panic!("the reference yields");
    };
    assert!(closed_form.quality[0].worst() < 0.03);
    assert!(closed_form.intervals.is_none() && closed_form.left_out.is_empty());
}
