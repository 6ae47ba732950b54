//! Walton and Braun: a linear spring in loading and a stiffer one in unloading.

use super::envelope::{Envelope, Unloading};
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use super::spring::Springs;
use crate::material::Material;

/// Latched linear springs.
///
/// $$ F = k_1 \delta, \qquad \text{unloading:}\quad F = k_2 (\delta - \delta_r), \quad \delta_r = \delta_m \left(1 - \frac{k_1}{k_2}\right), \quad
///    k_2 = \hat k_2 + S F_m $$
///
/// Constant $k_2$ ($S = 0$): $e = \sqrt{k_1/k_2}$ at every speed. Variable $k_2$ ($\hat k_2 = k_1$, $S > 0$): e
/// falls with the speed. The law has no elastic range and no geometry; contact radius: that of Hertz, $a^2 = R\delta$.
/// Source: Walton and Braun 1986, J. Rheol. 30, 949; stiffnesses from a material: [`Springs`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaltonBraun {
    loading: f64,
    unloading: f64,
    /// $S R$: growth of the unloading stiffness with the force.
    growth: f64,
}

impl WaltonBraun {
    /// Law from $k_1/R$, $\hat k_2/R$ (Pa) and the growth $S R$ of the unloading stiffness with the force at the
    /// peak.
    ///
    /// ```
    /// use impactlaw::{contact::rebound::rebound, theory::walton_braun::WaltonBraun};
    /// let hit = rebound(&WaltonBraun::new(1e6, 4e6, 0.0), 0.01, 0.02, 1.0);
    /// assert!((hit.restitution - 0.5).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn new(loading: f64, unloading: f64, growth: f64) -> Self {
        Self {
            loading,
            unloading,
            growth,
        }
    }

    /// Constant unloading stiffness; `None` for an elastic body.
    #[must_use]
    pub fn constant(material: &Material) -> Option<Self> {
        let springs = Springs::of(material)?;
        Some(Self::new(springs.loading, springs.unloading, 0.0))
    }

    /// Unloading stiffness that grows with the force, from $k_1$ to the reference value at the reference speed;
    /// `None` for an elastic body.
    #[must_use]
    pub fn variable(material: &Material) -> Option<Self> {
        let springs = Springs::of(material)?;
        let force = springs.loading * springs.flattening;
        let growth = (springs.unloading - springs.loading) / force;
        Some(Self::new(springs.loading, springs.loading, growth))
    }

    /// Coefficient of restitution, with $\omega_0 = \sqrt{k_1/m}$ for a sphere on a wall:
    ///
    /// $$ e = \sqrt{\frac{k_1}{\hat k_2 + S k_1 V/\omega_0}} $$
    ///
    /// that is $\sqrt{k_1/k_2}$ for $S = 0$ and the authors' $\sqrt{\omega_0/(S V + \omega_0)}$ for $\hat k_2 = k_1$.
    /// `velocity` in m/s.
    #[must_use]
    pub fn restitution(&self, material: &Material, velocity: f64) -> f64 {
        let flattening = velocity * (material.sphere_mass(1.0) / self.loading).sqrt();
        let stiffness = self.unloading + self.growth * self.loading * flattening;
        (self.loading / stiffness).sqrt()
    }
}

/// [`WaltonBraun::constant`].
#[derive(Debug, Clone, Copy)]
pub struct Constant;

impl Published for Constant {
    const NAME: &'static str = "walton-braun";
    const SUMMARY: &'static str = "linear; unloading stiffer by a constant ratio";
    const PAPERS: &'static [&'static str] = &["WaltonBraun1986"];
    const REFERENCE: &'static str = "Walton and Braun 1986, J. Rheol. 30, 949, constant k2; k1 = 5 R Y (Walton 2006), k2 from Johnson's e at rho V^2/Y = 0.01";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = Some(|material, velocity| {
        Some(WaltonBraun::constant(material)?.restitution(material, velocity))
    });
}

impl PublishedLaw for Constant {
    type Law = WaltonBraun;

    fn law(material: &Material) -> Option<WaltonBraun> {
        WaltonBraun::constant(material)
    }
}

/// [`WaltonBraun::variable`].
#[derive(Debug, Clone, Copy)]
pub struct Variable;

impl Published for Variable {
    const NAME: &'static str = "walton-braun-variable";
    const SUMMARY: &'static str = "linear; unloading stiffness grows with the largest force";
    const PAPERS: &'static [&'static str] = &["WaltonBraun1986"];
    const REFERENCE: &'static str = "Walton and Braun 1986, J. Rheol. 30, 949, k2 growing with the force; k1 = 5 R Y (Walton 2006), k2 from Johnson's e at rho V^2/Y = 0.01";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = Some(|material, velocity| {
        Some(WaltonBraun::variable(material)?.restitution(material, velocity))
    });
}

impl PublishedLaw for Variable {
    type Law = WaltonBraun;

    fn law(material: &Material) -> Option<WaltonBraun> {
        WaltonBraun::variable(material)
    }
}

impl Envelope for WaltonBraun {
    fn loading(&self, x: f64) -> f64 {
        self.loading * x
    }

    fn loading_slope(&self, _: f64) -> f64 {
        self.loading
    }

    fn loading_work(&self, x: f64) -> f64 {
        0.5 * self.loading * x * x
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        x.sqrt()
    }

    fn unloading(&self, peak: f64, force: f64) -> Unloading {
        let stiffness = self.unloading + self.growth * force;
        Unloading::linear(peak * (1.0 - self.loading / stiffness))
    }

    fn supported_to(&self) -> f64 {
        f64::INFINITY
    }
}
