//! Contact laws of one body pressed by a rigid plane (flattening laws) and what is built from them.
//!
//! Sign convention, stated here and nowhere else: overlap $\delta > 0$ means contact, force $F > 0$ repels,
//! rate $\dot\delta > 0$ approaches.
//!
//! Laws are geometrically similar: with $x = \delta/R$ the flattening of a body of radius R,
//! $F = R^2 \varphi(x)$. Traits speak in $x$ and the reduced force $\varphi = F/R^2$ (Pa), so one law serves every
//! grain size of its material.

pub mod admissible;
pub mod elastoplastic;
pub mod guarantees;
pub mod inertia;
pub mod loading;
pub mod pair;
mod panel;
pub mod rebound;
pub mod spline;
pub mod unloading;

use crate::tape::Keep;
use inertia::Inertia;

/// Normal force law of one body on a rigid plane: a pure function of flattening and its history.
///
/// Path-exact: the force follows from the state, never from summed increments, so results do not depend on the
/// time step.
pub trait NormalLaw: Clone + Send + Sync + 'static {
    /// What the contact remembers (e.g. the largest flattening); `Default` is the virgin contact.
    type History: Copy + Default + Send + Sync + PartialEq + Keep + std::fmt::Debug;

    /// Reduced force $F/R^2$ (Pa) at flattening `x` = $\delta/R$, updating the history. 0 where contact is lost.
    fn force(&self, x: f64, history: &mut Self::History) -> f64;

    /// Tangent stiffness of the present branch, $d\varphi/dx$ (Pa), at `x` with `history` already updated.
    fn stiffness(&self, x: f64, history: &Self::History) -> f64;

    /// Force, stiffness and contact radius at once, updating the history: what a contact needs each step. To be
    /// overridden where the three share what is costly; the values must stay those of the three.
    #[inline(always)]
    fn state(&self, x: f64, history: &mut Self::History) -> State {
        let force = self.force(x, history);
        State {
            force,
            stiffness: self.stiffness(x, history),
            contact_radius: self
                .contact_radius(x, history)
                .unwrap_or_else(|| x.max(0.0).sqrt()),
            depth: self.depth(x, history),
        }
    }

    /// Flattening since the force was zero on the present branch, over R: `x` on first loading, else past where unloading loses
    /// contact; 0 where contact is lost.
    fn depth(&self, x: f64, history: &Self::History) -> f64;

    /// Recoverable energy over $R^3$ (Pa): area under the unloading branch from `x` down to zero force.
    fn elastic_energy(&self, x: f64, history: &Self::History) -> f64;

    /// Energy over $R^3$ (Pa) that plastic flow has dissipated: work of first loading up to the largest flattening, less what is
    /// recoverable from there. Exactly 0 as long as nothing has yielded.
    fn dissipated(&self, history: &Self::History) -> f64;

    /// Contact radius over R, where the law states one.
    fn contact_radius(&self, x: f64, history: &Self::History) -> Option<f64>;

    /// Largest flattening `x` so far, where the law remembers it.
    fn largest(&self, _history: &Self::History) -> Option<f64> {
        None
    }

    /// Largest flattening `x` the law's source supports; `f64::INFINITY` when it states none.
    fn valid_to(&self) -> f64;

    /// Slowest impact the law was made from, where it is one in which the body yields; none where the source has no gap above
    /// the elastic range.
    fn slowest(&self) -> Option<Slowest> {
        None
    }

    /// What the law adds to [`NormalLaw::force`] on first loading because of the rate of approach. Everything else of
    /// this trait is the rate-independent core; a bed runs on the core alone.
    fn inertia(&self) -> Inertia {
        Inertia::NONE
    }
}

/// Slowest impact that a law rests on: below it, down to the yield point, nobody has seen the law let go.
///
/// What decides is where a contact turns, not how fast it came: force and rebound follow from the largest flattening $x_m$, and
/// in an impact on a rigid plane speed and $x_m$ belong together, $\int_0^{x_m} \varphi\ dx = \tfrac23 \pi \rho V^2$ for every
/// radius. Two equal grains that meet at 2V, a grain that two others press, and a slow squeeze all have their $x_m$. First loading
/// up to the slowest $x_m$ is supported, for every faster impact passed through it; the ways back are not. Up to the yield point the
/// body is elastic and Hertz's law is exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slowest {
    /// Speed on a rigid plane, m/s.
    pub velocity: f64,
    /// Largest flattening $\delta/R$ of it under the law.
    pub flattening: f64,
    /// Flattening $\delta/R$ of first yield, less than that.
    pub yields_at: f64,
}

/// What of a contact lies within the range of its law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coverage {
    /// Whether it was flattened beyond what the law's source supports.
    pub beyond: bool,
    /// Work (J, counted as $\tfrac25 F \delta$ of each side, exact for Hertz) that has loaded it, where it has yielded and lets go.
    pub unloading: f64,
    /// The part of that which turned back short of the slowest impact of the law ([`Slowest`]).
    pub below: f64,
}

impl Coverage {
    /// Coverage over $R^3$ (Pa) of a body under `law` at flattening `x`, its history being up to date.
    #[must_use]
    pub fn of<L: NormalLaw>(law: &L, x: f64, history: &L::History) -> Self {
        let most = law.largest(history);
        let beyond = most.unwrap_or(x) > law.valid_to();
        let (Some(slowest), Some(most)) = (law.slowest(), most) else {
            return Self {
                beyond,
                ..Self::default()
            };
        };
        let mut there = *history;
        let unloading = match x < most && most > slowest.yields_at {
            true => 0.4 * most * law.force(most, &mut there),
            false => 0.0,
        };
        let below = match most < slowest.flattening {
            true => unloading,
            false => 0.0,
        };
        Self {
            beyond,
            unloading,
            below,
        }
    }

    /// The same of `count` sides, their reduced work times `volume` (m3).
    #[must_use]
    pub fn times(self, count: f64, volume: f64) -> Self {
        Self {
            beyond: self.beyond,
            unloading: count * volume * self.unloading,
            below: count * volume * self.below,
        }
    }

    /// That of two sides of one contact.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            beyond: self.beyond || other.beyond,
            unloading: self.unloading + other.unloading,
            below: self.below + other.below,
        }
    }
}

/// State of a body pressed by a plane, over its radius.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// Force $F/R^2$, Pa.
    pub force: f64,
    /// Stiffness $d\varphi/dx$, Pa.
    pub stiffness: f64,
    /// Contact radius $a/R$: what the law states, else that of a sphere cut by a plane, $a^2 = R\delta$.
    pub contact_radius: f64,
    /// Flattening over R since the force was zero on the present branch.
    pub depth: f64,
}

/// Calls generic code with the concrete law behind a name: one `match`, outside every loop.
pub trait LawVisitor {
    /// What the visit returns.
    type Output;
    /// Run with the concrete law.
    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output;
}
