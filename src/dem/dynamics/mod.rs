//! Step of a bed: forces at the time of the positions, then a kick and a drift, of grains and bodies on one clock.

pub(crate) mod any;
pub(crate) mod compose;
pub mod contact;
mod removal;
mod restart;
pub(crate) mod state;

use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::machine::{Load, Machine};
use crate::dem::contacts::pairs::Contacts;
use crate::dem::contacts::surfaces::Surfaces;
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::losses::Losses;
use crate::dem::force::normal::{NormalModel, Squeeze};
use crate::dem::grains::{Grains, Motion, Sphere, Spin};
use crate::{Error, Result};
use parry3d::math::{Pose, Vector};
use rayon::prelude::*;

/// Grains moved by one task.
const CHUNK: usize = 256;

/// Work done on the bed from outside, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outside {
    /// By driven bodies and belts on grains, and by bringing grains back through periodic sides against gravity.
    pub driven: f64,
    /// By changes of the law while grains touch.
    pub stiffening: f64,
}

/// Normal laws of a bed.
pub struct Normals {
    /// Between two grains.
    pub pair: Box<dyn NormalModel>,
    /// Of a grain on a surface.
    pub wall: Box<dyn NormalModel>,
}

/// What a bed is made of, its law apart.
pub struct Parts {
    /// Grains.
    pub grains: Grains,
    /// Bodies.
    pub machine: Machine,
    /// Gravity, m/s2.
    pub gravity: Vector,
    /// Time step, s.
    pub dt: f64,
    /// Distance up to which neighbours are listed, m: larger lists are longer, but last.
    pub skin: f64,
}

/// A bed of grains among bodies; `C` are the effects of its contacts.
pub struct Bed<C: ContactLaw> {
    /// Effects around the normal laws.
    pub law: C,
    /// Grains.
    pub grains: Grains,
    /// Everything else.
    pub machine: Machine,
    /// Contacts between grains.
    pub contacts: Contacts<C>,
    /// Contacts of grains with bodies.
    pub surfaces: Surfaces<C>,
    /// Gravity, m/s2.
    pub gravity: Vector,
    /// Time step, s.
    pub dt: f64,
    /// Length of the step that led to the positions, s: velocities are those of its middle.
    pub stride: f64,
    /// Time of the positions, s.
    pub time: f64,
    /// Steps done.
    pub step: u64,
    /// Loads of the grains on each body at the time of the positions.
    pub loads: Vec<Load>,
    /// Work done from outside.
    pub outside: Outside,
    skin: f64,
    pub(in crate::dem) before: Vec<Load>,
    pub(in crate::dem) listed: Listed,
    /// Forces are those of the positions.
    pub(in crate::dem) fresh: bool,
}

/// Where everything was when neighbours were listed, and how far the grains have come since.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::dem) struct Listed {
    pub(in crate::dem) centres: Vec<Vector>,
    pub(in crate::dem) poses: Vec<Pose>,
    /// Largest squared distance in each chunk of grains, m2.
    pub(in crate::dem) moved: Vec<f64>,
    /// Smallest radius, m.
    pub(in crate::dem) smallest: f64,
    /// Neighbours must be listed before the next step.
    pub(in crate::dem) due: bool,
}

impl<C: ContactLaw> Bed<C> {
    /// Bed in the state of its parts, with no contact history.
    #[must_use]
    pub fn new(law: C, normals: Normals, parts: Parts) -> Self {
        let bodies = parts.machine.stations.len();
        Self {
            law,
            grains: parts.grains,
            machine: parts.machine,
            contacts: Contacts::new(normals.pair),
            surfaces: Surfaces::new(normals.wall),
            gravity: parts.gravity,
            dt: parts.dt,
            stride: parts.dt,
            time: 0.0,
            step: 0,
            loads: vec![Load::default(); bodies],
            outside: Outside::default(),
            skin: parts.skin,
            before: vec![Load::default(); bodies],
            listed: Listed {
                due: true,
                ..Listed::default()
            },
            fresh: false,
        }
    }

    /// One step of the clock.
    ///
    /// # Errors
    /// [`Error::Bed`] when a place is no longer a number.
    pub fn step(&mut self) -> Result<()> {
        self.evaluate()?;
        self.advance()
    }

    /// Brings every force to the time of the positions, once: work is booked with it.
    ///
    /// # Errors
    /// [`Error::Bed`] when a grain's place is no longer a number.
    pub fn evaluate(&mut self) -> Result<()> {
        if std::mem::replace(&mut self.fresh, true) {
            return Ok(());
        }
        if self.relist_due()? {
            self.relist()?;
        }
        std::mem::swap(&mut self.loads, &mut self.before);
        let (grains, machine, dt) = (&self.grains, &self.machine, self.stride);
        let (contacts, surfaces, law) = (&mut self.contacts, &mut self.surfaces, &self.law);
        let loads = &mut self.loads;
        let is_small = contacts.is_small();
        let pairs = || contacts.evaluate(law, grains, dt);
        let walls = || {
            surfaces.evaluate(law, grains, machine, dt);
            surfaces.load_into(machine, loads);
        };
        both(is_small, pairs, walls);
        self.book_drives();
        Ok(())
    }

    /// Moves grains and bodies on by one time step under the present forces.
    ///
    /// Velocities go from the middle of the last step to that of the next: where the two differ in length, a kick of either
    /// would shift them against the positions, and a grain that bounces in gravity would lose energy with every change.
    ///
    /// # Errors
    /// [`Error::Bed`] when a body's place is no longer a number.
    pub fn advance(&mut self) -> Result<()> {
        let Listed { centres, moved, .. } = &mut self.listed;
        let mover = Mover {
            contacts: &self.contacts,
            surfaces: &self.surfaces,
            centres,
            gravity: self.gravity,
            kick: 0.5 * (self.stride + self.dt),
            dt: self.dt,
        };
        let (grains, machine) = (&mut self.grains, &mut self.machine);
        let (loads, kick, dt) = (&self.loads, mover.kick, self.dt);
        let bodies = || machine.step(loads, kick, dt).map(|()| machine.view());
        let ((), stepped) = both(
            self.contacts.is_small(),
            || mover.kick_and_drift(grains, moved),
            bodies,
        );
        stepped.map_err(|body| {
            let name = &self.machine.bodies()[body].name;
            self.broken(&format!("the body \"{name}\""))
        })?;
        self.time += self.dt;
        self.stride = self.dt;
        self.step += 1;
        self.fresh = false;
        Ok(())
    }

    /// Neighbours are listed anew before the next evaluation, after a body was moved by hand or taken out.
    pub fn list_again(&mut self) {
        self.listed.due = true;
    }

    /// Neighbours are listed and forces evaluated anew, after grains have come in.
    pub fn renew(&mut self) {
        self.listed.due = true;
        self.fresh = false;
    }

    fn relist_due(&self) -> Result<bool> {
        let moved = self
            .listed
            .moved
            .iter()
            .fold(0.0f64, |m, &x| if x <= m { m } else { x })
            .sqrt();
        if !moved.is_finite() {
            return Err(self.broken("a grain"));
        }
        let bodies = self.machine.moved_since(&self.listed.poses);
        if !self.listed.due {
            // lists are made anew once half the skin is used up, so that what is beyond it came in one step
            for (of_grains, way, part) in [(true, moved, 0.5), (false, bodies, 1.0)] {
                if way > part * self.skin + self.listed.smallest {
                    let what = match of_grains {
                        true => self.furthest_grain(),
                        false => self.furthest_body(),
                    };
                    return Err(Error::Bed {
                        step: self.step,
                        reason: format!(
                            "{what} has moved in one step by more than the radius of the smallest grain, and may have passed through another; reduce the time step or the speeds"
                        ),
                    });
                }
            }
        }
        Ok(self.listed.due || 2.0 * moved > self.skin || moved + bodies > self.skin)
    }

    /// The grain that has moved furthest since the last listing, in words.
    fn furthest_grain(&self) -> String {
        let ways = self.grains.spheres.iter().zip(&self.listed.centres);
        let ways = ways.map(|(sphere, before)| sphere.centre.distance(*before));
        let furthest = ways.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        furthest.map_or("a grain".to_owned(), |(grain, _)| {
            let at = self.grains.spheres[grain].centre * 1e3;
            let speed = self.grains.motions[grain].velocity.length();
            format!(
                "grain {} at ({:.4}, {:.4}, {:.4}) mm, {speed:.3} m/s fast,",
                self.grains.ids[grain], at.x, at.y, at.z
            )
        })
    }

    /// The body that has, by name.
    fn furthest_body(&self) -> String {
        let bodies = self.machine.bodies().iter().enumerate();
        let ways =
            bodies.map(|(index, body)| (body, self.machine.way_since(&self.listed.poses, index)));
        let furthest = ways.max_by(|a, b| a.1.total_cmp(&b.1));
        furthest.map_or("a body".to_owned(), |(body, _)| {
            format!("the body \"{}\"", body.name)
        })
    }

    fn broken(&self, what: &str) -> Error {
        Error::Bed {
            step: self.step,
            reason: format!("the place of {what} is no longer a number; reduce the time step"),
        }
    }

    fn relist(&mut self) -> Result<()> {
        if !self.grains.room.is_open() {
            let reach = 2.0 * self.grains.largest_radius() + self.skin;
            self.grains.room.admit(reach)?;
            self.outside.driven += self.grains.reenter(self.gravity);
        }
        let softening = self.law.softening();
        self.contacts.relist(&mut self.grains, self.skin, softening);
        self.surfaces
            .relist(&mut self.grains, &self.machine, self.skin, softening);
        self.listed = Listed {
            centres: self.grains.spheres.iter().map(|s| s.centre).collect(),
            poses: self.machine.surfaces.iter().map(|s| s.pose).collect(),
            moved: vec![0.0; self.grains.len().div_ceil(CHUNK)],
            smallest: self.grains.smallest_radius(),
            due: false,
        };
        Ok(())
    }

    /// Moves the surface of a body that is a belt like this from now on.
    ///
    /// Forces must be up to date ([`Bed::evaluate`]): its power on them is that of the new motion.
    pub fn run_belt(&mut self, body: usize, belt: Belt) {
        self.machine.stations[body].belt = Some(belt);
        self.surfaces.load_into(&self.machine, &mut self.loads);
    }

    /// Books what driven bodies and belts spent since the last step.
    fn book_drives(&mut self) {
        for ((station, now), before) in self
            .machine
            .stations
            .iter()
            .zip(&self.loads)
            .zip(&self.before)
        {
            if station.driven {
                let power = (now.force + before.force).dot(station.velocity)
                    + (now.torque + before.torque).dot(station.spin);
                self.outside.driven -= 0.5 * self.stride * power;
            }
            if station.belt.is_some() {
                self.outside.driven += 0.5 * self.stride * (now.power + before.power);
            }
        }
    }

    /// Force and torque of all contacts on a grain, without gravity.
    #[must_use]
    pub fn load(&self, grain: usize) -> (Vector, Vector) {
        load(&self.contacts, &self.surfaces, grain)
    }

    /// Energy dissipated by effects so far; plastic flow is booked by contact.
    #[must_use]
    pub fn losses(&self) -> Losses {
        let mut sum = self.contacts.losses();
        sum += self.surfaces.losses();
        sum
    }

    /// Starts the account of energy: what plastic flow has dissipated so far belongs to the time before.
    ///
    /// Forces must be up to date ([`Bed::evaluate`]).
    pub fn start_account(&mut self) {
        let softening = self.law.softening();
        for index in 0..self.contacts.memory.len() {
            let before = self.plastic_in(index);
            C::book_flow(&mut self.contacts.memory[index], -before);
        }
        self.surfaces.start_account(&self.grains, softening);
    }

    /// Makes contacts `factor` times as stiff as the material's: what touching contacts then hold more is booked as
    /// work from outside.
    pub fn soften(&mut self, factor: f64) {
        let change = factor - self.law.softening();
        self.law.soften(factor);
        for index in 0..self.contacts.memory.len() {
            if self.contacts.pushes[index].touches() {
                let squeeze = self.squeeze_of(index);
                let work = self.contacts.elastic_energy(index, squeeze)
                    + self.contacts.dissipated(index, squeeze.radii);
                self.outside.stiffening += change * work;
            }
        }
        self.outside.stiffening += change * self.surfaces.law_work(&self.grains);
    }

    /// A listed pair as its normal law sees it; the overlap is negative if it is apart.
    #[must_use]
    pub fn squeeze_of(&self, pair: usize) -> Squeeze {
        let radii = self.grains.radii(self.contacts.list.pairs[pair]);
        Squeeze {
            overlap: radii[0] + radii[1] - self.contacts.line(pair, &self.grains).length(),
            radii,
        }
    }
}

/// Two tasks one after the other where one thread does it all, else side by side. Each extra
/// join lets workers go idle.
fn both<A: Send, B: Send>(
    is_small: bool,
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    if is_small {
        (first(), second())
    } else {
        rayon::join(first, second)
    }
}

/// Force and torque of all contacts on a grain.
#[inline(always)]
fn load<C: ContactLaw>(
    contacts: &Contacts<C>,
    surfaces: &Surfaces<C>,
    grain: usize,
) -> (Vector, Vector) {
    let (mut force, mut torque) = contacts.load(grain);
    let (wall_force, wall_torque) = surfaces.load(grain);
    force += wall_force;
    torque += wall_torque;
    (force, torque)
}

/// What moving the grains reads.
struct Mover<'a, C: ContactLaw> {
    contacts: &'a Contacts<C>,
    surfaces: &'a Surfaces<C>,
    /// Centres when neighbours were listed.
    centres: &'a [Vector],
    gravity: Vector,
    /// From the middle of the last step to that of this one, s.
    kick: f64,
    /// Length of this step, s.
    dt: f64,
}

impl<C: ContactLaw> Mover<'_, C> {
    /// Kicks and drifts all grains; `moved` gets the largest squared distance of each chunk.
    fn kick_and_drift(&self, grains: &mut Grains, moved: &mut [f64]) {
        let Grains {
            spheres,
            motions,
            spins,
            ..
        } = grains;
        if let [moved] = moved {
            *moved = self.move_chunk(0, spheres, motions, spins);
            return;
        }
        spheres
            .par_chunks_mut(CHUNK)
            .zip(motions.par_chunks_mut(CHUNK))
            .zip(spins.par_chunks_mut(CHUNK))
            .zip(moved.par_iter_mut())
            .enumerate()
            .for_each(|(chunk, (((spheres, motions), spins), moved))| {
                *moved = self.move_chunk(chunk * CHUNK, spheres, motions, spins);
            });
    }

    /// Kicks and drifts one chunk of grains; returns the largest squared distance from where they were listed.
    fn move_chunk(
        &self,
        first: usize,
        spheres: &mut [Sphere],
        motions: &mut [Motion],
        spins: &mut [Spin],
    ) -> f64 {
        let (kick, dt) = (self.kick, self.dt);
        let mut furthest = 0.0;
        for (at, ((sphere, motion), spin)) in spheres.iter_mut().zip(motions).zip(spins).enumerate()
        {
            let (force, torque) = load(self.contacts, self.surfaces, first + at);
            motion.velocity += (force * motion.inverse_mass + self.gravity) * kick;
            sphere.centre += motion.velocity * dt;
            if C::ROTATES {
                spin.rate += torque * (spin.inverse_inertia * kick);
            }
            let distance = (sphere.centre - self.centres[first + at]).length_squared();
            // a NaN must come through, so that the run stops
            if !(distance <= furthest) {
                furthest = distance;
            }
        }
        furthest
    }
}
