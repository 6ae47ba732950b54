//! Problem: from a table to groups, distinct runs and scaled figures, by units alone.

use super::dimension::{MOST, groups, product_of};
use super::formula::Columns;
use super::ranking::spearman;
use super::table::{Column, Table};
use crate::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use crate::table::Dimension;
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Column of the impact speed.
const SPEED: &str = "velocity_m_s";
/// Column of the speed at first yield, which is made here.
pub const YIELD_SPEED: &str = "yield_velocity_m_s";

/// Symbols of columns; others are called by their name without the unit.
const SYMBOLS: [(&str, &str); 8] = [
    ("density_kg_m3", "rho"),
    ("young_modulus_Pa", "E"),
    ("yield_strength_Pa", "Y"),
    ("hardening_modulus_Pa", "H"),
    ("poisson_ratio", "nu"),
    ("radius_m", "R"),
    (SPEED, "V"),
    (YIELD_SPEED, "Vy"),
];

/// Symbol of a column.
#[must_use]
pub fn symbol(name: &str) -> String {
    let known = SYMBOLS.iter().find(|(column, _)| *column == name);
    known.map_or_else(|| name.to_owned(), |(_, symbol)| (*symbol).to_owned())
}

/// A product of powers of columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Product {
    /// Columns with their exponents, none of them 0.
    pub exponents: Vec<(String, i32)>,
}

impl Product {
    fn new(columns: &[&Column], exponents: &[i32]) -> Self {
        let pairs = columns.iter().zip(exponents).filter(|(_, x)| **x != 0);
        Product {
            exponents: pairs.map(|(column, x)| (column.name.clone(), *x)).collect(),
        }
    }

    /// As text: `rho V^2/Y`; `1` for the empty one.
    #[must_use]
    pub fn text(&self) -> String {
        let power = |(name, x): &(String, i32)| match x.abs() {
            1 => symbol(name),
            x => format!("{}^{x}", symbol(name)),
        };
        let side = |sign: i32| -> Vec<String> {
            let there = self.exponents.iter().filter(|(_, x)| x.signum() == sign);
            there.map(power).collect()
        };
        let (above, below) = (side(1).join(" "), side(-1));
        let above = if above.is_empty() {
            "1".to_owned()
        } else {
            above
        };
        match &below[..] {
            [] => above,
            [one] => format!("{above}/{one}"),
            more => format!("{above}/({})", more.join(" ")),
        }
    }

    /// As a name in formulas: `E_Y`, `rho_V2_Y`.
    #[must_use]
    pub fn name(&self) -> String {
        let mut sorted: Vec<&(String, i32)> = self.exponents.iter().collect();
        sorted.sort_by_key(|(_, x)| x.signum() < 0);
        let parts: Vec<String> = sorted
            .iter()
            .map(|(name, x)| match x.abs() {
                1 => symbol(name),
                x => format!("{}{x}", symbol(name)),
            })
            .collect();
        parts.join("_")
    }

    /// Logarithm of its value in every row.
    #[must_use]
    pub fn logs(&self, table: &Table) -> Vec<f64> {
        let mut sum = vec![0.0; table.rows()];
        for (name, x) in &self.exponents {
            if let Some(column) = table.input(name) {
                let both = sum.iter_mut().zip(&column.values);
                both.for_each(|(s, v)| *s += f64::from(*x) * v.ln());
            }
        }
        sum
    }

    /// Exponent of a column.
    #[must_use]
    pub fn of(&self, name: &str) -> i32 {
        let found = self.exponents.iter().find(|(column, _)| column == name);
        found.map_or(0, |(_, x)| *x)
    }
}

/// A column that others determine: a constant times a product of their powers.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependent {
    /// The column.
    pub name: String,
    /// The constant.
    pub factor: f64,
    /// The others, with their exponents.
    pub exponents: Vec<(String, f64)>,
}

impl Dependent {
    /// As text.
    #[must_use]
    pub fn text(&self) -> String {
        let powers: Vec<String> = self
            .exponents
            .iter()
            .map(|(name, x)| match *x == 1.0 {
                true => symbol(name),
                false => format!("{}^{x}", symbol(name)),
            })
            .collect();
        format!(
            "{} = {} {}",
            symbol(&self.name),
            crate::unit::significant(self.factor, 6),
            powers.join(" ")
        )
    }
}

/// What a table says of its inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    /// Columns that vary and stand for themselves.
    pub free: Vec<String>,
    /// Columns that never change: what they do is undetermined.
    pub undetermined: Vec<String>,
    /// Columns that others determine.
    pub dependent: Vec<Dependent>,
    /// Groups.
    pub groups: Vec<Product>,
}

/// Largest error of a logarithm with which one column is a product of powers of others.
const EXACT: f64 = 1e-6;

/// The speed at first yield as a column, where the table says what it takes (Johnson 1985; peak pressure 1.6 Y).
#[must_use]
pub fn yield_speed(table: &Table) -> Option<Column> {
    let of = |name: &str| table.input(name).map(|column| &column.values);
    let (density, young, poisson) = (
        of("density_kg_m3")?,
        of("young_modulus_Pa")?,
        of("poisson_ratio")?,
    );
    let strength = of("yield_strength_Pa")?;
    let value = |row: usize| {
        let material = Material {
            density: density[row],
            young_modulus: young[row],
            poisson_ratio: poisson[row],
            flow: Some(Flow::perfectly_plastic(strength[row])),
        };
        let point = material.yield_point(1.0, YIELD_PRESSURE_RATIO);
        point.map_or(f64::NAN, |point| point.velocity)
    };
    Some(Column {
        name: YIELD_SPEED.to_owned(),
        dimension: Dimension::of_name(YIELD_SPEED)?,
        values: (0..table.rows()).map(value).collect(),
    })
}

/// `column` as a product of powers of `others`, if it is one.
fn dependence(column: &Column, others: &[&Column]) -> Option<Dependent> {
    if others.is_empty() {
        return None;
    }
    let n = column.values.len();
    let matrix = DMatrix::from_fn(n, others.len() + 1, |i, j| match j {
        0 => 1.0,
        j => others[j - 1].values[i].ln(),
    });
    let right = DVector::from_iterator(n, column.values.iter().map(|v| v.ln()));
    let solved = matrix.clone().svd(true, true).solve(&right, 1e-10).ok()?;
    let worst = (&matrix * &solved - &right).amax();
    if !(worst < EXACT) {
        return None;
    }
    // exponents of physics are simple: eighths to nine digits are meant
    let round = |x: f64| {
        let eighths = (8.0 * x).round() / 8.0;
        if (x - eighths).abs() < 1e-5 {
            eighths
        } else {
            x
        }
    };
    let exponents: Vec<(String, f64)> = others
        .iter()
        .zip(solved.iter().skip(1))
        .map(|(other, x)| (other.name.clone(), round(*x)))
        .filter(|(_, x)| *x != 0.0)
        .collect();
    Some(Dependent {
        name: column.name.clone(),
        factor: solved[0].exp(),
        exponents,
    })
}

impl Inputs {
    /// Looks at the inputs of a table; `figures` decide which of two equally short groups is taken: the one that ranks with them.
    ///
    /// # Errors
    /// [`Error::Value`] for a column that varies and is not positive, [`Error::Refused`] when there is no group.
    pub fn of(table: &Table, figures: &[&Column]) -> Result<Self> {
        let (mut free, mut undetermined, mut dependent) =
            (Vec::<&Column>::new(), Vec::new(), Vec::new());
        // what has a unit comes first: pure numbers that it determines are groups already made
        let mut columns: Vec<&Column> = table.inputs.iter().collect();
        columns.sort_by_key(|column| (column.dimension.is_none(), column.name == YIELD_SPEED));
        for column in columns {
            if column.constant() {
                undetermined.push(column);
                continue;
            }
            if let Some(row) = column.values.iter().position(|v| !(*v > 0.0)) {
                return Err(Error::in_table(
                    &table.path,
                    &column.name,
                    format!("{} in line {}", column.values[row], table.lines[row]),
                    "must be positive where it varies: products of powers are looked for",
                ));
            }
            match dependence(column, &free) {
                Some(found) => dependent.push(found),
                // made of the others, though by no product of powers where Poisson's ratio varies
                None if column.name == YIELD_SPEED => {}
                None => free.push(column),
            }
        }
        // what never changes takes part by its unit: at one density an impact still depends on rho V^2/Y
        let fixed = undetermined.iter().copied().filter(|column| {
            !column.dimension.is_none() && column.values.iter().all(|value| *value > 0.0)
        });
        let mut columns: Vec<&Column> = free.iter().copied().chain(fixed).collect();
        // in the order of the table, whose first column stands above the line of a group
        columns.sort_by_key(|column| table.inputs.iter().position(|one| one.name == column.name));
        let dimensions: Vec<Dimension> = columns.iter().map(|column| column.dimension).collect();
        let merit = |exponents: &[i32]| {
            let logs = Product::new(&columns, exponents).logs(table);
            let of = figures
                .iter()
                .map(|figure| spearman(&logs, &figure.values).abs());
            of.sum::<f64>()
        };
        let mut made: Vec<(Product, Column)> = Vec::new();
        for exponents in groups(&dimensions, merit) {
            let group = Product::new(&columns, &exponents);
            let column = Column {
                name: group.name(),
                dimension: Dimension::default(),
                values: group.logs(table).iter().map(|log| log.exp()).collect(),
            };
            // one that the others determine in this table can say nothing of its own
            let others: Vec<&Column> = made.iter().map(|(_, column)| column).collect();
            if !column.constant() && dependence(&column, &others).is_none() {
                made.push((group, column));
            }
        }
        let list = |columns: &[&Column]| {
            let names: Vec<&str> = columns.iter().map(|c| &c.name[..]).collect();
            names.join(", ")
        };
        let refuse = |found: String| Error::Refused {
            what: format!("{}: columns that vary", table.path.display()),
            found,
            allowed: format!(
                "must make 1 to {MOST} products of powers without unit, each column in one at least: add the columns of what else has a unit, as density or modulus"
            ),
        };
        if made.is_empty() {
            return Err(refuse(list(&free)));
        }
        let alone = |column: &&Column| made.iter().all(|(group, _)| group.of(&column.name) == 0);
        let alone: Vec<&Column> = free.iter().copied().filter(alone).collect();
        if !alone.is_empty() {
            return Err(refuse(format!("{} in none", list(&alone))));
        }
        Ok(Inputs {
            groups: made.into_iter().map(|(group, _)| group).collect(),
            free: free.iter().map(|c| c.name.clone()).collect(),
            undetermined: undetermined.iter().map(|c| c.name.clone()).collect(),
            dependent,
        })
    }

    /// Shortest product of inputs with the dimension of a figure; of equally short ones that of the columns that stand in most
    /// groups.
    #[must_use]
    pub fn scale(&self, table: &Table, figure: &Column) -> Option<Product> {
        let determined = |name: &str| self.dependent.iter().any(|one| one.name == name);
        // a pure number scales nothing
        let scales =
            |c: &&Column| !determined(&c.name) && c.name != YIELD_SPEED && !c.dimension.is_none();
        let columns: Vec<&Column> = table.inputs.iter().filter(scales).collect();
        let dimensions: Vec<Dimension> = columns.iter().map(|c| c.dimension).collect();
        let merit = |exponents: &[i32]| {
            let used = columns.iter().zip(exponents).filter(|(_, x)| **x != 0);
            let counts = used.map(|(column, _)| {
                let of = |group: &&Product| group.of(&column.name) != 0;
                self.groups.iter().filter(of).count() as f64
            });
            counts.sum::<f64>()
        };
        product_of(&dimensions, figure.dimension, merit).map(|x| Product::new(&columns, &x))
    }
}

/// One figure over the distinct runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Name of the figure.
    pub name: String,
    /// What it is divided by.
    pub scale: Product,
    /// Its value without unit, one a distinct run.
    pub values: Vec<f64>,
    /// Standard error of each.
    pub errors: Vec<f64>,
}

/// Distinct runs of a study, in dimensionless terms.
#[derive(Debug, Clone, PartialEq)]
pub struct Runs {
    /// Groups of each.
    pub columns: Columns,
    /// Number of cases each stands for.
    pub counts: Vec<usize>,
    /// Cases of each, by their numbers in the table.
    pub cases: Vec<Vec<usize>>,
    /// V/V_y of each, where there is a speed at first yield.
    pub over_yield: Option<Vec<f64>>,
    /// Level of each: runs with equal values of all groups that the speed is not in.
    pub levels: Vec<usize>,
    /// Number of levels.
    pub level_count: usize,
}

/// Exponents k of the factors 1 - (V/V_y)^-k, which vanish at first yield.
///
/// Up to a power of V/V_y, which every power product holds, all small expressions of V/V_y that vanish there are among them:
/// V/V_y - 1, sqrt(V/V_y) - 1, (V/V_y)^2 - 1, 1 - V_y/V; log(V/V_y) is the limit of small k.
pub const VANISHING: [f64; 4] = [0.25, 0.5, 1.0, 2.0];

impl Runs {
    /// Distinct runs of a table by its groups.
    #[must_use]
    pub fn of(table: &Table, inputs: &Inputs) -> Self {
        let logs: Vec<Vec<f64>> = inputs
            .groups
            .iter()
            .map(|group| group.logs(table))
            .collect();
        let nine = |x: f64| format!("{x:.8e}");
        let mut cases: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut first: BTreeMap<Vec<String>, usize> = BTreeMap::new();
        for row in 0..table.rows() {
            let key: Vec<String> = logs.iter().map(|column| nine(column[row].exp())).collect();
            let at = *first.entry(key).or_insert(row);
            cases.entry(at).or_default().push(row);
        }
        let rows: Vec<usize> = cases.keys().copied().collect();
        let pick = |column: &Vec<f64>| rows.iter().map(|&row| column[row]).collect::<Vec<f64>>();
        let over_yield = match (table.input(SPEED), table.input(YIELD_SPEED)) {
            (Some(speed), Some(limit)) => Some(
                rows.iter()
                    .map(|&row| speed.values[row] / limit.values[row])
                    .collect::<Vec<f64>>(),
            ),
            _ => None,
        };
        let vanishing = over_yield.as_ref().map_or_else(Vec::new, |v| {
            let column = |k: &f64| v.iter().map(|v| (1.0 - v.powf(-k)).max(0.0).ln()).collect();
            VANISHING.iter().map(column).collect()
        });
        let slow: Vec<&Vec<f64>> = inputs
            .groups
            .iter()
            .zip(&logs)
            .filter(|(group, _)| group.of(SPEED) == 0)
            .map(|(_, column)| column)
            .collect();
        let mut numbers: BTreeMap<Vec<String>, usize> = BTreeMap::new();
        let mut levels = Vec::new();
        for &row in &rows {
            let key: Vec<String> = slow.iter().map(|column| nine(column[row].exp())).collect();
            let next = numbers.len();
            levels.push(*numbers.entry(key).or_insert(next));
        }
        Runs {
            columns: Columns {
                rows: rows.len(),
                logs: logs.iter().map(pick).collect(),
                vanishing,
            },
            counts: cases.values().map(Vec::len).collect(),
            cases: cases.into_values().collect(),
            over_yield,
            level_count: numbers.len(),
            levels,
        }
    }

    /// A figure over the runs. `tolerance`: what the runs were planned for; relative for what has a unit, for pure numbers
    /// relative to their root mean square.
    ///
    /// # Errors
    /// [`Error::Refused`] when no small powers of inputs have its dimension.
    pub fn target(
        &self,
        table: &Table,
        inputs: &Inputs,
        figure: &Column,
        tolerance: f64,
    ) -> Result<Target> {
        let Some(scale) = inputs.scale(table, figure) else {
            return Err(Error::Refused {
                what: format!("unit of `{}`", figure.name),
                found: "no product of small powers of the inputs has it".to_owned(),
                allowed: "leave it out of --target".to_owned(),
            });
        };
        let logs = scale.logs(table);
        let value = |cases: &Vec<usize>| figure.values[cases[0]] / logs[cases[0]].exp();
        let values: Vec<f64> = self.cases.iter().map(value).collect();
        let all: usize = self.counts.iter().sum();
        let squares: f64 = values
            .iter()
            .zip(&self.counts)
            .map(|(y, n)| *n as f64 * y * y)
            .sum();
        let root = (squares / all as f64).sqrt();
        let errors = values
            .iter()
            .map(|y| match figure.dimension.is_none() {
                true => tolerance * root,
                false => tolerance * y.abs(),
            })
            .collect();
        Ok(Target {
            name: figure.name.clone(),
            scale,
            values,
            errors,
        })
    }
}

#[cfg(test)]
mod tests;
