//! Frames of a run for ParaView: grains, contacts and bodies, each a series of VTP files with its times.

use crate::Result;
use crate::dem::dynamics::any::AnyBed;
use crate::dem::dynamics::contact::{ContactRow, Other};
use crate::files::vtp::{Column, PolyData, collection};
use crate::files::write_atomic;
use crate::tape::keep_fields;
use crate::view::outline::Outline;
use std::path::{Path, PathBuf};

/// Names of the three series.
const SERIES: [&str; 3] = ["grains", "contacts", "bodies"];

/// Frames written so far.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frames {
    folder: PathBuf,
    times: Vec<f64>,
}
keep_fields!(Frames: times; rebuilt folder);

impl Frames {
    /// Frames in `folder`, none yet.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            times: Vec::new(),
        }
    }

    /// Writes one frame more, and the collections that give the frames their times.
    ///
    /// # Errors
    /// [`crate::Error::File`] when a file cannot be written.
    pub fn write(&mut self, bed: &dyn AnyBed, rows: &[ContactRow]) -> Result<()> {
        let number = self.times.len();
        self.times.push(bed.clock().1);
        let frames = [grains(bed), contacts(rows), bodies(bed)];
        for (name, data) in SERIES.iter().zip(frames) {
            let file = |number: usize| format!("{name}_{number:04}.vtp");
            write_atomic(&self.folder.join(file(number)), data.text().as_bytes())?;
            let series = self.times.iter().enumerate();
            let series: Vec<(f64, String)> = series.map(|(k, &time)| (time, file(k))).collect();
            let path = self.folder.join(format!("{name}.pvd"));
            write_atomic(&path, collection(&series).as_bytes())?;
        }
        Ok(())
    }

    /// Number of frames.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }
}

/// Grains as points with their radius, material and group (which count from 0), motion, forces and plastic dissipation.
fn grains(bed: &dyn AnyBed) -> PolyData {
    let grains = bed.grains();
    let per = |value: &dyn Fn(usize) -> f64| (0..grains.len()).map(value).collect();
    PolyData {
        points: grains.spheres.iter().map(|s| s.centre.to_array()).collect(),
        point_data: vec![
            Column::scalars(
                "radius_m",
                grains.spheres.iter().map(|s| s.radius).collect(),
            ),
            Column::scalars("id", grains.ids.iter().map(|&id| f64::from(id)).collect()),
            Column::scalars("material", per(&|grain| f64::from(grains.material(grain)))),
            Column::scalars("group", per(&|grain| f64::from(grains.groups[grain]))),
            Column::vectors(
                "velocity_m_s",
                grains.motions.iter().map(|m| m.velocity.to_array()),
            ),
            Column::vectors("spin_rad_s", grains.spins.iter().map(|s| s.rate.to_array())),
            Column::scalars("force_sum_N", bed.squeeze()),
            Column::scalars("plastic_J", bed.plastic_by_grain()),
        ],
        ..PolyData::default()
    }
}

/// Contacts that carry force, as lines with that force: the force chains. A body stands as -1 less its number.
fn contacts(rows: &[ContactRow]) -> PolyData {
    let numbers = |value: fn(&ContactRow) -> f64| rows.iter().map(value).collect();
    let mut cell_data = vec![
        Column::scalars("first_id", numbers(|row| f64::from(row.first))),
        Column::scalars(
            "other_id",
            numbers(|row| match row.other {
                Other::Grain(id) => f64::from(id),
                Other::Body(index) => -1.0 - index as f64,
            }),
        ),
        Column::scalars("force_N", numbers(|row| row.force.length())),
        Column::scalars("normal_force_N", numbers(ContactRow::normal_force)),
        Column::scalars("tangential_force_N", numbers(ContactRow::tangential_force)),
        Column::vectors(
            "force_vector_N",
            rows.iter().map(|row| row.force.to_array()),
        ),
        Column::scalars("overlap_m", numbers(|row| row.overlap)),
        Column::scalars("plastic_J", numbers(|row| row.plastic)),
    ];
    let largest: Option<Vec<f64>> = rows.iter().map(|row| row.largest_overlap).collect();
    cell_data.extend(largest.map(|values| Column::scalars("largest_overlap_m", values)));
    PolyData {
        points: rows
            .iter()
            .flat_map(|row| row.ends.map(|end| end.to_array()))
            .collect(),
        lines: (0..rows.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect(),
        cell_data,
        ..PolyData::default()
    }
}

/// Bodies as triangles, with the index and the load of each; those taken out are left out.
fn bodies(bed: &dyn AnyBed) -> PolyData {
    let machine = bed.machine();
    let mut data = PolyData::default();
    let (mut index, mut force, mut torque) = (Vec::new(), Vec::new(), Vec::new());
    for (number, surface) in machine.surfaces.iter().enumerate() {
        if surface.removed {
            continue;
        }
        let outline = Outline::of(&*surface.shape, 1.0);
        let first = data.points.len() as u32;
        let place = |v| (surface.pose.transform_point(v) * machine.unit).to_array();
        data.points.extend(outline.vertices.into_iter().map(place));
        let load = bed.load_on(number);
        for triangle in outline.triangles {
            data.triangles.push(triangle.map(|corner| corner + first));
            index.push(number as f64);
            force.push(load.force.to_array());
            torque.push(load.torque.to_array());
        }
    }
    data.cell_data = vec![
        Column::scalars("body", index),
        Column::vectors("load_N", force),
        Column::vectors("torque_N_m", torque),
    ];
    data
}
