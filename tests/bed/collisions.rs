//! Two bodies: what tests of single impacts in the bed share.

use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Flat, Press, Twins};
use impactlaw::contact::rebound::rebound;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::{Body, Mobility, Solid};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::normal::{Model, NormalModel};
use impactlaw::dem::grains::Grains;
use impactlaw::material::{Flow, Material};
use parry3d::math::{Rotation, Vector};

pub const RADIUS: f64 = 250e-6;
pub const MATERIAL: Material = Material {
    density: 7274.0,
    young_modulus: 59.82e9,
    poisson_ratio: 0.33,
    flow: Some(Flow::perfectly_plastic(97.59e6)),
};

/// Loads along Hertz, unloads along a stiffer straight line: a law with a closed form for everything.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Straight {
    pub loading: f64,
    pub unloading: f64,
}

impl NormalLaw for Straight {
    type History = f64;

    fn force(&self, x: f64, deepest: &mut f64) -> f64 {
        *deepest = deepest.max(x);
        let peak = self.loading * *deepest;
        (peak - self.unloading * (*deepest - x)).max(0.0)
    }

    fn stiffness(&self, x: f64, deepest: &f64) -> f64 {
        if x < *deepest {
            self.unloading
        } else {
            self.loading
        }
    }

    fn depth(&self, x: f64, deepest: &f64) -> f64 {
        if x < *deepest {
            (x - deepest * (1.0 - self.loading / self.unloading)).max(0.0)
        } else {
            x
        }
    }

    fn dissipated(&self, deepest: &f64) -> f64 {
        0.5 * self.loading * deepest * deepest * (1.0 - self.loading / self.unloading)
    }

    fn elastic_energy(&self, x: f64, deepest: &f64) -> f64 {
        let force = (self.loading * deepest - self.unloading * (deepest - x)).max(0.0);
        0.5 * force * force / self.unloading
    }

    fn contact_radius(&self, _: f64, _: &f64) -> Option<f64> {
        None
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// A law as beds use it, without its inertia term, whose contacts have one radius over R if `contact_radius` is given.
#[derive(Debug, Clone)]
pub struct Bare<L> {
    pub law: L,
    pub contact_radius: Option<f64>,
}

impl<L: NormalLaw> NormalLaw for Bare<L> {
    type History = L::History;

    fn force(&self, x: f64, history: &mut L::History) -> f64 {
        self.law.force(x, history)
    }

    fn stiffness(&self, x: f64, history: &L::History) -> f64 {
        self.law.stiffness(x, history)
    }

    fn depth(&self, x: f64, history: &L::History) -> f64 {
        self.law.depth(x, history)
    }

    fn dissipated(&self, history: &L::History) -> f64 {
        self.law.dissipated(history)
    }

    fn elastic_energy(&self, x: f64, history: &L::History) -> f64 {
        self.law.elastic_energy(x, history)
    }

    fn contact_radius(&self, x: f64, history: &L::History) -> Option<f64> {
        let given = self.contact_radius;
        given.or_else(|| self.law.contact_radius(x, history))
    }

    fn valid_to(&self) -> f64 {
        self.law.valid_to()
    }
}

/// Bed of `grains` whose pairs are pressed by `pair` and whose surface contacts by `wall`.
pub fn bed<C: ContactLaw>(
    effects: C,
    pair: impl Press,
    wall: impl Press,
    grains: Grains,
    machine: Machine,
    dt: f64,
) -> Bed<C> {
    let boxed = |model: Box<dyn NormalModel>| model;
    let normals = Normals {
        pair: boxed(Box::new(Model(pair))),
        wall: boxed(Box::new(Model(wall))),
    };
    let parts = Parts {
        grains,
        machine,
        gravity: Vector::ZERO,
        dt,
        skin: RADIUS,
    };
    Bed::new(effects, normals, parts)
}

pub fn smooth() -> Law {
    Law::smooth()
}

pub fn empty() -> Machine {
    Machine::new(Vec::new(), Vector::ZERO, RADIUS).unwrap()
}

/// A block whose top is the plane z = 0.
pub fn floor(mobility: Mobility) -> Machine {
    let edge = 20.0 * RADIUS;
    let body = Body {
        name: "floor".to_owned(),
        solid: Solid::Cuboid(Vector::splat(edge)),
        centre: Vector::new(0.0, 0.0, -edge),
        rotation: Rotation::IDENTITY,
        mobility,
        material: None,
    };
    Machine::new(vec![body], Vector::ZERO, RADIUS).unwrap()
}

/// Velocity and spin of a grain of `material` after it was thrown on a rigid floor, in `steps` a contact time of `law` alone.
pub fn thrown<C: ContactLaw>(
    effects: C,
    law: impl NormalLaw,
    material: &Material,
    velocity: Vector,
    steps: f64,
) -> [Vector; 2] {
    let mut grains = Grains::default();
    let place = Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9));
    grains.add(place, RADIUS, material.density);
    grains.motions[0].velocity = velocity;
    let mass = material.sphere_mass(RADIUS);
    let time = rebound(&law, RADIUS, mass, velocity.z.abs()).contact_time;
    let floor = floor(Mobility::Fixed);
    let pair = Twins(law.clone());
    let mut bed = bed(effects, pair, Flat(law), grains, floor, time / steps);
    collide(&mut bed);
    [bed.grains.motions[0].velocity, bed.grains.spins[0].rate]
}

/// Runs until the first grain has been pushed and is free again.
pub fn collide<C: ContactLaw>(bed: &mut Bed<C>) {
    let touching = |bed: &Bed<C>| {
        bed.contacts
            .pushes
            .iter()
            .any(|push| push.force != Vector::ZERO)
            || bed
                .surfaces
                .all()
                .any(|held| held.patch.push.force != Vector::ZERO)
    };
    let mut touched = false;
    loop {
        bed.evaluate().unwrap();
        let now = touching(bed);
        if touched && !now {
            return;
        }
        touched |= now;
        bed.advance().unwrap();
    }
}
