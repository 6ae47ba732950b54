//! Terms: what a run has to know of its scene beside the bed and the stages.

use super::time_step::Limits;
use crate::bed::scene::Scene;
use crate::material::Material;
use parry3d::math::Vector;

/// What a run has to know of its scene beside the bed, the stages and the grains to come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms {
    /// Gravity, m/s2.
    pub gravity: Vector,
    /// Material of the first group of grains.
    pub material: Material,
    /// Smallest radius, m.
    pub smallest: f64,
    /// A radius of the middle, m.
    pub radius: f64,
    /// Contact stiffness over that of the material once the packing is made.
    pub softening: f64,
    /// Bounds on the time step.
    pub limits: Limits,
    /// Rows of a stage.
    pub rows: usize,
}

impl Terms {
    /// Terms of a scene, with at least `steps` a contact where the scene does not say.
    #[must_use]
    pub fn of(scene: &Scene, steps: f64) -> Self {
        Self {
            gravity: scene.gravity,
            material: *scene.material(),
            smallest: scene.radii()[0],
            radius: scene.radius(),
            softening: scene.contact.softening(),
            limits: Limits::of(scene.time, &scene.groups, &scene.materials, steps),
            rows: scene.output.rows,
        }
    }
}
