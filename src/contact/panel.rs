//! Panels of Gauss-Legendre collocation: adaptive integrals of a work and of the time that depends on it.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes of a panel: exact for polynomials of degree 15, at rounding level on smooth branches after few halvings.
const NODES: usize = 8;
/// Error accepted on a panel, relative to the scale of the branch.
const TOLERANCE: f64 = 1e-13;
/// Halvings after which a panel is taken as it is. A jump of the integrand inside it is then worth 2^-44 of the
/// branch.
const MAX_HALVINGS: u32 = 44;
/// Panels after which a branch is no longer refined, so that no law, however rough, keeps it for ever.
const MAX_PANELS: u32 = 4096;
/// Panels a branch starts with.
const FIRST_PANELS: u32 = 4;

/// Nodes on [0, 1] with weights, and the weights of the integrals from 0 to each node.
struct Collocation {
    node: [f64; NODES],
    weight: [f64; NODES],
    cumulative: [[f64; NODES]; NODES],
}

static COLLOCATION: LazyLock<Collocation> = LazyLock::new(Collocation::legendre);

/// Legendre polynomials $P_0 \dots P_n$ at `z`.
fn legendre(z: f64) -> [f64; NODES + 1] {
    let mut p = [1.0; NODES + 1];
    p[1] = z;
    for k in 1..NODES {
        let k_f = k as f64;
        p[k + 1] = ((2.0 * k_f + 1.0) * z * p[k] - k_f * p[k - 1]) / (k_f + 1.0);
    }
    p
}

impl Collocation {
    /// Roots of $P_n$ by Newton's method; the cumulative weights integrate the interpolating polynomial,
    ///
    /// $$ A_{ij} = \frac{w_j}{2} \Big[ z_i + 1 + \sum_{k=1}^{n-1} P_k(z_j) \big(P_{k+1}(z_i) - P_{k-1}(z_i)\big) \Big]. $$
    fn legendre() -> Self {
        let n = NODES as f64;
        let mut z = [0.0; NODES];
        let mut weight = [0.0; NODES];
        for i in 0..NODES {
            let mut root = -(PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let p = legendre(root);
                slope = n * (root * p[NODES] - p[NODES - 1]) / (root * root - 1.0);
                root -= p[NODES] / slope;
            }
            z[i] = root;
            weight[i] = 2.0 / ((1.0 - root * root) * slope * slope);
        }
        let p = z.map(legendre);
        let mut cumulative = [[0.0; NODES]; NODES];
        for i in 0..NODES {
            for j in 0..NODES {
                let series: f64 = (1..NODES)
                    .map(|k| p[j][k] * (p[i][k + 1] - p[i][k - 1]))
                    .sum();
                cumulative[i][j] = 0.25 * weight[j] * (z[i] + 1.0 + series);
            }
        }
        Self {
            node: z.map(|z| 0.5 * (z + 1.0)),
            weight: weight.map(|w| 0.5 * w),
            cumulative,
        }
    }
}

/// Work and time gathered over a piece of a branch.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Totals {
    /// Work over $R^3$, Pa.
    pub(crate) work: f64,
    /// Time in the units of the caller.
    pub(crate) time: f64,
}

impl Totals {
    fn plus(self, other: Self) -> Self {
        Self {
            work: self.work + other.work,
            time: self.time + other.time,
        }
    }
}

/// What is integrated over a coordinate `s`.
pub(crate) trait Integrand {
    /// Rate of work, dW/ds.
    fn work_rate(&self, s: f64) -> f64;
    /// Rate of time, dt/ds, once the work done up to `s` is known.
    fn time_rate(&self, s: f64, work: f64) -> f64;
}

/// One panel `[from, to]` of a branch on which `before` has been gathered already.
fn panel<I: Integrand>(integrand: &I, from: f64, to: f64, before: f64) -> Totals {
    let rule = &*COLLOCATION;
    let width = to - from;
    let s = rule.node.map(|node| from + width * node);
    let rate = s.map(|s| integrand.work_rate(s));
    let mut totals = Totals::default();
    for i in 0..NODES {
        let partial: f64 = (0..NODES).map(|j| rule.cumulative[i][j] * rate[j]).sum();
        let work = before + width * partial;
        totals.work += width * rule.weight[i] * rate[i];
        totals.time += width * rule.weight[i] * integrand.time_rate(s[i], work);
    }
    totals
}

/// Integrate over `[from, to]`, halving panels until work and time agree to `TOLERANCE` of `scale` with their
/// halves, and tell `observe` the coordinate and the totals at the end of every accepted panel. Ends always: panels
/// are halved at most `MAX_HALVINGS` times, at most `MAX_PANELS` are looked at, and what is not finite is not
/// refined.
pub(crate) fn accumulate<I: Integrand>(
    integrand: &I,
    (from, to): (f64, f64),
    scale: Totals,
    mut observe: impl FnMut(f64, Totals),
) -> Totals {
    let edge = |k: u32| from + (to - from) * f64::from(k) / f64::from(FIRST_PANELS);
    let mut totals = Totals::default();
    let mut panels = 0;
    for k in 0..FIRST_PANELS {
        let mut pending = vec![(edge(k), edge(k + 1), 0)];
        while let Some((left, right, halvings)) = pending.pop() {
            let middle = 0.5 * (left + right);
            let whole = panel(integrand, left, right, totals.work);
            let first = panel(integrand, left, middle, totals.work);
            let second = panel(integrand, middle, right, totals.work + first.work);
            let halves = first.plus(second);
            panels += 1;
            let far = (halves.work - whole.work).abs() > TOLERANCE * scale.work
                || (halves.time - whole.time).abs() > TOLERANCE * scale.time;
            if far && halvings < MAX_HALVINGS && panels < MAX_PANELS {
                pending.push((middle, right, halvings + 1));
                pending.push((left, middle, halvings + 1));
            } else {
                observe(middle, totals.plus(first));
                totals = totals.plus(halves);
                observe(right, totals);
            }
        }
    }
    totals
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Power(f64);

    impl Integrand for Power {
        fn work_rate(&self, s: f64) -> f64 {
            s.powf(self.0)
        }
        fn time_rate(&self, _: f64, work: f64) -> f64 {
            work
        }
    }

    #[test]
    fn powers_integrate_to_rounding_even_with_a_singular_end() {
        for n in [0.0, 1.0, 1.5, 7.0, 0.5] {
            let scale = Totals {
                work: 1.0,
                time: 1.0,
            };
            let got = accumulate(&Power(n), (0.0, 1.0), scale, |_, _| ());
            approx::assert_relative_eq!(got.work, 1.0 / (n + 1.0), max_relative = 1e-12);
            approx::assert_relative_eq!(
                got.time,
                1.0 / (n + 1.0) / (n + 2.0),
                max_relative = 1e-12
            );
        }
    }

    #[test]
    fn a_jump_costs_a_bounded_number_of_panels_and_is_exact() {
        struct Jump(std::cell::Cell<u32>);
        impl Integrand for Jump {
            fn work_rate(&self, s: f64) -> f64 {
                self.0.set(self.0.get() + 1);
                if s <= 0.3 { 1.0 } else { 2.0 }
            }
            fn time_rate(&self, _: f64, _: f64) -> f64 {
                0.0
            }
        }
        let jump = Jump(std::cell::Cell::new(0));
        let scale = Totals {
            work: 1.0,
            time: 1.0,
        };
        let got = accumulate(&jump, (0.0, 1.0), scale, |_, _| ());
        approx::assert_relative_eq!(got.work, 1.7, max_relative = 1e-12);
        assert!(jump.0.get() < 4000, "{} evaluations", jump.0.get());
    }
}
