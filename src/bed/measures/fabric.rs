//! Fabric of a bed at one instant: stress and fabric tensors, and coordination without rattlers.

use crate::dem::dynamics::contact::{ContactRow, Other};
use crate::dem::grains::Grains;
use crate::tape::keep_fields;
use nalgebra::{Matrix3, Vector3};
use parry3d::math::Vector;
use serde::Serialize;

/// What the contacts and motions of a bed sum up to.
///
/// $$ V \sigma_{ij} = \sum_c l^c_i f^c_j + \sum_p m^p v'^p_i v'^p_j, \qquad
///    \phi_{ij} = \frac{1}{N_c} \sum_c n^c_i n^c_j, \qquad
///    Z_m = \frac{2 N_c - N_1}{N - N_0 - N_1} $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | V | m3 | volume of the bed |
/// | sigma | Pa | stress, pressure positive: a part from contacts, a part from motion |
/// | l, f | m, N | branch vector and force of a contact; contacts with bodies count, from the surface to the centre |
/// | v' | m/s | velocity of a grain relative to the mean of the bed's mass |
/// | phi | 1 | fabric of the contacts between grains; its trace is 1 |
/// | Z_m | 1 | mechanical coordination: without the N_0 grains that have no contact and the N_1 that have one |
///
/// Source: Love 1927 and Weber 1966 for the stress, Satake 1978 for the fabric, Thornton 2000 for Z_m (contacts with
/// bodies are left out of N_c, as there in a periodic cell). Differs from the papers: none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fabric {
    /// Contact part of stress times volume, J.
    pub contact: Matrix3<f64>,
    /// Part of the motion, J.
    pub kinetic: Matrix3<f64>,
    /// Fabric tensor of the contacts between grains; zero without any.
    pub fabric: Matrix3<f64>,
    /// Contacts between grains.
    pub contacts: usize,
    /// Contacts of grains with bodies.
    pub wall_contacts: usize,
    /// Grains with at most one contact, bodies counted.
    pub rattlers: usize,
    /// Mechanical coordination number; 0 where every grain is a rattler.
    pub mechanical_coordination: f64,
    /// Mean normal force of the contacts between grains, N.
    pub mean_force: f64,
    /// Largest normal force of a contact, N.
    pub largest_force: f64,
}

fn column(v: Vector) -> Vector3<f64> {
    Vector3::from(v.to_array())
}

impl Fabric {
    /// Sums over the contacts that carry force, and over the grains.
    #[must_use]
    pub fn of(rows: &[ContactRow], grains: &Grains) -> Self {
        let names = grains.ids.iter().max().map_or(0, |&id| id as usize + 1);
        let (mut between, mut all) = (vec![0u32; names], vec![0u32; names]);
        let mut fabric = Self {
            contact: Matrix3::zeros(),
            kinetic: kinetic(grains),
            fabric: Matrix3::zeros(),
            contacts: 0,
            wall_contacts: 0,
            rattlers: 0,
            mechanical_coordination: 0.0,
            mean_force: 0.0,
            largest_force: 0.0,
        };
        for row in rows {
            fabric.contact += column(row.branch()) * column(row.force).transpose();
            let force = row.normal_force();
            fabric.largest_force = fabric.largest_force.max(force);
            all[row.first as usize] += 1;
            match row.other {
                Other::Grain(other) => {
                    let normal = column(row.normal);
                    fabric.fabric += normal * normal.transpose();
                    fabric.contacts += 1;
                    fabric.mean_force += force;
                    all[other as usize] += 1;
                    between[row.first as usize] += 1;
                    between[other as usize] += 1;
                }
                Other::Body(_) => fabric.wall_contacts += 1,
            }
        }
        if fabric.contacts > 0 {
            fabric.fabric /= fabric.contacts as f64;
            fabric.mean_force /= fabric.contacts as f64;
        }
        let count =
            |of: &[u32], n: u32| grains.ids.iter().filter(|&&i| of[i as usize] == n).count();
        fabric.rattlers = count(&all, 0) + count(&all, 1);
        let (alone, single) = (count(&between, 0), count(&between, 1));
        let carrying = grains.len() - alone - single;
        if carrying > 0 {
            fabric.mechanical_coordination =
                (2 * fabric.contacts - single) as f64 / carrying as f64;
        }
        fabric
    }
}

/// Fluctuation part of stress times volume, J.
fn kinetic(grains: &Grains) -> Matrix3<f64> {
    let (mut mass, mut momentum) = (0.0, Vector::ZERO);
    for motion in &grains.motions {
        mass += 1.0 / motion.inverse_mass;
        momentum += motion.velocity / motion.inverse_mass;
    }
    let mean = if mass > 0.0 {
        momentum / mass
    } else {
        momentum
    };
    let mut sum = Matrix3::zeros();
    for motion in &grains.motions {
        let apart = column(motion.velocity - mean);
        sum += apart * apart.transpose() / motion.inverse_mass;
    }
    sum
}

/// Row of `stress.csv`. The tensors are symmetric but for the couples of friction: their symmetric parts are written.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FabricRow {
    /// Stage.
    pub stage: String,
    /// Time.
    pub time_s: f64,
    /// Volume the stress is taken over; 0 where the scene has none, and then so are the stresses.
    pub volume_m3: f64,
    /// Contact stress.
    #[serde(rename = "stress_xx_Pa")]
    pub xx: f64,
    /// See `xx`.
    #[serde(rename = "stress_yy_Pa")]
    pub yy: f64,
    /// See `xx`.
    #[serde(rename = "stress_zz_Pa")]
    pub zz: f64,
    /// See `xx`.
    #[serde(rename = "stress_xy_Pa")]
    pub xy: f64,
    /// See `xx`.
    #[serde(rename = "stress_yz_Pa")]
    pub yz: f64,
    /// See `xx`.
    #[serde(rename = "stress_zx_Pa")]
    pub zx: f64,
    /// Pressure of the contacts: a third of the trace.
    #[serde(rename = "pressure_Pa")]
    pub pressure: f64,
    /// Mises' shear stress of the contacts.
    #[serde(rename = "shear_stress_Pa")]
    pub shear: f64,
    /// Stress of the motion.
    #[serde(rename = "kinetic_xx_Pa")]
    pub kinetic_xx: f64,
    /// See `kinetic_xx`.
    #[serde(rename = "kinetic_yy_Pa")]
    pub kinetic_yy: f64,
    /// See `kinetic_xx`.
    #[serde(rename = "kinetic_zz_Pa")]
    pub kinetic_zz: f64,
    /// Fabric of the contacts between grains.
    pub fabric_xx: f64,
    /// See `fabric_xx`.
    pub fabric_yy: f64,
    /// See `fabric_xx`.
    pub fabric_zz: f64,
    /// See `fabric_xx`.
    pub fabric_xy: f64,
    /// See `fabric_xx`.
    pub fabric_yz: f64,
    /// See `fabric_xx`.
    pub fabric_zx: f64,
    /// Contacts between grains.
    pub contacts: usize,
    /// Contacts with bodies.
    pub wall_contacts: usize,
    /// Grains with at most one contact.
    pub rattlers: usize,
    /// Coordination number without rattlers.
    pub mechanical_coordination: f64,
    /// Mean normal force between grains.
    #[serde(rename = "mean_force_N")]
    pub mean_force: f64,
    /// Largest normal force.
    #[serde(rename = "largest_force_N")]
    pub largest_force: f64,
}
keep_fields!(FabricRow: stage, time_s, volume_m3, xx, yy, zz, xy, yz, zx, pressure, shear, kinetic_xx, kinetic_yy,
    kinetic_zz, fabric_xx, fabric_yy, fabric_zz, fabric_xy, fabric_yz, fabric_zx, contacts, wall_contacts, rattlers,
    mechanical_coordination, mean_force, largest_force);

impl FabricRow {
    /// Row of an instant; `volume` (m3) is that of the bed, 0 where there is none to speak of.
    #[must_use]
    pub fn new(stage: &str, time: f64, volume: f64, fabric: &Fabric) -> Self {
        let over = |tensor: &Matrix3<f64>| match volume > 0.0 {
            true => 0.5 * (tensor + tensor.transpose()) / volume,
            false => Matrix3::zeros(),
        };
        let (stress, kinetic, phi) = (over(&fabric.contact), over(&fabric.kinetic), fabric.fabric);
        let pressure = stress.trace() / 3.0;
        let deviator = stress - Matrix3::identity() * pressure;
        Self {
            stage: stage.to_owned(),
            time_s: time,
            volume_m3: volume,
            xx: stress[(0, 0)],
            yy: stress[(1, 1)],
            zz: stress[(2, 2)],
            xy: stress[(0, 1)],
            yz: stress[(1, 2)],
            zx: stress[(2, 0)],
            pressure,
            shear: (1.5 * deviator.norm_squared()).sqrt(),
            kinetic_xx: kinetic[(0, 0)],
            kinetic_yy: kinetic[(1, 1)],
            kinetic_zz: kinetic[(2, 2)],
            fabric_xx: phi[(0, 0)],
            fabric_yy: phi[(1, 1)],
            fabric_zz: phi[(2, 2)],
            fabric_xy: phi[(0, 1)],
            fabric_yz: phi[(1, 2)],
            fabric_zx: phi[(2, 0)],
            contacts: fabric.contacts,
            wall_contacts: fabric.wall_contacts,
            rattlers: fabric.rattlers,
            mechanical_coordination: fabric.mechanical_coordination,
            mean_force: fabric.mean_force,
            largest_force: fabric.largest_force,
        }
    }
}
