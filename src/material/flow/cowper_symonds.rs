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
    /// Flow stress at rest and its slope.
    #[inline(always)]
    fn rest(&self, strain: f64) -> [f64; 2] {
        [self.strength + self.modulus * strain, self.modulus]
    }

    /// Rate factor of an increment in `dt` and its derivative.
    #[inline(always)]
    fn factor(&self, increment: f64, dt: f64) -> [f64; 2] {
        if increment > 0.0 && dt > 0.0 {
            let power = self.exponent.recip();
            let rise = (increment / (self.rate * dt)).powf(power);
            [1.0 + rise, power * rise / increment]
        } else {
            [1.0, 0.0]
        }
    }

    /// Flow stress at a `strain` that grew by the increment in `dt`, and its whole derivative.
    #[inline(always)]
    fn at(&self, strain: f64, increment: f64, dt: f64) -> [f64; 2] {
        let ([rest, slope], [factor, growth]) = (self.rest(strain), self.factor(increment, dt));
        [rest * factor, slope * factor + rest * growth]
    }

    #[inline(always)]
    fn length(&self, norm: f64, stiffness: f64, strain: f64, dt: f64) -> f64 {
        if dt == 0.0 {
            // nothing flows in no time
            return 0.0;
        }
        let hardening = |strain: f64| self.rest(strain);
        let factor = |increment: f64| self.factor(increment, dt);
        rate::length_of_return(
            [norm, stiffness, strain],
            hardening(strain),
            hardening,
            factor,
        )
    }
}

impl FlowStress for CowperSymonds {
    type Memory = ();
    const COST: f64 = 4.8;

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
        let at = |k: usize| self.length(norm[k], stiffness[k], strain[k], dt);
        Lanes::new([at(0), at(1), at(2), at(3)])
    }
}
