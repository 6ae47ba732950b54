//! Patch: one contact of a grain with a surface.

use crate::contact::Coverage;
use crate::dem::force::meeting::Push;
use crate::dem::force::normal::{Histories, Squeeze};
use crate::dem::grains::Grains;
use parry3d::math::Vector;

/// One contact of a grain with a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Patch<M> {
    /// What the contact remembers beside its normal history.
    pub memory: M,
    /// Push on the grain.
    pub push: Push,
    /// Point of contact, m.
    pub point: Vector,
    /// Normal from the surface to the grain.
    pub normal: Vector,
}

/// A patch with what it belongs to.
pub struct Held<'a, M> {
    /// Grain.
    pub grain: usize,
    /// Surface.
    pub surface: usize,
    /// The patch.
    pub patch: &'a Patch<M>,
    pub(in crate::dem) history: (&'a dyn Histories, usize),
}

impl<M> Held<'_, M> {
    /// The contact as its normal law sees it; no overlap where it is apart.
    #[must_use]
    pub fn squeeze(&self, grains: &Grains) -> Squeeze {
        let sphere = &grains.spheres[self.grain];
        let touches = self.patch.push.touches();
        let overlap = if touches {
            sphere.radius - (sphere.centre - self.patch.point).length()
        } else {
            0.0
        };
        Squeeze {
            overlap,
            radii: [sphere.radius, f64::INFINITY],
        }
    }

    /// Recoverable energy, J, its law at full stiffness.
    #[must_use]
    pub fn elastic_energy(&self, grains: &Grains) -> f64 {
        let squeeze = self.squeeze(grains);
        if squeeze.overlap > 0.0 {
            self.history.0.elastic_energy(self.history.1, squeeze)
        } else {
            0.0
        }
    }

    /// Energy plastic flow has dissipated by what the normal history tells, J, its law at full stiffness.
    #[must_use]
    pub fn dissipated(&self, grains: &Grains) -> f64 {
        let radii = [grains.spheres[self.grain].radius, f64::INFINITY];
        self.history.0.dissipated(self.history.1, radii)
    }

    /// Largest overlap (m) so far, where the law remembers it.
    #[must_use]
    pub fn largest_overlap(&self, grains: &Grains) -> Option<f64> {
        let radii = self.squeeze(grains).radii;
        self.history.0.largest_overlap(self.history.1, radii)
    }

    /// Largest stiffness, N/m, its law at full stiffness.
    #[must_use]
    pub fn stiffest(&self, grains: &Grains) -> f64 {
        self.history
            .0
            .stiffest(self.history.1, self.squeeze(grains))
    }

    /// What of it lies within the range of its law.
    #[must_use]
    pub fn coverage(&self, grains: &Grains) -> Coverage {
        self.history
            .0
            .coverage(self.history.1, self.squeeze(grains))
    }
}
