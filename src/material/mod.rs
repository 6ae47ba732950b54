//! Material of a particle: elastic constants, flow stress, and the yield quantities that follow from them.

pub mod adhesion;
pub mod constant;
pub mod effective;
pub mod flow;
pub mod reference;
pub mod stress;
pub mod table;

pub use effective::Effective;
pub use flow::Flow;
pub use reference::ReferenceUnits;
pub use table::MaterialTable;

use std::f64::consts::PI;
use stress::Moduli;

/// Peak Hertz pressure at first yield over the yield strength (Johnson 1985, section 6.3).
pub const YIELD_PRESSURE_RATIO: f64 = 1.6;

/// Mean contact pressure over yield strength when fully plastic, used for estimates only (Tabor).
pub const PLASTIC_PRESSURE_RATIO: f64 = 2.8;

/// Equivalent plastic strain of a spherical contact over a/R (Tabor 1951).
const REPRESENTATIVE_STRAIN: f64 = 0.2;
/// Mean of a strain that grows with the root of the flattening, over its last value, weighted with the work of a force in proportion
/// to the flattening.
const MEAN_STRAIN: f64 = 0.8;

/// Material of a particle, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Density rho, kg/m3.
    pub density: f64,
    /// Young's modulus E, Pa.
    pub young_modulus: f64,
    /// Poisson's ratio nu, in [0, 0.5).
    pub poisson_ratio: f64,
    /// Flow stress; `None` for an elastic body.
    pub flow: Option<Flow>,
}

/// Onset of yield of a sphere on a rigid flat (theory of Hertz, peak pressure `1.6 Y`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldPoint {
    /// Flattening delta_y, m.
    pub displacement: f64,
    /// Force F_y, N.
    pub force: f64,
    /// Impact speed V_y below which the sphere stays elastic, m/s.
    pub velocity: f64,
}

impl Material {
    /// Contact modulus on a rigid flat, $E^\ast = E/(1-\nu^2)$, Pa.
    #[must_use]
    pub fn contact_modulus(&self) -> f64 {
        self.young_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }

    /// Shear modulus $G = E/(2 + 2\nu)$, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        Moduli::new(self.young_modulus, self.poisson_ratio).shear
    }

    /// Mass of a sphere, kg.
    #[must_use]
    pub fn sphere_mass(&self, radius: f64) -> f64 {
        4.0 / 3.0 * PI * radius.powi(3) * self.density
    }

    /// Time a Rayleigh wave takes over half a sphere of `radius` (m), s.
    ///
    /// $$ T_R = \frac{\pi R \sqrt{\rho / G}}{0.1631 \nu + 0.8766} $$
    ///
    /// Source: Thornton and Randall 1988; the denominator is the usual fit of the Rayleigh speed over the shear speed.
    ///
    /// ```
    /// use impactlaw::material::Material;
    /// let glass = Material { density: 2500.0, young_modulus: 5e7, poisson_ratio: 0.3, flow: None };
    /// // pi * 1e-3 * sqrt(2500 / 1.923e7) / 0.92553 = 3.87e-5 s
    /// assert!((glass.rayleigh_time(1e-3) - 3.87e-5).abs() < 1e-7);
    /// ```
    #[must_use]
    pub fn rayleigh_time(&self, radius: f64) -> f64 {
        let nu = self.poisson_ratio;
        let shear = self.shear_modulus();
        PI * radius * (self.density / shear).sqrt() / (0.1631 * nu + 0.8766)
    }

    /// Flattening over the radius of a sphere that hits a rigid plane at `velocity` (m/s): were it elastic (Hertz), and were it
    /// fully plastic with the mean pressure [`PLASTIC_PRESSURE_RATIO`] times the flow stress (0 for an elastic body). That is taken
    /// at the strain of the contact: with H = E/10 and E/Y = 2000 it is 17 Y at a/R = 0.5.
    ///
    /// $$ \delta_e = \left(\tfrac{15 m V^2}{16 E^\ast \sqrt{R}}\right)^{2/5}, \quad
    ///    \delta_p = V \sqrt{\tfrac{m}{2 \pi R\ 2.8 \sigma}}, \quad
    ///    \sigma = \sigma_y\left(0.16 \sqrt{2 \delta_p / R}\right) $$
    #[must_use]
    pub fn flattening_limits(&self, velocity: f64) -> [f64; 2] {
        let e = self.young_modulus;
        let e_star = self.contact_modulus() / e;
        let speed = velocity / (e / self.density).sqrt();
        let mass = 4.0 / 3.0 * PI;
        let elastic = (15.0 * mass * speed * speed / (16.0 * e_star)).powf(0.4);
        let plastic = self.flow.map_or(0.0, |flow| {
            let against = |stress: f64| {
                speed * (mass / (2.0 * PI * PLASTIC_PRESSURE_RATIO * stress / e)).sqrt()
            };
            let mut flattening = against(flow.yield_strength());
            // each round leaves a quarter of the error at most
            for _ in 0..25 {
                let radius = (2.0 * flattening).sqrt().min(1.0);
                let strain = MEAN_STRAIN * REPRESENTATIVE_STRAIN * radius;
                flattening = against(flow.at_rest(strain));
            }
            flattening
        });
        [elastic, plastic]
    }

    /// Yield point of a sphere of `radius` for a peak pressure $p_0 = c Y$ at first yield.
    ///
    /// $$ \delta_y = \left(\frac{\pi p_0}{2 E^\ast}\right)^2 R, \quad F_y = \frac{\pi^3 p_0^3 R^2}{6 E^{\ast 2}}, \quad
    ///    \tfrac12 m V_y^2 = \tfrac25 F_y \delta_y $$
    ///
    /// `None` for an elastic body. Source: Johnson 1985, section 6.3; thesis (4-10), (4-11).
    #[must_use]
    pub fn yield_point(&self, radius: f64, pressure_ratio: f64) -> Option<YieldPoint> {
        let p_0 = pressure_ratio * self.flow?.yield_strength();
        let e_star = self.contact_modulus();
        let delta_y = (PI * p_0 / (2.0 * e_star)).powi(2) * radius;
        let f_y = PI.powi(3) * p_0.powi(3) * radius * radius / (6.0 * e_star * e_star);
        let v_y = (0.8 * f_y * delta_y / self.sphere_mass(radius)).sqrt();
        Some(YieldPoint {
            displacement: delta_y,
            force: f_y,
            velocity: v_y,
        })
    }
}
