//! Fitted elastic-plastic law: a loading curve, unloading branches, and what the contact remembers.

use super::admissible::Inadmissible;
use super::inertia::Inertia;
use super::loading::{Loading, SoftenedHertz};
use super::spline::SplineLoading;
use super::unloading::Unloading;
use super::{NormalLaw, Slowest, State};
use crate::tape::keep_fields;
use std::f64::consts::PI;

/// Fitted law with its closed-form loading curve.
pub type ClosedForm = Elastoplastic<SoftenedHertz>;
/// Fitted law with its spline loading curve.
pub type Spline = Elastoplastic<SplineLoading>;

/// Yield point of a material in reduced units: what $w$ and $f$ are counted in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldUnits {
    /// Flattening $x_y = \delta_y/R$.
    pub flattening: f64,
    /// Force $\varphi_y = F_y/R^2$, Pa.
    pub force: f64,
}

/// Elastic-plastic normal law of one body on a rigid plane, with a loading curve `L`:
///
/// $$ \varphi = \varphi_y\ f(x/x_y) \text{ in loading}, \quad
///    \varphi = \varphi_m \left(\frac{x - x_r}{x_m - x_r}\right)^n \text{ below the largest flattening } x_m $$
///
/// with $f$ of [`Loading`] and $x_r(x_m), n(x_m)$ of [`Unloading`]. Reloading retraces the branch to $x_m$ and goes
/// on along the loading curve. For every admissible set of constants: force and slope are continuous with Hertz
/// at the departure, loading increases, the force is never tensile and is zero below $x_r$, a later branch lies
/// below every earlier one (so no cycle yields energy), and the branch tends to Hertz as $x_m$ falls to the
/// departure. The force depends on $x$ and $x_m$ alone, hence not on the steps taken; where impacts show it, first
/// loading has an [`Inertia`] term on top, which takes energy and touches no other branch.
///
/// Past [`NormalLaw::valid_to`] the curves go on by the same formulas (the spline as a straight line); they stay
/// monotone, but no data support them.
#[derive(Debug, Clone, PartialEq)]
pub struct Elastoplastic<L> {
    loading: L,
    unloading: Unloading,
    units: YieldUnits,
    valid_to: f64,
    slowest: Option<Slowest>,
    inertia: Inertia,
}

/// What a contact of an [`Elastoplastic`] law remembers: the largest flattening. The other fields follow from
/// it; they are kept because they cost more than a call, and those of the branch are worked out when unloading begins.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// Largest flattening $x_m = \delta_m/R$ so far.
    pub flattening: f64,
    /// Reduced force at it, Pa.
    force: f64,
    /// Flattening $x_r$ at which the branch loses contact.
    residual: f64,
    /// Exponent $n$ of the branch, at least 1; 0 as long as nobody has asked for the branch.
    exponent: f64,
}

keep_fields!(Memory: flattening, force, residual, exponent);

/// Largest flattening $\delta/R$ at which a branch is asked for; a body ends there.
pub(super) const DEEPEST: f64 = 2.0;
/// Recovered part $1 - \rho$ of the deepest branch, and residual part $\rho$, below which it is lost in rounding.
const LEAST_PART: f64 = 1e-12;

/// Accuracy to which the flattening of the slowest impact is found.
const SLOWEST_ROUNDING: f64 = 1e-9;

/// Rounding allowed when the bound of the loading exponent is compared with that of unloading.
const EXPONENT_ROUNDING: f64 = 1e-9;

impl<L: Loading> Elastoplastic<L> {
    /// Law from its parts; `valid_to` is the largest flattening the fit has seen.
    ///
    /// # Errors
    /// [`Inadmissible`] when units or `valid_to` are not finite and positive, or where the loading curve rises more
    /// steeply than the unloading branch that starts there.
    pub fn new(
        loading: L,
        unloading: Unloading,
        units: YieldUnits,
        valid_to: f64,
    ) -> Result<Self, Inadmissible> {
        let named = [
            ("yield_point.flattening", units.flattening),
            ("yield_point.force", units.force),
            ("valid.flattening", valid_to),
        ];
        for (key, x) in named {
            let fine = x > 0.0 && x.is_finite();
            Inadmissible::unless(fine, key, x, "must be finite and above 0")?;
        }
        for (w, bound) in loading.exponent_bounds() {
            let (rho, n) = unloading.branch(w, loading.departure(), units.flattening);
            Inadmissible::unless(
                bound * (1.0 - rho) <= n * (1.0 + EXPONENT_ROUNDING),
                format!("loading exponent past w = {w}"),
                bound,
                "must not exceed that of unloading, n/(1 - residual ratio), or cycles would yield energy",
            )?;
        }
        let deepest = DEEPEST / units.flattening;
        let (rho, _) = unloading.branch(deepest, loading.departure(), units.flattening);
        let scale = "unloading.residual_scale";
        Inadmissible::unless(
            1.0 - rho >= LEAST_PART,
            scale,
            unloading.constants()[0],
            "must be larger, or `residual_power` smaller: after a flattening of 2 R nothing would be left to unload",
        )?;
        Inadmissible::unless(
            deepest <= loading.departure() || rho >= LEAST_PART,
            scale,
            unloading.constants()[0],
            "must be smaller, or `residual_power` larger: after a flattening of 2 R no residual would be left of what has yielded",
        )?;
        Ok(Elastoplastic {
            loading,
            unloading,
            units,
            valid_to,
            slowest: None,
            inertia: Inertia::NONE,
        })
    }

    /// The same law, which rests on impacts from `velocity` (m/s) on of a body of `density` (kg/m3).
    #[must_use]
    pub fn from_velocity(mut self, velocity: f64, density: f64) -> Self {
        let energy = 2.0 / 3.0 * PI * density * velocity * velocity;
        let reduced = energy / (self.units.force * self.units.flattening);
        // work rises with the flattening; a body yields from 1 on
        let (mut low, mut high) = (1.0, DEEPEST / self.units.flattening);
        let gap = self.loading.work(low) < reduced && self.loading.work(high) > reduced;
        while gap && high > low * (1.0 + SLOWEST_ROUNDING) {
            let middle = (low * high).sqrt();
            match self.loading.work(middle) < reduced {
                true => low = middle,
                false => high = middle,
            }
        }
        self.slowest = gap.then_some(Slowest {
            velocity,
            flattening: low * self.units.flattening,
            yields_at: self.units.flattening,
        });
        self
    }

    /// The same law with an inertia term of size `coefficient` on a body of `density` (kg/m3), from the departure on.
    ///
    /// # Errors
    /// Those of [`Inertia::new`].
    pub fn with_inertia(mut self, coefficient: f64, density: f64) -> Result<Self, Inadmissible> {
        let start = self.loading.departure() * self.units.flattening;
        self.inertia = Inertia::new(coefficient, density, start)?;
        Ok(self)
    }

    /// Loading curve in yield units.
    #[must_use]
    pub fn loading(&self) -> &L {
        &self.loading
    }

    /// Unloading branches.
    #[must_use]
    pub fn unloading(&self) -> &Unloading {
        &self.unloading
    }

    /// Yield units.
    #[must_use]
    pub fn units(&self) -> YieldUnits {
        self.units
    }

    /// Residual ratio $\rho$ and exponent $n$ of the branch from $w_m$ = `w_m`.
    #[inline]
    #[must_use]
    pub fn branch(&self, w_m: f64) -> (f64, f64) {
        self.unloading
            .branch(w_m, self.loading.departure(), self.units.flattening)
    }

    /// Memory of a contact whose largest flattening is `x`.
    #[inline]
    #[must_use]
    pub fn memory(&self, x: f64) -> Memory {
        Memory {
            flattening: x,
            force: self.units.force * self.loading.force(x / self.units.flattening),
            residual: 0.0,
            exponent: 0.0,
        }
    }

    /// Flattening $x_r$ at which a contact with this memory is lost in unloading.
    #[must_use]
    pub fn residual(&self, memory: &Memory) -> f64 {
        self.unloaded(memory).residual
    }

    /// Is the contact still in Hertz's range? Not told by its residual, which rounding may make 0 past the departure: then the
    /// way back is below the loading curve all the same, and Hertz's curve is above it.
    #[inline]
    fn is_elastic(&self, memory: &Memory) -> bool {
        memory.flattening <= self.loading.departure() * self.units.flattening
    }

    /// Memory with the constants of its branch.
    #[inline]
    fn unloaded(&self, memory: &Memory) -> Memory {
        if memory.exponent > 0.0 {
            return *memory;
        }
        let (rho, exponent) = self.branch(memory.flattening / self.units.flattening);
        Memory {
            residual: rho * memory.flattening,
            exponent,
            ..*memory
        }
    }
}

impl<L: Loading> NormalLaw for Elastoplastic<L> {
    type History = Memory;

    #[inline]
    fn force(&self, x: f64, history: &mut Memory) -> f64 {
        if x >= history.flattening {
            if x > history.flattening {
                *history = self.memory(x);
            }
            return history.force;
        }
        *history = self.unloaded(history);
        if x <= history.residual {
            return 0.0;
        }
        if self.is_elastic(history) {
            return self.units.force * super::loading::hertz(x / self.units.flattening);
        }
        let span = history.flattening - history.residual;
        history.force * ((x - history.residual) / span).powf(history.exponent)
    }

    fn stiffness(&self, x: f64, history: &Memory) -> f64 {
        let loading = || {
            let slope = self.loading.slope(x / self.units.flattening);
            self.units.force / self.units.flattening * slope
        };
        if x >= history.flattening {
            return if x > 0.0 { loading() } else { 0.0 };
        }
        let history = self.unloaded(history);
        if x <= history.residual {
            return 0.0;
        }
        if self.is_elastic(&history) {
            return loading();
        }
        let span = history.flattening - history.residual;
        let z = (x - history.residual) / span;
        history.force * history.exponent / span * z.powf(history.exponent - 1.0)
    }

    #[inline]
    fn state(&self, x: f64, history: &mut Memory) -> State {
        let contact_radius = x.max(0.0).sqrt();
        if x >= history.flattening {
            let (force, slope) = self.loading.force_and_slope(x / self.units.flattening);
            let (force, stiffness) = (
                self.units.force * force,
                self.units.force / self.units.flattening * slope,
            );
            if x > history.flattening {
                *history = Memory {
                    flattening: x,
                    force,
                    residual: 0.0,
                    exponent: 0.0,
                };
            }
            return State {
                force,
                stiffness,
                contact_radius,
                depth: x.max(0.0),
            };
        }
        *history = self.unloaded(history);
        let past = x - history.residual;
        if past <= 0.0 {
            return State {
                contact_radius,
                ..State::default()
            };
        }
        // Hertz too, as long as nothing has yielded: no residual, exponent 3/2
        let inverse_span = 1.0 / (history.flattening - history.residual);
        let z = past * inverse_span;
        let power = if history.exponent == 1.5 {
            z.sqrt()
        } else {
            z.powf(history.exponent - 1.0)
        };
        let secant = history.force * inverse_span * power;
        State {
            force: secant * past,
            stiffness: secant * history.exponent,
            contact_radius,
            depth: past,
        }
    }

    fn depth(&self, x: f64, history: &Memory) -> f64 {
        if x >= history.flattening {
            return x.max(0.0);
        }
        (x - self.unloaded(history).residual).max(0.0)
    }

    fn dissipated(&self, history: &Memory) -> f64 {
        let branch = self.unloaded(history);
        if self.is_elastic(&branch) {
            return 0.0;
        }
        let work = self.loading.work(branch.flattening / self.units.flattening);
        let span = branch.flattening - branch.residual;
        self.units.force * self.units.flattening * work
            - branch.force * span / (branch.exponent + 1.0)
    }

    fn elastic_energy(&self, x: f64, history: &Memory) -> f64 {
        let mut branch = *history;
        let force = self.force(x, &mut branch);
        branch = self.unloaded(&branch);
        force * (x - branch.residual).max(0.0) / (branch.exponent + 1.0)
    }

    fn contact_radius(&self, _x: f64, _history: &Memory) -> Option<f64> {
        None
    }

    fn largest(&self, history: &Memory) -> Option<f64> {
        Some(history.flattening)
    }

    fn valid_to(&self) -> f64 {
        self.valid_to
    }

    fn slowest(&self) -> Option<Slowest> {
        self.slowest
    }

    fn inertia(&self) -> Inertia {
        self.inertia
    }
}
