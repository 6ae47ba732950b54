//! Johnson: fully plastic loading at a constant mean pressure and Hertzian unloading.

use super::envelope::{Envelope, Unloading};
use super::hertz::Hertz;
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use crate::material::Material;
use std::f64::consts::PI;

/// Mean contact pressure of full plasticity over the yield strength (Johnson 1985, section 6.3: about 3).
const PLASTIC_PRESSURE_RATIO: f64 = 3.0;

/// Fully plastic contact without pile-up.
///
/// $$ F = \pi a^2 p_d = 2 \pi R p_d \delta, \qquad a^2 = 2 R \delta, \qquad p_d = 3 Y $$
/// $$ \text{unloading:}\quad F = F_m \left(\frac{\delta - \delta_r}{\delta_e}\right)^{3/2}, \quad
///    \delta_e = \frac{3 F_m}{4 a_m E^\ast}, \quad \delta_r = \delta_m - \delta_e $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | $p_d$ | Pa | mean (dynamic) pressure of full plasticity |
/// | $\delta_e, \delta_r$ | m | elastic recovery and residual displacement |
///
/// Source: Johnson 1985, Contact Mechanics, sections 6.3 and 11.4-11.5. The book gives no force between first yield
/// and full plasticity. **Bridge of this implementation, not of the book:** the sphere stays Hertzian, with
/// reversible unloading, up to the flattening where Hertz meets the plastic line, $x_c = (3\pi p_d/2E^\ast)^2$, that
/// is 32 times the flattening of first yield. The force is continuous there; the unloading branch is not: e is 1 up
/// to about $75\ V_y$ and falls to 0.84 at once. Slower impacts are outside this theory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Johnson {
    elastic: Hertz,
    contact_modulus: f64,
    slope: f64,
    meeting: f64,
}

impl Johnson {
    /// Law of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let p_d = PLASTIC_PRESSURE_RATIO * material.flow?.yield_strength();
        let e_star = material.contact_modulus();
        Some(Self {
            elastic: Hertz::new(e_star),
            contact_modulus: e_star,
            slope: 2.0 * PI * p_d,
            meeting: (1.5 * PI * p_d / e_star).powi(2),
        })
    }
}

impl Published for Johnson {
    const NAME: &'static str = "johnson";
    const SUMMARY: &'static str = "fully plastic at 3 Y, elastic unloading";
    const PAPERS: &'static [&'static str] = &["Johnson1985"];
    const REFERENCE: &'static str = "Johnson 1985, sections 6.3 and 11.5, p = 3 Y; Hertzian until the plastic line is met (not in the book)";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = true;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = Some(restitution);
}

impl PublishedLaw for Johnson {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Self::of(material)
    }
}

impl Envelope for Johnson {
    fn loading(&self, x: f64) -> f64 {
        if x <= self.meeting {
            self.elastic.reduced_force(x)
        } else {
            self.slope * x
        }
    }

    fn loading_slope(&self, x: f64) -> f64 {
        if x <= self.meeting {
            self.elastic.slope(x)
        } else {
            self.slope
        }
    }

    fn loading_work(&self, x: f64) -> f64 {
        let elastic = x.min(self.meeting);
        0.4 * elastic * self.elastic.reduced_force(elastic)
            + 0.5 * self.slope * (x * x - elastic * elastic)
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        if x <= self.meeting {
            x.sqrt()
        } else {
            (2.0 * x).sqrt()
        }
    }

    fn unloading(&self, peak: f64, force: f64) -> Unloading {
        if peak <= self.meeting {
            return Unloading::hertzian(0.0);
        }
        let a = self.loading_contact_radius(peak);
        Unloading::hertzian(peak - 0.75 * force / (a * self.contact_modulus))
    }

    fn supported_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// Coefficient of restitution at speed `velocity` (m/s) as the book prints it:
///
/// $$ e = 3.8 \left(\frac{Y}{E^\ast}\right)^{1/2} \left(\frac{\tfrac12 m V^2}{Y R^3}\right)^{-1/8}
///      = 3.465 \left(\frac{\rho V^2}{Y}\right)^{-1/8} \left(\frac{Y}{E^\ast}\right)^{1/2} $$
///
/// Source: Johnson 1985, section 11.5. 3.8 is rounded up: the formulas above give 3.743, so this is 1.5 % higher
/// than the integrated law. `None` for an elastic body and below the speed where the formula exceeds 1 (about 28
/// $V_y$).
#[must_use]
pub fn restitution(material: &Material, velocity: f64) -> Option<f64> {
    let y = material.flow?.yield_strength();
    let damage_number = material.density * velocity * velocity / y;
    let prefactor = 3.8 * (2.0 * PI / 3.0).powf(-0.125);
    let e = prefactor * damage_number.powf(-0.125) * (y / material.contact_modulus()).sqrt();
    (e <= 1.0).then_some(e)
}
