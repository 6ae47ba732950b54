//! Pair: flattening laws pressed against each other, or one against a rigid surface.
//!
//! Two touching bodies are two flattening laws in series: they share one force, and their flattenings add up to the
//! overlap of the undeformed bodies,
//!
//! $$ \delta = \delta_1 + \delta_2, \qquad F_1(\delta_1) = F_2(\delta_2) = F . $$
//!
//! The surface they share is curved, so that neither is pressed by a plane; what flattens a side is its curvature
//! against that surface. With the surface where Hertz has it, side $i$ is pressed like a sphere on a plane whose radius is
//!
//! $$ R_i' = R_e \left(1 + \frac{E_i^\ast}{E_j^\ast}\right), \qquad \frac{1}{R_e} = \frac{1}{R_1} + \frac{1}{R_2}, $$
//!
//! and the pair is Hertz's for any radii and moduli (Johnson 1985, section 4.2: $a^2 = R_e \delta = R_i' \delta_i$). Equal
//! spheres have $R_i' = R$, a rigid partner gives $R_i' = R_e$. With each side's own radius instead, a sphere on a large
//! one of its own material would be pressed as on a rigid wall, twice as stiff as it is.
//!
//! | type | bodies | each side |
//! |---|---|---|
//! | [`Flat`] | a grain on a rigid surface | $\delta_1 = \delta$, $R' = R$ |
//! | [`Twins`] | two grains of one material and one radius | $\delta_i = \delta/2$, $R' = R$ |
//! | [`Alike`] | two grains of one material and any radii | $\delta_i = \delta/2$, $R' = 2 R_e$ |
//! | [`Side`] twice | bodies of two materials | solved by [`balance`], each side with its own history |

use super::{Coverage, NormalLaw};
use crate::tape::Keep;
use std::fmt::Debug;

/// State of a pressed contact, SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pressed {
    /// Normal force F, N; 0 where the law has lost contact.
    pub force: f64,
    /// Tangent stiffness dF/d(overlap) of the present branch, N/m.
    pub stiffness: f64,
    /// Contact radius a, m: the law's own, else the geometric $a^2 = R \delta_1$.
    pub contact_radius: f64,
    /// Flattening of the first and of the second body, m.
    pub flattening: [f64; 2],
    /// Overlap since the force was zero on the present branch, m.
    pub depth: f64,
}

/// What presses: a pair of bodies, or a body and a rigid surface.
pub trait Press: Clone + Send + Sync + 'static {
    /// What the contact remembers.
    type History: Copy + Default + Send + Sync + PartialEq + Keep + Debug;
    /// Force at `overlap` (m) of bodies of `radii` (m), updating the history.
    fn press(&self, overlap: f64, radii: [f64; 2], history: &mut Self::History) -> Pressed;

    /// Recoverable energy (J) at `overlap`, the history being up to date.
    fn elastic_energy(&self, overlap: f64, radii: [f64; 2], history: &Self::History) -> f64;

    /// Energy (J) plastic flow has dissipated.
    fn dissipated(&self, radii: [f64; 2], history: &Self::History) -> f64;

    /// Largest overlap (m) so far of bodies of `radii` (m), where the law remembers it.
    fn largest_overlap(&self, radii: [f64; 2], history: &Self::History) -> Option<f64>;

    /// What of the contact at `overlap` (m) lies within the range of its law, the history being up to date.
    fn coverage(&self, overlap: f64, radii: [f64; 2], history: &Self::History) -> Coverage;
}

/// A grain on a rigid surface; all flattening is the grain's.
#[derive(Debug, Clone, PartialEq)]
pub struct Flat<L>(pub L);

impl<L: NormalLaw> Press for Flat<L> {
    type History = L::History;

    #[inline(always)]
    fn press(&self, overlap: f64, radii: [f64; 2], history: &mut L::History) -> Pressed {
        let radius = radii[0];
        let state = self.0.state(overlap / radius, history);
        Pressed {
            force: radius * radius * state.force,
            stiffness: radius * state.stiffness,
            contact_radius: radius * state.contact_radius,
            flattening: [overlap, 0.0],
            depth: radius * state.depth,
        }
    }

    fn elastic_energy(&self, overlap: f64, radii: [f64; 2], history: &L::History) -> f64 {
        radii[0].powi(3) * self.0.elastic_energy(overlap / radii[0], history)
    }

    fn dissipated(&self, radii: [f64; 2], history: &L::History) -> f64 {
        radii[0].powi(3) * self.0.dissipated(history)
    }

    fn largest_overlap(&self, radii: [f64; 2], history: &L::History) -> Option<f64> {
        self.0.largest(history).map(|x| x * radii[0])
    }

    fn coverage(&self, overlap: f64, radii: [f64; 2], history: &L::History) -> Coverage {
        Coverage::of(&self.0, overlap / radii[0], history).times(1.0, radii[0].powi(3))
    }
}

/// Two grains of one material and one radius: each side takes half the overlap, so one history serves both.
///
/// $$ F(\delta) = R^2 \varphi\left(\frac{\delta}{2R}\right), \qquad \frac{dF}{d\delta} = \frac{R}{2} \varphi' $$
///
/// ```
/// use impactlaw::contact::pair::{Flat, Press, Twins};
/// use impactlaw::theory::hertz::Hertz;
/// // Two spheres overlapping by 2 d carry the force of one sphere pressed by d on a rigid flat.
/// let (radii, d) = ([1e-3, 1e-3], 1e-6);
/// let pair = Twins(Hertz::new(7e10)).press(2.0 * d, radii, &mut ());
/// let wall = Flat(Hertz::new(7e10)).press(d, radii, &mut ());
/// assert_eq!(pair.force, wall.force);
/// assert_eq!(2.0 * pair.stiffness, wall.stiffness);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Twins<L>(pub L);

impl<L: NormalLaw> Press for Twins<L> {
    type History = L::History;

    #[inline(always)]
    fn press(&self, overlap: f64, radii: [f64; 2], history: &mut L::History) -> Pressed {
        let radius = radii[0];
        let half = 0.5 * overlap;
        let state = self.0.state(half / radius, history);
        Pressed {
            force: radius * radius * state.force,
            stiffness: 0.5 * radius * state.stiffness,
            contact_radius: radius * state.contact_radius,
            flattening: [half, half],
            depth: 2.0 * radius * state.depth,
        }
    }

    fn elastic_energy(&self, overlap: f64, radii: [f64; 2], history: &L::History) -> f64 {
        2.0 * radii[0].powi(3) * self.0.elastic_energy(0.5 * overlap / radii[0], history)
    }

    fn dissipated(&self, radii: [f64; 2], history: &L::History) -> f64 {
        2.0 * radii[0].powi(3) * self.0.dissipated(history)
    }

    fn largest_overlap(&self, radii: [f64; 2], history: &L::History) -> Option<f64> {
        self.0.largest(history).map(|x| 2.0 * x * radii[0])
    }

    fn coverage(&self, overlap: f64, radii: [f64; 2], history: &L::History) -> Coverage {
        Coverage::of(&self.0, 0.5 * overlap / radii[0], history).times(2.0, radii[0].powi(3))
    }
}

/// Two grains of one material and any radii: each side takes half the overlap with the radius $2 R_e$.
///
/// ```
/// use impactlaw::contact::pair::{Alike, Press};
/// use impactlaw::theory::hertz::Hertz;
/// // Hertz on two spheres: F = 4/3 (E*/2) sqrt(Re) d^1.5
/// let (modulus, effective, d) = (7e10, 0.75e-3, 1e-6f64);
/// let pair = Alike(Hertz::new(modulus)).press(d, [1e-3, 3e-3], &mut ());
/// let hertz = 2.0 / 3.0 * modulus * f64::sqrt(effective) * d.powf(1.5);
/// assert!((pair.force / hertz - 1.0).abs() < 1e-13);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Alike<L>(pub L);

/// Radius of the sphere whose flattening on a plane is that of each side, $2 R_e$.
#[inline(always)]
fn radius_of_sides([a, b]: [f64; 2]) -> f64 {
    2.0 * a * b / (a + b)
}

impl<L: NormalLaw> Press for Alike<L> {
    type History = L::History;

    #[inline(always)]
    fn press(&self, overlap: f64, radii: [f64; 2], history: &mut L::History) -> Pressed {
        let radius = radius_of_sides(radii);
        let half = 0.5 * overlap;
        let state = self.0.state(half / radius, history);
        Pressed {
            force: radius * radius * state.force,
            stiffness: 0.5 * radius * state.stiffness,
            contact_radius: radius * state.contact_radius,
            flattening: [half, half],
            depth: 2.0 * radius * state.depth,
        }
    }

    fn elastic_energy(&self, overlap: f64, radii: [f64; 2], history: &L::History) -> f64 {
        let radius = radius_of_sides(radii);
        2.0 * radius.powi(3) * self.0.elastic_energy(0.5 * overlap / radius, history)
    }

    fn dissipated(&self, radii: [f64; 2], history: &L::History) -> f64 {
        2.0 * radius_of_sides(radii).powi(3) * self.0.dissipated(history)
    }

    fn largest_overlap(&self, radii: [f64; 2], history: &L::History) -> Option<f64> {
        let radius = radius_of_sides(radii);
        self.0.largest(history).map(|x| 2.0 * x * radius)
    }

    fn coverage(&self, overlap: f64, radii: [f64; 2], history: &L::History) -> Coverage {
        let radius = radius_of_sides(radii);
        Coverage::of(&self.0, 0.5 * overlap / radius, history).times(2.0, radius.powi(3))
    }
}

/// Relative mismatch of the two forces at which the search ends: what is left of it enters the force and the energy
/// squared.
const MISMATCH: f64 = 1e-9;
/// Newton step over the overlap at which the search ends where one side carries nothing: the bodies have lost contact, and the
/// other side would come to nothing only in the limit.
const SLIGHT: f64 = 1e-13;
/// Iterations of the safeguarded Newton search: in each the mismatch or the bracket is halved.
const MAX_SEARCH: usize = 128;

/// One side of a contact between two materials, at a trial flattening.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Side {
    /// Force, N.
    pub force: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
}

/// Flattening (m) of the first side at which both sides carry one force, with the state of both there: Newton from
/// `guess`, kept inside a bracket that bisection can finish. A guess from the step before is off by the little the
/// share has changed since, so that one or two trials end the search.
pub fn balance(
    overlap: f64,
    guess: f64,
    mut first: impl FnMut(f64) -> Side,
    mut second: impl FnMut(f64) -> Side,
) -> (f64, [Side; 2]) {
    let (mut low, mut high) = (0.0, overlap);
    let mut at = guess;
    let mut sides = [first(at), second(overlap - at)];
    let mut before = f64::INFINITY;
    for _ in 0..MAX_SEARCH {
        let [a, b] = sides;
        let excess = a.force - b.force;
        if excess.abs() <= MISMATCH * a.force.max(b.force) {
            break;
        }
        if excess > 0.0 {
            high = at;
        } else {
            low = at;
        }
        let step = excess / (a.stiffness + b.stiffness);
        if a.force.min(b.force) == 0.0 && step.abs() <= SLIGHT * overlap {
            break;
        }
        let newton = at - step;
        // at a kink Newton can creep on inside the bracket for ever
        let gains = excess.abs() <= 0.5 * before;
        let next = if gains && newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        before = excess.abs();
        if next == at {
            break;
        }
        at = next;
        sides = [first(at), second(overlap - at)];
    }
    (at, sides)
}

/// Force and stiffness of two sides in series, both to second order in what is left of their mismatch.
#[must_use]
pub fn in_series([a, b]: [Side; 2]) -> Side {
    let both = a.stiffness + b.stiffness;
    if both > 0.0 {
        Side {
            force: (a.force * b.stiffness + b.force * a.stiffness) / both,
            stiffness: a.stiffness * b.stiffness / both,
        }
    } else {
        Side {
            force: 0.5 * (a.force + b.force),
            stiffness: 0.0,
        }
    }
}
