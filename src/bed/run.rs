//! Run of a scene: one packing, then the same stages under each law, side by side.

use super::compose::{AnyBed, Effects, NormalsOf, build};
use super::grains::Grains;
use super::insertion::{Room, insert};
use super::machine::{BodyState, Machine};
use super::output::{Counts, Frames, Summary};
use super::protocol::{Observer, Run};
use super::render::write_picture;
use super::row::Row;
use super::scene::{FITTED, Scene};
use super::stage::Stage;
use super::step::Parts;
use super::time_step;
use crate::contact::LawVisitor;
use crate::files::write_rows;
use crate::law::{AnyLaw, LawFile};
use crate::theory::hertz::Hertz;
use crate::{Error, Result};
use parry3d::math::Vector;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Distance up to which neighbours are listed, over the largest radius: the best of a scan between lists that are
/// short and lists that last.
const SKIN: f64 = 0.15;

/// How to run a scene.
pub struct Options<'a> {
    /// Folder for the files.
    pub folder: &'a Path,
    /// First line of every CSV file.
    pub provenance: &'a str,
    /// Seed instead of the scene's.
    pub seed: Option<u64>,
    /// Told what is being run, and of every row.
    pub progress: &'a (dyn Fn(&str, &Row) + Sync),
}

/// One law's run.
pub struct LawRun {
    /// Name in the scene.
    pub law: String,
    /// Time series.
    pub rows: Vec<Row>,
    /// Figures.
    pub summary: Summary,
    /// The bed at the largest strain, for a picture.
    pub portrait: Portrait,
}

/// What a picture of a bed needs.
#[derive(Debug, Clone)]
pub struct Portrait {
    /// Grains.
    pub grains: Grains,
    /// Energy dissipated by plastic flow in the contacts of each grain, J.
    pub plastic: Vec<f64>,
    /// Sum of the contact forces on each grain, as magnitudes, N.
    pub squeeze: Vec<f64>,
    /// The box.
    pub room: Room,
    /// Height of the piston's face, m.
    pub face: f64,
}

/// A scene's run.
pub struct BedReport {
    /// Making of the packing.
    pub packing: Vec<Row>,
    /// Figures of the making.
    pub packing_summary: Summary,
    /// The laws, in the scene's order.
    pub laws: Vec<LawRun>,
    /// Stress, strain, coordination and dissipation of all laws: `oedometer.csv`.
    pub oedometer: PathBuf,
    /// Beds at the largest strain, side by side: `bed.png`.
    pub picture: PathBuf,
}

/// Row of `oedometer.csv`.
#[derive(Serialize)]
struct OedometerRow<'a> {
    law: &'a str,
    stage: &'static str,
    strain: f64,
    #[serde(rename = "stress_Pa")]
    stress_pa: f64,
    #[serde(rename = "lateral_stress_Pa")]
    lateral_stress_pa: f64,
    coordination: f64,
    solid_fraction: f64,
    #[serde(rename = "plastic_J")]
    plastic_j: f64,
    #[serde(rename = "friction_J")]
    friction_j: f64,
    #[serde(rename = "damping_J")]
    damping_j: f64,
    #[serde(rename = "driven_work_J")]
    driven_work_j: f64,
}

/// The packing all laws start from.
struct Packed {
    grains: Grains,
    bodies: Vec<BodyState>,
    room: Room,
}

/// Runs a scene and writes its files; `fitted` is the law file behind the name [`FITTED`].
///
/// Call it from a worker of a rayon pool (`rayon::scope`), or every step pays for a change of threads.
///
/// # Errors
/// [`Error::Argument`] when the scene wants a fitted law and there is none, or one of another material;
/// [`Error::Bed`] when a bed cannot go on; [`Error::File`] when a file cannot be written.
pub fn run_scene(scene: &Scene, fitted: Option<&LawFile>, options: &Options) -> Result<BedReport> {
    let (grains, room) = insert(scene, options.seed.unwrap_or(scene.seed));
    let laws = laws(scene, fitted)?;
    let (packed, packing, packing_summary) = pack(scene, grains, room, options)?;
    let mut runs = Vec::new();
    for (name, law) in scene.laws.iter().zip(&laws) {
        runs.push(compress(scene, name, law, &packed, options)?);
    }
    let oedometer = options.folder.join("bed/oedometer.csv");
    let rows: Vec<OedometerRow> = runs
        .iter()
        .flat_map(|run| run.rows.iter().map(|row| oedometer_row(&run.law, row)))
        .collect();
    write_rows(&oedometer, options.provenance, &rows)?;
    let picture = options.folder.join("bed/bed.png");
    let portraits: Vec<(&str, &Portrait)> = runs
        .iter()
        .map(|run| (run.law.as_str(), &run.portrait))
        .collect();
    write_picture(&picture, &portraits)?;
    Ok(BedReport {
        packing,
        packing_summary,
        laws: runs,
        oedometer,
        picture,
    })
}

/// Laws of a scene by name, refused before the first step if one cannot be had.
fn laws(scene: &Scene, fitted: Option<&LawFile>) -> Result<Vec<AnyLaw>> {
    let wanted = scene.laws.iter().any(|law| law == FITTED);
    let refuse = |found: &str, allowed: &str| Error::Argument {
        argument: "--law".to_owned(),
        found: found.to_owned(),
        allowed: format!(
            "{allowed}: the scene `{}` asks for the law \"{FITTED}\"",
            scene.name
        ),
    };
    match fitted {
        None if wanted => return Err(refuse("nothing", "must name a law file")),
        Some(file) if wanted && file.material() != scene.material => {
            return Err(refuse(
                "a law of another material",
                "must name a law file of the scene's `[material]`",
            ));
        }
        _ => {}
    }
    scene
        .laws
        .iter()
        .map(|name| AnyLaw::named(name, fitted, &scene.material))
        .collect()
}

fn oedometer_row<'a>(law: &'a str, row: &Row) -> OedometerRow<'a> {
    OedometerRow {
        law,
        stage: row.stage,
        strain: row.strain,
        stress_pa: row.stress_pa,
        lateral_stress_pa: row.lateral_stress_pa,
        coordination: row.coordination,
        solid_fraction: row.solid_fraction,
        plastic_j: row.plastic_j,
        friction_j: row.friction_j,
        damping_j: row.damping_j,
        driven_work_j: row.driven_work_j,
    }
}

fn parts(scene: &Scene, grains: Grains, room: &Room) -> Result<Parts> {
    let gravity = Vector::new(0.0, 0.0, -scene.gravity);
    let skin = SKIN * grains.largest_radius();
    let dt = time_step::largest(
        &scene.time,
        &scene.material,
        grains.smallest_radius(),
        1.0,
        f64::INFINITY,
    );
    Ok(Parts {
        grains,
        machine: Machine::new(room.bodies(), gravity, scene.radius)?,
        gravity,
        dt,
        skin,
    })
}

/// Makes the packing with softened elastic contacts.
fn pack(
    scene: &Scene,
    grains: Grains,
    room: Room,
    options: &Options,
) -> Result<(Packed, Vec<Row>, Summary)> {
    let began = Instant::now();
    let parts = parts(scene, grains, &room)?;
    let normals = NormalsOf {
        grains: &parts.grains,
    }
    .visit(&Hertz::of(&scene.material));
    let contact = scene.stages.iter().find_map(|stage| match stage {
        Stage::Settle { contact, .. } => Some(*contact),
        _ => None,
    });
    let effects = Effects::of(&contact.unwrap_or(scene.contact), &scene.material);
    let bed = build(normals, &effects, parts);
    let mut observer = Watch::new("packing", scene, options);
    let mut run = Run::new(bed, scene, room, &mut observer);
    for stage in scene.stages.iter().filter(|stage| stage.prepares()) {
        run.stage(stage)?;
    }
    let packed = Packed {
        grains: run.bed.grains().clone(),
        bodies: run.bed.machine().state(),
        room,
    };
    let summary = finish("packing", scene, &run, began, options)?;
    Ok((packed, run.rows, summary))
}

/// Compresses the packing under one law.
fn compress(
    scene: &Scene,
    name: &str,
    law: &AnyLaw,
    packed: &Packed,
    options: &Options,
) -> Result<LawRun> {
    let began = Instant::now();
    let mut parts = parts(scene, packed.grains.clone(), &packed.room)?;
    parts.grains.plastic.fill(0.0);
    parts.machine.restore(&packed.bodies);
    let normals = law.visit(NormalsOf {
        grains: &parts.grains,
    })?;
    let bed = build(
        normals,
        &Effects::of(&scene.contact, &scene.material),
        parts,
    );
    let mut observer = Watch::new(name, scene, options);
    let mut run = Run::new(bed, scene, packed.room, &mut observer);
    let mut portrait = portrait(run.bed.as_ref(), packed.room, packed.room.height);
    for stage in scene.stages.iter().filter(|stage| !stage.prepares()) {
        run.stage(stage)?;
        if matches!(stage, Stage::Compress { .. }) {
            let face = run
                .rows
                .last()
                .map_or(packed.room.height, |row| row.height_m);
            portrait = self::portrait(run.bed.as_ref(), packed.room, face);
        }
    }
    let summary = finish(name, scene, &run, began, options)?;
    Ok(LawRun {
        law: name.to_owned(),
        rows: run.rows,
        summary,
        portrait,
    })
}

fn portrait(bed: &dyn AnyBed, room: Room, face: f64) -> Portrait {
    Portrait {
        grains: bed.grains().clone(),
        plastic: bed.plastic_by_grain(),
        squeeze: bed.squeeze(),
        room,
        face,
    }
}

/// Writes the files of one run.
fn finish(
    name: &str,
    scene: &Scene,
    run: &Run,
    began: Instant,
    options: &Options,
) -> Result<Summary> {
    let settling_stiffness = scene
        .stages
        .iter()
        .fold(1.0, |softest: f64, stage| match stage {
            Stage::Settle { stiffness, .. } => softest.min(*stiffness),
            _ => softest,
        });
    let counts = Counts {
        grains: run.bed.grains().len(),
        steps: run.bed.clock().2,
        wall_s: began.elapsed().as_secs_f64(),
        lost: run.lost,
        beyond_validity: run.beyond_validity,
        max_overlap_ratio: run.max_overlap_ratio,
        settling_stiffness,
    };
    let summary = Summary::new(name, &run.rows, counts);
    let folder = folder(options, name);
    write_rows(&folder.join("bed.csv"), options.provenance, &run.rows)?;
    summary.write(&folder)?;
    Ok(summary)
}

fn folder(options: &Options, name: &str) -> PathBuf {
    options.folder.join("bed").join(name)
}

/// Passes rows on to the frames and to the progress shown.
struct Watch<'a> {
    name: String,
    frames: Frames,
    progress: &'a (dyn Fn(&str, &Row) + Sync),
}

impl<'a> Watch<'a> {
    fn new(name: &str, scene: &Scene, options: &Options<'a>) -> Self {
        let frames = Frames::new(
            &folder(options, name).join("vtp"),
            scene.output.rows,
            scene.output.frames,
        );
        Self {
            name: name.to_owned(),
            frames,
            progress: options.progress,
        }
    }
}

impl Observer for Watch<'_> {
    fn row(&mut self, bed: &dyn AnyBed, row: &Row) -> Result<()> {
        (self.progress)(&self.name, row);
        self.frames.row(bed, row)
    }
}
