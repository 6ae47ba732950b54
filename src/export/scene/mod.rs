//! Scene for a code that runs on many processors: its packing, walls, piston, law and stages as data file and input script.
//!
//! What is written so far is an oedometer: a box of grains of one material under one fitted law, a piston that compresses
//! and lets go. Everything else is refused by name before anything is run.

pub(crate) mod lammps;
pub(crate) mod liggghts;

use crate::bed::run::packing::Packed;
use crate::bed::scene::{Container, FITTED, LawChoice, OutputTable, Scene, Stage, TimeStep};
use crate::dem::force::damping::steps_for;
use crate::dem::force::named::Constants;
use crate::export::c::contact::filled;
use crate::export::c::kernel::number;
use crate::export::source::artifact::Artifact;
use crate::export::source::portable::Portable;
use crate::files::sha256;
use crate::law::LawFile;
use crate::law::file::plain;
use crate::{Error, Result};
use std::fmt::Write;

/// Gap over the smallest radius left between the highest grain and the piston, as in a bed.
const PISTON_GAP: f64 = 1e-3;
/// Margin of the simulation box around the walls, over the largest radius.
const MARGIN: f64 = 2.0;
/// Distance up to which neighbours are listed, over the largest radius.
const SKIN: f64 = 0.3;
/// Travel of the piston between two looks at its stress, over the height of the bed.
const LOOK: f64 = 2e-5;
/// Most steps between two looks.
const MOST_STEPS: f64 = 100.0;
/// Share of the Rayleigh time and steps a contact that the law's suggested time step stands for.
const SUGGESTED: (f64, f64) = (0.2, 20.0);
/// Power of the first loading of every fitted law, which begins as Hertz's.
const FIRST_POWER: f64 = 1.5;

/// A code whole scenes go to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// LAMMPS.
    Lammps,
    /// LIGGGHTS.
    Liggghts,
}

impl Code {
    /// Every code, in the order of messages.
    pub const ALL: [Code; 2] = [Code::Lammps, Code::Liggghts];

    /// Name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Code::Lammps => "lammps",
            Code::Liggghts => "liggghts",
        }
    }
}

impl std::str::FromStr for Code {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        Code::ALL
            .into_iter()
            .find(|code| code.name() == text)
            .ok_or_else(|| Error::not_one_of("--to", text, Code::ALL.map(Code::name)))
    }
}

/// Refuses a scene with something that is not written for other codes, naming it. Everything a scene holds is taken apart here,
/// so that what is new does not compile until it is written or refused.
///
/// # Errors
/// [`Error::Value`] with the first such thing.
pub fn check(scene: &Scene) -> Result<()> {
    let Scene {
        // written into the files
        name: _,
        hash: _,
        gravity: _,
        time:
            TimeStep {
                rayleigh_fraction: _,
                steps_per_contact: _,
                step: _,
            },
        // the packing holds what they have made
        seed: _,
        // rows are written; the rest are files of runs that are made here
        output:
            OutputTable {
                rows: _,
                frames: _,
                film: _,
                animation: _,
                contacts: _,
                dump: _,
            },
        // the groups say which one is used
        materials: _,
        document,
        laws,
        groups,
        contact,
        pairs,
        container,
        domain,
        bodies,
        outlets,
        stages,
        measures,
    } = scene;
    let refuse = |key: &str, allowed: &str| Err(document.reject(key, allowed));
    let Some(container) = container else {
        return refuse("box", "must be there: only beds in a box are exported");
    };
    check_container(scene, container)?;
    if domain.is_some() {
        return refuse("domain", "must be left out: a domain is not exported");
    }
    if !bodies.is_empty() {
        return refuse(
            "body[0]",
            "must be left out: only the walls and the piston of the box are exported",
        );
    }
    if !outlets.is_empty() {
        return refuse("outlet[0]", "must be left out: outlets are not exported");
    }
    if !measures.is_empty() {
        return refuse("measure[0]", "must be left out: measures are not exported");
    }
    let material = groups[0].material;
    if let Some(other) = groups.iter().find(|group| group.material != material) {
        return refuse(
            &format!("{}.material", other.key),
            "must be that of the other groups: an export holds one law",
        );
    }
    if !pairs.is_empty() {
        return refuse(
            "pair[0]",
            "must be left out: an export has the effects of `[contact]` for all contacts",
        );
    }
    check_contact(scene, contact)?;
    if !laws.iter().any(|law| law == FITTED) {
        return refuse(
            "laws",
            "must hold \"fitted\": that is the law which is exported",
        );
    }
    for (index, stage) in stages.iter().enumerate() {
        if let Stage::Run(_) = stage {
            return refuse(
                &format!("stage[{index}].kind"),
                "must be \"compress\" or \"unload\" once the packing is made: other stages are not exported",
            );
        }
    }
    if !stages
        .iter()
        .any(|stage| matches!(stage, Stage::Compress { .. }))
    {
        return refuse(
            "stage",
            "must hold a stage \"compress\": without it the piston does nothing",
        );
    }
    Ok(())
}

/// What of a box is not written.
fn check_container(scene: &Scene, container: &Container) -> Result<()> {
    let Container {
        width: _,
        depth: _,
        height: _,
        // the stages that are written need it
        piston: _,
        periodic,
    } = container;
    if periodic.contains(&true) {
        let allowed = "must be left out: sides of the box are exported as walls";
        return Err(scene.document.reject("periodic", allowed));
    }
    Ok(())
}

/// What of the contacts is not written; the codes take the effects apart themselves.
fn check_contact(scene: &Scene, contact: &Constants) -> Result<()> {
    let Constants {
        restitution: _,
        friction: _,
        rolling: _,
        stiffness,
    } = contact;
    if stiffness.is_some_and(|stiffness| stiffness != 1.0) {
        let allowed = "must be left out: an exported law has its own stiffness";
        return Err(scene.document.reject("contact.stiffness", allowed));
    }
    Ok(())
}

/// The law a scene calls fitted, ready for export; `given` is the law file beside the scene.
///
/// # Errors
/// [`Error::Refused`] when there is none for the scene's material.
pub fn law(scene: &Scene, given: Option<&LawFile>) -> Result<Portable> {
    let material = &scene.materials[scene.groups[0].material];
    material.law_in(FITTED, given)?;
    let of_this = given.filter(|file| file.material() == material.material);
    let file = match &material.law {
        LawChoice::File(file) => Some(of_this.unwrap_or(file)),
        _ => of_this,
    };
    let Some(file) = file else {
        return Err(scene
            .document
            .reject(&format!("{}.law", material.key), "must name a law file"));
    };
    Portable::new(file.clone(), None, sha256([file.text()?]))
}

/// Files of a scene for a code, law included, in a folder of the code's name.
///
/// # Errors
/// Those of [`check`]; [`Error::Value`] when grains of the scene have not come in.
pub fn export(scene: &Scene, law: &Portable, packed: &Packed, code: Code) -> Result<Vec<Artifact>> {
    check(scene)?;
    if !packed.complete {
        let allowed = "must all have come in when the packing is made";
        return Err(scene.document.reject("grains", allowed));
    }
    let Some(container) = scene.container else {
        return Err(scene.document.reject("box", "must be there"));
    };
    let bed = Bed {
        scene,
        law,
        packed,
        container,
    };
    Ok(match code {
        Code::Lammps => lammps::export(&bed),
        Code::Liggghts => liggghts::export(&bed),
    })
}

/// A scene with its packing and law.
pub(crate) struct Bed<'a> {
    scene: &'a Scene,
    law: &'a Portable,
    packed: &'a Packed,
    container: Container,
}

impl Bed<'_> {
    /// Height of the piston's face before it moves, m.
    fn face(&self) -> f64 {
        let spheres = &self.packed.grains.spheres;
        let tops = spheres.iter().map(|sphere| sphere.centre.z + sphere.radius);
        tops.fold(0.0, f64::max) + PISTON_GAP * self.packed.grains.smallest_radius()
    }

    /// Time step, s: the scene's own, or what the law suggests for the smallest grain.
    fn time_step(&self) -> f64 {
        let time = &self.scene.time;
        let steps = time.steps_per_contact.unwrap_or_else(|| {
            let restitution = self.scene.contact.restitution.unwrap_or(1.0);
            steps_for(restitution, FIRST_POWER)
        });
        let careful = (time.rayleigh_fraction / SUGGESTED.0)
            .min(SUGGESTED.1 / steps)
            .min(1.0);
        let suggested = self.law.time_step_over_radius * self.packed.grains.smallest_radius();
        time.step.unwrap_or(careful * suggested)
    }

    /// Steps between two rows: those of the first compression over the rows of a stage.
    fn row_steps(&self) -> f64 {
        let duration = self.scene.stages.iter().find_map(|stage| match stage {
            Stage::Compress { speed, strain, .. } => Some(1.2 * strain * self.face() / speed),
            _ => None,
        });
        let steps = duration.unwrap_or(0.0) / self.time_step();
        (steps / self.scene.output.rows as f64).round().max(1.0)
    }

    /// The packing as a data file that both codes read.
    fn data(&self) -> Artifact {
        let grains = &self.packed.grains;
        let margin = MARGIN * grains.largest_radius();
        let edges = [
            ("x", self.container.width),
            ("y", self.container.depth),
            ("z", self.packed.room.height),
        ];
        let mut text = format!(
            "Packing of the scene \"{}\": id type diameter density x y z, SI\n\n{} atoms\n1 atom types\n\n",
            plain(&self.scene.name),
            grains.len()
        );
        for (axis, edge) in edges {
            let _ = writeln!(text, "{:e} {:e} {axis}lo {axis}hi", -margin, edge + margin);
        }
        let density = self.law.material().density;
        text.push_str("\nAtoms\n\n");
        for (index, sphere) in grains.spheres.iter().enumerate() {
            let [x, y, z] = sphere.centre.to_array();
            let diameter = 2.0 * sphere.radius;
            let _ = writeln!(
                text,
                "{} 1 {diameter:e} {density:e} {x:e} {y:e} {z:e}",
                index + 1
            );
        }
        text.push_str("\nVelocities\n\n");
        for (index, (motion, spin)) in grains.motions.iter().zip(&grains.spins).enumerate() {
            let [x, y, z] = motion.velocity.to_array();
            let [a, b, c] = spin.rate.to_array();
            let _ = writeln!(text, "{} {x:e} {y:e} {z:e} {a:e} {b:e} {c:e}", index + 1);
        }
        Artifact {
            name: "scene.data".to_owned(),
            text,
        }
    }

    /// A part of a script with the scene's numbers in it.
    fn fill(&self, part: &str, more: &[(&str, String)]) -> String {
        let gravity = self.scene.gravity;
        let direction = gravity
            .try_normalize()
            .unwrap_or(parry3d::math::Vector::NEG_Z);
        let common = [
            ("@SCENE@", plain(&self.scene.name)),
            ("@HASH@", self.scene.hash.clone()),
            ("@PROGRAM@", crate::PROGRAM.to_owned()),
            ("@DT@", number(self.time_step())),
            ("@ROWS@", format!("{}", self.row_steps())),
            ("@SKIN@", number(SKIN * self.packed.grains.largest_radius())),
            ("@WIDTH@", number(self.container.width)),
            ("@DEPTH@", number(self.container.depth)),
            (
                "@AREA@",
                number(self.container.width * self.container.depth),
            ),
            ("@FACE@", number(self.face())),
            (
                "@GRAVITY@",
                format!(
                    "{:e} vector {:e} {:e} {:e}",
                    gravity.length(),
                    direction.x,
                    direction.y,
                    direction.z
                ),
            ),
        ];
        let words = more.iter().chain(&common);
        let text = words.fold(part.to_owned(), |text, (word, value)| {
            text.replace(word, value)
        });
        filled(&text, self.law)
    }

    /// The stages after the packing, each by the parts of a code.
    fn stages(&self, parts: &Parts) -> String {
        let mut text = String::new();
        let mut seated = false;
        for (k, stage) in self.scene.stages.iter().enumerate() {
            let words = |velocity: f64, more: &[(&'static str, f64)]| -> Vec<(&str, String)> {
                let look = LOOK * self.face() / (velocity.abs() * self.time_step());
                let mut words = vec![
                    ("@K@", k.to_string()),
                    ("@STAGE@", plain(stage.name())),
                    ("@VELOCITY@", format!("{velocity:e}")),
                    ("@CHECK@", format!("{:.0}", look.clamp(1.0, MOST_STEPS))),
                ];
                words.extend(
                    more.iter()
                        .map(|(word, value)| (*word, format!("{value:e}"))),
                );
                words
            };
            match *stage {
                Stage::Compress {
                    speed,
                    approach,
                    seating_stress,
                    seating_travel,
                    strain,
                } => {
                    let more = [
                        ("@SEATING@", seating_stress),
                        ("@TRAVEL@", seating_travel),
                        ("@STRAIN@", strain),
                    ];
                    if !seated && approach > speed {
                        for part in [parts.drive, NEAR, parts.turn] {
                            text.push_str(&self.fill(part, &words(-approach, &more)));
                        }
                    }
                    let words = words(-speed, &more);
                    let seat = if seated { "" } else { parts.seat };
                    seated = true;
                    for part in [parts.drive, seat, COMPRESS, parts.end] {
                        text.push_str(&self.fill(part, &words));
                    }
                }
                Stage::Unload { speed } => {
                    for part in [parts.drive, UNLOAD, parts.end] {
                        text.push_str(&self.fill(part, &words(speed, &[])));
                    }
                }
                Stage::Settle { .. } | Stage::Relax { .. } | Stage::Run(_) => {}
            }
        }
        text
    }
}

const COMPRESS: &str = include_str!("compress.in");
const NEAR: &str = include_str!("approach.in");
const UNLOAD: &str = include_str!("unload.in");

/// What a code says at the beginning of a stage, until the piston is seated, and at the end.
struct Parts {
    drive: &'static str,
    /// Between two velocities of the piston within a stage.
    turn: &'static str,
    seat: &'static str,
    end: &'static str,
}
