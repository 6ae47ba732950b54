//! Encounters: how fast bodies are, and which free ones have come to another body.

use super::Machine;
use crate::dem::bodies::Mobility;
use parry3d::bounding_volume::BoundingVolume;
use parry3d::query::intersection_test;

impl Machine {
    /// Bound on the speed (m/s) of any point of a body: of told motions their peak, of free bodies the present one,
    /// of belts that of their surface: as fast as grains may become on it.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        let speeds = (0..self.handles.len()).map(|index| self.speed(index));
        speeds.fold(0.0, f64::max) * self.unit
    }

    /// Bound on the speed of a body's points, in the machine's unit.
    fn speed(&self, index: usize) -> f64 {
        let body = &self.world.bodies[self.handles[index]];
        let surface = &self.surfaces[index];
        if surface.removed {
            return 0.0;
        }
        if let Some(belt) = &self.stations[index].belt {
            let ball = surface.shape.compute_bounding_sphere(&surface.pose);
            let off = (ball.center() - belt.about / self.unit).length();
            return belt.fastest((off + ball.radius()) * self.unit) / self.unit;
        }
        if body.is_fixed() {
            return 0.0;
        }
        let (drive, told) = (&self.drives[index], self.stations[index].driven);
        let spin = if told {
            drive.motion.spin
        } else {
            body.angvel()
        };
        // a plane has no end: without a turn its arm does not matter
        if spin.length_squared() == 0.0 {
            return match told {
                true => drive.motion.fastest(0.0),
                false => body.linvel().length(),
            };
        }
        let ball = surface.shape.compute_local_bounding_sphere();
        let arm = ball.center().length() + ball.radius();
        if told {
            let axis = drive.motion.about.unwrap_or(drive.start);
            return drive.motion.fastest(arm + (drive.start - axis).length());
        }
        let off = (body.center_of_mass() - body.translation()).length();
        body.linvel().length() + spin.length() * (arm + off)
    }

    /// Bodies that move under forces with nothing that ties them: neither held nor on a joint.
    pub fn loose(&self) -> impl Iterator<Item = usize> {
        let loose = |&index: &usize| match self.bodies[index].mobility {
            Mobility::Free(freedom) => {
                let moves = self.world.bodies[self.handles[index]].is_dynamic();
                freedom.joint.is_none() && moves
            }
            _ => false,
        };
        (0..self.bodies.len()).filter(loose)
    }

    /// A loose body that has come to another body, and that other one.
    #[must_use]
    pub fn meeting(&self) -> Option<[usize; 2]> {
        let meets = |&[a, b]: &[usize; 2]| {
            let [a, b] = [a, b].map(|index| &self.surfaces[index]);
            let blocks = [a, b].map(|surface| surface.shape.compute_aabb(&surface.pose));
            let test = || intersection_test(&a.pose, &*a.shape, &b.pose, &*b.shape);
            // shapes that parry cannot compare are taken to meet as soon as their blocks do
            blocks[0].intersects(&blocks[1]) && test().map_or(true, |found| found.intersecting)
        };
        let others = |body: usize| (0..self.bodies.len()).filter(move |&other| other != body);
        let pairs = self
            .loose()
            .flat_map(|body| others(body).map(move |other| [body, other]));
        let standing = |pair: &[usize; 2]| pair.iter().all(|&body| !self.surfaces[body].removed);
        pairs.filter(standing).find(meets)
    }
}
