//! Solvers of the fit: a simplex that finds the basin, then damped Gauss-Newton steps to its bottom.

use super::form::{Form, UNLOADING};
use super::marquardt::{Stop, minimise};
use super::residual::{Objective, Part, Pressed, half_squares};
use crate::{Error, Result};
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::neldermead::NelderMead;
use nalgebra::{DMatrix, DVector};

/// Edge of the first simplex, in free numbers (logarithms).
const SIMPLEX_EDGE: f64 = 0.5;
/// Simplex steps for the loading numbers, and for those of the unloading.
const SIMPLEX_STEPS: u64 = 250;
/// Standard deviation of the cost over the simplex at which it stops.
const SIMPLEX_SPREAD: f64 = 1e-4;
/// Largest number of Gauss-Newton steps.
const POLISH_STEPS: usize = 60;
/// Relative fall of the cost below which polishing stops, for a law.
pub const LAW: f64 = 1e-9;
/// The same for one resample of many, whose spread is what counts.
pub const RESAMPLE: f64 = 1e-5;
/// Step of the difference quotients in free numbers.
const DIFFERENCE: f64 = 1e-6;

/// Some of the free numbers, the others held: what the simplex sees.
struct Slice<'a, F> {
    objective: &'a Objective<'a, F>,
    part: Part,
    whole: &'a [f64],
    first: usize,
    /// First loading of the runs, where the numbers that move are those of the unloading.
    pressed: Option<Vec<Pressed>>,
}

impl<F: Form> Slice<'_, F> {
    fn whole(&self, some: &[f64]) -> Vec<f64> {
        let mut free = self.whole.to_vec();
        free[self.first..self.first + some.len()].copy_from_slice(some);
        free
    }
}

impl<F: Form> CostFunction for Slice<'_, F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, some: &Vec<f64>) -> std::result::Result<f64, argmin::core::Error> {
        let free = self.whole(some);
        let cost = match &self.pressed {
            None => self.objective.cost(&free, self.part),
            Some(pressed) => self
                .objective
                .form
                .law(&free, f64::MAX)
                .map_or(f64::INFINITY, |law| {
                    half_squares(&self.objective.released(&free, &law, pressed, self.part))
                }),
        };
        // a simplex needs comparable numbers: inadmissible is worse than anything a run can give
        Ok(cost.min(f64::MAX.sqrt()))
    }
}

/// Radii of the shells around a start that are searched for an admissible law, in spreads.
const SHELLS: [f64; 10] = [0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0];

/// Free numbers at the least cost: simplex on the loading, simplex on the unloading, then all together.
///
/// # Errors
/// [`Error::Fit`] when no admissible law lies near the start or a solver stops without a result.
pub fn solve<F: Form>(objective: &Objective<'_, F>) -> Result<Vec<f64>> {
    let mut free = admissible(objective, &objective.form.start())?;
    let split = free.len() - UNLOADING;
    free = simplex(objective, Part::Loading, &free, 0..split)?;
    free = simplex(objective, Part::Unloading, &free, split..free.len())?;
    polish(objective, &free, LAW)
}

/// `start` if it is admissible, else the best point of the nearest shell around it that holds one: one number moved, or two.
///
/// # Errors
/// [`Error::Fit`] when no shell does.
pub fn admissible<F: Form>(objective: &Objective<'_, F>, start: &[f64]) -> Result<Vec<f64>> {
    let cost = |free: &[f64]| objective.cost(free, Part::All);
    if cost(start).is_finite() {
        return Ok(start.to_vec());
    }
    let spread = objective.form.spread();
    for radius in SHELLS {
        let mut best = (f64::INFINITY, Vec::new());
        let mut moves: Vec<Vec<(usize, f64)>> = Vec::new();
        for i in 0..start.len() {
            for side in [-radius, radius] {
                moves.push(vec![(i, side)]);
                for j in 0..i {
                    moves.extend([-radius, radius].map(|other| vec![(i, side), (j, other)]));
                }
            }
        }
        for step in moves {
            let mut free = start.to_vec();
            for (i, side) in step {
                free[i] += side * spread[i];
            }
            let here = cost(&free);
            if here < best.0 {
                best = (here, free);
            }
        }
        if best.0.is_finite() {
            return Ok(best.1);
        }
    }
    Err(Error::Fit {
        reason: "no admissible law near the start".to_owned(),
    })
}

/// Nelder-Mead over `range` of the free numbers.
fn simplex<F: Form>(
    objective: &Objective<'_, F>,
    part: Part,
    whole: &[f64],
    range: std::ops::Range<usize>,
) -> Result<Vec<f64>> {
    let law = objective.form.law(whole, f64::MAX);
    let pressed = law.filter(|_| part == Part::Unloading);
    let slice = Slice {
        objective,
        part,
        whole,
        first: range.start,
        pressed: pressed.and_then(|law| objective.pressed(&law, part)),
    };
    let corner = whole[range.clone()].to_vec();
    let mut corners = vec![corner.clone()];
    for i in 0..corner.len() {
        let mut moved = corner.clone();
        moved[i] += SIMPLEX_EDGE;
        corners.push(moved);
    }
    let failed = |e: argmin::core::Error| Error::Fit {
        reason: format!("the simplex stopped: {e}"),
    };
    let solver = NelderMead::new(corners)
        .with_sd_tolerance(SIMPLEX_SPREAD)
        .map_err(failed)?;
    let result = Executor::new(slice, solver)
        .configure(|state| state.max_iters(SIMPLEX_STEPS))
        .timer(false)
        .run()
        .map_err(failed)?;
    let best = result.state().get_best_param().cloned().unwrap_or(corner);
    let mut free = whole.to_vec();
    free[range].copy_from_slice(&best);
    Ok(free)
}

/// Levenberg-Marquardt from `free` until the cost no longer falls, or where the edge of what is admissible leaves no
/// derivatives; "no longer" is a relative fall below `least`.
///
/// # Errors
/// [`Error::Fit`] when `free` is not admissible.
pub fn polish<F: Form>(objective: &Objective<'_, F>, free: &[f64], least: f64) -> Result<Vec<f64>> {
    let cost = |free: &[f64]| objective.cost(free, Part::All);
    if !cost(free).is_finite() {
        return Err(Error::Fit {
            reason: "no admissible law near the start".to_owned(),
        });
    }
    let stop = Stop {
        steps: POLISH_STEPS,
        fall: least,
    };
    let normal = |free: &[f64]| {
        let (jacobian, residuals) = jacobian(objective, free)?;
        let transposed = jacobian.transpose();
        Some((&transposed * jacobian, -(transposed * residuals)))
    };
    Ok(minimise(free, stop, cost, normal).0)
}

/// Residuals and their derivatives by forward differences (backward where forward is not admissible); `None` where neither is.
fn jacobian<F: Form>(
    objective: &Objective<'_, F>,
    free: &[f64],
) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let law = objective.form.law(free, f64::MAX)?;
    let pressed = objective.pressed(&law, Part::All)?;
    let here = objective.released(free, &law, &pressed, Part::All);
    let mut matrix = DMatrix::zeros(here.len(), free.len());
    for j in 0..free.len() {
        let at = |step: f64| {
            let mut moved = free.to_vec();
            moved[j] += step;
            let there = if j < free.len() - UNLOADING {
                objective.residuals(&moved, Part::All)?
            } else {
                let law = objective.form.law(&moved, f64::MAX)?;
                objective.released(&moved, &law, &pressed, Part::All)
            };
            Some((step, there))
        };
        let (step, there) = at(DIFFERENCE).or_else(|| at(-DIFFERENCE))?;
        for i in 0..here.len() {
            matrix[(i, j)] = (there[i] - here[i]) / step;
        }
    }
    Some((matrix, DVector::from_vec(here)))
}
