//! Acts: how each kind of stage begins, changes the bed from step to step, and ends.

use crate::Result;
use crate::bed::measures::gauge::Gauge;
use crate::bed::scene::{Change, Duration, RunStage, Stage};
use crate::bed::stages::{Place, Run};
use crate::dem::dynamics::state::Packing;

/// Gap over the radius left between the highest grain and the piston put above it.
const PISTON_GAP: f64 = 1e-3;
/// Part of the bed's height the piston may travel without meeting the seating stress.
const LONGEST_APPROACH: f64 = 0.5;
/// Time for a compression to be sampled over, over what the strain alone takes: the piston has to come near first.
const APPROACH: f64 = 1.2;

/// First of the instants `due`, `due + interval` and so on that comes after `now`, however short the interval.
fn after(now: f64, due: f64, interval: f64) -> f64 {
    let next = due + interval;
    if next > now {
        return next;
    }
    let skipped = ((now - next) / interval).floor() + 1.0;
    let next = next + skipped * interval;
    // an interval below the resolution of the clock, or none
    if next.is_finite() {
        next.max(now.next_up())
    } else {
        now.next_up()
    }
}

impl Run<'_> {
    /// Begins a stage.
    pub(in crate::bed) fn begin(&mut self, stage: &Stage) -> Result<()> {
        let duration = match stage {
            Stage::Settle {
                stiffness, longest, ..
            } => {
                self.softening = *stiffness;
                self.bed.soften(*stiffness);
                *longest
            }
            Stage::Relax { steps } => *steps as f64,
            Stage::Compress {
                speed,
                approach,
                strain,
                ..
            } => {
                self.set_clock()?;
                let first = match self.progress.seated_height {
                    Some(_) => speed,
                    None => approach,
                };
                APPROACH * strain * self.lower_piston(*first)? / speed
            }
            Stage::Unload { speed } => {
                self.drive_piston(*speed);
                let face = self.view().face(self.bed.as_ref());
                let seated = self.progress.seated_height.unwrap_or(self.room.height);
                (seated - face) / speed
            }
            Stage::Run(run) => {
                self.begin_run(run)?;
                match run.longest {
                    Duration::Time(time) => time,
                    Duration::Steps(steps) => steps as f64,
                }
            }
        };
        self.set_clock()?;
        self.gauges.iter_mut().for_each(Gauge::begin);
        let steps = matches!(stage, Stage::Relax { .. })
            || matches!(stage, Stage::Run(run) if matches!(run.longest, Duration::Steps(_)));
        self.place = Place {
            begun: true,
            time: self.time(),
            step: self.step(),
            next_row: if steps { 0.0 } else { self.time() },
            interval: duration / self.terms.rows as f64,
            face: self.view().face(self.bed.as_ref()),
            growth: self.growth(stage),
            next_check: self.place.next_check,
            slow_since: None,
            carried_since: None,
        };
        Ok(())
    }

    fn growth(&self, stage: &Stage) -> f64 {
        match stage {
            Stage::Relax { steps } => {
                (self.terms.softening / self.softening).powf(1.0 / *steps as f64)
            }
            _ => 1.0,
        }
    }

    fn begin_run(&mut self, run: &RunStage) -> Result<()> {
        self.bed.evaluate()?;
        let time = self.time();
        self.feed.begin(&run.insert, time);
        for order in &run.moves {
            let Some(body) = self.bed.machine().find(&order.body) else {
                return Err(self.stop(format!("there is no body \"{}\"", order.body)));
            };
            match order.change {
                Change::Drive(motion) => self.bed.machine_mut().drive_as(body, motion),
                Change::Belt(belt) => self.bed.run_belt(body, belt),
                Change::Remove => self.intervene(|bed| bed.take_out(body)),
                Change::Release => self.intervene(|bed| bed.machine_mut().release(body)),
            }
        }
        Ok(())
    }

    /// Puts the piston just above the grains unless it is on them already, and drives it down; returns its height.
    fn lower_piston(&mut self, speed: f64) -> Result<f64> {
        let Some(piston) = self.piston() else {
            return Ok(self.room.height);
        };
        if self.progress.seated_height.is_none() {
            self.bed.evaluate()?;
            let face = self.bed.packing().top + PISTON_GAP * self.terms.smallest;
            let middle = face + 0.5 * self.room.thickness;
            self.bed.machine_mut().lift(piston, middle);
            self.bed.list_again();
        }
        self.drive_piston(-speed);
        Ok(self.view().face(self.bed.as_ref()))
    }

    /// Notes what a stage waits for.
    pub(in crate::bed) fn note(&mut self, stage: &Stage, survey: Option<&Packing>) {
        let rest_speed = match stage {
            Stage::Settle { rest_speed, .. } => Some(*rest_speed),
            Stage::Run(run) => run.until.rest_speed,
            _ => None,
        };
        if let (Some(packing), Some(rest_speed)) = (survey, rest_speed) {
            let slow = packing.contacts > 0 && packing.rms_speed < rest_speed;
            let since = self.place.slow_since.unwrap_or(self.time());
            self.place.slow_since = slow.then_some(since);
        }
        if let Stage::Compress {
            speed,
            approach,
            seating_stress,
            seating_travel,
            ..
        } = stage
        {
            // the first touch is seen at once, a stress that lasts by the looks at it
            if survey.is_some() || *seating_travel == 0.0 {
                self.seat(*seating_stress, *seating_travel);
            }
            if approach > speed {
                self.slow_down(*speed, *approach, *seating_stress);
            }
        }
    }

    /// Drives the piston slower the nearer its stress is to that of its seat: v = v_a (1 - stress / seating stress), and
    /// never below the speed of the test, which holds once it is seated.
    fn slow_down(&mut self, speed: f64, approach: f64, seating_stress: f64) {
        let left = match (self.progress.seated_height, self.place.carried_since) {
            (None, None) => 1.0 - self.view().stress(self.bed.as_ref()) / seating_stress,
            _ => 0.0,
        };
        let wanted = (approach * left).max(speed);
        if wanted != self.progress.piston_speed {
            self.drive_piston(-wanted);
        }
    }

    /// Seats the piston where it first met a stress that has lasted since; strain counts from there.
    fn seat(&mut self, seating_stress: f64, seating_travel: f64) {
        if self.progress.seated_height.is_some() {
            return;
        }
        let (face, stress) = (
            self.view().face(self.bed.as_ref()),
            self.view().stress(self.bed.as_ref()),
        );
        if stress < seating_stress {
            self.place.carried_since = None;
            return;
        }
        let since = *self.place.carried_since.get_or_insert(face);
        if since - face < seating_travel {
            return;
        }
        self.progress.seated_height = Some(since);
        let stage = &self.progress.stage;
        let begun = self.rows.iter().rposition(|row| row.stage != *stage);
        for row in &mut self.rows[begun.map_or(0, |last| last + 1)..] {
            row.strain = ((since - row.height_m) / since).max(0.0);
        }
    }

    /// Records a row if one is due.
    pub(in crate::bed) fn sample(&mut self, stage: &Stage) -> Result<()> {
        let by_steps = matches!(stage, Stage::Relax { .. })
            || matches!(stage, Stage::Run(run) if matches!(run.longest, Duration::Steps(_)));
        let now = if by_steps {
            (self.step() - self.place.step) as f64
        } else {
            self.time()
        };
        if now < self.place.next_row {
            return Ok(());
        }
        self.place.next_row = after(now, self.place.next_row, self.place.interval);
        self.record(false)
    }

    /// Whether a stage is over; `survey` is there every few steps.
    pub(in crate::bed) fn ends(&self, stage: &Stage, survey: Option<&Packing>) -> Result<bool> {
        let bed = self.bed.as_ref();
        let done = (self.time() - self.place.time, self.step() - self.place.step);
        Ok(match stage {
            Stage::Settle {
                longest,
                rest_speed,
                ..
            } => self.rests(*rest_speed) || done.0 >= *longest,
            Stage::Relax { steps } => done.1 >= *steps,
            Stage::Compress { strain, .. } => {
                let (start, face) = (self.place.face, self.view().face(bed));
                match self.progress.seated_height {
                    Some(seated) => seated - face >= strain * seated,
                    None if start - face > LONGEST_APPROACH * start => {
                        let reason = "the piston met no resistance; lower `seating_stress` or look for lost grains";
                        return Err(self.stop(reason.to_owned()));
                    }
                    None => false,
                }
            }
            Stage::Unload { .. } => self.view().stress(bed) <= 0.0,
            Stage::Run(run) => {
                let over = match run.longest {
                    Duration::Time(time) => done.0 >= time,
                    Duration::Steps(steps) => done.1 >= steps,
                };
                over || self.holds(run, survey)
            }
        })
    }

    /// Whether all grains are in and have been slower than `speed` (m/s) for longer than free fall would take to
    /// reach it twice: slow because something carries them.
    fn rests(&self, speed: f64) -> bool {
        let gravity = self.terms.gravity.length();
        let fall = if gravity > 0.0 {
            2.0 * speed / gravity
        } else {
            0.0
        };
        let since = self.place.slow_since;
        since.is_some_and(|since| self.time() - since >= fall) && self.feed.is_done()
    }

    /// Whether a condition that ends a stage holds.
    fn holds(&self, run: &RunStage, survey: Option<&Packing>) -> bool {
        let (until, bed) = (&run.until, self.bed.as_ref());
        let slow = until.rest_speed.is_some_and(|speed| self.rests(speed));
        let calm = until.kinetic_energy.is_some_and(|energy| {
            survey.is_some() && self.feed.is_done() && bed.energies().kinetic < energy
        });
        let stressed = until
            .stress
            .is_some_and(|stress| self.view().stress(bed) > stress);
        let pushed = until.force.as_ref().is_some_and(|(body, above)| {
            let body = bed.machine().find(body);
            body.is_some_and(|body| bed.force_on(body).length() > *above)
        });
        let dry = until.flow_ended.is_some_and(|time| {
            let ended = |gauge: &Gauge| gauge.flow_ended(self.time(), time);
            self.gauges.iter().any(ended)
        });
        slow || calm || stressed || pushed || dry
    }

    /// What a stage does to the bed in every step.
    pub(in crate::bed) fn change(&mut self, stage: &Stage) {
        if let Stage::Relax { steps } = stage {
            let last = self.step() - self.place.step + 1 == *steps;
            let full = self.terms.softening;
            self.softening = if last {
                full
            } else {
                (self.softening * self.place.growth).min(full)
            };
            self.bed.soften(self.softening);
            let dt = self.terms.limits.rayleigh(self.softening);
            self.bed.set_dt(self.bed.clock().0.min(dt));
        }
    }

    /// Ends a stage.
    pub(in crate::bed) fn end(&self, stage: &Stage) {
        if let Stage::Run(run) = stage
            && !self.feed.is_done()
        {
            tracing::warn!(
                "{}: not all grains have come in; make the stage longer or the region larger",
                run.name
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::after;

    #[test]
    fn the_next_row_comes_after_now_however_short_the_interval() {
        assert_eq!(after(1.0, 1.0, 0.5), 1.5);
        assert_eq!(after(2.1, 1.0, 0.5), 2.5);
        assert_eq!(after(2.5, 1.0, 0.5), 3.0);
        for interval in [1e-12, 1e-27, 5e-324, 0.0] {
            let next = after(1.0, 0.0, interval);
            assert!(next > 1.0 && next <= 1.0 + 2e-12, "{interval}: {next}");
        }
    }
}
