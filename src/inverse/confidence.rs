//! Intervals of an estimate: the same estimate of measurements that are drawn around it.
//!
//! A draw makes the figures of the material that was found, at speeds, a modulus and radii that are off by their standard deviations, adds
//! the noise of the rows, and if wanted the error of the atlas, and estimates again with the nominal numbers. Each draw has a
//! random stream of its own, so that the intervals are the same bits for any number of threads.

use super::measurement::Measurement;
use super::model::{DEVIATIONS, Point};
use super::search::{AT_THE_END, DIFFERENCE, Estimate, Problem, refuse};
use crate::Result;
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// How intervals are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Draws.
    pub draws: usize,
    /// Seed.
    pub seed: u64,
    /// Standard deviation of Young's modulus, relative.
    pub young_modulus: f64,
    /// Standard deviation of the radius that rows without their own share, relative.
    pub radius: f64,
    /// Whether the atlas itself is off by its errors.
    pub atlas: bool,
}

/// 95 % intervals of Y and H.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Of Y, Pa.
    pub strength: [f64; 2],
    /// Of H, Pa; both the value that is known where it is not sought.
    pub hardening: [f64; 2],
}

/// Part of the draws beyond either end of an interval.
const TAIL: f64 = 0.025;
/// Steps with slopes that are kept; what has not settled then is searched for anew.
const STEPS: usize = 12;
/// Change of the logarithms that counts as settled.
const SETTLED: f64 = 1e-5;

/// Slopes of the rows over the numbers, over the deviations.
struct Slopes {
    columns: DMatrix<f64>,
    /// Of all numbers, and of the strength alone.
    inverse: DMatrix<f64>,
    strength: f64,
}

impl Slopes {
    fn of(problem: &Problem<'_>, estimate: &Estimate) -> Option<Self> {
        let count = problem.unknowns.count();
        let mut columns = DMatrix::zeros(problem.rows.len(), count);
        for k in 0..count {
            let at = |step: f64| {
                let mut point = estimate.point;
                match k {
                    0 => point.strength += step,
                    _ => point.hardening = point.hardening.map(|h| h + step),
                }
                problem.predicted(&point)
            };
            let (up, down) = (at(DIFFERENCE), at(-DIFFERENCE));
            let sides = u8::from(up.is_some()) + u8::from(down.is_some());
            let here = &estimate.predicted;
            let (up, down) = (up.unwrap_or(here.clone()), down.unwrap_or(here.clone()));
            for i in 0..here.len() {
                let slope = (up[i] - down[i]) / (DIFFERENCE * f64::from(sides));
                columns[(i, k)] = slope / estimate.sigmas[i];
            }
        }
        let inverse = (columns.transpose() * &columns).try_inverse()?;
        let strength = columns.column(0).norm_squared();
        let whole = inverse.iter().all(|x| x.is_finite()) && strength > 0.0;
        whole.then_some(Slopes {
            columns,
            inverse,
            strength,
        })
    }
}

/// Standard normal numbers of a draw.
struct Noise {
    random: Pcg64,
    normal: Normal,
}

impl Noise {
    fn of(seed: u64, draw: u64) -> Self {
        let seed = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(draw);
        Noise {
            random: Pcg64::seed_from_u64(seed),
            normal: Normal::standard(),
        }
    }

    fn next(&mut self) -> f64 {
        let share: f64 = self.random.random_range(f64::EPSILON..1.0);
        self.normal.inverse_cdf(share)
    }
}

/// Numbers that the rows of one key share: each key gets one draw, in the order of its first row.
struct Shared<K>(Vec<(K, f64)>);

impl<K: PartialEq> Shared<K> {
    fn of(&mut self, key: K, noise: &mut Noise) -> f64 {
        match self.0.iter().find(|(known, _)| *known == key) {
            Some((_, value)) => *value,
            None => {
                let value = noise.next();
                self.0.push((key, value));
                value
            }
        }
    }
}

/// Measurements of the material that was found, as they might have come out.
fn drawn(
    problem: &Problem<'_>,
    estimate: &Estimate,
    sampling: &Sampling,
    errors: &[f64],
    draw: u64,
) -> Option<Vec<f64>> {
    let noise = &mut Noise::of(sampling.seed, draw);
    let (young, radius) = (noise.next(), noise.next());
    let (mut speed, mut size) = (Shared(Vec::new()), Shared(Vec::new()));
    let (mut common, mut own) = (Shared(Vec::new()), Shared(Vec::new()));
    let mut velocities = Vec::with_capacity(problem.rows.len());
    let mut others = Vec::with_capacity(problem.rows.len());
    for row in &problem.rows {
        let (fast, large) = (speed.of(row.line, noise), size.of(row.line, noise));
        // half of the atlas' variance is the same at all speeds, half that of each speed: a material each tells no more
        let both =
            common.of(row.figure, noise) + own.of((row.figure, row.velocity.to_bits()), noise);
        velocities.push(row.velocity * (row.velocity_sigma * fast).exp());
        others.push((large, both * 0.5f64.sqrt(), noise.next()));
    }
    let mut model = problem.model.clone();
    model.known.young_modulus *= (sampling.young_modulus * young).exp();
    // what was found is Y and H: the same of another modulus
    let truth = model.figures(&estimate.point, &problem.rows, &velocities)?;
    let one = |(i, row): (usize, &Measurement)| {
        let (large, off, rest) = others[i];
        let value = truth[i] + errors[i] * off;
        let sizes = match row.radius_sigma {
            0.0 => sampling.radius * radius,
            own => own * large,
        };
        let sigma = match estimate.by_scatter {
            true => estimate.sigmas[i],
            false => row.sigma.unwrap_or(0.0),
        };
        value + row.radius_slope * sizes + sigma * rest
    };
    Some(problem.rows.iter().enumerate().map(one).collect())
}

/// Estimate of drawn values, and whether it lies at an end of what the atlas knows.
fn again(
    problem: &Problem<'_>,
    estimate: &Estimate,
    slopes: &Slopes,
    values: &[f64],
) -> Option<(Point, bool)> {
    let [low, high] = problem.strengths();
    let mut point = estimate.point;
    let mut predicted = estimate.predicted.clone();
    for _ in 0..STEPS {
        let each = values.iter().zip(&predicted).zip(&estimate.sigmas);
        let off = DVector::from_iterator(values.len(), each.map(|((v, p), s)| (v - p) / s));
        let downhill = slopes.columns.transpose() * &off;
        let step = &slopes.inverse * &downhill;
        let mut next = point;
        next.strength += step[0];
        if let Some(hardening) = &mut next.hardening {
            *hardening += step[1];
            if *hardening < 0.0 {
                // no hardening, and the strength that goes with that: the part of the rows that the way there leaves
                let moved = point.hardening.unwrap_or(0.0);
                let left = off + slopes.columns.column(1) * moved;
                *hardening = 0.0;
                next.strength =
                    point.strength + slopes.columns.column(0).dot(&left) / slopes.strength;
            }
            let most = problem.largest_hardening(next.strength.clamp(low, high));
            *hardening = hardening.min(most);
        }
        next.strength = next.strength.clamp(low, high);
        if let Some(hardening) = &mut next.hardening {
            *hardening = hardening.min(problem.largest_hardening(next.strength));
        }
        let moved = (next.strength - point.strength).abs()
            + (next.hardening.unwrap_or(0.0) - point.hardening.unwrap_or(0.0)).abs();
        point = next;
        if moved < SETTLED {
            return Some((point, at_end(problem, &point)));
        }
        predicted = problem.predicted(&point)?;
    }
    let (point, _) = problem.nearest(values, &estimate.sigmas)?;
    Some((point, at_end(problem, &point)))
}

/// Whether a point lies at an end of the range; no hardening is none.
fn at_end(problem: &Problem<'_>, point: &Point) -> bool {
    let [low, high] = problem.strengths();
    let strength = point.strength - low < AT_THE_END || high - point.strength < AT_THE_END;
    let most = problem.largest_hardening(point.strength);
    strength || point.hardening.is_some_and(|h| most - h < AT_THE_END)
}

/// 95 % interval of an estimate.
///
/// # Errors
/// [`crate::Error::Refused`] where the rows do not tell the numbers: their slopes vanish, or one draw in forty ends at an end of the atlas.
pub fn intervals(
    problem: &Problem<'_>,
    estimate: &Estimate,
    sampling: &Sampling,
) -> Result<Interval> {
    let known = &problem.model.known;
    let open = |what: &str| {
        let [strength, hardening] = estimate.point.constants(known);
        refuse(
            "estimate",
            format!(
                "a yield strength of about {}{}",
                crate::unit::engineering(strength, "Pa", 3),
                match estimate.point.hardening {
                    Some(_) => format!(
                        " and a hardening modulus of about {}",
                        crate::unit::engineering(hardening, "Pa", 3)
                    ),
                    None => String::new(),
                }
            ),
            &format!(
                "these rows do not determine it: {what}; more rows, smaller uncertainties or speeds further apart would"
            ),
        )
    };
    let slopes = Slopes::of(problem, estimate)
        .ok_or_else(|| open("it changes none of their figures, or both do the same"))?;
    let errors = match sampling.atlas {
        true => problem.model.errors(&estimate.point, &problem.rows),
        false => Some(vec![0.0; problem.rows.len()]),
    };
    let errors = errors.ok_or_else(|| open("the atlas has no law there"))?;
    let all: Vec<Option<(Point, bool)>> = (0..sampling.draws as u64)
        .into_par_iter()
        .map(|draw| {
            let values = drawn(problem, estimate, sampling, &errors, draw)?;
            again(problem, estimate, &slopes, &values)
        })
        .collect();
    let ended = all
        .iter()
        .filter(|one| !matches!(one, Some((_, false))))
        .count();
    if ended as f64 > TAIL * sampling.draws as f64 {
        return Err(open(&format!(
            "{ended} of {} draws from their uncertainties end at an end of the atlas",
            sampling.draws
        )));
    }
    let found: Vec<Point> = all.into_iter().flatten().map(|(point, _)| point).collect();
    // by the scatter of few rows a deviation is itself uncertain
    let wider = match estimate.by_scatter {
        true => StudentsT::new(0.0, 1.0, estimate.freedom as f64)
            .map_or(1.0, |t| t.inverse_cdf(1.0 - TAIL) / DEVIATIONS),
        false => 1.0,
    };
    let ends = |value: &dyn Fn(&Point) -> f64| {
        let mut values: Vec<f64> = found.iter().map(value).collect();
        values.sort_by(f64::total_cmp);
        let here = value(&estimate.point);
        [TAIL, 1.0 - TAIL].map(|share| {
            let at = values[(share * (values.len() - 1) as f64).round() as usize];
            here + wider * (at - here)
        })
    };
    let strength = ends(&|point| point.strength).map(f64::exp);
    let hardening = match estimate.point.hardening {
        Some(_) => ends(&|point| point.constants(known)[1]).map(|h| h.max(0.0)),
        None => [known.hardening; 2],
    };
    Ok(Interval {
        strength,
        hardening,
    })
}
