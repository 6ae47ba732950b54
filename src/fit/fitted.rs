//! Fitted: what a fit hands on, the law in its forms with its errors, and which errors are too large.

use super::quality::{LeftOut, Quality};
use crate::contact::elastoplastic::Elastoplastic;
use crate::contact::loading::SoftenedHertz;
use crate::contact::spline::SplineLoading;
use crate::theory::hertz::Hertz;

/// Largest error of F*, delta* and e at any speed with which a law counts as good, for impacts simulated to a relative
/// `tolerance`: half of the tolerance is left for what the form cannot follow.
#[must_use]
pub fn threshold(tolerance: f64) -> f64 {
    1.5 * tolerance
}

/// Largest error at a speed that was left out, beyond which a law is said to be no guide between and beyond its speeds.
#[must_use]
pub fn left_out_bound(tolerance: f64) -> f64 {
    5.0 * tolerance
}

/// A law fitted in one form.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedForm<L> {
    /// The law.
    pub law: Elastoplastic<L>,
    /// Its errors, one entry a speed.
    pub quality: Vec<Quality>,
    /// 95 % intervals of its constants: those of the loading curve (closed form: $w_1, b, q$; spline: the force of
    /// each knot), then $\kappa$ of the inertia term if the law has one, then $c, k, n_1, n_2$. `None` for fewer than
    /// [`LEAST_RUNS`](super::confidence::LEAST_RUNS) speeds.
    pub intervals: Option<Vec<[f64; 2]>>,
    /// Errors at speeds that were left out of the fit; empty for a single speed.
    pub left_out: Vec<LeftOut>,
}

/// What the impacts ask for.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Nothing yields: the law is Hertz's.
    Elastic {
        /// Hertz's law of the material.
        law: Hertz,
        /// Its errors, one entry a speed.
        quality: Vec<Quality>,
    },
    /// The law in both forms, or in the one that was found.
    Yielding {
        /// Closed form.
        closed_form: Option<Box<FittedForm<SoftenedHertz>>>,
        /// Spline.
        spline: Option<Box<FittedForm<SplineLoading>>>,
    },
}

/// An impact that was not used.
#[derive(Debug, Clone, PartialEq)]
pub struct Skipped {
    /// Its speed, m/s.
    pub velocity: f64,
    /// Why, as in "the impact at 3 m/s ...".
    pub why: String,
}

/// Result of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The law.
    pub outcome: Outcome,
    /// Largest flattening delta*/R among the impacts.
    pub flattening: f64,
    /// Smallest and largest impact speed, m/s.
    pub velocities: [f64; 2],
    /// Accuracy of the impacts, relative.
    pub tolerance: f64,
    /// Impacts that were not used.
    pub skipped: Vec<Skipped>,
    /// Why a form is missing, if one is.
    pub missing: Option<String>,
}
