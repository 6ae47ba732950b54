//! Shock: a viscous stress where material is compressed within a few steps.
//!
//! Where the wall stops a body at a good part of its wave speed, a shock runs into it. Across a shock the equations of motion
//! lose energy: what came in kinetically and is not stored becomes heat. A scheme without dissipation cannot lose it; it leaves
//! it in oscillations from point to point. The viscous stress of von Neumann and Richtmyer (1950), with Landshoff's linear term
//! (1955), takes the energy where it is lost, and spreads the shock over a few cells. What it changes is measured in the guide,
//! chapter *The solver*. With w the speed at which the sides of a cell close in,
//!
//! $$ \tau_q = - \rho_0 (c_2 w^2 + c_1 c_d w), \qquad w = \max(0, - h \dot J) $$
//!
//! Its work follows from the conditions across the shock whatever the coefficients, as long as cells are small. The usual ones
//! are used (e.g. Benson 1992). In slow compression w is of the order of the strain rate times a cell, and nothing is felt.

use crate::lanes::Lanes;
use crate::plan::viscosity::{LINEAR, QUADRATIC};
use crate::tape::{Keep, Tape};

/// Size of a cell over the way of a wave in its stable step: quadratic splines have $\omega_{max} = 1.95 c/h$, and 0.85 of
/// $2/\omega_{max}$ is used. Of squeezed cells this is the size they have left.
const CELLS: f64 = 1.15;

/// Viscous stresses of all points, block by block.
#[derive(Debug, Clone, Default)]
pub(super) struct Shock {
    /// Linear coefficient times the dilatational wave speed; `None`: off.
    linear: Option<f64>,
    /// Size of a cell over its time step.
    way: f64,
    /// Volume ratios of the step before.
    ratios: Vec<Lanes>,
    /// Mean viscous Kirchhoff stresses.
    stresses: Vec<Lanes>,
}

impl Keep for Shock {
    fn save(&self, tape: &mut Tape) {
        let Self {
            linear: _,
            way: _,
            ratios,
            stresses,
        } = self;
        ratios.as_slice().save(tape);
        stresses.as_slice().save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            linear: _,
            way: _,
            ratios,
            stresses,
        } = self;
        ratios.as_mut_slice().load(tape)?;
        stresses.as_mut_slice().load(tape)
    }
}

impl Shock {
    /// On for a dilatational wave speed if the share of the stable step that is taken is given, else off.
    pub(super) fn new(speed: f64, dt_share: Option<f64>) -> Self {
        Shock {
            linear: dt_share.map(|_| LINEAR * speed),
            way: dt_share.map_or(0.0, |share| CELLS * speed / share),
            ..Shock::default()
        }
    }

    /// Add an undeformed block.
    pub(super) fn push(&mut self) {
        if self.is_on() {
            self.ratios.push(Lanes::splat(1.0));
            self.stresses.push(Lanes::default());
        }
    }

    #[inline(always)]
    pub(super) fn is_on(&self) -> bool {
        self.linear.is_some()
    }

    /// `stress` and the viscous one of a block.
    #[inline(always)]
    pub(super) fn added_to(&self, stress: Lanes, block: usize) -> Lanes {
        if self.is_on() {
            stress + self.stresses[block]
        } else {
            stress
        }
    }

    /// Take up the volume ratios `j` that a block of cells of size `side` has reached in `dt`. Returns the work of the stress it
    /// had till then, per reference volume.
    #[inline(always)]
    pub(super) fn follow(&mut self, block: usize, j: Lanes, side: f64, dt: f64) -> Lanes {
        let before = std::mem::replace(&mut self.ratios[block], j);
        let grown = j - before;
        let work = self.stresses[block] * grown * before.recip();
        let speed = if dt > 0.0 {
            grown * (-side.min(self.way * dt) / dt)
        } else {
            Lanes::default()
        };
        let speed = speed.where_positive(speed, Lanes::default());
        let linear = Lanes::splat(self.linear.unwrap_or_default());
        self.stresses[block] = -(speed * QUADRATIC + linear) * speed;
        work
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> usize {
        std::mem::size_of_val(&self.ratios[..]) + std::mem::size_of_val(&self.stresses[..])
    }
}
