//! Luding: linear springs whose unloading stiffens with the largest overlap up to a limit branch.

use super::envelope::{Envelope, Unloading};
use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use super::spring::Springs;
use crate::material::Material;

/// Adhesive elasto-plastic springs of Luding, here without the adhesive branch ($k_c = 0$).
///
/// $$ F = k_1 \delta \ (\delta \le \delta^\ast), \quad F = \hat k_2 (\delta - \delta^\ast_r) \ (\delta > \delta^\ast), \quad
///    \delta^\ast = \frac{\hat k_2}{\hat k_2 - k_1} \phi_f \frac{2 R_1 R_2}{R_1 + R_2}, \quad
///    \delta^\ast_r = \phi_f \frac{2 R_1 R_2}{R_1 + R_2} $$
/// $$ \text{unloading:}\quad F = k_2 (\delta - \delta_r), \quad \delta_r = \delta_m\left(1 - \frac{k_1}{k_2}\right), \quad
///    k_2 = k_1 + (\hat k_2 - k_1) \frac{\delta_m}{\delta^\ast} $$
///
/// Source: Luding 2008, Granular Matter 10, 235 (as documented by LAMMPS). Past $\delta^\ast$ the contact is elastic on the
/// limit branch, so e rises again. One body here is half of a pair of equal spheres, so its limit residual is
/// $\phi_f R/2$: in series two such bodies are the published pair law; a wall is then a mirror (codes differ there).
/// Contact radius: that of Hertz.
///
/// The paper leaves stiffnesses and $\phi_f$ free; [`Luding::of`] takes them from the material. $k_2$ is that of
/// [`Springs`] after an impact at the reference speed, so that e is Johnson's there, and it grows up to the end of his range
/// of moderate plasticity: $\delta^\ast$ is the flattening of $\rho V^2/Y = 0.1$, whatever the material. Up to there, without adhesion,
/// this is the law of Walton and Braun with a growing $k_2$. A $\phi_f$ fixed
/// instead, such as 0.05, is used up by slower impacts; beyond it e is near 1 for every $\hat k_2$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Luding {
    loading: f64,
    limit: f64,
    limit_flattening: f64,
    limit_residual: f64,
}

impl Luding {
    /// Law from $k_1/R$, $\hat k_2/R$ (Pa) and the plasticity depth $\phi_f$ of two equal spheres.
    #[must_use]
    pub fn with_depth(loading: f64, limit: f64, depth: f64) -> Self {
        let limit_residual = 0.5 * depth;
        Self {
            loading,
            limit,
            limit_flattening: limit / (limit - loading) * limit_residual,
            limit_residual,
        }
    }

    /// Law of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let springs = Springs::of(material)?;
        let growth = (springs.unloading - springs.loading) / springs.flattening;
        let limit = springs.loading + growth * springs.limit;
        Some(Self {
            loading: springs.loading,
            limit,
            limit_flattening: springs.limit,
            limit_residual: springs.limit * (1.0 - springs.loading / limit),
        })
    }

    /// Unloading stiffness over R (Pa) after a largest flattening `peak`.
    fn stiffness_after(&self, peak: f64) -> f64 {
        let share = (peak / self.limit_flattening).min(1.0);
        self.loading + (self.limit - self.loading) * share
    }

    /// Coefficient of restitution at speed `velocity` (m/s), from the energies of the springs, with
    /// $\delta_m = V\sqrt{m/k_1}$:
    ///
    /// $$ e = \sqrt{k_1/k_2(\delta_m)} \ (\delta_m \le \delta^\ast), \qquad
    ///    e = \sqrt{1 - \left(1 - \frac{k_1}{\hat k_2}\right)\left(\frac{\delta^\ast}{\delta_m}\right)^2} $$
    ///
    /// Derived here; the paper gives the springs only.
    #[must_use]
    pub fn restitution(&self, material: &Material, velocity: f64) -> f64 {
        let peak = velocity * (material.sphere_mass(1.0) / self.loading).sqrt();
        if peak <= self.limit_flattening {
            return (self.loading / self.stiffness_after(peak)).sqrt();
        }
        // all that is lost is lost up to the limit branch
        let share = (self.limit_flattening / peak).powi(2);
        (1.0 - (1.0 - self.loading / self.limit) * share).sqrt()
    }
}

impl Published for Luding {
    const NAME: &'static str = "luding";
    const SUMMARY: &'static str =
        "linear; as `walton-braun-variable` up to ρV²/Y = 0.1, elastic beyond; without adhesion";
    const PAPERS: &'static [&'static str] = &["Luding2008"];
    const REFERENCE: &'static str = "Luding 2008, Granular Matter 10, 235, without adhesion; k1 = 5 R Y (Walton 2006), k2 from Johnson's e at rho V^2/Y = 0.01, limit branch from 0.1 on";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> =
        Some(|material, velocity| Some(Luding::of(material)?.restitution(material, velocity)));
}

impl PublishedLaw for Luding {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Self::of(material)
    }
}

impl Envelope for Luding {
    fn loading(&self, x: f64) -> f64 {
        if x <= self.limit_flattening {
            self.loading * x
        } else {
            self.limit * (x - self.limit_residual)
        }
    }

    fn loading_slope(&self, x: f64) -> f64 {
        if x <= self.limit_flattening {
            self.loading
        } else {
            self.limit
        }
    }

    fn loading_work(&self, x: f64) -> f64 {
        let plastic = x.min(self.limit_flattening);
        let from_residual = |x: f64| (x - self.limit_residual) * (x - self.limit_residual);
        let past = from_residual(x) - from_residual(plastic);
        0.5 * (self.loading * plastic * plastic + self.limit * past)
    }

    fn loading_contact_radius(&self, x: f64) -> f64 {
        x.sqrt()
    }

    fn unloading(&self, peak: f64, _: f64) -> Unloading {
        if peak > self.limit_flattening {
            return Unloading::linear(self.limit_residual);
        }
        Unloading::linear(peak * (1.0 - self.loading / self.stiffness_after(peak)))
    }

    fn supported_to(&self) -> f64 {
        f64::INFINITY
    }
}
