//! The published theories of one material: force at a displacement, and restitution against speed.
//!
//! `cargo run --release --example theories`

use impactlaw::prelude::*;

/// Radius of the ball, m.
const RADIUS: f64 = 250e-6;

/// What is asked of every law: its force at a flattening, and its restitution at each speed.
struct Figures<'a> {
    mass: f64,
    speeds: &'a [f64],
}

// a theory's law is a type of its own; a visitor is called with it, once, outside every loop
impl LawVisitor for Figures<'_> {
    type Output = (f64, Vec<f64>);

    fn visit<L: NormalLaw>(self, law: &L) -> (f64, Vec<f64>) {
        // laws speak in delta/R and F/R2; a history starts as the untouched contact
        let mut history = L::History::default();
        let force = law.force(0.01, &mut history) * RADIUS * RADIUS;
        let bounce = |&speed: &f64| rebound(law, RADIUS, self.mass, speed).restitution;
        (force, self.speeds.iter().map(bounce).collect())
    }
}

/// Runs the example.
///
/// # Errors
/// None with these numbers.
pub fn main() -> Result<()> {
    let solder = Material {
        density: 7274.0,
        young_modulus: 59.82e9,
        poisson_ratio: 0.33,
        flow: Some(Flow::perfectly_plastic(97.59e6)),
    };
    let mass = solder.sphere_mass(RADIUS);
    let speeds = [0.1, 1.0, 10.0];
    println!("{:<22} {:>10}  e at {speeds:?} m/s", "theory", "F(R/100) N");
    for theory in Theory::of(&solder) {
        let speeds = &speeds;
        let (force, restitution) = theory.visit(&solder, Figures { mass, speeds })?;
        println!("{theory:<22} {force:>10.4}  {restitution:.3?}");
        assert!(restitution.iter().all(|e| (0.0..=1.0 + 1e-9).contains(e)));
    }
    Ok(())
}
