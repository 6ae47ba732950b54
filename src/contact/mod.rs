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

    /// What the law adds to [`NormalLaw::force`] on first loading because of the rate of approach. Everything else of
    /// this trait is the rate-independent core; a bed runs on the core alone.
    fn inertia(&self) -> Inertia {
        Inertia::NONE
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
