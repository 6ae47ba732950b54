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

impl Pulse {
    /// Impact of `law` with incident `energy` ($\tfrac12 m V^2$ over $F_y\delta_y$); `guess` of the largest flattening.
    ///
    /// The turning point solves $\int_0^{w_m} e^\mu f\ dw = E$ ([`Added`]). The branch gives back
    /// $E_r = f_m (w_m - w_r)/(n + 1)$, so $e^2 = E_r/E$, in the time
    /// $\frac{w_m - w_r}{v_r} \sqrt\pi\ \Gamma(1 + 1/p)/\Gamma(1/2 + 1/p)$ with $p = n + 1$ and $v_r = \sqrt{2E_r}$.
    /// `None` if no turning point is found.
    pub fn of<L: Loading>(law: &Elastoplastic<L>, energy: f64, guess: f64) -> Option<Self> {
        let loading = law.loading();
        let added = Added::of(law);
        let w_m = turning_point(loading, &added, energy, guess)?;
        let force = loading.force(w_m);
        let (rho, n) = law.branch(w_m);
        let span = w_m * (1.0 - rho);
        let returned = force * span / (n + 1.0);
        let p = n + 1.0;
        let back = span / (2.0 * returned).sqrt() * PI.sqrt() * gamma(1.0 + 1.0 / p)
            / gamma(0.5 + 1.0 / p);
        let press = press(loading, &added, w_m);
        Some(Pulse {
            flattening: w_m,
            force: press.force.max(force),
            residual: rho * w_m,
            restitution: (returned / energy).sqrt(),
            time: press.time + back,
        })
    }
}

fn turning_point<L: Loading>(loading: &L, added: &Added, energy: f64, guess: f64) -> Option<f64> {
    let work = |w: f64| match added.is_none() {
        true => loading.work(w),
        false => loading.weighted_work(w, |w| added.factor(w)),
    };
    let mut w = guess;
    let mut last = f64::INFINITY;
    for _ in 0..NEWTON_STEPS {
        let step = (work(w) - energy) / (loading.force(w) * added.factor(w));
        let next = (w - step).clamp(0.3 * w, 4.0 * w);
        if !next.is_finite() {
            return None;
        }
        last = (next - w).abs() / w;
        if last <= 1e-13 {
            return Some(next);
        }
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
