//! Dump: grains as text in the format of LAMMPS' `dump custom`, which OVITO, VMD and LAMMPS' own tools read.

use crate::dem::bodies::machine::Machine;
use crate::dem::grains::Grains;
use parry3d::math::Vector;
use std::fmt::Write;

/// Columns after the header.
const COLUMNS: &str = "id type x y z radius vx vy vz omegax omegay omegaz mass group";

/// One frame: `ITEM: TIMESTEP` to the last grain, SI units, grains in the order of their names. Names, types (the
/// materials) and groups count from 1.
///
/// The box is the smallest that holds all grains and bodies (`ff`: its sides are open), as other programs need one.
#[must_use]
pub fn frame(grains: &Grains, machine: &Machine, step: u64) -> String {
    let (mut low, mut high) = (Vector::MAX, Vector::MIN);
    for sphere in &grains.spheres {
        low = low.min(sphere.centre - sphere.radius);
        high = high.max(sphere.centre + sphere.radius);
    }
    for surface in &machine.surfaces {
        if surface.removed || surface.shape.as_halfspace().is_some() {
            continue;
        }
        let bounds = surface.shape.compute_aabb(&surface.pose);
        low = low.min(bounds.mins * machine.unit);
        high = high.max(bounds.maxs * machine.unit);
    }
    if low.x > high.x {
        (low, high) = (Vector::ZERO, Vector::ZERO);
    }
    let mut text = format!(
        "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n",
        grains.len()
    );
    for axis in 0..3 {
        let _ = writeln!(text, "{:e} {:e}", low[axis], high[axis]);
    }
    let _ = writeln!(text, "ITEM: ATOMS {COLUMNS}");
    let mut order: Vec<usize> = (0..grains.len()).collect();
    order.sort_unstable_by_key(|&grain| grains.ids[grain]);
    for grain in order {
        let (sphere, motion) = (&grains.spheres[grain], &grains.motions[grain]);
        let (c, v, w) = (sphere.centre, motion.velocity, grains.spins[grain].rate);
        let _ = writeln!(
            text,
            "{} {} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {:e} {}",
            grains.ids[grain] + 1,
            u32::from(grains.material(grain)) + 1,
            c.x,
            c.y,
            c.z,
            sphere.radius,
            v.x,
            v.y,
            v.z,
            w.x,
            w.y,
            w.z,
            1.0 / motion.inverse_mass,
            grains.groups[grain] + 1
        );
    }
    text
}
