//! Flow stress: the yield strength and the effects that change it, composed at compile time.

use crate::lanes::Lanes;

/// Flow stress of a material point as a function of its accumulated equivalent plastic strain.
pub trait FlowStress: Copy + Send + Sync + 'static {
    /// Flow stress $\sigma_y(\varepsilon_p)$.
    fn stress(&self, strain: Lanes) -> Lanes;
    /// Hardening slope $d\sigma_y/d\varepsilon_p$.
    fn slope(&self, strain: Lanes) -> Lanes;
    /// Newton steps that solve the return exactly (1 where the flow stress is linear).
    const NEWTON_STEPS: usize;
}

/// Constant flow stress Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerfectlyPlastic {
    /// Yield strength Y.
    pub strength: f64,
}

impl FlowStress for PerfectlyPlastic {
    const NEWTON_STEPS: usize = 1;
    #[inline(always)]
    fn stress(&self, _: Lanes) -> Lanes {
        Lanes::splat(self.strength)
    }
    #[inline(always)]
    fn slope(&self, _: Lanes) -> Lanes {
        Lanes::default()
    }
}

/// Linear isotropic hardening, $\sigma_y = Y + H \varepsilon_p$ (the thesis' "bilinear" material).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearHardening {
    /// Initial yield strength Y.
    pub strength: f64,
    /// Hardening modulus H.
    pub modulus: f64,
}

impl FlowStress for LinearHardening {
    const NEWTON_STEPS: usize = 1;
    #[inline(always)]
    fn stress(&self, strain: Lanes) -> Lanes {
        Lanes::splat(self.strength) + strain * self.modulus
    }
    #[inline(always)]
    fn slope(&self, _: Lanes) -> Lanes {
        Lanes::splat(self.modulus)
    }
}
