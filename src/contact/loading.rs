//! Loading curves of the fitted law, in units of the yield point: the trait, and the closed form.
//!
//! $w = \delta/\delta_y$ and $f = F/F_y$, so that Hertz is $f = w^{3/2}$ for every material.

use super::admissible::Inadmissible;

/// Loading curve $f(w)$: Hertz up to [`Loading::departure`], then softer, increasing and $C^1$ for every
/// admissible set of constants.
pub trait Loading: Clone + Send + Sync + std::fmt::Debug + 'static {
    /// Flattening $w_1$ up to which the curve is Hertz's and the contact stays elastic.
    fn departure(&self) -> f64;

    /// Force $f(w)$.
    fn force(&self, w: f64) -> f64;

    /// Slope $df/dw$.
    fn slope(&self, w: f64) -> f64;

    /// Force and slope at once, for what they share.
    #[inline]
    fn force_and_slope(&self, w: f64) -> (f64, f64) {
        (self.force(w), self.slope(w))
    }

    /// Work $\int_0^w f\ dw$.
    fn work(&self, w: f64) -> f64;

    /// Weighted work $\int_{from}^{to} f\ g\ dw$ for a `weight` g that is 1 up to the departure and smooth past it.
    fn weighted_work(&self, from: f64, to: f64, weight: impl Fn(f64) -> f64) -> f64;

    /// Work $\int_{from}^{to} f\ dw$.
    fn work_between(&self, from: f64, to: f64) -> f64 {
        self.work(to) - self.work(from)
    }

    /// Upper bounds of the exponent $d\ln f/d\ln w$ past the departure: `(w, bound)` means from `w` to the next
    /// entry's `w`, the last entry to infinity.
    fn exponent_bounds(&self) -> Vec<(f64, f64)>;
}

/// Hertz's loading curve, $w^{3/2}$.
#[inline]
#[must_use]
pub fn hertz(w: f64) -> f64 {
    w * w.sqrt()
}

/// Its work, $\tfrac25 w^{5/2}$.
#[inline]
#[must_use]
pub(crate) fn hertz_work(w: f64) -> f64 {
    0.4 * w * hertz(w)
}

/// Closed form of the loading curve: Hertz times a factor that falls with the logarithm of the flattening.
///
/// $$ f(w) = w^{3/2} \exp\left(-q \frac{L^3}{b^2 + L^2}\right), \quad L = \max\left(0, \ln\frac{w}{w_1}\right) $$
///
/// | symbol | field | unit | meaning |
/// |---|---|---|---|
/// | $w$ | | 1 | flattening over $\delta_y$ |
/// | $w_1$ | `departure` | 1 | flattening at which the curve leaves Hertz's |
/// | $b$ | `breadth` | 1 | breadth of the transition on the logarithmic axis |
/// | $q$ | `softening` | 1 | how far the exponent falls in the end |
///
/// With $v = (L/b)^2$ the exponent is $d\ln f/d\ln w = \tfrac32 - q\ v(3+v)/(1+v)^2$. The fraction lies in
/// $[0, 9/8]$ and tends to 1, so for $q < 4/3$ the curve increases, is never steeper than Hertz's
/// on logarithmic axes, and tends to the power $\tfrac32 - q$. It leaves Hertz's curve smoothly: $f$, $f'$ and
/// $f''$ are continuous at $w_1$.
///
/// Source: this work; chosen among nine forms of two to four constants for the lowest largest error with a
/// proof of monotony, on finite-element flattening at $E/Y = 80$ and on the curves of Kogut-Etsion and
/// Jackson-Green over four decades of $w$.
///
/// # Example
/// ```
/// use impactlaw::contact::loading::{Loading, SoftenedHertz};
/// let curve = SoftenedHertz::new(1.0, 10.0, 1.0)?;
/// assert_eq!(curve.force(0.25), 0.125); // Hertz
/// // L = ln(e) = 1: exp(1.5 - 1/101)
/// assert!((curve.force(1f64.exp()) - (1.5 - 1.0 / 101.0f64).exp()).abs() < 1e-14);
/// # Ok::<(), impactlaw::contact::admissible::Inadmissible>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoftenedHertz {
    departure: f64,
    breadth: f64,
    softening: f64,
}

/// Upper end of the admissible `softening`: beyond it the exponent $3/2 - 9q/8$ would become negative.
pub const SOFTENING_LIMIT: f64 = 4.0 / 3.0;

impl SoftenedHertz {
    /// Curve with $w_1$ = `departure`, $b$ = `breadth`, $q$ = `softening`.
    ///
    /// # Errors
    /// [`Inadmissible`] unless $w_1 > 0$, $b > 0$, $0 \le q < 4/3$, all finite.
    pub fn new(departure: f64, breadth: f64, softening: f64) -> Result<Self, Inadmissible> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let above_zero = "must be finite and above 0";
        Inadmissible::unless(positive(departure), "departure", departure, above_zero)?;
        Inadmissible::unless(positive(breadth), "breadth", breadth, above_zero)?;
        Inadmissible::unless(
            (0.0..SOFTENING_LIMIT).contains(&softening),
            "softening",
            softening,
            "must lie in [0, 4/3), or the force would fall with flattening",
        )?;
        Ok(SoftenedHertz {
            departure,
            breadth,
            softening,
        })
    }

    /// $b$, breadth of the transition.
    #[must_use]
    pub fn breadth(&self) -> f64 {
        self.breadth
    }

    /// $q$, fall of the exponent.
    #[must_use]
    pub fn softening(&self) -> f64 {
        self.softening
    }

    /// Exponent $d\ln f/d\ln w$ at `w`.
    #[must_use]
    pub fn exponent(&self, w: f64) -> f64 {
        if w <= self.departure {
            return 1.5;
        }
        let l = (w / self.departure).ln() / self.breadth;
        let v = l * l;
        1.5 - self.softening * v * (3.0 + v) / ((1.0 + v) * (1.0 + v))
    }
}

impl Loading for SoftenedHertz {
    fn departure(&self) -> f64 {
        self.departure
    }

    #[inline]
    fn force(&self, w: f64) -> f64 {
        if w <= self.departure {
            return hertz(w);
        }
        let l = (w / self.departure).ln();
        let l2 = l * l;
        hertz(w) * (-self.softening * l * l2 / (self.breadth * self.breadth + l2)).exp()
    }

    fn slope(&self, w: f64) -> f64 {
        if w <= self.departure {
            return 1.5 * w.sqrt();
        }
        self.exponent(w) * self.force(w) / w
    }

    #[inline]
    fn force_and_slope(&self, w: f64) -> (f64, f64) {
        let root = w.sqrt();
        if w <= self.departure {
            return (w * root, 1.5 * root);
        }
        let l = (w / self.departure).ln();
        let (l2, b2) = (l * l, self.breadth * self.breadth);
        let inverse = 1.0 / (b2 + l2);
        let force = w * root * (-self.softening * l * l2 * inverse).exp();
        let exponent = 1.5 - self.softening * l2 * (3.0 * b2 + l2) * inverse * inverse;
        (force, exponent * force / w)
    }

    /// Gauss-Legendre quadrature with five nodes on panels that halve in $\sqrt w$; relative error below 1e-5 for
    /// $b \ge 1$, and less the broader the transition.
    fn work(&self, w: f64) -> f64 {
        self.weighted_work(0.0, w, |_| 1.0)
    }

    fn work_between(&self, from: f64, to: f64) -> f64 {
        self.weighted_work(from, to, |_| 1.0)
    }

    fn weighted_work(&self, from: f64, to: f64, g: impl Fn(f64) -> f64) -> f64 {
        if to < from {
            return -self.weighted_work(to, from, g);
        }
        let elastic = hertz_work(to.min(self.departure)) - hertz_work(from.min(self.departure));
        elastic + work_between(self.departure.max(from), to, |w| self.force(w) * g(w))
    }

    fn exponent_bounds(&self) -> Vec<(f64, f64)> {
        vec![(self.departure, 1.5)]
    }
}

/// Integral of a smooth `force` from `start` to `end`; 0 if that is less: five Gauss-Legendre nodes on panels that halve in the
/// root of the flattening.
pub(crate) fn work_between(start: f64, end: f64, force: impl Fn(f64) -> f64) -> f64 {
    let start = start.sqrt();
    let mut sum = 0.0;
    let mut high = end.max(0.0).sqrt();
    while high > start {
        let low = (0.5 * high).max(start);
        let half = 0.5 * (high - low);
        for (node, weight) in GAUSS_5 {
            let s = low + half * (1.0 + node);
            sum += weight * half * 2.0 * s * force(s * s);
        }
        high = low;
    }
    sum
}

/// Nodes on [-1, 1] and weights of Gauss-Legendre quadrature of order ten (Abramowitz and Stegun, table 25.4).
pub(crate) const GAUSS_5: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
