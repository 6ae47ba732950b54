//! Bed in hand: a scene under one law, step by step as its caller asks for them, with the bits of a whole run.

use crate::bed::filling::drain::Drain;
use crate::bed::measures::series::Row;
use crate::bed::run::assembly::{Recipe, Start, assemble, elastic, laws, pair_laws};
use crate::bed::run::begin;
use crate::bed::scene::{Scene, Stage};
use crate::bed::stages::time_step;
use crate::bed::stages::{Observer, Run, Terms};
use crate::dem::bodies::enclosure::Room;
use crate::dem::bodies::machine::Machine;
use crate::dem::dynamics::Parts;
use crate::dem::dynamics::any::AnyBed;
use crate::dem::force::damping::USUAL_STEPS;
use crate::dem::force::named::Constants;
use crate::law::{AnyLaw, LawFile};
use crate::{Error, Result};

/// Distance up to which neighbours are listed, over the largest radius: the best of a scan between lists that are
/// short and lists that last.
const SKIN: f64 = 0.15;

/// Bodies of a scene in their room.
pub(in crate::bed) fn machine(scene: &Scene, room: &Room) -> Result<Machine> {
    Machine::new(scene.all_bodies(room), scene.gravity, scene.radius())
}

/// What the bed of a scene is made of where it starts.
fn parts(scene: &Scene, start: &Start) -> Result<Parts> {
    let mut machine = machine(scene, &start.room)?;
    if let Some(bodies) = &start.bodies {
        machine.restore(bodies, start.time);
    }
    let mut grains = start.grains.clone();
    grains.plastic.fill(0.0);
    grains.plastic_gone = 0.0;
    Ok(Parts {
        grains,
        machine,
        gravity: scene.gravity,
        dt: Terms::of(scene, USUAL_STEPS).limits.rayleigh(1.0),
        skin: SKIN * scene.radii()[1],
    })
}

/// How the contacts of a scene are made up under `laws`, pairs of materials left out.
fn recipe<'a>(scene: &'a Scene, laws: Vec<AnyLaw>, contact: &'a Constants) -> Recipe<'a> {
    let [smallest, largest] = scene.radii();
    Recipe {
        materials: &scene.materials,
        laws,
        contact,
        pairs: &[],
        pair_laws: Vec::new(),
        is_mixture: scene.is_mixture(),
        material: scene.groups[0].material,
        monodisperse: smallest == largest,
        softening: scene.contact.softening(),
    }
}

impl Start {
    /// Goes on where the packing that `run` has made ends.
    pub(in crate::bed) fn goes_on_from(&mut self, run: &Run) {
        self.grains = run.bed.grains().clone();
        self.bodies = Some(run.bed.machine().state());
        self.time = run.bed.clock().1;
        self.feed = run.feed.clone();
        self.feed.restart_clock(self.time);
    }
}

/// A bed that stages can be run on.
pub(in crate::bed) struct Ready {
    bed: Box<dyn AnyBed>,
    terms: Terms,
    /// Law of each material, then those of pairs of materials.
    pub(in crate::bed) laws: Vec<AnyLaw>,
}

impl Ready {
    /// For the stages that make the packing, with softened elastic contacts.
    pub(in crate::bed) fn to_pack(scene: &Scene, start: &Start) -> Result<Self> {
        let contact = scene.stages.iter().find_map(|stage| match stage {
            Stage::Settle { contact, .. } => Some(*contact),
            _ => None,
        });
        let contact = contact.unwrap_or(scene.contact);
        let recipe = recipe(scene, elastic(&scene.materials), &contact);
        Ok(Self {
            bed: assemble(&recipe, parts(scene, start)?)?,
            // how fast a packing settles is a means: the usual steps do
            terms: Terms::of(scene, USUAL_STEPS),
            laws: recipe.laws,
        })
    }

    /// For the stages after the packing, under one law of each material, in the run called `name`.
    pub(in crate::bed) fn under(
        scene: &Scene,
        name: &str,
        laws: Vec<AnyLaw>,
        start: &Start,
    ) -> Result<Self> {
        let of_pairs = pair_laws(&scene.pairs, name)?;
        let mut all = laws.clone();
        all.extend(of_pairs.iter().map(|own| own.law.clone()));
        let steps = time_step::steps_under(scene, &all)?;
        let recipe = Recipe {
            pairs: &scene.pairs,
            pair_laws: of_pairs,
            ..recipe(scene, laws, &scene.contact)
        };
        Ok(Self {
            bed: assemble(&recipe, parts(scene, start)?)?,
            terms: Terms::of(scene, steps),
            laws: all,
        })
    }

    /// The run of its stages, and the laws of materials and pairs.
    pub(in crate::bed) fn run<'a>(
        self,
        scene: &Scene,
        start: &Start,
        observer: &'a mut dyn Observer,
    ) -> (Run<'a>, Vec<AnyLaw>) {
        let flows = (start.feed.clone(), Drain::new(&scene.outlets));
        let measures = &scene.measures;
        let run = Run::new(self.bed, self.terms, start.room, flows, measures, observer);
        (run, self.laws)
    }
}

/// A scene under one law, step by step: first the stages that make its packing, then those under the law. No file is written.
pub struct Hand {
    scene: Scene,
    start: Start,
    /// Name of the law.
    name: String,
    laws: Vec<AnyLaw>,
    run: Run<'static>,
    packs: bool,
    over: bool,
    /// Rows of the packing, once it is made.
    packing: Vec<Row>,
}

impl Hand {
    /// The scene before its first step, under its law called `law`, or its first one; `given` is the law file beside it, `seed`
    /// stands in place of the scene's.
    ///
    /// # Errors
    /// [`Error::Refused`] for a law that the scene does not list, and those of [`run_scene`](super::run_scene) before the first step.
    pub fn new(
        scene: Scene,
        law: Option<&str>,
        given: Option<&LawFile>,
        seed: Option<u64>,
    ) -> Result<Self> {
        let name = law.or(scene.laws.first().map(String::as_str));
        let name = name.filter(|name| scene.laws.iter().any(|listed| listed == name));
        let Some(name) = name else {
            return Err(Error::not_one_of("law", law.unwrap_or(""), &scene.laws));
        };
        let laws = laws(&scene.materials, |index| scene.uses(index), name, given)?;
        let start = begin(&scene, seed)?;
        let packs = scene.stages.iter().any(Stage::prepares);
        let name = name.to_owned();
        let run = Self::ready(&scene, (&name, &laws), &start, packs)?;
        Ok(Self {
            scene,
            start,
            name,
            laws,
            run,
            packs,
            over: false,
            packing: Vec::new(),
        })
    }

    fn ready(
        scene: &Scene,
        (name, laws): (&str, &[AnyLaw]),
        start: &Start,
        packs: bool,
    ) -> Result<Run<'static>> {
        let ready = match packs {
            true => Ready::to_pack(scene, start)?,
            false => Ready::under(scene, name, laws.to_vec(), start)?,
        };
        // an observer that is nothing takes no memory
        Ok(ready.run(scene, start, Box::leak(Box::new(()))).0)
    }

    /// Up to `steps` steps; fewer only when the stages have ended. Returns how many.
    ///
    /// # Errors
    /// [`Error::Bed`] when the bed cannot go on.
    pub fn step(&mut self, steps: u64) -> Result<u64> {
        let mut done = 0;
        while done < steps && !self.over {
            let stages = self.scene.stages.iter();
            let stages: Vec<&Stage> = stages.filter(|s| s.prepares() == self.packs).collect();
            while done < steps && self.run.step_through(&stages)? {
                done += 1;
            }
            if done == steps {
                break;
            }
            match self.packs {
                true => {
                    self.start.goes_on_from(&self.run);
                    let run =
                        Self::ready(&self.scene, (&self.name, &self.laws), &self.start, false)?;
                    let packed = std::mem::replace(&mut self.run, run);
                    self.packing = packed.done().rows;
                    self.packs = false;
                }
                false => self.over = true,
            }
        }
        Ok(done)
    }

    /// The bed as it is.
    #[must_use]
    pub fn bed(&self) -> &dyn AnyBed {
        self.run.bed.as_ref()
    }

    /// The bed, for who shows its grains without copying them.
    pub fn bed_mut(&mut self) -> &mut dyn AnyBed {
        self.run.bed.as_mut()
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Name of the stage under way; `end` after the last one.
    #[must_use]
    pub fn stage(&self) -> &str {
        match self.over {
            true => "end",
            false => self.run.stage_name(),
        }
    }

    /// Whether its stages have ended.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.over
    }

    /// Rows of its time series so far, without those of the packing.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        match self.packs {
            true => &[],
            false => &self.run.rows,
        }
    }

    /// Rows of the packing so far.
    #[must_use]
    pub fn packing_rows(&self) -> &[Row] {
        match self.packs {
            true => &self.run.rows,
            false => &self.packing,
        }
    }
}
