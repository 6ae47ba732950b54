//! Run of a scene: one packing, then the same stages under each law, side by side.

pub(crate) mod assembly;
pub mod hand;
pub(crate) mod packing;
mod warnings;
mod watch;

use self::assembly::{Start, laws};
use self::hand::{Ready, machine};
use self::warnings::warnings;
use self::watch::Watch;
use crate::bed::filling::falls::check_falls;
use crate::bed::filling::{check_bodies, insert};
use crate::bed::measures::gauge::finding;
use crate::bed::measures::oedometer;
use crate::bed::measures::series::{self, Row};
use crate::bed::record::Record;
use crate::bed::record::oedometer as side_by_side;
use crate::bed::record::summary::{Counts, Summary};
use crate::bed::scene::{Scene, Stage};
use crate::bed::stages::time_step;
use crate::bed::stages::{Done, Run};
use crate::dem::grains::Grains;
use crate::law::{AnyLaw, LawFile};
use crate::tape::{Checkpoint, Keeper, TakenUp, VERSION};
use crate::theory::Theory;
use crate::view::film::Frame;
use crate::view::kinds::Names;
use crate::view::picture::write_picture;
use crate::view::portrait::{Cast, Portrait};
use crate::{Error, Result};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Grains up to which the laws of a scene run side by side, each on threads of its own. A step of some hundred grains is too short
/// to be shared by threads; beds of more would take too much memory at once.
const SIDE_BY_SIDE: usize = 100_000;
/// File a run under way is kept in.
const RESTART: &str = "restart.bin";

/// How to run a scene.
pub struct Options<'a> {
    /// Folder for the files.
    pub folder: &'a Path,
    /// First line of every CSV file.
    pub provenance: &'a str,
    /// Seed instead of the scene's.
    pub seed: Option<u64>,
    /// How often a run saves a checkpoint, from which the same call resumes after an interruption; never if none.
    pub checkpoint: Option<Duration>,
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
    /// Grains at the end.
    pub grains: Grains,
    /// The bed at the largest strain, or where its film shows most, for a picture.
    pub portrait: Portrait,
    pub(in crate::bed) record: Record,
}

/// A scene's run.
pub struct BedReport {
    /// Making of the packing that all laws start from, if the scene makes one.
    pub packing: Option<LawRun>,
    /// The laws, in the scene's order.
    pub laws: Vec<LawRun>,
    /// Stress, strain, coordination and dissipation of all laws: `oedometer.csv`, of a bed that is compressed.
    pub oedometer: Option<PathBuf>,
    /// Beds at the largest strain, or where their films show most, whole and cut open: `bed.png`.
    pub picture: PathBuf,
}

/// Runs a scene and writes its files; `given` is the law file beside the scene.
///
/// Call it from a worker of a rayon pool (`rayon::scope`), or every step pays for a change of threads.
///
/// # Errors
/// Before the first step [`crate::Error::Refused`] when the scene wants a fitted law and there is none, or one of
/// another material, and [`crate::Error::Value`] when grains or bodies have no room or the time step is too large;
/// then [`crate::Error::Bed`] when a bed cannot go on and [`crate::Error::File`] when a file cannot be written.
pub fn run_scene(scene: &Scene, given: Option<&LawFile>, options: &Options) -> Result<BedReport> {
    let listed = scene.laws.iter();
    let laws: Vec<Vec<AnyLaw>> = listed
        .map(|name| laws(&scene.materials, |index| scene.uses(index), name, given))
        .collect::<Result<_>>()?;
    let mut start = begin(scene, options.seed)?;
    let prepares = scene.stages.iter().any(Stage::prepares);
    let packing = match prepares {
        true => Some(pack(scene, &mut start, options)?),
        false => None,
    };
    let run = |(name, laws): (&String, Vec<AnyLaw>)| under_law(scene, name, laws, &start, options);
    let listed = scene.laws.iter().zip(laws);
    // all of them come to an end, and the first error in the scene's order is told, whichever came first
    let runs: Vec<Result<LawRun>> = if start.grains.len() <= SIDE_BY_SIDE {
        let listed: Vec<_> = listed.collect();
        listed.into_par_iter().map(run).collect()
    } else {
        listed.map(run).collect()
    };
    let runs: Vec<LawRun> = runs.into_iter().collect::<Result<_>>()?;
    let compresses = scene
        .stages
        .iter()
        .any(|stage| matches!(stage, Stage::Compress { .. }));
    let oedometer = compresses.then(|| options.folder.join("bed/oedometer.csv"));
    if let Some(path) = &oedometer {
        let series = runs.iter().map(|run| (run.law.as_str(), &run.rows[..]));
        side_by_side::write(path, options.provenance, series)?;
    }
    let picture = options.folder.join("bed/bed.png");
    let portraits: Vec<(&str, &Portrait)> = runs
        .iter()
        .map(|run| (run.law.as_str(), &run.portrait))
        .collect();
    write_picture(&picture, &portraits, &names(scene))?;
    // all is written: what an interrupted call would have gone on from is not needed any more
    for run in packing.iter().chain(&runs) {
        // the checkpoint first: what goes on from it needs its frames
        if let Some(checkpoint) = checkpoint(&run.law, options) {
            Keeper::new(&checkpoint, "").forget();
        }
        run.record.discard();
    }
    Ok(BedReport {
        packing,
        laws: runs,
        oedometer,
        picture,
    })
}

/// The scene before its first step, grains and bodies checked; `seed` in place of its own.
pub(in crate::bed) fn begin(scene: &Scene, seed: Option<u64>) -> Result<Start> {
    let (grains, feed, room) = insert(scene, seed.unwrap_or(scene.seed))?;
    time_step::check(scene)?;
    let machine = machine(scene, &room)?;
    check_bodies(scene, &feed, &grains, &machine)?;
    if let Some([free, other]) = machine.meeting() {
        let [free, other] = [free, other].map(|body| &machine.bodies()[body].name);
        let index = scene.bodies.iter().position(|body| body.name == *free);
        let key = format!("body[{}].free", index.unwrap_or(0));
        let allowed = format!(
            "must stay clear of \"{other}\": bodies meet grains only; move it, hold it, or give it a joint"
        );
        return Err(scene.document.reject(&key, allowed));
    }
    check_falls(scene, &feed, &grains, &machine)?;
    Ok(Start {
        grains,
        bodies: None,
        time: 0.0,
        feed,
        room,
    })
}

/// Makes the packing with softened elastic contacts.
pub(in crate::bed) fn pack(scene: &Scene, start: &mut Start, options: &Options) -> Result<LawRun> {
    let began = Instant::now();
    let ready = Ready::to_pack(scene, start)?;
    let mut watch = Watch::new("packing", &folder(options, "packing"), scene, options);
    let checkpoint = checkpoint("packing", options);
    let plan = format!("{} {:?} packing", scene.hash, options.seed);
    let (mut run, laws) = ready.run(scene, start, &mut watch);
    let stages: Vec<&Stage> = scene.stages.iter().filter(|s| s.prepares()).collect();
    go(&mut run, &stages, &plan, checkpoint.as_ref())?;
    start.goes_on_from(&run);
    let done = run.done();
    finish("packing", scene, (done, &laws), watch, began, options)
}

/// Runs the stages after the packing under one law.
fn under_law(
    scene: &Scene,
    name: &str,
    laws: Vec<AnyLaw>,
    start: &Start,
    options: &Options,
) -> Result<LawRun> {
    let began = Instant::now();
    let ready = Ready::under(scene, name, laws, start)?;
    let plan = format!("{} {:?} {name} {:?}", scene.hash, options.seed, ready.laws);
    let mut watch = Watch::new(name, &folder(options, name), scene, options);
    let checkpoint = checkpoint(name, options);
    let (mut run, laws) = ready.run(scene, start, &mut watch);
    let stages: Vec<&Stage> = scene.stages.iter().filter(|s| !s.prepares()).collect();
    go(&mut run, &stages, &plan, checkpoint.as_ref())?;
    let done = run.done();
    finish(name, scene, (done, &laws), watch, began, options)
}

/// Takes up what was kept of a run, and runs its stages to their end.
fn go<'a>(
    run: &mut Run<'a>,
    stages: &[&Stage],
    plan: &str,
    checkpoint: Option<&'a Checkpoint>,
) -> Result<()> {
    if let Some(checkpoint) = checkpoint {
        let path = checkpoint.path().display();
        match run.keep_by(Keeper::new(checkpoint, plan)) {
            TakenUp::Nothing => {}
            TakenUp::Run => tracing::info!("resumed at step {} from {path}", run.bed.clock().2),
            TakenUp::Other => {
                tracing::warn!("{path} is of another scene, law, seed or program: started anew");
            }
            TakenUp::Version(version) => {
                let other = format!(
                    "it is of version {version} of the restart files, this program has version {VERSION}; remove it to start anew"
                );
                let cause = std::io::Error::new(std::io::ErrorKind::InvalidData, other);
                return Err(Error::file("resume from", checkpoint.path())(cause));
            }
            TakenUp::Damaged => {
                let damaged = "it is damaged; remove it to start anew";
                let cause = std::io::Error::new(std::io::ErrorKind::InvalidData, damaged);
                return Err(Error::file("resume from", checkpoint.path())(cause));
            }
        }
    }
    run.stages(stages)
}

/// Where a run is kept, if it is.
fn checkpoint(name: &str, options: &Options) -> Option<Checkpoint> {
    let path = folder(options, name).join(RESTART);
    Some(Checkpoint::new(&path, options.checkpoint?))
}

/// Writes the files of one run.
fn finish(
    name: &str,
    scene: &Scene,
    (run, laws): (Done, &[AnyLaw]),
    watch: Watch,
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
        wall_s: run.seconds_before + began.elapsed().as_secs_f64(),
        lost: run.tally.lost,
        lost_bodies: run.tally.lost_bodies,
        outlet_grains: run.drain.total().grains,
        beyond_validity: run.tally.beyond_validity,
        below_validity: run.tally.below_validity,
        below_validity_share: run.tally.below_share(),
        max_overlap_ratio: run.tally.max_overlap_ratio,
        contact_stiffness: softening,
        settling_stiffness,
    };
    let mut summary = Summary::new(name, &run.rows, counts);
    let findings = run.gauges.iter();
    let findings = findings.flat_map(|gauge| {
        let gravity = scene.gravity.length();
        gauge.findings(run.bed.as_ref(), gravity, 2.0 * scene.radius())
    });
    let left = run.drain.by_outlet().flat_map(|(name, outflow)| {
        let count = outflow.grains as f64;
        [
            finding(format!("grains out at {name}"), count, "", ""),
            finding(format!("mass out at {name}"), outflow.mass, "kg", ""),
        ]
    });
    summary.findings = findings.chain(left).collect();
    let yields = name != Theory::Hertz.name();
    let (material, rows) = (scene.material(), &run.rows);
    summary
        .findings
        .extend(oedometer::findings(rows, material, yields));
    let names = names(scene);
    (summary.materials, summary.groups) = (names.materials, names.groups);
    summary.warnings = warnings(&run, laws);
    let folder = folder(options, name);
    series::write(&folder.join("bed.csv"), options.provenance, &run.rows)?;
    let title = format!("{}: {name}", scene.name);
    let told = format!("{} grains, {} steps", summary.grains, summary.steps);
    watch
        .record
        .finish(run.bed.as_ref(), &title, &told, &summary.warnings)?;
    summary.write(&folder)?;
    let cast = Cast::of(run.bed.as_ref());
    let shown = match watch.deepest {
        Some(deepest) => Some(deepest),
        None => watch.record.best_frame()?,
    };
    let now = || Frame::of(run.bed.as_ref(), "");
    Ok(LawRun {
        law: name.to_owned(),
        rows: run.rows,
        summary,
        grains: run.bed.grains().clone(),
        portrait: cast.at(&shown.unwrap_or_else(now)),
        record: watch.record,
    })
}

/// Names that the grains of a scene are told apart by.
fn names(scene: &Scene) -> Names {
    Names {
        materials: scene.materials.iter().map(|m| m.name.clone()).collect(),
        groups: scene.groups.iter().map(|g| g.name.clone()).collect(),
    }
}

fn folder(options: &Options, name: &str) -> PathBuf {
    options.folder.join("bed").join(name)
}
