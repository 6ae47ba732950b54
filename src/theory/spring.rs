//! Springs: the stiffnesses that users of linear hysteretic laws take from a material.

use super::johnson;
use crate::material::Material;

/// Loading stiffness over $R^\ast Y$: $k_1 = 5 R^\ast Y$.
const LOADING_RATIO: f64 = 5.0;
/// Damage number $\rho V^2/Y$ at which the springs are calibrated: the middle of Johnson's range of moderate
/// plasticity, 1e-3 to 1e-1.
const REFERENCE_DAMAGE_NUMBER: f64 = 1e-2;

/// Damage number from which on no spring stiffens any more: the end of that range.
const LIMIT_DAMAGE_NUMBER: f64 = 1e-1;

/// Stiffnesses of a body over its radius (Pa), so that the springs stay geometrically similar.
///
/// - $k_1 = 5 R^\ast Y$: the practice of discrete-element codes (Walton 2006, as documented for the hysteretic spring
///   of EDEM). It holds for two equal spheres ($R^\ast = R/2$, two springs in series) and for a sphere on a wall ($R^\ast = R$)
///   alike, with $k_1/R = 5Y$ a body.
/// - $k_2 = k_1/e^2$ at one reference speed. Users measure e; without a measurement it is [`johnson::restitution`]
///   at $\rho V^2/Y = 0.01$, at most 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Springs {
    /// $k_1/R$, Pa.
    pub loading: f64,
    /// $k_2/R$ at the reference speed, Pa.
    pub unloading: f64,
    /// Flattening $\delta/R$ that the reference impact reaches on $k_1$.
    pub flattening: f64,
    /// Flattening $\delta/R$ that an impact at the end of the range reaches on $k_1$.
    pub limit: f64,
}

impl Springs {
    /// Springs of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let y = material.flow?.yield_strength();
        let loading = LOADING_RATIO * y;
        let speed = |damage_number: f64| (damage_number * y / material.density).sqrt();
        let reached = |velocity: f64| velocity * (material.sphere_mass(1.0) / loading).sqrt();
        let velocity = speed(REFERENCE_DAMAGE_NUMBER);
        let e = johnson::restitution(material, velocity).unwrap_or(1.0);
        Some(Self {
            loading,
            unloading: loading / (e * e),
            flattening: reached(velocity),
            limit: reached(speed(LIMIT_DAMAGE_NUMBER)),
        })
    }
}
