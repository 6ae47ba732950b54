//! Restart: the whole state of a bed in progress on a tape, to be resumed bit for bit.
//!
//! Laws, shapes and settings are not kept: they are built again from the scene. Neighbour lists and the parts of every
//! sum are, since a list made at another time would sum the same numbers in another order.

use crate::dem::bodies::machine::{Load, Machine};
use crate::dem::contacts::family::{CHUNK as CANDIDATES, Family, Patch, Tally};
use crate::dem::contacts::pairs::{CHUNK as PAIRS, Contacts};
use crate::dem::contacts::surfaces::Surfaces;
use crate::dem::dynamics::{Bed, Listed, Outside};
use crate::dem::force::effects::{ContactLaw, Memory};
use crate::dem::force::meeting::{Losses, Push};
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
keep_fields!(Grains: spheres, motions, spins, plastic, ids, materials);
keep_fields!(Losses: friction, rolling, damping);
keep_fields!(impl [D: Keep, T: Keep, R: Keep] Memory<D, T, R>: damping, tangential, rolling, work);
keep_fields!(Push: force, couple, arms);
keep_fields!(Load: force, torque);
keep_fields!(HalfList: pairs, start, reverse_start, reverse, images);
keep_fields!(impl [M: Keep] Patch<M>: memory, push, point, normal);
keep_fields!(Tally: losses, left_out);
keep_fields!(Outside: driven, stiffening);
keep_fields!(Listed: centres, poses, moved, due);

/// Materials of contacts that are about to be loaded: they know their own.
const UNKNOWN: fn(usize) -> [u8; 2] = |_| [RIGID; 2];

impl<C: ContactLaw> Keep for Contacts<C> {
    fn save(&self, tape: &mut Tape) {
        self.list.save(tape);
        tape.save_few(&self.memory);
        tape.save_few(&self.pushes);
        self.histories.iter().for_each(|chunk| chunk.save(tape));
        self.chunks.save(tape);
        self.spent.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.list.load(tape)?;
        self.memory = vec![C::Memory::default(); self.list.pairs.len()];
        tape.load_few(&mut self.memory)?;
        self.pushes = vec![Push::default(); self.list.pairs.len()];
        tape.load_few(&mut self.pushes)?;
        self.touching = self.pushes.iter().map(Push::touches).collect();
        let none = vec![None; self.list.pairs.len()];
        self.histories = self.model.chunks(&[], &none, PAIRS, &UNKNOWN);
        self.histories
            .iter_mut()
            .try_for_each(|chunk| chunk.load(tape))?;
        self.chunks.load(tape)?;
        self.spent.load(tape)
    }
}

impl<C: ContactLaw> Keep for Surfaces<C> {
    fn save(&self, tape: &mut Tape) {
        self.solids.save(tape);
        self.meshes.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.solids.load(&*self.model, tape)?;
        self.meshes.load(&*self.model, tape)
    }
}

impl<C: ContactLaw, const K: usize> Family<C, K> {
    fn save(&self, tape: &mut Tape) {
        self.candidates.save(tape);
        self.start.save(tape);
        self.patches.save(tape);
        self.histories.iter().for_each(|chunk| chunk.save(tape));
        self.tallies.save(tape);
        self.spent.save(tape);
    }

    fn load(&mut self, model: &dyn NormalModel, tape: &mut Tape) -> Option<()> {
        self.candidates.load(tape)?;
        self.start.load(tape)?;
        self.patches.load(tape)?;
        let none = vec![None; self.patches.len()];
        self.histories = model.chunks(&[], &none, CANDIDATES * K, &UNKNOWN);
        self.histories
            .iter_mut()
            .try_for_each(|chunk| chunk.load(tape))?;
        self.tallies.load(tape)?;
        self.spent.load(tape)
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
        self.grains.save(tape);
        self.machine.save(tape);
        self.law.softening().save(tape);
        self.contacts.save(tape);
        self.surfaces.save(tape);
        self.dt.save(tape);
        self.time.save(tape);
        self.step.save(tape);
        self.loads.save(tape);
        self.before.save(tape);
        self.outside.save(tape);
        self.listed.save(tape);
        self.fresh.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.grains.load(tape)?;
        self.machine.load(tape)?;
        let mut softening = 1.0;
        softening.load(tape)?;
        self.law.soften(softening);
        Keep::load(&mut self.contacts, tape)?;
        Keep::load(&mut self.surfaces, tape)?;
        self.dt.load(tape)?;
        self.time.load(tape)?;
        self.step.load(tape)?;
        self.loads.load(tape)?;
        self.before.load(tape)?;
        self.outside.load(tape)?;
        self.listed.load(tape)?;
        self.fresh.load(tape)
    }
}
