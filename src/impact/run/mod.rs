//! Run: one impact in progress, step by step.

pub(crate) mod record;
pub(crate) mod transfer;

mod advance;
#[cfg(test)]
mod kept;
mod observe;
mod turning;

use self::record::{Frame, Record, Snapshot};
use self::transfer::Remap;
use crate::curve::Status;
use crate::impact::kernel::{Part, Purpose};
use crate::impact::model::Model;
use crate::impact::stepping::erosion::Erosion;
use crate::impact::stepping::levels::LocalStep;
use crate::impact::stepping::stability::StabilityLimit;
use crate::impact::wall::meridian::Wall;
use crate::plan::{Plan, Remedies};
use crate::scheme::{TimeStep, Transfer};
use crate::space::Space;
use crate::tape::{Keeper, keep_fields};

/// Outputs over the expected contact time.
pub(in crate::impact) const OUTPUTS: f64 = 400.0;
/// Energy imbalance (of the incident kinetic energy) beyond which a run is stopped as unstable.
pub(in crate::impact) const UNSTABLE: f64 = 0.05;
/// Stable step, in times that a bar wave takes through the smallest cell, below which a run is stopped: a node has hardly any
/// mass (a point on the rim of its functions), or cells are crushed for good. Of nine runs from slight to flattened, E/Y 40 to
/// 20000, none came below 0.05.
pub(in crate::impact) const LEAST_STEP: f64 = 1e-3;
/// Most steps between refreshes of the stable time step and the contact candidates.
pub(in crate::impact) const REFRESH: f64 = 50.0;
/// Share of a cell that the wall may cover between refreshes: the stable step follows the strain of fast impacts.
pub(in crate::impact) const COVERED: f64 = 0.5;
/// The same where large deformation squeezes single cells much faster than the body.
const COVERED_LARGE: f64 = 0.1;

/// Way that the centre of mass can have gone, in ways at the impact speed: more than one by what rounding and an unstable run may add.
const MOST_FALLEN: f64 = 1.5;

/// Where an impact began: of a first one all zero.
#[derive(Debug, Clone, Copy, Default)]
struct Start {
    /// Mean displacement along the normal.
    height: f64,
    /// Displacement of the material centre along the normal.
    centre: f64,
    /// Elastic energy of the stresses left by the impact before.
    elastic: f64,
    /// Elastic energy booked to erosion by then.
    eroded: f64,
}

keep_fields!(Start: height, centre, elastic, eroded);
keep_fields!(
    impl [S: Space, W: Wall<S>, T: Remap<S::Vector>, const N: usize]
    Run<'_, S, W, T, N>:
    model, transfer, transferred, u, v, limit, local, dt, time, step, stepped, next_refresh, next_output, impulse, tangential,
    contact_work, surface, plastic, shock, contact_radius, contact_end, frames, closure, compressed, film, erosion, start;
    rebuilt plan, speed, old, force, blocks, mass, failure, excess,
);

/// A run in progress.
#[derive(Clone)]
pub(in crate::impact) struct Run<'a, S, W, T, const N: usize>
where
    S: Space,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    model: Model<S, W, N>,
    transfer: T,
    transferred: f64,
    plan: &'a Plan,
    speed: f64,
    u: Vec<S::Vector>,
    v: Vec<S::Vector>,
    old: Vec<S::Vector>,
    force: Vec<S::Vector>,
    limit: StabilityLimit<S>,
    local: LocalStep<S, W>,
    /// Time step, the long one where some cells take short ones.
    dt: f64,
    time: f64,
    step: u64,
    /// Blocks of points stepped so far, and those of the body.
    stepped: u64,
    blocks: u64,
    next_refresh: u64,
    next_output: f64,
    impulse: f64,
    tangential: f64,
    contact_work: f64,
    /// Energy of the surface that the wall attracts.
    surface: f64,
    plastic: f64,
    shock: f64,
    contact_radius: f64,
    contact_end: f64,
    mass: f64,
    frames: Vec<Frame>,
    closure: f64,
    compressed: Option<Snapshot>,
    film: Vec<(f64, Snapshot)>,
    failure: Option<String>,
    erosion: Erosion,
    start: Start,
    /// Moment of inertia of the lumped masses above that of the body.
    excess: f64,
}

impl<'a, S, W, T, const N: usize> Run<'a, S, W, T, N>
where
    S: Space,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    pub(in crate::impact) fn new(
        model: Model<S, W, N>,
        transfer: T,
        plan: &'a Plan,
        speed: f64,
    ) -> Self {
        let nodes = model.mass.len();
        let mass = model.mass.iter().sum::<f64>();
        let mut run = Run {
            limit: StabilityLimit::new(nodes),
            local: LocalStep::new(&remedies(plan), &model.contact, nodes),
            u: vec![S::Vector::default(); nodes],
            v: vec![incident::<S>(plan, speed); nodes],
            old: vec![S::Vector::default(); nodes],
            force: vec![S::Vector::default(); nodes],
            transfer,
            transferred: 0.0,
            plan,
            speed,
            dt: 0.0,
            time: 0.0,
            step: 0,
            stepped: 0,
            blocks: model.points.blocks_of(Part::All),
            next_refresh: 0,
            next_output: 0.0,
            impulse: 0.0,
            tangential: 0.0,
            contact_work: 0.0,
            surface: 0.0,
            plastic: 0.0,
            shock: 0.0,
            contact_radius: 0.0,
            contact_end: 0.0,
            mass,
            frames: Vec::new(),
            closure: 0.0,
            compressed: None,
            film: Vec::new(),
            failure: None,
            erosion: Erosion::new(plan.grid.remedies.least_step),
            start: Start::default(),
            excess: 0.0,
            model,
        };
        run.excess = run.excess_inertia();
        run.lift(run.model.contact.range());
        run.frames.push(run.first_frame());
        run.take_first_picture();
        run
    }

    /// Run the impacts of the plan one after the other; those after one that did not end well are left out. A single impact
    /// is kept by `keeper` while it is under way, and resumed where one was kept.
    pub(in crate::impact) fn finish(mut self, mut keeper: Option<Keeper>) -> Vec<Record> {
        if let Some(keeper) = &mut keeper
            && keeper.take_up(&mut self)
        {
            tracing::info!("resumed at step {}", self.step);
        }
        let mut records = Vec::with_capacity(self.plan.impacts);
        loop {
            self.rebound(keeper.as_mut());
            records.push(self.take_record());
            let ended_well = records.last().is_some_and(|r| r.status == Status::Ok);
            if records.len() >= self.plan.impacts || !ended_well || self.is_flat() {
                break;
            }
            self.start_again();
        }
        if let Some(keeper) = &keeper {
            records[0].seconds_before = keeper.seconds_before();
            keeper.forget();
        }
        records
    }

    /// Step until the particle has rung out after its rebound, or the run must stop.
    fn rebound(&mut self, mut keeper: Option<&mut Keeper>) {
        let interval = self.plan.estimate.contact_time / OUTPUTS;
        while self.failure.is_none() && !self.is_over() {
            if keeper.as_deref().is_some_and(Keeper::is_stopped) {
                self.failure = Some("stopped".to_owned());
                break;
            }
            if let Some(keeper) = keeper.as_deref_mut().filter(|k| k.is_due()) {
                // a run that cannot be kept is still worth finishing
                if let Err(error) = keeper.keep(self) {
                    tracing::warn!("{error}");
                }
            }
            if self.step == self.next_refresh {
                self.refresh();
            }
            if self.step == 0 {
                self.next_output = interval;
            }
            let output = self.time >= self.next_output;
            if output {
                self.next_output += interval;
            }
            self.advance(output);
        }
    }

    /// The particle as its rebound left it, without the vibration, back on its way to the wall, which it just touches.
    fn start_again(&mut self) {
        let outline = self.model.contact.outline(&self.u);
        let lowest = outline.iter().fold(f64::INFINITY, |a, (_, z)| a.min(*z));
        for u in &mut self.u {
            u.as_mut()[S::NORMAL] -= lowest;
        }
        let incident = self.incident();
        self.v.fill(incident);
        let elastic = (self.model.points)
            .sweep(Purpose::Audit, &self.u, &mut self.force)
            .elastic;
        self.start = Start {
            height: self.mean(&self.u, S::NORMAL),
            centre: self.along(&self.model.markers[1]),
            elastic,
            eroded: self.erosion.energy(),
        };
        self.lift(self.model.contact.range());
        let [south, _, north] = &self.model.markers;
        let first = Frame {
            height: self.height(north, south),
            elastic,
            ..self.first_frame()
        };
        self.frames = vec![first];
        self.take_first_picture();
        (self.time, self.step, self.stepped, self.next_refresh) = (0.0, 0, 0, 0);
        (self.impulse, self.tangential, self.contact_work) = (0.0, 0.0, 0.0);
        (self.plastic, self.shock, self.surface) = (0.0, 0.0, 0.0);
        (self.transferred, self.closure) = (0.0, 0.0);
        (self.contact_radius, self.contact_end) = (0.0, 0.0);
    }

    /// Take the body away from the wall by `range`: where a wall attracts, an impact begins where it is first felt.
    fn lift(&mut self, range: f64) {
        if range > 0.0 {
            for u in &mut self.u {
                u.as_mut()[S::NORMAL] += range;
            }
        }
    }

    /// Velocity before the impact.
    fn incident(&self) -> S::Vector {
        incident::<S>(self.plan, self.speed)
    }

    /// The moment of first contact.
    fn first_frame(&self) -> Frame {
        let squared: f64 = self.incident().as_ref().iter().map(|v| v * v).sum();
        Frame {
            kinetic: 0.5 * self.mass * squared,
            height: self.plan.grid.shape.height(),
            displacement: 0.0 - self.model.contact.range(),
            centre_displacement: 0.0 - self.model.contact.range(),
            ..Frame::default()
        }
    }

    /// Rebounded and rung out, held by the wall, flat, or out of time.
    fn is_over(&self) -> bool {
        let rung = self.time > self.contact_end + self.plan.ring_time;
        let rebounded = rung && self.mean(&self.v, S::NORMAL) > 0.0;
        rebounded || self.sticks() || self.is_flat() || self.time > self.plan.longest_time
    }

    /// On its way back to a wall that attracts it, before it came free of it.
    fn sticks(&self) -> bool {
        let attracted = self.model.contact.range() > 0.0 && self.compressed.is_some();
        attracted && self.mean(&self.v, S::NORMAL) < 0.0
    }

    /// Spread into a sheet that has no height left to fall and hardly falls: it will not come back.
    fn is_flat(&self) -> bool {
        let tolerance = self.plan.tolerance;
        let height = 0.5 * self.plan.grid.shape.height();
        // the wall only ever pushes it back: so far it can have fallen, and a mean over all nodes is dear in three dimensions
        let fallen = MOST_FALLEN * self.speed * self.time;
        if height + self.start.height - fallen > tolerance {
            return false;
        }
        let left = height + self.mean(&self.u, S::NORMAL);
        let sinking = -self.mean(&self.v, S::NORMAL) / self.speed;
        left < tolerance && (0.0..0.5 * tolerance).contains(&sinking)
    }

    /// Stable time step and contact candidates of the present configuration.
    fn refresh(&mut self) {
        self.dt = match self.plan.scheme.time_step {
            TimeStep::Stable => self.stable_step() * self.plan.grid.dt_share,
            TimeStep::Fixed(dt) => dt,
        };
        let covered = if self.plan.grid.remedies == Remedies::NONE {
            COVERED
        } else {
            COVERED_LARGE
        };
        let covering = covered * self.plan.grid.fine / (self.speed * self.dt);
        let interval = covering.clamp(1.0, REFRESH).floor();
        self.next_refresh += interval as u64;
        let fastest = self.speed.max(self.model.contact.snapping());
        let (speed, horizon) = (2.0 * fastest, 2.0 * interval * self.dt);
        let travel = self.transfer.travel(&self.u);
        self.model
            .contact
            .refresh(travel, speed, horizon, &|_| true);
        self.local
            .refresh(travel, speed, horizon, &self.model.points);
    }

    /// Stable step of the present configuration; the last one where there is none to go on with: where erosion gives up, where
    /// displacements are no numbers any more, or where it would take for ever.
    fn stable_step(&mut self) -> f64 {
        let model = &mut self.model;
        let found = self.local.stable_step(
            &mut self.limit,
            &mut self.erosion,
            &mut model.points,
            &self.u,
            &model.recip_mass,
        );
        let least = LEAST_STEP * self.plan.grid.fine;
        let found = found.and_then(|dt| match dt.is_finite() && dt >= least {
            true => Ok(dt),
            false => Err(format!(
                "stable time step {dt:e} R/c0: nodes without mass, or a body that has come apart"
            )),
        });
        found.unwrap_or_else(|reason| {
            self.failure = Some(reason);
            self.dt
        })
    }

    /// Mass average of component `axis` of a nodal field.
    fn mean(&self, field: &[S::Vector], axis: usize) -> f64 {
        let sum: f64 = field
            .iter()
            .zip(&self.model.mass)
            .map(|(x, m)| m * x.as_ref()[axis])
            .sum();
        sum / self.mass
    }
}

/// Remedies of a plan; cells take steps of their own only where nothing else acts on velocities in between.
fn remedies(plan: &Plan) -> Remedies {
    let scheme = &plan.scheme;
    let applies = scheme.transfer == Transfer::Persistent && scheme.time_step == TimeStep::Stable;
    let remedies = plan.grid.remedies;
    let long_step = if applies { remedies.long_step } else { 0.0 };
    Remedies {
        long_step,
        ..remedies
    }
}

/// Velocity before an impact at `speed`.
pub(in crate::impact) fn incident<S: Space>(plan: &Plan, speed: f64) -> S::Vector {
    let mut incident = S::Vector::default();
    incident.as_mut()[S::NORMAL] = -speed * plan.angle.cos();
    if let Some(axis) = S::SLIDING {
        incident.as_mut()[axis] = speed * plan.angle.sin();
    }
    incident
}
