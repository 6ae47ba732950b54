//! Protocol: the stages of a scene, run one after the other on one bed.

use super::compose::AnyBed;
use super::insertion::{PISTON, Room};
use super::measure::Packing;
use super::row::{Progress, Row, View};
use super::scene::Scene;
use super::stage::Stage;
use super::time_step;
use crate::{Error, Result};
use parry3d::math::Vector;

/// Steps between checks of time step, overlap and rest.
const CHECK_EVERY: u64 = 50;
/// Overlap over diameter at which a bed has left every contact law's ground and is stopped.
const TOO_DEEP: f64 = 0.25;
/// Gap over the radius left between the highest grain and the piston put above it.
const PISTON_GAP: f64 = 1e-3;
/// Part of the bed's height the piston may travel without meeting the seating stress.
const LONGEST_APPROACH: f64 = 0.5;

/// Receives what a run produces as it goes.
pub trait Observer {
    /// A new row; the bed is as the row says.
    ///
    /// # Errors
    /// Whatever stops the run, e.g. a file that cannot be written.
    fn row(&mut self, bed: &dyn AnyBed, row: &Row) -> Result<()>;
}

impl Observer for () {
    fn row(&mut self, _: &dyn AnyBed, _: &Row) -> Result<()> {
        Ok(())
    }
}

/// A bed going through stages.
pub struct Run<'a> {
    /// The bed.
    pub bed: Box<dyn AnyBed>,
    /// Rows so far.
    pub rows: Vec<Row>,
    /// Largest number of grains seen outside the box.
    pub lost: usize,
    /// Largest overlap over diameter seen.
    pub max_overlap_ratio: f64,
    /// Largest number of contacts seen beyond the validity of the law.
    pub beyond_validity: usize,
    scene: &'a Scene,
    room: Room,
    observer: &'a mut dyn Observer,
    progress: Progress,
    started: bool,
    grain_volume: f64,
    smallest_radius: f64,
    softening: f64,
    checked: u64,
}

/// When the rows of a stage fall due, on its clock: time, or steps where the time step changes much.
struct Sampling {
    next: f64,
    interval: f64,
}

impl<'a> Run<'a> {
    /// Run of a bed in its `room`.
    #[must_use]
    pub fn new(
        bed: Box<dyn AnyBed>,
        scene: &'a Scene,
        room: Room,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let (grain_volume, smallest_radius) =
            (bed.grains().volume(), bed.grains().smallest_radius());
        Self {
            bed,
            rows: Vec::new(),
            lost: 0,
            max_overlap_ratio: 0.0,
            beyond_validity: 0,
            scene,
            room,
            observer,
            progress: Progress {
                stage: "start",
                piston_speed: 0.0,
                seated_height: None,
                first_balance: 0.0,
            },
            started: false,
            grain_volume,
            smallest_radius,
            softening: 1.0,
            checked: 0,
        }
    }

    /// Runs one stage to its end.
    ///
    /// # Errors
    /// [`Error::Bed`] when the bed cannot go on, with the reason; what the observer returns.
    pub fn stage(&mut self, stage: &Stage) -> Result<()> {
        self.progress.stage = stage.name();
        match *stage {
            Stage::Settle {
                stiffness,
                longest,
                rest_speed,
                ..
            } => self.settle(stiffness, longest, rest_speed),
            Stage::Relax { steps } => self.relax(steps),
            Stage::Compress {
                speed,
                seating_stress,
                strain,
            } => self.compress(speed, seating_stress, strain),
            Stage::Unload { speed } => self.unload(speed),
        }
    }

    fn settle(&mut self, stiffness: f64, longest: f64, rest_speed: f64) -> Result<()> {
        self.softening = stiffness;
        self.bed.soften(stiffness);
        self.set_clock();
        let end = self.time() + longest;
        let mut sampling = self.sampling(longest);
        loop {
            let packing = self.prepare()?;
            self.sample(&mut sampling, self.time())?;
            let at_rest = packing.is_some_and(|p| p.contacts > 0 && p.rms_speed < rest_speed);
            if at_rest || self.time() >= end {
                return self.record();
            }
            self.bed.advance()?;
        }
    }

    fn relax(&mut self, steps: u64) -> Result<()> {
        let (first, growth) = (self.step(), (1.0 / self.softening).powf(1.0 / steps as f64));
        self.set_clock();
        let mut sampling = Sampling {
            next: 0.0,
            interval: steps as f64 / self.scene.output.rows as f64,
        };
        while self.step() - first < steps {
            self.prepare()?;
            self.sample(&mut sampling, (self.step() - first) as f64)?;
            self.softening = (self.softening * growth).min(1.0);
            self.bed.soften(self.softening);
            let dt = self.largest_time_step(f64::INFINITY);
            self.bed.set_dt(self.bed.clock().0.min(dt));
            self.bed.advance()?;
        }
        self.softening = 1.0;
        self.bed.soften(1.0);
        self.prepare()?;
        self.record()
    }

    fn compress(&mut self, speed: f64, seating_stress: f64, strain: f64) -> Result<()> {
        self.set_clock();
        self.bed.evaluate()?;
        let start = self.lower_piston(speed);
        let mut sampling = self.sampling(1.2 * strain * start / speed);
        loop {
            self.prepare()?;
            let face = self.view().face(self.bed.as_ref());
            if self.progress.seated_height.is_none()
                && self.view().stress(self.bed.as_ref()) >= seating_stress
            {
                self.progress.seated_height = Some(face);
            }
            self.sample(&mut sampling, self.time())?;
            match self.progress.seated_height {
                Some(seated) if seated - face >= strain * seated => return self.record(),
                None if start - face > LONGEST_APPROACH * start => return Err(self.stop(
                    "the piston met no resistance; lower `seating_stress` or look for lost grains"
                        .to_owned(),
                )),
                _ => {}
            }
            self.bed.advance()?;
        }
    }

    /// Puts the piston just above the grains unless it is on them already, and drives it down; returns its height.
    fn lower_piston(&mut self, speed: f64) -> f64 {
        let Some(piston) = self.bed.machine().find(PISTON) else {
            return self.room.height;
        };
        if self.progress.seated_height.is_none() {
            let face = self.bed.packing().top + PISTON_GAP * self.smallest_radius;
            self.bed
                .machine_mut()
                .lift(piston, face + 0.5 * self.room.thickness);
            self.bed.list_again();
        }
        self.bed
            .machine_mut()
            .drive(piston, Vector::new(0.0, 0.0, -speed));
        self.progress.piston_speed = speed;
        self.view().face(self.bed.as_ref())
    }

    fn unload(&mut self, speed: f64) -> Result<()> {
        self.set_clock();
        if let Some(piston) = self.bed.machine().find(PISTON) {
            self.bed
                .machine_mut()
                .drive(piston, Vector::new(0.0, 0.0, speed));
        }
        self.progress.piston_speed = speed;
        let seated = self.progress.seated_height.unwrap_or(self.room.height);
        let face = self.view().face(self.bed.as_ref());
        let mut sampling = self.sampling((seated - face) / speed);
        loop {
            self.prepare()?;
            self.sample(&mut sampling, self.time())?;
            if self.view().stress(self.bed.as_ref()) <= 0.0 {
                return self.record();
            }
            self.bed.advance()?;
        }
    }

    /// Forces of the present instant; every few steps also the checks, whose survey is returned.
    fn prepare(&mut self) -> Result<Option<Packing>> {
        self.bed.evaluate()?;
        if !self.started {
            self.started = true;
            self.bed.start_account();
            self.progress.first_balance = self.bed.energies().balance();
        }
        if self.step() < self.checked + CHECK_EVERY && self.step() > 0 {
            return Ok(None);
        }
        self.checked = self.step();
        let packing = self.bed.packing();
        let limit = self.largest_time_step(packing.contact_time);
        self.bed.set_dt(limit);
        self.lost = self.lost.max(self.outside());
        self.max_overlap_ratio = self.max_overlap_ratio.max(packing.max_overlap_ratio);
        self.beyond_validity = self.beyond_validity.max(packing.beyond_validity);
        if packing.max_overlap_ratio > TOO_DEEP {
            return Err(self.stop(format!(
                "two grains overlap by {:.0} % of a diameter; no contact law holds there: compress less or more slowly",
                100.0 * packing.max_overlap_ratio
            )));
        }
        if self.bed.left_out() > 0 {
            return Err(self.stop(
                "a grain touches a mesh in too many places; use larger triangles".to_owned(),
            ));
        }
        Ok(Some(packing))
    }

    /// Sets the time step to what the present state allows, and says so.
    fn set_clock(&mut self) {
        let contact_time = self.bed.packing().contact_time;
        let dt = self.largest_time_step(contact_time);
        self.bed.set_dt(dt);
        tracing::info!(
            "{}: time step {dt:.3e} s, stiffness {:.1e} of the true one",
            self.progress.stage,
            self.softening
        );
    }

    fn sampling(&self, duration: f64) -> Sampling {
        Sampling {
            next: self.time(),
            interval: duration / self.scene.output.rows as f64,
        }
    }

    fn sample(&mut self, sampling: &mut Sampling, now: f64) -> Result<()> {
        if now < sampling.next {
            return Ok(());
        }
        while sampling.next <= now {
            sampling.next += sampling.interval;
        }
        self.record()
    }

    fn largest_time_step(&self, contact_time: f64) -> f64 {
        let (settings, material) = (&self.scene.time, &self.scene.material);
        time_step::largest(
            settings,
            material,
            self.smallest_radius,
            self.softening,
            contact_time,
        )
    }

    fn record(&mut self) -> Result<()> {
        let (packing, energies) = (self.bed.packing(), self.bed.energies());
        let row = self
            .view()
            .row(self.bed.as_ref(), &packing, &energies, &self.progress);
        self.observer.row(self.bed.as_ref(), &row)?;
        self.rows.push(row);
        Ok(())
    }

    fn view(&self) -> View<'_> {
        View {
            room: &self.room,
            material: &self.scene.material,
            grain_volume: self.grain_volume,
            diameter: 2.0 * self.scene.radius,
        }
    }

    fn outside(&self) -> usize {
        let spheres = &self.bed.grains().spheres;
        spheres
            .iter()
            .filter(|sphere| !self.room.holds(sphere.centre))
            .count()
    }

    fn time(&self) -> f64 {
        self.bed.clock().1
    }

    fn step(&self) -> u64 {
        self.bed.clock().2
    }

    fn stop(&self, reason: String) -> Error {
        Error::Bed {
            step: self.step(),
            reason,
        }
    }
}
