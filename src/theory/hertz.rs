//! Hertz: the elastic sphere on a rigid plane.

use super::published::{ELASTIC, Evidence, FlowConstants, Published, PublishedLaw, Restitution};
use crate::contact::{NormalLaw, State};
use crate::material::Material;

/// Elastic contact of a sphere with a rigid frictionless plane.
///
/// $$ F = \tfrac43 E^\ast \sqrt{R}\ \delta^{3/2}, \qquad a^2 = R \delta $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | E* | Pa | contact modulus, $E/(1-\nu^2)$ |
/// | R | m | radius |
/// | delta | m | approach of the centre |
/// | a | m | contact radius |
///
/// Source: Hertz 1882; Johnson 1985, section 4.2. Valid for $a \ll R$; loading and unloading are one curve, $e = 1$.
///
/// ```
/// use impactlaw::{contact::NormalLaw, theory::hertz::Hertz};
/// // 4/3 * 3e9 Pa * 0.01^(3/2) = 4e6 Pa, times R^2 = 1e-6 m2: 4 N
/// let reduced_force = Hertz::new(3e9).force(0.01, &mut ());
/// assert!((reduced_force * 1e-6 - 4.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// $\tfrac43 E^\ast$, Pa.
    prefactor: f64,
    /// Largest flattening at which the body is known to be elastic.
    valid_to: f64,
}

impl Hertz {
    /// Law of a body with contact modulus E* (Pa).
    #[must_use]
    pub fn new(contact_modulus: f64) -> Self {
        Self {
            prefactor: 4.0 / 3.0 * contact_modulus,
            valid_to: f64::INFINITY,
        }
    }

    /// The same law of a body that is known to be elastic up to a flattening `x` = delta/R.
    #[must_use]
    pub fn up_to(self, x: f64) -> Self {
        Self {
            valid_to: x,
            ..self
        }
    }

    /// Law of a material; its flow stress plays no part.
    #[must_use]
    pub fn of(material: &Material) -> Self {
        Self::new(material.contact_modulus())
    }

    /// $\tfrac43 E^\ast$, Pa.
    #[must_use]
    pub fn prefactor(&self) -> f64 {
        self.prefactor
    }

    /// Reduced force $F/R^2$ (Pa) at `x` = delta/R.
    pub(crate) fn reduced_force(&self, x: f64) -> f64 {
        if x > 0.0 {
            self.prefactor * x * x.sqrt()
        } else {
            0.0
        }
    }

    /// Slope of the reduced force (Pa).
    pub(crate) fn slope(&self, x: f64) -> f64 {
        1.5 * self.prefactor * x.max(0.0).sqrt()
    }
}

impl Published for Hertz {
    const NAME: &'static str = "hertz";
    const SUMMARY: &'static str = "elastic";
    const PAPERS: &'static [&'static str] = &["Hertz1882", "Johnson1985"];
    const REFERENCE: &'static str = "Hertz 1882; Johnson 1985, section 4.2";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = true;
    const FLOW: FlowConstants = ELASTIC;
    const RESTITUTION: Option<Restitution> = Some(|_, _| Some(1.0));
}

impl PublishedLaw for Hertz {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Some(Self::of(material))
    }
}

impl NormalLaw for Hertz {
    type History = ();

    fn force(&self, x: f64, _: &mut ()) -> f64 {
        self.reduced_force(x)
    }

    fn stiffness(&self, x: f64, _: &()) -> f64 {
        self.slope(x)
    }

    #[inline(always)]
    fn state(&self, x: f64, _: &mut ()) -> State {
        let x = x.max(0.0);
        let root = x.sqrt();
        State {
            force: self.prefactor * x * root,
            stiffness: 1.5 * self.prefactor * root,
            contact_radius: root,
            depth: x,
        }
    }

    fn depth(&self, x: f64, _: &()) -> f64 {
        x.max(0.0)
    }

    fn dissipated(&self, _: &()) -> f64 {
        0.0
    }

    /// $\tfrac25 \varphi x$.
    fn elastic_energy(&self, x: f64, _: &()) -> f64 {
        0.4 * self.reduced_force(x) * x.max(0.0)
    }

    fn contact_radius(&self, x: f64, _: &()) -> Option<f64> {
        Some(x.max(0.0).sqrt())
    }

    fn valid_to(&self) -> f64 {
        self.valid_to
    }
}
