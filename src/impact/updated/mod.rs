//! Updated Lagrangian: points move through the grid, nodal masses and all weights are computed anew every step, velocity
//! lives on the points. Simple, one point at a time; it exists to be compared.
//!
//! The step is that of the thesis with gradients taken in the present configuration. Each point keeps its deformation
//! gradient; with weights $F^T \nabla N$ the kernel's reference form of forces and gradients holds as it stands.

pub(crate) mod deformation;

use self::deformation::{Deformation, gradient, pulled_back};
use crate::curve::Status;
use crate::impact::grid::section::Section;
use crate::impact::kernel::{Matter, Warmth};
use crate::impact::points::lattice;
use crate::impact::points::section::SectionPoint;
use crate::impact::run::OUTPUTS;
use crate::impact::run::record::{Frame, Record, SectionView, Snapshot};
use crate::impact::wall::CONTACT_TOLERANCE;
use crate::impact::wall::meridian::{Contact, Wall};
use crate::lanes::Lanes;
use crate::material::stress::{Kinematics, Moduli};
use crate::plan::Plan;
use crate::scheme::{Layout, TimeStep, Transfer};
use crate::shape::Shape;
use crate::space::{Axisymmetric, Space, Symmetric};
use std::f64::consts::PI;

/// Width and height of the grid.
const ROOM: (f64, f64) = (1.5, 2.8);
const USUAL: f64 = 50.0;

/// A point on its way.
#[derive(Debug, Clone, Copy)]
struct Mover {
    /// Its block of the matter.
    block: usize,
    start: [f64; 2],
    position: [f64; 2],
    velocity: [f64; 2],
    deformation: Deformation,
    volume: f64,
    mean: f64,
    shear_norm: f64,
}

/// Nodes and present weights of a point.
struct Reach<const N: usize> {
    node: usize,
    values: [f64; N],
    gradients: [[f64; 3]; N],
}

/// An updated Lagrangian run.
pub struct Updated<'a, const P: usize, const N: usize> {
    plan: &'a Plan,
    speed: f64,
    /// A block a mover.
    matter: Box<dyn Matter<Axisymmetric>>,
    moduli: Moduli,
    section: Section<P>,
    offsets: [usize; N],
    movers: Vec<Mover>,
    reaches: Vec<Reach<N>>,
    surface: Vec<usize>,
    sole: f64,
    mass: Vec<f64>,
    recip_mass: Vec<[f64; 2]>,
    old: Vec<[f64; 2]>,
    v: Vec<[f64; 2]>,
    still: Vec<[f64; 2]>,
    dt: f64,
    time: f64,
    step: u64,
    impulse: f64,
    work: f64,
    plastic: f64,
    radius: f64,
    contact_end: f64,
    least_j: f64,
}

impl<'a, const P: usize, const N: usize> Updated<'a, P, N> {
    /// Lay out the points of `matter`, which has none yet.
    pub fn new(plan: &'a Plan, mut matter: Box<dyn Matter<Axisymmetric>>, speed: f64) -> Self {
        let count = match plan.scheme.layout {
            Layout::Lattice(count) | Layout::Centred(count) => count,
            Layout::Fitted => USUAL,
        };
        let section = Section::<P>::uniform(plan.grid.fine, ROOM);
        let nodes = section.nodes();
        let points = lattice::points(count);
        let surface = lattice::outermost(count);
        let index = |r: f64, z: f64| points.iter().position(|p| p.r == r && p.z == z);
        let mover = |(block, p): (usize, &SectionPoint)| Mover {
            block,
            start: [p.r, p.z],
            position: [p.r, p.z],
            velocity: [0.0, -speed],
            deformation: [1.0, 0.0, 0.0, 1.0, 1.0],
            volume: 2.0 * PI * p.r * p.area,
            mean: 1.0,
            shear_norm: 0.0,
        };
        points.iter().for_each(|_| matter.push());
        let moduli = matter.moduli();
        let dt = match plan.scheme.time_step {
            TimeStep::Fixed(dt) => dt,
            TimeStep::Stable => 0.1 * plan.grid.fine / moduli.dilatational_speed(1.0),
        };
        Updated {
            offsets: section.offsets(),
            surface: surface.iter().filter_map(|p| index(p.r, p.z)).collect(),
            sole: surface.first().map_or(0.0, |p| p.z),
            movers: points.iter().enumerate().map(mover).collect(),
            reaches: Vec::new(),
            mass: vec![0.0; nodes],
            recip_mass: vec![[0.0; 2]; nodes],
            old: vec![[0.0; 2]; nodes],
            v: vec![[0.0; 2]; nodes],
            still: vec![[0.0; 2]; nodes],
            plan,
            speed,
            matter,
            moduli,
            section,
            dt,
            time: 0.0,
            step: 0,
            impulse: 0.0,
            work: 0.0,
            plastic: 0.0,
            radius: 0.0,
            contact_end: 0.0,
            least_j: 1.0,
        }
    }

    /// Step until the particle has rung out after its rebound, or the run must stop.
    pub fn finish(mut self) -> Record {
        let interval = self.plan.estimate.contact_time / OUTPUTS;
        let mut frames = vec![self.frame()];
        let mut compressed = None;
        let mut failure = None;
        while failure.is_none() && !self.is_over() {
            self.advance();
            if !(self.least_j > 0.0) {
                failure = Some(format!(
                    "volume ratio J = {:e} at a material point",
                    self.least_j
                ));
            }
            if self.time >= interval * frames.len() as f64 {
                frames.push(self.frame());
                self.radius = 0.0;
                if compressed.is_none() && self.mean(|p| p.velocity[1]) >= 0.0 {
                    compressed = Some(self.snapshot());
                }
            }
        }
        self.into_record(frames, compressed.unwrap_or_default(), failure)
    }

    fn is_over(&self) -> bool {
        let rung = self.time > self.contact_end + self.plan.ring_time;
        (rung && self.mean(|p| p.velocity[1]) > 0.0) || self.time > self.plan.longest_time
    }

    /// One step: points to nodes, deformation, forces, contact, nodes to points.
    fn advance(&mut self) {
        self.find_nodes();
        self.points_to_nodes();
        self.deform();
        self.push();
        self.touch();
        self.nodes_to_points();
        self.time += self.dt;
        self.step += 1;
    }

    /// Nodes and weights of every point where it is now.
    fn find_nodes(&mut self) {
        let reach = |p: &Mover| {
            let (r, z) = (p.position[0], p.position[1]);
            let cell = self.section.cell_of(r, z);
            let point = self.section.point::<N>(cell, r, z, 1.0);
            Reach {
                node: self.section.first_node(cell),
                values: point.values,
                gradients: point.weights,
            }
        };
        self.reaches = self.movers.iter().map(reach).collect();
    }

    fn points_to_nodes(&mut self) {
        self.mass.fill(0.0);
        self.old.fill([0.0; 2]);
        for (p, reach) in self.movers.iter().zip(&self.reaches) {
            for (value, offset) in reach.values.iter().zip(&self.offsets) {
                let n = reach.node + offset;
                let share = value * p.volume;
                self.mass[n] += share;
                self.old[n][0] += share * p.velocity[0];
                self.old[n][1] += share * p.velocity[1];
            }
        }
        for (n, &m) in self.mass.iter().enumerate() {
            let w = if m > 0.0 { 1.0 / m } else { 0.0 };
            let radial = if self.section.is_on_axis(n) { 0.0 } else { w };
            self.recip_mass[n] = [radial, w];
            self.old[n][0] *= radial;
            self.old[n][1] *= w;
        }
        self.v.copy_from_slice(&self.old);
    }

    /// $F \leftarrow F + \Delta t \sum_i v_i \otimes F^T \nabla N_i$.
    fn deform(&mut self) {
        for (p, reach) in self.movers.iter_mut().zip(&self.reaches) {
            let f = p.deformation;
            for (gradient, offset) in reach.gradients.iter().zip(&self.offsets) {
                let w = pulled_back(gradient, &f);
                let [ur, uz] = self.old[reach.node + offset].map(|v| self.dt * v);
                let change = [ur * w[0], ur * w[1], uz * w[0], uz * w[1], ur * w[2]];
                for (f, c) in p.deformation.iter_mut().zip(change) {
                    *f += c;
                }
            }
        }
    }

    /// Stresses, and the free velocities that their forces give the nodes.
    fn push(&mut self) {
        self.least_j = f64::INFINITY;
        for (p, reach) in self.movers.iter_mut().zip(&self.reaches) {
            let f = gradient(&p.deformation);
            let j = Axisymmetric::determinant(&f);
            let recip_j = j.recip();
            let kinematics = Kinematics {
                gradient: f,
                recip_j,
                recip_cbrt_j: j.recip_cbrt(),
            };
            let answer = self.matter.update(&kinematics, self.dt, p.block);
            self.least_j = if self.least_j <= j.array()[0] {
                self.least_j
            } else {
                j.array()[0]
            };
            p.mean = answer.mean.array()[0];
            p.shear_norm = answer.deviator.squared_norm().array()[0].sqrt();
            self.plastic += answer.dissipation.array()[0] * p.volume;
            let pressure = self.moduli.volumetric_stress(j.array()[0]);
            let tau = answer.deviator.shifted(j * pressure);
            let stress = Axisymmetric::first_piola(&tau, &f, recip_j, Lanes::splat(p.volume));
            for (gradient, offset) in reach.gradients.iter().zip(&self.offsets) {
                let n = reach.node + offset;
                let w = pulled_back(gradient, &p.deformation).map(Lanes::splat);
                let mut force = [Lanes::default(); 3];
                Axisymmetric::add_force(&mut force, &stress, &w);
                for (k, force) in force.iter().take(2).enumerate() {
                    self.v[n][k] -= self.dt * force.array()[0] * self.recip_mass[n][k];
                }
            }
        }
    }

    /// Contact of the surface points where they are now.
    fn touch(&mut self) {
        let mut contact =
            Contact::<Axisymmetric, N>::new(self.offsets, CONTACT_TOLERANCE * self.speed);
        let near = 4.0 * self.speed * self.dt;
        let mut any = false;
        for &c in &self.surface {
            let [r, z] = self.movers[c].position;
            if z - self.sole < near {
                contact.push(
                    self.reaches[c].node,
                    self.reaches[c].values,
                    z - self.sole,
                    r,
                );
                any = true;
            }
        }
        if !any {
            return;
        }
        contact.couple(&self.recip_mass);
        contact.refresh(&self.still, 2.0 * self.speed, 4.0 * self.dt, &|_| true);
        let touch = contact.solve(
            self.dt,
            &self.still,
            &self.old,
            &mut self.v,
            &self.recip_mass,
        );
        self.impulse += touch.impulse;
        self.work += touch.work;
        self.radius = self.radius.max(touch.radius);
        if touch.impulse > 0.0 {
            self.contact_end = self.time + self.dt;
        }
    }

    fn nodes_to_points(&mut self) {
        let flip = match self.plan.scheme.transfer {
            Transfer::Blend(flip) => flip,
            _ => 1.0,
        };
        for (p, reach) in self.movers.iter_mut().zip(&self.reaches) {
            for k in 0..2 {
                let (mut change, mut here) = (0.0, 0.0);
                for (value, offset) in reach.values.iter().zip(&self.offsets) {
                    let n = reach.node + offset;
                    change += value * (self.v[n][k] - self.old[n][k]);
                    here += value * self.v[n][k];
                }
                p.velocity[k] = flip * (p.velocity[k] + change) + (1.0 - flip) * here;
                p.position[k] += self.dt * here;
            }
        }
    }

    /// Mass average over the points.
    fn mean(&self, value: impl Fn(&Mover) -> f64) -> f64 {
        let mass: f64 = self.movers.iter().map(|p| p.volume).sum();
        self.movers.iter().map(|p| p.volume * value(p)).sum::<f64>() / mass
    }

    fn frame(&self) -> Frame {
        let moduli = self.moduli;
        let mass: f64 = self.movers.iter().map(|p| p.volume).sum();
        let elastic = |p: &Mover| {
            let f = &p.deformation;
            let j = (f[0] * f[3] - f[1] * f[2]) * f[4];
            1.5 * moduli.shear * (p.mean - 1.0) + moduli.volumetric_energy(j)
        };
        let travel = |z: f64| {
            // axis points (the first of a row) nearest to the height asked for
            let near = |p: &&Mover| (p.start[1] - z).abs() + p.start[0];
            let nearest = self
                .movers
                .iter()
                .min_by(|a, b| near(a).total_cmp(&near(b)));
            nearest.map_or(0.0, |p| p.position[1] - p.start[1])
        };
        Frame {
            time: self.time,
            displacement: -self.mean(|p| p.position[1] - p.start[1]),
            centre_displacement: -travel(1.0),
            impulse: self.impulse,
            tangential: 0.0,
            contact_radius: self.radius,
            kinetic: mass * self.mean(|p| 0.5 * (p.velocity[0].powi(2) + p.velocity[1].powi(2))),
            elastic: mass * self.mean(elastic),
            plastic: self.plastic,
            surface: 0.0,
            height: 2.0 + travel(2.0) - travel(0.0),
        }
    }

    fn snapshot(&self) -> Snapshot {
        let view = |p: &Mover| {
            let f = &p.deformation;
            let j = (f[0] * f[3] - f[1] * f[2]) * f[4];
            let size = (p.volume / (2.0 * PI * p.start[0])).sqrt();
            SectionView {
                place: [p.position[0], p.position[1], size],
                plastic_strain: self.matter.plastic_strain(p.block).array()[0],
                von_mises: 1.5f64.sqrt() * p.shear_norm / j,
                pressure: -self.moduli.volumetric_stress(j),
                temperature: (self.matter.temperature(p.block)).map_or(0.0, |t| t.array()[0]),
            }
        };
        let outline = |&c: &usize| {
            let [r, z] = self.movers[c].position;
            (r, z - self.sole)
        };
        Snapshot {
            points: self.movers.iter().map(view).collect(),
            outline: self.surface.iter().map(outline).collect(),
        }
    }

    /// Temperatures of matter that knows them.
    fn warmth(&self) -> Option<Warmth> {
        let temperature = |p: &Mover| self.matter.temperature(p.block);
        let hottest = |p: &Mover| temperature(p).map_or(0.0, |t| t.array()[0]);
        self.movers.first().and_then(temperature)?;
        Some(Warmth {
            share: self.matter.heat_share(),
            hottest: self.movers.iter().map(hottest).fold(0.0, f64::max),
            mean: self.mean(hottest),
        })
    }

    fn into_record(
        self,
        frames: Vec<Frame>,
        compressed: Snapshot,
        failure: Option<String>,
    ) -> Record {
        let incident = frames[0].kinetic;
        let missing = |f: &Frame| 1.0 + (self.work - f.kinetic - f.elastic - f.plastic) / incident;
        let status = match failure {
            Some(reason) => Status::Failed(format!("step {}: {reason}", self.step)),
            None if self.time > self.plan.longest_time => Status::NoRebound,
            None => Status::Ok,
        };
        let size = std::mem::size_of::<Mover>() + std::mem::size_of::<Reach<N>>();
        Record {
            contact_end: self.contact_end,
            exit_speed: self.mean(|p| p.velocity[1]),
            speed: self.speed,
            shape: Shape::Sphere,
            sliding: None,
            // all that is missing is put down to the transfers; they are not audited one by one
            closure: 0.0,
            contact_loss: 0.0,
            transfer_loss: frames.last().map_or(0.0, missing),
            eroded: 0.0,
            shock: 0.0,
            knocking: 0.0,
            has_poles: true,
            plastic_strain: self.mean(|p| self.matter.plastic_strain(p.block).array()[0]),
            warmth: self.warmth(),
            points: self.movers.len(),
            steps: self.step,
            seconds_before: 0.0,
            memory_bytes: size * self.movers.len() + self.matter.bytes() + self.mass.len() * 9 * 8,
            status,
            rebound: self.snapshot(),
            film: Vec::new(),
            compressed,
            frames,
        }
    }
}
