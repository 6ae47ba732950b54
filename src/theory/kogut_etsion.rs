//! Kogut and Etsion: finite-element power laws of a flattened sphere, unloading of Etsion, Kligerman and Kadin.

use super::envelope::{Envelope, Unloading};
use super::hertz::Hertz;
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use crate::material::Material;

/// Hardness over the yield strength, H/Y.
const HARDNESS_RATIO: f64 = 2.8;

/// One row of the table of Kogut and Etsion 2002: up to `to`, force and area as factor times a power of $w$.
struct Row {
    to: f64,
    force: (f64, f64),
    area: (f64, f64),
}

/// Elastic-plastic rows of the paper; below is Hertz, above full plasticity.
const ROWS: [Row; 2] = [
    Row {
        to: 6.0,
        force: (1.03, 1.425),
        area: (0.93, 1.136),
    },
    Row {
        to: 110.0,
        force: (1.40, 1.263),
        area: (0.94, 1.146),
    },
];

/// Elastic-perfectly plastic sphere flattened by a rigid plane, fitted to finite elements.
///
/// With $w = \delta/\delta_c$, $\delta_c = (\pi K H/2E^\ast)^2 R$, $K = 0.454 + 0.41\nu$, $H = 2.8\ Y$, $P_c$ the
/// force of Hertz at $\delta_c$ and $A_c = \pi R \delta_c$:
///
/// | $w$ | $F/P_c$ | $A/A_c$ |
/// |---|---|---|
/// | up to 1 | $w^{1.5}$ | $w$ |
/// | up to 6 | $1.03\ w^{1.425}$ | $0.93\ w^{1.136}$ |
/// | up to 110 | $1.40\ w^{1.263}$ | $0.94\ w^{1.146}$ |
/// | above | $(3/K)\ w$, that is $F = 2\pi R H \delta$ | $2w$ |
///
/// $$ \text{unloading:}\quad F = F_m \left(\frac{\delta - \delta_r}{\delta_m - \delta_r}\right)^{n}, \quad
///    \frac{\delta_r}{\delta_m} = (1 - w_m^{-0.28})(1 - w_m^{-0.69}), \quad n = 1.5\ w_m^{-0.0331}, \quad
///    A \propto (\delta - \delta_r)^{w_m^{-0.12}} $$
///
/// Source: loading Kogut and Etsion 2002, J. Appl. Mech. 69, 657 (constants seen in independent codes); unloading
/// Etsion, Kligerman and Kadin 2005, Int. J. Solids Struct. 42, 3716: **its constants are unverified** against the
/// paper. Basis: E/Y 100 to 1000, $w \le 110$ (unverified).
///
/// The published rows do not meet: at $w = 1$ the force jumps up by 3 % and the area down by 7 %, at $w = 6$ by 1.7
/// % and 2.9 %, at 110 by $0.7$ to $16$ % with Poisson's ratio. A row holds at its own upper end. The first jump
/// puts the curve above Hertz up to $w = 1.48$, which makes e as large as 1.015 just above yield: the law is kept
/// as published.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KogutEtsion {
    elastic: Hertz,
    critical_flattening: f64,
    critical_force: f64,
    plastic_slope: f64,
}

impl KogutEtsion {
    /// Law of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let k = 0.454 + 0.41 * material.poisson_ratio;
        let point = material.yield_point(1.0, k * HARDNESS_RATIO)?;
        Some(Self {
            elastic: Hertz::of(material),
            critical_flattening: point.displacement,
            critical_force: point.force,
            plastic_slope: 3.0 / k * point.force / point.displacement,
        })
    }

    fn row(w: f64) -> Option<&'static Row> {
        ROWS.iter().find(|row| w <= row.to)
    }
}

impl Published for KogutEtsion {
    const NAME: &'static str = "kogut-etsion";
    const SUMMARY: &'static str =
        "finite-element power laws; unloading of Etsion, Kligerman and Kadin";
    const PAPERS: &'static [&'static str] = &["KogutEtsion2002", "EtsionKligermanKadin2005"];
    const REFERENCE: &'static str = "Kogut and Etsion 2002, J. Appl. Mech. 69, 657; unloading Etsion, Kligerman and Kadin 2005, Int. J. Solids Struct. 42, 3716 (unloading constants unverified)";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = None;
}

/// [`KogutEtsion`] with an unloading of Hertz that begins with the contact radius $a_m$ of the largest displacement.
///
/// $$ \text{unloading:}\quad F = F_m \left(\frac{\delta - \delta_r}{\delta_m - \delta_r}\right)^{3/2}, \quad
///    \delta_m - \delta_r = \frac{3 F_m}{4 a_m E^\ast}, \quad a^2 = R_r (\delta - \delta_r), \quad
///    R_r = \frac{4 E^\ast a_m^3}{3 F_m} $$
///
/// It has no constant of its own: force and radius of a sphere of radius $R_r$ under Hertz are $F_m$ and $a_m$ at $\delta_m$.
///
/// Source: attributed to Etsion, Kligerman and Kadin 2005 by Jackson, Green and Marghitu 2010 and by **one code** that was seen, not the
/// papers. Between $w = 1$ and $1.068^{1/0.143} = 1.6$ the jumps of loading at first yield leave more than $\delta_m$ to spring back:
/// nothing is left of the flattening there, and e is up to 1.015 as with the other unloading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzianUnloading {
    loading: KogutEtsion,
    contact_modulus: f64,
}

impl Published for HertzianUnloading {
    const NAME: &'static str = "kogut-etsion-hertzian";
    const SUMMARY: &'static str =
        "`kogut-etsion`, unloading of Hertz from its radius; unverified, compared on request";
    const PAPERS: &'static [&'static str] = &["KogutEtsion2002", "JacksonGreenMarghitu2010"];
    const REFERENCE: &'static str = "Kogut and Etsion 2002, J. Appl. Mech. 69, 657; unloading of Hertz with a continuous contact radius, as Jackson, Green and Marghitu 2010 and a code attribute it to Etsion, Kligerman and Kadin 2005 (not seen in the papers)";
    const EVIDENCE: Evidence = Evidence::Unverified;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = None;
}

impl PublishedLaw for HertzianUnloading {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Some(Self {
            loading: KogutEtsion::of(material)?,
            contact_modulus: material.contact_modulus(),
        })
    }
}

impl Envelope for HertzianUnloading {
    fn loading(&self, x: f64) -> f64 {
        self.loading.loading(x)
    }

    fn loading_slope(&self, x: f64) -> f64 {
        self.loading.loading_slope(x)
    }

    fn loading_work(&self, x: f64) -> f64 {
        self.loading.loading_work(x)
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        self.loading.loading_contact_radius(x)
    }

    fn unloading(&self, peak: f64, force: f64) -> Unloading {
        if peak <= self.loading.critical_flattening {
            return Unloading::hertzian(0.0);
        }
        let radius = self.loading_contact_radius(peak);
        let sprung = 0.75 * force / (radius * self.contact_modulus);
        Unloading::hertzian((peak - sprung).max(0.0))
    }

    fn supported_to(&self) -> f64 {
        self.loading.supported_to()
    }
}

impl PublishedLaw for KogutEtsion {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Self::of(material)
    }
}

impl Envelope for KogutEtsion {
    fn loading(&self, x: f64) -> f64 {
        let w = x / self.critical_flattening;
        match Self::row(w) {
            _ if w <= 1.0 => self.elastic.reduced_force(x),
            Some(row) => self.critical_force * row.force.0 * w.powf(row.force.1),
            None => self.plastic_slope * x,
        }
    }

    fn loading_slope(&self, x: f64) -> f64 {
        let w = x / self.critical_flattening;
        match Self::row(w) {
            _ if w <= 1.0 => self.elastic.slope(x),
            Some(row) => row.force.1 * self.loading(x) / x,
            None => self.plastic_slope,
        }
    }

    fn loading_work(&self, x: f64) -> f64 {
        let w = x / self.critical_flattening;
        let mut work = 0.4 * w.min(1.0).powf(2.5);
        let mut from = 1.0;
        for row in &ROWS {
            let (factor, power) = (row.force.0, row.force.1 + 1.0);
            let to = w.min(row.to);
            if to > from {
                work += factor / power * (to.powf(power) - from.powf(power));
                from = to;
            }
        }
        let slope = self.plastic_slope * self.critical_flattening / self.critical_force;
        let plastic = 0.5 * slope * (w * w - from * from).max(0.0);
        let plastic = if w > from { plastic } else { 0.0 };
        self.critical_force * self.critical_flattening * (work + plastic)
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        let w = x / self.critical_flattening;
        let area = match Self::row(w) {
            _ if w <= 1.0 => w,
            Some(row) => row.area.0 * w.powf(row.area.1),
            None => 2.0 * w,
        };
        (area * self.critical_flattening).sqrt()
    }

    fn unloading(&self, peak: f64, _: f64) -> Unloading {
        let w = peak / self.critical_flattening;
        if w <= 1.0 {
            return Unloading::hertzian(0.0);
        }
        Unloading {
            residual: peak * (1.0 - w.powf(-0.28)) * (1.0 - w.powf(-0.69)),
            exponent: 1.5 * w.powf(-0.0331),
            area_exponent: w.powf(-0.12),
            start: 1.0,
        }
    }

    fn supported_to(&self) -> f64 {
        ROWS[1].to * self.critical_flattening
    }
}
