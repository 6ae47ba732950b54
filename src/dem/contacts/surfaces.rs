//! Surfaces: contacts of grains with bodies, each keyed by grain and surface so that its history stays its own.

use super::crowd::Crowd;
pub use super::family::Held;
use super::family::{Family, Situation};
use crate::dem::bodies::machine::{Load, Machine};
use crate::dem::bodies::touching::MAX_TOUCHES;
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use crate::dem::force::normal::NormalModel;
use crate::dem::grains::Grains;
use parry3d::bounding_volume::BoundingVolume;
use parry3d::math::Vector;

/// All contacts of grains with bodies.
pub struct Surfaces<C: ContactLaw> {
    pub(in crate::dem) model: Box<dyn NormalModel>,
    pub(in crate::dem) solids: Family<C, 1>,
    pub(in crate::dem) meshes: Family<C, MAX_TOUCHES>,
    /// Grains with several surfaces near them.
    pub(in crate::dem) crowd: Crowd,
}

impl<C: ContactLaw> Surfaces<C> {
    /// No contacts yet, under the normal law of `model`.
    #[must_use]
    pub fn new(model: Box<dyn NormalModel>) -> Self {
        Self {
            model,
            solids: Family::default(),
            meshes: Family::default(),
            crowd: Crowd::default(),
        }
    }

    /// Whether both hold the same patches and histories, bit for bit.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        self.solids.same(&other.solids) && self.meshes.same(&other.meshes)
    }

    /// Evaluates the law for every grain near a surface.
    pub fn evaluate(&mut self, law: &C, grains: &Grains, machine: &Machine, dt: f64) {
        let situation = Situation {
            law,
            grains,
            machine,
            dt,
        };
        self.crowd.find(&situation);
        for [from, to] in self.crowd.moves(&situation, &self.solids, &self.meshes) {
            let contact = match from {
                (true, patch) => self.meshes.take(patch),
                (false, patch) => self.solids.take(patch),
            };
            match to {
                (true, patch) => self.meshes.put(patch, contact),
                (false, patch) => self.solids.put(patch, contact),
            }
        }
        self.solids.evaluate(&situation, &self.crowd.members);
        self.meshes.evaluate(&situation, &self.crowd.members);
    }

    /// Finds out which grains have several surfaces near them, after the candidates were listed.
    pub(in crate::dem) fn seat(&mut self) {
        self.crowd = Crowd::seat(&mut self.solids, &mut self.meshes);
    }

    /// Lists the grains nearer than `skin` (m) to a surface anew; histories go with their contacts. What plastic flow has
    /// dissipated in those that leave the list, their law `softening` times as stiff, is handed to the grains.
    pub fn relist(&mut self, grains: &mut Grains, machine: &Machine, skin: f64, softening: f64) {
        let (mut solids, mut meshes) = (Vec::new(), Vec::new());
        let boxes: Vec<_> = machine
            .surfaces
            .iter()
            .map(|s| s.shape.compute_aabb(&s.pose))
            .collect();
        for (grain, sphere) in grains.spheres.iter().enumerate() {
            let centre = sphere.centre / machine.unit;
            let reach = (sphere.radius + skin) / machine.unit;
            for (index, surface) in machine.surfaces.iter().enumerate() {
                if surface.removed {
                    continue;
                }
                let near = boxes[index].loosened(reach).contains_local_point(centre)
                    && surface.shape.distance_to_point(&surface.pose, centre, true) < reach;
                if near {
                    let family = if surface.shape.as_trimesh().is_some() {
                        &mut meshes
                    } else {
                        &mut solids
                    };
                    family.push([grain as u32, index as u32]);
                }
            }
        }
        let materials = &machine.materials;
        self.solids
            .relist(solids, grains, &*self.model, materials, softening);
        self.meshes
            .relist(meshes, grains, &*self.model, materials, softening);
        self.seat();
    }

    /// Energy dissipated so far, plastic flow apart.
    #[must_use]
    pub fn losses(&self) -> Losses {
        let mut sum = self.solids.losses();
        sum += self.meshes.losses();
        sum
    }

    /// Touching points that had no room beside the nearest ones of their grain and mesh, since the last listing.
    #[must_use]
    pub fn left_out(&self) -> u32 {
        self.meshes.left_out()
    }

    /// Every patch with its grain and surface, solids first, in order.
    pub fn all(&self) -> impl Iterator<Item = Held<'_, C::Memory>> {
        self.solids.all().chain(self.meshes.all())
    }

    /// Counts what contacts hold now, their law `softening` times as stiff, as put in before.
    pub fn start_account(&mut self, grains: &Grains, softening: f64) {
        self.solids.start_account(grains, softening);
        self.meshes.start_account(grains, softening);
    }

    /// Energy (J) put into the contacts that touch, held or dissipated, their law at full stiffness.
    #[must_use]
    pub fn law_work(&self, grains: &Grains) -> f64 {
        self.solids.law_work(grains) + self.meshes.law_work(grains)
    }

    /// Ends the contacts with a surface, their law `softening` times as stiff: what plastic flow has dissipated in them is
    /// handed to the grains, what they hold is gone.
    pub fn release(&mut self, surface: usize, grains: &mut Grains, softening: f64) {
        self.solids.release(surface, grains, softening);
        self.meshes.release(surface, grains, softening);
    }

    /// Force and torque of all surfaces on a grain.
    #[inline(always)]
    #[must_use]
    pub fn load(&self, grain: usize) -> (Vector, Vector) {
        let (mut force, mut torque) = (Vector::ZERO, Vector::ZERO);
        for patch in self.solids.of(grain).iter().chain(self.meshes.of(grain)) {
            force += patch.push.force;
            if C::ROTATES {
                torque += patch.push.couple * patch.push.arms[0] + C::moment(&patch.memory);
            }
        }
        (force, torque)
    }

    /// Loads of all grains on each body, summed in the order of the candidates.
    pub fn load_into(&self, machine: &Machine, loads: &mut [Load]) {
        loads.fill(Load::default());
        for Held { surface, patch, .. } in self.all() {
            if patch.push.touches() {
                let (load, station) = (&mut loads[surface], &machine.stations[surface]);
                let moment = C::moment(&patch.memory);
                load.force -= patch.push.force;
                load.torque -= (patch.point - station.centre).cross(patch.push.force) + moment;
                if let Some(belt) = &station.belt {
                    let along = belt.at(patch.point, patch.normal);
                    load.power += patch.push.force.dot(along) + moment.dot(belt.spin);
                }
            }
        }
    }
}
