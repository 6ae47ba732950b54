//! Run: one impact in progress, step by step.

use crate::curve::Status;
use crate::impact::contact::Wall;
use crate::impact::erosion::Erosion;
use crate::impact::kernel::{PointView, Purpose, Sweep};
use crate::impact::record::{Frame, Record, SectionView, Sliding, Snapshot};
use crate::impact::remap::{Remap, StepEnd};
use crate::impact::setup::Model;
use crate::impact::timestep::StabilityLimit;
use crate::material::stress::Constitutive;
use crate::plan::{Geometry, Plan, Remedies};
use crate::scheme::TimeStep;
use crate::space::Space;

/// Outputs over the expected contact time.
pub(super) const OUTPUTS: f64 = 400.0;
/// Energy imbalance (of the incident kinetic energy) beyond which a run is stopped as unstable.
const UNSTABLE: f64 = 0.05;
/// Most steps between refreshes of the stable time step and the contact candidates.
const REFRESH: f64 = 50.0;
/// Share of a cell that the wall may cover between refreshes: the stable step follows the strain of fast impacts.
const COVERED: f64 = 0.5;
/// The same where large deformation squeezes single cells much faster than the body.
const COVERED_LARGE: f64 = 0.1;

/// A run in progress.
pub(super) struct Run<'a, S, M, W, T, const N: usize>
where
    S: Space,
    M: Constitutive<S>,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    model: Model<S, M, W, N>,
    transfer: T,
    transferred: f64,
    plan: &'a Plan,
    speed: f64,
    u: Vec<S::Vector>,
    v: Vec<S::Vector>,
    old: Vec<S::Vector>,
    force: Vec<S::Vector>,
    limit: StabilityLimit<S>,
    dt: f64,
    time: f64,
    step: u64,
    next_refresh: u64,
    impulse: f64,
    tangential: f64,
    contact_work: f64,
    plastic: f64,
    contact_radius: f64,
    contact_end: f64,
    mass: f64,
    frames: Vec<Frame>,
    closure: f64,
    compressed: Option<Snapshot>,
    failure: Option<String>,
    erosion: Erosion,
}

impl<'a, S, M, W, T, const N: usize> Run<'a, S, M, W, T, N>
where
    S: Space,
    M: Constitutive<S>,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    pub(super) fn new(model: Model<S, M, W, N>, transfer: T, plan: &'a Plan, speed: f64) -> Self {
        let nodes = model.mass.len();
        let mass = model.mass.iter().sum::<f64>();
        let mut incident = S::Vector::default();
        incident.as_mut()[S::NORMAL] = -speed * plan.angle.cos();
        if let Some(axis) = S::SLIDING {
            incident.as_mut()[axis] = speed * plan.angle.sin();
        }
        let kinetic: f64 = incident.as_ref().iter().map(|v| 0.5 * mass * v * v).sum();
        let first = Frame {
            kinetic,
            height: 2.0,
            ..Frame::default()
        };
        Run {
            limit: StabilityLimit::new(nodes),
            u: vec![S::Vector::default(); nodes],
            v: vec![incident; nodes],
            old: vec![S::Vector::default(); nodes],
            force: vec![S::Vector::default(); nodes],
            model,
            transfer,
            transferred: 0.0,
            plan,
            speed,
            dt: 0.0,
            time: 0.0,
            step: 0,
            next_refresh: 0,
            impulse: 0.0,
            tangential: 0.0,
            contact_work: 0.0,
            plastic: 0.0,
            contact_radius: 0.0,
            contact_end: 0.0,
            mass,
            frames: vec![first],
            closure: 0.0,
            compressed: None,
            failure: None,
            erosion: Erosion::new(plan.grid.remedies.least_step),
        }
    }

    /// Step until the particle has rung out after its rebound, or the run must stop.
    pub(super) fn finish(mut self) -> Record {
        let interval = self.plan.estimate.contact_time / OUTPUTS;
        let mut next_output = interval;
        while self.failure.is_none() && !self.is_over() {
            if self.step == self.next_refresh {
                self.refresh();
            }
            let output = self.time >= next_output;
            if output {
                next_output += interval;
            }
            self.advance(output);
        }
        self.into_record()
    }

    /// Rebounded and rung out, flat, or out of time.
    fn is_over(&self) -> bool {
        let rung = self.time > self.contact_end + self.plan.ring_time;
        let rebounded = rung && self.mean(&self.v, S::NORMAL) > 0.0;
        rebounded || self.is_flat() || self.time > self.plan.longest_time
    }

    /// Spread into a sheet that has no height left to fall and hardly falls: it will not come back.
    fn is_flat(&self) -> bool {
        let tolerance = self.plan.tolerance;
        let left = 1.0 + self.mean(&self.u, S::NORMAL);
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
        let horizon = 2.0 * interval * self.dt;
        self.model
            .contact
            .refresh(self.transfer.travel(&self.u), 2.0 * self.speed, horizon);
    }

    /// Stable step of the present configuration; the last one where there is none to go on with.
    fn stable_step(&mut self) -> f64 {
        let model = &mut self.model;
        let found = self.erosion.stable_step(
            &mut self.limit,
            &mut model.points,
            &self.u,
            &model.recip_mass,
        );
        found.unwrap_or_else(|reason| {
            self.failure = Some(reason);
            self.dt
        })
    }

    /// Internal forces of this step. Where a point is turned inside out its cell is taken out, or the run stops.
    fn forces(&mut self, purpose: Purpose) -> Sweep {
        let points = &mut self.model.points;
        let sweep = points.sweep(purpose, &self.u, &mut self.force);
        if sweep.least_j > 0.0 {
            return sweep;
        }
        if !self.erosion.is_on() {
            let least = sweep.least_j;
            self.failure = Some(format!("volume ratio J = {least:e} at a material point"));
        } else if let Err(reason) = self.erosion.take_out_inverted(points, &self.u) {
            self.failure = Some(reason);
        }
        // the states of the others have moved on to these displacements: they answer as before and dissipate no more
        let again = points.sweep(purpose, &self.u, &mut self.force);
        Sweep {
            plastic: sweep.plastic + again.plastic,
            ..again
        }
    }

    /// One step of the symplectic scheme: forces at $u_n$, velocities to n + 1/2, contact, displacements to n + 1.
    fn advance(&mut self, output: bool) {
        let purpose = if output {
            Purpose::Audit
        } else {
            Purpose::Step
        };
        let sweep = self.forces(purpose);
        self.plastic += sweep.plastic;
        let dt = self.dt;
        for n in 0..self.u.len() {
            self.old[n] = self.v[n];
            let (force, weight) = (self.force[n], self.model.recip_mass[n]);
            let components = force.as_ref().iter().zip(weight.as_ref());
            for (v, (f, w)) in self.v[n].as_mut().iter_mut().zip(components) {
                *v += dt * f * w;
            }
        }
        let travel = self.transfer.travel(&self.u);
        let recip_mass = &self.model.recip_mass;
        let contact = &mut self.model.contact;
        let touch = contact.solve(dt, travel, &self.old, &mut self.v, recip_mass);
        self.impulse += touch.impulse;
        self.tangential += touch.tangential;
        self.contact_work += touch.work;
        self.contact_radius = self.contact_radius.max(touch.radius);
        if touch.impulse > 0.0 {
            self.contact_end = self.time + dt;
        }
        if output {
            self.record(sweep.elastic, touch.impulse);
        }
        let end = StepEnd {
            dt,
            old: &self.old,
            force: &self.force,
            mass: &self.model.mass,
            recip_mass: &self.model.recip_mass,
        };
        self.transferred += self.transfer.remap(end, &mut self.v);
        for (u, v) in self.u.iter_mut().zip(&self.v) {
            for (u, v) in u.as_mut().iter_mut().zip(v.as_ref()) {
                *u += dt * v;
            }
        }
        self.time += dt;
        self.step += 1;
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

    /// Keep a frame at time n (`impulse` of the step that is under way belongs half to each side).
    fn record(&mut self, elastic: f64, impulse: f64) {
        let kinetic: f64 = (self.old.iter().zip(&self.v).zip(&self.model.mass))
            .map(|((a, b), m)| {
                let mut product = 0.0;
                for (a, b) in a.as_ref().iter().zip(b.as_ref()) {
                    product += a * b;
                }
                0.5 * m * product
            })
            .sum();
        let incident = self.frames[0].kinetic;
        let given = incident + self.contact_work + self.transferred;
        let balance = kinetic + elastic + self.plastic + self.erosion.energy() - given;
        let closure = (balance / incident).abs();
        if !(closure <= UNSTABLE) {
            self.failure = Some(format!(
                "energy imbalance {closure:e} of the incident energy"
            ));
        }
        self.closure = self.closure.max(closure);
        let along = |marker: &[(usize, f64)]| -> f64 {
            marker
                .iter()
                .map(|(n, w)| w * self.u[*n].as_ref()[S::NORMAL])
                .sum()
        };
        let [south, centre, north] = &self.model.markers;
        let frame = Frame {
            time: self.time,
            displacement: -self.mean(&self.u, S::NORMAL),
            centre_displacement: -along(centre),
            impulse: self.impulse - 0.5 * impulse,
            contact_radius: self.contact_radius,
            kinetic,
            elastic,
            plastic: self.plastic,
            height: self.height(north, south),
        };
        self.contact_radius = 0.0;
        self.frames.push(frame);
        if self.compressed.is_none() && self.mean(&self.v, S::NORMAL) >= 0.0 {
            self.compressed = Some(self.snapshot());
        }
    }

    /// Distance of the poles.
    fn height(&self, north: &[(usize, f64)], south: &[(usize, f64)]) -> f64 {
        let mut squared = 0.0;
        for axis in 0..S::Vector::default().as_ref().len() {
            let along = |marker: &[(usize, f64)]| -> f64 {
                marker
                    .iter()
                    .map(|(n, w)| w * self.u[*n].as_ref()[axis])
                    .sum()
            };
            let rest = if axis == S::NORMAL { 2.0 } else { 0.0 };
            let distance = rest + along(north) - along(south);
            squared += distance * distance;
        }
        squared.sqrt()
    }

    /// Motion along the wall so far, where there can be any.
    fn sliding(&self) -> Option<Sliding> {
        let axis = S::SLIDING.filter(|_| self.plan.geometry == Geometry::Half)?;
        let centre: Vec<f64> = (0..S::Vector::default().as_ref().len())
            .map(|k| self.mean(&self.u, k) + self.mean(&self.model.places, k))
            .collect();
        let mut momentum = 0.0;
        for (n, mass) in self.model.mass.iter().enumerate() {
            let mut arm = self.u[n];
            for (k, x) in arm.as_mut().iter_mut().enumerate() {
                *x += self.model.places[n].as_ref()[k] - centre[k];
            }
            momentum += mass * S::moment(&arm, &self.v[n]);
        }
        Some(Sliding {
            incident: self.speed * self.plan.angle.sin(),
            exit: self.mean(&self.v, axis),
            spin: momentum / (0.4 * self.mass),
            impulse_ratio: -self.tangential / self.impulse,
        })
    }

    /// The particle as it is now.
    fn snapshot(&self) -> Snapshot {
        let model = &self.model;
        let seen = |p: PointView| {
            let volume = p.volume / model.copies;
            let depth = self.plan.grid.fine;
            S::section(&p.position, &p.reference, volume, depth).map(|place| SectionView {
                place,
                plastic_strain: p.plastic_strain,
                von_mises: p.von_mises,
            })
        };
        Snapshot {
            points: model
                .points
                .view(&self.u)
                .into_iter()
                .filter_map(seen)
                .collect(),
            outline: self.model.contact.outline(&self.u),
        }
    }

    /// Memory of points and nodes.
    fn bytes(&self) -> usize {
        let fields = [&self.u, &self.v, &self.old, &self.force];
        let nodes: usize = fields.iter().map(|f| std::mem::size_of_val(&f[..])).sum();
        self.model.points.bytes() + nodes + self.transfer.bytes()
    }

    fn into_record(self) -> Record {
        let memory_bytes = self.bytes();
        let exit_speed = if self.is_flat() {
            0.0
        } else {
            self.mean(&self.v, S::NORMAL)
        };
        let rebound = self.snapshot();
        let sliding = self.sliding();
        let status = match self.failure {
            Some(reason) => Status::Failed(format!("step {}: {reason}", self.step)),
            None if self.time > self.plan.longest_time => Status::NoRebound,
            None => Status::Ok,
        };
        Record {
            contact_end: self.contact_end,
            exit_speed,
            speed: self.speed * self.plan.angle.cos(),
            sliding,
            closure: self.closure,
            eroded: self.erosion.volume() / self.mass,
            plastic_strain: self.model.points.plastic_strain_volume() / self.mass,
            points: self.model.points.count(),
            steps: self.step,
            memory_bytes,
            transfer_loss: -self.transferred / self.frames[0].kinetic,
            frames: self.frames,
            compressed: self.compressed.unwrap_or_default(),
            rebound,
            status,
        }
    }
}
