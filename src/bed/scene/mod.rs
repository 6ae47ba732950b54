//! Scene: what a bed file says, checked and in SI units.

mod body;
mod drive;
mod group;
mod material;
mod measure;
mod settings;
mod stage;
mod stages;
mod written;

pub use group::{Amount, Group, Insertion};
pub use material::{GrainMaterial, LawChoice, OWN};
pub use measure::{Measure, Orifice, Plane};
pub use settings::{ContactTable, OutputTable, TimeStep};
pub use stage::{Change, Duration, Move, RunStage, Stage, Until};

use super::bodies::{Body, Mobility, Solid};
use super::mesh::shortest_edge;
use super::room::{PISTON, Room, WALLS};
use crate::Result;
use crate::document::Document;
use crate::unit::{Length, Quantity, engineering};
use body::{BodyTable, Files, check_bodies};
use group::{GroupTable, RegionTable, check_groups};
use material::{SceneMaterialTable, check_laws, check_materials};
use measure::{MeasureTable, check_measures};
use parry3d::math::Vector;
use serde::Deserialize;
use settings::TimeTable;
use sha2::{Digest, Sha256};
use stages::{Cast, StageTable, check_stages};
use std::collections::BTreeMap;
use std::path::Path;
use written::{Gravity, OneOrMany};

/// Shortest edge of a mesh over the smallest radius.
const SHORTEST_EDGE: f64 = 0.02;

/// Name of the law that comes from a law file.
pub const FITTED: &str = "fitted";

/// A checked scene, SI units. Read with [`Scene::read`].
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Name: the file's stem.
    pub name: String,
    /// SHA-256 of the file's text and of the meshes it names, hexadecimal.
    pub hash: String,
    /// The file, to point into it.
    pub document: Document,
    /// Laws the bed is run under, side by side: [`FITTED`], a theory, or [`OWN`].
    pub laws: Vec<String>,
    /// Seed of everything random.
    pub seed: u64,
    /// Gravity, m/s2.
    pub gravity: Vector,
    /// Materials, in the order of their names.
    pub materials: Vec<GrainMaterial>,
    /// Groups of grains.
    pub groups: Vec<Group>,
    /// Effects beside the normal law.
    pub contact: ContactTable,
    /// The box, if there is one.
    pub container: Option<Container>,
    /// Block of space (m, two corners) that grains must not leave, if the scene says so.
    pub domain: Option<[Vector; 2]>,
    /// Bodies beside the box.
    pub bodies: Vec<Body>,
    /// Time step.
    pub time: TimeStep,
    /// Stages, in order.
    pub stages: Vec<Stage>,
    /// Measures.
    pub measures: Vec<Measure>,
    /// Files.
    pub output: OutputTable,
}

/// Box of a scene: walls around x in [0, width], y in [0, depth], on the floor z = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Container {
    /// Inner edge along x, m.
    pub width: f64,
    /// Inner edge along y, m.
    pub depth: f64,
    /// Height of the walls, m; what the grains need if none.
    pub height: Option<f64>,
    /// Whether a piston hangs under the rim.
    pub piston: bool,
}

/// The scene file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    laws: Option<Vec<String>>,
    seed: u64,
    gravity: Gravity,
    #[serde(default)]
    periodic: Vec<String>,
    material: Option<SceneMaterialTable>,
    #[serde(default)]
    materials: BTreeMap<String, SceneMaterialTable>,
    grains: OneOrMany<GroupTable>,
    #[serde(default)]
    contact: ContactTable,
    #[serde(rename = "box")]
    container: Option<BoxTable>,
    domain: Option<RegionTable>,
    #[serde(default)]
    body: Vec<BodyTable>,
    #[serde(default)]
    time: TimeTable,
    stage: Vec<StageTable>,
    #[serde(default)]
    measure: Vec<MeasureTable>,
    #[serde(default)]
    output: OutputTable,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BoxTable {
    width: Quantity<Length>,
    depth: Quantity<Length>,
    height: Option<Quantity<Length>>,
}

impl Scene {
    /// Reads and checks a scene file, the law files and meshes it names included.
    ///
    /// # Errors
    /// [`crate::Error::File`] when it cannot be read; otherwise as [`Scene::parse`].
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_document(&Document::read(path)?)
    }

    /// Checks the text of a scene file; `path` is for messages, the name, and the files it names.
    ///
    /// # Errors
    /// [`crate::Error::Syntax`] and [`crate::Error::Value`], naming key, what was found and what is allowed.
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        Self::from_document(&Document::new(path, text))
    }

    fn from_document(document: &Document) -> Result<Self> {
        let file: SceneFile = document.parse()?;
        if !file.periodic.is_empty() {
            let allowed = "must be left out: periodic sides are not there yet; use walls";
            return Err(document.reject("periodic", allowed));
        }
        let mut files = Files::new();
        let materials = check_materials(document, file.material, file.materials)?;
        let groups = check_groups(document, file.grains, &materials)?;
        let contact = file.contact.check(document)?;
        let reserved: Vec<&str> = WALLS.iter().copied().chain([PISTON]).collect();
        let bodies = check_bodies(document, file.body, &reserved, &mut files)?;
        let mut cast = Cast {
            contact: &contact,
            bodies: bodies.iter().map(|body| body.name.clone()).collect(),
            groups: groups.iter().map(|group| group.name.clone()).collect(),
            boxed: file.container.is_some(),
        };
        if cast.boxed {
            cast.bodies
                .extend(reserved.iter().map(|&name| name.to_owned()));
        }
        let stages = check_stages(document, file.stage, &cast)?;
        let container = match file.container {
            Some(table) => Some(table.check(document, &stages)?),
            None => None,
        };
        let scene = Scene {
            name: document.name(),
            hash: hash(document, &files),
            document: document.clone(),
            laws: check_laws(document, file.laws, &materials)?,
            seed: file.seed,
            gravity: file.gravity.check(document)?,
            materials,
            groups,
            contact,
            container,
            domain: match file.domain {
                Some(table) => Some(table.check(document, "domain")?.corners()),
                None => None,
            },
            bodies,
            time: file.time.check(document)?,
            stages,
            measures: check_measures(document, file.measure, &cast.bodies)?,
            output: file.output.check(document)?,
        };
        scene.check_room()?;
        scene.check_meshes()?;
        scene.check_materials()?;
        scene.check_moves()?;
        Ok(scene)
    }

    /// Smallest and largest radius a grain may get, m.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        let limits = self.groups.iter().map(|group| group.sizes.limits());
        limits.fold([f64::INFINITY, 0.0], |[low, high], [smallest, largest]| {
            [low.min(smallest), high.max(largest)]
        })
    }

    /// A radius of the middle, m: that of the first group.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.groups[0].sizes.typical()
    }

    /// Material of the first group.
    #[must_use]
    pub fn material(&self) -> &crate::material::Material {
        &self.materials[self.groups[0].material].material
    }

    /// Walls of the box, the piston if it is used, then the scene's own bodies.
    #[must_use]
    pub fn all_bodies(&self, room: &Room) -> Vec<Body> {
        let mut bodies = match &self.container {
            Some(container) if container.piston => room.bodies(),
            Some(_) => room.walls(),
            None => Vec::new(),
        };
        bodies.extend(self.bodies.iter().cloned());
        bodies
    }

    /// Block around the bodies that have an end and the regions grains come in through: two corners, m.
    #[must_use]
    pub fn extent(&self) -> [Vector; 2] {
        let regions = self.groups.iter().filter_map(|group| group.region);
        let bodies = self.bodies.iter().filter_map(Body::corners);
        let corners = regions.map(|region| region.corners()).chain(bodies);
        corners.fold([Vector::MAX, Vector::MIN], |[low, high], [below, above]| {
            [low.min(below), high.max(above)]
        })
    }

    fn check_room(&self) -> Result<()> {
        let document = &self.document;
        let [_, largest] = self.radii();
        let Some(container) = &self.container else {
            if let Some(group) = self.groups.iter().find(|group| group.region.is_none()) {
                let key = format!("{}.region", group.key);
                return Err(document.reject(&key, "must be there where there is no `[box]`"));
            }
            let planes = self
                .bodies
                .iter()
                .any(|body| body.solid == Solid::HalfSpace);
            if planes && self.domain.is_none() {
                let allowed = "must say which space grains must not leave: a plane has no end";
                return Err(document.reject("domain", allowed));
            }
            return Ok(());
        };
        if self.domain.is_some() {
            let allowed = "must be left out where there is a `[box]`";
            return Err(document.reject("domain", allowed));
        }
        for (key, edge) in [
            ("box.width", container.width),
            ("box.depth", container.depth),
        ] {
            if edge < 4.0 * largest {
                return Err(document.reject(
                    key,
                    "must be at least two grain diameters, or no grain fits without overlap",
                ));
            }
        }
        Ok(())
    }

    /// That no mesh has edges so short, compared with the grains, that its touched points cannot be told apart.
    fn check_meshes(&self) -> Result<()> {
        let [smallest, _] = self.radii();
        for (index, body) in self.bodies.iter().enumerate() {
            let Solid::Mesh {
                vertices,
                triangles,
            } = &body.solid
            else {
                continue;
            };
            let edge = shortest_edge(vertices, triangles);
            if edge < SHORTEST_EDGE * smallest {
                let allowed = format!(
                    "must not be so much smaller than the grains: an edge of {} against a radius of {}; merge short edges, or look at `scale`",
                    engineering(edge, "m", 2),
                    engineering(smallest, "m", 2)
                );
                return Err(self
                    .document
                    .reject(&format!("body[{index}].mesh"), allowed));
            }
        }
        Ok(())
    }

    fn check_materials(&self) -> Result<()> {
        let first = self.groups[0].material;
        match self.groups.iter().find(|group| group.material != first) {
            Some(other) => Err(self.document.reject(
                &format!("{}.material", other.key),
                "must be that of the other groups: contacts between two materials are not there yet",
            )),
            None => Ok(()),
        }
    }

    /// That bodies are told to move, or let go, only if they can.
    fn check_moves(&self) -> Result<()> {
        for (index, stage) in self.stages.iter().enumerate() {
            let Stage::Run(run) = stage else { continue };
            for (at, order) in run.moves.iter().enumerate() {
                let key = format!("stage[{index}].move[{at}]");
                let body = self.bodies.iter().find(|body| body.name == order.body);
                let held = body.is_some_and(
                    |body| matches!(body.mobility, Mobility::Free(freedom) if freedom.held),
                );
                let free = body.is_some_and(|body| matches!(body.mobility, Mobility::Free(_)));
                match order.change {
                    Change::Release if !held => {
                        let allowed = "must stand for a free body with `held = true`";
                        return Err(self.document.reject(&format!("{key}.release"), allowed));
                    }
                    Change::Drive(_) if free => {
                        let allowed =
                            "must not be told to a free body, which moves under its forces";
                        return Err(self.document.reject(&key, allowed));
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }
}

impl BoxTable {
    fn check(self, document: &Document, stages: &[Stage]) -> Result<Container> {
        let uses_piston = |stage: &Stage| match stage {
            Stage::Compress { .. } => true,
            Stage::Run(run) => {
                run.until.stress.is_some() || run.moves.iter().any(|order| order.body == PISTON)
            }
            _ => false,
        };
        Ok(Container {
            width: document.positive("box.width", self.width)?,
            depth: document.positive("box.depth", self.depth)?,
            height: match self.height {
                Some(height) => Some(document.positive("box.height", height)?),
                None => None,
            },
            piston: stages.iter().any(uses_piston),
        })
    }
}

/// Hash of all that makes the scene: its text alone, or with the files it names.
fn hash(document: &Document, files: &Files) -> String {
    if files.is_empty() {
        return document.hash();
    }
    let mut sum = Sha256::new();
    sum.update(document.text());
    for (name, bytes) in files {
        sum.update(name);
        sum.update(bytes);
    }
    sum.finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}
