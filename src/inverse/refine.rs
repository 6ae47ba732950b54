//! Refinement: real impacts at the estimate say by what factor the atlas is off there, and the estimate is made again with that.

use super::measurement::{Figure, velocities};
use super::search::{Estimate, Problem};
use crate::Result;
use crate::material::Material;

/// Most speeds at which impacts are run; between them the factor is linear over the logarithm of the speed.
pub const MOST_SPEEDS: usize = 5;
/// Most rounds.
const ROUNDS: usize = 6;

/// What an impact that was run says of the figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// e.
    pub restitution: f64,
    /// 1 - H_d/D.
    pub compression_ratio: f64,
    /// Largest contact radius over R.
    pub contact_radius: f64,
}

/// A round of refinement.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// Y and H that were run, Pa.
    pub constants: [f64; 2],
    /// Speeds that were run, m/s.
    pub velocities: Vec<f64>,
    /// Figures of the runs over those of the atlas.
    pub factors: Vec<[f64; 3]>,
    /// Y and H after it, Pa.
    pub found: [f64; 2],
}

/// Speeds that are run: all there are, or [`MOST_SPEEDS`] spread over their logarithms.
#[must_use]
pub fn speeds(problem: &Problem<'_>) -> Vec<f64> {
    let all = velocities(&problem.rows);
    if all.len() <= MOST_SPEEDS {
        return all;
    }
    let [low, high] = [all[0].ln(), all[all.len() - 1].ln()];
    (0..MOST_SPEEDS)
        .map(|k| match k {
            0 => all[0],
            k if k == MOST_SPEEDS - 1 => all[all.len() - 1],
            k => (low + (high - low) * k as f64 / (MOST_SPEEDS - 1) as f64).exp(),
        })
        .collect()
}

/// Corrects the model of `problem` by runs until the estimate moves by less than `least` (relative); the last estimate, the
/// rounds, and whether they settled.
///
/// # Errors
/// Those of `run` and of [`Problem::estimate`].
pub fn refine(
    problem: &mut Problem<'_>,
    estimate: Estimate,
    least: f64,
    mut run: impl FnMut(&Material, &[f64]) -> Result<Vec<Run>>,
) -> Result<(Estimate, Vec<Round>, bool)> {
    let velocities = speeds(problem);
    let known = problem.model.known;
    let (mut estimate, mut rounds) = (estimate, Vec::new());
    for _ in 0..ROUNDS {
        let before = estimate.point.constants(&known);
        let material = known.material(&estimate.point);
        let runs = run(&material, &velocities)?;
        let told = problem.model.told(&estimate.point, &velocities)?;
        let both = told.iter().zip(&runs);
        let factors: Vec<[f64; 3]> = both
            .map(|(told, run)| Figure::ALL.map(|kind| of_run(kind, run) / told[kind as usize]))
            .collect();
        let nodes = velocities.iter().zip(&factors);
        problem.model.correction.nodes = nodes
            .map(|(velocity, factors)| (velocity.ln(), factors.map(f64::ln)))
            .collect();
        estimate = problem.estimate()?;
        let found = estimate.point.constants(&known);
        rounds.push(Round {
            constants: before,
            velocities: velocities.clone(),
            factors,
            found,
        });
        // hardening counts by what it adds to the strength
        let moved = (0..2).map(|k| (found[k] - before[k]).abs() / before[0].max(before[k]));
        if moved.fold(0.0, f64::max) < least {
            return Ok((estimate, rounds, true));
        }
    }
    Ok((estimate, rounds, false))
}

fn of_run(kind: Figure, run: &Run) -> f64 {
    match kind {
        Figure::Restitution => run.restitution,
        Figure::CompressionRatio => run.compression_ratio,
        Figure::FlatDiameter => run.contact_radius,
    }
}
