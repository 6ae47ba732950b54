//! Tester: how fast a single-particle impact tester throws its particles, from the vacuum that draws air through its tube.
//!
//! Saifoori (2025, section 6.3.1) took the form that Bonakdar and others (2021, Int. J. Pharm. 597, 120365) gave an aerosol disperser:
//!
//! $$ N_v^{1/3} = \frac{C_1 \left(\frac{P}{\rho_a g h}\right)^{C_2}}{(S - 1)^{C_3} N_d^{C_4/3}}, \qquad
//!    N_v^{1/3} = V \left[\frac{3}{4 g \nu_a (S - 1)}\right]^{1/3}, \qquad
//!    N_d^{1/3} = D \left[\frac{4 g (S - 1)}{3 \nu_a^2}\right]^{1/3} $$
//!
//! (his equations 6-1 to 6-3) with the gauge pressure P of the vacuum, the length h of the tube, S the density of the particle over that
//! of the air and $\nu_a$ the air's kinematic viscosity. Without a vacuum the form gives no speed at all: the particle falls
//! ([`fall`]). Measured speeds give the four constants ([`fit`]).

pub mod fall;
pub mod fit;
pub mod table;

use std::ops::RangeInclusive;

/// Acceleration of gravity, m/s2.
pub const GRAVITY: f64 = 9.81;

/// Air of the laboratory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Density, kg/m3.
    pub density: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
}

impl Air {
    /// Air at 20 degC and one atmosphere. The thesis does not print what it used.
    pub const USUAL: Air = Air {
        density: 1.204,
        viscosity: 1.81e-5,
    };

    /// Kinematic viscosity, m2/s.
    #[must_use]
    pub fn kinematic(&self) -> f64 {
        self.viscosity / self.density
    }
}

/// A particle that is thrown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Diameter D, m.
    pub diameter: f64,
    /// Density, kg/m3.
    pub density: f64,
}

/// Constants of the correlation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// $C_1$ to $C_4$.
    pub values: [f64; 4],
}

/// What a set of constants was found from.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Gauge pressures, Pa.
    pub pressures: RangeInclusive<f64>,
    /// Diameters, m.
    pub diameters: RangeInclusive<f64>,
    /// Densities, kg/m3.
    pub densities: RangeInclusive<f64>,
}

/// Equation (6-6): high-density polyethylene, two polypropylenes and glass.
pub const POLYMERS_AND_GLASS: Constants = Constants {
    values: [371.23, 0.464, 0.673, 0.235],
};
/// Equation (6-7): the same with balls of SAC305 solder.
pub const WITH_SOLDER: Constants = Constants {
    values: [240.527, 0.472, 0.624, 0.221],
};

impl Support {
    /// That of [`POLYMERS_AND_GLASS`].
    #[must_use]
    pub fn of_polymers_and_glass() -> Self {
        Support {
            pressures: 4e3..=16e3,
            diameters: 500e-6..=1e-3,
            densities: 745.0..=2545.0,
        }
    }

    /// That of [`WITH_SOLDER`].
    #[must_use]
    pub fn with_solder() -> Self {
        Support {
            pressures: 4e3..=20e3,
            diameters: 350e-6..=1e-3,
            densities: 745.0..=7274.0,
        }
    }

    /// Quantities of a throw that lie outside.
    #[must_use]
    pub fn lacks(&self, particle: &Particle, pressure: f64) -> Vec<&'static str> {
        // a bound that was written in another unit is met all the same
        let within = |range: &RangeInclusive<f64>, value: f64| {
            (range.start() * (1.0 - 1e-9)..=range.end() * (1.0 + 1e-9)).contains(&value)
        };
        [
            ("pressure", within(&self.pressures, pressure)),
            ("diameter", within(&self.diameters, particle.diameter)),
            ("density", within(&self.densities, particle.density)),
        ]
        .into_iter()
        .filter_map(|(what, held)| (!held).then_some(what))
        .collect()
    }
}

/// Standard deviations of what a speed is reckoned from, each over its value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviations {
    /// Of the gauge pressure.
    pub pressure: f64,
    /// Of the diameter.
    pub diameter: f64,
    /// Of the particle's density.
    pub density: f64,
    /// Of measured speeds about the correlation.
    pub scatter: f64,
}

/// A tester.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tester {
    /// The air it draws.
    pub air: Air,
    /// Length of its tube, m.
    pub tube: f64,
    /// Constants of its correlation.
    pub constants: Constants,
}

impl Tester {
    /// Length of the tube of the tester of Saifoori (2025), m.
    pub const TUBE: f64 = 0.401;

    /// $P/(\rho_a g h)$.
    #[must_use]
    pub fn head(&self, pressure: f64) -> f64 {
        pressure / (self.air.density * GRAVITY * self.tube)
    }

    /// Speed of impact, m/s, at a gauge `pressure`, Pa, of the vacuum; the particle is denser than air.
    ///
    /// ```
    /// use impactlaw::tester::{Air, Particle, Tester, WITH_SOLDER};
    ///
    /// let tester = Tester { air: Air::USUAL, tube: Tester::TUBE, constants: WITH_SOLDER };
    /// let solder = Particle { diameter: 500e-6, density: 7274.0 };
    /// assert!((tester.speed(&solder, 10e3) - 18.8).abs() < 0.05);
    /// ```
    #[must_use]
    pub fn speed(&self, particle: &Particle, pressure: f64) -> f64 {
        let [c1, c2, c3, c4] = self.constants.values;
        let denser = self.denser(particle);
        let number =
            c1 * self.head(pressure).powf(c2) / (denser.powf(c3) * self.size(particle).powf(c4));
        number / self.per_speed(particle)
    }

    /// Standard deviation of the speed over the speed: the correlation is a product of powers, whose exponents weigh the deviations.
    #[must_use]
    pub fn deviation(&self, particle: &Particle, by: &Deviations) -> f64 {
        let [_, c2, c3, c4] = self.constants.values;
        let denser = self.denser(particle);
        let by_density = (1.0 / 3.0 - c3 - c4 / 3.0) * (denser + 1.0) / denser;
        [
            by.scatter,
            c2 * by.pressure,
            c4 * by.diameter,
            by_density * by.density,
        ]
        .into_iter()
        .fold(0.0, f64::hypot)
    }

    /// S - 1.
    fn denser(&self, particle: &Particle) -> f64 {
        particle.density / self.air.density - 1.0
    }

    /// $N_v^{1/3}$ over V (equation 6-2).
    fn per_speed(&self, particle: &Particle) -> f64 {
        (3.0 / (4.0 * GRAVITY * self.air.kinematic() * self.denser(particle))).cbrt()
    }

    /// $N_d^{1/3}$ (equation 6-3).
    fn size(&self, particle: &Particle) -> f64 {
        let viscosity = self.air.kinematic();
        particle.diameter
            * (4.0 * GRAVITY * self.denser(particle) / (3.0 * viscosity * viscosity)).cbrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tester(constants: Constants) -> Tester {
        Tester {
            air: Air::USUAL,
            tube: Tester::TUBE,
            constants,
        }
    }

    const SOLDER: Particle = Particle {
        diameter: 500e-6,
        density: 7274.0,
    };

    #[test]
    fn solder_at_ten_kilopascal_is_thrown_as_both_sets_say() {
        let by = |constants| tester(constants).speed(&SOLDER, 10e3);
        assert!((by(POLYMERS_AND_GLASS) - 16.9).abs() < 0.05);
        assert!((by(WITH_SOLDER) - 18.8).abs() < 0.05);
    }

    #[test]
    fn deviations_are_the_slopes_of_the_speed() {
        let tester = tester(WITH_SOLDER);
        let v = tester.speed(&SOLDER, 10e3);
        let share = 1e-6;
        let slope = |speed: f64| ((speed / v).ln() / share).abs();
        let larger = Particle {
            diameter: SOLDER.diameter * (1.0 + share),
            ..SOLDER
        };
        let denser = Particle {
            density: SOLDER.density * (1.0 + share),
            ..SOLDER
        };
        let one = |by: Deviations| tester.deviation(&SOLDER, &by);
        let none = Deviations::default();
        let pairs = [
            (
                slope(tester.speed(&SOLDER, 10e3 * (1.0 + share))),
                one(Deviations {
                    pressure: 1.0,
                    ..none
                }),
            ),
            (
                slope(tester.speed(&larger, 10e3)),
                one(Deviations {
                    diameter: 1.0,
                    ..none
                }),
            ),
            (
                slope(tester.speed(&denser, 10e3)),
                one(Deviations {
                    density: 1.0,
                    ..none
                }),
            ),
        ];
        for (slope, stated) in pairs {
            assert!((slope / stated - 1.0).abs() < 1e-5, "{slope} {stated}");
        }
        let both = one(Deviations {
            pressure: 0.3,
            scatter: 0.4,
            ..none
        });
        assert!((both - (0.16 + (0.3 * 0.472f64).powi(2)).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn what_the_constants_were_not_found_from_is_named() {
        let support = Support::with_solder();
        assert!(support.lacks(&SOLDER, 10e3).is_empty());
        assert!(support.lacks(&SOLDER, 20e3).is_empty());
        let dust = Particle {
            diameter: 63e-6,
            density: 2700.0,
        };
        assert_eq!(support.lacks(&dust, 1e3), ["pressure", "diameter"]);
    }
}
