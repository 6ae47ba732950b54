//! Front: of each number of constants the best formula, with scores and intervals.

use super::formula::Formula;
use super::physics::{Places, Rules};
use super::problem::{Runs, Target, VANISHING};
use super::score::{Model, Score, Split, intervals, weights};
use super::search::{Effort, Found, Task, misfit_bits, search};
use super::solve::Data;
use rayon::prelude::*;

/// A formula of the front.
#[derive(Debug, Clone)]
pub struct Entry {
    /// What was found.
    pub found: Found,
    /// Errors on what was fitted.
    pub seen: Score,
    /// With levels left out.
    pub levels: Score,
    /// With materials left out.
    pub materials: Score,
    /// 95 % intervals of the constants.
    pub intervals: Vec<[f64; 2]>,
    /// Bits with the misfit of what was left out.
    pub length: f64,
}

/// Where a front is looked for.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// Runs.
    pub runs: &'a Runs,
    /// Where formulas are looked at.
    pub places: &'a Places,
    /// Levels.
    pub levels: &'a Split,
    /// Materials.
    pub materials: &'a Split,
    /// Seed.
    pub seed: u64,
    /// How far to go.
    pub effort: Effort,
}

/// Most constants of a formula in the front.
const MOST: usize = 6;
/// Formulas of a number of constants that are compared with levels left out.
const COMPARED: usize = 6;

/// Searches for a figure; formulas by rising number of constants, each better than all before it.
#[must_use]
pub fn front(setting: &Setting<'_>, target: &Target) -> Vec<Entry> {
    let rules = Rules::of(&target.name);
    let physical = |formula: &Formula| setting.places.broken(formula, &rules).is_none();
    let weights = weights(setting.runs, target);
    let task = Task {
        data: Data {
            columns: &setting.runs.columns,
            targets: &target.values,
            weights: &weights,
        },
        limit: rules
            .limit
            .and_then(|value| Some((setting.places.limit.as_ref()?, value))),
        vanishing: match setting.runs.over_yield {
            Some(_) => VANISHING.len(),
            None => 0,
        },
        physical: &physical,
        seed: setting.seed,
        effort: setting.effort,
    };
    let found = search(&task);
    let mut front: Vec<Entry> = Vec::new();
    for constants in 0..=MOST {
        let some: Vec<&Found> = found
            .iter()
            .filter(|f| f.constants == constants)
            .take(COMPARED)
            .collect();
        let lengths: Vec<f64> = some
            .par_iter()
            .map(|one| one.bits + misfit_bits(left_out(one, setting, target, &weights)))
            .collect();
        let best = (0..some.len()).min_by(|&a, &b| lengths[a].total_cmp(&lengths[b]));
        let Some(best) = best.filter(|&i| lengths[i].is_finite()) else {
            continue;
        };
        let better = |entry: &Entry| some[best].fitted.chi2 < entry.found.fitted.chi2;
        if front.iter().all(better) {
            front.push(entry(some[best], lengths[best], setting, target));
        }
    }
    front
}

/// Sum of squares over the errors of the data, every level predicted from the others.
fn left_out(found: &Found, setting: &Setting<'_>, target: &Target, weights: &[f64]) -> f64 {
    let model = Model::Fitted(found.fitted.formula.clone());
    let predicted = model.predictions(setting.runs, target, setting.levels);
    let rows = predicted.iter().zip(&target.values).zip(weights);
    let sum: f64 = rows.map(|((p, y), w)| ((p - y) * w).powi(2)).sum();
    if sum.is_finite() { sum } else { f64::INFINITY }
}

fn entry(found: &Found, length: f64, setting: &Setting<'_>, target: &Target) -> Entry {
    let runs = setting.runs;
    let formula = &found.fitted.formula;
    let model = Model::Fitted(formula.clone());
    Entry {
        seen: Score::of(&formula.values(&runs.columns), target, &runs.counts),
        levels: model.left_out(runs, target, setting.levels),
        materials: model.left_out(runs, target, setting.materials),
        intervals: intervals(formula, runs, target, setting.seed),
        found: found.clone(),
        length,
    }
}

/// The one of least bits, misfit of left-out levels included, of those that say more than the mean does.
#[must_use]
pub fn chosen(front: &[Entry]) -> Option<usize> {
    let length = |i: usize| front[i].length;
    let told = (0..front.len()).filter(|&i| front[i].seen.r2 > 0.0);
    told.min_by(|&a, &b| length(a).total_cmp(&length(b)))
}
