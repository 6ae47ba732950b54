//! Thornton: Hertz with the contact pressure cut off at a limit, and a flatter Hertzian unloading.

use super::envelope::{Envelope, Unloading};
use super::hertz::Hertz;
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use crate::material::{Material, YIELD_PRESSURE_RATIO};
use std::f64::consts::PI;

/// Limiting pressure of [`AtHardness`] over the yield strength: Tabor's hardness.
const HARDNESS_RATIO: f64 = 2.8;

/// Elastic-perfectly plastic contact with the Hertz pressure truncated at $p_y$.
///
/// $$ F = \tfrac43 E^\ast \sqrt{R}\ \delta^{3/2} \ (\delta \le \delta_y), \qquad
///    F = F_y + \pi p_y R (\delta - \delta_y), \qquad a^2 = R \delta $$
/// $$ \text{unloading:}\quad F = \tfrac43 E^\ast \sqrt{R_p} (\delta - \delta_p)^{3/2}, \quad
///    \frac{R_p}{R} = \frac{\tfrac43 E^\ast \sqrt{R}\ \delta_m^{3/2}}{F_m}, \quad \delta_p = \delta_m - \frac{R
///   \delta_m}{R_p} $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | $p_y$ | Pa | limiting contact pressure, the **peak** pressure of Hertz at yield |
/// | $\delta_y, F_y$ | m, N | $\left(\pi p_y / 2E^\ast\right)^2 R$ and the force of Hertz there |
/// | $R_p$ | m | radius of the plastically flattened sphere |
/// | $\delta_m, F_m$ | m, N | largest displacement and its force |
///
/// The paper writes $R_p = \frac{4E^\ast}{3F_m}\left[\frac{2F_m + F_y}{2\pi p_y}\right]^{3/2}$; on its loading line
/// the bracket is $R \delta_m$ (checked algebraically). Source: Thornton 1997, J. Appl. Mech. 64, 383; Thornton and
/// Ning 1998, Powder Technol. 99, 154, without adhesion. Valid for a small contact. The plastic slope is half that
/// of full plasticity, so one $p_y$ cannot fit both first yield ($1.6\ Y$) and the force of large flattening
/// ($2.8\ Y$): both are offered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thornton {
    elastic: Hertz,
    yield_flattening: f64,
    yield_force: f64,
    slope: f64,
}

impl Thornton {
    /// Law with $p_y$ = `pressure_ratio` times the yield strength; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material, pressure_ratio: f64) -> Option<Self> {
        let point = material.yield_point(1.0, pressure_ratio)?;
        let p_y = pressure_ratio * material.flow?.yield_strength();
        Some(Self {
            elastic: Hertz::of(material),
            yield_flattening: point.displacement,
            yield_force: point.force,
            slope: PI * p_y,
        })
    }
}

/// [`Thornton`] with the pressure limited at first yield, 1.6 Y.
#[derive(Debug, Clone, Copy)]
pub struct AtFirstYield;

impl Published for AtFirstYield {
    const NAME: &'static str = "thornton";
    const SUMMARY: &'static str = "pressure limited at first yield, 1.6 Y";
    const PAPERS: &'static [&'static str] = &["Thornton1997"];
    const REFERENCE: &'static str =
        "Thornton 1997, J. Appl. Mech. 64, 383, pressure limited at first yield, 1.6 Y";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = true;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> =
        Some(|material, velocity| restitution(material, YIELD_PRESSURE_RATIO, velocity));
}

impl PublishedLaw for AtFirstYield {
    type Law = Thornton;

    fn law(material: &Material) -> Option<Thornton> {
        Thornton::of(material, YIELD_PRESSURE_RATIO)
    }
}

/// [`Thornton`] with the pressure limited at the hardness, 2.8 Y.
#[derive(Debug, Clone, Copy)]
pub struct AtHardness;

impl Published for AtHardness {
    const NAME: &'static str = "thornton-hardness";
    const SUMMARY: &'static str = "pressure limited at the hardness, 2.8 Y";
    const PAPERS: &'static [&'static str] = &["Thornton1997"];
    const REFERENCE: &'static str =
        "Thornton 1997, J. Appl. Mech. 64, 383, pressure limited at the hardness, 2.8 Y";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = true;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> =
        Some(|material, velocity| restitution(material, HARDNESS_RATIO, velocity));
}

impl PublishedLaw for AtHardness {
    type Law = Thornton;

    fn law(material: &Material) -> Option<Thornton> {
        Thornton::of(material, HARDNESS_RATIO)
    }
}

impl Envelope for Thornton {
    fn loading(&self, x: f64) -> f64 {
        if x <= self.yield_flattening {
            self.elastic.reduced_force(x)
        } else {
            self.yield_force + self.slope * (x - self.yield_flattening)
        }
    }

    fn loading_slope(&self, x: f64) -> f64 {
        if x <= self.yield_flattening {
            self.elastic.slope(x)
        } else {
            self.slope
        }
    }

    fn loading_work(&self, x: f64) -> f64 {
        let elastic = x.min(self.yield_flattening);
        let past = x - elastic;
        0.4 * elastic * self.elastic.reduced_force(elastic)
            + past * (self.yield_force + 0.5 * self.slope * past)
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        x.sqrt()
    }

    fn unloading(&self, peak: f64, force: f64) -> Unloading {
        if peak <= self.yield_flattening {
            return Unloading::hertzian(0.0);
        }
        Unloading::hertzian(peak * (1.0 - force / self.elastic.reduced_force(peak)))
    }

    fn supported_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// Coefficient of restitution at speed `velocity` (m/s), with $r = V_y/V \le 1$:
///
/// $$ e = \sqrt{\tfrac{6\sqrt3}{5}} \left[1 - \tfrac16 r^2\right]^{1/2}
///    \left[\frac{r}{r + 2\sqrt{\tfrac65 - \tfrac15 r^2}}\right]^{1/4} $$
///
/// Source: Thornton 1997. Exact for the law above; for fast impacts $e \to 1.185\ r^{1/4}$. `None` for an elastic
/// body.
///
/// ```
/// # use impactlaw::material::{Flow, Material};
/// # let ball = Material { density: 8e3, young_modulus: 1e11, poisson_ratio: 0.35,
/// #     flow: Some(Flow::perfectly_plastic(1.25e9)) };
/// let e = impactlaw::theory::thornton::restitution(&ball, 1.6, 10.0).unwrap();
/// assert!((e - 0.465).abs() < 5e-4);
/// ```
#[must_use]
pub fn restitution(material: &Material, pressure_ratio: f64, velocity: f64) -> Option<f64> {
    let r = material.yield_point(1.0, pressure_ratio)?.velocity / velocity;
    if r >= 1.0 {
        return Some(1.0);
    }
    let spring = (r / (r + 2.0 * (1.2 - 0.2 * r * r).sqrt())).powf(0.25);
    Some((1.2 * 3.0_f64.sqrt() * (1.0 - r * r / 6.0)).sqrt() * spring)
}
