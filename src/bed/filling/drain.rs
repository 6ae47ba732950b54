//! Drain: the grains that leave through the outlets of a scene, and what left with them.

use crate::bed::scene::Outlet;
use crate::dem::grains::{Grains, Sphere};
use crate::tape::keep_fields;

/// What has left through one outlet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outflow {
    /// Grains.
    pub grains: usize,
    /// Their mass, kg.
    pub mass: f64,
}
keep_fields!(Outflow: grains, mass);

/// Outlets with what has left through each.
#[derive(Debug, Clone, PartialEq)]
pub struct Drain {
    outlets: Vec<Outlet>,
    /// One for each outlet of the scene.
    pub outflows: Vec<Outflow>,
    /// Energy that left with the grains, J: of their motion, in gravity, and held in their contacts.
    pub energy: f64,
}
keep_fields!(Drain: outflows, energy; rebuilt outlets);

impl Drain {
    /// Nothing has left yet.
    #[must_use]
    pub fn new(outlets: &[Outlet]) -> Self {
        Self {
            outlets: outlets.to_vec(),
            outflows: vec![Outflow::default(); outlets.len()],
            energy: 0.0,
        }
    }

    /// Grains that are to leave now, ascending, counted out; `each` is told of every one with its mass (kg).
    pub fn due(&mut self, grains: &Grains, mut each: impl FnMut(&Sphere, f64)) -> Vec<u32> {
        let mut gone = Vec::new();
        if self.outlets.is_empty() {
            return gone;
        }
        for (index, (sphere, motion)) in grains.spheres.iter().zip(&grains.motions).enumerate() {
            let centre = grains.room.inside(sphere.centre);
            let through = |outlet: &Outlet| outlet.mouth.takes(centre);
            if let Some(outlet) = self.outlets.iter().position(through) {
                let mass = 1.0 / motion.inverse_mass;
                self.outflows[outlet].grains += 1;
                self.outflows[outlet].mass += mass;
                gone.push(index as u32);
                each(sphere, mass);
            }
        }
        gone
    }

    /// Least thickness (m) of an outlet that a grain could fly through between two looks; infinite without one.
    #[must_use]
    pub fn thinnest(&self) -> f64 {
        let thickness = self.outlets.iter().map(|outlet| outlet.mouth.thickness());
        thickness.fold(f64::INFINITY, f64::min)
    }

    /// What has left through all outlets.
    #[must_use]
    pub fn total(&self) -> Outflow {
        let mut total = Outflow::default();
        for outflow in &self.outflows {
            total.grains += outflow.grains;
            total.mass += outflow.mass;
        }
        total
    }

    /// Outlets by name, with what has left through each.
    pub fn by_outlet(&self) -> impl Iterator<Item = (&str, &Outflow)> {
        let names = self.outlets.iter().map(|outlet| outlet.name.as_str());
        names.zip(&self.outflows)
    }
}
