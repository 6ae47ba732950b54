//! Row of the bed's time series, and the account of its energy.

use crate::Result;
use crate::dem::bodies::enclosure::{PISTON, Room};
use crate::dem::dynamics::any::AnyBed;
use crate::dem::dynamics::state::{Energies, Packing};
use crate::dem::force::losses::Losses;
use crate::files::write_rows;
use crate::material::Material;
use crate::tape::keep_fields;
use serde::Serialize;
use std::path::Path;

keep_fields! {
/// One instant of a bed. Field names are the header of `bed.csv`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Row {
    /// Stage.
    pub stage: String,
    /// Time, s.
    pub time_s: f64,
    /// Steps done.
    pub step: u64,
    /// Time step, s.
    pub time_step_s: f64,
    /// Height of the piston's face, or of the highest grain while the piston is parked, m; the period where z is periodic.
    pub height_m: f64,
    /// Compression since the seating stress was reached for good, over the height then.
    pub strain: f64,
    /// Stress on the piston.
    #[serde(rename = "stress_Pa")]
    pub stress_pa: f64,
    /// Mean normal stress on the four walls.
    #[serde(rename = "lateral_stress_Pa")]
    pub lateral_stress_pa: f64,
    /// Vertical stress inside, from the contacts between grains.
    #[serde(rename = "virial_stress_Pa")]
    pub virial_stress_pa: f64,
    /// Contacts between grains per grain.
    pub coordination: f64,
    /// Volume of the grains over that of the bed.
    pub solid_fraction: f64,
    /// Largest overlap over the diameter.
    pub max_overlap_ratio: f64,
    /// Contacts flattened beyond what the law's source supports.
    pub beyond_validity: usize,
    /// Contacts that have yielded and let go short of the slowest impact of the law.
    pub below_validity: usize,
    /// Fastest grain.
    pub max_speed_m_s: f64,
    /// Inertial number: strain rate times diameter times root of density over stress; 0 without a stress.
    pub inertial_number: f64,
    /// Kinetic energy.
    #[serde(rename = "kinetic_J")]
    pub kinetic_j: f64,
    /// Energy in gravity, above the floor.
    #[serde(rename = "potential_J")]
    pub potential_j: f64,
    /// Energy recoverable from normal contact.
    #[serde(rename = "elastic_J")]
    pub elastic_j: f64,
    /// Energy stored by effects: in tangential and rolling springs.
    #[serde(rename = "springs_J")]
    pub springs_j: f64,
    /// Dissipated by plastic flow.
    #[serde(rename = "plastic_J")]
    pub plastic_j: f64,
    /// Work done by driven bodies and belts.
    #[serde(rename = "driven_work_J")]
    pub driven_work_j: f64,
    /// Work done by raising the stiffness.
    #[serde(rename = "stiffening_work_J")]
    pub stiffening_work_j: f64,
    /// Grains that have left through outlets.
    pub outlet_grains: usize,
    /// Their mass.
    pub outlet_mass_kg: f64,
    /// Mass that leaves in a time, mean since the row before.
    pub outlet_rate_kg_s: f64,
    /// Energy that left with them: of motion, in gravity, and held in their contacts.
    #[serde(rename = "outlet_J")]
    pub outlet_j: f64,
    /// Energy present and dissipated less work done, minus the same at the start; what grains brought and took is accounted
    /// for.
    #[serde(rename = "imbalance_J")]
    pub imbalance_j: f64,
    /// Dissipated by each effect; its columns stand behind the others.
    #[serde(skip)]
    pub losses: Losses,
}
}

/// What a row needs beside the bed.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// The box.
    pub room: &'a Room,
    /// Grain material.
    pub material: &'a Material,
    /// Volume of all grains, m3.
    pub grain_volume: f64,
    /// Mean diameter, m.
    pub diameter: f64,
}

/// Where a stage has got to.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// Stage.
    pub stage: String,
    /// Speed of the piston, m/s; 0 while it is parked.
    pub piston_speed: f64,
    /// Height at which the seating stress began to be sustained, m; none before that is known.
    pub seated_height: Option<f64>,
    /// Energy balance at the start of the account, J.
    pub first_balance: f64,
}
keep_fields!(Progress: stage, piston_speed, seated_height, first_balance);

/// What has left through outlets, and what had when the row before was taken.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Left {
    /// Grains.
    pub grains: usize,
    /// Mass, kg.
    pub mass: f64,
    /// Energy, J.
    pub energy: f64,
    /// Time (s), mass (kg) and rate (kg/s) of the row before.
    pub before: [f64; 3],
}

impl Left {
    /// Mean rate (kg/s) since the row before; that of the row itself at the same instant.
    fn rate(&self, now: f64) -> f64 {
        let [time, mass, rate] = self.before;
        if now > time {
            (self.mass - mass) / (now - time)
        } else {
            rate
        }
    }
}

impl View<'_> {
    /// A body of the box; bodies of the scene may bear such a name where there is no box.
    fn own(&self, bed: &dyn AnyBed, name: &str) -> Option<usize> {
        bed.machine().find(name).filter(|_| self.room.owns(name))
    }

    /// Stress on the piston, Pa.
    #[must_use]
    pub fn stress(&self, bed: &dyn AnyBed) -> f64 {
        let piston = self.own(bed, PISTON);
        piston.map_or(0.0, |piston| bed.force_on(piston).z / self.room.area())
    }

    /// Height of the piston's face, m.
    #[must_use]
    pub fn face(&self, bed: &dyn AnyBed) -> f64 {
        let piston = self.own(bed, PISTON);
        piston.map_or(self.room.height, |piston| {
            bed.machine().stations[piston].centre.z - 0.5 * self.room.thickness
        })
    }

    /// Row of the present instant.
    #[must_use]
    pub fn row(
        &self,
        bed: &dyn AnyBed,
        packing: &Packing,
        energies: &Energies,
        progress: &Progress,
        left: &Left,
    ) -> Row {
        let (dt, time, step) = bed.clock();
        let stress = self.stress(bed);
        let height = if progress.piston_speed > 0.0 {
            self.face(bed)
        } else if self.room.periodic[2] {
            self.room.height
        } else if bed.grains().is_empty() {
            0.0
        } else {
            packing.top
        };
        // without a grain there is no height, and nothing per volume
        let per = |value: f64, whole: f64| if whole == 0.0 { 0.0 } else { value / whole };
        let volume = self.room.area() * height;
        let sides = 2.0 * (self.room.width + self.room.depth) * height;
        let lateral = |name, axis: usize| {
            let wall = self.own(bed, name);
            wall.map_or(0.0, |wall| bed.force_on(wall)[axis].abs())
        };
        let rate = per(progress.piston_speed, height);
        Row {
            stage: progress.stage.clone(),
            time_s: time,
            step,
            time_step_s: dt,
            height_m: height,
            strain: progress
                .seated_height
                .map_or(0.0, |seated| (seated - height) / seated),
            stress_pa: stress,
            lateral_stress_pa: per(
                lateral("left", 0) + lateral("right", 0) + lateral("front", 1) + lateral("back", 1),
                sides,
            ),
            virial_stress_pa: per(packing.virial[(2, 2)], volume),
            coordination: packing.coordination,
            solid_fraction: per(self.grain_volume, volume),
            max_overlap_ratio: packing.max_overlap_ratio,
            beyond_validity: packing.beyond_validity,
            below_validity: packing.below_validity,
            max_speed_m_s: packing.max_speed,
            inertial_number: if stress > 0.0 {
                rate * self.diameter * (self.material.density / stress).sqrt()
            } else {
                0.0
            },
            kinetic_j: energies.kinetic,
            potential_j: energies.potential,
            elastic_j: energies.elastic,
            springs_j: energies.springs,
            plastic_j: energies.plastic,
            driven_work_j: energies.driven,
            stiffening_work_j: energies.stiffening,
            outlet_grains: left.grains,
            outlet_mass_kg: left.mass,
            outlet_rate_kg_s: left.rate(time),
            outlet_j: left.energy,
            imbalance_j: energies.balance() - progress.first_balance,
            losses: energies.losses,
        }
    }
}

impl Row {
    /// Energy that has gone through the bed, J: what moves, what contacts hold and what was dissipated.
    #[must_use]
    pub fn turnover(&self) -> f64 {
        self.kinetic_j + self.elastic_j + self.springs_j + self.dissipated()
    }

    /// Energy dissipated so far, J.
    #[must_use]
    pub fn dissipated(&self) -> f64 {
        self.losses.total() + self.plastic_j
    }

    /// Energy dissipated by plastic flow over all energy dissipated so far.
    #[must_use]
    pub fn plastic_share(&self) -> f64 {
        self.plastic_j / self.dissipated().max(f64::MIN_POSITIVE)
    }
}

/// Writes `bed.csv`.
///
/// # Errors
/// [`crate::Error::File`] when it cannot be written.
pub fn write(path: &Path, provenance: &str, rows: &[Row]) -> Result<()> {
    let rows: Vec<(&Row, Losses)> = rows.iter().map(|row| (row, row.losses)).collect();
    write_rows(path, provenance, &rows)
}

/// Largest closure of its account a run may show.
pub const CLOSURE: f64 = 0.01;

/// Imbalance over the largest turnover so far at which a run is stopped: what follows would tell nothing.
pub const HOPELESS: f64 = 0.1;

/// Share of the energy in gravity below which an imbalance may be rounding.
const ROUNDING: f64 = 1e-9;

/// First row of a series whose imbalance is beyond `bound` of the largest turnover up to it.
#[must_use]
pub fn first_beyond(rows: &[Row], bound: f64) -> Option<&Row> {
    let mut most = 0.0f64;
    rows.iter().find(|row| {
        most = most.max(row.turnover());
        let rounding = ROUNDING * row.potential_j.abs();
        !(row.imbalance_j.abs() <= (bound * most).max(rounding))
    })
}

/// Largest imbalance over the largest turnover of energy in a series: the closure of its account.
#[must_use]
pub fn closure(rows: &[Row]) -> f64 {
    let worst = rows
        .iter()
        .fold(0.0f64, |worst, row| worst.max(row.imbalance_j.abs()));
    let most = rows
        .iter()
        .fold(0.0f64, |most, row| most.max(row.turnover()));
    if most > 0.0 { worst / most } else { worst }
}
