//! Residuals of a fit: what is minimised, and how much each figure of a run weighs.

use super::form::Form;
use super::pulse::{Added, Loaded, Pulse};
use super::run::{Point, Run};
use crate::contact::elastoplastic::Elastoplastic;
use crate::contact::loading::Loading;
use crate::curve::restitution_error;

/// Relative tolerances: a residual is an error over its tolerance, so these are the weights.
///
/// F*, delta* and e are what a law must return; force along the curves counts over F*, and a whole branch
/// counts like one figure, so that every run weighs the same. Waves that run through the sphere early in loading
/// lift the force above the quasi-static envelope for a short part of the branch, which this weight keeps small.
mod tolerance {
    /// F*, delta*, e.
    pub const FIGURE: f64 = 0.005;
    /// Error of F*, delta*, e past which it counts progressively, so that the largest errors are levelled.
    pub const LEVEL: f64 = 0.01;
    /// Recovered part delta* - delta_res. It, not delta_res, carries e, and is 2 % of delta* in soft metals.
    pub const RECOVERED: f64 = 0.02;
    /// Contact time.
    pub const TIME: f64 = 0.02;
    /// Root mean square force along a branch over F*.
    pub const CURVE: f64 = 0.02;
}

/// Which free numbers and residuals take part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Loading curve, F*, delta*.
    Loading,
    /// Unloading branches, delta_res, e, contact time.
    Unloading,
    /// Everything.
    All,
}

/// Sum of squares that a form is fitted to.
#[derive(Debug, Clone)]
pub struct Objective<'a, F> {
    /// Form.
    pub form: &'a F,
    /// Runs.
    pub runs: &'a [Run],
    /// How often each run counts.
    pub weights: &'a [f64],
}

/// First loading of one run, with the residuals that depend on it alone.
#[derive(Debug, Clone)]
pub struct Pressed {
    loaded: Loaded,
    residuals: Vec<f64>,
}

impl<F: Form> Objective<'_, F> {
    /// Residuals at `free`; `None` where it is not admissible.
    #[must_use]
    pub fn residuals(&self, free: &[f64], part: Part) -> Option<Vec<f64>> {
        let law = self.form.law(free, f64::MAX)?;
        Some(self.released(free, &law, &self.pressed(&law, part)?, part))
    }

    /// First loading by `law` of every run that counts: it stays what it is where the numbers of the unloading move alone.
    #[must_use]
    pub fn pressed(&self, law: &Elastoplastic<F::Curve>, part: Part) -> Option<Vec<Pressed>> {
        let press = |(run, _): (&Run, f64)| {
            let loaded = Loaded::of(law, run.energy, run.max_flattening)?;
            let residuals = match part {
                Part::Unloading => Vec::new(),
                Part::Loading | Part::All => loading(run, law, &loaded.released(law)),
            };
            Some(Pressed { loaded, residuals })
        };
        self.counting().map(press).collect()
    }

    /// Residuals at `free`, whose law is `law` and whose first loading is `pressed`.
    #[must_use]
    pub fn released(
        &self,
        free: &[f64],
        law: &Elastoplastic<F::Curve>,
        pressed: &[Pressed],
        part: Part,
    ) -> Vec<f64> {
        let mut all = Vec::new();
        for ((run, weight), pressed) in self.counting().zip(pressed) {
            let begin = all.len();
            all.extend_from_slice(&pressed.residuals);
            if part != Part::Loading {
                unloading(&mut all, run, law, &pressed.loaded.released(law));
            }
            all[begin..].iter_mut().for_each(|r| *r *= weight.sqrt());
        }
        all.extend(self.form.roughness(free));
        let held = self.form.start().into_iter().zip(self.form.spread());
        let distance = |(a, (b, spread)): (&f64, (f64, f64))| (a - b) / spread;
        all.extend(free.iter().zip(held).map(distance));
        all
    }

    /// The runs that count, each with how often.
    fn counting(&self) -> impl Iterator<Item = (&Run, f64)> {
        let all = self.runs.iter().zip(self.weights.iter().copied());
        all.filter(|(_, weight)| *weight > 0.0)
    }

    /// Half the sum of squares; infinite where not admissible.
    #[must_use]
    pub fn cost(&self, free: &[f64], part: Part) -> f64 {
        let residuals = self.residuals(free, part);
        residuals.map_or(f64::INFINITY, |r| half_squares(&r))
    }
}

/// Half the sum of squares.
pub fn half_squares(residuals: &[f64]) -> f64 {
    0.5 * residuals.iter().map(|x| x * x).sum::<f64>()
}

/// Residual of a figure with relative error `error`: its square grows with the fourth power past the level.
fn figure(error: f64) -> f64 {
    error / tolerance::FIGURE * (error / tolerance::LEVEL).hypot(1.0)
}

/// Weight of one of so many points of a branch.
fn branch(points: usize) -> f64 {
    1.0 / (tolerance::CURVE * (points as f64).sqrt())
}

/// Residuals of one run's loading.
fn loading<L: Loading>(run: &Run, law: &Elastoplastic<L>, pulse: &Pulse) -> Vec<f64> {
    let (curve, added) = (law.loading(), Added::of(law));
    let figures = [
        figure(pulse.force / run.max_force - 1.0),
        figure(pulse.flattening / run.max_flattening - 1.0),
    ];
    let weight = branch(run.loading.len());
    let error = |p: &Point| {
        let force = curve.force(p.flattening) + added.force(p.flattening, p.energy);
        (force / run.max_force - p.force) * weight
    };
    let along = run.loading.iter().map(error);
    figures.into_iter().chain(along).collect()
}

/// Adds the residuals of one run's unloading.
fn unloading<L: Loading>(all: &mut Vec<f64>, run: &Run, law: &Elastoplastic<L>, pulse: &Pulse) {
    all.push(figure(restitution_error(
        pulse.restitution,
        run.restitution,
    )));
    if run.sticks {
        return;
    }
    let recovered = run.max_flattening - run.residual;
    all.push(((pulse.flattening - pulse.residual) / recovered - 1.0) / tolerance::RECOVERED);
    all.push((pulse.time / run.contact_time - 1.0) / tolerance::TIME);
    let weight = branch(run.unloading.len());
    let (rho, n) = law.branch(run.max_flattening);
    let (w_m, w_r) = (run.max_flattening, rho * run.max_flattening);
    let top = law.loading().force(w_m) / run.max_force;
    let error = |(w, f): &(f64, f64)| {
        let z = ((w - w_r) / (w_m - w_r)).clamp(0.0, 1.0);
        (top * z.powf(n) - f) * weight
    };
    all.extend(run.unloading.iter().map(error));
}
