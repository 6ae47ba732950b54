//! Linear isotropic hardening: the thesis' "bilinear" material.

use super::{FlowStress, YIELD_STRENGTH, flow_stress};
use crate::lanes::Lanes;
use crate::material::constant::{Absent, Constant, Dimension, Range};

/// Linear hardening modulus H.
pub const HARDENING_MODULUS: Constant = Constant {
    key: "hardening_modulus",
    symbol: "H",
    effect: "hardening",
    dimension: Dimension::Stress,
    range: Range::NotNegative,
    absent: Absent::Nothing,
    meaning: "slope of the flow stress over the equivalent plastic strain; needs a yield strength",
    example: "'500 MPa'",
    otherwise: "0",
};

flow_stress! {
    /// Linear isotropic hardening, $\sigma_y = Y + H \varepsilon_p$.
    LinearHardening, "linear hardening" {
        /// Initial yield strength Y.
        strength: YIELD_STRENGTH,
        /// Hardening modulus H.
        modulus: HARDENING_MODULUS,
    }
}

impl FlowStress for LinearHardening {
    type Memory = ();

    #[inline(always)]
    fn stress(&self, strain: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        Lanes::splat(self.strength) + strain * self.modulus
    }

    #[inline(always)]
    fn slope(&self, _: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        Lanes::splat(self.modulus)
    }
}
