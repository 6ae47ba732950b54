//! Rows of `contacts_NNNN.csv`: the contacts that carry force.

use crate::dem::bodies::machine::Machine;
use crate::dem::dynamics::contact::{ContactRow, Other};
use serde::Serialize;

/// Row of `contacts_NNNN.csv`.
#[derive(Debug, Serialize)]
pub(super) struct Written<'a> {
    first: u32,
    /// The other grain; empty where a body is touched.
    other: Option<u32>,
    /// The body touched; empty where a grain is.
    body: Option<&'a str>,
    x_m: f64,
    y_m: f64,
    z_m: f64,
    normal_x: f64,
    normal_y: f64,
    normal_z: f64,
    #[serde(rename = "normal_force_N")]
    normal_force_n: f64,
    #[serde(rename = "tangential_force_N")]
    tangential_force_n: f64,
    overlap_m: f64,
    largest_overlap_m: Option<f64>,
    #[serde(rename = "plastic_J")]
    plastic_j: f64,
}

impl<'a> Written<'a> {
    /// A contact as a line of the file; its place is the middle of the overlap of two grains, or the surface.
    pub(super) fn of(row: &ContactRow, machine: &'a Machine) -> Self {
        let (other, body, point) = match row.other {
            Other::Grain(id) => (Some(id), None, 0.5 * (row.ends[0] + row.ends[1])),
            Other::Body(index) => {
                let name = machine.bodies().get(index).map(|body| body.name.as_str());
                (None, name, row.ends[1])
            }
        };
        Self {
            first: row.first,
            other,
            body,
            x_m: point.x,
            y_m: point.y,
            z_m: point.z,
            normal_x: row.normal.x,
            normal_y: row.normal.y,
            normal_z: row.normal.z,
            normal_force_n: row.normal_force(),
            tangential_force_n: row.tangential_force(),
            overlap_m: row.overlap,
            largest_overlap_m: row.largest_overlap,
            plastic_j: row.plastic,
        }
    }
}
