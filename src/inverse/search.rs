//! The material whose impacts are nearest to the measured ones.

use super::measurement::{Figure, Measurement, velocities};
use super::model::{Known, Model, Point};
use crate::atlas::{Atlas, Place};
use crate::fit::marquardt::{Stop, minimise};
use crate::material::YIELD_PRESSURE_RATIO;
use crate::unit::{engineering, significant};
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknowns {
    /// Y, at the hardening modulus that is known.
    Yield,
    /// Y and H.
    YieldAndHardening,
}

impl Unknowns {
    /// How many.
    #[must_use]
    pub fn count(self) -> usize {
        match self {
            Unknowns::Yield => 1,
            Unknowns::YieldAndHardening => 2,
        }
    }
}

/// Measurements, and the model that is to give them.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem<'a> {
    /// Model.
    pub model: Model<'a>,
    /// Measurements.
    pub rows: Vec<Measurement>,
    /// What is sought.
    pub unknowns: Unknowns,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The material.
    pub point: Point,
    /// Figures of the model, a row each.
    pub predicted: Vec<f64>,
    /// Standard deviations of the rows, those of the speeds among them; by the scatter of the rows where none are given.
    pub sigmas: Vec<f64>,
    /// Sum of the squares of the residuals over the deviations; of the residuals themselves where no deviation is given.
    pub chi_square: f64,
    /// Rows less unknowns.
    pub freedom: usize,
    /// Whether the deviations are those of the scatter.
    pub by_scatter: bool,
}

/// Points of the first search: of the strength, and of the hardening.
const SCAN: [usize; 2] = [60, 12];
/// Rounds in which deviations by speed follow the estimate.
const ROUNDS: usize = 3;
/// Step of difference quotients.
pub const DIFFERENCE: f64 = 1e-4;
/// When to stop.
const STOP: Stop = Stop {
    steps: 60,
    fall: 1e-12,
};
/// Least scatter of rows: rounding.
const LEAST_SCATTER: f64 = 1e-12;
/// As near to an end of the range, in logarithms, an estimate is at it.
pub const AT_THE_END: f64 = 1e-3;

impl<'a> Problem<'a> {
    /// A problem that can have an answer.
    ///
    /// # Errors
    /// [`Error::Refused`] for rows that cannot tell what is sought: fewer speeds and figures than unknowns, no uncertainty to judge
    /// them by, speeds too far apart for the atlas, or a material outside it.
    pub fn new(
        atlas: &'a Atlas,
        known: Known,
        rows: Vec<Measurement>,
        unknowns: Unknowns,
    ) -> Result<Self> {
        let mut kinds: Vec<Figure> = rows.iter().map(|row| row.figure).collect();
        kinds.sort();
        kinds.dedup();
        let mut told: Vec<(u64, Figure)> = rows
            .iter()
            .map(|row| (row.velocity.to_bits(), row.figure))
            .collect();
        told.sort();
        told.dedup();
        if told.len() < unknowns.count() {
            return Err(refuse(
                "measurements",
                format!(
                    "one speed ({} m/s)",
                    rows.first().map_or(0.0, |r| r.velocity)
                ),
                "must be at two speeds at least to tell yield strength and hardening apart",
            ));
        }
        let with = rows.iter().filter(|row| row.sigma.is_some()).count();
        if with < rows.len() {
            let bare = rows.iter().find(|row| row.sigma.is_none());
            let line = bare.map_or(0, |row| row.line);
            if with > 0 {
                return Err(refuse(
                    "uncertainties",
                    format!("none in line {line}, but in others"),
                    "must be given for every row, by its column or by --sigma-..., or for none",
                ));
            }
            if kinds.len() > 1 {
                return Err(refuse(
                    "uncertainties",
                    "none, of figures of several kinds".to_owned(),
                    "must be given: nothing else tells what one weighs against the other",
                ));
            }
            if rows.len() <= unknowns.count() {
                return Err(refuse(
                    "uncertainties",
                    format!("none, and {} rows", rows.len()),
                    "must be given (a column such as `restitution_sigma`, or --sigma-restitution): more rows than unknowns would tell it by their scatter",
                ));
            }
        }
        let problem = Problem {
            model: Model {
                atlas,
                known,
                correction: super::model::Correction::default(),
            },
            rows,
            unknowns,
        };
        problem.check_range()?;
        Ok(problem)
    }

    /// That the atlas knows some strength for which it knows all the speeds.
    fn check_range(&self) -> Result<()> {
        let known = &self.model.known;
        let range = &self.model.atlas.range;
        let [low, high] = self.strengths();
        let speeds = velocities(&self.rows);
        let text = |v: Option<&f64>| engineering(v.copied().unwrap_or(0.0), "m/s", 4);
        if low >= high {
            let [slow, fast] = range.severity;
            return Err(refuse(
                "speeds",
                format!("{} to {}", text(speeds.first()), text(speeds.last())),
                &format!(
                    "no strength has all of them within rho V^2/Y from {} to {} and E/Y from {} to {}, the range of the atlas; leave out rows",
                    significant(slow, 3),
                    significant(fast, 3),
                    significant(range.young_over_yield[0], 4),
                    significant(range.young_over_yield[1], 4)
                ),
            ));
        }
        let point = Point {
            strength: 0.5 * (low + high),
            hardening: self.sought(0.0),
        };
        range.check(&Place::of(&known.material(&point))?)
    }

    fn sought(&self, hardening: f64) -> Option<f64> {
        (self.unknowns == Unknowns::YieldAndHardening).then_some(hardening)
    }

    /// Smallest and largest $\ln Y$ of which the atlas knows all the speeds.
    #[must_use]
    pub fn strengths(&self) -> [f64; 2] {
        let Known {
            density,
            young_modulus,
            ..
        } = self.model.known;
        let range = &self.model.atlas.range;
        let speeds = velocities(&self.rows);
        let of = |v: Option<&f64>| density * v.map_or(0.0, |v| v * v);
        let [slow, fast] = range.severity;
        let [soft, stiff] = range.young_over_yield;
        let low = (of(speeds.last()) / fast).max(young_modulus / stiff);
        let high = (of(speeds.first()) / slow).min(young_modulus / soft);
        // the ends themselves may round out of the range
        [low.ln() + 1e-9, high.ln() - 1e-9]
    }

    /// Largest $\ln(1 + H/Y)$ at a strength.
    #[must_use]
    pub fn largest_hardening(&self, strength: f64) -> f64 {
        let most = self.model.atlas.range.hardening_over_young[1] * self.model.known.young_modulus;
        (most / strength.exp()).ln_1p() - 1e-12
    }

    /// Whether the atlas knows a point.
    #[must_use]
    pub fn holds(&self, point: &Point) -> bool {
        let [low, high] = self.strengths();
        let hardening = point.hardening.unwrap_or(0.0);
        (low..=high).contains(&point.strength)
            && (0.0..=self.largest_hardening(point.strength)).contains(&hardening)
    }

    /// The point of numbers: $\ln Y$, and $\ln(1 + H/Y)$ if it is there.
    fn point(&self, numbers: &[f64]) -> Point {
        Point {
            strength: numbers[0],
            hardening: self.sought(numbers.get(1).copied().unwrap_or(0.0)),
        }
    }

    /// Figures at a point, at the speeds as they were measured.
    #[must_use]
    pub fn predicted(&self, point: &Point) -> Option<Vec<f64>> {
        let speeds: Vec<f64> = self.rows.iter().map(|row| row.velocity).collect();
        match self.holds(point) {
            true => self.model.figures(point, &self.rows, &speeds),
            false => None,
        }
    }

    /// Numbers of least cost for these values of the rows.
    pub fn nearest(&self, values: &[f64], sigmas: &[f64]) -> Option<(Point, f64)> {
        let residuals = |numbers: &[f64]| {
            let predicted = self.predicted(&self.point(numbers))?;
            let each = predicted.iter().zip(values).zip(sigmas);
            Some(each.map(|((p, v), s)| (p - v) / s).collect::<Vec<f64>>())
        };
        let cost = |numbers: &[f64]| {
            residuals(numbers).map_or(f64::INFINITY, |r| r.iter().map(|x| x * x).sum())
        };
        let [low, high] = self.strengths();
        let mut starts: Vec<Vec<f64>> = Vec::new();
        for i in 0..SCAN[0] {
            let strength = low + (high - low) * (i as f64 + 0.5) / SCAN[0] as f64;
            starts.push(vec![strength]);
            let most = self.largest_hardening(strength);
            for j in (0..SCAN[1]).filter(|_| self.unknowns == Unknowns::YieldAndHardening) {
                starts.push(vec![strength, most * (j as f64 + 0.5) / SCAN[1] as f64]);
            }
        }
        // without hardening is the edge of what may be: it is searched for itself
        let mut best: Option<(Vec<f64>, f64)> = None;
        for length in 1..=self.unknowns.count() {
            let of = starts.iter().filter(|start| start.len() == length);
            let costs = of.map(|start| (start, cost(start)));
            let Some((start, _)) = costs.min_by(|a, b| a.1.total_cmp(&b.1)) else {
                continue;
            };
            let normal = |numbers: &[f64]| normal(numbers, &residuals);
            let found = minimise(start, STOP, cost, normal);
            if best.as_ref().is_none_or(|(_, least)| found.1 < *least) {
                best = Some(found);
            }
        }
        let (numbers, least) = best?;
        least.is_finite().then(|| (self.point(&numbers), least))
    }

    /// The estimate.
    ///
    /// # Errors
    /// [`Error::Refused`] where it lies at an end of the atlas' range, and for a row that tells nothing at the estimate.
    pub fn estimate(&self) -> Result<Estimate> {
        let values: Vec<f64> = self.rows.iter().map(|row| row.value).collect();
        let nothing = || {
            refuse(
                "measurements",
                "no material of the atlas that gives them".to_owned(),
                "check modulus, density and units, or leave out the fastest and the slowest rows",
            )
        };
        let mut sigmas: Vec<f64> = self.rows.iter().map(|r| r.sigma.unwrap_or(1.0)).collect();
        let (mut point, mut chi_square) = self.nearest(&values, &sigmas).ok_or_else(nothing)?;
        let by_scatter = self.rows.iter().any(|row| row.sigma.is_none());
        if !by_scatter {
            for _ in 1..ROUNDS {
                sigmas = self.sigmas(&point).ok_or_else(nothing)?;
                (point, chi_square) = self.nearest(&values, &sigmas).ok_or_else(nothing)?;
            }
        }
        self.check_ends(&point)?;
        let predicted = self.predicted(&point).ok_or_else(nothing)?;
        let freedom = self.rows.len() - self.unknowns.count().min(self.rows.len());
        if by_scatter {
            let scatter = (chi_square / freedom.max(1) as f64)
                .sqrt()
                .max(LEAST_SCATTER);
            sigmas.fill(scatter);
        }
        Ok(Estimate {
            point,
            predicted,
            sigmas,
            chi_square,
            freedom,
            by_scatter,
        })
    }

    /// Standard deviations of the rows, with what the speed's and their own radius' do to them.
    fn sigmas(&self, point: &Point) -> Option<Vec<f64>> {
        let at = |share: f64| {
            let speeds: Vec<f64> = self.rows.iter().map(|r| r.velocity * share).collect();
            self.model.figures(point, &self.rows, &speeds)
        };
        let (up, down) = (at(1.0 + DIFFERENCE)?, at(1.0 - DIFFERENCE)?);
        let one = |((row, up), down): ((&Measurement, &f64), &f64)| {
            let slope = (up - down) / (2.0 * DIFFERENCE);
            let parts = [
                row.sigma.unwrap_or(1.0),
                slope * row.velocity_sigma,
                row.radius_slope * row.radius_sigma,
            ];
            parts.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        let rows = self.rows.iter().zip(&up).zip(&down);
        Some(rows.map(one).collect())
    }

    /// That an estimate is no end of the range, and that every row yields there.
    fn check_ends(&self, point: &Point) -> Result<()> {
        let [low, high] = self.strengths();
        let range = &self.model.atlas.range;
        let known = &self.model.known;
        let at = |what: &str| {
            let strength = engineering(point.strength.exp(), "Pa", 4);
            refuse(
                "estimate",
                format!("a yield strength of {strength} or {what}"),
                &format!(
                    "the impacts must lie within the atlas (E/Y {} to {}, rho V^2/Y {} to {}); check modulus, density and units, or leave out the {} rows",
                    significant(range.young_over_yield[0], 4),
                    significant(range.young_over_yield[1], 4),
                    significant(range.severity[0], 3),
                    significant(range.severity[1], 3),
                    if what == "less" { "fastest" } else { "slowest" }
                ),
            )
        };
        if point.strength - low < AT_THE_END {
            return Err(at("less"));
        }
        if high - point.strength < AT_THE_END {
            return Err(at("more"));
        }
        if let Some(hardening) = point.hardening
            && self.largest_hardening(point.strength) - hardening < AT_THE_END
        {
            return Err(refuse(
                "estimate",
                format!(
                    "a hardening modulus of {} or more",
                    engineering(point.constants(known)[1], "Pa", 4)
                ),
                &format!(
                    "H/E must be at most {}, the range of the atlas",
                    significant(range.hardening_over_young[1], 3)
                ),
            ));
        }
        let first = known.material(point).yield_point(1.0, YIELD_PRESSURE_RATIO);
        let first = first.map_or(0.0, |first| first.velocity);
        match self.rows.iter().find(|row| row.velocity <= first) {
            Some(row) => Err(refuse(
                &format!("line {}", row.line),
                engineering(row.velocity, "m/s", 4),
                &format!(
                    "must be above {}, the speed of first yield at the estimate of {}: a slower impact tells nothing of it; leave it out",
                    engineering(first, "m/s", 4),
                    engineering(point.strength.exp(), "Pa", 4)
                ),
            )),
            None => Ok(()),
        }
    }
}

/// Refusal.
pub(super) fn refuse(what: &str, found: String, allowed: &str) -> Error {
    Error::Refused {
        what: what.to_owned(),
        found,
        allowed: allowed.to_owned(),
    }
}

/// Normal equations by difference quotients; one-sided at an edge, `None` where there are none.
fn normal(
    numbers: &[f64],
    residuals: &impl Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let here = residuals(numbers)?;
    let mut slopes = DMatrix::zeros(here.len(), numbers.len());
    for k in 0..numbers.len() {
        let at = |step: f64| {
            let mut moved = numbers.to_vec();
            moved[k] += step;
            residuals(&moved)
        };
        let (up, down) = (at(DIFFERENCE), at(-DIFFERENCE));
        let width =
            DIFFERENCE * (f64::from(u8::from(up.is_some())) + f64::from(u8::from(down.is_some())));
        if width == 0.0 {
            return None;
        }
        let (up, down) = (up.unwrap_or(here.clone()), down.unwrap_or(here.clone()));
        for i in 0..here.len() {
            slopes[(i, k)] = (up[i] - down[i]) / width;
        }
    }
    let matrix = slopes.transpose() * &slopes;
    let right = -(slopes.transpose() * DVector::from_vec(here));
    Some((matrix, right))
}
