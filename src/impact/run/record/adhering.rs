//! Adhering: what is told of an impact on a wall that attracts the particle.

use super::Record;
use crate::curve::Adhering;
use crate::material::adhesion::Jkr;
use crate::material::{Material, ReferenceUnits};
use crate::plan::Plan;

impl Record {
    /// Figures in SI units, where the wall adheres.
    pub(super) fn adhesion(
        &self,
        material: &Material,
        radius: f64,
        plan: &Plan,
    ) -> Option<Adhering> {
        let law = plan.adhesion?;
        let units = ReferenceUnits::of(material, radius);
        let modulus = material.contact_modulus();
        let work = law.work * units.stress * radius;
        let sphere = Jkr {
            radius,
            modulus,
            work,
        };
        let incident = self.frames[0].kinetic;
        Some(Adhering {
            work_of_adhesion_j_m2: work,
            range_m: law.range * radius,
            maugis_number: law.maugis_number(1.0, modulus / units.stress),
            sticking_velocity_m_s: sphere.sticking_speed(material.sphere_mass(radius)),
            pull_off_force_n: self.pull_off() * units.force(),
            surface_energy_ratio: self.largest(|f| -f.surface) / incident,
            contact_loss_ratio: self.contact_loss,
        })
    }

    /// Largest pull after the largest displacement.
    fn pull_off(&self) -> f64 {
        let deepest = (self.frames.iter())
            .max_by(|a, b| a.displacement.total_cmp(&b.displacement))
            .map_or(0.0, |frame| frame.time);
        self.mean_forces()
            .filter(|(time, _)| *time > deepest)
            .fold(0.0, |most, (_, force)| f64::max(most, -force))
    }
}
