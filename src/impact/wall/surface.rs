//! Patch: contact of a three-dimensional body with the wall, without or with Coulomb friction.
//!
//! Normal impulses solve the same complementarity as in `super::meridian`. Masses are lumped, so W couples equal
//! components only, and the problem splits exactly: normal impulses first, then the tangential ones, which minimise
//!
//! $$ \tfrac12 \sum_{cd} \lambda_c \cdot W_{cd} \lambda_d + \sum_c b_c \cdot \lambda_c, \qquad |\lambda_c| \le \mu \lambda^n_c $$
//!
//! with the sliding velocities $b_c$: where the bound is not reached the point sticks, elsewhere it slides against the
//! impulse. The bound takes the normal force of a point with a short memory, $\dot s = (F - s)/\tau$ (Prakash and Clifton
//! 1993; Ranjith and Rice 2001): with the instantaneous force, sliding of an elastic body on a rigid one is ill-posed. Slip
//! waves then grow the faster the shorter they are, until points stick that should slide, and smaller cells make it worse.
//!
//! $\tau$ is a fixed share of the contact time ([`MEMORY`]), not a number of cells: the limit of small cells exists, and
//! its distance from Coulomb's law is of the order of $\tau$ over the contact time. Both problems are convex and are solved
//! by projected Gauss-Seidel in alternating directions, warm-started from the last step. One point a cell keeps W well
//! conditioned; a few sweeps of some 25 entries a point suffice.

use super::meridian::{Touch, Wall};
use crate::space::Solid;
use crate::tape::keep_fields;

/// Sweeps after which the remaining violation is accepted and reported.
const MOST_SWEEPS: usize = 200;

/// Memory of friction for the normal force as a share of the expected contact time.
///
/// In full sliding (nu 0.2, 0.35, 0.45; mu 0.1, 0.3, 0.5) the friction impulse lacks 0.05 % of mu times the normal impulse
/// with a share of 0.004, 0.12 % with 0.008 and 0.36 % with 0.016, whatever the cells. Slip waves took part of it, the more
/// the smaller the cells, where mu over the share came above 200: at this share that is mu = 1.6.
pub const MEMORY: f64 = 0.008;

/// Friction law of the wall.
pub trait Friction: Copy + Send + Sync + 'static {
    /// Whether there is any: what is off costs nothing.
    const ON: bool;
    /// Coefficient mu.
    fn coefficient(&self) -> f64;
    /// Time over which it follows the normal force.
    fn memory(&self) -> f64;
}

/// No friction.
#[derive(Debug, Clone, Copy)]
pub struct Frictionless;

/// Coulomb friction with one coefficient, following the normal force after a short time.
#[derive(Debug, Clone, Copy)]
pub struct Coulomb {
    /// Coefficient mu.
    pub coefficient: f64,
    /// Time tau.
    pub memory: f64,
}

impl Friction for Frictionless {
    const ON: bool = false;
    fn coefficient(&self) -> f64 {
        0.0
    }
    fn memory(&self) -> f64 {
        0.0
    }
}

impl Friction for Coulomb {
    const ON: bool = true;
    fn coefficient(&self) -> f64 {
        self.coefficient
    }
    fn memory(&self) -> f64 {
        self.memory
    }
}

/// Surface points and their impulses; `F` is the friction of the wall.
#[derive(Debug, Clone)]
pub struct Patch<F: Friction, const N: usize> {
    friction: F,
    offsets: [usize; N],
    nodes: Vec<usize>,
    values: Vec<[f64; N]>,
    places: Vec<[f64; 3]>,
    /// Rows of W: entries `starts[c]..starts[c + 1]`.
    starts: Vec<usize>,
    columns: Vec<u32>,
    normal: Vec<f64>,
    /// Entries of W in x and y; empty without friction.
    tangential: Vec<[f64; 2]>,
    diagonal: Vec<[f64; 3]>,
    /// Gap rates (and sliding velocities) without impulses, and impulses.
    free: Vec<[f64; 3]>,
    impulses: Vec<[f64; 3]>,
    /// Normal forces with the memory of the friction; zero without friction.
    remembered: Vec<f64>,
    candidates: Vec<u32>,
    time: f64,
    tolerance: f64,
    sweeps: u64,
}

keep_fields!(impl [F: Friction, const N: usize] Patch<F, N>: free, impulses, remembered, candidates, time, sweeps;
    rebuilt friction, offsets, nodes, values, places, starts, columns, normal, tangential, diagonal, tolerance);

impl<F: Friction, const N: usize> Patch<F, N> {
    /// No points yet; `tolerance` is the speed below which a violation counts as solved.
    #[must_use]
    pub fn new(friction: F, offsets: [usize; N], tolerance: f64) -> Self {
        Patch {
            friction,
            offsets,
            nodes: Vec::new(),
            values: Vec::new(),
            places: Vec::new(),
            starts: vec![0],
            columns: Vec::new(),
            normal: Vec::new(),
            tangential: Vec::new(),
            diagonal: Vec::new(),
            free: Vec::new(),
            impulses: Vec::new(),
            remembered: Vec::new(),
            candidates: Vec::new(),
            time: 0.0,
            tolerance,
            sweeps: 0,
        }
    }

    /// Add a surface point: first node, basis values, reference position.
    pub fn push(&mut self, node: usize, values: [f64; N], place: [f64; 3]) {
        self.nodes.push(node);
        self.values.push(values);
        self.places.push(place);
        self.free.push([0.0; 3]);
        self.impulses.push([0.0; 3]);
        self.remembered.push(0.0);
    }

    /// Surface points.
    #[must_use]
    pub fn count(&self) -> usize {
        self.nodes.len()
    }

    /// Gauss-Seidel sweeps so far.
    #[must_use]
    pub fn sweeps(&self) -> u64 {
        self.sweeps
    }

    /// Compute the coupling W from the nodes' reciprocal masses; call once all points are there.
    pub fn couple(&mut self, recip_mass: &[[f64; 3]]) {
        let mut users: Vec<Vec<(u32, f64)>> = vec![Vec::new(); recip_mass.len()];
        for (c, (node, values)) in self.nodes.iter().zip(&self.values).enumerate() {
            for (offset, value) in self.offsets.iter().zip(values) {
                if *value > 0.0 {
                    users[node + offset].push((c as u32, *value));
                }
            }
        }
        let mut sums = vec![[0.0; 3]; self.count()];
        for c in 0..self.count() {
            let mut row: Vec<u32> = Vec::new();
            for (offset, value) in self.offsets.iter().zip(&self.values[c]) {
                let node = self.nodes[c] + offset;
                for &(d, other) in users[node].iter().filter(|_| *value > 0.0) {
                    row.push(d);
                    for (sum, w) in sums[d as usize].iter_mut().zip(&recip_mass[node]) {
                        *sum += value * other * w;
                    }
                }
            }
            row.sort_unstable();
            row.dedup();
            for d in row {
                let [x, y, z] = std::mem::take(&mut sums[d as usize]);
                self.columns.push(d);
                self.normal.push(z);
                if F::ON {
                    self.tangential.push([x, y]);
                }
                if d as usize == c {
                    self.diagonal.push([x, y, z]);
                }
            }
            self.starts.push(self.columns.len());
        }
    }

    /// Component `axis` of a nodal field at point `c`.
    #[inline(always)]
    fn at(&self, c: usize, field: &[[f64; 3]], axis: usize) -> f64 {
        let node = self.nodes[c];
        let terms = self.offsets.iter().zip(&self.values[c]);
        terms
            .map(|(offset, value)| value * field[node + offset][axis])
            .sum()
    }

    /// Sweep `update` over the candidates, forth and back, until its largest correction is below the tolerance.
    fn relax(&mut self, update: impl Fn(&mut Self, usize) -> f64) -> f64 {
        let candidates = std::mem::take(&mut self.candidates);
        let mut worst = 0.0f64;
        for sweep in 0..MOST_SWEEPS {
            worst = 0.0;
            for k in 0..candidates.len() {
                let forth = if sweep % 2 == 0 {
                    k
                } else {
                    candidates.len() - 1 - k
                };
                worst = worst.max(update(self, candidates[forth] as usize));
            }
            self.sweeps += 1;
            if worst < self.tolerance {
                break;
            }
        }
        self.candidates = candidates;
        worst
    }

    /// Gap rate of point `c` brought to zero, or its impulse to zero; returns the correction as a speed.
    #[inline(always)]
    fn press(&mut self, c: usize) -> f64 {
        let mut speed = self.free[c][2];
        for k in self.starts[c]..self.starts[c + 1] {
            speed += self.normal[k] * self.impulses[self.columns[k] as usize][2];
        }
        let stiff = self.diagonal[c][2];
        let old = self.impulses[c][2];
        let new = (old - speed / stiff).max(0.0);
        self.impulses[c][2] = new;
        ((new - old) * stiff).abs()
    }

    /// Sliding of point `c` stopped as far as the bound allows; returns the correction as a speed.
    #[inline(always)]
    fn rub(&mut self, c: usize) -> f64 {
        let bound = self.friction.coefficient() * self.remembered[c] * self.time;
        let old = self.impulses[c];
        if bound == 0.0 && old[0] == 0.0 && old[1] == 0.0 {
            return 0.0;
        }
        let [mut x, mut y, _] = self.free[c];
        for k in self.starts[c]..self.starts[c + 1] {
            let other = &self.impulses[self.columns[k] as usize];
            x += self.tangential[k][0] * other[0];
            y += self.tangential[k][1] * other[1];
        }
        let stiff = self.diagonal[c][0].max(self.diagonal[c][1]);
        let (x, y) = (old[0] - x / stiff, old[1] - y / stiff);
        let length = (x * x + y * y).sqrt();
        let keep = if length > bound { bound / length } else { 1.0 };
        self.impulses[c][0] = x * keep;
        self.impulses[c][1] = y * keep;
        let (dx, dy) = (x * keep - old[0], y * keep - old[1]);
        (dx * dx + dy * dy).sqrt() * stiff
    }

    /// Let the remembered normal forces follow the present ones; out of contact they are forgotten.
    fn remember(&mut self, dt: f64) {
        let share = dt / (dt + self.friction.memory());
        for &c in &self.candidates {
            let force = self.impulses[c as usize][2] / dt;
            let remembered = &mut self.remembered[c as usize];
            *remembered = if force > 0.0 {
                *remembered + share * (force - *remembered)
            } else {
                0.0
            };
        }
    }

    /// Free gap rates and sliding velocities of the candidates, warm-started impulses; whether any point would touch.
    fn prepare(&mut self, dt: f64, u: &[[f64; 3]], v: &[[f64; 3]]) -> bool {
        let ratio = if self.time > 0.0 { dt / self.time } else { 1.0 };
        self.time = dt;
        let mut any = false;
        for k in 0..self.candidates.len() {
            let c = self.candidates[k] as usize;
            let gap = self.places[c][2] + self.at(c, u, 2);
            let free = gap / dt + self.at(c, v, 2);
            any |= free < 0.0;
            self.free[c] = if F::ON {
                [self.at(c, v, 0), self.at(c, v, 1), free]
            } else {
                [0.0, 0.0, free]
            };
            for impulse in &mut self.impulses[c] {
                *impulse *= ratio;
            }
        }
        any
    }

    /// Axes along which impulses act.
    const AXES: &'static [usize] = if F::ON { &[0, 1, 2] } else { &[2] };

    /// Give the impulses to the nodes; sum impulse, work and extent of the step.
    fn apply(
        &self,
        u: &[[f64; 3]],
        old: &[[f64; 3]],
        v: &mut [[f64; 3]],
        recip_mass: &[[f64; 3]],
        touch: &mut Touch,
    ) {
        let pressed = || {
            let all = self.candidates.iter().map(|c| *c as usize);
            all.filter(|c| self.impulses[*c][2] > 0.0)
        };
        for c in pressed() {
            let impulse = &self.impulses[c];
            for (offset, value) in self.offsets.iter().zip(&self.values[c]) {
                let n = self.nodes[c] + offset;
                for &k in Self::AXES {
                    v[n][k] += value * impulse[k] * recip_mass[n][k];
                }
            }
            touch.impulse += impulse[2];
            touch.tangential += impulse[0];
            let [x, y] = [0, 1].map(|k| self.places[c][k] + self.at(c, u, k));
            touch.radius = touch.radius.max((x * x + y * y).sqrt());
        }
        for c in pressed() {
            for &k in Self::AXES {
                let speeds = self.at(c, old, k) + self.at(c, v, k);
                touch.work += 0.5 * self.impulses[c][k] * speeds;
            }
        }
    }
}

impl<F: Friction, const N: usize> Wall<Solid> for Patch<F, N> {
    fn refresh(&mut self, u: &[[f64; 3]], speed: f64, horizon: f64, among: &dyn Fn(usize) -> bool) {
        self.candidates.clear();
        for c in 0..self.count() {
            let gap = self.places[c][2] + self.at(c, u, 2);
            let near = gap < speed * horizon || self.impulses[c][2] > 0.0;
            let node = self.nodes[c];
            if near && self.offsets.iter().any(|offset| among(node + offset)) {
                self.candidates.push(c as u32);
            }
        }
    }

    fn solve(
        &mut self,
        dt: f64,
        u: &[[f64; 3]],
        old: &[[f64; 3]],
        v: &mut [[f64; 3]],
        recip_mass: &[[f64; 3]],
    ) -> Touch {
        let mut touch = Touch::default();
        if !self.prepare(dt, u, v) {
            for &c in &self.candidates {
                self.impulses[c as usize] = [0.0; 3];
                self.remembered[c as usize] = 0.0;
            }
            return touch;
        }
        touch.residual = self.relax(Self::press);
        if F::ON {
            self.remember(dt);
            touch.residual = touch.residual.max(self.relax(Self::rub));
        }
        self.apply(u, old, v, recip_mass, &mut touch);
        touch
    }

    fn outline(&self, u: &[[f64; 3]]) -> Vec<(f64, f64)> {
        let least = self
            .places
            .iter()
            .map(|p| p[1])
            .fold(f64::INFINITY, f64::min);
        let mut outline: Vec<(f64, f64)> = (0..self.count())
            .filter(|c| self.places[*c][1] <= 1.001 * least)
            .map(|c| {
                (
                    self.places[c][0] + self.at(c, u, 0),
                    self.places[c][2] + self.at(c, u, 2),
                )
            })
            .collect();
        outline.sort_by(|a, b| a.0.total_cmp(&b.0));
        outline
    }
}
