//! A table of results as text: columns by name with the units their names end in, cells by line.
//!
//! Values stand apart by commas, semicolons or tabs, as the header has them; lines that begin with `#` are remarks. A unit stands at the end of
//! a name (`velocity_mm_s`) or in brackets behind it (`velocity (mm/s)`, `velocity [mm/s]`).

use crate::{Error, Result};
use std::path::Path;

mod named;

pub use named::{Dimension, Named};

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name as the file has it.
    pub head: String,
    /// Its name in SI units; the head where that ends in nothing known.
    pub name: String,
    /// What the name says of its numbers.
    pub named: Option<Named>,
}

/// A row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Line of the file.
    pub line: u64,
    cells: Vec<String>,
}

impl Row {
    /// Text of the cell in column `at`.
    #[must_use]
    pub fn cell(&self, at: usize) -> &str {
        self.cells.get(at).map_or("", String::as_str)
    }
}

/// A table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table<'a> {
    path: &'a Path,
    /// Columns, in their order.
    pub columns: Vec<Column>,
    /// Rows, in their order.
    pub rows: Vec<Row>,
}

impl<'a> Table<'a> {
    /// Reads the text of a table; `must` says what kind of table it has to be.
    ///
    /// # Errors
    /// [`Error::Value`] for rows of more or fewer values than the header has names, and for a column that is there twice, whatever its unit.
    pub fn parse(text: &str, path: &'a Path, must: &str) -> Result<Self> {
        let text = text.trim_start_matches('\u{feff}');
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .delimiter(between(text))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let broken = |error: csv::Error| Error::in_table(path, "table", error.to_string(), must);
        let heads = reader.headers().map_err(broken)?;
        let columns: Vec<Column> = heads.iter().map(Column::of).collect();
        for (i, column) in columns.iter().enumerate() {
            let same = |other: &Column| other.name == column.name && !column.name.is_empty();
            if columns[..i].iter().any(same) {
                let allowed = "must be there once, whatever its unit";
                return Err(Error::in_table(
                    path,
                    &column.name,
                    "the column twice",
                    allowed,
                ));
            }
        }
        let row = |record: csv::StringRecord| Row {
            line: record.position().map_or(0, csv::Position::line),
            cells: record.iter().map(str::to_owned).collect(),
        };
        let rows = reader.records().map(|record| record.map(row));
        let rows = rows
            .collect::<std::result::Result<_, _>>()
            .map_err(broken)?;
        Ok(Table {
            path,
            columns,
            rows,
        })
    }

    /// Place of a column by its name in SI units.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// What the number in column `at` of a row is in SI units; `None` where the cell holds no number.
    #[must_use]
    pub fn number(&self, row: &Row, at: usize) -> Option<f64> {
        let factor = self.columns[at].named.as_ref().map_or(1.0, |n| n.factor);
        row.cell(at).parse::<f64>().ok().map(|value| value * factor)
    }

    /// Refusal of what stands under `key`.
    #[must_use]
    pub fn refuse(&self, key: &str, found: impl Into<String>, allowed: &str) -> Error {
        Error::in_table(self.path, key, found, allowed)
    }

    /// Refusal of a row for what it has of a `column`.
    #[must_use]
    pub fn refuse_row(&self, row: &Row, column: &str, found: &str, allowed: &str) -> Error {
        self.refuse(&format!("line {}, {column}", row.line), found, allowed)
    }

    /// Refusal of the cell in column `at` of a row, as the file names it.
    #[must_use]
    pub fn refuse_cell(&self, row: &Row, at: usize, allowed: &str) -> Error {
        let found = format!("`{}`", row.cell(at));
        self.refuse_row(row, &self.columns[at].head, &found, allowed)
    }
}

/// What stands between the values of a table, by its header.
fn between(text: &str) -> u8 {
    let is_text = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let head = text.lines().find(is_text).unwrap_or_default();
    [b';', b'\t', b',']
        .into_iter()
        .find(|byte| head.as_bytes().contains(byte))
        .unwrap_or(b',')
}

impl Column {
    fn of(head: &str) -> Self {
        let name = spelled(head);
        // capitals matter in units alone: `Velocity_m_s`
        let named = Named::of(&name).or_else(|| Named::of(&name.to_lowercase()));
        Column {
            head: head.to_owned(),
            name: named.as_ref().map_or(name, |named| named.name.clone()),
            named,
        }
    }
}

/// A head with its unit at its end: `velocity_mm_s` for `Velocity (mm/s)`.
fn spelled(head: &str) -> String {
    for (open, close) in [('(', ')'), ('[', ']')] {
        let Some((stem, rest)) = head.split_once(open) else {
            continue;
        };
        if let Some(unit) = rest.trim().strip_suffix(close) {
            let unit = unit.trim().replace(['µ', '\u{3bc}'], "u");
            let unit = unit.replace('²', "2").replace('³', "3").replace('^', "");
            let stem = stem.trim().to_lowercase().replace(' ', "_");
            return match unit.as_str() {
                "" | "-" | "1" => stem,
                unit => format!("{stem}_{}", unit.replace(['/', ' '], "_")),
            };
        }
    }
    head.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Table<'_>> {
        Table::parse(text, Path::new("t.csv"), "must be a table")
    }

    #[test]
    fn commas_semicolons_and_tabs_units_at_the_end_and_in_brackets_give_the_same_numbers() {
        for text in [
            "velocity_m_s,radius_m,note\n2,1e-3,a\n",
            "# a remark\nvelocity_mm_s;radius_um;note\n2000;1000;a\n",
            "\u{feff}Velocity (mm/s)\tRadius [\u{b5}m]\tnote\n\n2000\t1000\ta\n",
        ] {
            let table = read(text).unwrap();
            let number = |name: &str| table.number(&table.rows[0], table.place(name).unwrap());
            assert_eq!(number("velocity_m_s"), Some(2.0), "{text}");
            assert!((number("radius_m").unwrap() - 1e-3).abs() < 1e-18, "{text}");
            assert_eq!(number("note"), None);
            assert_eq!(table.rows[0].cell(2), "a");
        }
    }

    #[test]
    fn a_column_twice_and_a_row_of_another_length_are_refused() {
        let error = read("radius_m,radius_mm\n1,1000\n").unwrap_err();
        assert!(
            error
                .to_string()
                .contains("radius_m`: found the column twice"),
            "{error}"
        );
        let error = read("radius_m,velocity_m_s\n1,1\n1,0,5\n").unwrap_err();
        assert!(error.to_string().contains("line: 3"), "{error}");
        // names that are left empty are no names
        assert_eq!(read("a,,\n1,,\n").unwrap().columns.len(), 3);
    }
}
