//! Contact row: one contact that carries force: who touches whom, how hard and how deep.

use crate::dem::dynamics::Bed;
use crate::dem::force::effects::ContactLaw;
use parry3d::math::Vector;

/// What a grain touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Other {
    /// A grain, by its name.
    Grain(u32),
    /// A body, by its index.
    Body(usize),
}

/// One contact of the bed, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRow {
    /// Name of the grain the force acts on.
    pub first: u32,
    /// What it touches.
    pub other: Other,
    /// Centre of the grain, and centre of the other grain or point of contact, m.
    pub ends: [Vector; 2],
    /// Unit normal towards the grain.
    pub normal: Vector,
    /// Distance from the grain's centre to the other's, or to the surface, m.
    pub distance: f64,
    /// Force on the grain, N.
    pub force: Vector,
    /// Overlap, m.
    pub overlap: f64,
    /// Largest overlap so far, m, where the law remembers it.
    pub largest_overlap: Option<f64>,
    /// Energy plastic flow has dissipated in it, J.
    pub plastic: f64,
}

impl ContactRow {
    /// Part of the force along the normal, N.
    #[must_use]
    pub fn normal_force(&self) -> f64 {
        self.force.dot(self.normal)
    }

    /// Size of the force across the normal, N.
    #[must_use]
    pub fn tangential_force(&self) -> f64 {
        (self.force - self.normal * self.normal_force()).length()
    }

    /// Vector over which the force is handed on, m: from the other centre, or the surface, to the grain's centre.
    #[must_use]
    pub fn branch(&self) -> Vector {
        self.normal * self.distance
    }
}

impl<C: ContactLaw> Bed<C> {
    /// Contacts that carry force, pairs of grains first, in the order of the lists.
    #[must_use]
    pub fn contact_rows(&self) -> Vec<ContactRow> {
        let carries = |force: Vector| force != Vector::ZERO;
        let pairs = self.contacts.pushes.iter().enumerate();
        let pairs = pairs.filter(|(_, push)| carries(push.force));
        let pairs = pairs.map(|(index, push)| self.pair_row(index, push.force));
        let held = self.surfaces.all();
        let held = held.filter(|held| carries(held.patch.push.force));
        let held = held.map(|held| {
            let (sphere, squeeze) = (self.grains.spheres[held.grain], held.squeeze(&self.grains));
            ContactRow {
                first: self.grains.ids[held.grain],
                other: Other::Body(held.surface),
                ends: [sphere.centre, held.patch.point],
                normal: held.patch.normal,
                distance: sphere.radius - squeeze.overlap,
                force: held.patch.push.force,
                overlap: squeeze.overlap,
                largest_overlap: held.largest_overlap(&self.grains),
                plastic: self.plastic_on(&held),
            }
        });
        pairs.chain(held).collect()
    }

    fn pair_row(&self, index: usize, force: Vector) -> ContactRow {
        let pair = self.contacts.list.pairs[index].map(|grain| grain as usize);
        let line = self.contacts.line(index, &self.grains);
        let end = self.grains.spheres[pair[1]].centre;
        let squeeze = self.squeeze_of(index);
        ContactRow {
            first: self.grains.ids[pair[0]],
            other: Other::Grain(self.grains.ids[pair[1]]),
            ends: [end + line, end],
            normal: line.normalize(),
            distance: squeeze.radii[0] + squeeze.radii[1] - squeeze.overlap,
            force,
            overlap: squeeze.overlap,
            largest_overlap: self.contacts.largest_overlap(index, squeeze.radii),
            plastic: self.plastic_in(index),
        }
    }
}
