//! Similar impacts: slow elastic ones are run faster, and their figures brought back by Hertz's similarity.
//!
//! Below the yield speed an impact depends on $\rho V^2/E$ and $\nu$ alone. As V vanishes it lasts ever longer against the time that
//! waves take through the body, and inertia and the body's shape drop out: what is left is Hertz's impact, in which all speeds are
//! similar, $F \propto V^{6/5}$, $\delta \propto V^{4/5}$, $t \propto V^{-1/5}$, $a \propto V^{2/5}$. A run at V itself would need
//! ever more and smaller steps for that one answer, and at $V/c_0$ of $10^{-7}$ its energy is lost in the rounding of the strains'.
//!
//! What a run is off Hertz by is of first order in $\sqrt{\delta/R}$: $F = F_H (1 + c \sqrt{\delta/R})$ with c from 0.6 to 0.9
//! (`tests/impact/elastic.rs`), at most 0.45 of it in F*, 0.3 in $\delta$* and contact time. At V that is less. The speed is chosen so
//! that this error is half of the tolerance at most.

use super::{Effect, Estimate, Grid};
use crate::unit::{engineering, significant};

/// Share of $\sqrt{\delta/R}$ that the largest force differs from Hertz's by, at most.
const OFF_HERTZ: f64 = 0.45;
/// Share of the tolerance that the difference may take.
const SHARE: f64 = 0.5;

/// Factors on what was found at one speed to what holds at another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    /// V over the speed of the run.
    speed: f64,
}

impl Similarity {
    /// From a run at one speed to another.
    #[must_use]
    pub fn between(run: f64, velocity: f64) -> Self {
        Similarity {
            speed: velocity / run,
        }
    }

    /// Whether anything changes.
    #[must_use]
    pub fn is_on(&self) -> bool {
        self.speed != 1.0
    }

    fn power(&self, exponent: f64) -> f64 {
        if self.is_on() {
            self.speed.powf(exponent)
        } else {
            1.0
        }
    }

    /// Of times.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.power(-0.2)
    }

    /// Of displacements.
    #[must_use]
    pub fn displacement(&self) -> f64 {
        self.power(0.8)
    }

    /// Of contact radii.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.power(0.4)
    }

    /// Of forces.
    #[must_use]
    pub fn force(&self) -> f64 {
        self.power(1.2)
    }

    /// Of energies.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.power(2.0)
    }
}

/// Speed at which an elastic impact is run whose largest displacement would be `displacement` (in R) at the speed `velocity`.
#[must_use]
pub fn run_speed(velocity: f64, displacement: f64, tolerance: f64) -> f64 {
    let most = (SHARE * tolerance / OFF_HERTZ).powi(2);
    let run = velocity * (most / displacement).powf(1.25).max(1.0);
    // energies of an impact too slow for numbers cannot be brought back
    if Similarity::between(run, velocity).energy() >= f64::MIN_POSITIVE {
        run
    } else {
        velocity
    }
}

/// Whether a faster impact is run in place of the one asked for.
pub(super) fn similar_impact(asked: f64, run: f64, estimate: &Estimate) -> Effect {
    let on = run != asked;
    let reason = if on {
        let error = 45.0 * estimate.displacement.sqrt();
        format!(
            "without yield slow impacts are Hertz's: run at {}, F ~ V^1.2, delta ~ V^0.8, t ~ V^-0.2 within {} %",
            engineering(run, "m/s", 3),
            significant(error, 2)
        )
    } else {
        "it is run at its own speed".to_owned()
    };
    Effect {
        name: "similar impact",
        on,
        reason,
    }
}

/// Whether small cells are made heavier.
pub(super) fn mass_scaling(grid: &Grid, estimate: &Estimate) -> Effect {
    let lasts = format!(
        "the impact takes {} R/c0",
        significant(estimate.contact_time, 3)
    );
    Effect {
        name: "mass scaling",
        on: grid.scaled > 0.0,
        reason: if grid.scaled > 0.0 {
            format!(
                "{lasts}, so the inertia of small cells does not matter: {} % of the mass is moved to them, steps are {} times as \
                 long",
                significant(100.0 * grid.added_mass(), 2),
                significant(grid.scaled / grid.fine, 3)
            )
        } else {
            format!("{lasts}, and its cells are not small enough for a gain")
        },
    }
}
