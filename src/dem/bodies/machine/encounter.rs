//! Encounters: how fast bodies are, and which free ones have come to another body.

use super::Machine;
use crate::dem::bodies::Mobility;
use parry3d::bounding_volume::{Aabb, BoundingVolume};
use parry3d::math::Vector;
use parry3d::query::{ShapeCastOptions, cast_shapes, intersection_test};

/// A loose body that nothing keeps from a body that stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// The one that moves, and the one it comes to.
    pub bodies: [usize; 2],
    /// When, s.
    pub after: f64,
    /// Lowest and highest corner of the block of space it moves through, m.
    pub through: [Vector; 2],
}

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

    /// The first loose body that comes to a standing one in a straight line under `gravity` (m/s2), as long as nothing touches it. One that
    /// turns, or is thrown across gravity, is left to the run.
    #[must_use]
    pub fn first_fall(&self, gravity: Vector) -> Option<Fall> {
        let falls = self.loose().flat_map(|body| {
            let standing = (0..self.bodies.len()).filter(move |&other| {
                matches!(self.bodies[other].mobility, Mobility::Fixed)
                    && !self.surfaces[other].removed
            });
            standing.filter_map(move |other| self.fall(body, other, gravity))
        });
        falls.min_by(|a, b| a.after.total_cmp(&b.after))
    }

    fn fall(&self, body: usize, other: usize, gravity: Vector) -> Option<Fall> {
        let moving = &self.world.bodies[self.handles[body]];
        let (velocity, pull) = (moving.linvel(), gravity / self.unit);
        let way = (velocity.normalize_or_zero() + pull.normalize_or_zero()).normalize_or_zero();
        let straight = velocity.cross(pull).length() <= 1e-9 * velocity.length() * pull.length();
        if way == Vector::ZERO || !straight || moving.angvel() != Vector::ZERO {
            return None;
        }
        let [one, two] = [body, other].map(|index| &self.surfaces[index]);
        let options = ShapeCastOptions {
            stop_at_penetration: true,
            ..ShapeCastOptions::default()
        };
        let hit = cast_shapes(
            &one.pose,
            way,
            &*one.shape,
            &two.pose,
            Vector::ZERO,
            &*two.shape,
            options,
        );
        let length = hit.ok()??.time_of_impact;
        // length = speed t + pull t^2 / 2
        let (speed, pull) = (velocity.dot(way), pull.dot(way));
        let after = 2.0 * length / (speed + (speed * speed + 2.0 * pull * length).sqrt());
        let start = one.shape.compute_aabb(&one.pose);
        let end = Aabb::new(start.mins + way * length, start.maxs + way * length);
        let through = start.merged(&end);
        Some(Fall {
            bodies: [body, other],
            after,
            through: [through.mins * self.unit, through.maxs * self.unit],
        })
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
