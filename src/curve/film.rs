//! Film: the particle at moments of its impact, as two series of files for ParaView.

use super::{MapPoint, Part, ParticleMap};
use crate::files::vtp::{Column, PolyData, collection};
use crate::files::write_atomic;
use crate::{Error, Result};
use std::path::Path;

/// The particle on the way, in the plane of a map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Film {
    /// Time since first contact (s), and the particle then.
    pub pictures: Vec<(f64, ParticleMap)>,
}

/// File of the page that plays the film, beside the series.
pub const PAGE: &str = "film.html";

/// Names of the series: material points, and the surface as a line.
const SERIES: [(&str, Part); 2] = [("points", Part::Inside), ("surface", Part::Surface)];

impl Film {
    /// Writes `points_0000.vtp`, `surface_0000.vtp`, ... and the collections `points.pvd`, `surface.pvd` that give them their
    /// times into `folder`, in place of an earlier film; of a film without pictures nothing.
    ///
    /// # Errors
    /// [`Error::File`] when a file cannot be written or removed.
    pub fn write(&self, folder: &Path) -> Result<()> {
        clear(folder)?;
        for (name, part) in SERIES {
            let mut series = Vec::new();
            for (k, (time, map)) in self.pictures.iter().enumerate() {
                let file = format!("{name}_{k:04}.vtp");
                let rows: Vec<&MapPoint> = map.points.iter().filter(|p| p.part == part).collect();
                let data = match part {
                    Part::Inside => points(&rows),
                    Part::Surface => line(&rows),
                };
                write_atomic(&folder.join(&file), data.text().as_bytes())?;
                series.push((*time, file));
            }
            if !series.is_empty() {
                let path = folder.join(format!("{name}.pvd"));
                write_atomic(&path, collection(&series).as_bytes())?;
            }
        }
        Ok(())
    }
}

/// Removes the files of an earlier film: they would be taken for this one's.
fn clear(folder: &Path) -> Result<()> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(());
    };
    let of_series = |file: &str, name: &str| match file.strip_prefix(name) {
        Some(rest) => rest == ".pvd" || (rest.starts_with('_') && rest.ends_with(".vtp")),
        None => false,
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let file = path.file_name().and_then(|file| file.to_str());
        let ours =
            |file: &str| file == PAGE || SERIES.iter().any(|(name, _)| of_series(file, name));
        if file.is_some_and(ours) {
            std::fs::remove_file(&path).map_err(Error::file("remove", &path))?;
        }
    }
    Ok(())
}

/// A row in the plane y = 0.
fn place(row: &&MapPoint) -> [f64; 3] {
    [row.r_m, 0.0, row.z_m]
}

/// Material points with all that maps show.
fn points(rows: &[&MapPoint]) -> PolyData {
    let numbers = |value: fn(&MapPoint) -> f64| rows.iter().map(|row| value(row)).collect();
    let mut point_data = vec![
        Column::scalars("size_m", numbers(|row| row.size_m)),
        Column::scalars(
            "equivalent_plastic_strain",
            numbers(|row| row.equivalent_plastic_strain),
        ),
        Column::scalars("von_mises_Pa", numbers(|row| row.von_mises_pa)),
        Column::scalars("pressure_Pa", numbers(|row| row.pressure_pa)),
    ];
    let temperatures: Option<Vec<f64>> = rows.iter().map(|row| row.temperature_k).collect();
    if let Some(temperatures) = temperatures.filter(|all| !all.is_empty()) {
        point_data.push(Column::scalars("temperature_K", temperatures));
    }
    PolyData {
        points: rows.iter().map(place).collect(),
        point_data,
        ..PolyData::default()
    }
}

/// The surface from pole to pole.
fn line(rows: &[&MapPoint]) -> PolyData {
    PolyData {
        points: rows.iter().map(place).collect(),
        lines: (1..rows.len() as u32).map(|k| [k - 1, k]).collect(),
        ..PolyData::default()
    }
}
