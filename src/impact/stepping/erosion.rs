//! Erosion: cells of a flattened body that would stop the run are weakened instead.
//!
//! A body that spreads into a sheet has cells a hundred times thinner than they were, and the stable step falls with the
//! thinnest of them, which hold less than a hundredth of the mass. Where the step would fall below a share of its first
//! value, the cells that hold the energy of the fastest mode carry a quarter of their stress from then on; a cell weakened
//! [`WEAKEST`] is taken out, as is one in which a point is squeezed to [`LEAST_J`] of its volume. Mass is never taken: it stays on the nodes.
//! The elastic energy that goes with the stress is booked, and the volume that lost its strength is reported.
//! Element erosion is common in explicit finite elements (e.g. Belytschko and Lin 1987); weakening first keeps the sheet
//! together.

use super::stability::StabilityLimit;
use crate::impact::kernel::{Part, Points, Purpose};
use crate::space::Space;
use crate::tape::keep_fields;

/// Share of the stress that is left after each weakening: the stable step of the cell doubles.
const WEAKENED: f64 = 0.25;
/// Strength below which a cell is taken out.
const WEAKEST: f64 = 1e-3;
/// Share of the energy of the most stressed cell in the fastest mode from which a cell is weakened with it.
const TAKES_PART: f64 = 0.5;
/// Share of the body that may lose its strength before the run is given up.
const MOST: f64 = 0.5;
/// Volume ratio of a point at and below which its cell is taken out. Shocks at half the speed of sound leave 0.6, and the
/// pressure of the material has no barrier against less: what is squeezed so far is about to be turned inside out, and would
/// be thrown away by forces that grow as 1/J. The value is a choice: what it changes is measured in the guide, chapter *The solver*.
pub const LEAST_J: f64 = 0.05;
/// Power iterations after a weakening, and at the start.
const AFTER: usize = 20;
const FIRST: usize = 60;
/// Power iterations of a refresh, which starts from the last mode.
pub(in crate::impact) const REFRESH: usize = 3;

/// What erosion did so far.
#[derive(Debug, Clone, Default)]
pub struct Erosion {
    /// Shortest stable step that is accepted, as a share of the first; 0: any.
    least: f64,
    /// Stable step of the undeformed body.
    first: f64,
    /// Volume that has lost its strength.
    volume: f64,
    /// Elastic energy that went with the stress.
    energy: f64,
}

keep_fields!(Erosion: first, volume, energy; rebuilt least);

impl Erosion {
    /// Nothing eroded yet; `least`: shortest stable step accepted over that of the undeformed body, 0 to erode nothing.
    pub fn new(least: f64) -> Self {
        Erosion {
            least,
            ..Erosion::default()
        }
    }

    /// Whether cells may be weakened at all.
    pub fn is_on(&self) -> bool {
        self.least > 0.0
    }

    /// Stable step of the undeformed body; 0 before it was asked for.
    pub fn first(&self) -> f64 {
        self.first
    }

    /// Shortest stable step that is accepted.
    pub fn least_step(&self) -> f64 {
        self.least * self.first
    }

    /// Elastic energy that went with the stress of weakened cells.
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// Volume that has lost its strength: of a weakened cell the share of its stress that is gone.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Stable step of a part of the cells as they are, after weakening what would make it too short.
    ///
    /// # Errors
    /// The reason to stop, when half of the body has lost its strength.
    pub fn stable_step<S: Space, const N: usize>(
        &mut self,
        limit: &mut StabilityLimit<S>,
        points: &mut Points<S, N>,
        part: Part,
        u: &[S::Vector],
        recip_mass: &[S::Vector],
    ) -> Result<f64, String> {
        if self.first == 0.0 {
            self.first = limit.estimate(points, part, u, recip_mass, FIRST);
            return Ok(self.first);
        }
        let mut dt = limit.estimate(points, part, u, recip_mass, REFRESH);
        while dt < self.least_step() {
            let shares = limit.energy_shares(points, part, u);
            let weakened: Vec<f64> = shares
                .iter()
                .map(|s| if *s > TAKES_PART { WEAKENED } else { 1.0 })
                .collect();
            self.weaken(points, part, u, &weakened)?;
            dt = limit.estimate(points, part, u, recip_mass, AFTER);
        }
        Ok(dt)
    }

    /// Take out the cells in which a point is squeezed to [`LEAST_J`] of its volume or turned inside out.
    ///
    /// # Errors
    /// As [`Self::stable_step`].
    pub fn take_out_crushed<S: Space, const N: usize>(
        &mut self,
        points: &mut Points<S, N>,
        u: &[S::Vector],
    ) -> Result<(), String> {
        let left = points.one_by_one(Part::All, Purpose::Trial, u, |sweep, _| {
            if sweep.least_j > LEAST_J { 1.0 } else { 0.0 }
        });
        self.weaken(points, Part::All, u, &left)
    }

    /// Let every cell of a part carry the share `left` of what it carries now.
    fn weaken<S: Space, const N: usize>(
        &mut self,
        points: &mut Points<S, N>,
        part: Part,
        u: &[S::Vector],
        left: &[f64],
    ) -> Result<(), String> {
        let energies = points.one_by_one(part, Purpose::Look, u, |sweep, _| sweep.elastic);
        for (energy, left) in energies.iter().zip(left) {
            if energy.is_finite() {
                self.energy += (1.0 - left) * energy;
            }
        }
        self.volume += points.weaken(part, left, WEAKEST);
        if self.volume > MOST * points.volume() {
            let share = 100.0 * MOST;
            return Err(format!("more than {share} % of the body lost its strength"));
        }
        Ok(())
    }
}
