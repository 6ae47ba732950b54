//! Space: what stands where grains come in, be it grains, their images or bodies.

use crate::dem::bodies::machine::Machine;
use crate::dem::grains::Grains;
use crate::dem::grains::newcomer::Newcomer;
use crate::dem::grains::periodic::Periodic;
use parry3d::math::{Pose, Vector};
use parry3d::query::intersection_test;
use parry3d::shape::Cuboid;

/// Block of space with all that reaches into it.
pub struct Space<'a> {
    corners: [Vector; 2],
    room: Periodic,
    machine: &'a Machine,
    /// Bodies whose block reaches into it.
    bodies: Vec<usize>,
    /// Centres (m) and radii (m) of grains that reach into it, images included.
    grains: Vec<(Vector, f64)>,
}

impl<'a> Space<'a> {
    /// The block between two corners (m) among grains, `newcomers` and bodies.
    #[must_use]
    pub fn of(
        [low, high]: [Vector; 2],
        grains: &Grains,
        newcomers: &[Newcomer],
        machine: &'a Machine,
    ) -> Self {
        let room = grains.room;
        let here = grains.spheres.iter().map(|s| (s.centre, s.radius));
        let new = newcomers.iter().map(|one| (one.centre, one.radius));
        let middle = 0.5 * (low + high);
        let reaches = |&(centre, radius): &(Vector, f64)| {
            let centre = nearest_image(&room, centre, middle);
            let nearest = centre.clamp(low, high);
            (nearest - centre).length_squared() < radius * radius
        };
        let bodies = 0..machine.surfaces.len();
        let is_near = |&body: &usize| {
            let surface = &machine.surfaces[body];
            let block = surface.shape.compute_aabb(&surface.pose);
            let (mins, maxs) = (block.mins * machine.unit, block.maxs * machine.unit);
            !surface.removed && mins.cmplt(high).all() && maxs.cmpgt(low).all()
        };
        Self {
            corners: [low, high],
            room,
            machine,
            bodies: bodies.filter(is_near).collect(),
            grains: here.chain(new).filter(reaches).collect(),
        }
    }

    /// Whether no grain reaches into it.
    #[must_use]
    pub fn is_clear_of_grains(&self) -> bool {
        self.grains.is_empty()
    }

    /// A body that reaches into a ball.
    #[must_use]
    pub fn body_at(&self, centre: Vector, radius: f64) -> Option<usize> {
        let centre = self.room.inside(centre) / self.machine.unit;
        let reaches = |&body: &usize| {
            let surface = &self.machine.surfaces[body];
            let distance = surface.shape.distance_to_point(&surface.pose, centre, true);
            distance * self.machine.unit < radius
        };
        self.bodies.iter().copied().find(reaches)
    }

    /// Whether a ball touches neither grain nor body.
    #[must_use]
    pub fn is_free(&self, centre: Vector, radius: f64) -> bool {
        let apart = |&(other, size): &(Vector, f64)| {
            self.room.shortest(other - centre).length() > size + radius
        };
        self.grains.iter().all(apart) && self.body_at(centre, radius).is_none()
    }

    /// Names of the bodies that take some of it.
    #[must_use]
    pub fn bodies(&self) -> Vec<&str> {
        let unit = self.machine.unit;
        let [low, high] = self.corners.map(|corner| corner / unit);
        let block = Cuboid::new(0.5 * (high - low));
        let place = Pose::from_translation(0.5 * (low + high));
        let takes = |&&body: &&usize| {
            let surface = &self.machine.surfaces[body];
            let meets = intersection_test(&place, &block, &surface.pose, &*surface.shape);
            high.is_finite() && meets.is_ok_and(|found| found.intersecting)
        };
        let bodies = self.bodies.iter().filter(takes);
        bodies
            .map(|&body| self.machine.bodies()[body].name.as_str())
            .collect()
    }

    /// A grain has come in.
    pub fn take(&mut self, newcomer: &Newcomer) {
        self.grains.push((newcomer.centre, newcomer.radius));
    }
}

/// The image of a point that is nearest to `to` along every periodic axis.
fn nearest_image(room: &Periodic, mut point: Vector, to: Vector) -> Vector {
    for axis in 0..3 {
        if let Some((_, length)) = room.along(axis) {
            point[axis] -= ((point[axis] - to[axis]) / length).round() * length;
        }
    }
    point
}
