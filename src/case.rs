//! Case file: what the user asks for, checked and in SI units.

use crate::document::Document;
use crate::document::keys::{Kind, Value as _, key, keys, names, table};
use crate::document::range;
use crate::material::adhesion::Adhesion;
use crate::material::flow::{FlowConstants, InText, WithFlow};
use crate::material::{Flow, Material};
use crate::scheme::preset::Method;
use crate::shape::Shape;
use crate::unit::{self, Angle, Density, Length, Pressure, Quantity, Velocity};
use crate::{Error, Result};
use named::Given;
use scheme::SchemeTable;
use serde::Deserialize;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use wall::{Wall, WallTable};

pub mod named;
pub mod pair;
pub(crate) mod scheme;
mod scope;
pub(crate) mod slips;
mod wall;

/// A checked case, SI units. Read with [`Case::read`].
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Name: the file's stem.
    pub name: String,
    /// File it was read from.
    pub path: PathBuf,
    /// SHA-256 of the file's text, hexadecimal: provenance of everything made from it.
    pub hash: String,
    /// Particle shape, lengths in m.
    pub shape: Shape,
    /// Particle radius R, m.
    pub radius: f64,
    /// Particle material.
    pub material: Material,
    /// Impact speeds, m/s, ascending.
    pub velocities: Vec<f64>,
    /// Angle of the impact velocity from the wall's normal, rad; 0 for a normal impact.
    pub angle: f64,
    /// Coulomb friction coefficient of the wall; 0 for a frictionless one.
    pub friction: f64,
    /// Adhesion of the wall; none of one that does not adhere.
    pub adhesion: Option<Adhesion>,
    /// Accuracy asked for, relative, on F*, delta* and e.
    pub tolerance: f64,
    /// Published method to run instead of the crate's own.
    pub method: Option<Method>,
    /// Bed scene to run with the law, resolved against the case file's folder.
    pub bed: Option<PathBuf>,
}

/// The case file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseFile {
    #[serde(default)]
    unusual: Vec<String>,
    particle: ParticleTable,
    material: Given,
    impact: ImpactTable,
    wall: Option<WallTable>,
    accuracy: AccuracyTable,
    scheme: Option<SchemeTable>,
    bed: Option<BedTable>,
}

keys! {
    CaseFile {
        particle: table("the particle"),
        material: table("its material: constants, or the name of one of `models/constants/` (`material = \"ofhc-copper\"` above the tables)"),
        impact: table("speeds"),
        wall: table("the wall: rigid with friction or adhesion, or deformable").or("rigid and frictionless"),
        accuracy: table("what the run is planned for"),
        scheme: table("a published method in place of the crate's own").or("the crate's own"),
        bed: table("a bed that `run` ends with").or("none"),
        unusual: key("values that look like a slip of a unit and are meant all the same", "`particle.radius`, `impact.velocities`, `wall.radius`, `wall.work_of_adhesion`, or a number of `[material]` or `[wall.material]` as `material.density`", "['particle.radius']").or("none"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParticleTable {
    radius: Quantity<Length>,
    #[serde(default)]
    shape: ShapeName,
    length: Option<Quantity<Length>>,
}

keys! {
    ParticleTable {
        radius: key("radius of the sphere or the cylinder", "> 0", "'250 um'"),
        shape: key("its shape; a cylinder flies along its axis against a frictionless wall and is run by `impact` alone", "", "'cylinder'").or("sphere"),
        length: key("length of a cylinder", "> 0", "'25.4 mm'").or("none of a sphere"),
    }
}

#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ShapeName {
    #[default]
    Sphere,
    Cylinder,
}

names! {
    ShapeName {
        Sphere as "sphere",
        Cylinder as "cylinder",
    }
}

/// Length of a cylinder over its radius that is run.
const SLENDER: RangeInclusive<f64> = 0.2..=50.0;

/// Table `[material]`, in case and scene files alike.
type MaterialTable = WithFlow<ElasticTable, InText>;

/// Its constants besides those of the flow stress.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ElasticTable {
    pub(crate) density: Quantity<Density>,
    pub(crate) young_modulus: Quantity<Pressure>,
    pub(crate) poisson_ratio: f64,
}

keys! {
    ElasticTable {
        density: key("mass per volume of the solid", "> 0", "'7274 kg/m3'"),
        young_modulus: key("Young's modulus E", "> 0", "'59.82 GPa'"),
        poisson_ratio: key("Poisson's ratio", "[0, 0.5)", "0.33"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ImpactTable {
    velocities: Vec<Quantity<Velocity>>,
    angle: Option<Quantity<Angle>>,
}

keys! {
    ImpactTable {
        velocities: key("impact speeds", "> 0, each once", "['5 m/s', '10 m/s']"),
        angle: key("of the velocity from the wall's normal; above 0 the impact is run in three dimensions, by `impact` alone", "0 to 85 deg", "'30 deg'").or("0"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AccuracyTable {
    tolerance: f64,
}

keys! {
    AccuracyTable {
        tolerance: key("error asked for: relative in F* and δ*, absolute in e", "(0, 0.2]", "0.02"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BedTable {
    scene: String,
}

keys! {
    BedTable {
        scene: key("scene to run with the law, beside the case file", "an existing file", "'solder-bed.toml'"),
    }
}

impl Case {
    /// Read and check a case file.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be read; otherwise as [`Case::parse`].
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_document(&Document::read(path)?)
    }

    /// Check the text of a case file; `path` is for messages, the name, and for files the case names.
    ///
    /// ```
    /// use impactlaw::case::Case;
    /// let case = Case::parse(r#"
    ///     [particle]
    ///     radius = "250 um"
    ///     [material]
    ///     density = "8000 kg/m3"
    ///     young_modulus = "100 GPa"
    ///     poisson_ratio = 0.35
    ///     yield_strength = "1.25 GPa"
    ///     [impact]
    ///     velocities = ["50 m/s", "10 m/s"]
    ///     [accuracy]
    ///     tolerance = 0.02
    /// "#, "cases/steel.toml".as_ref())?;
    /// assert_eq!(case.name, "steel");
    /// assert_eq!(case.velocities, [10.0, 50.0]);
    /// # Ok::<(), impactlaw::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Syntax`] for an unknown or missing key or a value without unit, [`Error::Value`] for a value out of
    /// range or one that looks like a slip of its unit and is not named in `unusual`; both name key, what was found and what is allowed.
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        Self::from_document(&Document::new(path, text))
    }

    /// Keys of a case file.
    #[must_use]
    pub fn keys() -> Kind {
        CaseFile::kind()
    }

    /// Check a case file that has been read already.
    ///
    /// # Errors
    /// As [`Case::parse`], and [`Error::Value`] for a deformable wall, which [`pair::Asked`] reads.
    pub fn from_document(document: &Document) -> Result<Self> {
        match Self::with_wall(document)? {
            (case, None, _) => Ok(case),
            _ => Err(pair::refusal(document)),
        }
    }

    /// The case, what stands in place of a rigid wall, and the values that are meant though they look like slips.
    fn with_wall(document: &Document) -> Result<(Self, Option<pair::Target>, Vec<String>)> {
        let file: CaseFile = document.parse()?;
        let Wall {
            friction,
            adhesion,
            target,
        } = (file.wall).map_or(Ok(Wall::default()), |wall| wall.check(document))?;
        let written: Vec<f64> = file.impact.velocities.iter().map(|v| v.si()).collect();
        let case = Case {
            name: document.name(),
            path: document.path().to_owned(),
            hash: document.hash(),
            radius: document.within("particle.radius", file.particle.radius.si())?,
            shape: file.particle.shape(document)?,
            material: file.material.check(document, "material")?,
            velocities: file.impact.check(document)?,
            angle: file.impact.angle(document)?,
            friction,
            adhesion,
            tolerance: document.within("accuracy.tolerance", file.accuracy.tolerance)?,
            method: file.scheme.map(|s| s.check(document)).transpose()?,
            bed: file.bed.map(|bed| bed.check(document)).transpose()?,
        };
        case.check_cylinder(document)?;
        if let Some((key, allowed)) = case.beyond_preset(target.is_some()) {
            return Err(document.reject(&key, allowed));
        }
        slips::check(&case, &written, document, &file.unusual, target.is_some())?;
        Ok((case, target, file.unusual))
    }

    /// A case without a file: a sphere of `radius` (m) of `material`, at `velocities` (m/s), to `tolerance`.
    ///
    /// # Errors
    /// [`Error::Refused`] for a value that a case file would not be allowed either.
    pub fn of(
        name: &str,
        radius: f64,
        material: Material,
        velocities: &[f64],
        tolerance: f64,
    ) -> Result<Self> {
        let refuse = |what: &str, found: String, allowed: &str| Error::Refused {
            what: what.to_owned(),
            found,
            allowed: allowed.to_owned(),
        };
        let root = Self::keys();
        let within = |key: &str, value: f64| {
            let range = root.at(key).map_or("", |key| key.line.range);
            match range::holds(range, value) {
                Some(true) => Ok(()),
                _ => {
                    let what = key.rsplit('.').next().unwrap_or(key);
                    Err(refuse(what, value.to_string(), &range::must(range)))
                }
            }
        };
        let Material {
            density,
            young_modulus,
            poisson_ratio,
            flow,
        } = material;
        within("particle.radius", radius)?;
        within("material.density", density)?;
        within("material.young_modulus", young_modulus)?;
        within("material.poisson_ratio", poisson_ratio)?;
        for (constant, value) in flow.iter().flat_map(|flow| flow.constants()) {
            if !constant.range.holds(value, young_modulus) {
                let allowed = constant.range.rule(young_modulus);
                return Err(refuse(constant.key, value.to_string(), &allowed));
            }
        }
        if let Some((constant, allowed)) = flow.and_then(Flow::contradiction) {
            let value = flow.and_then(|flow| flow.value(&constant));
            let found = value.unwrap_or(f64::NAN).to_string();
            return Err(refuse(constant.key, found, &allowed));
        }
        let mut velocities = velocities.to_vec();
        velocities.sort_by(f64::total_cmp);
        velocities.dedup();
        if velocities.is_empty() {
            let allowed = "must hold at least one speed";
            return Err(refuse("velocities", "[]".to_owned(), allowed));
        }
        for velocity in &velocities {
            within("impact.velocities", *velocity)?;
        }
        within("accuracy.tolerance", tolerance)?;
        Ok(Case {
            name: name.to_owned(),
            path: PathBuf::from(name),
            hash: "0".repeat(64),
            shape: Shape::Sphere,
            radius,
            material,
            velocities,
            angle: 0.0,
            friction: 0.0,
            adhesion: None,
            tolerance,
            method: None,
            bed: None,
        })
    }

    /// The case with the speeds of `--velocity`, when any are given.
    ///
    /// # Errors
    /// [`Error::Refused`] for a text that is not a positive speed, or for one given twice.
    pub fn with_velocities(mut self, texts: &[String]) -> Result<Self> {
        if texts.is_empty() {
            return Ok(self);
        }
        let reject = |text: &str, allowed: &str| Error::Refused {
            what: "--velocity".to_owned(),
            found: format!("\"{text}\""),
            allowed: allowed.to_owned(),
        };
        let mut velocities = Vec::new();
        for text in texts {
            let velocity = unit::argument::<Velocity>("--velocity", text)?;
            if velocity <= 0.0 {
                return Err(reject(text, "must be positive, e.g. \"10 m/s\""));
            }
            if velocities.contains(&velocity) {
                return Err(reject(text, "must be given once"));
            }
            slips::check_argument(&self, velocity, text)?;
            velocities.push(velocity);
        }
        velocities.sort_by(f64::total_cmp);
        self.velocities = velocities;
        Ok(self)
    }
}

impl ParticleTable {
    /// The shape, with a length of its own where it has one.
    fn shape(&self, document: &Document) -> Result<Shape> {
        match (self.shape, self.length) {
            (ShapeName::Sphere, None) => Ok(Shape::Sphere),
            (ShapeName::Sphere, Some(_)) => {
                let allowed = "must be left out: a sphere has none; a cylinder is told by `shape = \"cylinder\"`";
                Err(document.reject("particle.length", allowed))
            }
            (ShapeName::Cylinder, None) => {
                Err(document.reject("particle.shape", "needs a `length` beside it"))
            }
            (ShapeName::Cylinder, Some(length)) => {
                let length = document.within("particle.length", length.si())?;
                let rule = format!(
                    "must be {} to {} times the radius",
                    SLENDER.start(),
                    SLENDER.end()
                );
                let holds = |length: f64| SLENDER.contains(&(length / self.radius.si()));
                let length = document.check("particle.length", length, holds, &rule)?;
                Ok(Shape::Cylinder { length })
            }
        }
    }
}

impl ElasticTable {
    /// Checks the table whose dotted key is `at`.
    pub(crate) fn check(
        self,
        flow: &FlowConstants<InText>,
        document: &Document,
        at: &str,
    ) -> Result<Material> {
        let key = |name: &str| format!("{at}.{name}");
        let young_modulus = document.within(&key("young_modulus"), self.young_modulus.si())?;
        Ok(Material {
            density: document.within(&key("density"), self.density.si())?,
            young_modulus,
            poisson_ratio: document.within(&key("poisson_ratio"), self.poisson_ratio)?,
            flow: flow.check(document, at, young_modulus)?,
        })
    }
}

impl ImpactTable {
    pub(crate) fn check(&self, document: &Document) -> Result<Vec<f64>> {
        if self.velocities.is_empty() {
            return Err(document.reject(
                "impact.velocities",
                "must hold at least one speed, e.g. [\"10 m/s\"]",
            ));
        }
        let mut velocities = Vec::with_capacity(self.velocities.len());
        for (i, &quantity) in self.velocities.iter().enumerate() {
            let key = format!("impact.velocities[{i}]");
            let velocity = document.within(&key, quantity.si())?;
            if velocities.contains(&velocity) {
                return Err(document.reject(&key, "must be given once"));
            }
            velocities.push(velocity);
        }
        velocities.sort_by(f64::total_cmp);
        Ok(velocities)
    }
}

impl ImpactTable {
    fn angle(&self, document: &Document) -> Result<f64> {
        let key = "impact.angle";
        let allowed = 0.0..=85f64.to_radians();
        self.angle.map_or(Ok(0.0), |angle| {
            document.check(
                key,
                angle.si(),
                |angle| allowed.contains(&angle),
                &document.must(key),
            )
        })
    }
}

impl BedTable {
    fn check(&self, document: &Document) -> Result<PathBuf> {
        let path = document.resolve(&self.scene);
        if path.is_file() {
            Ok(path)
        } else {
            Err(document.reject(
                "bed.scene",
                format!(
                    "must name an existing file ({} does not exist)",
                    path.display()
                ),
            ))
        }
    }
}

#[cfg(test)]
mod tests;
