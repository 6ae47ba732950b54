//! Scene: what a bed file says, checked and in SI units.

use super::stage::{Stage, StageTable, check_stages};
use crate::Result;
use crate::case::MaterialTable;
use crate::document::Document;
use crate::material::Material;
use crate::theory::Theory;
use crate::unit::{Acceleration, Length, Quantity, Velocity};
use serde::Deserialize;
use std::path::Path;

/// Name of the law that comes from a law file.
pub const FITTED: &str = "fitted";

/// A checked scene, SI units. Read with [`Scene::read`].
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Name: the file's stem.
    pub name: String,
    /// SHA-256 of the file's text, hexadecimal.
    pub hash: String,
    /// Laws the bed is compressed with, side by side: [`FITTED`] or a theory.
    pub laws: Vec<String>,
    /// Seed of the insertion.
    pub seed: u64,
    /// Gravity along -z, m/s2.
    pub gravity: f64,
    /// Grain material.
    pub material: Material,
    /// Number of grains.
    pub count: usize,
    /// Grain radius, m.
    pub radius: f64,
    /// Radii are spread evenly over this share of the radius, up and down.
    pub spread: f64,
    /// Root mean square of the random velocities grains are inserted with, along each axis, m/s.
    pub stir: f64,
    /// Effects beside the normal law.
    pub contact: ContactTable,
    /// Inner edges of the box along x and y, m.
    pub width: f64,
    /// See `width`.
    pub depth: f64,
    /// Time step.
    pub time: TimeTable,
    /// Stages, in order.
    pub stages: Vec<Stage>,
    /// Files.
    pub output: OutputTable,
}

/// The scene file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    laws: Vec<String>,
    seed: u64,
    gravity: Quantity<Acceleration>,
    material: MaterialTable,
    grains: GrainsTable,
    #[serde(default)]
    contact: ContactTable,
    #[serde(rename = "box")]
    container: BoxTable,
    #[serde(default)]
    time: TimeTable,
    stage: Vec<StageTable>,
    #[serde(default)]
    output: OutputTable,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GrainsTable {
    count: usize,
    radius: Quantity<Length>,
    #[serde(default)]
    spread: f64,
    stir: Option<Quantity<Velocity>>,
}

/// Table `[contact]`: an effect that is not named does not exist.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactTable {
    /// Coulomb friction coefficient.
    pub friction: Option<f64>,
    /// Rolling friction coefficient.
    pub rolling: Option<f64>,
    /// Restitution of the elastic contact, by viscous damping.
    pub restitution: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BoxTable {
    width: Quantity<Length>,
    depth: Quantity<Length>,
}

/// Table `[time]`: how the time step follows from the stiffest contact.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TimeTable {
    /// Largest share of the Rayleigh time.
    pub rayleigh_fraction: f64,
    /// Least number of steps in the half oscillation of a grain on its stiffest contact.
    pub steps_per_contact: f64,
}

impl Default for TimeTable {
    /// Usual DEM practice: a fifth of the Rayleigh time, twenty steps a contact.
    fn default() -> Self {
        Self {
            rayleigh_fraction: 0.2,
            steps_per_contact: 20.0,
        }
    }
}

/// Table `[output]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OutputTable {
    /// Rows of `bed.csv` in a stage.
    pub rows: usize,
    /// Frames of the VTP series in a stage.
    pub frames: usize,
}

impl Default for OutputTable {
    fn default() -> Self {
        Self {
            rows: 100,
            frames: 4,
        }
    }
}

impl Scene {
    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// [`crate::Error::File`] when it cannot be read; otherwise as [`Scene::parse`].
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_document(&Document::read(path)?)
    }

    /// Checks the text of a scene file; `path` is for messages and the name.
    ///
    /// # Errors
    /// [`crate::Error::Syntax`] and [`crate::Error::Value`], naming key, what was found and what is allowed.
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        Self::from_document(&Document::new(path, text))
    }

    fn from_document(document: &Document) -> Result<Self> {
        let file: SceneFile = document.parse()?;
        let scene = Scene {
            name: document.name(),
            hash: document.hash(),
            laws: check_laws(document, file.laws)?,
            seed: file.seed,
            gravity: document.non_negative("gravity", file.gravity)?,
            material: file.material.check(document)?,
            count: file.grains.count,
            radius: document.positive("grains.radius", file.grains.radius)?,
            spread: document.check(
                "grains.spread",
                file.grains.spread,
                |s| (0.0..0.5).contains(&s),
                "must lie in [0, 0.5)",
            )?,
            stir: file
                .grains
                .stir
                .map_or(Ok(0.0), |stir| document.non_negative("grains.stir", stir))?,
            contact: file.contact.check(document)?,
            width: document.positive("box.width", file.container.width)?,
            depth: document.positive("box.depth", file.container.depth)?,
            time: file.time.check(document)?,
            stages: check_stages(document, &file.stage, &file.contact)?,
            output: file.output,
        };
        scene.check_room(document)?;
        scene.check_yield(document)?;
        Ok(scene)
    }

    /// Largest radius a grain may get, m.
    #[must_use]
    pub fn largest_radius(&self) -> f64 {
        self.radius * (1.0 + self.spread)
    }

    fn check_room(&self, document: &Document) -> Result<()> {
        if self.count == 0 {
            return Err(document.reject("grains.count", "must be at least 1"));
        }
        for (key, edge) in [("box.width", self.width), ("box.depth", self.depth)] {
            if edge < 4.0 * self.largest_radius() {
                return Err(document.reject(
                    key,
                    "must be at least two grain diameters, or no grain fits without overlap",
                ));
            }
        }
        if self.output.rows == 0 {
            return Err(document.reject("output.rows", "must be at least 1"));
        }
        Ok(())
    }

    fn check_yield(&self, document: &Document) -> Result<()> {
        for (index, law) in self.laws.iter().enumerate() {
            let elastic = law == FITTED || law == Theory::Hertz.name();
            if self.material.flow.is_none() && !elastic {
                let key = format!("laws[{index}]");
                return Err(document.reject(
                    &key,
                    "needs `material.yield_strength`; an elastic grain has the law \"hertz\" only",
                ));
            }
        }
        Ok(())
    }
}

fn check_laws(document: &Document, laws: Vec<String>) -> Result<Vec<String>> {
    if laws.is_empty() {
        return Err(document.reject("laws", "must name at least one law, e.g. [\"hertz\"]"));
    }
    for (index, law) in laws.iter().enumerate() {
        let key = format!("laws[{index}]");
        if law != FITTED && law.parse::<Theory>().is_err() {
            let names = Theory::ALL.map(Theory::name).join(", ");
            return Err(document.reject(&key, format!("must be one of {FITTED}, {names}")));
        }
        if laws[..index].contains(law) {
            return Err(document.reject(&key, "must be named once"));
        }
    }
    Ok(laws)
}

impl ContactTable {
    fn check(self, document: &Document) -> Result<Self> {
        if let Some(friction) = self.friction {
            document.check(
                "contact.friction",
                friction,
                |f| f > 0.0,
                "must be positive; leave it out for smooth grains",
            )?;
        }
        if let Some(rolling) = self.rolling {
            document.check(
                "contact.rolling",
                rolling,
                |f| f > 0.0,
                "must be positive; leave it out for free rolling",
            )?;
            if self.friction.is_none() {
                return Err(document.reject(
                    "contact.rolling",
                    "needs `contact.friction` beside it: smooth grains do not roll",
                ));
            }
        }
        if let Some(restitution) = self.restitution {
            let must = "must lie in (0, 1]; leave it out for no damping";
            document.check(
                "contact.restitution",
                restitution,
                |e| e > 0.0 && e <= 1.0,
                must,
            )?;
        }
        Ok(self)
    }
}

impl TimeTable {
    fn check(self, document: &Document) -> Result<Self> {
        document.check(
            "time.rayleigh_fraction",
            self.rayleigh_fraction,
            |f| f > 0.0 && f <= 0.5,
            "must lie in (0, 0.5], e.g. 0.2; a larger time step is unstable in a packing",
        )?;
        document.check(
            "time.steps_per_contact",
            self.steps_per_contact,
            |n| (8.0..=1e6).contains(&n),
            "must lie in [8, 1e6], e.g. 20; fewer steps cannot follow a contact",
        )?;
        Ok(self)
    }
}
