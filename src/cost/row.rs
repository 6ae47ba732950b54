//! Row: one rung of a ladder with what it cost and what it missed; the columns of `cost_V*.csv`.

use super::{Misfit, Pulse, Rung};
use crate::curve::{Impact, Status};
use crate::plan::Geometry;
use serde::Serialize;

/// One run. Field names are the CSV header; errors are relative to the finest run (`*_error_rel`, `mae_*`, `mse_*`) and, of
/// elastic cases, to Hertz and Johnson (`hertz_*`).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Impact speed, m/s.
    pub velocity_m_s: f64,
    /// What is varied.
    pub ladder: String,
    /// Setting.
    pub rung: String,
    /// Degree of the splines.
    pub degree: usize,
    /// 2: the axisymmetric section, 3: a quarter of the sphere.
    pub dimension: usize,
    /// Smallest cells, particle radii.
    pub cell_size_rel: f64,
    /// Cells in the expected contact radius.
    pub cells_per_radius: f64,
    /// Material points.
    pub points: usize,
    /// Steps.
    pub steps: u64,
    /// Wall time, s.
    pub wall_s: f64,
    /// Processor time, s: the wall time of a machine with nothing else to do.
    pub cpu_s: f64,
    /// Seconds the planner predicted.
    pub predicted_s: f64,
    /// Points times steps a second.
    pub point_steps_per_s: f64,
    /// Memory of points and nodes, bytes.
    pub memory_bytes: usize,
    /// How the run ended.
    pub status: String,
    /// Largest of the errors in F*, delta* and e.
    pub error: f64,
    /// Of F*.
    pub max_force_error_rel: f64,
    /// Of delta*.
    pub max_displacement_error_rel: f64,
    /// Of e.
    pub restitution_error_rel: f64,
    /// Of the contact time.
    pub contact_time_error_rel: f64,
    /// Mean absolute error of F/F*.
    pub mae_force: f64,
    /// Mean absolute error of delta/delta*.
    pub mae_displacement: f64,
    /// Mean squared error of F/F*.
    pub mse_force: f64,
    /// Mean squared error of delta/delta*.
    pub mse_displacement: f64,
    /// F* against Hertz.
    pub hertz_max_force_error_rel: Option<f64>,
    /// delta* against Hertz.
    pub hertz_max_displacement_error_rel: Option<f64>,
    /// Contact time against Johnson.
    pub hertz_contact_time_error_rel: Option<f64>,
    /// Mean absolute error of F/F* against Johnson.
    pub hertz_mae_force: Option<f64>,
    /// Mean absolute error of delta/delta* against Johnson.
    pub hertz_mae_displacement: Option<f64>,
    /// Restitution.
    pub restitution: f64,
    /// Energy lost in transfers between points and grid over the incident energy.
    pub transfer_loss: f64,
    /// Largest imbalance of the energies over the incident energy.
    pub energy_closure: f64,
    /// Whether nothing is both faster and more accurate.
    pub on_front: bool,
}

impl Row {
    /// Row of a finished (or stopped) run.
    #[must_use]
    pub fn new(
        rung: &Rung,
        run: &super::Finished,
        reference: &Pulse,
        hertz: Option<&Pulse>,
    ) -> Self {
        let impact = &run.impact;
        let s = &impact.summary;
        let done = s.status == Status::Ok;
        let pulse = Pulse::of(impact);
        let misfit = pulse.misfit(reference);
        let ideal = hertz.filter(|_| done).map(|hertz| pulse.misfit(hertz));
        let plan = &rung.plan;
        let mut row = Row {
            velocity_m_s: s.velocity_m_s,
            degree: plan.grid.degree,
            dimension: match plan.geometry {
                Geometry::Axisymmetric => 2,
                _ => 3,
            },
            cell_size_rel: plan.grid.fine,
            cells_per_radius: plan.estimate.contact_radius / plan.grid.fine,
            points: s.points,
            steps: s.steps,
            wall_s: s.wall_s,
            cpu_s: run.footprint.cpu_s,
            predicted_s: plan.seconds,
            point_steps_per_s: s.points as f64 * s.steps as f64 / run.footprint.cpu_s,
            memory_bytes: run.footprint.memory_bytes,
            status: status(impact),
            hertz_max_force_error_rel: ideal.map(|m| m.force),
            hertz_max_displacement_error_rel: ideal.map(|m| m.displacement),
            hertz_contact_time_error_rel: ideal.map(|m| m.contact_time),
            hertz_mae_force: ideal.map(|m| m.mae_force),
            hertz_mae_displacement: ideal.map(|m| m.mae_displacement),
            restitution: s.restitution,
            transfer_loss: run.footprint.transfer_loss,
            energy_closure: s.energy_closure,
            ..Row::empty(&rung.ladder, &rung.name)
        };
        if done {
            row.set_errors(&misfit);
        }
        row
    }

    fn set_errors(&mut self, misfit: &Misfit) {
        self.error = misfit.worst();
        self.max_force_error_rel = misfit.force;
        self.max_displacement_error_rel = misfit.displacement;
        self.restitution_error_rel = misfit.restitution;
        self.contact_time_error_rel = misfit.contact_time;
        self.mae_force = misfit.mae_force;
        self.mae_displacement = misfit.mae_displacement;
        self.mse_force = misfit.mse_force;
        self.mse_displacement = misfit.mse_displacement;
    }

    /// Row without figures.
    #[must_use]
    pub fn empty(ladder: &str, rung: &str) -> Self {
        let nan = f64::NAN;
        Row {
            velocity_m_s: nan,
            ladder: ladder.to_owned(),
            rung: rung.to_owned(),
            degree: 0,
            dimension: 0,
            cell_size_rel: nan,
            cells_per_radius: nan,
            points: 0,
            steps: 0,
            wall_s: nan,
            cpu_s: nan,
            predicted_s: nan,
            point_steps_per_s: nan,
            memory_bytes: 0,
            status: String::new(),
            error: nan,
            max_force_error_rel: nan,
            max_displacement_error_rel: nan,
            restitution_error_rel: nan,
            contact_time_error_rel: nan,
            mae_force: nan,
            mae_displacement: nan,
            mse_force: nan,
            mse_displacement: nan,
            hertz_max_force_error_rel: None,
            hertz_max_displacement_error_rel: None,
            hertz_contact_time_error_rel: None,
            hertz_mae_force: None,
            hertz_mae_displacement: None,
            restitution: nan,
            transfer_loss: nan,
            energy_closure: nan,
            on_front: false,
        }
    }
}

/// One word, and the reason where a run was stopped.
fn status(impact: &Impact) -> String {
    match &impact.summary.status {
        Status::Ok => "ok".to_owned(),
        Status::Sticks => "sticks".to_owned(),
        Status::NoRebound => "no_rebound".to_owned(),
        Status::Failed(reason) => format!("failed: {reason}"),
    }
}
