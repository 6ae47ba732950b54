//! Removal: grains and bodies taken out of a bed at once; what they have dissipated stays in the account.

use super::{Bed, CHUNK};
use crate::Result;
use crate::dem::force::effects::ContactLaw;
use crate::dem::grains::neighbours::Staying;

impl<C: ContactLaw> Bed<C> {
    /// Takes a body out at once. What its contacts hold goes with it; what they have dissipated stays in the account.
    pub fn take_out(&mut self, body: usize) {
        let softening = self.law.softening();
        self.surfaces.release(body, &mut self.grains, softening);
        self.machine.remove(body);
        self.list_again();
    }

    /// Takes out the grains whose indices are `gone`, ascending. Their contacts end, and what those hold goes with them;
    /// what they have dissipated stays in the account. Forces on all else are then those without them.
    ///
    /// Lists are cut, not made anew: what stays keeps its order, and no sum changes its own.
    ///
    /// # Errors
    /// As [`Bed::evaluate`].
    pub fn let_go(&mut self, gone: &[u32]) -> Result<()> {
        self.evaluate()?;
        let softening = self.law.softening();
        let stay = Staying::without(self.grains.len(), gone);
        self.contacts.part_with(&stay, &mut self.grains, softening);
        self.surfaces.part_with(&stay, &mut self.grains, softening);
        for &grain in gone {
            self.grains.plastic_gone += self.grains.plastic[grain as usize];
        }
        self.grains.reorder(&stay.old);
        self.contacts.restrict(&stay, &self.grains);
        self.surfaces
            .restrict(&stay, &self.grains, &self.machine.materials);
        self.surfaces.load_into(&self.machine, &mut self.loads);
        let centres = &mut self.listed.centres;
        *centres = stay.old.iter().map(|&at| centres[at as usize]).collect();
        let spheres = self.grains.spheres.chunks(CHUNK);
        self.listed.moved = spheres
            .zip(self.listed.centres.chunks(CHUNK))
            .map(|(spheres, centres)| {
                let ways = spheres.iter().zip(centres);
                ways.map(|(sphere, &centre)| (sphere.centre - centre).length_squared())
                    .fold(0.0, f64::max)
            })
            .collect();
        Ok(())
    }
}
