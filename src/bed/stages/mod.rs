//! Protocol: the stages of a scene, run one after the other on one bed, step by step.

pub(crate) mod acts;
pub(crate) mod tally;
mod terms;
pub mod time_step;

pub use terms::Terms;

use self::tally::Tally;
use crate::bed::filling::drain::Drain;
use crate::bed::filling::feed::Feed;
use crate::bed::measures::gauge::Gauge;
use crate::bed::measures::series::{HOPELESS, Left, Progress, Row, View, first_beyond};
use crate::bed::scene::{Measure, Stage};
use crate::dem::bodies::enclosure::{PISTON, Room};
use crate::dem::dynamics::any::AnyBed;
use crate::dem::dynamics::state::Packing;
use crate::tape::{Keep, Keeper, TakenUp, keep_fields};
use crate::{Error, Result};
use parry3d::math::Vector;

/// Steps between checks of time step, overlap and rest.
pub const CHECK_EVERY: u64 = 50;
/// The same where an impact may be too deep: an impact takes at least four times as many.
pub const CHECK_DEEP: u64 = 5;
/// Overlap over diameter at which a bed has left every contact law's ground and is stopped.
const TOO_DEEP: f64 = 0.25;

/// Receives what a run produces as it goes, and is kept with it.
pub trait Observer: Keep + Send {
    /// A new row, the `last` of its stage or not; the bed is as the row says.
    ///
    /// # Errors
    /// Whatever stops the run, e.g. a file that cannot be written.
    fn row(&mut self, bed: &dyn AnyBed, row: &Row, last: bool) -> Result<()>;

    /// A stage has ended; the bed is as it left it.
    fn stage_ended(&mut self, bed: &dyn AnyBed, stage: &Stage);
}

impl Observer for () {
    fn row(&mut self, _: &dyn AnyBed, _: &Row, _: bool) -> Result<()> {
        Ok(())
    }

    fn stage_ended(&mut self, _: &dyn AnyBed, _: &Stage) {}
}

/// Where a run is within its stage: all that going on needs beside the bed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Place {
    /// Whether the stage has begun.
    pub begun: bool,
    /// Time the stage began, s.
    pub time: f64,
    /// Step the stage began at.
    pub step: u64,
    /// When the next row falls due, on the stage's clock.
    pub next_row: f64,
    /// Between rows, on the stage's clock: time, or steps where the time step changes much.
    pub interval: f64,
    /// Height of the piston's face when the stage began, m.
    pub face: f64,
    /// Factor by which the stiffness grows in a step.
    pub growth: f64,
    /// Step of the next check.
    pub next_check: u64,
    /// Since when the grains have been slow, s; none while they are not.
    pub slow_since: Option<f64>,
    /// Height (m) of the piston's face since which the stress has not been below the seating stress.
    pub carried_since: Option<f64>,
}
keep_fields!(Place: begun, time, step, next_row, interval, face, growth, next_check, slow_since, carried_since);

/// A bed going through stages.
pub struct Run<'a> {
    /// The bed.
    pub bed: Box<dyn AnyBed>,
    /// Rows so far.
    pub rows: Vec<Row>,
    /// Counts so far.
    pub tally: Tally,
    /// Grains to come.
    pub feed: Feed,
    /// Grains that have left.
    pub drain: Drain,
    /// Measures under way.
    pub gauges: Box<[Gauge]>,
    pub(in crate::bed) terms: Terms,
    pub(in crate::bed) room: Room,
    observer: &'a mut dyn Observer,
    pub(in crate::bed) progress: Progress,
    pub(in crate::bed) place: Place,
    started: bool,
    pub(in crate::bed) softening: f64,
    /// Stages that have ended.
    ended: usize,
    keeper: Option<Keeper<'a>>,
}
keep_fields!(impl [] Run<'_>: bed, rows, tally, feed, drain, gauges, observer, progress, place, started, softening,
    ended; rebuilt terms, room, keeper);

/// What a run leaves when its stages have ended.
pub struct Done {
    /// The bed.
    pub bed: Box<dyn AnyBed>,
    /// All rows.
    pub rows: Vec<Row>,
    /// All counts.
    pub tally: Tally,
    /// Grains that have not come in.
    pub feed: Feed,
    /// Grains that have left.
    pub drain: Drain,
    /// All measures.
    pub gauges: Box<[Gauge]>,
    /// Seconds the run took before it was resumed.
    pub seconds_before: f64,
}

impl<'a> Run<'a> {
    /// Run of a bed in its `room`.
    #[must_use]
    pub fn new(
        bed: Box<dyn AnyBed>,
        terms: Terms,
        room: Room,
        (feed, drain): (Feed, Drain),
        measures: &[Measure],
        observer: &'a mut dyn Observer,
    ) -> Self {
        Self {
            bed,
            rows: Vec::new(),
            tally: Tally::default(),
            feed,
            drain,
            gauges: measures.iter().map(Gauge::new).collect(),
            softening: terms.softening,
            terms,
            room,
            observer,
            progress: Progress {
                stage: "start".to_owned(),
                piston_speed: 0.0,
                seated_height: None,
                first_balance: 0.0,
            },
            place: Place::default(),
            started: false,
            ended: 0,
            keeper: None,
        }
    }

    /// Takes up what `keeper` finds of this run, and keeps it from now on.
    pub fn keep_by(&mut self, mut keeper: Keeper<'a>) -> TakenUp {
        let taken = keeper.take_up_into(self);
        self.keeper = Some(keeper);
        taken
    }

    /// The end of the run.
    #[must_use]
    pub fn done(self) -> Done {
        Done {
            seconds_before: self.keeper.as_ref().map_or(0.0, Keeper::seconds_before),
            bed: self.bed,
            rows: self.rows,
            tally: self.tally,
            feed: self.feed,
            drain: self.drain,
            gauges: self.gauges,
        }
    }

    /// Runs the stages that have not ended yet, one after the other.
    ///
    /// # Errors
    /// As [`Run::stage`].
    pub fn stages(&mut self, stages: &[&Stage]) -> Result<()> {
        while self.step_through(stages)? {}
        self.keep(true)
    }

    /// One step of the first stage that has not ended; false when there is none, or the run stops because of its account.
    ///
    /// # Errors
    /// As [`Run::stage`].
    pub fn step_through(&mut self, stages: &[&Stage]) -> Result<bool> {
        while let Some(stage) = stages.get(self.ended) {
            if self.go_on(stage)? {
                return Ok(true);
            }
            if self.is_hopeless() {
                break;
            }
            self.observer.stage_ended(self.bed.as_ref(), stage);
            self.ended += 1;
        }
        Ok(false)
    }

    /// Keeps the run if it is time, or `now`; what it was at the last keeping is what an interrupted run goes on from.
    fn keep(&mut self, now: bool) -> Result<()> {
        let Some(mut keeper) = self.keeper.take() else {
            return Ok(());
        };
        let kept = match now || keeper.is_due() {
            true => keeper.keep(self),
            false => Ok(()),
        };
        self.keeper = Some(keeper);
        kept
    }

    /// Name of the stage under way.
    pub(in crate::bed) fn stage_name(&self) -> &str {
        &self.progress.stage
    }

    /// Whether the account of energies is so far off that the run stops at its last row; a warning says so.
    fn is_hopeless(&self) -> bool {
        first_beyond(&self.rows, HOPELESS).is_some()
    }

    /// Runs one stage to its end.
    ///
    /// # Errors
    /// [`Error::Bed`] when the bed cannot go on, with the reason; what the observer returns.
    pub fn stage(&mut self, stage: &Stage) -> Result<()> {
        while self.go_on(stage)? {}
        Ok(())
    }

    /// One step of a stage; false when it has ended without one.
    fn go_on(&mut self, stage: &Stage) -> Result<bool> {
        if !self.place.begun {
            self.progress.stage = stage.name().to_owned();
            self.begin(stage)?;
        }
        let survey = self.prepare()?;
        self.note(stage, survey.as_ref());
        for gauge in &mut self.gauges {
            gauge.read(self.bed.as_ref(), survey.is_some());
        }
        let rows = self.rows.len();
        self.sample(stage)?;
        if self.rows.len() > rows && self.is_hopeless() {
            return Ok(false);
        }
        if self.ends(stage, survey.as_ref())? {
            self.place.begun = false;
            self.end(stage);
            return self.record(true).map(|()| false);
        }
        self.change(stage);
        self.tally.particle_steps += self.bed.grains().len() as u64;
        self.bed.advance()?;
        if survey.is_some() {
            self.keep(false)?;
        }
        Ok(true)
    }

    /// Forces of the present instant; every few steps also grains that come in and the checks, whose survey is
    /// returned.
    pub(in crate::bed) fn prepare(&mut self) -> Result<Option<Packing>> {
        let check = self.step() >= self.place.next_check || self.step() == 0;
        // at the first step of a later stage forces have been evaluated already, which must happen once
        if check && (self.step() > self.place.step || self.step() == 0) {
            self.let_in();
        }
        self.bed.evaluate()?;
        if !self.started {
            self.started = true;
            self.bed.start_account();
            self.progress.first_balance = self.bed.energies().balance();
        }
        if !check {
            return Ok(None);
        }
        self.let_out()?;
        let packing = self.bed.packing();
        self.set_dt(&packing)?;
        self.place.next_check = self.step() + self.until_next_check(&packing);
        let outside = self.outside();
        let bodies_outside = self.bodies_outside().count();
        let tally = &mut self.tally;
        tally.max_overlap_ratio = tally.max_overlap_ratio.max(packing.max_overlap_ratio);
        tally.beyond_validity = tally.beyond_validity.max(packing.beyond_validity);
        tally.below_validity = tally.below_validity.max(packing.below_validity);
        (0..2).for_each(|part| tally.unloading[part] += packing.unloading[part]);
        tally.lost = tally.lost.max(outside);
        tally.lost_bodies = tally.lost_bodies.max(bodies_outside);
        if packing.max_overlap_ratio > TOO_DEEP {
            return Err(self.stop(format!(
                "two grains overlap by {:.0} % of a diameter; no contact law holds there: compress less or more slowly",
                100.0 * packing.max_overlap_ratio
            )));
        }
        if let Some([free, other]) = self.bed.machine().meeting() {
            let [free, other] = [free, other].map(|body| &self.bed.machine().bodies()[body].name);
            return Err(self.stop(format!(
                "the free body \"{free}\" has come to \"{other}\", and bodies meet grains only; end the stage before, keep it away with more grains, or give it a joint"
            )));
        }
        if self.bed.left_out() > 0 {
            return Err(self.stop(
                "a grain touches a mesh in too many places; use larger triangles".to_owned(),
            ));
        }
        Ok(Some(packing))
    }

    /// Steps to the next check: fewer where an impact may be too deep, so that none is over unseen, and where a grain may fly
    /// through an outlet, even one that is struck and then twice as fast.
    fn until_next_check(&self, packing: &Packing) -> u64 {
        let speed = packing.max_speed + self.bed.machine().fastest();
        let way = 2.0 * speed * self.bed.clock().0 * CHECK_EVERY as f64;
        let deep = self.terms.limits.flattening(self.softening, speed) > TOO_DEEP;
        match deep || way > self.drain.thinnest() {
            true => CHECK_DEEP,
            false => CHECK_EVERY,
        }
    }

    /// Lets the grains that are due come in; the energy they bring is not the bed's imbalance.
    fn let_in(&mut self) {
        if self.feed.is_done() {
            return;
        }
        let (dt, time, _) = self.bed.clock();
        let newcomers = self.feed.due(self.bed.grains(), self.bed.machine(), time);
        if newcomers.is_empty() {
            return;
        }
        if self.started {
            let gravity = self.terms.gravity;
            let brought = newcomers.iter().map(|one| one.energy(gravity, dt));
            self.progress.first_balance += brought.sum::<f64>();
        }
        self.bed.join(&newcomers);
    }

    /// Takes out the grains that have come to an outlet; the energy that leaves with them is booked.
    fn let_out(&mut self) -> Result<()> {
        let gauges = &mut self.gauges;
        let gone = self.drain.due(self.bed.grains(), |sphere, mass| {
            gauges.iter_mut().for_each(|gauge| gauge.left(sphere, mass));
        });
        if gone.is_empty() {
            return Ok(());
        }
        let before = self.bed.energies().balance();
        self.bed.let_go(&gone)?;
        let left = before - self.bed.energies().balance();
        self.drain.energy += left;
        self.progress.first_balance -= left;
        Ok(())
    }

    /// Changes bodies from outside; the energy this brings in or takes away is not the bed's imbalance.
    pub(in crate::bed) fn intervene(&mut self, change: impl FnOnce(&mut dyn AnyBed)) {
        let before = self.bed.energies().balance();
        change(self.bed.as_mut());
        self.progress.first_balance += self.bed.energies().balance() - before;
        self.bed.list_again();
    }

    /// Sets the time step to what the present state allows, and says so.
    pub(in crate::bed) fn set_clock(&mut self) -> Result<()> {
        self.bed.evaluate()?;
        let packing = self.bed.packing();
        self.set_dt(&packing)?;
        tracing::info!(
            "{}: time step {:.3e} s, stiffness {:.1e} of the true one",
            self.progress.stage,
            self.bed.clock().0,
            self.softening
        );
        Ok(())
    }

    fn set_dt(&mut self, packing: &Packing) -> Result<()> {
        let dt = self
            .terms
            .limits
            .step(self.softening, packing, self.bed.machine().fastest())
            .map_err(|reason| self.stop(reason))?;
        self.bed.set_dt(dt);
        Ok(())
    }

    pub(in crate::bed) fn record(&mut self, last: bool) -> Result<()> {
        let (packing, energies) = (self.bed.packing(), self.bed.energies());
        let total = self.drain.total();
        let before = self.rows.last().map_or([self.time(), 0.0, 0.0], |row| {
            [row.time_s, row.outlet_mass_kg, row.outlet_rate_kg_s]
        });
        let left = Left {
            grains: total.grains,
            mass: total.mass,
            energy: self.drain.energy,
            before,
        };
        let bed = self.bed.as_ref();
        let view = self.view();
        let row = view.row(bed, &packing, &energies, &self.progress, &left);
        self.observer.row(self.bed.as_ref(), &row, last)?;
        self.rows.push(row);
        Ok(())
    }

    pub(in crate::bed) fn view(&self) -> View<'_> {
        View {
            room: &self.room,
            material: &self.terms.material,
            grain_volume: self.bed.grains().volume(),
            diameter: 2.0 * self.terms.radius,
        }
    }

    /// Grains outside the room now.
    #[must_use]
    pub fn outside(&self) -> usize {
        let spheres = &self.bed.grains().spheres;
        spheres
            .iter()
            .filter(|sphere| !self.room.holds(sphere.centre))
            .count()
    }

    /// Names of the free bodies outside the room now.
    pub fn bodies_outside(&self) -> impl Iterator<Item = &str> {
        let machine = self.bed.machine();
        let outside = machine
            .loose()
            .filter(|&body| !self.room.holds(machine.stations[body].centre));
        outside.map(|body| machine.bodies()[body].name.as_str())
    }

    /// Index of the piston.
    pub(in crate::bed) fn piston(&self) -> Option<usize> {
        self.bed
            .machine()
            .find(PISTON)
            .filter(|_| self.room.owns(PISTON))
    }

    /// Drives the piston along z at `speed` (m/s).
    pub(in crate::bed) fn drive_piston(&mut self, speed: f64) {
        if let Some(piston) = self.piston() {
            let machine = self.bed.machine_mut();
            machine.drive(piston, Vector::new(0.0, 0.0, speed));
        }
        self.progress.piston_speed = speed.abs();
    }

    pub(in crate::bed) fn time(&self) -> f64 {
        self.bed.clock().1
    }

    pub(in crate::bed) fn step(&self) -> u64 {
        self.bed.clock().2
    }

    pub(in crate::bed) fn stop(&self, reason: String) -> Error {
        Error::Bed {
            step: self.step(),
            reason,
        }
    }
}
