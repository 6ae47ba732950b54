//! Fit of a code's own model to a law: restitution, largest force and contact time over the law's speeds.

use crate::contact::rebound::{Rebound, rebound};
use crate::contact::{LawVisitor, NormalLaw};
use crate::export::source::portable::Portable;
use crate::{Error, Result};
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::neldermead::NelderMead;

/// Speeds of a projection, evenly spaced on a logarithmic axis.
const SPEEDS: usize = 5;
/// Edge of the first simplex, in logarithms.
const SIMPLEX_EDGE: f64 = 0.3;
/// Steps of the simplex; it is started twice.
const SIMPLEX_STEPS: u64 = 300;
/// Spread of the cost over the simplex at which it stops.
const SIMPLEX_SPREAD: f64 = 1e-9;

/// Impacts of a body on a wall under the law: what a projection is fitted to and judged by.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Radius, m.
    pub radius: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Speed and figures, slowest first.
    pub impacts: Vec<(f64, Rebound)>,
}

/// Figures of the law, inertia included, over its range of speeds.
#[must_use]
pub fn target(law: &Portable) -> Target {
    let radius = law.radius();
    let mass = law.material().sphere_mass(radius);
    let (slow, fast) = (
        law.file.valid.velocity_min_m_s,
        law.file.valid.velocity_max_m_s,
    );
    let count = if fast > slow { SPEEDS } else { 1 };
    let speed = |k: usize| slow * (fast / slow).powf(k as f64 / (SPEEDS - 1) as f64);
    let speeds: Vec<f64> = (0..count).map(speed).collect();
    Target {
        radius,
        mass,
        impacts: law.full.visit(Impacts {
            radius,
            mass,
            speeds,
        }),
    }
}

struct Impacts {
    radius: f64,
    mass: f64,
    speeds: Vec<f64>,
}

impl LawVisitor for Impacts {
    type Output = Vec<(f64, Rebound)>;

    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
        let hit = |v| (v, rebound(law, self.radius, self.mass, v));
        self.speeds.into_iter().map(hit).collect()
    }
}

impl Target {
    /// Figures of another law at the same speeds.
    #[must_use]
    pub fn figures<L: NormalLaw>(&self, law: &L) -> Vec<Rebound> {
        let hit = |(v, _): &(f64, Rebound)| rebound(law, self.radius, self.mass, *v);
        self.impacts.iter().map(hit).collect()
    }

    /// Relative errors of e, F* and contact time, one row a speed.
    #[must_use]
    pub fn errors(&self, figures: &[Rebound]) -> Vec<[f64; 3]> {
        let row = |((_, ours), theirs): (&(f64, Rebound), &Rebound)| {
            [
                theirs.restitution / ours.restitution - 1.0,
                theirs.max_force / ours.max_force - 1.0,
                theirs.contact_time / ours.contact_time - 1.0,
            ]
        };
        self.impacts.iter().zip(figures).map(row).collect()
    }

    /// The impact in the middle of the speeds.
    #[must_use]
    pub fn middle(&self) -> &Rebound {
        &self.impacts[self.impacts.len() / 2].1
    }

    /// Largest flattening over radius of any impact.
    #[must_use]
    pub fn deepest(&self) -> f64 {
        let depth = |(_, hit): &(f64, Rebound)| hit.max_displacement / self.radius;
        self.impacts.iter().map(depth).fold(0.0, f64::max)
    }
}

/// A model whose numbers are all positive, seen by the simplex through their logarithms.
struct Problem<'a, B> {
    target: &'a Target,
    build: B,
}

impl<L: NormalLaw, B: Fn(&[f64]) -> L> CostFunction for Problem<'_, B> {
    type Param = Vec<f64>;
    type Output = f64;

    /// Sum of squared logarithms of the ratios of e, F* and contact time.
    fn cost(&self, logs: &Vec<f64>) -> std::result::Result<f64, argmin::core::Error> {
        let numbers: Vec<f64> = logs.iter().map(|log| log.exp()).collect();
        let figures = self.target.figures(&(self.build)(&numbers));
        let errors = self.target.errors(&figures);
        let cost: f64 = errors
            .iter()
            .flatten()
            .map(|e| (1.0 + e).ln().powi(2))
            .sum();
        // a simplex needs comparable numbers: a model that cannot stop the body is worse than any that can
        Ok(if cost.is_finite() {
            cost
        } else {
            f64::MAX.sqrt()
        })
    }
}

/// Numbers (all positive) of the model `build` at the least cost, from `start`.
///
/// # Errors
/// [`Error::Fit`] when the simplex stops without a result.
pub fn project<L: NormalLaw>(
    target: &Target,
    start: &[f64],
    build: impl Fn(&[f64]) -> L + Copy,
) -> Result<Vec<f64>> {
    let failed = |e: argmin::core::Error| Error::Fit {
        reason: format!("the simplex of a native model stopped: {e}"),
    };
    let mut logs: Vec<f64> = start.iter().map(|number| number.ln()).collect();
    for edge in [SIMPLEX_EDGE, 0.1 * SIMPLEX_EDGE] {
        let mut corners = vec![logs.clone()];
        for i in 0..logs.len() {
            let mut moved = logs.clone();
            moved[i] += edge;
            corners.push(moved);
        }
        let solver = NelderMead::new(corners)
            .with_sd_tolerance(SIMPLEX_SPREAD)
            .map_err(failed)?;
        let result = Executor::new(Problem { target, build }, solver)
            .configure(|state| state.max_iters(SIMPLEX_STEPS))
            .timer(false)
            .run()
            .map_err(failed)?;
        if let Some(best) = result.state().get_best_param() {
            logs.clone_from(best);
        }
    }
    Ok(logs.iter().map(|log| log.exp()).collect())
}
