//! Grains: spheres as columns, packed so that one contact reads one cache line of each.

pub mod neighbours;
pub(crate) mod newcomer;
pub mod periodic;

use self::periodic::Periodic;
use parry3d::math::Vector;
use std::f64::consts::PI;

/// Where a grain is and how large.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C)]
pub struct Sphere {
    /// Centre, m.
    pub centre: Vector,
    /// Radius, m.
    pub radius: f64,
}

/// How a grain moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C)]
pub struct Motion {
    /// Velocity half a step before the time of the positions, m/s.
    pub velocity: Vector,
    /// Inverse mass, 1/kg.
    pub inverse_mass: f64,
}

/// How a grain turns.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C)]
pub struct Spin {
    /// Angular velocity half a step before the time of the positions, rad/s.
    pub rate: Vector,
    /// Inverse moment of inertia, 1/(kg m2).
    pub inverse_inertia: f64,
}

/// All grains of a bed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Grains {
    /// Positions and radii.
    pub spheres: Vec<Sphere>,
    /// Velocities and masses.
    pub motions: Vec<Motion>,
    /// Angular velocities and moments of inertia.
    pub spins: Vec<Spin>,
    /// Energy dissipated by plastic flow in contacts that are over, a half of each contact to each of its grains, J.
    pub plastic: Vec<f64>,
    /// Name of each grain, kept when the order changes and never given again.
    pub ids: Vec<u32>,
    /// Names given so far.
    pub named: u32,
    /// Material of each grain, as an index; empty while all grains are of material 0.
    pub materials: Vec<u8>,
    /// Group each grain came in with, as an index.
    pub groups: Vec<u32>,
    /// Energy so dissipated in contacts of grains that have been taken out, J.
    pub plastic_gone: f64,
    /// Sides of the room.
    pub room: Periodic,
}

impl Grains {
    /// The spheres of a pair. Inner loops ask for them: `map` of an array is a call that is not always expanded.
    #[inline(always)]
    #[must_use]
    pub fn both(&self, [a, b]: [u32; 2]) -> [&Sphere; 2] {
        [&self.spheres[a as usize], &self.spheres[b as usize]]
    }

    /// Their radii.
    #[inline(always)]
    #[must_use]
    pub fn radii(&self, pair: [u32; 2]) -> [f64; 2] {
        let [a, b] = self.both(pair);
        [a.radius, b.radius]
    }

    /// Adds a solid sphere of `density` (kg/m3) at rest.
    pub fn add(&mut self, centre: Vector, radius: f64, density: f64) {
        let mass = 4.0 / 3.0 * PI * radius.powi(3) * density;
        self.ids.push(self.named);
        self.named += 1;
        self.spheres.push(Sphere { centre, radius });
        self.motions.push(Motion {
            velocity: Vector::ZERO,
            inverse_mass: 1.0 / mass,
        });
        self.spins.push(Spin {
            rate: Vector::ZERO,
            inverse_inertia: 1.0 / (0.4 * mass * radius * radius),
        });
        self.plastic.push(0.0);
        self.groups.push(0);
        if !self.materials.is_empty() {
            self.materials.push(0);
        }
    }

    /// Adds a solid sphere of another material than the first one.
    pub fn add_of(&mut self, material: u8, centre: Vector, radius: f64, density: f64) {
        self.materials.resize(self.len(), 0);
        self.add(centre, radius, density);
        self.materials.resize(self.len() - 1, 0);
        self.materials.push(material);
    }

    /// Material of a grain, as an index.
    #[inline(always)]
    #[must_use]
    pub fn material(&self, grain: usize) -> u8 {
        self.materials.get(grain).copied().unwrap_or(0)
    }

    /// Brings grains that left through a periodic side back on the other; returns the energy (J) they gain in
    /// `gravity` (m/s2) by it.
    pub fn reenter(&mut self, gravity: Vector) -> f64 {
        let mut gained = 0.0;
        for (sphere, motion) in self.spheres.iter_mut().zip(&self.motions) {
            let centre = self.room.inside(sphere.centre);
            gained -= gravity.dot(centre - sphere.centre) / motion.inverse_mass;
            sphere.centre = centre;
        }
        gained
    }

    /// Number of grains.
    #[must_use]
    pub fn len(&self) -> usize {
        self.spheres.len()
    }

    /// Whether there is no grain.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// Largest radius, m; 0 without grains.
    #[must_use]
    pub fn largest_radius(&self) -> f64 {
        self.spheres.iter().fold(0.0, |r, s| r.max(s.radius))
    }

    /// Smallest radius, m; infinite without grains.
    #[must_use]
    pub fn smallest_radius(&self) -> f64 {
        self.spheres
            .iter()
            .fold(f64::INFINITY, |r, s| r.min(s.radius))
    }

    /// Whether all grains have one radius, so that a contact of two is symmetric.
    #[must_use]
    pub fn monodisperse(&self) -> bool {
        self.spheres.windows(2).all(|w| w[0].radius == w[1].radius)
    }

    /// Volume of all grains, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.spheres
            .iter()
            .map(|s| 4.0 / 3.0 * PI * s.radius.powi(3))
            .sum()
    }

    /// Puts the grains in the order of `old` indices; those not among them are gone.
    pub fn reorder(&mut self, old: &[u32]) {
        fn pick<T: Copy>(column: &mut Vec<T>, old: &[u32]) {
            *column = old.iter().map(|&i| column[i as usize]).collect();
        }
        pick(&mut self.spheres, old);
        pick(&mut self.motions, old);
        pick(&mut self.spins, old);
        pick(&mut self.plastic, old);
        pick(&mut self.ids, old);
        pick(&mut self.groups, old);
        if !self.materials.is_empty() {
            pick(&mut self.materials, old);
        }
    }
}
