//! Scene: what a bed file says, checked and in SI units.

pub(crate) mod region;
pub mod sizes;
pub(crate) mod stage_tables;

mod at;
mod body;
mod check;
mod container;
mod drive;
mod given;
mod group;
mod material;
mod measure;
mod outlet;
mod pair;
mod settings;
mod slips;
mod stage;
mod written;

use crate::dem::force::named::Constants;
use crate::document::keys::{Kind, Value as _, key, keys, table};
pub use container::Container;
pub use given::{Given, Place};
pub use group::{Amount, Group, Insertion};
pub use material::{GrainMaterial, LawChoice, OWN};
pub use measure::{Measure, Orifice, Plane};
pub use outlet::{Mouth, Outlet};
pub use pair::PairContact;
pub use settings::{OutputTable, TimeStep};
pub use stage::{Change, Duration, Move, RunStage, Stage, Until};

use crate::Result;
use crate::bed::scene::region::RegionTable;
use crate::dem::bodies::Body;
use crate::dem::bodies::enclosure::{PISTON, Room, WALLS};
use crate::dem::grains::periodic::Periodic;
use crate::document::Document;
use crate::files::sha256;
use body::{BodyTable, Files, check_bodies};
use container::BoxTable;
use group::{GroupTable, check_groups};
use material::{SceneMaterialTable, check_laws, check_materials};
use measure::{MeasureTable, check_measures};
use outlet::{OutletTable, Surroundings, check_outlets};
use pair::check_pairs;
use parry3d::math::Vector;
use serde::Deserialize;
use settings::{ContactTable, PairTable, TimeTable};
use stage_tables::{Cast, StageTable, check_stages};
use std::collections::BTreeMap;
use std::path::Path;
use written::{Gravity, OneOrMany};

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
    pub contact: Constants,
    /// Effects of pairs of materials.
    pub pairs: Vec<PairContact>,
    /// The box, if there is one.
    pub container: Option<Container>,
    /// Block of space (m, two corners) that grains must not leave, if the scene says so.
    pub domain: Option<[Vector; 2]>,
    /// Bodies beside the box.
    pub bodies: Vec<Body>,
    /// Where grains leave.
    pub outlets: Vec<Outlet>,
    /// Time step.
    pub time: TimeStep,
    /// Stages, in order.
    pub stages: Vec<Stage>,
    /// Measures.
    pub measures: Vec<Measure>,
    /// Files.
    pub output: OutputTable,
}

/// The scene file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    #[serde(default)]
    unusual: Vec<String>,
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
    #[serde(default)]
    pair: Vec<PairTable>,
    #[serde(rename = "box")]
    container: Option<BoxTable>,
    domain: Option<RegionTable>,
    #[serde(default)]
    body: Vec<BodyTable>,
    #[serde(default)]
    outlet: Vec<OutletTable>,
    #[serde(default)]
    time: TimeTable,
    stage: Vec<StageTable>,
    #[serde(default)]
    measure: Vec<MeasureTable>,
    #[serde(default)]
    output: OutputTable,
}

keys! {
    SceneFile {
        unusual: key("values that look like a slip of a unit and are meant all the same", "`gravity`, and numbers of materials and grains as `material.density`, `grains.radius`", "['material.density']").or("none"),
        laws: key("laws the scene is run under, one after the other from one packing", "`\"fitted\"`, `\"atlas\"` or a theory, each once", "['fitted', 'hertz']").or("every material's own `law`"),
        seed: key("of everything random", "≥ 0", "1"),
        gravity: key("along -z, or a vector", "magnitude ≥ 0", "'9.81 m/s2'"),
        periodic: key("sides of the box that are periodic instead of walls; along z without gravity along it", "`\"x\"`, `\"y\"`, `\"z\"`", "['x', 'y']").or("none"),
        material: table("the material, if there is one").or("one of the two required"),
        materials: table("the materials by name, if there are several").or("one of the two required"),
        grains: table("groups of grains"),
        contact: table("effects beside the normal law").or("no effects"),
        pair: table("effects of two materials in contact").or("none"),
        container as "box": table("a box on the floor z = 0 with a corner at the origin").or("none"),
        domain: table("block that grains must not leave; required beside a plane, refused beside a box").or("box, or block around the bodies"),
        body: table("bodies beside the box").or("none"),
        outlet: table("where grains leave").or("none"),
        time: table("time step").or("as its keys"),
        stage: table("what happens, in order").within("at least one"),
        measure: table("what is to be measured").or("none"),
        output: table("files").or("as its keys"),
    }
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

    /// Keys of a scene file.
    #[must_use]
    pub fn keys() -> Kind {
        SceneFile::kind()
    }

    fn from_document(document: &Document) -> Result<Self> {
        let file: SceneFile = document.parse()?;
        let mut files = Files::new();
        let materials = check_materials(document, file.material, file.materials)?;
        let groups = check_groups(document, file.grains, &materials, &mut files)?;
        let contact = file.contact.check(document)?;
        // without a box there is nothing else that could bear such a name
        let reserved: Vec<&str> = match file.container {
            Some(_) => standing(&file.periodic).collect(),
            None => Vec::new(),
        };
        let smallest = |radius: f64, group: &Group| radius.min(group.sizes.limits()[0]);
        let smallest = groups.iter().fold(f64::INFINITY, smallest);
        let bodies = check_bodies(
            document, file.body, &reserved, &materials, smallest, &mut files,
        )?;
        let cast = Cast {
            contact: &contact,
            bodies: names(&bodies, file.container.is_some(), &file.periodic),
            centres: bodies
                .iter()
                .map(|body| (body.name.clone(), body.centre))
                .collect(),
            groups: groups.iter().map(|group| group.name.clone()).collect(),
            boxed: file.container.is_some(),
        };
        let stages = check_stages(document, file.stage, &cast)?;
        let container = check_box(document, file.container, &stages, &file.periodic)?;
        let around = Surroundings {
            groups: &groups,
            smallest,
            periodic: container.map_or([false; 3], |box_| box_.periodic),
        };
        let outlets = check_outlets(document, file.outlet, &around)?;
        let scene = Scene {
            name: document.name(),
            hash: hash(document, &files),
            document: document.clone(),
            laws: check_laws(document, file.laws, &materials)?,
            seed: file.seed,
            gravity: file.gravity.check(document)?,
            pairs: check_pairs(document, file.pair, &materials, &contact)?,
            materials,
            groups,
            contact,
            container,
            domain: match file.domain {
                Some(table) => Some(table.check(document, "domain")?.corners()),
                None => None,
            },
            bodies,
            outlets,
            time: file.time.check(document)?,
            stages,
            measures: check_measures(document, file.measure, &cast.bodies)?,
            output: file.output.check(document)?,
        };
        slips::check(&scene, &file.unusual)?;
        scene.check_room()?;
        scene.check_regions()?;
        scene.check_moves()?;
        scene.check_pair_laws()?;
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

    /// Periodic sides.
    ///
    /// # Errors
    /// As [`Periodic::new`].
    pub fn sides(&self) -> Result<Periodic> {
        let period = self.container.map_or([None; 3], |container| {
            let edges = [
                Some(container.width),
                Some(container.depth),
                container.height,
            ];
            [0, 1, 2].map(|axis| edges[axis].filter(|_| container.periodic[axis]))
        });
        Periodic::new(Vector::ZERO, period)
    }

    /// Whether grains or bodies are of a material.
    #[must_use]
    pub fn uses(&self, material: usize) -> bool {
        let groups = self.groups.iter().map(|group| group.material);
        groups
            .chain(self.bodies.iter().filter_map(Body::flattening_material))
            .any(|used| used == material)
    }

    /// Whether contacts of more than one kind can occur: several materials, bodies that flatten too, or pairs with effects
    /// of their own.
    #[must_use]
    pub fn is_mixture(&self) -> bool {
        let first = self.groups[0].material;
        let several = self.groups.iter().any(|group| group.material != first);
        let flattening = self.bodies.iter().any(|body| body.material.is_some());
        // effects of a pair hold between grains, not on rigid bodies: two tables even for one material
        several || flattening || !self.pairs.is_empty()
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

    /// Block around the bodies that have an end and the regions grains come in and leave through: two corners, m.
    #[must_use]
    pub fn extent(&self) -> [Vector; 2] {
        let regions = self.groups.iter().filter_map(|group| group.region);
        let bodies = self.bodies.iter().filter_map(Body::corners);
        let mouths = self.outlets.iter().filter_map(|outlet| match outlet.mouth {
            Mouth::Region(region) => Some(region),
            Mouth::Beyond { .. } => None,
        });
        let regions = regions.chain(mouths).map(|region| region.corners());
        let given = self
            .groups
            .iter()
            .filter_map(|group| group.given.as_deref());
        let given = given.flat_map(|given| &given.grains).map(|grain| {
            let radius = Vector::splat(grain.radius);
            [grain.centre - radius, grain.centre + radius]
        });
        let corners = regions.chain(given).chain(bodies);
        corners.fold([Vector::MAX, Vector::MIN], |[low, high], [below, above]| {
            [low.min(below), high.max(above)]
        })
    }
}

/// Names of the bodies of a box that stand.
fn standing(periodic: &[String]) -> impl Iterator<Item = &'static str> {
    let open = |side: &str| periodic.iter().any(|axis| axis == side);
    let (x, y, z) = (open("x"), open("y"), open("z"));
    let gone = move |name: &str| match name {
        "left" | "right" => x,
        "front" | "back" => y,
        _ => z,
    };
    WALLS
        .into_iter()
        .chain([PISTON])
        .filter(move |name| !gone(name))
}

/// Names of the bodies of a scene, those of its box that stand included.
fn names(bodies: &[Body], boxed: bool, periodic: &[String]) -> Vec<String> {
    let mut names: Vec<String> = bodies.iter().map(|body| body.name.clone()).collect();
    if boxed {
        names.extend(standing(periodic).map(str::to_owned));
    }
    names
}

fn check_box(
    document: &Document,
    table: Option<BoxTable>,
    stages: &[Stage],
    periodic: &[String],
) -> Result<Option<Container>> {
    match table {
        Some(table) => Ok(Some(table.check(document, stages, periodic)?)),
        None if periodic.is_empty() => Ok(None),
        None => {
            let allowed = "needs a `[box]`, whose edges are the periods";
            Err(document.reject("periodic", allowed))
        }
    }
}

/// Hash of all that makes the scene: its text alone, or with the files it names.
fn hash(document: &Document, files: &Files) -> String {
    if files.is_empty() {
        return document.hash();
    }
    let named = files.iter();
    let named = named.flat_map(|(name, bytes)| [name.as_bytes(), bytes]);
    sha256(std::iter::once(document.text().as_bytes()).chain(named))
}
