//! Cowper and Symonds' rate factor (1957) on linear hardening: $\sigma_y = (Y + H \varepsilon_p) \left(1 + (\dot\varepsilon_p /
//! D)^{1/q}\right)$. The rate is that of the step itself ([`super::product`]).

use super::product::Product;
use super::{HARDENING_MODULUS, YIELD_STRENGTH, flow_stress};
use crate::material::constant::{Absent, Constant, Dimension, Range};

/// Rate D at which the strength is twice that at rest.
pub const DOUBLING_RATE: Constant = Constant {
    key: "doubling_rate",
    symbol: "D",
    effect: "rate",
    dimension: Dimension::Rate,
    range: Range::Positive,
    absent: Absent::Other,
    meaning: "D of Cowper and Symonds' rate factor 1 + (rate/D)^(1/q): the plastic strain rate that doubles the strength",
    example: "'6500 1/s'",
    otherwise: "none: no such rate factor",
};

/// Exponent q.
pub const RATE_EXPONENT: Constant = Constant {
    key: "rate_exponent",
    symbol: "q",
    effect: "rate",
    dimension: Dimension::Number,
    range: Range::Positive,
    absent: Absent::Other,
    meaning: "q of Cowper and Symonds' rate factor 1 + (rate/D)^(1/q); needs a doubling rate",
    example: "4",
    otherwise: "none: no such rate factor",
};

flow_stress! {
    /// Cowper and Symonds' flow stress, $(Y + H \varepsilon_p) \left(1 + (\dot\varepsilon_p / D)^{1/q}\right)$.
    CowperSymonds, "Cowper-Symonds" {
        /// Initial yield strength Y.
        strength: YIELD_STRENGTH,
        /// Hardening modulus H.
        modulus: HARDENING_MODULUS,
        /// Rate D.
        rate: DOUBLING_RATE,
        /// Exponent q.
        exponent: RATE_EXPONENT,
    }
}

impl Product for CowperSymonds {
    type Memory = ();
    const COST: f64 = 4.8;

    #[inline(always)]
    fn rest(&self, strain: f64) -> [f64; 2] {
        [self.strength + self.modulus * strain, self.modulus]
    }

    #[inline(always)]
    fn rate_factor(&self, increment: f64, dt: f64) -> [f64; 2] {
        if increment > 0.0 && dt > 0.0 {
            let power = self.exponent.recip();
            let rise = (increment / (self.rate * dt)).powf(power);
            [1.0 + rise, power * rise / increment]
        } else {
            [1.0, 0.0]
        }
    }
}
