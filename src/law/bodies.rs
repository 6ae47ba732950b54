//! Bodies of the law of a pair: table `[pair]` of its file.

use crate::case::pair::{PairCase, TargetShape};
use crate::curve::Particle;
use crate::document::Document;
use crate::document::keys::{key, keys, names, table};
use crate::material::{Effective, Material, MaterialTable};
use crate::unit::engineering;
use crate::{Error, Result};
use serde::{Deserialize, Serialize};

/// Relative difference that text makes of a number that follows from others.
const ROUNDING: f64 = 1e-9;

/// Shape of the second body of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TargetName {
    /// A sphere that is free to move.
    Sphere,
    /// A plate that is held at its back.
    Plate,
    /// A half-space.
    HalfSpace,
}

names! { TargetName { Sphere as "sphere", Plate as "plate", HalfSpace as "half-space", } }

/// `[pair]`: the two bodies of a law that is of both.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairTable {
    /// Shape of the second body.
    pub target: TargetName,
    /// Radius of the particle that was simulated.
    pub particle_radius_m: f64,
    /// Radius of a second sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target_radius_m: Option<f64>,
    /// Thickness of a plate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target_thickness_m: Option<f64>,
    /// Material of the particle.
    pub particle_material: MaterialTable,
    /// Material of the second body.
    pub target_material: MaterialTable,
}

keys! {
    PairTable "The law is of two bodies, their approach and their effective radius; `[material]` is then the sphere on a rigid plane that stands for both." {
        target: key("shape of the second body", "`\"sphere\"`, `\"plate\"`, `\"half-space\"`", "'plate'"),
        particle_radius_m: key("radius of the particle that was simulated, m", "> 0", "0.0025"),
        target_radius_m: key("radius of the second sphere, m", "> 0", "0.001").or("none: flat"),
        target_thickness_m: key("thickness of the plate, m", "> 0", "0.01").or("none: no plate"),
        particle_material: table("what the particle is made of"),
        target_material: table("what the second body is made of"),
    }
}

impl PairTable {
    /// The bodies of a case.
    #[must_use]
    pub fn of(pair: &PairCase) -> Self {
        let shape = pair.target.shape;
        PairTable {
            target: match shape {
                TargetShape::Sphere { .. } => TargetName::Sphere,
                TargetShape::Plate { .. } => TargetName::Plate,
                TargetShape::HalfSpace => TargetName::HalfSpace,
            },
            particle_radius_m: pair.particle.radius,
            target_radius_m: shape.radius(),
            target_thickness_m: shape.thickness(),
            particle_material: MaterialTable::from(&pair.particle.material),
            target_material: MaterialTable::from(&pair.target.material),
        }
    }

    /// Materials of the particle and of the second body.
    #[must_use]
    pub fn materials(&self) -> [Material; 2] {
        [&self.particle_material, &self.target_material].map(MaterialTable::material)
    }

    /// The sphere on a rigid plane that stands for both bodies.
    #[must_use]
    pub fn effective(&self) -> Effective {
        let [first, second] = self.materials();
        Effective::of(
            &first,
            self.particle_radius_m,
            &second,
            self.target_radius_m,
        )
    }

    /// Length of the second body, its radius or its thickness, over the radius of the particle.
    fn proportion(&self) -> Option<f64> {
        let length = self.target_radius_m.or(self.target_thickness_m);
        length.map(|length| length / self.particle_radius_m)
    }

    /// The bodies in words: `a sphere of 2.5 mm on a plate of 10 mm`.
    #[must_use]
    pub fn bodies(&self) -> String {
        let length = |x: f64| engineering(x, "m", 4);
        let second = match (self.target_radius_m, self.target_thickness_m) {
            (Some(radius), _) => format!("a sphere of {}", length(radius)),
            (None, Some(thickness)) => format!("a plate of {}", length(thickness)),
            (None, None) => "a half-space".to_owned(),
        };
        format!("a sphere of {} on {second}", length(self.particle_radius_m))
    }

    /// What of `self` is not as in `other`: materials, shape and proportions; empty where one law is of both, whatever their size.
    #[must_use]
    pub fn differences(&self, other: &PairTable) -> Vec<String> {
        let mut all = Vec::new();
        for (whose, [own, others]) in [
            (
                "particle",
                [&self.particle_material, &other.particle_material],
            ),
            (
                "second body",
                [&self.target_material, &other.target_material],
            ),
        ] {
            let of = |table: &MaterialTable| Particle::of(&table.material(), 1.0);
            let found = of(own).differences(&of(others));
            all.extend(found.iter().map(|what| format!("{whose}: {what}")));
        }
        let same = match (self.proportion(), other.proportion()) {
            (Some(a), Some(b)) => (a / b - 1.0).abs() < ROUNDING,
            (a, b) => a == b,
        };
        if self.target != other.target || !same {
            all.push(format!("{} instead of {}", self.bodies(), other.bodies()));
        }
        all
    }

    /// That the lengths are there that the shape has, and that a sphere of `radius` (m) of `material` is the one that stands for both bodies.
    pub(super) fn check(
        &self,
        material: &Material,
        radius: f64,
        document: &Document,
    ) -> Result<()> {
        document.within("pair.particle_radius_m", self.particle_radius_m)?;
        self.particle_material
            .check(document, "pair.particle_material")?;
        self.target_material
            .check(document, "pair.target_material")?;
        for (key, value, shape) in [
            (
                "pair.target_radius_m",
                self.target_radius_m,
                TargetName::Sphere,
            ),
            (
                "pair.target_thickness_m",
                self.target_thickness_m,
                TargetName::Plate,
            ),
        ] {
            match (value, self.target == shape) {
                (Some(value), true) => drop(document.within(key, value)?),
                (None, false) => {}
                (Some(_), false) => {
                    let allowed = "must be left out: the second body has another shape";
                    return Err(document.reject(key, allowed));
                }
                (None, true) => return Err(document.reject(key, "must be there for this shape")),
            }
        }
        let of_both = self.effective();
        let stated = Particle::of(material, radius);
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < ROUNDING;
        let m = (&stated.material, &of_both.material);
        for (key, a, b) in [
            ("provenance.radius_m", stated.radius_m, of_both.radius),
            ("material.density_kg_m3", m.0.density_kg_m3, m.1.density),
            (
                "material.young_modulus_Pa",
                m.0.young_modulus_pa,
                m.1.young_modulus,
            ),
            // a ratio of 0 is none of a quotient
            (
                "material.poisson_ratio",
                1.0 + m.0.poisson_ratio,
                1.0 + m.1.poisson_ratio,
            ),
        ] {
            if !near(a, b) {
                let allowed = format!(
                    "must be that of the sphere that stands for the bodies of `[pair]`, here {b}"
                );
                return Err(document.reject(key, allowed));
            }
        }
        if material.flow != of_both.material.flow {
            let allowed = "must have the flow stress of the material of `[pair]` that yields first";
            return Err(document.reject("material", allowed));
        }
        Ok(())
    }
}

/// Refusal of a law of two bodies where that of one is meant.
pub(super) fn refusal(document: &Document, bodies: &PairTable) -> Error {
    Error::Refused {
        what: document.path().display().to_string(),
        found: format!("the law of a pair, {}", bodies.bodies()),
        allowed: "must be the law of one material on a rigid wall: that of a pair holds for its two materials together, and is taken by \
                  `impactlaw compare` with the case of the pair, by `[[pair]] law` of a scene and by `impactlaw export --to c`"
            .to_owned(),
    }
}
