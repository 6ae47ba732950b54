//! Table: the columns of a study by name, with the units their names end in.

use crate::study::Groups;
use crate::table::{self, Dimension, Named, Row};
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Figures of an impact: what a study finds. Every other column of numbers is an input.
pub const FIGURES: [&str; 19] = [
    "restitution",
    "max_force_N",
    "max_displacement_m",
    "max_centre_displacement_m",
    "residual_displacement_m",
    "contact_time_s",
    "compression_ratio",
    "height_at_max_compression_ratio",
    "equivalent_plastic_strain",
    "plastic_work_ratio",
    "shock_work_ratio",
    "energy_closure",
    "eroded_volume_ratio",
    "points",
    "steps",
    "wall_s",
    "predicted_s",
    "tangential_restitution",
    "impulse_ratio",
];

/// Figures that no impact has outside these bounds: the smallest and the largest, the smallest itself allowed or not.
const BOUNDS: [(&str, Bound, f64, &str); 4] = [
    ("restitution", Bound::From(0.0), 1.01, "must lie in [0, 1]"),
    (
        "max_force_N",
        Bound::Above(0.0),
        f64::INFINITY,
        "must be above 0",
    ),
    (
        "max_displacement_m",
        Bound::Above(0.0),
        f64::INFINITY,
        "must be above 0",
    ),
    (
        "contact_time_s",
        Bound::Above(0.0),
        f64::INFINITY,
        "must be above 0",
    ),
];

/// A lower bound.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bound {
    /// Itself allowed.
    From(f64),
    /// Not itself.
    Above(f64),
}

impl Bound {
    fn allows(self, value: f64) -> bool {
        match self {
            Bound::From(least) => value >= least,
            Bound::Above(least) => value > least,
        }
    }
}

/// Column with the status of a row.
const STATUS: &str = "status";
/// Column with the name of a case, which may be a number.
const NAME: &str = "name";
/// Column with the tolerance a run was planned for.
const TOLERANCE: &str = "tolerance";
/// Inputs of an impact that determine every group a study writes beside them.
const RAW: [&str; 3] = ["density_kg_m3", "young_modulus_Pa", "velocity_m_s"];

/// A column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, with the unit at the end.
    pub name: String,
    /// Dimension by that unit.
    pub dimension: Dimension,
    /// One value a row.
    pub values: Vec<f64>,
}

impl Column {
    /// Smallest and largest value.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let fold = |start: f64, f: fn(f64, f64) -> f64| self.values.iter().copied().fold(start, f);
        [
            fold(f64::INFINITY, f64::min),
            fold(f64::NEG_INFINITY, f64::max),
        ]
    }

    /// Whether all its values are the same to nine digits.
    #[must_use]
    pub fn constant(&self) -> bool {
        let [low, high] = self.range();
        high - low <= 1e-9 * high.abs().max(low.abs())
    }
}

/// Results of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Where they were read.
    pub path: PathBuf,
    /// What was given to the runs.
    pub inputs: Vec<Column>,
    /// What they found.
    pub figures: Vec<Column>,
    /// Columns that hold words, nothing in any row, or a group of the inputs beside them.
    pub left_out: Vec<String>,
    /// Columns that were converted: as the file names them, and as they are called here, in SI units.
    pub converted: Vec<(String, String)>,
    /// Tolerance that all the runs were planned for, where a column says it.
    pub tolerance: Option<f64>,
    /// Rows that did not end with status ok, which are not here.
    pub failed: usize,
    /// Line of the file of each row.
    pub lines: Vec<u64>,
}

impl Table {
    /// Reads `results.csv`.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be read, [`Error::Value`] for what is no table of a study.
    pub fn read(path: &Path) -> Result<Self> {
        let text = crate::files::read_text(path)?;
        Self::parse(&text, path)
    }

    /// Reads the text of one.
    ///
    /// # Errors
    /// As [`Table::read`].
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        let text = Text::of(text, path)?;
        let mut table = Table {
            path: path.to_owned(),
            inputs: Vec::new(),
            figures: Vec::new(),
            left_out: Vec::new(),
            converted: Vec::new(),
            tolerance: None,
            failed: text.failed,
            lines: text.table.rows.iter().map(|row| row.line).collect(),
        };
        let derived = match RAW.iter().all(|raw| text.table.place(raw).is_some()) {
            true => Groups::column_names(),
            false => Vec::new(),
        };
        for (at, table::Column { head, name, .. }) in text.table.columns.iter().enumerate() {
            if name == STATUS {
                continue;
            }
            let left_out = name == NAME || derived.contains(name);
            let Some(values) = (if left_out { None } else { text.numbers(at)? }) else {
                table.left_out.push(name.clone());
                continue;
            };
            if name == TOLERANCE {
                table.tolerance = Some(text.tolerance(at, values)?);
                continue;
            }
            let column = text.column(at, values)?;
            if name != head {
                table.converted.push((head.clone(), name.clone()));
            }
            match is_figure(name) {
                true => table.figures.push(column),
                false => table.inputs.push(column),
            }
        }
        for (i, one) in table.inputs.iter().enumerate() {
            let twin = table.inputs[..i]
                .iter()
                .find(|other| !one.constant() && other.values == one.values);
            if let Some(twin) = twin {
                return Err(text.table.refuse(
                    &one.name,
                    format!("the values of `{}`", twin.name),
                    "two columns that never differ cannot be told apart: take one out",
                ));
            }
        }
        Ok(table)
    }

    /// The input called `name`.
    #[must_use]
    pub fn input(&self, name: &str) -> Option<&Column> {
        self.inputs.iter().find(|column| column.name == name)
    }

    /// The figure called `name`.
    ///
    /// # Errors
    /// [`Error::Value`] when there is none, it has a row without value, or always the same.
    pub fn figure(&self, name: &str) -> Result<&Column> {
        let refuse =
            |found: String, allowed: String| Error::in_table(&self.path, name, found, &allowed);
        let Some(column) = self.figures.iter().find(|column| column.name == name) else {
            let names: Vec<&str> = self.figures.iter().map(|c| &c.name[..]).collect();
            let allowed = match names.is_empty() {
                true => format!(
                    "must be the results.csv of a study, with one of {}",
                    FIGURES.join(", ")
                ),
                false => format!("it has {}", names.join(", ")),
            };
            return Err(refuse("no such figure".to_owned(), allowed));
        };
        if let Some(row) = column.values.iter().position(|value| !value.is_finite()) {
            return Err(refuse(
                format!("no number in line {}", self.lines[row]),
                "an equation needs a value in every row".to_owned(),
            ));
        }
        if column.constant() {
            return Err(refuse(
                format!("{} in every row", column.values[0]),
                "what never changes has no equation: leave it out of --target".to_owned(),
            ));
        }
        Ok(column)
    }

    /// The rows of these numbers alone.
    #[must_use]
    pub fn some(&self, rows: &[usize]) -> Table {
        let pick = |columns: &[Column]| -> Vec<Column> {
            let one = |column: &Column| Column {
                values: rows.iter().map(|&row| column.values[row]).collect(),
                ..column.clone()
            };
            columns.iter().map(one).collect()
        };
        Table {
            inputs: pick(&self.inputs),
            figures: pick(&self.figures),
            lines: rows.iter().map(|&row| self.lines[row]).collect(),
            ..self.clone()
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.lines.len()
    }
}

/// Whether a column is a figure of the impact.
fn is_figure(name: &str) -> bool {
    FIGURES.contains(&name)
}

/// Whether a cell holds no number on purpose.
fn is_void(cell: &&str) -> bool {
    cell.is_empty() || cell.eq_ignore_ascii_case("nan")
}

/// Whether a cell holds something else than a number.
fn is_word(cell: &&str) -> bool {
    !is_void(cell) && cell.parse::<f64>().is_err()
}

/// A table as text, of the rows that ended well.
struct Text<'a> {
    table: table::Table<'a>,
    /// Rows that did not end well.
    failed: usize,
}

impl<'a> Text<'a> {
    fn of(text: &str, path: &'a Path) -> Result<Self> {
        let mut table = table::Table::parse(text, path, "must be the results.csv of a study")?;
        let count = table.rows.len();
        if let Some(at) = table.place(STATUS) {
            table.rows.retain(|row| row.cell(at) == "ok");
        }
        let left = table.rows.len();
        if left < 2 {
            let found = format!("{left} with status ok");
            let allowed = "an equation needs many: run a study of more cases";
            return Err(table.refuse("rows", found, allowed));
        }
        Ok(Text {
            table,
            failed: count - left,
        })
    }

    /// Refusal of a cell.
    fn refuse_cell(&self, key: &str, at: usize, row: &Row, allowed: &str) -> Error {
        let found = format!("`{}` in line {}", row.cell(at), row.line);
        self.table.refuse(key, found, allowed)
    }

    /// Numbers of a column as they are written; none of one that holds words, or nothing that a case has.
    fn numbers(&self, at: usize) -> Result<Option<Vec<f64>>> {
        let name = &self.table.columns[at].name;
        let rows = &self.table.rows;
        let cells: Vec<&str> = rows.iter().map(|row| row.cell(at)).collect();
        let figure = is_figure(name);
        if cells.iter().all(|cell| cell.is_empty()) {
            return Err(self
                .table
                .refuse(name, "an empty column", "a value in every row"));
        }
        // constants of flow stresses that no case has, and names of runs
        if (!figure && cells.iter().all(is_void)) || cells.iter().all(is_word) {
            return Ok(None);
        }
        let mut values = Vec::with_capacity(cells.len());
        for (row, cell) in rows.iter().zip(&cells) {
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => values.push(value),
                // counts and times of runs are not looked at
                _ if figure && !cell.is_empty() && !is_word(cell) => values.push(f64::NAN),
                _ => return Err(self.refuse_cell(name, at, row, "must be a number in every row")),
            }
        }
        Ok(Some(values))
    }

    /// The tolerance that all runs were planned for.
    fn tolerance(&self, at: usize, values: Vec<f64>) -> Result<f64> {
        let column = Column {
            name: self.table.columns[at].name.clone(),
            dimension: Dimension::default(),
            values,
        };
        let [low, high] = column.range();
        let found = format!("{low} to {high}");
        if !(low > 0.0 && high <= 0.2) {
            return Err(self.table.refuse(
                &column.name,
                found,
                "must lie in (0, 0.2], or be left out",
            ));
        }
        if !column.constant() {
            let allowed = "must be the same in every row: runs of one error make an equation";
            return Err(self.table.refuse(&column.name, found, allowed));
        }
        Ok(low)
    }

    /// A column in SI units, of its numbers as they are written.
    fn column(&self, at: usize, mut values: Vec<f64>) -> Result<Column> {
        let table::Column { head, name, named } = &self.table.columns[at];
        let refuse_cell =
            |row: usize, allowed| Err(self.refuse_cell(head, at, &self.table.rows[row], allowed));
        let Some(unit) = named else {
            return Err(self.table.refuse(
                name,
                "no unit known at the end of its name",
                &format!(
                    "must end in a unit ({}), or, without one, in one of {}",
                    Named::known().join(", "),
                    Dimension::bare().join(", ")
                ),
            ));
        };
        if unit.factor != 1.0 {
            values.iter_mut().for_each(|value| *value *= unit.factor);
            if let Some(row) = values.iter().position(|value| value.is_infinite()) {
                return refuse_cell(row, "must be a number in SI units too");
            }
        }
        if let Some((_, least, most, allowed)) = BOUNDS.iter().find(|bound| bound.0 == name) {
            let beyond = |value: &f64| !(value.is_nan() || least.allows(*value) && value <= most);
            if let Some(row) = values.iter().position(beyond) {
                return refuse_cell(row, allowed);
            }
        }
        Ok(Column {
            name: name.clone(),
            dimension: unit.dimension,
            values,
        })
    }
}
