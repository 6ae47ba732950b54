//! Forms of the fitted law: how free numbers become admissible constants, for the closed form and for the spline.

use super::run::Run;
use crate::contact::elastoplastic::{ClosedForm, Elastoplastic, YieldUnits};
use crate::contact::loading::{Loading, SOFTENING_LIMIT, SoftenedHertz};
use crate::contact::spline::{Knot, SplineLoading};
use crate::contact::unloading::{EXPONENT_LIMIT, Unloading};

/// A form that can be fitted: a map from free numbers to a loading curve and its unloading.
///
/// The first numbers are those of the loading curve, the last [`UNLOADING`] those of the unloading. Where the form has an
/// inertia term, the logarithm of its coefficient stands between them.
pub trait Form: Sync {
    /// Loading curve of this form.
    type Curve: Loading;

    /// Numbers to start from; also what numbers that the runs do not determine are held near.
    fn start(&self) -> Vec<f64>;

    /// Distance of each number from its start that costs as much as one figure that is off by its tolerance.
    fn spread(&self) -> Vec<f64>;

    /// Loading curve from the free numbers; `None` where they are not admissible.
    fn curve(&self, free: &[f64]) -> Option<Self::Curve>;

    /// Yield point of the material, the units of the law.
    fn units(&self) -> YieldUnits;

    /// Density of the body (kg/m3), if the form has an inertia term.
    fn density(&self) -> Option<f64>;

    /// Law from the free numbers, valid to flattening `valid_to` over R; `None` where it is not admissible.
    fn law(&self, free: &[f64], valid_to: f64) -> Option<Elastoplastic<Self::Curve>> {
        let unloading = unloading(&free[free.len() - UNLOADING..])?;
        let law = Elastoplastic::new(self.curve(free)?, unloading, self.units(), valid_to).ok()?;
        match self.density() {
            None => Some(law),
            Some(density) => {
                let coefficient = free[free.len() - UNLOADING - 1].exp();
                law.with_inertia(coefficient, density).ok()
            }
        }
    }

    /// Constants of the loading curve that a reader sees.
    fn constants(curve: &Self::Curve) -> Vec<f64>;

    /// Departures from smoothness that the form wants kept small (residuals).
    fn roughness(&self, free: &[f64]) -> Vec<f64>;
}

/// Free numbers of the unloading.
pub const UNLOADING: usize = 4;

/// Unloading from its free numbers: logarithms of $c$, $k$, $n_1 + \tfrac12$, $n_2$.
#[must_use]
pub fn unloading(free: &[f64]) -> Option<Unloading> {
    let [c, k, above, n_2] = [0, 1, 2, 3].map(|i| free[i].exp());
    Unloading::new(c, k, EXPONENT_LIMIT + above, n_2).ok()
}

/// Residual of Jackson, Green and Marghitu 2010, $c = 6.9$, $k = 0.54$; exponents as in [`Unloading`].
fn unloading_start() -> [f64; UNLOADING] {
    [6.9f64.ln(), 0.54f64.ln(), 0.4f64.ln(), 7.5f64.ln()]
}

/// Spread of the unloading numbers: a factor of about 1.6 in each constant.
const UNLOADING_SPREAD: f64 = 0.5;
/// Spread of a number that is held at its start.
const HELD: f64 = 1e-6;

/// Spreads of the unloading numbers for a fit to `runs` impacts. Each impact has one residual and one exponent of unloading: one
/// impact determines c and n_1, and k and n_2, which say how these grow with the flattening, are held where they start.
fn unloading_spread(runs: usize) -> [f64; UNLOADING] {
    match runs {
        0 | 1 => [UNLOADING_SPREAD, HELD, UNLOADING_SPREAD, HELD],
        _ => [UNLOADING_SPREAD; UNLOADING],
    }
}

/// Logarithm of the inertia coefficient to start from: that of a flat disc in an ideal fluid, $3\sqrt2 \cdot 4/3$
/// ([`Inertia`](crate::contact::inertia::Inertia)).
fn inertia_start() -> f64 {
    (4.0 * 2f64.sqrt()).ln()
}

/// Its spread, the same factor as for the unloading.
const INERTIA_SPREAD: f64 = 0.5;

/// Closed form: logarithms of $w_1$ and $b$, logit of $q$ over its limit.
#[derive(Debug, Clone, Copy)]
pub struct ClosedFormFit {
    /// Yield point of the material.
    pub units: YieldUnits,
    /// Density of the body (kg/m3), if the law is to have an inertia term.
    pub density: Option<f64>,
    /// Impacts it is fitted to.
    pub runs: usize,
}

/// Middle of the closed form's fits to four curves (quasi-static finite elements at $E/Y = 80$, Kogut-Etsion,
/// Jackson-Green at two materials): $w_1$, $b$, and $q$ over its limit.
const CLOSED_START: [f64; 3] = [0.33, 13.5, 0.75];
/// Their scatter, in the free numbers.
const CLOSED_SPREAD: [f64; 3] = [0.4, 0.25, 1.0];

impl Form for ClosedFormFit {
    type Curve = SoftenedHertz;

    fn start(&self) -> Vec<f64> {
        let [w_1, b, q] = CLOSED_START;
        let mut free = vec![w_1.ln(), b.ln(), (q / (1.0 - q)).ln()];
        free.extend(self.density.map(|_| inertia_start()));
        free.extend(unloading_start());
        free
    }

    fn spread(&self) -> Vec<f64> {
        let inertia = self.density.map(|_| INERTIA_SPREAD);
        let unloading = unloading_spread(self.runs);
        let loading = CLOSED_SPREAD.into_iter().chain(inertia);
        loading.chain(unloading).collect()
    }

    fn curve(&self, free: &[f64]) -> Option<SoftenedHertz> {
        let softening = SOFTENING_LIMIT / (1.0 + (-free[2]).exp());
        SoftenedHertz::new(free[0].exp(), free[1].exp(), softening).ok()
    }

    fn units(&self) -> YieldUnits {
        self.units
    }

    fn density(&self) -> Option<f64> {
        self.density
    }

    fn constants(curve: &SoftenedHertz) -> Vec<f64> {
        vec![curve.departure(), curve.breadth(), curve.softening()]
    }

    fn roughness(&self, _: &[f64]) -> Vec<f64> {
        Vec::new()
    }
}

/// Spline: logarithms of the mean exponents between knots at fixed flattenings.
#[derive(Debug, Clone)]
pub struct SplineFit {
    units: YieldUnits,
    density: Option<f64>,
    runs: usize,
    hertz_to: f64,
    flattenings: Vec<f64>,
    start: Vec<f64>,
}

/// Ratio of neighbouring knots' flattenings that is aimed at.
const KNOT_RATIO: f64 = 3.0;
/// Fewest and most knots past the departure.
const KNOTS: (usize, usize) = (1, 12);
/// Fall below Hertz at which the closed form counts as departed, and the spline starts.
const DEPARTED: f64 = 0.01;
/// Latest start of the spline over the largest flattening of the runs, for runs just above the yield speed.
const LATEST_DEPARTURE: f64 = 0.9;
/// Distance of an exponent from that of the closed form, as a fraction, that costs as much as a figure that is off by
/// its tolerance.
const EXPONENT_SPREAD: f64 = 0.05;
/// Change of slope of the exponent from knot to knot that costs as much as a figure that is off by its tolerance.
const EXPONENT_BEND: f64 = 0.1;

impl SplineFit {
    /// Spline over the range of `runs`, started from the `closed` form's `law` and its free numbers.
    #[must_use]
    pub fn new(law: &ClosedForm, closed: &ClosedFormFit, free: &[f64], runs: &[Run]) -> Self {
        let curve = law.loading();
        let top = runs.iter().map(|r| r.max_flattening).fold(0.0, f64::max);
        let latest = departed(curve).min(LATEST_DEPARTURE * top);
        // up to its start a spline is elastic: one of these impacts would keep nothing of what it lost
        let between = |r: &Run| r.max_flattening > curve.departure() && r.max_flattening <= latest;
        let hertz_to = match runs.iter().any(between) {
            true => curve.departure(),
            false => latest,
        };
        let decades = (top / hertz_to).ln() / KNOT_RATIO.ln();
        let count = (decades.ceil() as usize).clamp(KNOTS.0, KNOTS.1);
        let step = (top / hertz_to).powf(1.0 / count as f64);
        let flattenings: Vec<f64> = (1..=count)
            .map(|k| hertz_to * step.powi(k as i32))
            .collect();
        let mut low = (hertz_to, hertz_to.powf(1.5));
        let mut start = Vec::new();
        for w in &flattenings {
            let high = (*w, curve.force(*w));
            start.push(((high.1 / low.1).ln() / (high.0 / low.0).ln()).ln());
            low = high;
        }
        let others = UNLOADING + usize::from(closed.density.is_some());
        start.extend_from_slice(&free[free.len() - others..]);
        SplineFit {
            units: closed.units,
            density: closed.density,
            runs: runs.len(),
            hertz_to,
            flattenings,
            start,
        }
    }
}

/// Flattening at which the closed form has fallen [`DEPARTED`] below Hertz, by bisection in the logarithm.
fn departed(curve: &SoftenedHertz) -> f64 {
    let hertz = crate::contact::loading::hertz;
    let fallen = |w: f64| curve.force(w) < (1.0 - DEPARTED) * hertz(w);
    let (mut low, mut high) = (curve.departure(), curve.departure() * 1e6);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if fallen(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}

/// Exponent at knot `k`: the mean of the intervals beside it; at the last knot extrapolated, to no less than half.
fn knot_exponent(intervals: &[f64], k: usize) -> f64 {
    let before = intervals[k - 1];
    match (intervals.get(k), k) {
        (Some(after), _) => 0.5 * (before + after),
        (None, 1) => before,
        (None, _) => (1.5 * before - 0.5 * intervals[k - 2]).max(0.5 * before),
    }
}

/// Slope in $s = \sqrt w$ at the first knot, moved as little as the interval that leaves Hertz's curve needs to have no
/// exponent above 3/2.
///
/// With the interval $[s_0, s_1]$ of length h, Hertz at $s_0$ and force f at $s_1$, no Bernstein coefficient of
/// $3f - sf'$ is negative if $\frac{3}{h}(f - s_0^3 - 2hs_0^2 - h^2s_0) \le f' \le
/// \min\left(\frac{9f - 6s_0s_1^2}{s_0 + 3h}, \frac{3f}{s_1}\right)$, which leaves room wherever f is not above Hertz.
fn below_hertz([s_0, s_1]: [f64; 2], f: f64, slope: f64) -> f64 {
    let h = s_1 - s_0;
    let least = 3.0 / h * (f - s_0.powi(3) - 2.0 * h * s_0 * s_0 - h * h * s_0);
    let most = (9.0 * f - 6.0 * s_0 * s_1 * s_1) / (s_0 + 3.0 * h);
    slope.min(most).min(3.0 * f / s_1).max(least)
}

/// Share of the steepest monotone slope that is used, so that rounding does not carry a slope beyond it.
const WITHIN: f64 = 1.0 - 1e-12;

/// Spline from Hertz's curve at `hertz_to` through knots at `flattenings`, between which the force rises with the mean `exponents`;
/// slopes follow `knot_exponent` and are kept within the box that makes the spline monotone. `None` where it is not admissible.
#[must_use]
pub fn through(hertz_to: f64, flattenings: &[f64], exponents: &[f64]) -> Option<SplineLoading> {
    let mut forces = vec![hertz_to.powf(1.5)];
    let mut low = hertz_to;
    for (w, e) in flattenings.iter().zip(exponents) {
        forces.push(forces[forces.len() - 1] * (w / low).powf(*e));
        low = *w;
    }
    let start = std::iter::once(hertz_to);
    let w: Vec<f64> = start.chain(flattenings.iter().copied()).collect();
    let s: Vec<f64> = w.iter().map(|w| w.sqrt()).collect();
    let secant = |k: usize| (forces[k] - forces[k - 1]) / (s[k] - s[k - 1]);
    let knot = |k: usize| {
        let mut slope = 2.0 * knot_exponent(exponents, k) * forces[k] / s[k];
        if k == 1 {
            slope = below_hertz([s[0], s[1]], forces[1], slope);
        }
        let after = if k + 1 < w.len() {
            secant(k + 1)
        } else {
            f64::INFINITY
        };
        Knot {
            flattening: w[k],
            force: forces[k],
            slope: slope.min(WITHIN * 3.0 * secant(k).min(after)) / (2.0 * s[k]),
        }
    };
    let knots: Vec<Knot> = (1..w.len()).map(knot).collect();
    SplineLoading::new(hertz_to, &knots).ok()
}

impl Form for SplineFit {
    type Curve = SplineLoading;

    fn start(&self) -> Vec<f64> {
        self.start.clone()
    }

    fn spread(&self) -> Vec<f64> {
        let unloading = unloading_spread(self.runs);
        let exponents = std::iter::repeat_n(EXPONENT_SPREAD, self.flattenings.len());
        let inertia = self.density.map(|_| INERTIA_SPREAD);
        exponents.chain(inertia).chain(unloading).collect()
    }

    fn curve(&self, free: &[f64]) -> Option<SplineLoading> {
        let exponents = free[..self.flattenings.len()].iter().map(|t| t.exp());
        let exponents: Vec<f64> = exponents.collect();
        through(self.hertz_to, &self.flattenings, &exponents)
    }

    fn units(&self) -> YieldUnits {
        self.units
    }

    fn density(&self) -> Option<f64> {
        self.density
    }

    fn constants(curve: &SplineLoading) -> Vec<f64> {
        curve.knots().iter().map(|k| k.force).collect()
    }

    fn roughness(&self, free: &[f64]) -> Vec<f64> {
        let exponents = free[..self.flattenings.len()].iter().map(|t| t.exp());
        let all: Vec<f64> = std::iter::once(1.5).chain(exponents).collect();
        all.windows(3)
            .map(|e| (e[0] - 2.0 * e[1] + e[2]) / EXPONENT_BEND)
            .collect()
    }
}
