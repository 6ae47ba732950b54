//! Saturating hardening of Voce (1948): $\sigma_y = Y + Q (1 - e^{-b \varepsilon_p})$.

use super::{FlowStress, YIELD_STRENGTH, flow_stress};
use crate::lanes::Lanes;
use crate::material::constant::{Absent, Constant, Dimension, Range};

/// Stress Q that hardening adds in the end.
pub const SATURATION_STRESS: Constant = Constant {
    key: "saturation_stress",
    symbol: "Q",
    effect: "hardening",
    dimension: Dimension::Stress,
    range: Range::NotNegative,
    absent: Absent::Other,
    meaning: "Q of the flow stress Y + Q (1 - exp(-b ε_p)); needs a yield strength and a saturation exponent",
    example: "'120 MPa'",
    otherwise: "none: no saturating hardening",
};

/// Exponent b: strain over which hardening saturates is 1/b.
pub const SATURATION_EXPONENT: Constant = Constant {
    key: "saturation_exponent",
    symbol: "b",
    effect: "hardening",
    dimension: Dimension::Number,
    range: Range::Positive,
    absent: Absent::Other,
    meaning: "b of the flow stress Y + Q (1 - exp(-b ε_p)): strain of saturation is 1/b",
    example: "15",
    otherwise: "none: no saturating hardening",
};

flow_stress! {
    /// Saturating hardening, $\sigma_y = Y + Q (1 - e^{-b \varepsilon_p})$.
    VoceHardening, "saturating hardening (Voce)" {
        /// Initial yield strength Y.
        strength: YIELD_STRENGTH,
        /// Saturation stress Q.
        saturation: SATURATION_STRESS,
        /// Exponent b.
        exponent: SATURATION_EXPONENT,
    }
}

impl FlowStress for VoceHardening {
    type Memory = ();
    // the condition of the return is convex: the method comes up to its root from below and squares the rest once a step is short
    // against 1/b; where hardening is far stiffer than the body it takes about one step for each 1/b of strain before that
    const NEWTON_STEPS: usize = 40;

    #[inline(always)]
    fn stress(&self, strain: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        let grown = strain.map(|strain| -(-self.exponent * strain).exp_m1());
        grown * self.saturation + Lanes::splat(self.strength)
    }

    #[inline(always)]
    fn slope(&self, strain: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        let first = self.saturation * self.exponent;
        strain.map(|strain| first * (-self.exponent * strain).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::flow::{LinearHardening, ROOT};

    const STIFFNESS: f64 = 0.7;

    #[test]
    fn returns_end_on_the_yield_surface() {
        for (saturation, exponent) in [(1e-4, 1.0), (1e-3, 15.0), (1e-2, 200.0), (0.5, 30.0)] {
            let flow = VoceHardening {
                strength: 1e-3,
                saturation,
                exponent,
            };
            for strain in [0.0, 1e-6, 1e-3, 0.1, 3.0] {
                let at = Lanes::splat(strain);
                let radius = flow.stress(at, at, 0.0, &()) * ROOT;
                for beyond in [1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0] {
                    let norm = radius * (1.0 + beyond);
                    let stiffness = Lanes::splat(STIFFNESS);
                    let length = flow.length_of_return(norm, stiffness, at, 0.0, &());
                    let end = flow.stress(at + length * ROOT, at, 0.0, &());
                    let left = (norm - stiffness * length - end * ROOT).min() / norm.min();
                    assert!(left.abs() < 1e-13, "{flow:?} {strain} {beyond}: {left}");
                }
                let inside = radius * 0.999;
                let none = flow.length_of_return(inside, Lanes::splat(STIFFNESS), at, 0.0, &());
                assert_eq!(none, Lanes::default());
            }
        }
    }

    #[test]
    fn far_from_saturation_it_is_linear_hardening() {
        let (strength, modulus) = (2e-3, 0.05);
        let flow = VoceHardening {
            strength,
            saturation: modulus * 1e9,
            exponent: 1e-9,
        };
        let linear = LinearHardening { strength, modulus };
        let (norm, stiffness) = (Lanes::splat(0.01), Lanes::splat(STIFFNESS));
        let strain = Lanes::new([0.0, 0.001, 0.01, 0.05]);
        let a = flow.length_of_return(norm, stiffness, strain, 0.0, &());
        let b = linear.length_of_return(norm, stiffness, strain, 0.0, &());
        for (a, b) in a.array().into_iter().zip(b.array()) {
            assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
        }
    }
}
