//! Advance: one step of a run, level by level of cells.

use super::transfer::{Remap, StepEnd};
use crate::impact::kernel::{Part, Purpose, Sweep};
use crate::impact::run::Run;
use crate::impact::stepping::erosion::LEAST_J;
use crate::impact::stepping::levels::push;
use crate::impact::wall::meridian::{Touch, Wall};
use crate::space::Space;

/// What an output needs of the levels' sweeps: elastic energy, and impulses of the steps that are under way.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Output {
    pub(super) elastic: f64,
    pub(super) impulse: f64,
    pub(super) tangential: f64,
}

impl<S, W, T, const N: usize> Run<'_, S, W, T, N>
where
    S: Space,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    /// Internal forces of a level of cells. Where a point is crushed its cell is taken out, or the run stops.
    fn forces(&mut self, level: usize, purpose: Purpose) -> Sweep {
        let points = &mut self.model.points;
        let force = match level {
            0 => &mut self.force,
            _ => self.local.force(level),
        };
        let part = Part::Level(level);
        self.stepped += points.blocks_of(part);
        let sweep = points.sweep_part(part, purpose, &self.u, force);
        self.plastic += sweep.plastic;
        self.shock += sweep.shock;
        let least = if self.erosion.is_on() { LEAST_J } else { 0.0 };
        if sweep.least_j > least {
            return sweep;
        }
        if !self.erosion.is_on() {
            let least = sweep.least_j;
            self.failure = Some(format!("volume ratio J = {least:e} at a material point"));
        } else if let Err(reason) = self.erosion.take_out_crushed(points, &self.u) {
            self.failure = Some(reason);
        }
        // the states have moved on to these displacements: the cells that are left answer as before and dissipate no more
        points.sweep_part(part, Purpose::Look, &self.u, force)
    }

    /// One step of the symplectic scheme: forces at $u_n$, velocities to n + 1/2, contact, displacements to n + 1.
    pub(super) fn advance(&mut self, output: bool) {
        self.descend(0, self.dt, &mut output.then(Output::default));
        self.step += 1;
    }

    /// One step of a level of cells, with the two steps of the next level in it. What is due to be put out is gathered on
    /// the way down to the first of the shortest steps.
    fn descend(&mut self, level: usize, dt: f64, output: &mut Option<Output>) {
        let purpose = match output {
            Some(_) => Purpose::Audit,
            None => Purpose::Step,
        };
        let sweep = self.forces(level, purpose);
        let touch = if level == 0 {
            self.kick(dt)
        } else {
            let nodes = self.model.points.nodes_of(level);
            let recip_mass = &self.model.recip_mass;
            self.local
                .kick(level, dt, nodes, &self.u, &mut self.v, recip_mass)
        };
        self.book(&touch, dt);
        if let Some(output) = output {
            output.elastic += sweep.elastic;
            output.impulse += touch.impulse - touch.pull;
            output.tangential += touch.tangential;
        }
        if level < self.model.points.deepest() {
            self.descend(level + 1, 0.5 * dt, output);
            self.descend(level + 1, 0.5 * dt, output);
            return;
        }
        if let Some(output) = output.take() {
            self.record(&output);
        }
        if level == 0 {
            self.map(dt);
        }
        self.drift(dt);
    }

    /// Velocities after forces and contact of the longest step.
    fn kick(&mut self, dt: f64) -> Touch {
        self.old.copy_from_slice(&self.v);
        let travel = self.transfer.travel(&self.u);
        let pull = self.model.contact.pull(travel, &mut self.force);
        self.surface = pull.energy;
        let recip_mass = &self.model.recip_mass;
        for (n, v) in self.v.iter_mut().enumerate() {
            push(v, dt, &self.force[n], &recip_mass[n]);
        }
        let contact = &mut self.model.contact;
        let mut touch = contact.solve(dt, travel, &self.old, &mut self.v, recip_mass);
        if touch.impulse > 0.0 {
            touch.work += self.turn();
        }
        touch.pull = pull.force * dt;
        touch
    }

    /// Add up what contact did in a step of length `dt`.
    fn book(&mut self, touch: &Touch, dt: f64) {
        self.impulse += touch.impulse - touch.pull;
        self.tangential += touch.tangential;
        self.contact_work += touch.work;
        self.contact_radius = self.contact_radius.max(touch.radius);
        if touch.impulse > 0.0 || touch.pull > 0.0 {
            self.contact_end = self.time + dt;
        }
    }

    /// Velocities mapped through the points, in schemes that do.
    fn map(&mut self, dt: f64) {
        let end = StepEnd {
            dt,
            old: &self.old,
            force: &self.force,
            mass: &self.model.mass,
            recip_mass: &self.model.recip_mass,
        };
        self.transferred += self.transfer.remap(end, &mut self.v);
    }

    /// Displacements at the end of a shortest step.
    fn drift(&mut self, dt: f64) {
        for (n, u) in self.u.iter_mut().enumerate() {
            let v = self.v[n].as_ref();
            for (k, u) in u.as_mut().iter_mut().enumerate() {
                *u += dt * v[k];
            }
        }
        self.time += dt;
        self.model.points.pass_time(dt);
    }
}
