//! Stronge: a sphere whose mean contact pressure grows with the logarithm of the flattening up to full plasticity.

use super::envelope::{Envelope, Unloading};
use super::hertz::Hertz;
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use crate::material::Material;

/// Mean pressure at first yield over Y, $\theta$.
const YIELD_PRESSURE: f64 = 1.1;
/// Peak pressure of Hertz over the mean one.
const PEAK_OVER_MEAN: f64 = 1.5;
/// Mean pressure of full plasticity over Y.
const FULL_PRESSURE: f64 = 2.8;
/// Flattening over that of first yield from which the contact is fully plastic.
const FULL_FROM: f64 = 84.0;

/// Elastic-perfectly plastic sphere with the mean pressure of an expanding cavity.
///
/// With $w = \delta/\delta_Y$, $u = 2w - 1$, $\theta = 1.1$:
///
/// $$ \delta_Y = \left(\frac{3\pi \theta Y}{4 E^\ast}\right)^2 R, \qquad F_Y = \pi R \delta_Y \theta Y $$
/// $$ w \le 1:\ \text{Hertz}; \qquad
///    w \le 84:\ \frac{F}{F_Y} = u \left(1 + \frac{\ln u}{3 \theta}\right); \qquad
///    w > 84:\ \frac{F}{F_Y} = \frac{2.8}{\theta} u; \qquad \frac{a^2}{R \delta_Y} = u $$
/// $$ \text{unloading:}\quad F = F_Y u_m \left(\frac{\delta - \delta_r}{\delta_m - \delta_r}\right)^{3/2}, \qquad
///    \delta_m - \delta_r = \delta_Y \sqrt{u_m} $$
///
/// Source: Stronge 2000, Impact Mechanics, chapter 6: **from memory**. That the two plastic branches meet at w = 84 within 0.2 % speaks
/// for the loading; nothing else does. As it stands the slope jumps by 1.74 at yield, the force lies above Hertz by up
/// to 44 % (w = 2.6), and at reversal it drops to $1/(1 + \ln u/(3\theta))$ of what it was; e is up to 1.012 just above yield.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stronge {
    elastic: Hertz,
    yield_flattening: f64,
    yield_force: f64,
}

impl Stronge {
    /// Law of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let point = material.yield_point(1.0, PEAK_OVER_MEAN * YIELD_PRESSURE)?;
        Some(Self {
            elastic: Hertz::of(material),
            yield_flattening: point.displacement,
            yield_force: point.force,
        })
    }

    /// Contact area over that of first yield, past it.
    fn area(&self, x: f64) -> f64 {
        2.0 * x / self.yield_flattening - 1.0
    }

    /// Mean pressure over that of first yield.
    fn pressure(x: f64, area: f64, yield_flattening: f64) -> f64 {
        if x <= FULL_FROM * yield_flattening {
            1.0 + area.ln() / (3.0 * YIELD_PRESSURE)
        } else {
            FULL_PRESSURE / YIELD_PRESSURE
        }
    }
}

impl Published for Stronge {
    const NAME: &'static str = "stronge";
    const SUMMARY: &'static str =
        "pressure of an expanding cavity; unverified, compared on request";
    const PAPERS: &'static [&'static str] = &["Stronge2000"];
    const REFERENCE: &'static str =
        "Stronge 2000, Impact Mechanics, chapter 6 (from memory, unverified)";
    const EVIDENCE: Evidence = Evidence::Unverified;
    const OF_PAIRS: bool = true;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = None;
}

impl PublishedLaw for Stronge {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Self::of(material)
    }
}

impl Envelope for Stronge {
    fn loading(&self, x: f64) -> f64 {
        if x <= self.yield_flattening {
            return self.elastic.reduced_force(x);
        }
        let area = self.area(x);
        self.yield_force * area * Self::pressure(x, area, self.yield_flattening)
    }

    fn loading_slope(&self, x: f64) -> f64 {
        if x <= self.yield_flattening {
            return self.elastic.slope(x);
        }
        let pressure = Self::pressure(x, self.area(x), self.yield_flattening);
        let growth = match x <= FULL_FROM * self.yield_flattening {
            true => 1.0 / (3.0 * YIELD_PRESSURE),
            false => 0.0,
        };
        2.0 * self.yield_force / self.yield_flattening * (pressure + growth)
    }

    fn loading_work(&self, x: f64) -> f64 {
        let elastic = x.min(self.yield_flattening);
        let mut work = 0.4 * elastic * self.elastic.reduced_force(elastic);
        if x > self.yield_flattening {
            let full = FULL_FROM * self.yield_flattening;
            let (u, end) = (self.area(x.min(full)), self.area(x));
            let squares = 0.5 * (u * u - 1.0);
            let growing = squares + (0.5 * u * u * u.ln() - 0.5 * squares) / (3.0 * YIELD_PRESSURE);
            let constant = 0.5 * (end * end - u * u) * FULL_PRESSURE / YIELD_PRESSURE;
            work += 0.5 * self.yield_force * self.yield_flattening * (growing + constant);
        }
        work
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        if x <= self.yield_flattening {
            x.sqrt()
        } else {
            (self.yield_flattening * self.area(x)).sqrt()
        }
    }

    fn unloading(&self, peak: f64, force: f64) -> Unloading {
        if peak <= self.yield_flattening {
            return Unloading::hertzian(0.0);
        }
        let area = self.area(peak);
        Unloading {
            start: self.yield_force * area / force,
            ..Unloading::hertzian(peak - self.yield_flattening * area.sqrt())
        }
    }

    fn supported_to(&self) -> f64 {
        f64::INFINITY
    }
}
