//! A table of measured speeds as text.

use super::Particle;
use super::fit::{FEWEST, Measured};
use crate::Result;
use crate::table::{Row, Table};
use std::path::Path;

/// Columns of a table of measured speeds.
const COLUMNS: [&str; 4] = [
    "density_kg_m3",
    "diameter_m",
    "gauge_pressure_Pa",
    "velocity_m_s",
];

/// Measured speeds of a table with the columns `density_kg_m3`, `diameter_m`, `gauge_pressure_Pa` and `velocity_m_s`, in these or other
/// units; other columns are remarks.
///
/// # Errors
/// [`crate::Error::Value`] for what is no such table, by its line where it has one.
pub fn parse(text: &str, path: &Path) -> Result<Vec<Measured>> {
    let table = Table::parse(text, path, "must be a table of measured speeds")?;
    if table.rows.len() < FEWEST {
        let allowed = "must be at least five measured speeds below a line of names";
        return Err(table.refuse("rows", table.rows.len().to_string(), allowed));
    }
    let places = COLUMNS.map(|name| table.place(name));
    let [
        Some(density),
        Some(diameter),
        Some(pressure),
        Some(velocity),
    ] = places
    else {
        let missing = COLUMNS.into_iter().zip(places);
        let missing = missing.filter_map(|(name, place)| place.is_none().then_some(name));
        let missing: Vec<&str> = missing.collect();
        let allowed = "must be there, in these or other units: `gauge_pressure_kPa`";
        return Err(table.refuse(&missing.join(", "), "no column", allowed));
    };
    let measured = |row: &Row| {
        let number = |at: usize| positive(&table, row, at);
        Ok(Measured {
            particle: Particle {
                diameter: number(diameter)?,
                density: number(density)?,
            },
            pressure: number(pressure)?,
            speed: number(velocity)?,
        })
    };
    table.rows.iter().map(measured).collect()
}

/// A number of a row, above 0.
fn positive(table: &Table<'_>, row: &Row, at: usize) -> Result<f64> {
    match table.number(row, at) {
        Some(value) if value > 0.0 && value.is_finite() => Ok(value),
        Some(value) if value <= 0.0 => {
            let allowed =
                "must be positive; a fall without a vacuum tells nothing of the correlation";
            Err(table.refuse_cell(row, at, allowed))
        }
        _ => Err(table.refuse_cell(row, at, "must be a number")),
    }
}
