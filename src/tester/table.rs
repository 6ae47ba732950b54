//! A table of measured speeds as text.

use super::Particle;
use super::fit::{FEWEST, Measured};
use crate::discover::table::Table;
use crate::{Error, Result};
use std::path::Path;

/// Measured speeds of a table with the columns `density_kg_m3`, `diameter_m`, `gauge_pressure_Pa` and `velocity_m_s`, in these or other units.
///
/// # Errors
/// [`Error::Value`] for what is no such table, by its line where it has one.
pub fn parse(text: &str, path: &Path) -> Result<Vec<Measured>> {
    const COLUMNS: [&str; 4] = [
        "density_kg_m3",
        "diameter_m",
        "gauge_pressure_Pa",
        "velocity_m_s",
    ];
    let value = |key: String, found: String, allowed: &str| Error::Value {
        path: path.to_owned(),
        key,
        found,
        allowed: allowed.to_owned(),
        place: None,
    };
    let is_row = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let rows = text.lines().filter(is_row).count().saturating_sub(1);
    if rows < FEWEST {
        return Err(value(
            "rows".to_owned(),
            rows.to_string(),
            "must be at least five measured speeds below a line of names",
        ));
    }
    let table = Table::parse(text, path)?;
    let columns = COLUMNS.map(|name| table.inputs.iter().find(|column| column.name == name));
    let [
        Some(density),
        Some(diameter),
        Some(pressure),
        Some(velocity),
    ] = columns
    else {
        let missing: Vec<&str> = COLUMNS
            .into_iter()
            .zip(columns)
            .filter_map(|(name, column)| column.is_none().then_some(name))
            .collect();
        return Err(value(
            missing.join(", "),
            "no column".to_owned(),
            "must be there, in these or other units: `gauge_pressure_kPa`",
        ));
    };
    let mut all = Vec::new();
    for (row, line) in table.lines.iter().enumerate() {
        for column in [density, diameter, pressure, velocity] {
            if column.values[row] <= 0.0 {
                return Err(value(
                    format!("line {line}, {}", column.name),
                    column.values[row].to_string(),
                    "must be positive; a fall without a vacuum tells nothing of the correlation",
                ));
            }
        }
        all.push(Measured {
            particle: Particle {
                diameter: diameter.values[row],
                density: density.values[row],
            },
            pressure: pressure.values[row],
            speed: velocity.values[row],
        });
    }
    Ok(all)
}
