//! Identities: figures that others determine exactly, such as plastic strain and plastic work.

use super::problem::{Inputs, Product, Runs};
use super::table::{Column, Table};
use nalgebra::{DMatrix, DVector};

/// A figure as a constant times powers of groups and of another figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Identity {
    /// The figure.
    pub figure: String,
    /// The constant.
    pub factor: f64,
    /// Groups with their exponents.
    pub groups: Vec<(Product, f64)>,
    /// The other figure.
    pub other: String,
    /// Its exponent.
    pub power: f64,
    /// 90 % of the runs are this close, relative.
    pub spread: f64,
}

/// Largest such spread of an identity.
const EXACT: f64 = 2e-3;

impl Identity {
    /// As text.
    #[must_use]
    pub fn text(&self) -> String {
        let power = |text: &str, x: f64| match x == 1.0 {
            true => text.to_owned(),
            false => format!("{text}^{x}"),
        };
        let mut parts = vec![crate::unit::significant(self.factor, 4)];
        parts.extend(
            self.groups
                .iter()
                .map(|(group, x)| power(&format!("({})", group.text()), *x)),
        );
        parts.push(power(&self.other, self.power));
        format!("{} = {}", self.figure, parts.join(" "))
    }

    /// Whether it is the balance of energies without hardening: the plastic work of a unit of volume is Y times the strain.
    #[must_use]
    pub fn is_energy_balance(&self) -> bool {
        let half_severity = matches!(&self.groups[..], [(group, 1.0)]
            if group.exponents.len() == 3 && group.of("density_kg_m3") == 1
                && group.of("velocity_m_s") == 2 && group.of("yield_strength_Pa") == -1);
        self.figure == "equivalent_plastic_strain"
            && self.other == "plastic_work_ratio"
            && self.power == 1.0
            && half_severity
            && (self.factor - 0.5).abs() < 0.01
    }
}

/// Identities of a figure without unit with each of the other ones.
#[must_use]
pub fn identities(table: &Table, inputs: &Inputs, runs: &Runs, figure: &Column) -> Vec<Identity> {
    let one = |cases: &Vec<usize>, column: &Column| column.values[cases[0]];
    let values = |column: &Column| -> Vec<f64> {
        runs.cases.iter().map(|cases| one(cases, column)).collect()
    };
    let y = values(figure);
    let fits = |column: &&Column| {
        column.name != figure.name
            && column.dimension.is_none()
            && !["points", "steps"].contains(&&column.name[..])
    };
    if !figure.dimension.is_none() {
        return Vec::new();
    }
    table
        .figures
        .iter()
        .filter(fits)
        .filter_map(|other| {
            let z = values(other);
            let rows: Vec<usize> = (0..y.len()).filter(|&i| y[i] > 0.0 && z[i] > 0.0).collect();
            if rows.len() < y.len() / 2 || rows.len() < 8 {
                return None;
            }
            let logs = &runs.columns.logs;
            let matrix = DMatrix::from_fn(rows.len(), logs.len() + 2, |i, j| match j {
                0 => 1.0,
                1 => z[rows[i]].ln(),
                j => logs[j - 2][rows[i]],
            });
            let right = DVector::from_iterator(rows.len(), rows.iter().map(|&i| y[i].ln()));
            let solved = matrix.svd(true, true).solve(&right, 1e-12).ok()?;
            // quarters are meant, if they fit
            let exponents: Vec<f64> = solved
                .iter()
                .skip(1)
                .map(|x| (4.0 * x).round() / 4.0)
                .collect();
            let rest: Vec<f64> = rows
                .iter()
                .map(|&i| {
                    let groups = logs
                        .iter()
                        .zip(&exponents[1..])
                        .map(|(column, x)| x * column[i]);
                    y[i].ln() - exponents[0] * z[i].ln() - groups.sum::<f64>()
                })
                .collect();
            let mut sorted = rest.clone();
            sorted.sort_by(f64::total_cmp);
            let middle = sorted[sorted.len() / 2];
            let mut away: Vec<f64> = rest.iter().map(|r| (r - middle).abs()).collect();
            away.sort_by(f64::total_cmp);
            let spread = away[(away.len() * 9) / 10];
            let groups: Vec<(Product, f64)> = inputs
                .groups
                .iter()
                .cloned()
                .zip(exponents[1..].iter().copied())
                .filter(|(_, x)| *x != 0.0)
                .collect();
            (spread < EXACT && exponents[0] != 0.0).then(|| Identity {
                figure: figure.name.clone(),
                factor: middle.exp(),
                groups,
                other: other.name.clone(),
                power: exponents[0],
                spread,
            })
        })
        .collect()
}
