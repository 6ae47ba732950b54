//! A law of your own in the bed: Hertz with a contact that stiffens, between balls and on a floor.
//!
//! `cargo run --release --example own_law`

use impactlaw::contact::pair::{Alike, Flat};
use impactlaw::dem::bodies::Body;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::grains::Grains;
use impactlaw::prelude::*;
use parry3d::math::Vector;

/// F/R2 = k x^1.5 (1 + s x) with x = delta/R.
#[derive(Debug, Clone)]
struct Stiffening {
    k: f64,
    s: f64,
}

// what a law has to answer: force and its derivative, and where energy goes; the bed books it
impl NormalLaw for Stiffening {
    /// Elastic: a contact remembers nothing.
    type History = ();

    fn force(&self, x: f64, (): &mut ()) -> f64 {
        let x = x.max(0.0);
        self.k * x.powf(1.5) * (1.0 + self.s * x)
    }

    fn stiffness(&self, x: f64, (): &()) -> f64 {
        let x = x.max(0.0);
        self.k * x.sqrt() * (1.5 + 2.5 * self.s * x)
    }

    fn depth(&self, x: f64, (): &()) -> f64 {
        x.max(0.0)
    }

    fn elastic_energy(&self, x: f64, (): &()) -> f64 {
        let x = x.max(0.0);
        self.k * x.powf(2.5) * (1.0 / 2.5 + self.s * x / 3.5)
    }

    fn dissipated(&self, (): &()) -> f64 {
        0.0
    }

    fn contact_radius(&self, x: f64, (): &()) -> Option<f64> {
        Some(x.max(0.0).sqrt())
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// Runs the example.
///
/// # Errors
/// None with these numbers.
pub fn main() -> Result<()> {
    let (radius, density, speed) = (1e-3, 2500.0, 1.0);
    let law = Stiffening { k: 5e7, s: 2.0 };

    // two balls above each other; the lower one meets the floor, then the upper one
    let mut grains = Grains::default();
    for height in [1.1 * radius, 3.3 * radius] {
        grains.add(Vector::new(0.0, 0.0, height), radius, density);
    }
    for motion in &mut grains.motions {
        motion.velocity = Vector::new(0.0, 0.0, -speed);
    }
    let edge = 20.0 * radius;
    let floor = Body::block(
        "floor",
        Vector::new(-edge, -edge, -edge),
        Vector::new(edge, edge, 0.0),
    );
    let parts = Parts {
        grains,
        machine: Machine::new(vec![floor], Vector::ZERO, radius)?,
        gravity: Vector::ZERO,
        dt: 2e-7,
        skin: 0.2 * radius,
    };
    // one law for contacts of two balls and of a ball with a rigid body; no effects beside it
    let normals = Normals {
        pair: Box::new(Model(Alike(law.clone()))),
        wall: Box::new(Model(Flat(law))),
    };
    let mut bed = Bed::new(Law::smooth(), normals, parts);
    for _ in 0..20_000 {
        bed.step()?;
    }
    let speeds: Vec<f64> = bed
        .grains
        .motions
        .iter()
        .map(|motion| motion.velocity.z)
        .collect();
    let kept = speeds.iter().map(|v| v * v).sum::<f64>() / (2.0 * speed * speed);
    println!(
        "velocities {speeds:.3?} m/s, {:.4} of the kinetic energy",
        kept
    );
    // an elastic law gives the energy back, however it is shared
    assert!((kept - 1.0).abs() < 1e-3);
    Ok(())
}
