//! Measures of a bed at one instant: energies, packing, stress.

use crate::contact::Coverage;
use crate::dem::contacts::family::flowed;
use crate::dem::contacts::surfaces::Held;
use crate::dem::dynamics::Bed;
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use nalgebra::{Matrix3, Vector3};
use parry3d::math::Vector;
use std::f64::consts::PI;

/// Where the energy is and where it went, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energies {
    /// Motion and turning of grains, motion of free bodies.
    pub kinetic: f64,
    /// In gravity.
    pub potential: f64,
    /// Recoverable in normal contact.
    pub elastic: f64,
    /// Stored by effects: in tangential and rolling springs.
    pub springs: f64,
    /// Dissipated by each effect.
    pub losses: Losses,
    /// Dissipated by plastic flow in contacts.
    pub plastic: f64,
    /// Work done by driven bodies and by the motors of joints.
    pub driven: f64,
    /// Work done by changes of the law.
    pub stiffening: f64,
}

impl Energies {
    /// Energy present plus energy dissipated less work from outside: constant in an exact run.
    #[must_use]
    pub fn balance(&self) -> f64 {
        self.kinetic + self.potential + self.elastic + self.springs + self.dissipated()
            - self.driven
            - self.stiffening
    }

    /// Energy that has turned into heat.
    #[must_use]
    pub fn dissipated(&self) -> f64 {
        self.losses.total() + self.plastic
    }

    /// Energy that has gone through the bed: what moves, what is held in contacts and what was dissipated.
    #[must_use]
    pub fn turnover(&self) -> f64 {
        self.kinetic + self.elastic + self.springs + self.dissipated()
    }
}

/// State of the packing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packing {
    /// Contacts between grains that carry force.
    pub contacts: usize,
    /// Contacts of grains with bodies that carry force.
    pub wall_contacts: usize,
    /// Grain contacts per grain, two for each pair; walls not counted.
    pub coordination: f64,
    /// Largest overlap over the diameter of the smaller grain; on a surface, over the radius.
    pub max_overlap_ratio: f64,
    /// Contacts that were flattened beyond what the law's source supports.
    pub beyond_validity: usize,
    /// Contacts that have yielded and let go short of the slowest impact of the law ([`crate::contact::Slowest`]).
    pub below_validity: usize,
    /// Work that has loaded the contacts which have yielded and let go, and the part of it in those below, J.
    pub unloading: [f64; 2],
    /// Least time a half oscillation of a grain on its stiffest contact would take, s; infinite without contacts.
    pub contact_time: f64,
    /// Height of the highest point of a grain, m.
    pub top: f64,
    /// Fastest grain, m/s.
    pub max_speed: f64,
    /// Root mean square of the grains' speeds, m/s.
    pub rms_speed: f64,
    /// Sum over grain contacts of line of centres times force, J; over the volume, the stress (pressure positive).
    pub virial: Matrix3<f64>,
    /// Mean normal force of the grain contacts that carry force, N.
    pub mean_force: f64,
}

impl Packing {
    /// Counts a contact by what its law covers.
    fn cover(&mut self, coverage: &Coverage) {
        self.beyond_validity += usize::from(coverage.beyond);
        self.below_validity += usize::from(coverage.below > 0.0);
        self.unloading[0] += coverage.unloading;
        self.unloading[1] += coverage.below;
    }
}

impl<C: ContactLaw> Bed<C> {
    /// Energies at the time of the positions; forces must be up to date ([`Bed::evaluate`]).
    ///
    /// Kinetic energies are $\tfrac12 m\ v_{n-1/2} \cdot v_{n+1/2}$, the form in which the integrator's work adds up.
    #[must_use]
    pub fn energies(&self) -> Energies {
        let mut energies = Energies {
            driven: self.outside.driven + self.machine.motor_energy(),
            stiffening: self.outside.stiffening,
            ..Energies::default()
        };
        for grain in 0..self.grains.len() {
            let (force, torque) = self.load(grain);
            let (motion, spin) = (&self.grains.motions[grain], &self.grains.spins[grain]);
            let mass = 1.0 / motion.inverse_mass;
            let next = motion.velocity + (force * motion.inverse_mass + self.gravity) * self.stride;
            let turning = spin.rate + torque * (spin.inverse_inertia * self.stride);
            energies.kinetic += 0.5 * mass * motion.velocity.dot(next)
                + 0.5 / spin.inverse_inertia * spin.rate.dot(turning);
            energies.potential -= mass * self.gravity.dot(self.grains.spheres[grain].centre);
        }
        let (kinetic, potential) = self.machine.energy(&self.loads, self.stride);
        energies.kinetic += kinetic;
        energies.potential += potential;
        energies.losses = self.losses();
        self.add_contact_energies(&mut energies);
        energies
    }

    fn add_contact_energies(&self, energies: &mut Energies) {
        let softening = self.law.softening();
        energies.plastic = self.grains.plastic.iter().sum::<f64>() + self.grains.plastic_gone;
        for (index, memory) in self.contacts.memory.iter().enumerate() {
            energies.elastic +=
                softening * self.contacts.elastic_energy(index, self.squeeze_of(index));
            energies.springs += C::stored(memory);
            energies.plastic += self.plastic_in(index);
        }
        for held in self.surfaces.all() {
            energies.elastic += softening * held.elastic_energy(&self.grains);
            energies.springs += C::stored(&held.patch.memory);
            energies.plastic += self.plastic_on(&held);
        }
    }

    /// Energy plastic flow has dissipated in a listed pair, J.
    #[must_use]
    pub fn plastic_in(&self, pair: usize) -> f64 {
        let radii = self.grains.radii(self.contacts.list.pairs[pair]);
        self.contacts.flowed(pair, radii, self.law.softening())
    }

    /// Energy plastic flow has dissipated in a surface contact, J.
    #[must_use]
    pub fn plastic_on(&self, held: &Held<C::Memory>) -> f64 {
        flowed::<C>(held, &self.grains, self.law.softening())
    }

    /// Energy plastic flow has dissipated in the contacts of each grain, half of each contact to each grain, J.
    #[must_use]
    pub fn plastic_by_grain(&self) -> Vec<f64> {
        let mut plastic = self.grains.plastic.clone();
        for (index, pair) in self.contacts.list.pairs.iter().enumerate() {
            let flowed = self.plastic_in(index);
            pair.iter()
                .for_each(|&grain| plastic[grain as usize] += 0.5 * flowed);
        }
        for held in self.surfaces.all() {
            plastic[held.grain] += self.plastic_on(&held);
        }
        plastic
    }

    /// How hard each grain is squeezed: the sum of the magnitudes of its contact forces, N.
    #[must_use]
    pub fn squeeze(&self) -> Vec<f64> {
        let mut squeeze = vec![0.0; self.grains.len()];
        for (pair, push) in self.contacts.list.pairs.iter().zip(&self.contacts.pushes) {
            let force = push.force.length();
            pair.iter()
                .for_each(|&grain| squeeze[grain as usize] += force);
        }
        for held in self.surfaces.all() {
            squeeze[held.grain] += held.patch.push.force.length();
        }
        squeeze
    }

    /// State of the packing; forces must be up to date ([`Bed::evaluate`]).
    #[must_use]
    pub fn packing(&self) -> Packing {
        let mut packing = Packing {
            contacts: 0,
            wall_contacts: 0,
            coordination: 0.0,
            max_overlap_ratio: 0.0,
            beyond_validity: 0,
            below_validity: 0,
            unloading: [0.0; 2],
            contact_time: f64::INFINITY,
            top: f64::NEG_INFINITY,
            max_speed: 0.0,
            rms_speed: 0.0,
            virial: Matrix3::zeros(),
            mean_force: 0.0,
        };
        for (sphere, motion) in self.grains.spheres.iter().zip(&self.grains.motions) {
            packing.top = packing.top.max(sphere.centre.z + sphere.radius);
            packing.max_speed = packing.max_speed.max(motion.velocity.length());
            packing.rms_speed += motion.velocity.length_squared();
        }
        let count = self.grains.len().max(1) as f64;
        packing.rms_speed = (packing.rms_speed / count).sqrt();
        self.survey_pairs(&mut packing);
        self.survey_surfaces(&mut packing);
        packing.coordination = 2.0 * packing.contacts as f64 / count;
        packing.mean_force /= packing.contacts.max(1) as f64;
        packing
    }

    fn survey_pairs(&self, packing: &mut Packing) {
        for (index, push) in self
            .contacts
            .pushes
            .iter()
            .enumerate()
            .filter(|(_, push)| push.touches())
        {
            let [i, j] = self.contacts.list.pairs[index].map(|grain| grain as usize);
            let squeeze = self.squeeze_of(index);
            let line = self.contacts.line(index, &self.grains);
            let force = push.force.length();
            if force > 0.0 {
                packing.contacts += 1;
                packing.mean_force += force;
                let (line, force) = (
                    Vector3::from(line.to_array()),
                    Vector3::from(push.force.to_array()),
                );
                packing.virial += line * force.transpose();
            }
            let flattening = 0.5 * squeeze.overlap / squeeze.radii[0].min(squeeze.radii[1]);
            packing.max_overlap_ratio = packing.max_overlap_ratio.max(flattening);
            packing.cover(&self.contacts.coverage(index, squeeze));
            let inverse_mass =
                self.grains.motions[i].inverse_mass + self.grains.motions[j].inverse_mass;
            let stiffness = self.law.softening() * self.contacts.stiffest(index, squeeze);
            packing.contact_time = packing
                .contact_time
                .min(PI / (stiffness * inverse_mass).sqrt());
        }
    }

    /// A free body swings on all its contacts at once, each grain on its own contact against the body's mass.
    fn survey_surfaces(&self, packing: &mut Packing) {
        let mut carried = vec![0.0; self.machine.stations.len()];
        for held in self.surfaces.all().filter(|held| held.patch.push.touches()) {
            let squeeze = held.squeeze(&self.grains);
            let flattening = squeeze.overlap / squeeze.radii[0];
            packing.wall_contacts += usize::from(held.patch.push.force != Vector::ZERO);
            packing.max_overlap_ratio = packing.max_overlap_ratio.max(flattening);
            packing.cover(&held.coverage(&self.grains));
            let stiffness = self.law.softening() * held.stiffest(&self.grains);
            let body = self.machine.stations[held.surface].inverse_mass;
            let inverse_mass = self.grains.motions[held.grain].inverse_mass + body;
            packing.contact_time = packing
                .contact_time
                .min(PI / (stiffness * inverse_mass).sqrt());
            carried[held.surface] += stiffness * body;
        }
        let fastest = carried.into_iter().fold(0.0, f64::max);
        packing.contact_time = packing.contact_time.min(PI / f64::sqrt(fastest));
    }
}
