//! Johnson and Cook's flow stress (1983), with the adiabatic heating of plastic work or at room temperature:
//!
//! $$ \sigma_y = (Y + B \varepsilon_p^n) \left(1 + C \ln \max(1, \dot\varepsilon_p / \dot\varepsilon_0)\right)
//!    \left(1 - \theta^m\right), \qquad \theta = \frac{T - T_0}{T_m - T_0}, \qquad \rho c\ \dot T = \beta\ \dot w_p $$
//!
//! Below the reference rate the logarithm is held at 0: slower flow is no softer than at the reference rate. From the melting
//! temperature on there is no strength. The body begins at room temperature $T_0$, and no heat is conducted: a diffusion length
//! $\sqrt{\kappa t}$ of copper in 1 us is 10 um. The temperature in a step is that of its beginning; the rate is that of the step
//! itself ([`super::product`]). The share $1 - \beta$ of the plastic work stays in the material.

use super::power_hardening::power;
use super::product::Product;
use super::{HARDENING_COEFFICIENT, HARDENING_EXPONENT, YIELD_STRENGTH, flow_stress};
use crate::lanes::Lanes;
use crate::material::constant::{Absent, Constant, Dimension, Range};
use crate::unit::significant;

/// Rate sensitivity C.
pub const RATE_SENSITIVITY: Constant = Constant {
    key: "rate_sensitivity",
    symbol: "C",
    effect: "rate",
    dimension: Dimension::Number,
    range: Range::Share,
    absent: Absent::Other,
    meaning: "C of Johnson and Cook's rate factor 1 + C ln(rate/reference rate), which is 1 below the reference rate; needs the constants of power-law hardening",
    example: "0.025",
    otherwise: "none: no such rate factor",
};

/// Reference rate.
pub const REFERENCE_RATE: Constant = Constant {
    key: "reference_rate",
    symbol: "rate0",
    effect: "rate",
    dimension: Dimension::Rate,
    range: Range::Positive,
    absent: Absent::Usual(1.0),
    meaning: "plastic strain rate at which Johnson and Cook's constants were found; needs a rate sensitivity",
    example: "'1 1/s'",
    otherwise: "1 1/s",
};

/// Exponent m of thermal softening.
pub const SOFTENING_EXPONENT: Constant = Constant {
    key: "softening_exponent",
    symbol: "m",
    effect: "heating",
    dimension: Dimension::Number,
    range: Range::Positive,
    absent: Absent::Other,
    meaning: "m of Johnson and Cook's thermal factor 1 - ((T - T_room)/(T_melt - T_room))^m; plastic work heats the body, which begins at room temperature",
    example: "1.09",
    otherwise: "none: no heating",
};

/// Melting temperature.
pub const MELTING_TEMPERATURE: Constant = Constant {
    key: "melting_temperature",
    symbol: "Tm",
    effect: "heating",
    dimension: Dimension::Temperature,
    range: Range::Positive,
    absent: Absent::Other,
    meaning: "temperature from which there is no strength; above room_temperature",
    example: "'1356 K'",
    otherwise: "none: no heating",
};

/// Room temperature.
pub const ROOM_TEMPERATURE: Constant = Constant {
    key: "room_temperature",
    symbol: "T0",
    effect: "heating",
    dimension: Dimension::Temperature,
    range: Range::Positive,
    absent: Absent::Usual(298.15),
    meaning: "temperature at which Johnson and Cook's constants were found and at which the body begins; needs the constants of heating",
    example: "'25 degC'",
    otherwise: "25 degC",
};

/// Specific heat.
pub const SPECIFIC_HEAT: Constant = Constant {
    key: "specific_heat",
    symbol: "cp",
    effect: "heating",
    dimension: Dimension::SpecificHeat,
    range: Range::Positive,
    absent: Absent::Other,
    meaning: "heat that warms a mass by a temperature",
    example: "'383 J/(kg K)'",
    otherwise: "none: no heating",
};

/// Taylor and Quinney's share of the plastic work that becomes heat.
pub const TAYLOR_QUINNEY: Constant = Constant {
    key: "taylor_quinney_coefficient",
    symbol: "beta",
    effect: "heating",
    dimension: Dimension::Number,
    range: Range::Share,
    absent: Absent::Usual(0.9),
    meaning: "share of the plastic work that becomes heat; the rest stays in the material",
    example: "0.9",
    otherwise: "0.9",
};

flow_stress! {
    /// Johnson and Cook's flow stress at room temperature, $(Y + B \varepsilon_p^n) (1 + C \ln \dot\varepsilon^\ast)$.
    IsothermalJohnsonCook, "Johnson-Cook without heating" {
        /// Initial yield strength Y (Johnson and Cook's A).
        strength: YIELD_STRENGTH,
        /// Coefficient B.
        coefficient: HARDENING_COEFFICIENT,
        /// Exponent n.
        exponent: HARDENING_EXPONENT,
        /// Rate sensitivity C.
        sensitivity: RATE_SENSITIVITY,
        /// Reference rate.
        rate: REFERENCE_RATE,
    }
}

flow_stress! {
    /// Johnson and Cook's flow stress with adiabatic heating.
    JohnsonCook, "Johnson-Cook" {
        /// Initial yield strength Y (Johnson and Cook's A).
        strength: YIELD_STRENGTH,
        /// Coefficient B.
        coefficient: HARDENING_COEFFICIENT,
        /// Exponent n.
        exponent: HARDENING_EXPONENT,
        /// Rate sensitivity C.
        sensitivity: RATE_SENSITIVITY,
        /// Reference rate.
        rate: REFERENCE_RATE,
        /// Exponent m.
        softening: SOFTENING_EXPONENT,
        /// Melting temperature.
        melting: MELTING_TEMPERATURE,
        /// Room temperature.
        room: ROOM_TEMPERATURE,
        /// Specific heat.
        heat: SPECIFIC_HEAT,
        /// Share of the plastic work that becomes heat.
        share: TAYLOR_QUINNEY,
    }
}

impl Product for IsothermalJohnsonCook {
    type Memory = ();
    const COST: f64 = 5.9;

    #[inline(always)]
    fn rest(&self, strain: f64) -> [f64; 2] {
        power(self.strength, self.coefficient, self.exponent, strain)
    }

    #[inline(always)]
    fn rate_factor(&self, increment: f64, dt: f64) -> [f64; 2] {
        let slowest = self.rate * dt;
        if increment > slowest && dt > 0.0 {
            let factor = 1.0 + self.sensitivity * (increment / slowest).ln();
            [factor, self.sensitivity / increment]
        } else {
            [1.0, 0.0]
        }
    }

    #[inline(always)]
    fn knows_rates(&self) -> bool {
        self.sensitivity > 0.0
    }
}

impl JohnsonCook {
    /// The same at room temperature.
    #[inline(always)]
    fn at_room(&self) -> IsothermalJohnsonCook {
        let JohnsonCook {
            strength,
            coefficient,
            exponent,
            sensitivity,
            rate,
            ..
        } = *self;
        IsothermalJohnsonCook {
            strength,
            coefficient,
            exponent,
            sensitivity,
            rate,
        }
    }
}

impl Product for JohnsonCook {
    /// Temperature above room temperature, K.
    type Memory = Lanes;
    const COST: f64 = 6.8;

    #[inline(always)]
    fn rest(&self, strain: f64) -> [f64; 2] {
        self.at_room().rest(strain)
    }

    #[inline(always)]
    fn rate_factor(&self, increment: f64, dt: f64) -> [f64; 2] {
        self.at_room().rate_factor(increment, dt)
    }

    #[inline(always)]
    fn knows_rates(&self) -> bool {
        self.at_room().knows_rates()
    }

    #[inline(always)]
    fn left(&self, rise: &Lanes) -> Lanes {
        rise.map(|rise| {
            let homologous = rise / (self.melting - self.room);
            if homologous >= 1.0 {
                0.0
            } else if self.softening == 1.0 {
                1.0 - homologous
            } else {
                1.0 - homologous.powf(self.softening)
            }
        })
    }

    #[inline(always)]
    fn remember(&self, work: Lanes, rise: &mut Lanes) {
        *rise += work * (self.share / self.heat);
    }

    fn heat_share(&self) -> f64 {
        self.share
    }

    fn temperature(&self, rise: &Lanes) -> Option<Lanes> {
        Some(*rise + Lanes::splat(self.room))
    }

    fn heat_to_melt(&self) -> Option<f64> {
        Some(self.heat * (self.melting - self.room))
    }

    fn contradiction(&self) -> Option<(Constant, String)> {
        let allowed = || {
            let room = significant(self.room, 5);
            format!("must be above `{}` ({room} K)", ROOM_TEMPERATURE.key)
        };
        (self.melting <= self.room).then(|| (MELTING_TEMPERATURE, allowed()))
    }
}
