//! Matter: what the points are made of. Its type is known within a batch; nothing around the kernel is compiled again for it.
//!
//! A batch holds dozens of points, so one call through a table costs a thousandth of what it does. In return the whole of a
//! run (contact, steps, erosion, records) exists once for a grid and a wall instead of once for each flow stress.

use super::passes::{Vectors, blocks};
use super::{Cell, Purpose, Scratch};
use crate::lanes::Lanes;
use crate::material::stress::{Constitutive, Kinematics, Moduli, Response};
use crate::space::Space;
use crate::tape::{Keep, Tape};

/// Material and states of all points, block by block.
pub trait Matter<S: Space>: Send + Sync {
    /// Add an undeformed block.
    fn push(&mut self);
    /// Elastic moduli.
    fn moduli(&self) -> Moduli;
    /// Isochoric responses of a batch of cells into the scratch; `clock`: present time. States move on if the purpose does.
    fn respond(
        &mut self,
        cells: &mut [Cell],
        scratch: &mut [Scratch<S>],
        purpose: Purpose,
        clock: f64,
        vectors: Vectors,
    );
    /// Response of one block after `dt` of its own time; its state moves on.
    fn update(
        &mut self,
        kinematics: &Kinematics<S>,
        dt: f64,
        block: usize,
    ) -> Response<S::Symmetric>;
    /// Elastic response of a block with its state frozen.
    fn trial(&self, kinematics: &Kinematics<S>, block: usize) -> Response<S::Symmetric>;
    /// Accumulated equivalent plastic strain of a block.
    fn plastic_strain(&self, block: usize) -> Lanes;
    /// Temperature of a block, K; none of matter that knows none.
    fn temperature(&self, block: usize) -> Option<Lanes>;
    /// Share of the plastic work that becomes heat.
    fn heat_share(&self) -> f64;
    /// Write the states.
    fn save(&self, tape: &mut Tape);
    /// Take back what [`Matter::save`] wrote; `None` when the tape does not fit.
    fn load(&mut self, tape: &mut Tape) -> Option<()>;
    /// Memory of the states, bytes.
    fn bytes(&self) -> usize;
    /// Another of the same states.
    fn copy(&self) -> Box<dyn Matter<S>>;
}

/// Points of one constitutive model.
#[derive(Clone)]
struct Made<M, T> {
    material: M,
    states: Vec<T>,
}

/// No points yet, of a `material`.
pub fn made_of<S: Space, M: Constitutive<S>>(material: M) -> Box<dyn Matter<S>> {
    Box::new(Made::<M, M::State> {
        material,
        states: Vec::new(),
    })
}

impl<S: Space, M: Constitutive<S>> Matter<S> for Made<M, M::State> {
    fn push(&mut self) {
        self.states.push(self.material.virgin());
    }

    fn moduli(&self) -> Moduli {
        self.material.moduli()
    }

    fn respond(
        &mut self,
        cells: &mut [Cell],
        scratch: &mut [Scratch<S>],
        purpose: Purpose,
        clock: f64,
        vectors: Vectors,
    ) {
        match vectors {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: whoever names these vectors has detected them.
            Vectors::Avx2 => unsafe {
                respond_avx2(
                    self.material,
                    &mut self.states,
                    cells,
                    scratch,
                    purpose,
                    clock,
                );
            },
            Vectors::Any => respond(
                self.material,
                &mut self.states,
                cells,
                scratch,
                purpose,
                clock,
            ),
        }
    }

    fn update(
        &mut self,
        kinematics: &Kinematics<S>,
        dt: f64,
        block: usize,
    ) -> Response<S::Symmetric> {
        self.material
            .update(kinematics, dt, &mut self.states[block])
    }

    fn trial(&self, kinematics: &Kinematics<S>, block: usize) -> Response<S::Symmetric> {
        self.material.trial(kinematics, &self.states[block])
    }

    fn plastic_strain(&self, block: usize) -> Lanes {
        M::plastic_strain(&self.states[block])
    }

    fn temperature(&self, block: usize) -> Option<Lanes> {
        self.material.temperature(&self.states[block])
    }

    fn heat_share(&self) -> f64 {
        self.material.heat_share()
    }

    fn save(&self, tape: &mut Tape) {
        self.states.as_slice().save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.states.as_mut_slice().load(tape)
    }

    fn bytes(&self) -> usize {
        std::mem::size_of_val(&self.states[..])
    }

    fn copy(&self) -> Box<dyn Matter<S>> {
        Box::new(self.clone())
    }
}

/// [`respond`] compiled for 256-bit registers.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn respond_avx2<S: Space, M: Constitutive<S>>(
    material: M,
    states: &mut [M::State],
    cells: &mut [Cell],
    scratch: &mut [Scratch<S>],
    purpose: Purpose,
    clock: f64,
) {
    respond(material, states, cells, scratch, purpose, clock);
}

#[inline(always)]
fn respond<S: Space, M: Constitutive<S>>(
    material: M,
    states: &mut [M::State],
    cells: &mut [Cell],
    scratch: &mut [Scratch<S>],
    purpose: Purpose,
    clock: f64,
) {
    for (at, block) in blocks(cells).enumerate() {
        let s = &mut scratch[at];
        s.response = material.trial(&s.kinematics, &states[block]);
    }
    if purpose == Purpose::Trial {
        return;
    }
    let mut at = 0;
    for cell in cells {
        let dt = clock - cell.moved;
        let states = &mut states[cell.first as usize..cell.last as usize];
        let scratch = &mut scratch[at..at + states.len()];
        at += states.len();
        if purpose == Purpose::Look {
            for (k, s) in scratch.iter_mut().enumerate() {
                let mut state = states[k];
                s.response = material.settle(&s.kinematics, dt, &mut state, &s.response);
            }
        } else {
            for (k, s) in scratch.iter_mut().enumerate() {
                s.response = material.settle(&s.kinematics, dt, &mut states[k], &s.response);
            }
            cell.moved = clock;
        }
    }
}
