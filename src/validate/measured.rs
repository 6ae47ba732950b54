//! What was measured in an experiment, and what its source says besides, as a table of one value a row.

use crate::error::must_be_one_of;
use crate::table::{Named, Row, Table};
use crate::{Error, Result};
use std::path::Path;

/// Columns of the table.
const COLUMNS: [&str; 7] = [
    "case",
    "kind",
    "quantity",
    "value",
    "uncertainty",
    "source",
    "flag",
];

/// What a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Measured.
    Measured,
    /// Simulated by the source.
    Simulation,
    /// An equation's value as the source prints it.
    Equation,
    /// What the case file says too; it is drawn within its uncertainty.
    Input,
    /// The source says that it is not more.
    AtMost,
    /// The source says that it is not less.
    AtLeast,
}

/// Names of [`Kind`].
const KINDS: [(&str, Kind); 6] = [
    ("measured", Kind::Measured),
    ("thesis_simulation", Kind::Simulation),
    ("thesis_equation", Kind::Equation),
    ("input", Kind::Input),
    ("at_most", Kind::AtMost),
    ("at_least", Kind::AtLeast),
];

/// What has to be known of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flag {
    /// The text it was read from is damaged there.
    Damaged,
    /// It follows from others.
    Inferred,
    /// Nobody measured it.
    Assumed,
    /// It was measured, and is not to be had any more.
    Lost,
}

/// Names of [`Flag`].
const FLAGS: [(&str, Flag); 4] = [
    ("damaged", Flag::Damaged),
    ("inferred", Flag::Inferred),
    ("assumed", Flag::Assumed),
    ("lost", Flag::Lost),
];

impl Flag {
    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        let of = FLAGS.iter().find(|(_, flag)| *flag == self);
        of.map_or("", |(name, _)| name)
    }
}

/// A figure of an impact that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Figure {
    /// First to last contact, s.
    ContactTime,
    /// H/D at the largest compression.
    Height,
    /// e.
    Restitution,
    /// 1 - H/D afterwards.
    Compression,
    /// Mean equivalent plastic strain.
    Strain,
    /// F*, N.
    Force,
    /// Final length of a cylinder, m.
    Length,
    /// Mean pressure of the contact at its widest, F*/(π a²), over the lower yield strength.
    MeanPressure,
    /// Diameter of its foot, m.
    Foot,
    /// Its diameter at a fifth of the initial length above the foot, m.
    Fifth,
}

/// Something of a particle or of its throw that is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// V, m/s.
    Velocity,
    /// E, Pa.
    YoungModulus,
    /// rho, kg/m3.
    Density,
    /// D, m.
    Diameter,
    /// Gauge pressure of a tester, Pa.
    GaugePressure,
}

/// What a value is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Of an impact.
    Figure(Figure),
    /// Of what is given.
    Input(Input),
}

/// Names of quantities in SI units, and the values that they may have: above the first, up to the second.
const QUANTITIES: [(&str, Quantity, [f64; 2]); 15] = [
    (
        "contact_time_s",
        Quantity::Figure(Figure::ContactTime),
        [0.0, f64::MAX],
    ),
    (
        "height_at_max_compression_ratio",
        Quantity::Figure(Figure::Height),
        [0.0, 1.0],
    ),
    (
        "restitution",
        Quantity::Figure(Figure::Restitution),
        [0.0, 1.0],
    ),
    (
        "compression_ratio",
        Quantity::Figure(Figure::Compression),
        [0.0, 1.0],
    ),
    (
        "equivalent_plastic_strain",
        Quantity::Figure(Figure::Strain),
        [0.0, f64::MAX],
    ),
    (
        "max_force_N",
        Quantity::Figure(Figure::Force),
        [0.0, f64::MAX],
    ),
    (
        "mean_pressure_ratio",
        Quantity::Figure(Figure::MeanPressure),
        [0.0, f64::MAX],
    ),
    (
        "final_length_m",
        Quantity::Figure(Figure::Length),
        [0.0, f64::MAX],
    ),
    (
        "foot_diameter_m",
        Quantity::Figure(Figure::Foot),
        [0.0, f64::MAX],
    ),
    (
        "diameter_at_fifth_m",
        Quantity::Figure(Figure::Fifth),
        [0.0, f64::MAX],
    ),
    (
        "velocity_m_s",
        Quantity::Input(Input::Velocity),
        [0.0, f64::MAX],
    ),
    (
        "young_modulus_Pa",
        Quantity::Input(Input::YoungModulus),
        [0.0, f64::MAX],
    ),
    (
        "density_kg_m3",
        Quantity::Input(Input::Density),
        [0.0, f64::MAX],
    ),
    (
        "diameter_m",
        Quantity::Input(Input::Diameter),
        [0.0, f64::MAX],
    ),
    (
        "gauge_pressure_Pa",
        Quantity::Input(Input::GaugePressure),
        [0.0, 101_325.0],
    ),
];

impl Quantity {
    /// Its name in files, with its SI unit.
    #[must_use]
    pub fn name(self) -> &'static str {
        let of = QUANTITIES.iter().find(|(_, quantity, _)| *quantity == self);
        of.map_or("", |(name, ..)| name)
    }
}

/// Largest uncertainty of an input over its value: beyond it a normal distribution reaches below zero.
const LARGEST_SHARE: f64 = 0.3;

/// A row of the table, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Line of the file.
    pub line: u64,
    /// Case of the case file, or what several begin with, up to `, `.
    pub case: String,
    /// What it is.
    pub kind: Kind,
    /// Of what.
    pub quantity: Quantity,
    /// Its value; none of one that is lost.
    pub value: Option<f64>,
    /// How far it may be off; none where nothing says so.
    pub uncertainty: Option<f64>,
    /// Table or page.
    pub source: String,
    /// What has to be known of it.
    pub flag: Option<Flag>,
}

/// The rows of a table: columns `case`, `kind`, `quantity`, `value`, `uncertainty`, `source`, `flag`; a quantity ends in its unit.
///
/// # Errors
/// [`Error::Value`] naming line and column of what is no such table: a column or quantity that is not known, a value that no quantity of
/// its kind has, an uncertainty that is none, the same value twice.
pub fn parse(text: &str, path: &Path) -> Result<Vec<Entry>> {
    let must = format!("must have the columns {}", COLUMNS.join(", "));
    let table = Table::parse(text, path, &must)?;
    let mut columns = table.columns.iter();
    if let Some(column) = columns.find(|column| !COLUMNS.contains(&&column.name[..])) {
        let found = "no column of this name";
        return Err(table.refuse(&column.head, found, &must_be_one_of(COLUMNS)));
    }
    let mut places = [0; COLUMNS.len()];
    for (place, name) in places.iter_mut().zip(COLUMNS) {
        let at = table.place(name);
        *place = at.ok_or_else(|| table.refuse(name, "no column", &must))?;
    }
    let mut all: Vec<Entry> = Vec::new();
    for row in &table.rows {
        let cells = Cells {
            table: &table,
            row,
            places,
        };
        let entry = cells.entry()?;
        let same = |other: &&Entry| {
            other.case == entry.case && other.kind == entry.kind && other.quantity == entry.quantity
        };
        if let Some(before) = all.iter().find(same) {
            let found = format!("what line {} says already", before.line);
            return Err(table.refuse(&format!("line {}", row.line), found, "must be there once"));
        }
        all.push(entry);
    }
    match all.is_empty() {
        true => Err(table.refuse("rows", "none", "must hold a row at least")),
        false => Ok(all),
    }
}

/// A row and where its columns stand.
struct Cells<'a> {
    table: &'a Table<'a>,
    row: &'a Row,
    places: [usize; COLUMNS.len()],
}

impl Cells<'_> {
    fn text(&self, column: usize) -> &str {
        self.row.cell(self.places[column])
    }

    fn refuse(&self, column: usize, allowed: &str) -> Error {
        self.table
            .refuse_cell(self.row, self.places[column], allowed)
    }

    fn number(&self, column: usize, factor: f64) -> Result<Option<f64>> {
        let cell = self.text(column);
        if cell.is_empty() {
            return Ok(None);
        }
        // to the digits that are written, so that 1.3 ms is 0.0013 s
        let in_si = |value: f64| format!("{:.12e}", value * factor).parse::<f64>();
        match cell.parse::<f64>().and_then(in_si) {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            _ => Err(self.refuse(column, "must be a number")),
        }
    }

    fn entry(&self) -> Result<Entry> {
        let [case, kind, quantity, source, flag] = [0, 1, 2, 5, 6].map(|k| self.text(k));
        for (column, cell) in [(0, case), (5, source)] {
            if cell.is_empty() {
                return Err(self.refuse(column, "must be said"));
            }
        }
        let found = KINDS.iter().find(|(name, _)| *name == kind);
        let Some(&(_, kind)) = found else {
            return Err(self.refuse(1, &must_be_one_of(KINDS.map(|(name, _)| name))));
        };
        let named = Named::of(quantity);
        let known = named
            .as_ref()
            .and_then(|named| QUANTITIES.iter().find(|(name, ..)| *name == named.name));
        let (Some(named), Some(&(_, quantity, [above, most]))) = (&named, known) else {
            let names = must_be_one_of(QUANTITIES.map(|(name, ..)| name));
            return Err(self.refuse(2, &format!("{names}, in these or other units")));
        };
        if (kind == Kind::Input) != matches!(quantity, Quantity::Input(_)) {
            let allowed = "must be `input` for what is given, and another kind for a figure";
            return Err(self.refuse(1, allowed));
        }
        let flag = match FLAGS.iter().find(|(name, _)| *name == flag) {
            Some((_, flag)) => Some(*flag),
            None if flag.is_empty() => None,
            None => return Err(self.refuse(6, &must_be_one_of(FLAGS.map(|(name, _)| name)))),
        };
        let value = self.number(3, named.factor)?;
        if value.is_none() != (flag == Some(Flag::Lost)) {
            let allowed = "must be a number, or nothing with the flag `lost`";
            return Err(self.refuse(3, allowed));
        }
        if value.is_some_and(|value| !(value > above && value <= most)) {
            let allowed = match most == f64::MAX {
                true => format!("must be above {above}"),
                false => format!("must be above {above} and at most {most}"),
            };
            return Err(self.refuse(3, &allowed));
        }
        let uncertainty = self.number(4, named.factor)?;
        if let Some(by) = uncertainty {
            let Some(value) = value.filter(|_| by > 0.0) else {
                return Err(self.refuse(4, "must be above 0, or nothing"));
            };
            if kind == Kind::Input && by > LARGEST_SHARE * value {
                let allowed = format!("must be at most {LARGEST_SHARE} of the value");
                return Err(self.refuse(4, &allowed));
            }
        }
        Ok(Entry {
            line: self.row.line,
            case: case.to_owned(),
            kind,
            quantity,
            value,
            uncertainty,
            source: source.to_owned(),
            flag,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "case,kind,quantity,value,uncertainty,source,flag\n";

    fn refusal(rows: &str) -> String {
        parse(&format!("# a remark\n{HEAD}{rows}"), Path::new("m.csv"))
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn units_are_those_of_the_name() {
        let text = format!(
            "{HEAD}a,measured,contact_time_ms,1.5,0.2,page 1,damaged\na,input,diameter_mm,25,,page 1,\n"
        );
        let all = parse(&text, Path::new("m.csv")).unwrap();
        assert!((all[0].value.unwrap() - 1.5e-3).abs() < 1e-15);
        assert!((all[0].uncertainty.unwrap() - 2e-4).abs() < 1e-15);
        assert_eq!(all[0].flag, Some(Flag::Damaged));
        assert_eq!(all[1].quantity.name(), "diameter_m");
        assert!((all[1].value.unwrap() - 0.025).abs() < 1e-15);
    }

    #[test]
    fn every_slip_is_named_by_its_line() {
        for (row, says) in [
            ("a,measured,contact_time,1,,p,", "line 3, quantity"),
            ("a,measured,contact_time_mm,1,,p,", "line 3, quantity"),
            ("a,measured,restitution,1.2,,p,", "line 3, value"),
            ("a,measured,restitution,much,,p,", "line 3, value"),
            ("a,measured,restitution,,,p,", "line 3, value"),
            ("a,measured,restitution,0.5,,p,lost", "line 3, value"),
            ("a,measured,restitution,0.5,0,p,", "line 3, uncertainty"),
            ("a,measured,restitution,,0.1,p,lost", "line 3, uncertainty"),
            ("a,input,velocity_m_s,1,0.9,p,", "line 3, uncertainty"),
            ("a,input,restitution,0.5,,p,", "line 3, kind"),
            ("a,measured,velocity_m_s,5,,p,", "line 3, kind"),
            ("a,at_most,velocity_m_s,5,,p,", "line 3, kind"),
            ("a,at_least,restitution,1.5,,p,", "line 3, value"),
            ("a,seen,restitution,0.5,,p,", "line 3, kind"),
            ("a,measured,restitution,0.5,,,", "line 3, source"),
            ("a,measured,restitution,0.5,,p,guessed", "line 3, flag"),
            (
                "a,measured,restitution,0.5,,p,\na,measured,restitution,0.6,,p,",
                "line 4",
            ),
        ] {
            let said = refusal(row);
            assert!(said.contains(&format!("`{says}`")), "{row}: {said}");
        }
        assert!(refusal("").contains("`rows`"));
        assert!(refusal("a,measured,restitution,0.5,,p").contains("line: 3"));
        let twice = parse("case,case\n", Path::new("m.csv")).unwrap_err();
        assert!(twice.to_string().contains("twice"), "{twice}");
    }
}
