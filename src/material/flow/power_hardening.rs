//! Power-law hardening of Ludwik (1909), the strain part of Johnson and Cook's law (1983): $\sigma_y = Y + B \varepsilon_p^n$.
//!
//! Its slope is infinite at the first plastic strain, where Newton's method in the strain stands still. In $s =
//! \varepsilon_p^n$ the condition of the return,
//!
//! $$ |s_{dev}| - \tfrac{k}{r} (s^{1/n} - \varepsilon_0) - r (Y + B s) = 0, \qquad r = \sqrt{2/3}, $$
//!
//! falls and is concave for $n \le 1$: from above its root the method comes down to it and cannot overshoot.

use super::{FlowStress, ROOT, YIELD_STRENGTH, flow_stress};
use crate::lanes::Lanes;
use crate::material::constant::{Absent, Constant, Dimension, Range};

/// Coefficient B of power-law hardening.
pub const HARDENING_COEFFICIENT: Constant = Constant {
    key: "hardening_coefficient",
    symbol: "B",
    effect: "hardening",
    dimension: Dimension::Stress,
    range: Range::NotNegative,
    absent: Absent::Other,
    meaning: "B of the flow stress Y + B ε_p^n; needs a yield strength and an exponent",
    example: "'292 MPa'",
    otherwise: "none: no power-law hardening",
};

/// Exponent n of power-law hardening.
pub const HARDENING_EXPONENT: Constant = Constant {
    key: "hardening_exponent",
    symbol: "n",
    effect: "hardening",
    dimension: Dimension::Number,
    range: Range::UpToOne,
    absent: Absent::Other,
    meaning: "n of the flow stress Y + B ε_p^n",
    example: "0.31",
    otherwise: "none: no power-law hardening",
};

flow_stress! {
    /// Power-law hardening, $\sigma_y = Y + B \varepsilon_p^n$.
    PowerHardening, "power-law hardening" {
        /// Initial yield strength Y.
        strength: YIELD_STRENGTH,
        /// Coefficient B.
        coefficient: HARDENING_COEFFICIENT,
        /// Exponent n.
        exponent: HARDENING_EXPONENT,
    }
}

/// $Y + B \varepsilon^n$ and its slope.
#[inline(always)]
pub(super) fn power(strength: f64, coefficient: f64, exponent: f64, strain: f64) -> [f64; 2] {
    let strain = strain.max(0.0);
    let rise = coefficient * strain.powf(exponent);
    let slope = match rise > 0.0 {
        true => exponent * rise / strain,
        // at no strain it is infinite, without a coefficient none
        false if coefficient > 0.0 => f64::INFINITY,
        false => 0.0,
    };
    [strength + rise, slope]
}

/// Newton steps of a return. The start is within a factor of two of the root (two branches of which the larger one counts), and
/// each step squares what is left of the distance: with n from 0.05 to 1 the sixth changes nothing any more.
const STEPS: usize = 6;

impl PowerHardening {
    /// Length of the return of one point.
    fn length(&self, norm: f64, stiffness: f64, strain: f64) -> f64 {
        let &PowerHardening {
            strength,
            coefficient,
            exponent,
        } = self;
        let above = norm - ROOT * strength;
        if above <= ROOT * coefficient * strain.powf(exponent) {
            return 0.0;
        }
        // what the return would be without hardening, and the hardening that would stop it without a return
        let free = strain + ROOT * above / stiffness;
        let most = above / (ROOT * coefficient);
        let mut s = free.powf(exponent).min(most);
        let inverse = exponent.recip();
        for _ in 0..STEPS {
            let end = s.powf(inverse);
            let misfit = above - stiffness / ROOT * (end - strain) - ROOT * coefficient * s;
            let slope = stiffness / ROOT * inverse * end / s + ROOT * coefficient;
            s += misfit / slope;
        }
        ((s.powf(inverse) - strain) / ROOT).max(0.0)
    }
}

impl FlowStress for PowerHardening {
    type Memory = ();
    const COST: f64 = 5.0;

    #[inline(always)]
    fn stress(&self, strain: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        let hardening = strain.map(|strain| self.coefficient * strain.max(0.0).powf(self.exponent));
        hardening + Lanes::splat(self.strength)
    }

    #[inline(always)]
    fn slope(&self, strain: Lanes, _: Lanes, _: f64, (): &()) -> Lanes {
        let power = self.exponent - 1.0;
        strain.map(|strain| self.coefficient * self.exponent * strain.powf(power))
    }

    #[inline(always)]
    fn length_of_return(
        &self,
        norm: Lanes,
        stiffness: Lanes,
        strain: Lanes,
        _: f64,
        (): &(),
    ) -> Lanes {
        let (norm, stiffness, strain) = (norm.array(), stiffness.array(), strain.array());
        Lanes::each(|k| self.length(norm[k], stiffness[k], strain[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::flow::LinearHardening;

    const STIFFNESS: f64 = 0.7;

    /// What is left of the condition of the return, of the size of the deviator.
    fn misfit(flow: &PowerHardening, norm: f64, strain: f64) -> f64 {
        let length = flow.length(norm, STIFFNESS, strain);
        let end = Lanes::splat(strain + ROOT * length);
        let stress = flow.stress(end, Lanes::default(), 0.0, &()).min();
        (norm - STIFFNESS * length - ROOT * stress) / norm
    }

    #[test]
    fn returns_end_on_the_yield_surface_from_the_first_strain_to_large_ones() {
        for exponent in [0.05, 0.1, 0.2, 0.31, 0.5, 0.8, 1.0] {
            for coefficient in [1e-6, 1e-4, 1e-3, 1e-2, 0.1] {
                let flow = PowerHardening {
                    strength: 1e-3,
                    coefficient,
                    exponent,
                };
                for strain in [0.0, 1e-12, 1e-8, 1e-5, 1e-3, 0.1, 2.0, 20.0] {
                    let radius = ROOT * (1e-3 + coefficient * f64::powf(strain, exponent));
                    for beyond in [1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0] {
                        let norm = radius * (1.0 + beyond);
                        let left = misfit(&flow, norm, strain);
                        // strain is a power 1/n of what is solved for, and known to its rounding times that
                        let end = strain + norm / STIFFNESS;
                        let rounding = 4.0 * f64::EPSILON * STIFFNESS * end / (exponent * norm);
                        let within = 1e-12 + rounding;
                        assert!(left.abs() < within, "{flow:?} {strain} {beyond}: {left}");
                    }
                    assert_eq!(flow.length(0.999 * radius, STIFFNESS, strain), 0.0);
                }
            }
        }
    }

    #[test]
    fn an_exponent_of_one_is_linear_hardening() {
        let power = PowerHardening {
            strength: 2e-3,
            coefficient: 0.05,
            exponent: 1.0,
        };
        let linear = LinearHardening {
            strength: 2e-3,
            modulus: 0.05,
        };
        let (norm, stiffness) = (Lanes::splat(0.01), Lanes::splat(STIFFNESS));
        let strain = Lanes::new([0.0, 0.001, 0.01, 0.1]);
        let a = power.length_of_return(norm, stiffness, strain, 0.0, &());
        let b = linear.length_of_return(norm, stiffness, strain, 0.0, &());
        for (a, b) in a.array().into_iter().zip(b.array()) {
            assert!((a - b.max(0.0)).abs() < 1e-15, "{a} {b}");
        }
    }
}
