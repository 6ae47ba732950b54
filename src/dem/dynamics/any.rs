//! Any bed: a bed whose law is known by name only.

use super::Bed;
use super::contact::ContactRow;
use super::state::{Energies, Packing};
use crate::Result;
use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::machine::{Load, Machine};
use crate::dem::force::effects::ContactLaw;
use crate::dem::grains::newcomer::Newcomer;
use crate::dem::grains::{Grains, Motion, Sphere};
use crate::tape::Keep;
use parry3d::math::Vector;

/// A bed whose law is known by name only: everything but the loops inside a step.
pub trait AnyBed: Send + Keep {
    /// See [`Bed::evaluate`].
    ///
    /// # Errors
    /// As there.
    fn evaluate(&mut self) -> Result<()>;
    /// See [`Bed::advance`].
    ///
    /// # Errors
    /// As there.
    fn advance(&mut self) -> Result<()>;
    /// See [`Bed::soften`].
    fn soften(&mut self, factor: f64);
    /// See [`Bed::list_again`].
    fn list_again(&mut self);
    /// See [`Bed::take_out`].
    fn take_out(&mut self, body: usize);
    /// See [`Bed::run_belt`].
    fn run_belt(&mut self, body: usize, belt: Belt);
    /// See [`Bed::let_go`].
    ///
    /// # Errors
    /// As there.
    fn let_go(&mut self, gone: &[u32]) -> Result<()>;
    /// Lets grains come in; their neighbours are listed anew.
    fn join(&mut self, newcomers: &[Newcomer]);
    /// See [`Bed::start_account`].
    fn start_account(&mut self);
    /// Sets the time step, s.
    fn set_dt(&mut self, dt: f64);
    /// Time step, time of the positions (s) and steps done.
    fn clock(&self) -> (f64, f64, u64);
    /// Grains.
    fn grains(&self) -> &Grains;
    /// Puts a copy of the grains' places and motions in place of the ones it had, which are returned: whoever shows them without
    /// copying them keeps these.
    fn renewed(&mut self) -> (Vec<Sphere>, Vec<Motion>);
    /// Bodies.
    fn machine(&self) -> &Machine;
    /// Bodies, to be driven.
    fn machine_mut(&mut self) -> &mut Machine;
    /// Force of the grains on a body, N.
    fn force_on(&self, body: usize) -> Vector {
        self.load_on(body).force
    }
    /// Force and torque of the grains on a body.
    fn load_on(&self, body: usize) -> Load;
    /// See [`Bed::energies`].
    fn energies(&self) -> Energies;
    /// See [`Bed::packing`].
    fn packing(&self) -> Packing;
    /// See [`Bed::plastic_by_grain`].
    fn plastic_by_grain(&self) -> Vec<f64>;
    /// See [`Bed::contact_rows`].
    fn contact_rows(&self) -> Vec<ContactRow>;
    /// See [`Bed::squeeze`].
    fn squeeze(&self) -> Vec<f64>;
    /// Surface contacts lost because a grain touched a mesh in too many places, since neighbours were listed.
    fn left_out(&self) -> u32;
}

impl<C: ContactLaw> AnyBed for Bed<C> {
    fn evaluate(&mut self) -> Result<()> {
        Bed::evaluate(self)
    }

    fn advance(&mut self) -> Result<()> {
        Bed::advance(self)
    }

    fn soften(&mut self, factor: f64) {
        Bed::soften(self, factor);
    }

    fn list_again(&mut self) {
        Bed::list_again(self);
    }

    fn take_out(&mut self, body: usize) {
        Bed::take_out(self, body);
    }

    fn run_belt(&mut self, body: usize, belt: Belt) {
        Bed::run_belt(self, body, belt);
    }

    fn let_go(&mut self, gone: &[u32]) -> Result<()> {
        Bed::let_go(self, gone)
    }

    fn join(&mut self, newcomers: &[Newcomer]) {
        for newcomer in newcomers {
            newcomer.join(&mut self.grains);
        }
        Bed::renew(self);
    }

    fn start_account(&mut self) {
        Bed::start_account(self);
    }

    fn set_dt(&mut self, dt: f64) {
        self.dt = dt;
    }

    fn clock(&self) -> (f64, f64, u64) {
        (self.dt, self.time, self.step)
    }

    fn grains(&self) -> &Grains {
        &self.grains
    }

    fn renewed(&mut self) -> (Vec<Sphere>, Vec<Motion>) {
        let spheres = self.grains.spheres.clone();
        let motions = self.grains.motions.clone();
        (
            std::mem::replace(&mut self.grains.spheres, spheres),
            std::mem::replace(&mut self.grains.motions, motions),
        )
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    fn load_on(&self, body: usize) -> Load {
        self.loads[body]
    }

    fn energies(&self) -> Energies {
        Bed::energies(self)
    }

    fn packing(&self) -> Packing {
        Bed::packing(self)
    }

    fn plastic_by_grain(&self) -> Vec<f64> {
        Bed::plastic_by_grain(self)
    }

    fn contact_rows(&self) -> Vec<ContactRow> {
        Bed::contact_rows(self)
    }

    fn squeeze(&self) -> Vec<f64> {
        Bed::squeeze(self)
    }

    fn left_out(&self) -> u32 {
        self.surfaces.left_out()
    }
}
