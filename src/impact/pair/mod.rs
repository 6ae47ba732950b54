//! Pair: an impact of two deformable bodies, in the axisymmetric section and the crate's own scheme.
//!
//! Each body has a grid, points and a stable step of its own; both take the shorter one. Units are those of the first body, R = rho =
//! E = 1. Two spheres meet in the frame in which their centre of mass rests, so that their kinetic energy is the one that an impact
//! can take; a layer rests on its rigid foundation, where its nodes are held.
//!
//! Large deformation, three dimensions, friction, other schemes, mass scaling and repeated impacts do not exist here: nothing
//! in these types could ask for them.

mod body;
mod contact;
mod figures;

use self::body::{Body, Held};
use self::contact::PairContact;
use self::figures::PairRecord;
pub use self::figures::SimulatedPair;
use self::figures::TargetFrame;
use crate::case::pair::PairCase;
use crate::curve::Status;
use crate::impact::kernel::{Matter, PointView, Purpose, made_of};
use crate::impact::run::record::{Frame, SectionView, Snapshot};
use crate::impact::run::{COVERED, LEAST_STEP, OUTPUTS, REFRESH, UNSTABLE};
use crate::impact::wall::CONTACT_TOLERANCE;
use crate::material::flow::{FlowStress, FlowVisitor};
use crate::material::stress::{Elastic, J2, Moduli};
use crate::material::{Material, ReferenceUnits};
use crate::plan::pair::{Extent, MARGIN, PairPlan};
use crate::space::Axisymmetric;
use crate::tape::{Checkpoint, Keep, Keeper, Tape};

/// Runs on a layer made wider, after contact outlasted the plan.
const WIDENED: usize = 3;

/// Simulate one impact of two bodies as planned, kept in a file while it is under way where one is given.
///
/// Always returns what the run has; [`Status`] says whether it finished. Where contact outlasts the time in which the cut-off end of a
/// plate or half-space is not felt, the impact is run again on a wider one. A run that fails is tried once more with half the
/// time step, and a warning says so; only a good end counts.
#[must_use]
pub fn simulate_pair(
    pair: &PairCase,
    plan: &PairPlan,
    checkpoint: Option<&Checkpoint>,
) -> SimulatedPair {
    let started = std::time::Instant::now();
    let mut plan = plan.clone();
    let mut record = attempt(pair, &plan, checkpoint);
    for _ in 0..WIDENED {
        let stopped = matches!(record.status(), Status::Failed(_));
        if stopped || record.contact_end() <= plan.undisturbed() {
            break;
        }
        tracing::info!("contact outlasts the plan: run again on a wider wall");
        plan = plan.reaching(MARGIN * record.contact_end());
        record = attempt(pair, &plan, checkpoint);
    }
    if let Status::Failed(reason) = record.status() {
        tracing::warn!("{reason}; tried again with half the time step");
        let mut careful = plan.clone();
        careful.impact.grid.dt_share *= 0.5;
        let again = attempt(pair, &careful, checkpoint);
        // of two that did not end well the first tells more
        if *again.status() == Status::Ok {
            record = again;
        }
    }
    record.check(&plan);
    record.finish(pair, &plan, started.elapsed().as_secs_f64())
}

/// Run a plan.
fn attempt(pair: &PairCase, plan: &PairPlan, checkpoint: Option<&Checkpoint>) -> PairRecord {
    let (own, other) = (&pair.particle.material, &pair.target.material);
    let units = ReferenceUnits::of(own, pair.particle.radius);
    let density = other.density / own.density;
    let others = units_of_second(&units, other);
    let bodies = Bodies {
        matter: [matter(own, &units), matter(other, &others)],
        density,
    };
    let description = format!("{pair:?} {plan:?}");
    let keeper = checkpoint.map(|checkpoint| Keeper::new(checkpoint, &description));
    PairRun::new(plan, plan.impact.velocity / units.speed(), bodies).finish(keeper)
}

/// Units in which the constants of the second body become those of the run: stresses and rates as of the first, heat, which is per
/// mass, with its own density; so the length is another one for the same time.
fn units_of_second(units: &ReferenceUnits, other: &Material) -> ReferenceUnits {
    ReferenceUnits {
        density: other.density,
        length: units.length * (units.density / other.density).sqrt(),
        ..*units
    }
}

/// A material in given units.
fn matter(material: &Material, units: &ReferenceUnits) -> Box<dyn Matter<Axisymmetric>> {
    let modulus = material.young_modulus / units.stress;
    let moduli = Moduli::new(modulus, material.poisson_ratio);
    match material.flow {
        None => made_of(Elastic { moduli }),
        Some(flow) => flow.in_reference(units).visit(Yielding { moduli }),
    }
}

/// A plastic body, once its flow stress is known.
struct Yielding {
    moduli: Moduli,
}

impl FlowVisitor for Yielding {
    type Output = Box<dyn Matter<Axisymmetric>>;
    fn visit<F: FlowStress>(self, flow: F) -> Self::Output {
        let moduli = self.moduli;
        made_of(J2 { moduli, flow })
    }
}

/// What the two bodies are made of.
pub(super) struct Bodies {
    /// Matter of the first and of the second.
    pub(super) matter: [Box<dyn Matter<Axisymmetric>>; 2],
    /// Density of the second.
    pub(super) density: f64,
}

/// A run in progress.
#[derive(Clone)]
pub(super) struct PairRun<'a> {
    plan: &'a PairPlan,
    speed: f64,
    bodies: [Body; 2],
    contact: PairContact,
    /// Poles and centre of the first body, pole of the second.
    markers: [Held; 3],
    pole: Held,
    dt: f64,
    time: f64,
    step: u64,
    next_refresh: u64,
    next_output: f64,
    impulse: f64,
    contact_work: f64,
    contact_radius: f64,
    contact_end: f64,
    frames: Vec<Frame>,
    target: Vec<TargetFrame>,
    closure: f64,
    compressed: Option<[Snapshot; 2]>,
    failure: Option<String>,
}

impl<'a> PairRun<'a> {
    /// Two bodies that have just met.
    pub(super) fn new(plan: &'a PairPlan, speed: f64, made: Bodies) -> Self {
        let Bodies {
            matter: [first, second],
            density,
        } = made;
        let bodies = [
            Body::new(&plan.particle_grid(), first, 1.0),
            Body::new(&plan.target, second, density),
        ];
        let contact = PairContact::new(&bodies, CONTACT_TOLERANCE * speed);
        let mut run = PairRun {
            plan,
            speed,
            markers: [0.0, 1.0, 2.0].map(|z| bodies[0].on_axis(z)),
            pole: bodies[1].on_axis(0.0),
            bodies,
            contact,
            dt: 0.0,
            time: 0.0,
            step: 0,
            next_refresh: 0,
            next_output: plan.impact.estimate.contact_time / OUTPUTS,
            impulse: 0.0,
            contact_work: 0.0,
            contact_radius: 0.0,
            contact_end: 0.0,
            frames: Vec::new(),
            target: vec![TargetFrame::default()],
            closure: 0.0,
            compressed: None,
            failure: None,
        };
        let speeds = run.shares().map(|share| share * speed);
        let mut kinetic = 0.0;
        for (body, speed) in run.bodies.iter_mut().zip(speeds) {
            body.start(speed);
            kinetic += 0.5 * body.whole * speed * speed;
        }
        run.frames.push(Frame {
            kinetic,
            height: 2.0,
            ..Frame::default()
        });
        run
    }

    /// Shares of the relative speed with which the two bodies come.
    fn shares(&self) -> [f64; 2] {
        let [first, second] = &self.bodies;
        match second.extent {
            Extent::Layer { .. } => [1.0, 0.0],
            Extent::Sphere { .. } => {
                let sum = first.whole + second.whole;
                [second.whole / sum, first.whole / sum]
            }
        }
    }

    /// Step until the bodies have rung out after the rebound, or the run must stop. It is kept by `keeper` while it is under way,
    /// and resumed where one was kept.
    pub(super) fn finish(mut self, mut keeper: Option<Keeper>) -> PairRecord {
        if let Some(keeper) = &mut keeper
            && keeper.take_up(&mut self)
        {
            tracing::info!("resumed at step {}", self.step);
        }
        while self.failure.is_none() && !self.is_over() {
            if let Some(keeper) = keeper.as_mut().filter(|k| k.is_due()) {
                // a run that cannot be kept is still worth finishing
                if let Err(error) = keeper.keep(&self) {
                    tracing::warn!("{error}");
                }
            }
            self.advance();
        }
        let mut record = self.take_record();
        if let Some(keeper) = &keeper {
            record.record.seconds_before = keeper.seconds_before();
            keeper.forget();
        }
        record
    }

    /// Rebounded and rung out, or out of time.
    fn is_over(&self) -> bool {
        let rung = self.time > self.contact_end + self.plan.impact.ring_time;
        (rung && self.parting() > 0.0) || self.time > self.plan.impact.longest_time
    }

    /// Relative velocity of the centres of mass, positive as they part; of the first body alone on a layer.
    fn parting(&self) -> f64 {
        self.relative(|body| &body.v)
    }

    /// Distance by which a nodal field parts the centres of mass; on a layer, that of the first body moves alone.
    fn relative(&self, field: impl Fn(&Body) -> &[[f64; 2]]) -> f64 {
        let [first, second] = &self.bodies;
        let moved = first.mean(field(first));
        match second.extent {
            Extent::Layer { .. } => moved,
            Extent::Sphere { .. } => moved + second.mean(field(second)),
        }
    }

    /// Stable time step and pairs of surface points of the present configuration.
    fn refresh(&mut self) {
        let steps = self.bodies.each_mut().map(Body::stable_step);
        let fine = self.plan.impact.grid.fine.min(self.plan.target.fine);
        let dt = steps[0].min(steps[1]) * self.plan.impact.grid.dt_share;
        if !(dt >= LEAST_STEP * fine && dt.is_finite()) {
            self.failure = Some(format!(
                "stable time step {dt:e} R/c0: nodes without mass, or a body that has come apart"
            ));
            return;
        }
        self.dt = dt;
        let covering = COVERED * fine / (self.speed * dt);
        let interval = covering.clamp(1.0, REFRESH).floor();
        self.next_refresh += interval as u64;
        let (speed, horizon) = (2.0 * self.speed, 2.0 * interval * dt);
        self.contact.refresh(&self.bodies, speed, horizon);
    }

    /// One step: forces at $u_n$, velocities to n + 1/2, contact, displacements to n + 1.
    pub(super) fn advance(&mut self) {
        if self.step == self.next_refresh {
            self.refresh();
        }
        if self.failure.is_some() {
            return;
        }
        let output = self.time >= self.next_output;
        let purpose = if output {
            Purpose::Audit
        } else {
            Purpose::Step
        };
        let dt = self.dt;
        let sweeps = self.bodies.each_mut().map(|body| body.kick(purpose, dt));
        let least = sweeps[0].least_j.min(sweeps[1].least_j);
        if !(least > 0.0 && sweeps.iter().all(|s| s.least_j > 0.0)) {
            self.failure = Some(format!("volume ratio J = {least:e} at a material point"));
            return;
        }
        let touch = self.contact.solve(dt, &mut self.bodies);
        self.impulse += touch.impulse;
        self.contact_work += touch.work;
        self.contact_radius = self.contact_radius.max(touch.radius);
        if touch.impulse > 0.0 {
            self.contact_end = self.time + dt;
        }
        if output {
            self.next_output += self.plan.impact.estimate.contact_time / OUTPUTS;
            self.record(sweeps.map(|s| s.elastic), touch.impulse);
        }
        for body in &mut self.bodies {
            body.drift(dt);
        }
        self.time += dt;
        self.step += 1;
    }

    /// Keep a frame at time n (the impulse of the step that is under way belongs half to each side).
    fn record(&mut self, elastic: [f64; 2], impulse: f64) {
        let kinetic = self.bodies.each_ref().map(Body::kinetic);
        let plastic = self.bodies.each_ref().map(|body| body.plastic);
        let sum = |both: [f64; 2]| both[0] + both[1];
        let incident = self.frames[0].kinetic;
        let balance = sum(kinetic) + sum(elastic) + sum(plastic) - incident - self.contact_work;
        let closure = (balance / incident).abs();
        if !(closure <= UNSTABLE) {
            self.failure = Some(format!(
                "energy imbalance {closure:e} of the incident energy"
            ));
        }
        self.closure = self.closure.max(closure);
        let [first, second] = &self.bodies;
        let [south, centre, north] = &self.markers;
        self.frames.push(Frame {
            time: self.time,
            displacement: -self.relative(|body| &body.u),
            centre_displacement: match second.extent {
                Extent::Layer { .. } => -first.sunk(centre),
                Extent::Sphere { .. } => -first.sunk(centre) - second.mean(&second.u),
            },
            impulse: self.impulse - 0.5 * impulse,
            tangential: 0.0,
            contact_radius: self.contact_radius,
            kinetic: sum(kinetic),
            elastic: sum(elastic),
            plastic: sum(plastic),
            surface: 0.0,
            height: first.height(south, north),
        });
        // a free body flies on as a whole; what is left is its vibration
        let flight = match second.extent {
            Extent::Layer { .. } => 0.0,
            Extent::Sphere { .. } => {
                0.5 * second.whole * second.mean(&second.old) * second.mean(&second.v)
            }
        };
        self.target.push(TargetFrame {
            dent: match second.extent {
                Extent::Layer { .. } => second.sunk(&self.pole),
                Extent::Sphere { .. } => second.sunk(&self.pole) - second.mean(&second.u),
            },
            left: kinetic[1] - flight + elastic[1],
            plastic: plastic[1],
        });
        self.contact_radius = 0.0;
        if self.compressed.is_none() && self.parting() >= 0.0 {
            self.compressed = Some(self.snapshots());
        }
    }

    /// Both bodies as they are now, in the coordinates of the first one.
    fn snapshots(&self) -> [Snapshot; 2] {
        let signs = [1.0, -1.0];
        [0, 1].map(|b| {
            let body = &self.bodies[b];
            let seen = |p: PointView| {
                let [across, up, size] = Body::seen(&p.position, &p.reference, p.volume)?;
                Some(SectionView {
                    place: [across, signs[b] * up, size],
                    plastic_strain: p.plastic_strain,
                    von_mises: p.von_mises,
                    pressure: p.pressure,
                    temperature: p.temperature.unwrap_or_default(),
                })
            };
            Snapshot {
                points: (body.points.view(&body.u).into_iter())
                    .filter_map(seen)
                    .collect(),
                outline: (body.outline().into_iter())
                    .map(|(r, z)| (r, signs[b] * z))
                    .collect(),
            }
        })
    }
}

impl Keep for PairRun<'_> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            plan: _,
            speed: _,
            markers: _,
            pole: _,
            failure: _,
            bodies,
            contact,
            dt,
            time,
            step,
            next_refresh,
            next_output,
            impulse,
            contact_work,
            contact_radius,
            contact_end,
            frames,
            target,
            closure,
            compressed,
        } = self;
        bodies.save(tape);
        contact.save(tape);
        (*step, *next_refresh).save(tape);
        for number in [
            dt,
            time,
            next_output,
            impulse,
            contact_work,
            contact_radius,
            contact_end,
            closure,
        ] {
            number.save(tape);
        }
        frames.save(tape);
        target.save(tape);
        compressed.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.bodies.load(tape)?;
        self.contact.load(tape, &self.bodies)?;
        let mut counts = (0u64, 0u64);
        counts.load(tape)?;
        (self.step, self.next_refresh) = counts;
        for number in [
            &mut self.dt,
            &mut self.time,
            &mut self.next_output,
            &mut self.impulse,
            &mut self.contact_work,
            &mut self.contact_radius,
            &mut self.contact_end,
            &mut self.closure,
        ] {
            number.load(tape)?;
        }
        self.frames.load(tape)?;
        self.target.load(tape)?;
        self.compressed.load(tape)
    }
}

#[cfg(test)]
mod kept;
