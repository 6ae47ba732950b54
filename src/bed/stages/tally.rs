//! Tally: what a run counts as it goes.

use crate::tape::keep_fields;

/// What a run counts as it goes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Largest number of grains seen outside the room.
    pub lost: usize,
    /// Largest number of free bodies seen outside the room.
    pub lost_bodies: usize,
    /// Largest overlap over diameter seen.
    pub max_overlap_ratio: f64,
    /// Largest number of contacts seen beyond the validity of the law.
    pub beyond_validity: usize,
    /// Largest number of contacts seen that let go below it.
    pub below_validity: usize,
    /// Work that has loaded contacts which let go, and its part in those below, summed over the checks, J.
    pub unloading: [f64; 2],
    /// Steps of single grains.
    pub particle_steps: u64,
}
keep_fields!(Tally: lost, lost_bodies, max_overlap_ratio, beyond_validity, below_validity, unloading,
    particle_steps);

impl Tally {
    /// Share of the work of yielded contacts that let go which is in those below the range of the law.
    #[must_use]
    pub fn below_share(&self) -> f64 {
        let [all, below] = self.unloading;
        if all > 0.0 { below / all } else { 0.0 }
    }
}
