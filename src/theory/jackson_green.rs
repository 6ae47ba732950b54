//! Jackson and Green: finite-element fit with a hardness that falls as the contact grows, unloading of Jackson,
//! Green and Marghitu.

use super::envelope::{Envelope, Unloading};
use super::hertz::Hertz;
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use crate::contact::loading::work_between;
use crate::material::Material;

/// $w$ up to which the sphere is Hertzian.
pub(super) const ELASTIC_TO: f64 = 1.9;
/// Limit of the hardness over the yield strength for a small contact.
const HARDNESS_RATIO: f64 = 2.84;
/// Largest a/R of the finite-element runs.
const LARGEST_CONTACT_RADIUS: f64 = 0.41;
/// Largest share of the flattening that stays. The published form passes one near $w = 10^4$ (E/Y 600 at a/R = 0.4), where a
/// sphere would come back deeper than it was pressed.
const LARGEST_RESIDUE: f64 = 0.999;
/// Speed over critical speed up to which the restitution formula was fitted.
const FASTEST: f64 = 1000.0;

/// Elastic-perfectly plastic sphere flattened by a rigid plane, fitted to finite elements.
///
/// With $C = 1.295\ e^{0.736\nu}$, $w = \delta/\delta_c$, $\delta_c = (\pi C Y/2E^\ast)^2 R$, $P_c$ the force of Hertz
/// at $\delta_c$ and $B = 0.14\ e^{23 Y/E^\ast}$:
///
/// $$ w \le 1.9: \quad F = P_c w^{3/2}, \quad a^2 = R\delta $$
/// $$ w > 1.9: \quad \frac{F}{P_c} = e^{-\frac14 w^{5/12}} w^{3/2} + \frac{4 H_G}{C Y}\left[1 - e^{-\frac1{25} w^{5/9}}\right] w, \quad
///    \frac{H_G}{Y} = 2.84\left[1 - e^{-0.82 (a/R)^{-0.7}}\right], \quad a^2 = R\delta
///    \left(\frac{w}{1.9}\right)^B $$
/// $$ \text{unloading:}\quad F = F_m \left(\frac{\delta - \delta_r}{\delta_m - \delta_r}\right)^{3/2}, \quad
///    \frac{\delta_r}{\delta_m} = 1.02\left[1 - \left(\frac{w_m + 5.9}{6.9}\right)^{-0.54}\right] $$
///
/// Source: Jackson and Green 2005, J. Tribol. 127, 343; unloading Jackson, Green and Marghitu 2010, Nonlinear Dyn. 60, 217
/// (constants seen in independent codes). Basis: $\nu = 0.32$, $Y/E^\ast$ up to about 0.0073, a/R up to about 0.41
/// (unverified). Along unloading the contact area is scaled linearly from that at the peak, which the sources leave
/// open.
///
/// The two loading branches do not meet exactly: at $w = 1.9$ the force jumps by +2.6 % ($\nu = 0.2$) to -1.5 %
/// ($\nu = 0.4$). Hertz holds at 1.9 itself. Between $w = 1$ and 1.9 loading is Hertzian and unloading already
/// leaves a residual displacement, as published. From $w \approx 10^4$ on the published residual displacement would exceed
/// the largest one; it is held at 0.999 of it there, so that the law stays usable, and its restitution means nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JacksonGreen {
    elastic: Hertz,
    yield_factor: f64,
    growth: f64,
    critical_flattening: f64,
    critical_force: f64,
}

/// Ratio C of the peak pressure at first yield to the yield strength.
pub(super) fn yield_factor(material: &Material) -> f64 {
    1.295 * (0.736 * material.poisson_ratio).exp()
}

/// Exponent B by which the contact of a yielded body grows faster than the elastic one.
pub(super) fn growth(material: &Material, yield_strength: f64) -> f64 {
    0.14 * (23.0 * yield_strength / material.contact_modulus()).exp()
}

/// Force over $P_c$ and its derivative at `w`, from the hardness factor $4 H/(C Y)$ there and its derivative.
pub(super) fn elastic_plastic(w: f64, [hardness, rate]: [f64; 2]) -> [f64; 2] {
    let elastic = (-0.25 * w.powf(5.0 / 12.0)).exp();
    let plastic = -(-w.powf(5.0 / 9.0) / 25.0).exp_m1();
    let plastic_rate = (1.0 - plastic) * 5.0 / 225.0 * w.powf(-4.0 / 9.0);
    [
        elastic * w * w.sqrt() + hardness * plastic * w,
        elastic * w.sqrt() * (1.5 - 5.0 / 48.0 * w.powf(5.0 / 12.0))
            + rate * plastic * w
            + hardness * plastic_rate * w
            + hardness * plastic,
    ]
}

impl JacksonGreen {
    /// Law of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let c = yield_factor(material);
        let y = material.flow?.yield_strength();
        let point = material.yield_point(1.0, c)?;
        Some(Self {
            elastic: Hertz::of(material),
            yield_factor: c,
            growth: growth(material, y),
            critical_flattening: point.displacement,
            critical_force: point.force,
        })
    }

    /// Hardness factor $4 H_G/(C Y)$ and its derivative in w.
    fn hardness(&self, x: f64) -> [f64; 2] {
        let w = x / self.critical_flattening;
        let a = self.loading_contact_radius(x);
        let softening = (-0.82 * a.powf(-0.7)).exp();
        let scale = 4.0 * HARDNESS_RATIO / self.yield_factor;
        let a_rate = a * (1.0 + self.growth) / (2.0 * w);
        [
            scale * (1.0 - softening),
            -scale * softening * 0.82 * 0.7 * a.powf(-1.7) * a_rate,
        ]
    }
}

impl Published for JacksonGreen {
    const NAME: &'static str = "jackson-green";
    const SUMMARY: &'static str = "finite-element fit; unloading of Jackson, Green and Marghitu";
    const PAPERS: &'static [&'static str] = &["JacksonGreen2005", "JacksonGreenMarghitu2010"];
    const REFERENCE: &'static str = "Jackson and Green 2005, J. Tribol. 127, 343; unloading Jackson, Green and Marghitu 2010, Nonlinear Dyn. 60, 217";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = Some(restitution);
}

impl PublishedLaw for JacksonGreen {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Self::of(material)
    }
}

impl Envelope for JacksonGreen {
    fn loading(&self, x: f64) -> f64 {
        if x <= ELASTIC_TO * self.critical_flattening {
            return self.elastic.reduced_force(x);
        }
        self.critical_force * elastic_plastic(x / self.critical_flattening, self.hardness(x))[0]
    }

    fn loading_slope(&self, x: f64) -> f64 {
        if x <= ELASTIC_TO * self.critical_flattening {
            return self.elastic.slope(x);
        }
        let [_, slope] = elastic_plastic(x / self.critical_flattening, self.hardness(x));
        self.critical_force / self.critical_flattening * slope
    }

    fn loading_work(&self, x: f64) -> f64 {
        let hertz_to = ELASTIC_TO * self.critical_flattening;
        let elastic = 0.4 * x.min(hertz_to) * self.elastic.reduced_force(x.min(hertz_to));
        elastic + work_between(hertz_to, x, |x| self.loading(x))
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        let w = x / self.critical_flattening;
        if w <= ELASTIC_TO {
            x.sqrt()
        } else {
            x.sqrt() * (w / ELASTIC_TO).powf(0.5 * self.growth)
        }
    }

    fn unloading(&self, peak: f64, _: f64) -> Unloading {
        let w = peak / self.critical_flattening;
        if w <= 1.0 {
            return Unloading::hertzian(0.0);
        }
        let residue = 1.02 * (1.0 - ((w + 5.9) / 6.9).powf(-0.54));
        Unloading::hertzian(peak * residue.min(LARGEST_RESIDUE))
    }

    fn supported_to(&self) -> f64 {
        let edge = (ELASTIC_TO * self.critical_flattening).powf(self.growth);
        (LARGEST_CONTACT_RADIUS.powi(2) * edge).powf(1.0 / (1.0 + self.growth))
    }
}

/// Coefficient of restitution at speed `velocity` (m/s), with $v = V/V_c$ and $V_c$ the speed that just reaches
/// $\delta_c$:
///
/// $$ e = 1 \ (v \le 1), \quad e = 1 - 0.1 \ln v \left(\frac{v-1}{59}\right)^{0.156} \ (v \le 60), \quad
///    e = 1 - 0.1 \ln 60 - 0.11 \ln\frac{v}{60} (v - 60)^{2.36\ Y/E^\ast} \ (v < 1000) $$
///
/// Source: Jackson, Green and Marghitu 2010; within 2.2 % of the integrated law. `None` for an elastic body and
/// from $v = 1000$ on, where the authors stop.
#[must_use]
pub fn restitution(material: &Material, velocity: f64) -> Option<f64> {
    let point = material.yield_point(1.0, yield_factor(material))?;
    let e_y = material.flow?.yield_strength() / material.contact_modulus();
    let v = velocity / point.velocity;
    if v <= 1.0 {
        Some(1.0)
    } else if v <= 60.0 {
        Some(1.0 - 0.1 * v.ln() * ((v - 1.0) / 59.0).powf(0.156))
    } else if v < FASTEST {
        let late = 0.11 * (v / 60.0).ln() * (v - 60.0).powf(2.36 * e_y);
        Some(1.0 - 0.1 * 60.0_f64.ln() - late)
    } else {
        None
    }
}
