//! A table of measured impacts: the columns that are known, and their values.

use crate::table::{Column, Row, Table};
use crate::{Error, Result};
use std::path::Path;

/// Columns that are known, as SI names.
const COLUMNS: [&str; 12] = [
    "velocity_m_s",
    "velocity_sigma_m_s",
    "restitution",
    "restitution_sigma",
    "compression_ratio",
    "compression_ratio_sigma",
    "flat_diameter_m",
    "flat_diameter_sigma_m",
    "radius_m",
    "radius_sigma_m",
    "diameter_m",
    "diameter_sigma_m",
];

/// Columns by their SI names.
pub struct Measured<'a> {
    table: Table<'a>,
    /// Columns that mean nothing here.
    pub unused: Vec<String>,
}

impl<'a> Measured<'a> {
    /// Reads a table, its columns in any unit.
    ///
    /// # Errors
    /// As [`Table::parse`], and [`Error::Value`] for a column of ours without its unit.
    pub fn of(text: &str, path: &'a Path) -> Result<Self> {
        let must = "must be a table with a header and as many values in each row";
        let mut table = Table::parse(text, path, must)?;
        let mut unused = Vec::new();
        for at in 0..table.columns.len() {
            let (before, from) = table.columns.split_at_mut(at);
            let Column { name, head, .. } = &mut from[0];
            // names without a unit keep their capitals
            let plain = name.to_lowercase();
            if COLUMNS.contains(&&plain[..]) {
                if before.iter().any(|column| column.name == plain) {
                    let allowed = "must be there once, whatever its capitals";
                    return Err(Error::in_table(path, &plain, "the column twice", allowed));
                }
                *name = plain;
                continue;
            }
            // a name of ours that lacks its unit must not pass for a remark
            let ours = COLUMNS.iter().any(|known| {
                let stem = known.trim_end_matches("_m_s").trim_end_matches("_m");
                plain == stem || plain.contains("sigma")
            });
            if ours {
                let allowed = format!("must be one of {}, in any unit", COLUMNS.join(", "));
                return Err(Error::in_table(
                    path,
                    head,
                    "no column of this name",
                    &allowed,
                ));
            }
            unused.push(head.clone());
        }
        Ok(Measured { table, unused })
    }

    /// Rows.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.table.rows
    }

    /// Whether a column is there, by its SI name.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.table.place(name).is_some()
    }

    /// Refusal of the table.
    #[must_use]
    pub fn refuse(&self, key: &str, found: &str, allowed: &str) -> Error {
        self.table.refuse(key, found, allowed)
    }

    /// Refusal of a value of a row.
    #[must_use]
    pub fn at(&self, row: &Row, column: &str, found: &str, allowed: &str) -> Error {
        self.table.refuse_row(row, column, found, allowed)
    }

    /// What a row holds in a column.
    #[must_use]
    pub fn cell(&self, row: &Row, name: &str) -> String {
        let cell = self.table.place(name).map_or("", |at| row.cell(at));
        format!("`{cell}`")
    }

    /// Number of a row in SI units; none where the column is not there or the cell is empty.
    ///
    /// # Errors
    /// [`Error::Value`] for what is no number, or one that does not hold.
    pub fn number(
        &self,
        row: &Row,
        name: &str,
        holds: impl Fn(f64) -> bool,
        allowed: &str,
    ) -> Result<Option<f64>> {
        let Some(at) = self.table.place(name) else {
            return Ok(None);
        };
        if row.cell(at).is_empty() {
            return Ok(None);
        }
        match self.table.number(row, at).filter(|value| value.is_finite()) {
            Some(value) if holds(value) => Ok(Some(value)),
            Some(_) => Err(self.table.refuse_cell(row, at, allowed)),
            None => Err(self.table.refuse_cell(row, at, "must be a number")),
        }
    }
}
