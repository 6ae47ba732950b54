//! Cylinder that meets the wall with its end: what to expect of it, its grid, and when it yields.

use super::{Estimate, Grid, Remedies};
use crate::material::Material;
use crate::material::flow::Past;

/// Cells a radius for a tolerance of 2 %.
const CELLS: f64 = 16.0;
/// Height over the length up to which cells stay fine.
const FINE: f64 = 0.25;

/// Speed at which the stress $\rho c_0 V$ of a bar that meets a wall is its yield strength, m/s; `None` for an elastic one.
pub(super) fn yield_speed(material: &Material) -> Option<f64> {
    let impedance = (material.density * material.young_modulus).sqrt();
    material.flow.map(|flow| flow.yield_strength() / impedance)
}

/// Size of an impact of a cylinder of `length` (in R), run units but for `velocity` (m/s) and `radius` (m).
///
/// An elastic bar is in contact while a wave comes back from its end. A rigid-plastic one of strength $\sigma$ ends with the length
/// $L\ e^{-\rho V^2 / 2 \sigma}$ (Taylor 1948), here at the strength of a mean strain of a half of that, at the rate $V/L$; its rear
/// end is slowed down evenly.
pub(super) fn estimate(material: &Material, velocity: f64, length: f64, radius: f64) -> Estimate {
    let speed = velocity / (material.young_modulus / material.density).sqrt();
    let elastic = 2.0 * length;
    let yields = yield_speed(material).is_some_and(|least| velocity > least);
    let Some(flow) = material.flow.filter(|_| yields) else {
        return Estimate {
            displacement: 0.5 * speed * length,
            contact_radius: 1.0,
            contact_time: elastic,
        };
    };
    let rate = velocity / (length * radius);
    let pressure = material.density * velocity * velocity;
    let mut strain = 0.0;
    for _ in 0..30 {
        let past = Past {
            strain: 0.5 * strain,
            rate,
            ..Past::default()
        };
        strain = 0.5 * pressure / flow.after(past).0;
    }
    let shortened = length * -(-strain).exp_m1();
    Estimate {
        displacement: 0.5 * shortened + 0.5 * speed * length,
        contact_radius: 1.0,
        contact_time: (2.0 * shortened / speed).max(elastic),
    }
}

/// Grid over the whole end of a cylinder.
pub(super) fn grid(shape: crate::shape::Shape, tolerance: f64) -> Grid {
    let cells = (CELLS * (0.02 / tolerance).sqrt()).clamp(8.0, 80.0);
    let fine = 1.0 / cells.round();
    Grid {
        shape,
        degree: 2,
        points_per_direction: 2,
        fine,
        fine_width: 1.0,
        fine_depth: FINE * shape.height(),
        growth: 1.15,
        coarse: 3.0 * fine,
        dt_share: 1.0,
        scaled: 0.0,
        remedies: Remedies::NONE,
    }
}

/// Time after loss of contact over which the residual vibration is averaged: one and a half periods of its slowest mode along
/// the axis, $2 L / c_0$.
pub(super) fn ring_time(length: f64) -> f64 {
    3.0 * length
}
