//! EEPA: the Edinburgh elasto-plastic model without adhesion, as codes ship it.

use crate::contact::NormalLaw;

/// Power-law loading and a stiffer power-law branch in unloading.
///
/// $$ F = k_1 \delta^n, \qquad \text{unloading:}\quad F = \max\big(0,\quad k_2 (\delta^n - \delta_m^n) + k_1 \delta_m^n\big) $$
///
/// One body: $F/R^2 = \kappa_1 x^n$, $k_1 = \kappa_1 R^{2-n}$ on a wall. Both branches are powers of $\delta^n$, so e is the
/// same at every speed. Source: Morrissey 2013 (thesis, Edinburgh), eqs. for $k_{adh} = 0$, $f_0 = 0$, as in
/// `normal_model_edinburgh_stiffness.h` of LIGGGHTS 3.8 with `fixKc on`. That code takes the largest overlap back once the
/// force is zero, by the ratio of the linear springs: with $n < 1$ the force would come back and throw the body out faster,
/// so projections keep $n \ge 1$.
///
/// ```
/// use impactlaw::{contact::NormalLaw, export::native::eepa::Eepa};
/// let law = Eepa { loading: 1e6, ratio: 4.0, exponent: 1.0 };
/// let mut most = 0.0;
/// assert_eq!(law.force(0.02, &mut most), 2e4);
/// let half = law.force(0.0175, &mut most); // half the force after an eighth of the way
/// assert!((half / 1e4 - 1.0).abs() < 1e-12);
/// assert_eq!(law.force(0.015, &mut most), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eepa {
    /// $\kappa_1$, Pa.
    pub loading: f64,
    /// $k_2/k_1$.
    pub ratio: f64,
    /// $n$.
    pub exponent: f64,
}

impl NormalLaw for Eepa {
    /// Largest flattening so far.
    type History = f64;

    fn force(&self, x: f64, most: &mut f64) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        let load = x.powf(self.exponent);
        if x >= *most {
            *most = x;
            return self.loading * load;
        }
        let peak = most.powf(self.exponent);
        (self.loading * (self.ratio * (load - peak) + peak)).max(0.0)
    }

    fn stiffness(&self, x: f64, most: &f64) -> f64 {
        if self.force(x, &mut most.clone()) <= 0.0 {
            return 0.0;
        }
        let slope = self.loading * self.exponent * x.powf(self.exponent - 1.0);
        if x >= *most {
            slope
        } else {
            self.ratio * slope
        }
    }

    fn depth(&self, x: f64, most: &f64) -> f64 {
        if x >= *most {
            return x.max(0.0);
        }
        let peak = most.powf(self.exponent) * (1.0 - 1.0 / self.ratio);
        (x - peak.max(0.0).powf(1.0 / self.exponent)).max(0.0)
    }

    fn dissipated(&self, most: &f64) -> f64 {
        if self.ratio == 1.0 {
            return 0.0;
        }
        let n_1 = self.exponent + 1.0;
        self.loading * most.powf(n_1) / n_1 - self.elastic_energy(*most, most)
    }

    fn elastic_energy(&self, x: f64, most: &f64) -> f64 {
        let force = self.force(x, &mut most.clone());
        if force <= 0.0 {
            return 0.0;
        }
        // area under k_2 (s^n - s_0^n) from its zero s_0 to x
        let stiff = self.loading * self.ratio;
        let zero = (x.powf(self.exponent) - force / stiff).max(0.0);
        let end = zero.powf(1.0 / self.exponent);
        let n_1 = self.exponent + 1.0;
        stiff * ((x.powf(n_1) - end.powf(n_1)) / n_1 - zero * (x - end))
    }

    fn contact_radius(&self, _: f64, _: &f64) -> Option<f64> {
        None
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}
