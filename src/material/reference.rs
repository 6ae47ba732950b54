//! Reference units of an impact: R = rho = E = 1, time in R/c0; temperatures stay in kelvin.

use super::Material;
use super::constant::Dimension;

/// The units in which one sphere's impact is simulated, in SI. Two runs that are equal in these units are the same run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceUnits {
    /// Radius R, m.
    pub length: f64,
    /// Density rho, kg/m3.
    pub density: f64,
    /// Young's modulus E, Pa.
    pub stress: f64,
}

impl ReferenceUnits {
    /// Of a sphere of `radius`.
    #[must_use]
    pub fn of(material: &Material, radius: f64) -> Self {
        ReferenceUnits {
            length: radius,
            density: material.density,
            stress: material.young_modulus,
        }
    }

    /// Bar wave speed $c_0 = \sqrt{E/\rho}$, m/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        (self.stress / self.density).sqrt()
    }

    /// R/c0, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.length / self.speed()
    }

    /// E R^2, N.
    #[must_use]
    pub fn force(&self) -> f64 {
        self.stress * self.length * self.length
    }

    /// E R^3, J.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.force() * self.length
    }

    /// Unit of a material constant, in SI. Plastic work over a specific heat in these units is a rise in kelvin.
    #[must_use]
    pub fn unit(&self, dimension: Dimension) -> f64 {
        match dimension {
            Dimension::Number | Dimension::Temperature => 1.0,
            Dimension::Stress => self.stress,
            Dimension::Rate => self.time().recip(),
            Dimension::SpecificHeat => self.stress / self.density,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: ReferenceUnits = ReferenceUnits {
        length: 250e-6,
        density: 8000.0,
        stress: 200e9,
    };

    #[test]
    fn reference_units_know_seconds_and_kelvin() {
        // c0 = 5000 m/s, R/c0 = 50 ns
        assert!((STEEL.time() / 50e-9 - 1.0).abs() < 1e-14);
        let rate = 40.0 / STEEL.unit(Dimension::Rate);
        assert!((rate / 2e-6 - 1.0).abs() < 1e-14);
        // 1 MJ/m3 of work heats 8000 kg/m3 of 500 J/(kg K) by 0.25 K
        let work = 1e6 / STEEL.unit(Dimension::Stress);
        let heat = 500.0 / STEEL.unit(Dimension::SpecificHeat);
        assert!((work / heat / 0.25 - 1.0).abs() < 1e-14);
        assert_eq!(STEEL.unit(Dimension::Temperature), 1.0);
    }
}
