//! Contact state: queries on a listed pair of grains, for measures and output.

use super::contacts::{CHUNK, Contacts};
use super::law::ContactLaw;
use super::normals::Squeeze;

impl<C: ContactLaw> Contacts<C> {
    /// Recoverable energy (J) of a pair, its law at full stiffness.
    #[must_use]
    pub fn elastic_energy(&self, index: usize, squeeze: Squeeze) -> f64 {
        if squeeze.overlap > 0.0 {
            self.histories[index / CHUNK].elastic_energy(index % CHUNK, squeeze)
        } else {
            0.0
        }
    }

    /// Largest stiffness (N/m) of a pair, its law at full stiffness.
    #[must_use]
    pub fn stiffest(&self, index: usize, squeeze: Squeeze) -> f64 {
        self.histories[index / CHUNK].stiffest(index % CHUNK, squeeze)
    }

    /// Largest overlap (m) so far of a pair, where its law remembers it.
    #[must_use]
    pub fn largest_overlap(&self, index: usize, radii: [f64; 2]) -> Option<f64> {
        self.histories[index / CHUNK].largest_overlap(index % CHUNK, radii)
    }

    /// Largest flattening over radius the normal law's source supports.
    #[must_use]
    pub fn valid_to(&self) -> f64 {
        self.model.valid_to()
    }

    /// Whether both hold the same pairs, pushes and histories, bit for bit.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        let histories = self
            .histories
            .iter()
            .zip(&other.histories)
            .all(|(a, b)| a.same(&**b));
        histories
            && self.list == other.list
            && self.memory == other.memory
            && self.pushes == other.pushes
    }
}
