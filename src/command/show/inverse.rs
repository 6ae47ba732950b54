//! What `inverse` found: the report it writes, its text in the terminal, and the case of the material.

use crate::Result;
use crate::case::Case;
use crate::document::Document;
use crate::inverse::confidence::{Interval, Sampling};
use crate::inverse::refine::Round;
use crate::inverse::search::{Estimate, Problem, Unknowns};
use crate::material::flow::YIELD_STRENGTH;
use crate::material::{Flow, Material};
use crate::unit::{engineering, significant};
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::fmt::Write;
use std::path::Path;

/// The case with the material that was found.
pub struct FoundCase<'a> {
    /// R, m.
    pub radius: f64,
    /// Speeds, m/s.
    pub velocities: &'a [f64],
    /// Tolerance.
    pub tolerance: f64,
}

/// Hardening over the strength below which it is none in a case file.
const LEAST_HARDENING: f64 = 1e-3;

impl FoundCase<'_> {
    /// Its text, which reads back.
    ///
    /// # Errors
    /// Those of reading it: a value that looks like a slip of a unit.
    pub fn text(&self, material: &Material) -> Result<String> {
        let speeds = self.velocities.iter().map(|v| format!("\"{v} m/s\""));
        let mut text = format!(
            "[particle]\nradius = \"{:e} m\"\n[material]\ndensity = \"{} kg/m3\"\nyoung_modulus = \"{:e} Pa\"\npoisson_ratio = {}\n",
            self.radius, material.density, material.young_modulus, material.poisson_ratio
        );
        for (constant, value) in material.flow.iter().flat_map(Flow::constants) {
            let strength = material.flow.map_or(0.0, |flow| flow.yield_strength());
            if constant == YIELD_STRENGTH || value >= LEAST_HARDENING * strength {
                let _ = writeln!(text, "{} = \"{value:e} Pa\"", constant.key);
            }
        }
        let _ = write!(
            text,
            "[impact]\nvelocities = [{}]\n[accuracy]\ntolerance = {}\n",
            speeds.collect::<Vec<_>>().join(", "),
            self.tolerance
        );
        Case::from_document(&Document::new(Path::new("case of the material"), &text[..]))?;
        Ok(text)
    }
}

/// What was asked for, besides the measurements.
#[derive(Debug, Clone, Copy)]
pub struct Asked {
    /// Draws, and uncertainties that all rows share.
    pub sampling: Sampling,
    /// Standard deviation of speeds without their own, relative.
    pub velocity: f64,
    /// R, m.
    pub radius: f64,
    /// Flats are taken for spherical caps.
    pub cap: bool,
    /// Tolerance of the runs that corrected the atlas, if any did.
    pub refined: Option<f64>,
}

/// What is written.
#[derive(Debug, Serialize)]
pub struct Report {
    estimate: Found,
    assumed: Assumed,
    agreement: Agreement,
    row: Vec<RowOut>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    refinement: Vec<RoundOut>,
}

#[derive(Debug, Serialize)]
struct Found {
    #[serde(rename = "yield_strength_Pa")]
    strength: f64,
    /// 95 %, with the error of the atlas where it was not refined.
    #[serde(rename = "yield_strength_interval_Pa")]
    strength_interval: [f64; 2],
    /// 95 %, by the uncertainties of the measurements alone.
    #[serde(rename = "yield_strength_interval_of_the_measurements_Pa")]
    strength_measured: [f64; 2],
    #[serde(rename = "hardening_modulus_Pa")]
    hardening: f64,
    #[serde(rename = "hardening_modulus_interval_Pa")]
    hardening_interval: [f64; 2],
    #[serde(rename = "hardening_modulus_interval_of_the_measurements_Pa")]
    hardening_measured: [f64; 2],
}

#[derive(Debug, Serialize)]
struct Assumed {
    density_kg_m3: f64,
    #[serde(rename = "young_modulus_Pa")]
    young_modulus: f64,
    young_modulus_sigma_share: f64,
    poisson_ratio: f64,
    hardening_is_sought: bool,
    radius_m: f64,
    radius_sigma_share: f64,
    velocity_sigma_share: f64,
    flats_are_caps: bool,
    draws: usize,
    seed: u64,
    model: String,
    notes: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Agreement {
    /// Of the residuals over their deviations; those of the scatter make it the degrees of freedom.
    chi_square: f64,
    degrees_of_freedom: usize,
    deviations_from_scatter: bool,
    /// Share of measurements with these uncertainties, and the errors of the atlas, that would fit worse.
    worse_share: f64,
}

#[derive(Debug, Serialize)]
struct RowOut {
    line: u64,
    velocity_m_s: f64,
    figure: &'static str,
    measured: f64,
    predicted: f64,
    sigma: f64,
    /// Measured less predicted, over the deviation.
    residual: f64,
}

#[derive(Debug, Serialize)]
struct RoundOut {
    #[serde(rename = "yield_strength_Pa")]
    strength: f64,
    #[serde(rename = "hardening_modulus_Pa")]
    hardening: f64,
    velocities_m_s: Vec<f64>,
    restitution_factors: Vec<f64>,
    compression_ratio_factors: Vec<f64>,
    flat_diameter_factors: Vec<f64>,
    #[serde(rename = "found_yield_strength_Pa")]
    found_strength: f64,
    #[serde(rename = "found_hardening_modulus_Pa")]
    found_hardening: f64,
}

impl RoundOut {
    fn of(round: &Round) -> Self {
        let factors = |k: usize| round.factors.iter().map(|all| all[k]).collect();
        RoundOut {
            strength: round.constants[0],
            hardening: round.constants[1],
            velocities_m_s: round.velocities.clone(),
            restitution_factors: factors(0),
            compression_ratio_factors: factors(1),
            flat_diameter_factors: factors(2),
            found_strength: round.found[0],
            found_hardening: round.found[1],
        }
    }
}

impl Agreement {
    fn of(asked: &Asked, problem: &Problem<'_>, estimate: &Estimate) -> Self {
        // the atlas is off by its own errors, which are none of the measurements'
        let off = match asked.refined {
            None => problem.model.errors(&estimate.point, &problem.rows),
            Some(_) => None,
        };
        let off = off.unwrap_or(vec![0.0; problem.rows.len()]);
        let squares: f64 = (0..problem.rows.len())
            .map(|i| {
                let residual = problem.rows[i].value - estimate.predicted[i];
                (residual / estimate.sigmas[i].hypot(off[i])).powi(2)
            })
            .sum();
        let freedom = estimate.freedom as f64;
        let worse_share = match (estimate.by_scatter, ChiSquared::new(freedom)) {
            (false, Ok(chi)) => chi.sf(squares),
            _ => 1.0,
        };
        Agreement {
            chi_square: match estimate.by_scatter {
                true => freedom,
                false => estimate.chi_square,
            },
            degrees_of_freedom: estimate.freedom,
            deviations_from_scatter: estimate.by_scatter,
            worse_share,
        }
    }
}

/// What to know about an estimate; `first` is the yield strength by the atlas alone, Pa.
fn notes(asked: &Asked, agreement: &Agreement, first: f64) -> Vec<String> {
    let mut notes = vec![match asked.refined {
        None => {
            "the interval holds the error of the atlas with materials left out; --refine removes it"
                .to_owned()
        }
        Some(tolerance) => format!(
            "corrected by impacts of tolerance {tolerance}, whose own error is not in the interval; the atlas alone says {}",
            engineering(first, "Pa", 4)
        ),
    }];
    if agreement.deviations_from_scatter {
        notes.push(
            "no uncertainties given: they are taken from the scatter of the rows, speeds and all"
                .to_owned(),
        );
    }
    let worse = agreement.worse_share;
    if worse < UNLIKELY {
        let rare = match worse > 1e-9 {
            true => significant(1.0 / worse, 2),
            false => "a billion".to_owned(),
        };
        notes.push(format!(
            "the rows are further from any such material than their uncertainties say (one in {rare} would be): other flow stress, \
             modulus or uncertainties; the interval does not hold that"
        ));
    }
    if asked.cap {
        notes.push(
            "flat diameters are taken for spherical caps, which leaves out the pile-up at the rim"
                .to_owned(),
        );
    }
    notes
}

/// Share of worse fits below which the rows are said not to agree.
const UNLIKELY: f64 = 0.01;

impl Report {
    /// Of what was found; the intervals by the measurements alone, and with the error of the atlas.
    #[must_use]
    pub fn of(
        asked: &Asked,
        problem: &Problem<'_>,
        estimate: &Estimate,
        [measured, whole]: [&Interval; 2],
        first: [f64; 2],
        rounds: &[Round],
    ) -> Self {
        let known = &problem.model.known;
        let [strength, hardening] = estimate.point.constants(known);
        let agreement = Agreement::of(asked, problem, estimate);
        let notes = notes(asked, &agreement, first[0]);
        let atlas = problem.model.atlas;
        let row = problem.rows.iter().enumerate().map(|(i, row)| RowOut {
            line: row.line,
            velocity_m_s: row.velocity,
            figure: row.figure.name(),
            measured: row.value,
            predicted: estimate.predicted[i],
            sigma: estimate.sigmas[i],
            residual: (row.value - estimate.predicted[i]) / estimate.sigmas[i],
        });
        Report {
            estimate: Found {
                strength,
                strength_interval: whole.strength,
                strength_measured: measured.strength,
                hardening,
                hardening_interval: whole.hardening,
                hardening_measured: measured.hardening,
            },
            assumed: Assumed {
                density_kg_m3: known.density,
                young_modulus: known.young_modulus,
                young_modulus_sigma_share: asked.sampling.young_modulus,
                poisson_ratio: known.poisson_ratio,
                hardening_is_sought: problem.unknowns == Unknowns::YieldAndHardening,
                radius_m: asked.radius,
                radius_sigma_share: asked.sampling.radius,
                velocity_sigma_share: asked.velocity,
                flats_are_caps: asked.cap,
                draws: asked.sampling.draws,
                seed: asked.sampling.seed,
                model: format!(
                    "atlas of {} impacts ({}), {}",
                    atlas.impacts[1], atlas.program, atlas.study
                ),
                notes,
            },
            agreement,
            row: row.collect(),
            refinement: rounds.iter().map(RoundOut::of).collect(),
        }
    }

    /// What was found, as text.
    #[must_use]
    pub fn text(&self, settled: bool) -> String {
        let found = &self.estimate;
        let stress = |x: f64| engineering(x, "Pa", 4);
        let one = |name: &str, value: f64, whole: [f64; 2], own: [f64; 2]| {
            let ends = |ends: [f64; 2]| format!("{} to {}", stress(ends[0]), stress(ends[1]));
            let mut text = format!("{name} = {}, 95 % interval {}", stress(value), ends(whole));
            if whole != own {
                let _ = write!(text, " (by the measurements alone {})", ends(own));
            }
            text + "\n"
        };
        let mut text = one(
            "Y",
            found.strength,
            found.strength_interval,
            found.strength_measured,
        );
        if self.assumed.hardening_is_sought {
            text += &one(
                "H",
                found.hardening,
                found.hardening_interval,
                found.hardening_measured,
            );
        }
        let agreement = &self.agreement;
        let rows = match self.row.len() {
            1 => "1 row".to_owned(),
            n => format!("{n} rows"),
        };
        let freedom = agreement.degrees_of_freedom;
        let _ = match (agreement.deviations_from_scatter, freedom) {
            (true, _) => writeln!(text, "{rows}; their scatter is the uncertainty"),
            (_, 0) => writeln!(
                text,
                "{rows}: no more than is sought, whether they agree cannot be told"
            ),
            _ => writeln!(
                text,
                "{rows}, chi-square {} of {freedom} degrees of freedom",
                significant(agreement.chi_square, 3)
            ),
        };
        let _ = writeln!(
            text,
            "{:>12} {:>20} {:>10} {:>10} {:>10} {:>7}",
            "V", "figure", "measured", "material", "sigma", "off"
        );
        for row in &self.row {
            let _ = writeln!(
                text,
                "{:>12} {:>20} {:>10} {:>10} {:>10} {:>7.2}",
                engineering(row.velocity_m_s, "m/s", 4),
                row.figure,
                significant(row.measured, 4),
                significant(row.predicted, 4),
                significant(row.sigma, 2),
                row.residual
            );
        }
        if !self.refinement.is_empty() {
            let rounds = self.refinement.len();
            let state = if settled { "settled" } else { "not settled" };
            let _ = writeln!(text, "refined by impacts, {state} after {rounds} rounds");
        }
        for note in &self.assumed.notes {
            let _ = writeln!(text, "{note}");
        }
        text
    }
}
