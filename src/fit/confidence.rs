//! Confidence of a fit: parameter intervals from a bootstrap over runs, and errors at speeds that were left out.

use super::form::Form;
use super::pulse::Pulse;
use super::quality::LeftOut;
use super::residual::Objective;
use super::run::Run;
use super::solve::{RESAMPLE, polish};
use crate::Result;
use crate::contact::NormalLaw;
use crate::curve::restitution_error;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Fewest runs of a bootstrap. n runs make C(2n-1, n) different resamples: 10 of three runs, 35 of four, 126 of five; fewer
/// than 1/`TAIL` have no tails to cut off.
pub const LEAST_RUNS: usize = 5;
/// Refits of the bootstrap; each resamples the runs with replacement.
pub const RESAMPLES: usize = 100;
/// Seed of the bootstrap: the intervals of the same runs are the same numbers everywhere.
const SEED: u64 = 1882;
/// Part of the refits beyond either end of an interval: 95 % intervals.
const TAIL: f64 = 0.025;

/// 95 % intervals of the constants of `F`, each `[low, high]`; `None` for fewer than [`LEAST_RUNS`] runs, or where one in ten
/// refits finds no law.
///
/// The unit that is resampled is the run, because neighbouring samples of one curve are not independent. Refits
/// start at the optimum `free`.
#[must_use]
pub fn intervals<F: Form>(form: &F, runs: &[Run], free: &[f64]) -> Option<Vec<[f64; 2]>> {
    if runs.len() < LEAST_RUNS {
        return None;
    }
    let draws: Vec<Vec<f64>> = {
        let mut random = Pcg64::seed_from_u64(SEED);
        (0..RESAMPLES)
            .map(|_| draw(&mut random, runs.len()))
            .collect()
    };
    let refits = draws
        .par_iter()
        .map(|weights| {
            let objective = Objective {
                form,
                runs,
                weights,
            };
            constants(form, &polish(&objective, free, RESAMPLE).ok()?)
        })
        .collect::<Vec<Option<Vec<f64>>>>();
    let refits: Vec<Vec<f64>> = refits.into_iter().flatten().collect();
    if refits.len() < RESAMPLES - RESAMPLES / 10 {
        return None;
    }
    let count = refits.first().map_or(0, Vec::len);
    let interval = |j: usize| {
        let mut values: Vec<f64> = refits.iter().map(|c| c[j]).collect();
        values.sort_by(f64::total_cmp);
        [TAIL, 1.0 - TAIL].map(|p| values[(p * (values.len() - 1) as f64).round() as usize])
    };
    Some((0..count).map(interval).collect())
}

/// How often each run is drawn in one resample.
fn draw(random: &mut Pcg64, runs: usize) -> Vec<f64> {
    let mut weights = vec![0.0; runs];
    for _ in 0..runs {
        weights[random.random_range(0..runs)] += 1.0;
    }
    weights
}

fn constants<F: Form>(form: &F, free: &[f64]) -> Option<Vec<f64>> {
    let law = form.law(free, f64::MAX)?;
    let mut all = F::constants(law.loading());
    all.extend(form.density().map(|_| law.inertia().coefficient()));
    all.extend(law.unloading().constants());
    Some(all)
}

/// Leave-one-speed-out errors: for each run, `fit` makes a form and its free numbers from the others, which predict
/// it. NaN where the others make no law; empty for a single run.
pub fn left_out<F, B>(runs: &[Run], fit: B) -> Vec<LeftOut>
where
    F: Form,
    B: Fn(&[Run]) -> Result<(F, Vec<f64>)> + Sync,
{
    if runs.len() < 2 {
        return Vec::new();
    }
    (0..runs.len())
        .into_par_iter()
        .map(|i| {
            let (mut others, run) = (runs.to_vec(), &runs[i]);
            others.remove(i);
            let law = fit(&others).ok();
            let law = law.and_then(|(form, free)| form.law(&free, f64::MAX));
            let pulse = law.and_then(|law| Pulse::of(&law, run.energy, run.max_flattening));
            predict(pulse.as_ref(), run)
        })
        .collect()
}

/// Errors of a pulse, NaN without one.
fn predict(pulse: Option<&Pulse>, run: &Run) -> LeftOut {
    let error = |of: &dyn Fn(&Pulse) -> f64| pulse.map_or(f64::NAN, of);
    LeftOut {
        velocity: run.velocity,
        max_force: error(&|p| p.force / run.max_force - 1.0),
        max_displacement: error(&|p| p.flattening / run.max_flattening - 1.0),
        restitution: error(&|p| restitution_error(p.restitution, run.restitution)),
    }
}
