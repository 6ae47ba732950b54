//! Prediction: points, steps and seconds of a run, from its plan alone.
//!
//! Steps were measured on 66 impacts (E/Y 40 to 5000, $\rho V^2/Y$ 0.001 to 51, tolerance 0.01 and 0.02), seconds on one core
//! of a 2-core machine (Intel Xeon of 2.6 GHz with 2 MB of second-level cache a core); another machine scales all seconds
//! alike. On 46 others drawn at random (E/Y 20 to 2560, $\rho V^2/Y$ 1e-4 to 3, nu 0 to 0.45, tolerance 0.01 to 0.05) the
//! seconds were right within a factor of 1.25, but for two that took 0.62 and 0.65 of them (E/Y 53 and 2347, $\rho V^2/Y$
//! 0.335 and 0.205).

use super::{Geometry, Plan, graded, severity};
use crate::material::Material;
use crate::scheme::{Layout, Reference, TimeStep, Transfer};
use crate::shape::Shape;
use std::f64::consts::PI;

/// Point-steps a second and core of quadratic splines in the axisymmetric section, contact and outputs included.
const THROUGHPUT: f64 = 5.5e7;
/// The same where cells take steps of their own.
const LEVELS_THROUGHPUT: f64 = 4.9e7;
/// Sweeps that sorting them and measuring their steps costs each time.
const SORTING_SWEEPS: f64 = 3.0;
/// The same in three dimensions.
const SOLID_THROUGHPUT: f64 = 8e6;
/// Sweeps over the points that a refresh of the stable step costs.
const REFRESH_SWEEPS: f64 = 6.0;
/// $\rho V^2/Y$ against steps, as the mean over all points, over those that the undeformed body would take, for E/Y of 160 to
/// 5000: thin cells need short steps until erosion holds them, and a sheet that spreads fast is flat sooner. Measured with 12
/// to 34 cells a contact radius.
const SQUEEZE: [(f64, f64); 17] = [
    (0.001, 0.9),
    (0.01, 1.0),
    (0.03, 1.15),
    (0.06, 1.35),
    (0.12, 1.7),
    (0.2, 2.25),
    (0.32, 3.1),
    (0.5, 3.9),
    (0.8, 4.8),
    (1.2, 7.4),
    (2.0, 11.0),
    (3.2, 15.7),
    (5.0, 29.5),
    (8.0, 69.0),
    (12.8, 35.0),
    (25.6, 18.0),
    (51.2, 11.5),
];
/// Steps where one is taken for all over the mean where cells take their own, at $\rho V^2/Y$ of 0.3 to 3.
const ONE_STEP: f64 = 3.0;
/// Cells a contact radius with which [`SQUEEZE`] was measured, at $\rho V^2/Y \ge 1$.
const MEASURED_CELLS: f64 = 28.0;

/// The plan with points, steps and seconds predicted from its grid and scheme.
#[must_use]
pub fn with_prediction(mut plan: Plan, material: &Material) -> Plan {
    let dt = time_step(&plan, material);
    let duration = plan.estimate.contact_time + plan.ring_time;
    let steps = duration / dt;
    let squeezed = steps * squeeze(&plan, material);
    let speed = plan.run_velocity / (material.young_modulus / material.density).sqrt();
    plan.points = points(&plan);
    plan.steps = squeezed as u64;
    let (sweeps, throughput) = if takes_levels(&plan) {
        // share of the first step that the longest keeps
        let severity = severity(material, plan.velocity);
        let long = (0.6 * (0.25 / severity).powf(0.6)).clamp(0.35, 0.6);
        let interval = (0.1 * plan.grid.fine / (speed * long * dt)).clamp(1.0, 50.0);
        let refreshes = steps / (long * interval);
        (squeezed + SORTING_SWEEPS * refreshes, LEVELS_THROUGHPUT)
    } else {
        let interval = (0.5 * plan.grid.fine / (speed * dt) * squeezed / steps).clamp(1.0, 50.0);
        let refreshes = squeezed / interval;
        (squeezed + REFRESH_SWEEPS * refreshes, throughput(&plan))
    };
    let flow = material.flow.filter(|_| plan.plastic);
    let cost = flow.map_or(1.0, crate::material::Flow::cost);
    plan.seconds = cost * plan.points as f64 * sweeps / throughput;
    plan
}

/// Whether cells take steps of their own.
fn takes_levels(plan: &Plan) -> bool {
    let scheme = &plan.scheme;
    let applies = scheme.transfer == Transfer::Persistent && scheme.time_step == TimeStep::Stable;
    applies && plan.grid.remedies.long_step > 0.0
}

/// The plan with all cells `share` times as large.
#[must_use]
pub fn with_cells(mut plan: Plan, share: f64, material: &Material) -> Plan {
    plan.grid.fine *= share;
    plan.grid.coarse *= share;
    plan.grid.scaled *= share;
    // smaller cells are squeezed further
    plan.grid.remedies.least_step *= share.min(1.0);
    with_prediction(plan, material)
}

/// Point-steps a second of a plan's degree and scheme.
fn throughput(plan: &Plan) -> f64 {
    if plan.geometry != Geometry::Axisymmetric {
        // one point a cell leaves three of four lanes empty
        let lattice = [0.3, 0.2, 0.1][plan.grid.degree.clamp(1, 3) - 1];
        let share = match plan.scheme.layout {
            Layout::Fitted => 1.0,
            Layout::Lattice(_) | Layout::Centred(_) => lattice,
        };
        return SOLID_THROUGHPUT * share;
    }
    let degree = [0.75, 1.0, 0.4][plan.grid.degree.clamp(1, 3) - 1];
    let transfer = match plan.scheme.transfer {
        Transfer::Persistent => 1.0,
        _ => 0.65,
    };
    let reference = match plan.scheme.reference {
        Reference::Initial => 1.0,
        Reference::Present => 0.5,
    };
    let lattice = match plan.scheme.layout {
        // about one point a cell, as above
        Layout::Centred(_) => 0.4,
        Layout::Fitted | Layout::Lattice(_) => 1.0,
    };
    THROUGHPUT * degree * transfer * reference * lattice
}

/// Material points that the grid will hold.
fn points(plan: &Plan) -> usize {
    let grid = &plan.grid;
    let count =
        |length: f64, to: f64| graded(length, grid.fine, to, grid.growth, grid.coarse).len();
    let (across, up) = (
        count(1.0, grid.fine_width) as f64,
        count(grid.shape.height(), grid.fine_depth) as f64,
    );
    let side = grid.points_per_direction as f64;
    if let Shape::Cylinder { .. } = grid.shape {
        return (across * up * side.powi(2)) as usize;
    }
    // of a ball with points on its planes of symmetry, in their distance
    let ball = |count: f64| (count / 2.0).floor() + 1.0;
    let points = match (plan.geometry, plan.scheme.layout) {
        (Geometry::Axisymmetric, Layout::Centred(n)) => PI / 2.0 * ball(n).powi(2),
        (Geometry::Quarter, Layout::Centred(n)) => {
            PI / 3.0 * ball(n).powi(3) + PI / 2.0 * ball(n).powi(2)
        }
        (Geometry::Half, Layout::Centred(n)) => {
            2.0 * PI / 3.0 * ball(n).powi(3) + PI / 2.0 * ball(n).powi(2)
        }
        (Geometry::Quarter, Layout::Lattice(n)) => PI / 24.0 * n.powi(3),
        (Geometry::Half, Layout::Lattice(n)) => PI / 12.0 * n.powi(3),
        (Geometry::Quarter, _) => 0.6 * across.powi(2) * up * side.powi(3),
        (Geometry::Half, _) => 1.2 * across.powi(2) * up * side.powi(3),
        (_, Layout::Fitted) => 0.8 * across * up * side.powi(2),
        (_, Layout::Lattice(per_diameter)) => PI / 8.0 * per_diameter.powi(2),
    };
    points as usize
}

/// Time step of the undeformed body.
fn time_step(plan: &Plan, material: &Material) -> f64 {
    let nu = material.poisson_ratio;
    let speed = ((1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))).sqrt();
    match plan.scheme.time_step {
        TimeStep::Stable => {
            0.87 * plan.grid.dt_share * plan.grid.fine.max(plan.laid().scaled) / speed
        }
        TimeStep::Fixed(dt) => dt,
    }
}

/// Steps over those that the undeformed body would take.
fn squeeze(plan: &Plan, material: &Material) -> f64 {
    let solid = plan.geometry != Geometry::Axisymmetric;
    if solid || plan.scheme.time_step != TimeStep::Stable {
        return 1.0;
    }
    let severity = severity(material, plan.velocity * plan.angle.cos());
    let ratio = material
        .flow
        .map_or(1.0, |f| material.young_modulus / f.yield_strength() / 160.0);
    let soft = ratio.min(1.0).powf(0.25);
    if !plan.grid.remedies.is_large() {
        return (interpolated(severity) * soft).max(interpolated(severity).min(1.0));
    }
    let cells = plan.estimate.contact_radius / plan.grid.fine;
    // finer cells are squeezed further before erosion stops it
    let finer = (cells / (MEASURED_CELLS * severity.min(1.0).powf(0.4))).powf(0.5);
    let levels = (interpolated(severity) * finer * soft).max(1.0);
    if takes_levels(plan) {
        return levels;
    }
    // one step for all: the shortest
    (levels * ONE_STEP).min(1.0 / plan.grid.remedies.least_step)
}

/// [`SQUEEZE`] between its entries, straight in the logarithms.
fn interpolated(severity: f64) -> f64 {
    let k = SQUEEZE
        .partition_point(|(q, _)| *q < severity)
        .clamp(1, SQUEEZE.len() - 1);
    let ((q0, f0), (q1, f1)) = (SQUEEZE[k - 1], SQUEEZE[k]);
    let share = ((severity / q0).ln() / (q1 / q0).ln()).clamp(0.0, 1.0);
    f0 * (f1 / f0).powf(share)
}
