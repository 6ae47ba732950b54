//! Pulse of a law: the figures of one impact from its curves by energy alone, fast enough for the inside of a fit.

use crate::contact::NormalLaw;
use crate::contact::elastoplastic::Elastoplastic;
use crate::contact::loading::{GAUSS_5, Loading};
use statrs::function::gamma::gamma;
use std::f64::consts::{FRAC_PI_2, PI};

/// Figures of an impact in yield units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Largest flattening.
    pub flattening: f64,
    /// Largest force.
    pub force: f64,
    /// Flattening at loss of contact.
    pub residual: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Contact time over $\sqrt{m\delta_y/F_y}$.
    pub time: f64,
}

/// Inertia of a law in yield units: $F_i/F_y = \beta E \sqrt{w - w_1}$ at kinetic energy E of a sphere, with
///
/// $$ \beta = \frac{3\kappa}{2\pi}\ x_y^{3/2}, $$
///
/// so that in loading $dE/dw = -f - \mu' E$, $\mu = \tfrac23\beta(w - w_1)^{3/2}$, and $d(e^\mu E)/dw = -e^\mu f$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Added {
    beta: f64,
    departure: f64,
}

impl Added {
    /// Inertia of `law`.
    #[must_use]
    pub fn of<L: Loading>(law: &Elastoplastic<L>) -> Self {
        let kappa = law.inertia().coefficient();
        Added {
            beta: 1.5 * kappa / PI * law.units().flattening.powf(1.5),
            departure: law.loading().departure(),
        }
    }

    fn is_none(&self) -> bool {
        self.beta == 0.0
    }

    /// Force at flattening `w` and kinetic `energy`.
    #[inline]
    #[must_use]
    pub fn force(&self, w: f64, energy: f64) -> f64 {
        self.beta * energy * (w - self.departure).max(0.0).sqrt()
    }

    /// Integrating factor $e^\mu$.
    fn factor(&self, w: f64) -> f64 {
        if self.is_none() {
            return 1.0;
        }
        let past = (w - self.departure).max(0.0);
        (self.beta * past * past.sqrt() / 1.5).exp()
    }
}

/// Newton steps allowed for the turning point.
const NEWTON_STEPS: usize = 60;
/// Relative step between rounded turning points that is as good as none.
const ROUNDING: f64 = 1e-8;
/// Panels of the loading time.
const PANELS: usize = 2;

/// First loading of an impact, in yield units: what the unloading has no part in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loaded {
    /// Incident energy.
    energy: f64,
    /// Largest flattening.
    flattening: f64,
    /// Force there, from which the branch unloads.
    turning: f64,
    /// Largest force, inertia included.
    force: f64,
    /// Time to the turning point.
    time: f64,
}

impl Loaded {
    /// Loading by `law` with incident `energy` ($\tfrac12 m V^2$ over $F_y\delta_y$); `guess` of the largest flattening.
    ///
    /// The turning point solves $\int_0^{w_m} e^\mu f\ dw = E$ ([`Added`]); `None` if it is not found.
    pub fn of<L: Loading>(law: &Elastoplastic<L>, energy: f64, guess: f64) -> Option<Self> {
        let loading = law.loading();
        let added = Added::of(law);
        let flattening = turning_point(loading, &added, energy, guess)?;
        let turning = loading.force(flattening);
        let press = press(loading, &added, flattening);
        Some(Loaded {
            energy,
            flattening,
            turning,
            force: press.force.max(turning),
            time: press.time,
        })
    }

    /// The impact, with the unloading of `law`.
    ///
    /// The branch gives back $E_r = f_m (w_m - w_r)/(n + 1)$, so $e^2 = E_r/E$, in the time
    /// $\frac{w_m - w_r}{v_r} \sqrt\pi\ \Gamma(1 + 1/p)/\Gamma(1/2 + 1/p)$ with $p = n + 1$ and $v_r = \sqrt{2E_r}$.
    pub fn released<L: Loading>(&self, law: &Elastoplastic<L>) -> Pulse {
        let w_m = self.flattening;
        let (rho, n) = law.branch(w_m);
        let span = w_m * (1.0 - rho);
        let returned = self.turning * span / (n + 1.0);
        let p = n + 1.0;
        let back = span / (2.0 * returned).sqrt() * PI.sqrt() * gamma(1.0 + 1.0 / p)
            / gamma(0.5 + 1.0 / p);
        Pulse {
            flattening: w_m,
            force: self.force,
            residual: rho * w_m,
            restitution: (returned / self.energy).sqrt(),
            time: self.time + back,
        }
    }
}

impl Pulse {
    /// Impact of `law`: its loading ([`Loaded::of`]), then its unloading. `None` if no turning point is found.
    pub fn of<L: Loading>(law: &Elastoplastic<L>, energy: f64, guess: f64) -> Option<Self> {
        Some(Loaded::of(law, energy, guess)?.released(law))
    }
}

/// Newton's method for the turning point. The work is summed from step to step, for steps soon are short.
fn turning_point<L: Loading>(loading: &L, added: &Added, energy: f64, guess: f64) -> Option<f64> {
    let work = |from: f64, to: f64| match added.is_none() {
        true => loading.work_between(from, to),
        false => loading.weighted_work(from, to, |w| added.factor(w)),
    };
    let mut w = guess;
    let mut done = work(0.0, w);
    let mut last = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let step = (done - energy) / (loading.force(w) * added.factor(w));
        let next = (w - step).clamp(0.3 * w, 4.0 * w);
        if !next.is_finite() {
            return None;
        }
        last = (next - w).abs() / w;
        if last <= 1e-13 {
            return Some(next);
        }
        done += work(w, next);
        w = next;
    }
    // sums over panels are not smooth to the last digits, between which steps may go to and fro
    (last <= ROUNDING).then_some(w)
}

/// What loading takes and reaches.
struct Press {
    /// Its time.
    time: f64,
    /// Its largest force at a node, inertia included; the turning point is not one.
    force: f64,
}

/// $\int_0^{w_m} dw/\sqrt{2E}$ with $w = w_m\cos^2\theta$, which takes away the singularity at the turn. The energy left
/// is summed from node to node, starting at the turn.
fn press<L: Loading>(loading: &L, added: &Added, w_m: f64) -> Press {
    let half = 0.5 * FRAC_PI_2 / PANELS as f64;
    let (mut time, mut most, mut left, mut above) = (0.0, 0.0f64, 0.0, w_m);
    for panel in 0..PANELS {
        for (node, weight) in GAUSS_5 {
            let theta = half * (2.0 * panel as f64 + 1.0 + node);
            let w = w_m * theta.cos().powi(2);
            let step = 0.5 * (above - w);
            let work = |(node, weight): &(f64, f64)| {
                let at = w + step * (1.0 + node);
                weight * loading.force(at) * added.factor(at)
            };
            left += step * GAUSS_5.iter().map(work).sum::<f64>();
            above = w;
            let energy = left / added.factor(w);
            time += weight * half * w_m * (2.0 * theta).sin() / (2.0 * energy).sqrt();
            most = most.max(loading.force(w) + added.force(w, energy));
        }
    }
    Press { time, force: most }
}
