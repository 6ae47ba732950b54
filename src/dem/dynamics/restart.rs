//! Restart: the whole state of a bed in progress on a tape, to be resumed bit for bit.
//!
//! Laws, shapes and settings are not kept: they are built again from the scene. Neighbour lists and the parts of every
//! sum are, since a list made at another time would sum the same numbers in another order.

use crate::dem::bodies::machine::{Load, Machine};
use crate::dem::contacts::family::{CHUNK as CANDIDATES, Family, Patch, Tally};
use crate::dem::contacts::pairs::{CHUNK as PAIRS, Contacts};
use crate::dem::contacts::surfaces::Surfaces;
use crate::dem::dynamics::{Bed, Listed, Outside};
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::meeting::Push;
use crate::dem::force::mixture::RIGID;
use crate::dem::force::normal::NormalModel;
use crate::dem::force::slider::Slider;
use crate::dem::grains::neighbours::HalfList;
use crate::dem::grains::{Grains, Motion, Sphere, Spin};
use crate::tape::{Keep, Tape, keep_fields};
use parry3d::math::{Pose, Rotation, Vector};

keep_fields!(Vector: x, y, z);
keep_fields!(Rotation: x, y, z, w);
keep_fields!(Pose: rotation, translation);
keep_fields!(Slider: load, compliance);
keep_fields!(Sphere: centre, radius);
keep_fields!(Motion: velocity, inverse_mass);
keep_fields!(Spin: rate, inverse_inertia);
keep_fields!(Grains: spheres, motions, spins, plastic, ids, named, materials, groups, plastic_gone; rebuilt room);
keep_fields!(Push: force, couple, arms);
keep_fields!(Load: force, torque, power);
keep_fields!(HalfList: pairs, start, reverse_start, reverse, images);
keep_fields!(impl [M: Keep] Patch<M>: memory, push, point, normal);
keep_fields!(Tally: losses, left_out);
keep_fields!(Outside: driven, stiffening);
keep_fields!(Listed: centres, poses, moved, smallest, due);

/// Materials of contacts that are about to be loaded: they know their own.
const UNKNOWN: fn(usize) -> [u8; 2] = |_| [RIGID; 2];

impl<C: ContactLaw> Keep for Contacts<C> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            list,
            memory,
            pushes,
            histories,
            chunks,
            spent,
            touching: _,
            model: _,
        } = self;
        list.save(tape);
        tape.save_few(memory);
        tape.save_few(pushes);
        histories.iter().for_each(|chunk| chunk.save(tape));
        chunks.save(tape);
        spent.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            list,
            memory,
            pushes,
            histories,
            chunks,
            spent,
            touching,
            model,
        } = self;
        list.load(tape)?;
        let pairs = list.pairs.len();
        *memory = vec![C::Memory::default(); pairs];
        tape.load_few(memory)?;
        *pushes = vec![Push::default(); pairs];
        tape.load_few(pushes)?;
        *touching = pushes.iter().map(Push::touches).collect();
        *histories = model.chunks(&[], &vec![None; pairs], PAIRS, &UNKNOWN);
        histories
            .iter_mut()
            .try_for_each(|chunk| chunk.load(tape))?;
        chunks.load(tape)?;
        spent.load(tape)
    }
}

impl<C: ContactLaw> Keep for Surfaces<C> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            solids,
            meshes,
            crowd: _, // follows from the candidates
            model: _,
        } = self;
        solids.save(tape);
        meshes.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            solids,
            meshes,
            model,
            crowd: _,
        } = self;
        solids.load(&**model, tape)?;
        meshes.load(&**model, tape)?;
        self.seat();
        Some(())
    }
}

impl<C: ContactLaw, const K: usize> Family<C, K> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            candidates,
            seats: _, // those of the crowd
            start,
            patches,
            histories,
            tallies,
            spent,
        } = self;
        candidates.save(tape);
        start.save(tape);
        patches.save(tape);
        histories.iter().for_each(|chunk| chunk.save(tape));
        tallies.save(tape);
        spent.save(tape);
    }

    fn load(&mut self, model: &dyn NormalModel, tape: &mut Tape) -> Option<()> {
        let Self {
            candidates,
            seats: _,
            start,
            patches,
            histories,
            tallies,
            spent,
        } = self;
        candidates.load(tape)?;
        start.load(tape)?;
        patches.load(tape)?;
        let none = vec![None; patches.len()];
        *histories = model.chunks(&[], &none, CANDIDATES * K, &UNKNOWN);
        histories
            .iter_mut()
            .try_for_each(|chunk| chunk.load(tape))?;
        tallies.load(tape)?;
        spent.load(tape)
    }
}

impl Keep for Machine {
    fn save(&self, tape: &mut Tape) {
        self.state()[..].save(tape);
        self.time.save(tape);
        self.motors.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut state = self.state();
        state[..].load(tape)?;
        let mut time = 0.0;
        time.load(tape)?;
        self.restore(&state, time);
        self.motors.load(tape)
    }
}

impl<C: ContactLaw> Keep for Bed<C> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            grains,
            machine,
            law,
            contacts,
            surfaces,
            dt,
            stride,
            time,
            step,
            loads,
            before,
            outside,
            listed,
            fresh,
            gravity: _,
            skin: _,
        } = self;
        grains.save(tape);
        machine.save(tape);
        law.softening().save(tape);
        contacts.save(tape);
        surfaces.save(tape);
        dt.save(tape);
        stride.save(tape);
        time.save(tape);
        step.save(tape);
        loads.save(tape);
        before.save(tape);
        outside.save(tape);
        listed.save(tape);
        fresh.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            grains,
            machine,
            law,
            contacts,
            surfaces,
            dt,
            stride,
            time,
            step,
            loads,
            before,
            outside,
            listed,
            fresh,
            gravity: _,
            skin: _,
        } = self;
        grains.load(tape)?;
        machine.load(tape)?;
        let mut softening = 1.0;
        softening.load(tape)?;
        law.soften(softening);
        Keep::load(contacts, tape)?;
        Keep::load(surfaces, tape)?;
        dt.load(tape)?;
        stride.load(tape)?;
        time.load(tape)?;
        step.load(tape)?;
        loads.load(tape)?;
        before.load(tape)?;
        outside.load(tape)?;
        listed.load(tape)?;
        fresh.load(tape)
    }
}
