//! Oedometer: stress, strain, coordination and dissipation under all laws, side by side in one file.

use crate::Result;
use crate::bed::measures::series::Row;
use crate::files::write_rows;
use serde::Serialize;
use std::path::Path;

/// Row of `oedometer.csv`.
#[derive(Serialize)]
struct OedometerRow<'a> {
    law: &'a str,
    stage: &'a str,
    strain: f64,
    #[serde(rename = "stress_Pa")]
    stress_pa: f64,
    #[serde(rename = "lateral_stress_Pa")]
    lateral_stress_pa: f64,
    coordination: f64,
    inertial_number: f64,
    solid_fraction: f64,
    #[serde(rename = "plastic_J")]
    plastic_j: f64,
    #[serde(rename = "friction_J")]
    friction_j: f64,
    #[serde(rename = "damping_J")]
    damping_j: f64,
    #[serde(rename = "driven_work_J")]
    driven_work_j: f64,
}

/// Writes `oedometer.csv` of the rows of each law.
///
/// # Errors
/// [`crate::Error::File`] when it cannot be written.
pub fn write<'a>(
    path: &Path,
    provenance: &str,
    laws: impl Iterator<Item = (&'a str, &'a [Row])>,
) -> Result<()> {
    let each =
        |(law, rows): (&'a str, &'a [Row])| rows.iter().map(move |row| oedometer_row(law, row));
    let rows: Vec<OedometerRow> = laws.flat_map(each).collect();
    write_rows(path, provenance, &rows)
}

fn oedometer_row<'a>(law: &'a str, row: &'a Row) -> OedometerRow<'a> {
    OedometerRow {
        law,
        stage: &row.stage,
        strain: row.strain,
        stress_pa: row.stress_pa,
        lateral_stress_pa: row.lateral_stress_pa,
        coordination: row.coordination,
        inertial_number: row.inertial_number,
        solid_fraction: row.solid_fraction,
        plastic_j: row.plastic_j,
        friction_j: row.losses.friction,
        damping_j: row.losses.damping,
        driven_work_j: row.driven_work_j,
    }
}
