//! Residuals of a fit: what is minimised, and how much each figure of a run weighs.

use super::form::Form;
use super::pulse::{Added, Pulse};
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

impl<F: Form> Objective<'_, F> {
    /// Residuals at `free`; `None` where it is not admissible.
    #[must_use]
    pub fn residuals(&self, free: &[f64], part: Part) -> Option<Vec<f64>> {
        let law = self.form.law(free, f64::MAX)?;
        let mut all = Vec::new();
        for (run, weight) in self.runs.iter().zip(self.weights) {
            if *weight > 0.0 {
                let begin = all.len();
                push(&mut all, run, &law, part)?;
                all[begin..].iter_mut().for_each(|r| *r *= weight.sqrt());
            }
        }
        all.extend(self.form.roughness(free));
        let held = self.form.start().into_iter().zip(self.form.spread());
        let distance = |(a, (b, spread)): (&f64, (f64, f64))| (a - b) / spread;
        all.extend(free.iter().zip(held).map(distance));
        Some(all)
    }

    /// Half the sum of squares; infinite where not admissible.
    #[must_use]
    pub fn cost(&self, free: &[f64], part: Part) -> f64 {
        self.residuals(free, part).map_or(f64::INFINITY, |r| {
            0.5 * r.iter().map(|x| x * x).sum::<f64>()
        })
    }
}

/// Residual of a figure with relative error `error`: its square grows with the fourth power past the level.
fn figure(error: f64) -> f64 {
    error / tolerance::FIGURE * (error / tolerance::LEVEL).hypot(1.0)
}

/// Residuals of one run.
fn push<L: Loading>(
    all: &mut Vec<f64>,
    run: &Run,
    law: &Elastoplastic<L>,
    part: Part,
) -> Option<()> {
    let pulse = Pulse::of(law, run.energy, run.max_flattening)?;
    let curve = law.loading();
    let added = Added::of(law);
    let branch = |points: usize| 1.0 / (tolerance::CURVE * (points as f64).sqrt());
    if part != Part::Unloading {
        all.push(figure(pulse.force / run.max_force - 1.0));
        all.push(figure(pulse.flattening / run.max_flattening - 1.0));
        let weight = branch(run.loading.len());
        let error = |p: &Point| {
            let force = curve.force(p.flattening) + added.force(p.flattening, p.energy);
            (force / run.max_force - p.force) * weight
        };
        all.extend(run.loading.iter().map(error));
    }
    if part != Part::Loading {
        let restitution = restitution_error(pulse.restitution, run.restitution);
        all.push(figure(restitution));
        if run.sticks {
            return Some(());
        }
        let recovered = run.max_flattening - run.residual;
        all.push(((pulse.flattening - pulse.residual) / recovered - 1.0) / tolerance::RECOVERED);
        all.push((pulse.time / run.contact_time - 1.0) / tolerance::TIME);
        let weight = branch(run.unloading.len());
        let (rho, n) = law.branch(run.max_flattening);
        let (w_m, w_r) = (run.max_flattening, rho * run.max_flattening);
        let top = curve.force(w_m) / run.max_force;
        let error = |(w, f): &(f64, f64)| {
            let z = ((w - w_r) / (w_m - w_r)).clamp(0.0, 1.0);
            (top * z.powf(n) - f) * weight
        };
        all.extend(run.unloading.iter().map(error));
    }
    Some(())
}
