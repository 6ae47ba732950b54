//! Equations as files hold them: rows of tables, formulas as text, `equations.toml`.

use super::discover::Finding;
use crate::PROGRAM;
use crate::discover::file::{
    EquationTable, EquationsFile, GroupTable, OVER_YIELD, ProvenanceTable, SCHEMA,
    UndeterminedTable,
};
use crate::discover::formula::Formula;
use crate::discover::front::Entry;
use crate::discover::problem::{Inputs, Runs, Target, VANISHING};
use crate::discover::ranking::Ranked;
use crate::discover::score::Score;
use crate::discover::search::misfit_bits;
use crate::discover::table::{Column, Table};
use serde::Serialize;

/// What the equations were found in.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a> {
    /// The table.
    pub table: &'a Table,
    /// Its inputs.
    pub inputs: &'a Inputs,
    /// Its distinct runs.
    pub runs: &'a Runs,
    /// Figures.
    pub targets: &'a [(Column, Target)],
    /// Inputs that never change and that units do not rule out.
    pub undetermined: &'a [String],
}

/// A row of `discover.csv`.
#[derive(Debug, Clone, Serialize)]
#[allow(missing_docs)] // the guide explains the columns
pub struct Row {
    figure: String,
    model: String,
    constants: Option<usize>,
    chosen: bool,
    bits: Option<f64>,
    misfit_bits: Option<f64>,
    mae: f64,
    r2: f64,
    median_rel: f64,
    p90_rel: f64,
    levels_mae: f64,
    levels_r2: f64,
    levels_median_rel: f64,
    levels_p90_rel: f64,
    materials_mae: f64,
    materials_r2: f64,
    materials_median_rel: f64,
    materials_p90_rel: f64,
}

/// A row of `ranking.csv`.
#[derive(Debug, Clone, Serialize)]
#[allow(missing_docs)] // the guide explains the columns
pub struct RankRow {
    figure: String,
    column: String,
    place: f64,
    place_low: usize,
    place_high: usize,
    permutation: f64,
    permutation_low: f64,
    permutation_high: f64,
    spearman: f64,
    spearman_low: f64,
    spearman_high: f64,
}

/// Rows of `ranking.csv`.
#[must_use]
pub fn rank_rows(finding: &Finding) -> Vec<RankRow> {
    let row = |(name, one): (&String, &Ranked)| RankRow {
        figure: finding.figure.clone(),
        column: name.clone(),
        place: one.place,
        place_low: one.places[0],
        place_high: one.places[1],
        permutation: one.permutation,
        permutation_low: one.permutations[0],
        permutation_high: one.permutations[1],
        spearman: one.spearman,
        spearman_low: one.spearman_interval[0],
        spearman_high: one.spearman_interval[1],
    };
    finding
        .ranked
        .iter()
        .zip(&finding.ranking)
        .map(row)
        .collect()
}

/// Rows of `discover.csv`.
#[must_use]
pub fn finding_rows(finding: &Finding) -> Vec<Row> {
    let row = |model: &str, constants: Option<usize>, scores: [&Score; 3]| {
        let [seen, levels, materials] = scores;
        Row {
            figure: finding.figure.clone(),
            model: model.to_owned(),
            constants,
            chosen: false,
            bits: None,
            misfit_bits: None,
            mae: seen.mae,
            r2: seen.r2,
            median_rel: seen.median_rel,
            p90_rel: seen.p90_rel,
            levels_mae: levels.mae,
            levels_r2: levels.r2,
            levels_median_rel: levels.median_rel,
            levels_p90_rel: levels.p90_rel,
            materials_mae: materials.mae,
            materials_r2: materials.r2,
            materials_median_rel: materials.median_rel,
            materials_p90_rel: materials.p90_rel,
        }
    };
    let equations =
        finding
            .front
            .iter()
            .zip(&finding.formulas)
            .enumerate()
            .map(|(i, (entry, formula))| Row {
                chosen: finding.chosen == Some(i),
                bits: Some(entry.found.bits),
                misfit_bits: Some(misfit_bits(entry.found.fitted.chi2)),
                ..row(
                    formula,
                    Some(entry.found.constants),
                    [&entry.seen, &entry.levels, &entry.materials],
                )
            });
    let baselines = finding.baselines.iter().map(|(name, n, scores)| {
        let constants = (*n > 0).then_some(*n);
        row(name, constants, [&scores[0], &scores[1], &scores[2]])
    });
    equations.chain(baselines).collect()
}

/// A formula as text; with its numbers, or with the names of its constants.
#[must_use]
pub fn written(inputs: &Inputs, entry: &Entry, numbers: bool) -> String {
    let formula: &Formula = &entry.found.fitted.formula;
    let (groups, factors): (Vec<String>, Vec<String>) = match numbers {
        true => (
            inputs
                .groups
                .iter()
                .map(|group| format!("({})", group.text()))
                .collect(),
            VANISHING
                .iter()
                .map(|k| format!("(1 - (Vy/V)^{k})"))
                .collect(),
        ),
        false => (
            inputs.groups.iter().map(|group| group.name()).collect(),
            VANISHING
                .iter()
                .map(|k| format!("(1 - {OVER_YIELD}^(-{k}))"))
                .collect(),
        ),
    };
    let constants = formula.constants();
    let number = |i: usize| match numbers {
        true => crate::unit::significant(formula.numbers[i], 4),
        false => {
            let at = constants.iter().position(|&c| c == i).unwrap_or(0);
            format!("c{}", at + 1)
        }
    };
    formula.text(&groups, &factors, &number)
}

/// The file of equations of `findings`; what `known` says: table, inputs, runs and targets, and inputs that stay undetermined.
#[must_use]
pub fn file(known: &Known<'_>, findings: &[Finding], hash: &str, seed: u64) -> EquationsFile {
    let groups = known
        .inputs
        .groups
        .iter()
        .zip(&known.runs.columns.logs)
        .map(|(group, logs)| GroupTable {
            name: group.name(),
            text: group.text(),
            columns: group
                .exponents
                .iter()
                .map(|(name, _)| name.clone())
                .collect(),
            exponents: group.exponents.iter().map(|(_, x)| i64::from(*x)).collect(),
            min: logs.iter().copied().fold(f64::INFINITY, f64::min).exp(),
            max: logs.iter().copied().fold(f64::NEG_INFINITY, f64::max).exp(),
        });
    let mut equation = Vec::new();
    for (finding, (_, target)) in findings.iter().zip(known.targets) {
        for (i, entry) in finding.front.iter().enumerate() {
            let formula = &entry.found.fitted.formula;
            equation.push(EquationTable {
                figure: finding.figure.clone(),
                chosen: finding.chosen == Some(i),
                formula: written(known.inputs, entry, false),
                scale_columns: target
                    .scale
                    .exponents
                    .iter()
                    .map(|(name, _)| name.clone())
                    .collect(),
                scale_exponents: target
                    .scale
                    .exponents
                    .iter()
                    .map(|(_, x)| i64::from(*x))
                    .collect(),
                constants: formula
                    .constants()
                    .iter()
                    .map(|&c| formula.numbers[c])
                    .collect(),
                low: entry.intervals.iter().map(|i| i[0]).collect(),
                high: entry.intervals.iter().map(|i| i[1]).collect(),
                bits: entry.found.bits,
                misfit_bits: misfit_bits(entry.found.fitted.chi2),
                seen: entry.seen,
                levels: entry.levels,
                materials: entry.materials,
            });
        }
    }
    EquationsFile {
        schema: SCHEMA,
        provenance: ProvenanceTable {
            program: PROGRAM.to_owned(),
            results_sha256: hash.to_owned(),
            cases: known.table.rows(),
            runs: known.runs.columns.rows,
            seed,
        },
        group: groups.collect(),
        undetermined: known
            .undetermined
            .iter()
            .filter_map(|name| {
                Some(UndeterminedTable {
                    column: name.clone(),
                    value: *known.table.input(name)?.values.first()?,
                })
            })
            .collect(),
        equation,
    }
}
