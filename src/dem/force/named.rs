//! Contact constants that a scene names, and the effects they call for.

use super::damping::Viscous;
use super::friction::Mindlin;
use super::rolling::RollingSpring;
use crate::material::Material;

/// Checked constants of a contact; an effect that is not named does not act.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Constants {
    /// Coulomb friction coefficient.
    pub friction: Option<f64>,
    /// Rolling friction coefficient; only with friction.
    pub rolling: Option<f64>,
    /// Restitution of the elastic contact, by viscous damping.
    pub restitution: Option<f64>,
    /// Contact stiffness over that of the material, in (0, 1]: softer contacts allow longer time steps.
    pub stiffness: Option<f64>,
}

impl Constants {
    /// Contact stiffness over that of the material.
    #[must_use]
    pub fn softening(&self) -> f64 {
        self.stiffness.unwrap_or(1.0)
    }
}

/// Effects beside the normal law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Effects {
    /// Viscous damping.
    pub damping: Option<Viscous>,
    /// Friction.
    pub friction: Option<Mindlin>,
    /// Rolling resistance; only with friction.
    pub rolling: Option<RollingSpring>,
}

impl Effects {
    /// Effects a scene names for grains of `material`.
    #[must_use]
    pub fn of(contact: &Constants, material: &Material) -> Self {
        Self {
            damping: contact.restitution.map(Viscous::new),
            friction: contact.friction.map(|mu| Mindlin::new(material, mu)),
            rolling: contact.rolling.map(|mu| RollingSpring::new(material, mu)),
        }
    }

    /// The same for two bodies of these materials, rigid ones if none.
    #[must_use]
    pub fn between(contact: &Constants, materials: [Option<&Material>; 2]) -> Self {
        let (friction, rolling) = (contact.friction, contact.rolling);
        Self {
            damping: contact.restitution.map(Viscous::new),
            friction: friction.map(|mu| Mindlin::between(materials, mu)),
            rolling: rolling.map(|mu| RollingSpring::between(materials, mu)),
        }
    }
}
