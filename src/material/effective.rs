//! Effective body of two: the sphere that meets a rigid plane as they meet each other.

use super::Material;
use std::f64::consts::PI;

/// The sphere that meets a rigid, flat wall as two bodies meet each other, SI units.
///
/// Two bodies in normal contact are, to first order in a/R, one: their gap has the curvature of a sphere of radius $R$ on a plane,
/// it closes against the compliance of both, and the motion that contact can stop is that of the reduced mass,
///
/// $$ \frac1R = \frac1{R_1} + \frac1{R_2}, \qquad \frac1{E^\ast} = \frac{1-\nu_1^2}{E_1} + \frac{1-\nu_2^2}{E_2}, \qquad
///    \frac1m = \frac1{m_1} + \frac1{m_2}, \qquad \rho = \frac{3m}{4\pi R^3} . $$
///
/// The approach $\delta$ is that of the two centres of mass, so $m \ddot\delta = -F$ holds exactly; of a plate or half-space, which
/// is held far away, that of the particle's, and $R = R_1$, $m = m_1$. The flow stress is that of the body of the smaller yield strength:
/// it yields first, where the common pressure of Hertz reaches $1.6\ Y$. Young's modulus is written for that body's $\nu$, so that
/// $E/(1-\nu^2) = E^\ast$. Source: Johnson 1985, sections 4.2, 6.3 and 11.4.
///
/// | limit | effective body |
/// |---|---|
/// | rigid flat target | the particle itself |
/// | two equal spheres | $R/2$, $E^\ast/2$, $m/2$, $Y$: what each does on a rigid wall at half the speed, with twice the $\delta$ |
///
/// ```
/// use impactlaw::material::{Effective, Flow, Material};
/// let steel = Material { density: 7800.0, young_modulus: 2e11, poisson_ratio: 0.3, flow: Some(Flow::perfectly_plastic(1e9)) };
/// let twins = Effective::of(&steel, 1e-3, &steel, Some(1e-3));
/// assert!((twins.radius / 0.5e-3 - 1.0).abs() < 1e-14);
/// assert!((twins.material.contact_modulus() / steel.contact_modulus() - 0.5).abs() < 1e-14);
/// assert!((twins.material.sphere_mass(twins.radius) / steel.sphere_mass(1e-3) - 0.5).abs() < 1e-14);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effective {
    /// $R$, m.
    pub radius: f64,
    /// Its constants.
    pub material: Material,
}

/// $1/(1/a + 1/b)$; `a` where `b` is infinite, bit for bit.
fn reduced(a: f64, b: f64) -> f64 {
    if b.is_infinite() { a } else { a * b / (a + b) }
}

impl Effective {
    /// Of a sphere of `radius` (m) and a second body, which is flat and held where it has no radius.
    #[must_use]
    pub fn of(first: &Material, radius: f64, second: &Material, other: Option<f64>) -> Self {
        let (curvature, inertia) = match other {
            None => (f64::INFINITY, f64::INFINITY),
            Some(other) => (other, second.sphere_mass(other)),
        };
        let effective = reduced(radius, curvature);
        let mass = reduced(first.sphere_mass(radius), inertia);
        let strength = |m: &Material| m.flow.map_or(f64::INFINITY, |flow| flow.yield_strength());
        let softer = match strength(second) < strength(first) {
            true => second,
            false => first,
        };
        let modulus = reduced(first.contact_modulus(), second.contact_modulus());
        let nu = softer.poisson_ratio;
        Effective {
            radius: effective,
            material: Material {
                density: mass / (4.0 / 3.0 * PI * effective.powi(3)),
                young_modulus: modulus * (1.0 - nu * nu),
                poisson_ratio: nu,
                flow: softer.flow,
            },
        }
    }

    /// Mass $m$, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.material.sphere_mass(self.radius)
    }
}
