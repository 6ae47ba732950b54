//! Figures of a pair: what a run of two bodies leaves, and how it becomes curves, figures and maps in SI units.

use super::PairRun;
use crate::case::pair::{PairCase, TargetShape};
use crate::curve::{Heating, Impact, ParticleMap, Status, Target};
use crate::impact::kernel::Warmth;
use crate::impact::run::record::{Record, Snapshot};
use crate::material::MaterialTable;
use crate::plan::pair::PairPlan;
use crate::tape::keep_fields;

/// What is kept of the second body at an output, in run units.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TargetFrame {
    /// Travel of its pole towards its centre of mass; of a layer, towards its back.
    pub(super) dent: f64,
    /// Energy of its waves, vibration and stresses.
    pub(super) left: f64,
    /// Plastic work in it so far.
    pub(super) plastic: f64,
}

keep_fields!(TargetFrame: dent, left, plastic);

/// All that a run of two bodies leaves.
pub struct PairRecord {
    /// Of both as of one impact on a wall; maps and strains are those of the first body.
    pub(super) record: Record,
    target: Vec<TargetFrame>,
    /// The second body at the largest displacement and at the end.
    maps: [Snapshot; 2],
    warmth: Option<Warmth>,
}

/// What a simulated impact of two bodies leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedPair {
    /// Curve and figures.
    pub impact: Impact,
    /// The particle and the second body at the largest displacement.
    pub compressed: [ParticleMap; 2],
    /// The particle and the second body after the rebound.
    pub rebound: [ParticleMap; 2],
}

impl PairRun<'_> {
    /// All that the impact leaves.
    pub(super) fn take_record(mut self) -> PairRecord {
        let [first, second] = &self.bodies;
        let status = match &self.failure {
            Some(reason) => Status::Failed(format!("step {}: {reason}", self.step)),
            None if self.time > self.plan.impact.longest_time => Status::NoRebound,
            None => Status::Ok,
        };
        let [particle, layer] = self.snapshots();
        let [compressed, pressed] = self.compressed.take().unwrap_or_default();
        let mut record = Record {
            contact_end: self.contact_end,
            exit_speed: self.parting(),
            speed: self.speed,
            shape: self.plan.impact.grid.shape,
            sliding: None,
            closure: self.closure,
            eroded: 0.0,
            shock: 0.0,
            knocking: 0.0,
            has_poles: true,
            plastic_strain: first.points.plastic_strain_volume() / first.points.volume(),
            warmth: first.points.warmth(),
            points: first.points.count() + second.points.count(),
            steps: self.step,
            seconds_before: 0.0,
            memory_bytes: first.bytes() + second.bytes(),
            transfer_loss: 0.0,
            contact_loss: 0.0,
            frames: std::mem::take(&mut self.frames),
            compressed,
            rebound: particle,
            film: Vec::new(),
            status,
        };
        if record.status == Status::Ok
            && let Err(reason) = record.verdict(self.plan.impact.tolerance)
        {
            record.status = Status::Failed(reason);
        }
        PairRecord {
            warmth: second.points.warmth(),
            target: std::mem::take(&mut self.target),
            maps: [pressed, layer],
            record,
        }
    }
}

impl PairRecord {
    /// Whether the run ended well.
    pub(in crate::impact) fn status(&self) -> &Status {
        &self.record.status
    }

    /// Time of the last contact, R/c0.
    pub(in crate::impact) fn contact_end(&self) -> f64 {
        self.record.contact_end
    }

    /// Marks the run as failed where contact outlasted what the plan can tell.
    pub(in crate::impact) fn check(&mut self, plan: &PairPlan) {
        let end = plan.undisturbed();
        if self.record.contact_end > end && !matches!(self.record.status, Status::Failed(_)) {
            self.record.status = Status::Failed(format!(
                "waves came back from where the wall is cut off, {end:e} R/c0 after first contact, before contact ended"
            ));
        }
    }

    /// Curve, figures and maps in SI units; `seconds` is the time the runs took.
    pub(in crate::impact) fn finish(
        self,
        case: &PairCase,
        plan: &PairPlan,
        seconds: f64,
    ) -> SimulatedPair {
        let (material, radius) = (&case.particle.material, case.particle.radius);
        let record = &self.record;
        let wall = record.seconds_before + seconds;
        let mut impact = record.impact(material, radius, &plan.impact, wall);
        let halves = self.target.windows(2);
        for (sample, pair) in impact.curve.samples.iter_mut().zip(halves) {
            sample.target_displacement_m = Some(0.5 * radius * (pair[0].dent + pair[1].dent));
        }
        let work = self.target.last().map_or(0.0, |last| last.plastic) / record.frames[0].kinetic;
        let own = impact.summary.plastic_work_ratio - work;
        impact.summary.heating = record.warmth.map(|warmth| heating(warmth, own));
        impact.summary.target = Some(self.target(case, work));
        let [compressed, rebound] = &self.maps;
        SimulatedPair {
            impact,
            compressed: [&record.compressed, compressed].map(|map| map.map(material, radius)),
            rebound: [&record.rebound, rebound].map(|map| map.map(material, radius)),
        }
    }

    /// Figures of the second body, on which this share of the incident energy was spent as plastic work.
    fn target(&self, case: &PairCase, work: f64) -> Target {
        let radius = case.particle.radius;
        let deepest = self.target.iter().map(|f| f.dent).fold(0.0, f64::max);
        let last = self.target.last().copied().unwrap_or_default();
        let (own_radius, thickness) = match case.target.shape {
            TargetShape::Sphere { radius } => (Some(radius), None),
            TargetShape::Plate { thickness } => (None, Some(thickness)),
            TargetShape::HalfSpace => (None, None),
        };
        Target {
            shape: case.target.shape.name().to_owned(),
            radius_m: own_radius,
            thickness_m: thickness,
            material: MaterialTable::from(&case.target.material),
            max_indentation_m: deepest * radius,
            residual_indentation_m: self.resting() * radius,
            plastic_work_ratio: work,
            retained_energy_ratio: last.left / self.record.frames[0].kinetic,
            heating: self.warmth.map(|warmth| heating(warmth, work)),
        }
    }

    /// Depth of the dent after loss of contact, weighted by a Hann window so that part periods do not bias it.
    fn resting(&self) -> f64 {
        if self.target.last().is_none_or(|last| last.plastic == 0.0) {
            // what has not yielded comes back; its vibration does not average to that
            return 0.0;
        }
        let frames = &self.record.frames;
        let (from, to) = (
            self.record.contact_end,
            frames.last().map_or(0.0, |f| f.time),
        );
        let (mut sum, mut weight) = (0.0, 0.0);
        for (frame, target) in frames.iter().zip(&self.target) {
            if frame.time > from && to > from {
                let share = (frame.time - from) / (to - from);
                let w = (std::f64::consts::PI * share).sin().powi(2);
                sum += w * target.dent;
                weight += w;
            }
        }
        sum / weight
    }
}

/// What became of plastic work that is this share of the incident energy.
fn heating(warmth: Warmth, work: f64) -> Heating {
    Heating {
        heat_ratio: warmth.share * work,
        stored_work_ratio: (1.0 - warmth.share) * work,
        max_temperature_k: warmth.hottest,
        mean_temperature_k: warmth.mean,
    }
}
