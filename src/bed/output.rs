//! Output: the files of one bed run: time series, figures, and frames for ParaView.

use super::bodies::Solid;
use super::compose::AnyBed;
use super::gauge::Finding;
use super::protocol::Observer;
use super::row::{Row, closure};
use super::vtp::{Column, PolyData, collection};
use crate::files::write_atomic;
use crate::{Error, Result};
use parry3d::math::Vector;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Figures of one run (keys of `summary.json`).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Law between the grains.
    pub law: String,
    /// Grains.
    pub grains: usize,
    /// Time steps.
    pub steps: u64,
    /// Time simulated, s.
    pub time_s: f64,
    /// Smallest time step used, s.
    pub time_step_s: f64,
    /// Wall time, s.
    pub wall_s: f64,
    /// Grains times steps over wall time.
    pub particle_steps_per_s: f64,
    /// Largest imbalance of energy over the largest turnover.
    pub energy_closure: f64,
    /// Largest number of grains seen outside the box.
    pub lost_grains: usize,
    /// Largest overlap over diameter.
    pub max_overlap_ratio: f64,
    /// Largest number of contacts flattened beyond what the law's source supports.
    pub beyond_validity: usize,
    /// Largest stress on the piston.
    #[serde(rename = "max_stress_Pa")]
    pub max_stress_pa: f64,
    /// Strain left when the piston has come off.
    pub residual_strain: f64,
    /// Coordination number at the largest strain.
    pub coordination: f64,
    /// Inertial number at the largest stress.
    pub inertial_number: f64,
    /// Energy dissipated by plastic flow over all energy dissipated.
    pub plastic_share: f64,
    /// Contact stiffness over that of the material, as the scene asks for.
    pub contact_stiffness: f64,
    /// The same while the packing was made.
    pub settling_stiffness: f64,
    /// What the measures of the scene have found.
    pub findings: Vec<Finding>,
    /// What must be known before the figures are used.
    pub warnings: Vec<String>,
    /// How the run ended.
    pub status: &'static str,
}

/// What a run counted as it went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counts {
    /// Grains.
    pub grains: usize,
    /// Steps done.
    pub steps: u64,
    /// Steps of single grains.
    pub particle_steps: u64,
    /// Wall time, s.
    pub wall_s: f64,
    /// Grains outside.
    pub lost: usize,
    /// Contacts beyond the law's validity.
    pub beyond_validity: usize,
    /// Largest overlap over diameter.
    pub max_overlap_ratio: f64,
    /// Contact stiffness over that of the material, as the scene asks for.
    pub contact_stiffness: f64,
    /// The same while the packing was made.
    pub settling_stiffness: f64,
}

impl Summary {
    /// Figures of a run of `law` from its rows and counts.
    #[must_use]
    pub fn new(law: &str, rows: &[Row], counts: Counts) -> Self {
        let most =
            |value: fn(&Row) -> f64| rows.iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        let (peak, deepest, last) = (most(|r| r.stress_pa), most(|r| r.strain), rows.last());
        let dissipated = |r: &Row| r.friction_j + r.rolling_j + r.damping_j + r.plastic_j;
        Self {
            law: law.to_owned(),
            grains: counts.grains,
            steps: counts.steps,
            time_s: last.map_or(0.0, |r| r.time_s),
            time_step_s: rows
                .iter()
                .fold(f64::INFINITY, |dt, r| dt.min(r.time_step_s)),
            wall_s: counts.wall_s,
            particle_steps_per_s: counts.particle_steps as f64 / counts.wall_s,
            energy_closure: closure(rows),
            lost_grains: counts.lost,
            max_overlap_ratio: counts.max_overlap_ratio,
            beyond_validity: counts.beyond_validity,
            max_stress_pa: peak.map_or(0.0, |r| r.stress_pa),
            residual_strain: last.map_or(0.0, |r| r.strain),
            coordination: deepest.map_or(0.0, |r| r.coordination),
            inertial_number: peak.map_or(0.0, |r| r.inertial_number),
            plastic_share: last.map_or(0.0, |r| r.plastic_j / dissipated(r).max(f64::MIN_POSITIVE)),
            contact_stiffness: counts.contact_stiffness,
            settling_stiffness: counts.settling_stiffness,
            findings: Vec::new(),
            warnings: Vec::new(),
            status: "ok",
        }
    }

    /// Writes `summary.json` into `folder`.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let path = folder.join("summary.json");
        let text = serde_json::to_string_pretty(self)
            .map_err(|e| Error::file("write", &path)(e.into()))?;
        write_atomic(&path, text.as_bytes())
    }
}

/// Writes frames of a run for ParaView: grains, contacts and bodies, each a series with its times.
pub struct Frames {
    folder: PathBuf,
    every: usize,
    rows: usize,
    stage: String,
    series: [Vec<(f64, String)>; 3],
}

/// Names of the three series.
const SERIES: [&str; 3] = ["grains", "contacts", "bodies"];

impl Frames {
    /// Frames in `folder`, about `frames` of every `rows` rows of a stage.
    #[must_use]
    pub fn new(folder: &Path, rows: usize, frames: usize) -> Self {
        Self {
            folder: folder.to_owned(),
            every: rows.checked_div(frames).unwrap_or(0),
            rows: 0,
            stage: String::new(),
            series: Default::default(),
        }
    }

    fn write(&mut self, bed: &dyn AnyBed, time: f64) -> Result<()> {
        let number = self.series[0].len();
        let frames = [grains(bed), contacts(bed), bodies(bed)];
        for ((name, series), data) in SERIES.iter().zip(&mut self.series).zip(frames) {
            let file = format!("{name}_{number:04}.vtp");
            write_atomic(&self.folder.join(&file), data.text().as_bytes())?;
            series.push((time, file));
            let path = self.folder.join(format!("{name}.pvd"));
            write_atomic(&path, collection(series).as_bytes())?;
        }
        Ok(())
    }
}

impl Observer for Frames {
    fn row(&mut self, bed: &dyn AnyBed, row: &Row) -> Result<()> {
        if self.stage != row.stage {
            (self.stage, self.rows) = (row.stage.clone(), 0);
        }
        let due = self.every > 0 && self.rows.is_multiple_of(self.every);
        self.rows += 1;
        if due {
            self.write(bed, row.time_s)
        } else {
            Ok(())
        }
    }
}

/// Grains as points with their radius, motion and plastic dissipation.
fn grains(bed: &dyn AnyBed) -> PolyData {
    let grains = bed.grains();
    PolyData {
        points: grains.spheres.iter().map(|s| s.centre).collect(),
        point_data: vec![
            Column::scalars(
                "radius_m",
                grains.spheres.iter().map(|s| s.radius).collect(),
            ),
            Column::scalars("id", grains.ids.iter().map(|&id| f64::from(id)).collect()),
            Column::vectors("velocity_m_s", grains.motions.iter().map(|m| m.velocity)),
            Column::vectors("spin_rad_s", grains.spins.iter().map(|s| s.rate)),
            Column::scalars("plastic_J", bed.plastic_by_grain()),
        ],
        ..PolyData::default()
    }
}

/// Contacts that carry force, as lines with that force: the force chains.
fn contacts(bed: &dyn AnyBed) -> PolyData {
    let rows = bed.contact_rows();
    PolyData {
        points: rows.iter().flat_map(|row| row.ends).collect(),
        lines: (0..rows.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect(),
        cell_data: vec![
            Column::scalars(
                "force_N",
                rows.iter().map(|row| row.force.length()).collect(),
            ),
            Column::vectors("force_vector_N", rows.iter().map(|row| row.force)),
            Column::scalars("overlap_m", rows.iter().map(|row| row.overlap).collect()),
            Column::scalars("plastic_J", rows.iter().map(|row| row.plastic).collect()),
        ],
        ..PolyData::default()
    }
}

/// Bodies as triangles, with the index and the load of each.
fn bodies(bed: &dyn AnyBed) -> PolyData {
    let machine = bed.machine();
    let mut data = PolyData::default();
    let (mut index, mut load) = (Vec::new(), Vec::new());
    for (number, (body, surface)) in machine.bodies().iter().zip(&machine.surfaces).enumerate() {
        let (vertices, triangles) = outline(&body.solid);
        let first = data.points.len() as u32;
        let place = |v: Vector| surface.pose.transform_point(v / machine.unit) * machine.unit;
        data.points.extend(vertices.into_iter().map(place));
        for triangle in triangles {
            data.triangles.push(triangle.map(|corner| corner + first));
            index.push(number as f64);
            load.push(bed.force_on(number));
        }
    }
    data.cell_data = vec![
        Column::scalars("body", index),
        Column::vectors("load_N", load),
    ];
    data
}

/// Triangles of a shape, m.
fn outline(solid: &Solid) -> (Vec<Vector>, Vec<[u32; 3]>) {
    /// Segments around a round shape: for looking at, not for contact.
    const SEGMENTS: u32 = 32;
    /// Half the edge of the part of a plane that is drawn, m.
    const PLANE: f64 = 0.05;
    match solid {
        Solid::Cuboid(half) => parry3d::shape::Cuboid::new(*half).to_trimesh(),
        Solid::Ball(radius) => parry3d::shape::Ball::new(*radius).to_trimesh(SEGMENTS, SEGMENTS),
        Solid::Cylinder {
            radius,
            half_height,
        } => parry3d::shape::Cylinder::new(*half_height, *radius).to_trimesh(SEGMENTS),
        Solid::HalfSpace => {
            parry3d::shape::Cuboid::new(Vector::new(PLANE, PLANE, 0.0)).to_trimesh()
        }
        Solid::Mesh {
            vertices,
            triangles,
        } => (vertices.clone(), triangles.clone()),
    }
}
