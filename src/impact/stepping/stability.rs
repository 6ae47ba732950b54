//! Time step: the stability limit $2/\omega_{max}$ of the present state, by power iteration on $M^{-1} K$.
//!
//! The stiffness acts by finite difference of the elastic (frozen-state) internal force, so it is the tangent of the
//! deformed body whatever the grid or material. Plastic flow only softens it.

use crate::impact::kernel::{Part, Points, Purpose, Sweep};
use crate::space::Space;
use crate::tape::keep_fields;

/// Share of the stability limit that is used: power iteration approaches the largest frequency from below.
const SAFETY: f64 = 0.85;
/// Size of the probing displacement (lengths are in particle radii).
const PROBE: f64 = 1e-8;
/// Iterations of a search from an irregular start vector that precedes every estimate: after k of them a place stands out
/// by the power 2k of its own frequency, wherever it is.
const SEARCH: usize = 2;
/// Share of what the search found that is mixed into the mode found last. That mode alone is blind: it sits in a few cells,
/// falls below rounding elsewhere ($u + 10^{-8} m = u$), and cells that are squeezed later would be found too late or never.
const FOUND: f64 = 0.5;

/// Estimator of the largest frequency, warm-started from its last answer.
#[derive(Debug, Clone)]
pub struct StabilityLimit<S: Space> {
    /// The mode found last, and one to try.
    mode: Vec<S::Vector>,
    last: Vec<S::Vector>,
    /// Forces at rest, displacements that probe and their forces.
    rest: Vec<S::Vector>,
    moved: Vec<S::Vector>,
    force: Vec<S::Vector>,
}

keep_fields!(impl [S: Space] StabilityLimit<S>: mode; rebuilt last, rest, moved, force);

impl<S: Space> StabilityLimit<S> {
    /// Estimator for `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        let mut mode = vec![S::Vector::default(); nodes];
        stir::<S>(&mut mode);
        StabilityLimit {
            last: mode.clone(),
            mode,
            rest: vec![S::Vector::default(); nodes],
            moved: vec![S::Vector::default(); nodes],
            force: vec![S::Vector::default(); nodes],
        }
    }

    /// Stable time step of a part of the cells at displacements `u` after `iterations` power iterations: of the mode found last,
    /// which the body's slow change keeps converged, or of that one mixed with what a search found, if this is faster.
    pub fn estimate<const N: usize>(
        &mut self,
        points: &mut Points<S, N>,
        part: Part,
        u: &[S::Vector],
        recip_mass: &[S::Vector],
        iterations: usize,
    ) -> f64 {
        // sweeps over a level leave the entries of other nodes as they are
        self.rest.fill(S::Vector::default());
        self.force.fill(S::Vector::default());
        points.sweep_part(part, Purpose::Trial, u, &mut self.rest);
        std::mem::swap(&mut self.mode, &mut self.last);
        stir::<S>(&mut self.mode);
        for _ in 0..SEARCH {
            self.iterate(points, part, u, recip_mass);
        }
        self.mix();
        let mut challenger = 0.0f64;
        for _ in 1..iterations.max(2) {
            challenger = self.iterate(points, part, u, recip_mass);
        }
        std::mem::swap(&mut self.mode, &mut self.last);
        let champion = self.iterate(points, part, u, recip_mass);
        if challenger > champion {
            std::mem::swap(&mut self.mode, &mut self.last);
        }
        let squared = challenger.max(champion);
        SAFETY * 2.0 / squared.sqrt()
    }

    /// Energy of each cell of a part in the fastest mode found, over the largest of them.
    pub fn energy_shares<const N: usize>(
        &mut self,
        points: &mut Points<S, N>,
        part: Part,
        u: &[S::Vector],
    ) -> Vec<f64> {
        let scale = PROBE / largest_component(&self.mode);
        for ((moved, mode), u) in self.moved.iter_mut().zip(&self.mode).zip(u) {
            for (k, y) in moved.as_mut().iter_mut().enumerate() {
                *y = u.as_ref()[k] + scale * mode.as_ref()[k];
            }
        }
        let mode = &self.mode;
        let power = |_: &Sweep, forces: &[(usize, S::Vector)]| -> f64 {
            let product = |(node, f): &(usize, S::Vector)| -> f64 {
                let pairs = f.as_ref().iter().zip(mode[*node].as_ref());
                pairs.map(|(f, m)| f * m).sum()
            };
            forces.iter().map(product).sum()
        };
        let rest = points.one_by_one(part, Purpose::Trial, u, power);
        let moved = points.one_by_one(part, Purpose::Trial, &self.moved, power);
        let energy: Vec<f64> = rest.iter().zip(&moved).map(|(a, b)| a - b).collect();
        let most = energy.iter().fold(f64::MIN_POSITIVE, |a, e| a.max(*e));
        energy.iter().map(|e| e / most).collect()
    }

    /// The mode found last, and a share of what the search found.
    fn mix(&mut self) {
        let (found, known) = (largest_component(&self.mode), largest_component(&self.last));
        for (mode, last) in self.mode.iter_mut().zip(&self.last) {
            for (x, last) in mode.as_mut().iter_mut().zip(last.as_ref()) {
                *x = last / known + FOUND * *x / found;
            }
        }
    }

    /// One power iteration at displacements `u`, whose forces are in `rest`.
    fn iterate<const N: usize>(
        &mut self,
        points: &mut Points<S, N>,
        part: Part,
        u: &[S::Vector],
        recip_mass: &[S::Vector],
    ) -> f64 {
        let scale = 1.0 / largest_component(&self.mode);
        for ((moved, mode), u) in self.moved.iter_mut().zip(&mut self.mode).zip(u) {
            for (k, y) in moved.as_mut().iter_mut().enumerate() {
                mode.as_mut()[k] *= scale;
                *y = u.as_ref()[k] + PROBE * mode.as_ref()[k];
            }
        }
        points.sweep_part(part, Purpose::Trial, &self.moved, &mut self.force);
        self.advance(recip_mass)
    }

    /// `mode <- M^-1 K mode`; returns the growth of its length in the mass metric, an estimate of $\omega^2$.
    fn advance(&mut self, recip_mass: &[S::Vector]) -> f64 {
        let (mut new, mut old) = (0.0, 0.0);
        for (n, mode) in self.mode.iter_mut().enumerate() {
            for (k, x) in mode.as_mut().iter_mut().enumerate() {
                let w = recip_mass[n].as_ref()[k];
                let stiff = (self.rest[n].as_ref()[k] - self.force[n].as_ref()[k]) / PROBE;
                if w > 0.0 {
                    new += stiff * stiff * w;
                    old += *x * *x / w;
                }
                *x = stiff * w;
            }
        }
        (new / old).sqrt()
    }
}

/// A fixed irregular pattern of +-1, near the highest mode: no mode is orthogonal to it.
fn stir<S: Space>(mode: &mut [S::Vector]) {
    for (n, mode) in mode.iter_mut().enumerate() {
        for (k, x) in mode.as_mut().iter_mut().enumerate() {
            *x = if (n * 7 + k * 3) % 5 < 2 { 1.0 } else { -1.0 };
        }
    }
}

/// Largest absolute component of a field.
fn largest_component<V: AsRef<[f64]>>(field: &[V]) -> f64 {
    field
        .iter()
        .flat_map(|v| v.as_ref())
        .fold(f64::MIN_POSITIVE, |a, x| a.max(x.abs()))
}
