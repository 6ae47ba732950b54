//! Perfect plasticity: a constant flow stress.

use super::{FlowStress, YIELD_STRENGTH, flow_stress};
use crate::lanes::Lanes;

flow_stress! {
    /// Constant flow stress Y.
    PerfectlyPlastic, "perfectly plastic" {
        /// Yield strength Y.
        strength: YIELD_STRENGTH,
    }
}

impl FlowStress for PerfectlyPlastic {
    type Memory = ();

    #[inline(always)]
    fn stress(&self, _: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        Lanes::splat(self.strength)
    }

    #[inline(always)]
    fn slope(&self, _: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        Lanes::default()
    }
}
