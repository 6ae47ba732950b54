//! Bound: which rows of a table are used, as `--where` says it.

use super::problem::symbol;
use super::table::Table;
use crate::{Error, Result};

/// A bound on a product of powers of columns: rows that are used.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    exponents: Vec<(String, i32)>,
    below: bool,
    value: f64,
}

impl Bound {
    /// Reads `rho V^2/Y <= 3.2`: columns by symbol or name, whole exponents, `/` before each that divides, `<=` or `>=`.
    ///
    /// # Errors
    /// [`Error::Refused`] for what is none.
    pub fn parse(text: &str, table: &Table) -> Result<Self> {
        let refuse = |why: String| Error::Refused {
            what: "--where".to_owned(),
            found: format!("`{text}`"),
            allowed: format!("{why}; e.g. \"rho V^2/Y <= 3.2\""),
        };
        let (product, below, value) = match (text.split_once("<="), text.split_once(">=")) {
            (Some((left, right)), None) => (left, true, right),
            (None, Some((left, right))) => (left, false, right),
            _ => return Err(refuse("must hold one `<=` or `>=`".to_owned())),
        };
        let value: f64 = match value.trim().parse() {
            Ok(value) if f64::is_finite(value) => value,
            _ => return Err(refuse("must end in a number, SI units".to_owned())),
        };
        let mut exponents = Vec::new();
        let spaced = product.replace('/', " / ").replace('*', " ");
        let mut sign = 1;
        for word in spaced.split_whitespace() {
            if word == "/" {
                sign = -1;
                continue;
            }
            let (name, power) = word.split_once('^').unwrap_or((word, "1"));
            let power: i32 = power
                .parse()
                .map_err(|_| refuse(format!("`{power}` is no whole exponent")))?;
            let column = table
                .inputs
                .iter()
                .find(|c| c.name == name || symbol(&c.name) == name);
            let Some(column) = column else {
                let names: Vec<String> = table.inputs.iter().map(|c| symbol(&c.name)).collect();
                return Err(refuse(format!(
                    "`{name}` is no input; there are {}",
                    names.join(", ")
                )));
            };
            exponents.push((column.name.clone(), sign * power));
            sign = 1;
        }
        Ok(Bound {
            exponents,
            below,
            value,
        })
    }

    /// Rows of a table within it.
    #[must_use]
    pub fn rows(&self, table: &Table) -> Vec<usize> {
        let value = |row: usize| {
            let factor = |(name, x): &(String, i32)| {
                table
                    .input(name)
                    .map_or(f64::NAN, |c| c.values[row].powi(*x))
            };
            self.exponents.iter().map(factor).product::<f64>()
        };
        // ten digits: 3.2 of a study's values is 3.2
        let slack = 1e-10 * self.value.abs();
        let within = |row: &usize| match self.below {
            true => value(*row) <= self.value + slack,
            false => value(*row) >= self.value - slack,
        };
        (0..table.rows()).filter(within).collect()
    }
}
