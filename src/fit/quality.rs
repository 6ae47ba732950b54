//! Quality of a law: its errors against the impacts it should reproduce.

use super::run::{Point, Run, Scale};
use crate::contact::NormalLaw;
use crate::contact::rebound::rebound;
use crate::curve::restitution_error;

/// Errors of a law on one impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Impact speed, m/s.
    pub velocity: f64,
    /// F*, relative.
    pub max_force: f64,
    /// delta*, relative.
    pub max_displacement: f64,
    /// delta_res, over delta*.
    pub residual_displacement: f64,
    /// e, relative to itself or to [`crate::curve::LEAST_RESTITUTION`].
    pub restitution: f64,
    /// Contact time, relative; 0 where the body sticks, whose contact does not end.
    pub contact_time: f64,
    /// Root mean square force along loading, over F*.
    pub loading_force: f64,
    /// Root mean square force along unloading, over F*.
    pub unloading_force: f64,
}

impl Quality {
    /// Errors of `law` on `run`: figures by [`rebound`], forces at the displacements of the run.
    #[must_use]
    pub fn of<L: NormalLaw>(law: &L, run: &Run, scale: &Scale) -> Self {
        let hit = rebound(law, scale.radius, scale.mass, run.velocity);
        let x = |w: f64| w * scale.units().flattening;
        let top = run.max_force * scale.units().force;
        let inertia = law.inertia();
        let incident = run.velocity * run.velocity / run.energy;
        let loading = |p: &Point| {
            let force = law.force(x(p.flattening), &mut L::History::default());
            let added = inertia.force(x(p.flattening), incident * p.energy);
            ((force + added) / top - p.force).powi(2)
        };
        let mut pressed = L::History::default();
        law.force(x(run.max_flattening), &mut pressed);
        let unloading =
            |(w, f): &(f64, f64)| (law.force(x(*w), &mut pressed.clone()) / top - f).powi(2);
        let rms = |squares: f64, points: usize| (squares / points.max(1) as f64).sqrt();
        let most = run.max_flattening * scale.displacement;
        Quality {
            velocity: run.velocity,
            max_force: hit.max_force / (run.max_force * scale.force) - 1.0,
            max_displacement: hit.max_displacement / most - 1.0,
            residual_displacement: (hit.residual_displacement - run.residual * scale.displacement)
                / most,
            restitution: restitution_error(hit.restitution, run.restitution),
            contact_time: match run.sticks {
                true => 0.0,
                false => hit.contact_time / (run.contact_time * scale.time) - 1.0,
            },
            loading_force: rms(run.loading.iter().map(loading).sum(), run.loading.len()),
            unloading_force: rms(
                run.unloading.iter().map(unloading).sum(),
                run.unloading.len(),
            ),
        }
    }

    /// Largest of the errors of F*, delta* and e, without sign.
    #[must_use]
    pub fn worst(&self) -> f64 {
        [self.max_force, self.max_displacement, self.restitution]
            .iter()
            .fold(
                0.0,
                |worst, e| if e.abs() <= worst { worst } else { e.abs() },
            )
    }
}

/// Relative errors of a law that has not seen the speed it predicts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftOut {
    /// Impact speed that was left out, m/s.
    pub velocity: f64,
    /// Error of F*.
    pub max_force: f64,
    /// Error of delta*.
    pub max_displacement: f64,
    /// Error of e.
    pub restitution: f64,
}

impl LeftOut {
    /// Largest of the errors, without sign; NaN if one is.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let LeftOut {
            velocity: _,
            max_force,
            max_displacement,
            restitution,
        } = *self;
        let errors = [max_force, max_displacement, restitution];
        errors.iter().fold(
            0.0,
            |worst: f64, e| {
                if e.abs() <= worst { worst } else { e.abs() }
            },
        )
    }
}
