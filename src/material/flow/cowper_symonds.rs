//! Cowper and Symonds' rate factor (1957) on linear hardening: $\sigma_y = (Y + H \varepsilon_p) \left(1 + (\dot\varepsilon_p /
//! D)^{1/q}\right)$. The rate is that of the step itself ([`super::rate`]).

use super::{FlowStress, HARDENING_MODULUS, YIELD_STRENGTH, flow_stress, rate};
use crate::lanes::Lanes;
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

impl CowperSymonds {
    /// Flow stress at a `strain` that grew by the increment in `dt`, and its whole derivative.
    #[inline(always)]
    fn at(&self, strain: f64, increment: f64, dt: f64) -> [f64; 2] {
        let rest = self.strength + self.modulus * strain;
        if !(increment > 0.0 && dt > 0.0) {
            return [rest, self.modulus];
        }
        let power = self.exponent.recip();
        let rise = (increment / (self.rate * dt)).powf(power);
        let growth = power * rise / increment;
        [
            rest * (1.0 + rise),
            self.modulus * (1.0 + rise) + rest * growth,
        ]
    }

    fn length(&self, norm: f64, stiffness: f64, strain: f64, dt: f64) -> f64 {
        if dt == 0.0 {
            // nothing flows in no time
            return 0.0;
        }
        let [rest, _] = self.at(strain, 0.0, dt);
        rate::length_of_return(norm, stiffness, rest, |increment| {
            self.at(strain + increment, increment, dt)
        })
    }
}

impl FlowStress for CowperSymonds {
    type Memory = ();

    #[inline(always)]
    fn stress(&self, strain: Lanes, increment: Lanes, dt: f64, (): &()) -> Lanes {
        strain.zip(increment, |strain, increment| {
            self.at(strain, increment, dt)[0]
        })
    }

    #[inline(always)]
    fn slope(&self, strain: Lanes, increment: Lanes, dt: f64, (): &()) -> Lanes {
        strain.zip(increment, |strain, increment| {
            self.at(strain, increment, dt)[1]
        })
    }

    #[inline(always)]
    fn length_of_return(
        &self,
        norm: Lanes,
        stiffness: Lanes,
        strain: Lanes,
        dt: f64,
        (): &(),
    ) -> Lanes {
        let (norm, stiffness, strain) = (norm.array(), stiffness.array(), strain.array());
        Lanes::new([0, 1, 2, 3].map(|k| self.length(norm[k], stiffness[k], strain[k], dt)))
    }
}
