//! Body row: where a body is, how it moves and what the grains do to it, for `bodies.csv`.

use crate::dem::dynamics::any::AnyBed;
use crate::tape::keep_fields;
use serde::Serialize;

/// One body at one instant. Field names are the header of `bodies.csv`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct BodyRow {
    /// Stage.
    pub stage: String,
    /// Time.
    pub time_s: f64,
    /// Name of the body.
    pub body: String,
    /// Centre of mass.
    pub x_m: f64,
    /// See `x_m`.
    pub y_m: f64,
    /// See `x_m`.
    pub z_m: f64,
    /// Velocity of the centre of mass, half a step before.
    pub vx_m_s: f64,
    /// See `vx_m_s`.
    pub vy_m_s: f64,
    /// See `vx_m_s`.
    pub vz_m_s: f64,
    /// Angular velocity, half a step before.
    pub wx_rad_s: f64,
    /// See `wx_rad_s`.
    pub wy_rad_s: f64,
    /// See `wx_rad_s`.
    pub wz_rad_s: f64,
    /// Force of the grains on it.
    #[serde(rename = "force_x_N")]
    pub force_x: f64,
    /// See `force_x`.
    #[serde(rename = "force_y_N")]
    pub force_y: f64,
    /// See `force_x`.
    #[serde(rename = "force_z_N")]
    pub force_z: f64,
    /// Torque of the grains about its centre of mass.
    #[serde(rename = "torque_x_N_m")]
    pub torque_x: f64,
    /// See `torque_x`.
    #[serde(rename = "torque_y_N_m")]
    pub torque_y: f64,
    /// See `torque_x`.
    #[serde(rename = "torque_z_N_m")]
    pub torque_z: f64,
    /// Power of its belt on the grains.
    #[serde(rename = "belt_power_W")]
    pub belt_power: f64,
}
keep_fields!(BodyRow: stage, time_s, body, x_m, y_m, z_m, vx_m_s, vy_m_s, vz_m_s, wx_rad_s, wy_rad_s, wz_rad_s, force_x,
    force_y, force_z, torque_x, torque_y, torque_z, belt_power);

/// Rows of all bodies at the present instant.
#[must_use]
pub fn body_rows(bed: &dyn AnyBed, stage: &str) -> Vec<BodyRow> {
    let machine = bed.machine();
    let bodies = machine.bodies().iter().zip(&machine.stations).enumerate();
    bodies
        .map(|(index, (body, station))| {
            let load = bed.load_on(index);
            BodyRow {
                stage: stage.to_owned(),
                time_s: bed.clock().1,
                body: body.name.clone(),
                x_m: station.centre.x,
                y_m: station.centre.y,
                z_m: station.centre.z,
                vx_m_s: station.velocity.x,
                vy_m_s: station.velocity.y,
                vz_m_s: station.velocity.z,
                wx_rad_s: station.spin.x,
                wy_rad_s: station.spin.y,
                wz_rad_s: station.spin.z,
                force_x: load.force.x,
                force_y: load.force.y,
                force_z: load.force.z,
                torque_x: load.torque.x,
                torque_y: load.torque.y,
                torque_z: load.torque.z,
                belt_power: load.power,
            }
        })
        .collect()
}
