//! Spline form of the loading curve: a monotone cubic through few knots, cheap to evaluate.

use super::admissible::Inadmissible;
use super::loading::{GAUSS_5, Loading, hertz, hertz_work};

/// Knot of a [`SplineLoading`], in yield units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Flattening $w = \delta/\delta_y$.
    pub flattening: f64,
    /// Force $f = F/F_y$.
    pub force: f64,
    /// Slope $df/dw$.
    pub slope: f64,
}

/// Monotone $C^1$ spline: Hertz up to $w_1$, then a cubic in $s = \sqrt w$ between knots, a straight line past the
/// last knot.
///
/// $$ f(w) = c_0 + c_1 t + c_2 t^2 + c_3 t^3, \quad t = \sqrt w - \sqrt{w_k}, \quad w_k \le w \le w_{k+1} $$
///
/// with the four coefficients of an interval from force and slope at its ends (Hermite). Hertz ($s^3$) and full
/// plasticity ($s^2$) are both cubics in $s$, so few knots go far and a call costs one square root. The force
/// increases between knots if the slopes in $s$ do not exceed three times the secants on either side (the box of
/// Fritsch and Carlson 1980, SIAM J. Numer. Anal. 17:238).
///
/// # Example
/// ```
/// use impactlaw::contact::{loading::Loading, spline::{Knot, SplineLoading}};
/// // w_1 = 1 and one knot on the line f = (3w - 1)/2, which has Hertz's slope at w = 1
/// let line = SplineLoading::new(1.0, &[Knot { flattening: 4.0, force: 5.5, slope: 1.5 }])?;
/// assert!((line.force(2.25) - 2.875).abs() < 1e-12);
/// assert!((line.force(10.0) - 14.5).abs() < 1e-12);
/// # Ok::<(), impactlaw::contact::admissible::Inadmissible>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SplineLoading {
    /// Start of each interval; the first is $w_1$, the last that of the straight line.
    starts: Vec<f64>,
    pieces: Vec<Piece>,
    knots: Vec<Knot>,
}

/// One interval: cubic in $s - s_0$, and the work up to its start.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    start: f64,
    coefficients: [f64; 4],
    work: f64,
}

impl Piece {
    /// Hermite cubic from value `f` and slope `d` at `s_0` and `s_1`.
    fn hermite(s: [f64; 2], f: [f64; 2], d: [f64; 2], work: f64) -> Self {
        let h = s[1] - s[0];
        let secant = (f[1] - f[0]) / h;
        Piece {
            start: s[0],
            coefficients: [
                f[0],
                d[0],
                (3.0 * secant - 2.0 * d[0] - d[1]) / h,
                (d[0] + d[1] - 2.0 * secant) / (h * h),
            ],
            work,
        }
    }

    #[inline]
    fn force(&self, s: f64) -> f64 {
        let t = s - self.start;
        let [c0, c1, c2, c3] = self.coefficients;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    /// Slope in $s$.
    fn slope(&self, s: f64) -> f64 {
        let t = s - self.start;
        let [_, c1, c2, c3] = self.coefficients;
        c1 + t * (2.0 * c2 + t * 3.0 * c3)
    }

    /// Work from $w = 0$: $\int f\ dw = \int f\ 2s\ ds$.
    fn work(&self, s: f64) -> f64 {
        let t = s - self.start;
        let [c0, c1, c2, c3] = self.coefficients;
        let flat = t * (c0 + t * (c1 / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0)));
        let rising = t * t * (c0 / 2.0 + t * (c1 / 3.0 + t * (c2 / 4.0 + t * c3 / 5.0)));
        self.work + 2.0 * (self.start * flat + rising)
    }

    /// Upper bound of the exponent $d\ln f/d\ln w = s f'/(2f)$ up to `s_1`: the smallest $M$ for which the
    /// cubic $2Mf - sf'$ has no negative Bernstein coefficient.
    fn exponent_bound(&self, s_1: f64) -> f64 {
        let (s_0, h) = (self.start, s_1 - self.start);
        let (f, d) = (
            [self.force(s_0), self.force(s_1)],
            [self.slope(s_0), self.slope(s_1)],
        );
        let g = [f[0], f[0] + h * d[0] / 3.0, f[1] - h * d[1] / 3.0, f[1]];
        let q = [d[0], 3.0 * (g[2] - g[1]) / h, d[1]];
        let rise = [
            s_0 * q[0],
            (2.0 * s_0 * q[1] + s_1 * q[0]) / 3.0,
            (s_0 * q[2] + 2.0 * s_1 * q[1]) / 3.0,
            s_1 * q[2],
        ];
        (0..4).map(|i| rise[i] / (2.0 * g[i])).fold(0.0, f64::max)
    }
}

impl SplineLoading {
    /// Spline that leaves Hertz's curve at `hertz_to` and goes through `knots`, given with increasing flattening.
    ///
    /// # Errors
    /// [`Inadmissible`] unless there is a knot, all numbers are finite, flattenings and forces increase, and each
    /// slope is positive and, in $\sqrt w$, at most three times the secants beside it.
    pub fn new(hertz_to: f64, knots: &[Knot]) -> Result<Self, Inadmissible> {
        let check = Inadmissible::unless;
        check(
            hertz_to > 0.0 && hertz_to.is_finite(),
            "hertz_to",
            hertz_to,
            "must be finite and above 0",
        )?;
        check(!knots.is_empty(), "knots", 0.0, "needs at least one knot")?;
        let mut before = Knot {
            flattening: hertz_to,
            force: hertz(hertz_to),
            slope: 1.5 * hertz_to.sqrt(),
        };
        let mut work = hertz_work(hertz_to);
        let (mut starts, mut pieces) = (vec![hertz_to], Vec::new());
        for (i, knot) in knots.iter().enumerate() {
            check_knot(i, &before, knot)?;
            let s = [before.flattening.sqrt(), knot.flattening.sqrt()];
            let d = [2.0 * s[0] * before.slope, 2.0 * s[1] * knot.slope];
            let piece = Piece::hermite(s, [before.force, knot.force], d, work);
            work = piece.work(s[1]);
            pieces.push(piece);
            starts.push(knot.flattening);
            before = *knot;
        }
        pieces.push(straight_line(&before, work));
        Ok(SplineLoading {
            starts,
            pieces,
            knots: knots.to_vec(),
        })
    }

    /// The knots past $w_1$.
    #[must_use]
    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// Where each interval starts in $w$ and in $s = \sqrt w$, and its cubic in $s$ counted from there; the last one is
    /// the straight line.
    pub fn cubics(&self) -> impl Iterator<Item = (f64, f64, [f64; 4])> {
        let pieces = self.starts.iter().zip(&self.pieces);
        pieces.map(|(&w, piece)| (w, piece.start, piece.coefficients))
    }

    #[inline]
    fn piece(&self, w: f64) -> &Piece {
        let inner = &self.starts[1..];
        &self.pieces[inner.iter().filter(|start| w > **start).count()]
    }
}

/// $f = f_k + f_k' (w - w_k)$ as a piece in $s$: $w - w_k = 2 s_k t + t^2$.
fn straight_line(knot: &Knot, work: f64) -> Piece {
    let s = knot.flattening.sqrt();
    Piece {
        start: s,
        coefficients: [knot.force, 2.0 * s * knot.slope, knot.slope, 0.0],
        work,
    }
}

/// Monotony between `before` and `knot`, number `i` of the list.
fn check_knot(i: usize, before: &Knot, knot: &Knot) -> Result<(), Inadmissible> {
    let key = |field: &str| format!("knots[{i}].{field}");
    let rises = |a: f64, b: f64| b > a && b.is_finite();
    let rise = "must be finite and above that of the knot before";
    Inadmissible::unless(
        rises(before.flattening, knot.flattening),
        key("flattening"),
        knot.flattening,
        rise,
    )?;
    Inadmissible::unless(
        rises(before.force, knot.force),
        key("force"),
        knot.force,
        rise,
    )?;
    let (s_0, s_1) = (before.flattening.sqrt(), knot.flattening.sqrt());
    let most = 3.0 * (knot.force - before.force) / (s_1 - s_0);
    Inadmissible::unless(
        2.0 * s_0 * before.slope <= most,
        key("force"),
        knot.force,
        "must not be so small that the curve falls after the knot before (slope in sqrt(w) above 3 secants)",
    )?;
    Inadmissible::unless(
        knot.slope > 0.0 && 2.0 * s_1 * knot.slope <= most,
        key("slope"),
        knot.slope,
        "must be above 0 and, in sqrt(w), at most three times the secants beside the knot",
    )
}

impl Loading for SplineLoading {
    fn departure(&self) -> f64 {
        self.starts[0]
    }

    #[inline]
    fn force(&self, w: f64) -> f64 {
        if w <= self.starts[0] {
            return hertz(w);
        }
        self.piece(w).force(w.sqrt())
    }

    fn slope(&self, w: f64) -> f64 {
        let s = w.sqrt();
        if w <= self.starts[0] {
            return 1.5 * s;
        }
        self.piece(w).slope(s) / (2.0 * s)
    }

    #[inline]
    fn force_and_slope(&self, w: f64) -> (f64, f64) {
        let s = w.sqrt();
        if w <= self.starts[0] {
            return (w * s, 1.5 * s);
        }
        let piece = self.piece(w);
        (piece.force(s), piece.slope(s) / (2.0 * s))
    }

    fn work(&self, w: f64) -> f64 {
        if w <= self.starts[0] {
            return hertz_work(w);
        }
        self.piece(w).work(w.sqrt())
    }

    /// Gauss-Legendre quadrature with five nodes on each piece.
    fn weighted_work(&self, from: f64, to: f64, g: impl Fn(f64) -> f64) -> f64 {
        if to < from {
            return -self.weighted_work(to, from, g);
        }
        let hertz_to = self.starts[0];
        let mut sum = hertz_work(to.min(hertz_to)) - hertz_work(from.min(hertz_to));
        let first = from.sqrt();
        for (k, piece) in self.pieces.iter().enumerate() {
            let end = self.starts.get(k + 1).map_or(to, |next| next.min(to));
            let start = piece.start.max(first);
            let half = 0.5 * (end.sqrt() - start);
            if half <= 0.0 {
                continue;
            }
            for (node, weight) in GAUSS_5 {
                let s = start + half * (1.0 + node);
                sum += weight * half * 2.0 * s * piece.force(s) * g(s * s);
            }
        }
        sum
    }

    fn exponent_bounds(&self) -> Vec<(f64, f64)> {
        let inner = self.starts.iter().zip(&self.pieces).zip(&self.starts[1..]);
        let mut bounds: Vec<_> = inner
            .map(|((start, piece), end)| (*start, piece.exponent_bound(end.sqrt())))
            .collect();
        if let Some(last) = self.knots.last() {
            let exponent = last.flattening * last.slope / last.force;
            bounds.push((last.flattening, exponent.max(1.0)));
        }
        bounds
    }
}
