//! Impacts as data: the sphere of the reference impacts (E/Y = 80), its case, and the figures and curves of an impact.

use impactlaw::case::Case;
use impactlaw::curve::{Curve, Impact, Sample, Status, Summary};
use impactlaw::material::{Flow, Material};
use impactlaw::shape::Shape;
use std::path::Path;

/// Radius, m.
pub const RADIUS: f64 = 250e-6;

pub const MATERIAL: Material = Material {
    density: 8000.0,
    young_modulus: 100e9,
    poisson_ratio: 0.35,
    flow: Some(Flow::perfectly_plastic(1.25e9)),
};

/// The same without yield.
pub const ELASTIC: Material = Material {
    flow: None,
    ..MATERIAL
};

/// The same with another yield strength, Pa.
pub fn yielding_at(yield_strength: f64) -> Material {
    Material {
        flow: Some(Flow::perfectly_plastic(yield_strength)),
        ..MATERIAL
    }
}

pub fn case(material: Material, velocities: &[f64]) -> Case {
    Case {
        name: "impacts".into(),
        path: "impacts.toml".into(),
        hash: "0".repeat(64),
        shape: Shape::Sphere,
        radius: RADIUS,
        material,
        velocities: velocities.to_vec(),
        tolerance: 0.02,
        angle: 0.0,
        friction: 0.0,
        adhesion: None,
        method: None,
        bed: None,
    }
}

/// Largest force (N) and displacement (m), restitution, residual displacement (m) and contact time (s) of an impact.
pub fn summary(velocity: f64, figures: [f64; 5]) -> Summary {
    let [
        max_force_n,
        max_displacement_m,
        restitution,
        residual_displacement_m,
        contact_time_s,
    ] = figures;
    Summary {
        velocity_m_s: velocity,
        restitution,
        max_force_n,
        max_displacement_m,
        max_centre_displacement_m: max_displacement_m,
        residual_displacement_m,
        contact_time_s,
        compression_ratio: 0.0,
        height_at_max_compression_ratio: 1.0,
        equivalent_plastic_strain: 0.0,
        plastic_work_ratio: 0.0,
        energy_closure: 0.0,
        shock_work_ratio: 0.0,
        eroded_volume_ratio: 0.0,
        warnings: Vec::new(),
        points: 0,
        steps: 0,
        wall_s: 0.0,
        adhesion: None,
        cylinder: None,
        target: None,
        scheme: None,
        heating: None,
        tangential: None,
        particle: None,
        status: Status::Ok,
    }
}

pub fn sample(time_s: f64, displacement_m: f64, force_n: f64) -> Sample {
    Sample {
        time_s,
        displacement_m,
        centre_displacement_m: displacement_m,
        force_n,
        tangential_force_n: None,
        target_displacement_m: None,
        surface_j: None,
        contact_radius_m: 0.0,
        kinetic_j: 0.0,
        elastic_j: 0.0,
        plastic_j: 0.0,
    }
}

/// One row of a reference file.
#[derive(serde::Deserialize)]
struct Row {
    time_s: f64,
    displacement_m: f64,
    centre_displacement_m: f64,
    #[serde(rename = "force_N")]
    force: f64,
}

/// A finite-element impact of `tests/data/reference`; `figures` from the table in its README (centre of mass).
fn reference(velocity: f64, figures: [f64; 5]) -> Impact {
    let name = format!("tests/data/reference/fe_impact_EY80_V{velocity}.csv");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let rows = csv::Reader::from_path(path).unwrap().into_deserialize();
    let sample = |row: Row| Sample {
        centre_displacement_m: row.centre_displacement_m,
        ..sample(row.time_s, row.displacement_m, row.force)
    };
    Impact {
        summary: summary(velocity, figures),
        curve: Curve {
            samples: rows.map(|row| sample(row.unwrap())).collect(),
        },
    }
}

/// The finite-element impacts at 10 and 50 m/s.
pub fn references() -> [Impact; 2] {
    [
        reference(10.0, [14.72, 4.099e-6, 0.6425, 2.321e-6, 1.030e-6]),
        reference(50.0, [76.4, 17.51e-6, 0.3923, 13.87e-6, 0.809e-6]),
    ]
}
