//! Thornton and Ning: Hertz up to a yield radius, a straight line beyond, as LIGGGHTS ships it, without adhesion.

use crate::contact::NormalLaw;

/// Elastic-plastic sphere with a limited pressure, with the unloading of the code.
///
/// $$ \varphi = \tfrac43 E^\ast x^{3/2} \ (x \le c^2), \quad \varphi = \varphi_y + 2 E^\ast c\ (x - c^2) \ (x > c^2), \qquad
///    \text{unloading:}\quad \varphi = \varphi_m - \tfrac43 E^\ast (x_m^{3/2} - x^{3/2}) $$
///
/// $c$ is `coefficientYieldRatio`, the contact radius at yield over R. The paper (Thornton and Ning 1998, Powder Technol.
/// 99:154) unloads with an enlarged radius $R_p$; `normal_model_thornton_ning.h` of LIGGGHTS 3.8 does so with surface
/// energy only: without, its unloading is Hertz's curve of the undeformed sphere, shifted, and that is what is here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThorntonNing {
    /// $E^\ast$, Pa.
    pub modulus: f64,
    /// $c$.
    pub yield_ratio: f64,
}

impl ThorntonNing {
    fn hertz(&self, x: f64) -> f64 {
        4.0 / 3.0 * self.modulus * x * x.sqrt()
    }

    fn loading(&self, x: f64) -> f64 {
        let yields = self.yield_ratio * self.yield_ratio;
        if x <= yields {
            return self.hertz(x);
        }
        self.hertz(yields) + 2.0 * self.modulus * self.yield_ratio * (x - yields)
    }
}

impl NormalLaw for ThorntonNing {
    /// Largest flattening so far.
    type History = f64;

    fn force(&self, x: f64, most: &mut f64) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        if x >= *most {
            *most = x;
            return self.loading(x);
        }
        (self.loading(*most) - self.hertz(*most) + self.hertz(x)).max(0.0)
    }

    fn stiffness(&self, x: f64, most: &f64) -> f64 {
        if self.force(x, &mut most.clone()) <= 0.0 {
            return 0.0;
        }
        let root = x.sqrt();
        let loads = x >= *most;
        2.0 * self.modulus
            * match loads {
                true => root.min(self.yield_ratio),
                false => root,
            }
    }

    fn depth(&self, x: f64, most: &f64) -> f64 {
        if x >= *most {
            return x.max(0.0);
        }
        let lost = (self.hertz(*most) - self.loading(*most)).max(0.0);
        let end = (lost / (4.0 / 3.0 * self.modulus)).powf(2.0 / 3.0);
        (x - end).max(0.0)
    }

    fn dissipated(&self, most: &f64) -> f64 {
        let yields = self.yield_ratio * self.yield_ratio;
        if *most <= yields {
            return 0.0;
        }
        let past = most - yields;
        let loading = 0.4 * self.hertz(yields) * yields
            + past * (self.hertz(yields) + self.modulus * self.yield_ratio * past);
        loading - self.elastic_energy(*most, most)
    }

    fn elastic_energy(&self, x: f64, most: &f64) -> f64 {
        let force = self.force(x, &mut most.clone());
        if force <= 0.0 {
            return 0.0;
        }
        let zero = (self.hertz(x) - force).max(0.0);
        let end = (zero / (4.0 / 3.0 * self.modulus)).powf(2.0 / 3.0);
        0.4 * (self.hertz(x) * x - self.hertz(end) * end) - zero * (x - end)
    }

    fn contact_radius(&self, _: f64, _: &f64) -> Option<f64> {
        None
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}
