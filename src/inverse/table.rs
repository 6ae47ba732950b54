//! A table of measured impacts as text: columns by name with their units, cells by line.

use crate::discover::dimension::Named;
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

/// A row of the table.
pub struct Row {
    /// Line of the file.
    pub line: u64,
    cells: Vec<String>,
}

/// Columns by their SI names.
pub struct Table<'a> {
    path: &'a Path,
    /// SI name, place and factor of those that are known.
    columns: Vec<(String, usize, f64)>,
    heads: Vec<String>,
    /// Columns that mean nothing here.
    pub unused: Vec<String>,
    /// Rows.
    pub rows: Vec<Row>,
}

impl<'a> Table<'a> {
    /// Reads a table: header, then rows of as many cells; `;`, tab or `,` between them by the header.
    ///
    /// # Errors
    /// [`Error::Value`] for what is none, a column twice, or one of ours without its unit.
    pub fn of(text: &str, path: &'a Path) -> Result<Self> {
        let mut table = Table {
            path,
            columns: Vec::new(),
            heads: Vec::new(),
            unused: Vec::new(),
            rows: Vec::new(),
        };
        let text = text.trim_start_matches('\u{feff}');
        let is_text = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
        let head = text.lines().find(is_text).unwrap_or_default();
        let between = [b';', b'\t', b','];
        let between = between
            .into_iter()
            .find(|byte| head.as_bytes().contains(byte))
            .unwrap_or(b',');
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .delimiter(between)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let broken = |error: csv::Error| {
            let allowed = "must be a table with a header and as many values in each row";
            Error::in_table(path, "table", error.to_string(), allowed)
        };
        let heads = reader.headers().map_err(broken)?.clone();
        table.heads = heads.iter().map(str::to_owned).collect();
        for (at, head) in heads.iter().enumerate() {
            table.column(at, head)?;
        }
        for record in reader.records() {
            let record = record.map_err(broken)?;
            table.rows.push(Row {
                line: record.position().map_or(0, csv::Position::line),
                cells: record.iter().map(str::to_owned).collect(),
            });
        }
        Ok(table)
    }

    /// Takes a column by its name: `velocity_m_s`, `velocity_mm_s`, `velocity (mm/s)`, `velocity [mm/s]`.
    fn column(&mut self, at: usize, head: &str) -> Result<()> {
        let mut name = head.trim().to_lowercase();
        for (open, close) in [('(', ')'), ('[', ']')] {
            if let Some((stem, rest)) = head.split_once(open)
                && let Some(unit) = rest.trim().strip_suffix(close)
            {
                let unit = unit.trim().replace(['µ', '\u{3bc}'], "u");
                let stem = stem.trim().to_lowercase().replace(' ', "_");
                name = match unit.as_str() {
                    "" | "-" | "1" => stem,
                    unit => format!("{stem}_{}", unit.replace(['/', ' '], "_")),
                };
            }
        }
        let (si, factor) = match COLUMNS.contains(&&name[..]) {
            true => (name, 1.0),
            false => match Named::of(&name) {
                Some(named) => (named.name, named.factor),
                None => (name, 1.0),
            },
        };
        if !COLUMNS.contains(&&si[..]) {
            // a name of ours that lacks its unit must not pass for a remark
            let ours = COLUMNS.iter().any(|known| {
                let stem = known.trim_end_matches("_m_s").trim_end_matches("_m");
                si == stem || si.contains("sigma")
            });
            if ours {
                let allowed = format!("must be one of {}, in any unit", COLUMNS.join(", "));
                return Err(self.refuse(head, "no column of this name", &allowed));
            }
            self.unused.push(head.to_owned());
            return Ok(());
        }
        if self.has(&si) {
            return Err(self.refuse(head, "the column twice", "must be there once"));
        }
        self.columns.push((si, at, factor));
        Ok(())
    }

    /// Whether a column is there, by its SI name.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|(known, ..)| known == name)
    }

    /// Refusal of the table.
    #[must_use]
    pub fn refuse(&self, key: &str, found: &str, allowed: &str) -> Error {
        Error::in_table(self.path, key, found, allowed)
    }

    /// Refusal of a value of a row.
    #[must_use]
    pub fn at(&self, row: &Row, column: &str, found: &str, allowed: &str) -> Error {
        self.refuse(&format!("line {}, {column}", row.line), found, allowed)
    }

    /// What a row holds in a column.
    #[must_use]
    pub fn cell(&self, row: &Row, name: &str) -> String {
        let column = self.columns.iter().find(|(known, ..)| known == name);
        let cell = column.and_then(|(_, at, _)| row.cells.get(*at));
        format!("`{}`", cell.map_or("", String::as_str))
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
        let Some((_, at, factor)) = self.columns.iter().find(|(known, ..)| known == name) else {
            return Ok(None);
        };
        let cell = row.cells.get(*at).map_or("", String::as_str);
        if cell.is_empty() {
            return Ok(None);
        }
        let head = &self.heads[*at];
        match cell.parse::<f64>().map(|value| value * factor) {
            Ok(value) if value.is_finite() && holds(value) => Ok(Some(value)),
            Ok(value) if value.is_finite() => {
                Err(self.at(row, head, &self.cell(row, name), allowed))
            }
            _ => Err(self.at(row, head, &self.cell(row, name), "must be a number")),
        }
    }
}
