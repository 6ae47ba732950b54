//! Wu, Li and Thornton: restitution at finite plastic deformation, from finite elements; no force law.

use super::published::{Evidence, FlowConstants, Published, Restitution, YIELD_STRENGTH_ONLY};
use crate::material::{Material, YIELD_PRESSURE_RATIO};

/// Prefactor of the curve of finite plastic deformation.
const FINITE: f64 = 0.62;
/// Prefactor of the curve of small plastic deformation.
const SMALL: f64 = 2.08;

/// The formula as a published model; the paper gives no force.
#[derive(Debug, Clone, Copy)]
pub struct WuLiThornton;

impl Published for WuLiThornton {
    const NAME: &'static str = "wu-li-thornton";
    const SUMMARY: &'static str = "restitution at finite plastic deformation, no force";
    const PAPERS: &'static [&'static str] = &["WuLiThornton2003"];
    const REFERENCE: &'static str = "Wu, Li and Thornton 2003, Int. J. Impact Eng. 28, 929";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = Some(restitution);
}

/// Coefficient of restitution of an elastic-perfectly plastic sphere on a rigid wall at speed `velocity` (m/s):
///
/// $$ e = 2.08 \left(\frac{V}{V_y}\right)^{-1/4}, \qquad
///    e = 0.62 \left(\frac{V/V_y}{E^\ast/Y}\right)^{-1/2} \ \text{ from } \ \frac{V}{V_y} =
///   \left(\frac{0.62}{2.08}\right)^4 \left(\frac{E^\ast}{Y}\right)^2 \text{ on} $$
///
/// the speed where the two meet. $V_y$ with a peak pressure $1.6\ Y$. Source: Wu, Li and Thornton 2003; **2.08 and
/// the pressure ratio are unverified** (their intersection, $0.0079 (E^\ast/Y)^2$, agrees with the transition $0.008 (E^\ast/Y)^2$
/// of the paper). `None` for an elastic body and where the formula exceeds 1.
#[must_use]
pub fn restitution(material: &Material, velocity: f64) -> Option<f64> {
    let stiffness = material.contact_modulus() / material.flow?.yield_strength();
    let v = velocity / material.yield_point(1.0, YIELD_PRESSURE_RATIO)?.velocity;
    let e = if v < (FINITE / SMALL).powi(4) * stiffness * stiffness {
        SMALL * v.powf(-0.25)
    } else {
        FINITE * (v / stiffness).powf(-0.5)
    };
    (e <= 1.0).then_some(e)
}
