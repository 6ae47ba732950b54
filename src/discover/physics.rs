//! Physics as checks that reject: limits at first yield, bounds, monotony, and the balance of energies.

use super::formula::{Columns, Formula};
use super::problem::{Inputs, Runs, VANISHING};
use std::collections::BTreeMap;

/// What a figure must do whatever the formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules {
    /// Value at first yield.
    pub limit: Option<f64>,
    /// Smallest value.
    pub least: f64,
    /// Largest value.
    pub most: f64,
    /// Whether it grows with the speed (or falls).
    pub grows: Option<bool>,
}

/// Largest distance from the limit.
pub const LIMIT: f64 = 1e-6;
/// Places along the speed at which every material is looked at.
const PLACES: usize = 40;

impl Rules {
    /// Rules of a figure of an impact; of one that physics says nothing about, that it is a number.
    #[must_use]
    pub fn of(figure: &str) -> Self {
        let (limit, least, most, grows) = match figure {
            "restitution" => (Some(1.0), 0.0, 1.0, Some(false)),
            "compression_ratio" => (Some(0.0), 0.0, 1.0, Some(true)),
            "equivalent_plastic_strain" => (Some(0.0), 0.0, f64::INFINITY, Some(true)),
            "plastic_work_ratio" => (Some(0.0), 0.0, 1.0, None),
            "max_force_N" | "max_displacement_m" | "max_centre_displacement_m" => {
                (None, 0.0, f64::INFINITY, Some(true))
            }
            "residual_displacement_m" => (Some(0.0), 0.0, f64::INFINITY, Some(true)),
            _ => (None, f64::NEG_INFINITY, f64::INFINITY, None),
        };
        Rules {
            limit,
            least,
            most,
            grows,
        }
    }
}

/// Places where formulas are looked at: every material of the data, from first yield to its largest speed; and at first yield.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// `PLACES` rows a material.
    pub along: Columns,
    /// One row a material: first yield itself.
    pub limit: Option<Columns>,
    /// rho V^2/Y over two of the rows along: plastic strain over the share of the energy that went into it.
    pub half_severity: Option<Vec<f64>>,
}

impl Places {
    /// Places of the runs. The largest speed of a material is the one at which its groups with the speed reach their largest
    /// value in the data.
    #[must_use]
    pub fn of(runs: &Runs, inputs: &Inputs) -> Self {
        let powers: Vec<f64> = inputs
            .groups
            .iter()
            .map(|group| f64::from(group.of("velocity_m_s")))
            .collect();
        let logs = &runs.columns.logs;
        let range = |j: usize| {
            let all = logs[j].iter().copied();
            (
                all.clone().fold(f64::INFINITY, f64::min),
                all.fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let ends: Vec<(f64, f64)> = (0..logs.len()).map(range).collect();
        // one row of each level
        let mut first: BTreeMap<usize, usize> = BTreeMap::new();
        for (row, level) in runs.levels.iter().enumerate() {
            first.entry(*level).or_insert(row);
        }
        let mut along = vec![Vec::new(); logs.len()];
        let mut limit = vec![Vec::new(); logs.len()];
        let mut over = Vec::new();
        for &row in first.values() {
            // logarithm of the speed over that of the row, from and to
            let from = match &runs.over_yield {
                Some(v) => -v[row].ln(),
                None => by(&powers, logs, row, &ends, false),
            };
            let to = by(&powers, logs, row, &ends, true);
            for place in 1..=PLACES {
                let at = from + (to - from) * place as f64 / PLACES as f64;
                for j in 0..logs.len() {
                    along[j].push(logs[j][row] + powers[j] * at);
                }
                over.extend(runs.over_yield.as_ref().map(|v| v[row] * at.exp()));
            }
            for j in 0..logs.len() {
                limit[j].push(logs[j][row] + powers[j] * from);
            }
        }
        let vanishing = match runs.over_yield {
            Some(_) => VANISHING
                .iter()
                .map(|k| {
                    over.iter()
                        .map(|v| (1.0 - v.powf(-k)).max(0.0).ln())
                        .collect()
                })
                .collect(),
            None => Vec::new(),
        };
        let severity = inputs.groups.iter().position(|group| {
            group.of("density_kg_m3") == 1
                && group.of("velocity_m_s") == 2
                && group.of("yield_strength_Pa") == -1
                && group.exponents.len() == 3
        });
        let half_severity = severity.map(|j| along[j].iter().map(|log| 0.5 * log.exp()).collect());
        Places {
            along: Columns {
                rows: along[0].len(),
                logs: along,
                vanishing,
            },
            limit: runs.over_yield.as_ref().map(|_| Columns {
                rows: limit[0].len(),
                vanishing: vec![vec![f64::NEG_INFINITY; limit[0].len()]; VANISHING.len()],
                logs: limit,
            }),
            half_severity,
        }
    }

    /// The first rule that a formula breaks, as a sentence part.
    #[must_use]
    pub fn broken(&self, formula: &Formula, rules: &Rules) -> Option<String> {
        if let (Some(value), Some(columns)) = (rules.limit, &self.limit) {
            let worst = formula
                .values(columns)
                .iter()
                .map(|y| (y - value).abs())
                .fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
            if !(worst <= LIMIT) {
                return Some(format!("is {worst:.1e} from {value} at first yield"));
            }
        }
        let values = formula.values(&self.along);
        let outside = |y: &&f64| !(**y >= rules.least && **y <= rules.most && y.is_finite());
        if let Some(y) = values.iter().find(outside) {
            return Some(format!(
                "is {y} where it must lie in [{}, {}]",
                rules.least, rules.most
            ));
        }
        let grows = rules.grows?;
        for material in values.chunks(PLACES) {
            let turned = |pair: &[f64]| match grows {
                true => pair[1] < pair[0] * (1.0 - 1e-12),
                false => pair[1] > pair[0] * (1.0 + 1e-12),
            };
            if material.windows(2).any(turned) {
                let which = if grows { "grow" } else { "fall" };
                return Some(format!("does not {which} with the speed throughout"));
            }
        }
        None
    }

    /// Balance of energies of two equations over all places: the work of plastic flow, 2 eps_p Y over rho V^2 of the
    /// incident energy without hardening, cannot be more than what is lost, 1 - e^2. The largest excess as a plastic strain,
    /// which is to be compared with the error of the data.
    #[must_use]
    pub fn energy_excess(&self, strain: &Formula, restitution: &Formula) -> Option<f64> {
        let half = self.half_severity.as_ref()?;
        let (strains, e) = (strain.values(&self.along), restitution.values(&self.along));
        let excess = strains
            .iter()
            .zip(&e)
            .zip(half)
            .map(|((s, e), half)| s - half * (1.0 - e * e));
        Some(excess.fold(f64::NEG_INFINITY, f64::max))
    }
}

/// Logarithm of the factor that takes the speed of a row to where its groups reach an end of the data.
fn by(powers: &[f64], logs: &[Vec<f64>], row: usize, ends: &[(f64, f64)], upper: bool) -> f64 {
    let steps = powers
        .iter()
        .enumerate()
        .filter(|(_, p)| **p != 0.0)
        .map(|(j, p)| {
            let end = if (*p > 0.0) == upper {
                ends[j].1
            } else {
                ends[j].0
            };
            (end - logs[j][row]) / p
        });
    match upper {
        true => steps.fold(f64::INFINITY, f64::min),
        false => steps.fold(f64::NEG_INFINITY, f64::max),
    }
}
