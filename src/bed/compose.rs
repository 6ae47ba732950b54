//! Composition: from names in a scene to a bed of one concrete type; every choice is made here, once.

use super::contact_row::ContactRow;
use super::damping::Viscous;
use super::friction::{Mindlin, RollingSpring};
use super::grains::Grains;
use super::insertion::Newcomer;
use super::law::{ContactLaw, Law};
use super::machine::{Load, Machine};
use super::measure::{Energies, Packing};
use super::normals::{Model, NormalModel};
use super::scene::ContactTable;
use super::step::{Bed, Normals, Parts};
use crate::Result;
use crate::contact::pair::{Alike, Flat, Twins};
use crate::contact::{LawVisitor, NormalLaw};
use crate::material::Material;
use crate::tape::Keep;
use parry3d::math::Vector;

/// Effects beside the normal law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Effects {
    /// Viscous damping.
    pub damping: Option<Viscous>,
    /// Friction.
    pub friction: Option<Mindlin>,
    /// Rolling resistance; only with friction.
    pub rolling: Option<RollingSpring>,
}

impl Effects {
    /// Effects a scene names for grains of `material`.
    #[must_use]
    pub fn of(contact: &ContactTable, material: &Material) -> Self {
        Self {
            damping: contact.restitution.map(Viscous::new),
            friction: contact.friction.map(|mu| Mindlin::new(material, mu)),
            rolling: contact.rolling.map(|mu| RollingSpring::new(material, mu)),
        }
    }

    /// The same for two bodies of these materials, rigid ones if none.
    #[must_use]
    pub fn between(contact: &ContactTable, materials: [Option<&Material>; 2]) -> Self {
        let (friction, rolling) = (contact.friction, contact.rolling);
        Self {
            damping: contact.restitution.map(Viscous::new),
            friction: friction.map(|mu| Mindlin::between(materials, mu)),
            rolling: rolling.map(|mu| RollingSpring::between(materials, mu)),
        }
    }
}

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

/// Builds the normal laws of a bed from a concrete law; use with anything that visits laws by name.
pub struct NormalsOf {
    /// Whether all grains, those to come included, have one radius.
    pub monodisperse: bool,
}

impl LawVisitor for NormalsOf {
    type Output = Normals;

    fn visit<L: NormalLaw>(self, law: &L) -> Normals {
        let pair: Box<dyn NormalModel> = if self.monodisperse {
            Box::new(Model(Twins(law.clone())))
        } else {
            Box::new(Model(Alike(law.clone())))
        };
        Normals {
            pair,
            wall: Box::new(Model(Flat(law.clone()))),
        }
    }
}

/// Bed with the effects named.
#[must_use]
pub fn build(normals: Normals, effects: &Effects, parts: Parts) -> Box<dyn AnyBed> {
    match (effects.damping, effects.friction, effects.rolling) {
        (None, None, _) => boxed(Law::new((), (), ()), normals, parts),
        (Some(d), None, _) => boxed(Law::new(d, (), ()), normals, parts),
        (None, Some(t), None) => boxed(Law::new((), t, ()), normals, parts),
        (Some(d), Some(t), None) => boxed(Law::new(d, t, ()), normals, parts),
        (None, Some(t), Some(r)) => boxed(Law::new((), t, r), normals, parts),
        (Some(d), Some(t), Some(r)) => boxed(Law::new(d, t, r), normals, parts),
    }
}

fn boxed<C: ContactLaw>(law: C, normals: Normals, parts: Parts) -> Box<dyn AnyBed> {
    Box::new(Bed::new(law, normals, parts))
}
