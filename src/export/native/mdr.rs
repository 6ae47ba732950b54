//! MDR: the method of dimensionality reduction of Zunker and Kamrin for one contact, without adhesion and bulk response.

use crate::contact::NormalLaw;
use crate::material::stress::Moduli;
use crate::tape::keep_fields;
use std::f64::consts::PI;

/// Elastic-plastic sphere mapped on an elliptical indenter of height A and width B in a bed of springs.
///
/// $$ F = \frac{E^\ast A B}{4} \left[\arccos\left(1 - \frac{2\delta_e}{A}\right) - \left(2 - \frac{4\delta_e}{A}\right)
///    \sqrt{\frac{\delta_e}{A} - \frac{\delta_e^2}{A^2}}\right], \qquad
///    p_Y = Y \left(1 + 1.75\ e^{-4.4\ \delta_m/R}\right) $$
///
/// Elastic: $A = 4R$, $B = 2R$, $\delta_e = \delta$. From where Hertz's mean pressure exceeds $p_Y$: $A = 4 p_Y a_m/E^\ast$,
/// $B = 2 a_m$, $\delta_e = (\delta - \delta_m + A/2 + \delta_R)/(1 + 2\delta_R/A)$ with the contact radius $a_m$ at the
/// largest flattening and the correction $\delta_R$ of the displaced free surface.
///
/// Source: Zunker and Kamrin 2024, J. Mech. Phys. Solids 183:105492, as written in `gran_sub_mod_normal.cpp` of LAMMPS. Left
/// out: adhesion, the bulk response of confined particles, and the growth of the particle's radius as it flattens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mdr {
    young_modulus: f64,
    poisson_ratio: f64,
    yield_strength: f64,
    /// Flattening at yield over R.
    yields: f64,
}

/// Fixed-point steps to the flattening at yield; each gains two digits and more.
const YIELD_STEPS: usize = 40;

/// Halvings to the flattening at which contact is lost.
const HALVINGS: usize = 60;

/// What an MDR contact remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Indent {
    /// Largest flattening over R.
    most: f64,
    /// Flattening at yield over R; 0: not yet.
    yielded: f64,
}

keep_fields!(Indent: most, yielded);

impl Mdr {
    /// Law from Young's modulus (Pa), Poisson's ratio and yield strength (Pa).
    #[must_use]
    pub fn new(young_modulus: f64, poisson_ratio: f64, yield_strength: f64) -> Self {
        let mut law = Mdr {
            young_modulus,
            poisson_ratio,
            yield_strength,
            yields: 0.0,
        };
        // Hertz's mean pressure reaches that at yield: sqrt(x) = 3 pi p_Y(x)/(4 E*)
        let root = |x: f64| 0.75 * PI * law.pressure_at_yield(x) / law.modulus();
        law.yields = (0..YIELD_STEPS).fold(0.0, |x, _| root(x).powi(2));
        law
    }

    fn modulus(&self) -> f64 {
        self.young_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }

    /// Force over $R^2$ of an indenter of height `a` and width `b` (over R) at depth `depth`.
    fn indenter(&self, depth: f64, a: f64, b: f64) -> f64 {
        let s = (depth / a).clamp(0.0, 1.0);
        let shape = (1.0 - 2.0 * s).acos() - (2.0 - 4.0 * s) * (s - s * s).sqrt();
        0.25 * self.modulus() * a * b * shape
    }

    fn pressure_at_yield(&self, most: f64) -> f64 {
        self.yield_strength * (1.75 * (-4.4 * most).exp() + 1.0)
    }

    fn at(&self, x: f64, indent: &Indent) -> f64 {
        if indent.yielded == 0.0 {
            return self.indenter(x, 4.0, 2.0);
        }
        let most = indent.most;
        // contact area 2 delta R - delta^2 past yield, continuous with Hertz's delta R at it
        let intercept = indent.yielded * indent.yielded - indent.yielded;
        let radius = (2.0 * most - most * most + intercept).max(0.0).sqrt();
        let (a, b) = (
            4.0 * self.pressure_at_yield(most) / self.modulus() * radius,
            2.0 * radius,
        );
        let half = 0.5 * a;
        let full = 0.25 * self.modulus() * a * b * (1.0 - 2.0 * half / a).acos();
        let shear = Moduli::new(self.young_modulus, self.poisson_ratio).shear;
        let depth = 1.0 - (most - half);
        let slant = (radius * radius + depth * depth).sqrt();
        let nu = self.poisson_ratio;
        let correction = (2.0 * radius * radius * (nu - 1.0)
            - (2.0 * nu - 1.0) * depth * (slant - depth))
            * full
            / (2.0 * PI * radius * radius * shear * slant);
        let elastic = (x - most + half + correction) / (1.0 + correction / half);
        if elastic <= 0.0 {
            return 0.0;
        }
        self.indenter(elastic, a, b)
    }
}

/// Area under a force up to `x`, by the trapezoidal rule.
fn area(x: f64, force: impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 400;
    let width = x.max(0.0) / f64::from(PANELS);
    let at = |k: u32| force(width * f64::from(k));
    let inner: f64 = (1..PANELS).map(at).sum();
    width * (inner + 0.5 * (at(0) + at(PANELS)))
}

impl NormalLaw for Mdr {
    type History = Indent;

    fn force(&self, x: f64, indent: &mut Indent) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        if x > indent.most {
            indent.most = x;
            if x > self.yields {
                indent.yielded = self.yields;
            }
        }
        self.at(x, indent)
    }

    /// By a difference quotient; impacts do not need it.
    fn stiffness(&self, x: f64, indent: &Indent) -> f64 {
        let step = 1e-6 * x.abs();
        if step == 0.0 {
            return 0.0;
        }
        let loads = x >= indent.most;
        let (from, to) = if loads { (x, x + step) } else { (x - step, x) };
        (self.force(to, &mut indent.clone()) - self.force(from, &mut indent.clone())) / step
    }

    /// By bisection for where the force is lost.
    fn depth(&self, x: f64, indent: &Indent) -> f64 {
        let (mut lost, mut held) = (0.0, x.max(0.0));
        if x >= indent.most {
            return held;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (lost + held);
            if self.at(middle, indent) > 0.0 {
                held = middle;
            } else {
                lost = middle;
            }
        }
        x.max(0.0) - lost
    }

    fn elastic_energy(&self, x: f64, indent: &Indent) -> f64 {
        area(x, |x| self.at(x, indent))
    }

    fn dissipated(&self, indent: &Indent) -> f64 {
        if indent.yielded == 0.0 {
            return 0.0;
        }
        let loading = area(indent.most, |x| self.force(x, &mut Indent::default()));
        loading - self.elastic_energy(indent.most, indent)
    }

    fn contact_radius(&self, _: f64, _: &Indent) -> Option<f64> {
        None
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}
