//! Run of a scene: one packing, then the same stages under each law, side by side.

use super::compose::{AnyBed, Effects, NormalsOf, build};
use super::feed::Feed;
use super::grains::Grains;
use super::insertion::{check_bodies, insert};
use super::machine::{BodyState, Machine};
use super::output::{Counts, Frames, Summary};
use super::protocol::{Observer, Run};
use super::render::write_picture;
use super::room::Room;
use super::row::Row;
use super::scene::{Scene, Stage};
use super::step::{Normals, Parts};
use super::time_step::{self, Limits};
use crate::Result;
use crate::contact::LawVisitor;
use crate::files::write_rows;
use crate::law::{AnyLaw, LawFile};
use crate::theory::hertz::Hertz;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Distance up to which neighbours are listed, over the largest radius: the best of a scan between lists that are
/// short and lists that last.
const SKIN: f64 = 0.15;
/// Overlap over diameter above which a warning is given: contacts of one grain are then no longer apart.
const DEEP: f64 = 0.05;

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
    /// The bed at the largest strain, or at the end, for a picture.
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
    /// Making of the packing that all laws start from, if the scene makes one.
    pub packing: Option<LawRun>,
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
    stage: &'a str,
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

/// Where all laws start from.
struct Start {
    grains: Grains,
    bodies: Option<Vec<BodyState>>,
    time: f64,
    feed: Feed,
    room: Room,
}

/// Runs a scene and writes its files; `given` is the law file beside the scene.
///
/// Call it from a worker of a rayon pool (`rayon::scope`), or every step pays for a change of threads.
///
/// # Errors
/// Before the first step [`crate::Error::Argument`] when the scene wants a fitted law and there is none, or one of
/// another material, and [`crate::Error::Value`] when grains or bodies have no room or the time step is too large;
/// then [`crate::Error::Bed`] when a bed cannot go on and [`crate::Error::File`] when a file cannot be written.
pub fn run_scene(scene: &Scene, given: Option<&LawFile>, options: &Options) -> Result<BedReport> {
    let (grains, feed, room) = insert(scene, options.seed.unwrap_or(scene.seed))?;
    let laws = laws(scene, given)?;
    time_step::check(scene)?;
    check_bodies(scene, &grains, &machine(scene, &room)?)?;
    let mut start = Start {
        grains,
        bodies: None,
        time: 0.0,
        feed,
        room,
    };
    let prepares = scene.stages.iter().any(Stage::prepares);
    let packing = match prepares {
        true => Some(pack(scene, &mut start, options)?),
        false => None,
    };
    let mut runs = Vec::new();
    for (name, law) in scene.laws.iter().zip(&laws) {
        runs.push(under_law(scene, name, law, &start, options)?);
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
        laws: runs,
        oedometer,
        picture,
    })
}

/// Laws of the runs, refused before the first step if one cannot be had.
fn laws(scene: &Scene, given: Option<&LawFile>) -> Result<Vec<AnyLaw>> {
    let material = &scene.materials[scene.groups[0].material];
    let names = scene.laws.iter();
    names.map(|name| material.law_in(name, given)).collect()
}

fn oedometer_row<'a>(law: &'a str, row: &'a Row) -> OedometerRow<'a> {
    OedometerRow {
        law,
        stage: &row.stage,
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

fn machine(scene: &Scene, room: &Room) -> Result<Machine> {
    Machine::new(scene.all_bodies(room), scene.gravity, scene.radius())
}

/// Bed as it is at the start.
fn bed(
    scene: &Scene,
    start: &Start,
    normals: Normals,
    effects: &Effects,
) -> Result<Box<dyn AnyBed>> {
    let mut machine = machine(scene, &start.room)?;
    if let Some(bodies) = &start.bodies {
        machine.restore(bodies, start.time);
    }
    let mut grains = start.grains.clone();
    grains.plastic.fill(0.0);
    let parts = Parts {
        grains,
        machine,
        gravity: scene.gravity,
        dt: Limits::of(scene).rayleigh(1.0),
        skin: SKIN * scene.radii()[1],
    };
    let mut bed = build(normals, effects, parts);
    bed.soften(scene.contact.softening());
    Ok(bed)
}

fn normals(scene: &Scene) -> NormalsOf {
    let [smallest, largest] = scene.radii();
    NormalsOf {
        monodisperse: smallest == largest,
    }
}

/// Makes the packing with softened elastic contacts.
fn pack(scene: &Scene, start: &mut Start, options: &Options) -> Result<LawRun> {
    let began = Instant::now();
    let contact = scene.stages.iter().find_map(|stage| match stage {
        Stage::Settle { contact, .. } => Some(*contact),
        _ => None,
    });
    let effects = Effects::of(&contact.unwrap_or(scene.contact), scene.material());
    let law = normals(scene).visit(&Hertz::of(scene.material()));
    let bed = bed(scene, start, law, &effects)?;
    let mut observer = Watch::new("packing", scene, options);
    let mut run = Run::new(bed, scene, start.room, start.feed.clone(), &mut observer);
    for stage in scene.stages.iter().filter(|stage| stage.prepares()) {
        run.stage(stage)?;
    }
    start.grains = run.bed.grains().clone();
    start.bodies = Some(run.bed.machine().state());
    start.time = run.bed.clock().1;
    start.feed = run.feed.clone();
    start.feed.restart_clock(start.time);
    let portrait = portrait(run.bed.as_ref(), start.room, start.room.height);
    finish("packing", scene, run, portrait, began, options)
}

/// Runs the stages after the packing under one law.
fn under_law(
    scene: &Scene,
    name: &str,
    law: &AnyLaw,
    start: &Start,
    options: &Options,
) -> Result<LawRun> {
    let began = Instant::now();
    let normals = law.visit(normals(scene))?;
    let effects = Effects::of(&scene.contact, scene.material());
    let bed = bed(scene, start, normals, &effects)?;
    let mut observer = Watch::new(name, scene, options);
    let mut run = Run::new(bed, scene, start.room, start.feed.clone(), &mut observer);
    let mut deepest = None;
    for stage in scene.stages.iter().filter(|stage| !stage.prepares()) {
        run.stage(stage)?;
        if matches!(stage, Stage::Compress { .. }) {
            let face = run
                .rows
                .last()
                .map_or(start.room.height, |row| row.height_m);
            deepest = Some(portrait(run.bed.as_ref(), start.room, face));
        }
    }
    let portrait =
        deepest.unwrap_or_else(|| portrait(run.bed.as_ref(), start.room, start.room.height));
    finish(name, scene, run, portrait, began, options)
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
    run: Run,
    portrait: Portrait,
    began: Instant,
    options: &Options,
) -> Result<LawRun> {
    let softening = scene.contact.softening();
    let settling_stiffness =
        scene
            .stages
            .iter()
            .fold(softening, |softest: f64, stage| match stage {
                Stage::Settle { stiffness, .. } => softest.min(*stiffness),
                _ => softest,
            });
    let counts = Counts {
        grains: run.bed.grains().len(),
        steps: run.bed.clock().2,
        particle_steps: run.tally.particle_steps,
        wall_s: began.elapsed().as_secs_f64(),
        lost: run.tally.lost,
        beyond_validity: run.tally.beyond_validity,
        max_overlap_ratio: run.tally.max_overlap_ratio,
        contact_stiffness: softening,
        settling_stiffness,
    };
    let mut summary = Summary::new(name, &run.rows, counts);
    let findings = run.gauges.iter();
    let findings = findings.flat_map(|gauge| gauge.findings(run.bed.as_ref(), scene));
    summary.findings = findings.collect();
    summary.warnings = warnings(scene, &run);
    let folder = folder(options, name);
    write_rows(&folder.join("bed.csv"), options.provenance, &run.rows)?;
    summary.write(&folder)?;
    Ok(LawRun {
        law: name.to_owned(),
        rows: run.rows,
        summary,
        portrait,
    })
}

/// What a user must know before the figures are used.
fn warnings(scene: &Scene, run: &Run) -> Vec<String> {
    let (tally, mut warnings) = (&run.tally, Vec::new());
    if tally.lost > 0 {
        warnings.push(format!(
            "{} grains were outside the room; they are still listed in the files",
            tally.lost
        ));
    }
    if tally.beyond_validity > 0 {
        warnings.push(format!(
            "{} contacts at once were flattened beyond the range of the law: it was extrapolated",
            tally.beyond_validity
        ));
    }
    if tally.max_overlap_ratio > DEEP {
        warnings.push(format!(
            "grains overlapped by up to {:.1} % of a diameter: contacts influence each other there",
            100.0 * tally.max_overlap_ratio
        ));
    }
    if !run.feed.is_done(scene) {
        warnings.push("not all grains came in".to_owned());
    }
    warnings
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
