//! Lanes: four `f64` side by side, the width the kernel works in.
//!
//! Plain arrays with element-wise operators; the compiler turns them into vector instructions of whatever width the
//! surrounding function is compiled for. No fused multiply-add is ever introduced, so every width gives the same bits.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Points handled side by side.
pub const WIDTH: usize = 4;

/// Four numbers, one per material point of a block.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(32))]
pub struct Lanes(pub [f64; WIDTH]);

impl Lanes {
    /// The same number in every lane.
    #[inline(always)]
    #[must_use]
    pub fn splat(x: f64) -> Self {
        Lanes([x; WIDTH])
    }

    /// Element-wise function of one argument.
    #[inline(always)]
    #[must_use]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Lanes([f(self.0[0]), f(self.0[1]), f(self.0[2]), f(self.0[3])])
    }

    /// Element-wise function of two arguments.
    #[inline(always)]
    #[must_use]
    pub fn zip(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Lanes([
            f(self.0[0], o.0[0]),
            f(self.0[1], o.0[1]),
            f(self.0[2], o.0[2]),
            f(self.0[3], o.0[3]),
        ])
    }

    /// Square root.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// Reciprocal.
    #[inline(always)]
    #[must_use]
    pub fn recip(self) -> Self {
        self.map(|x| 1.0 / x)
    }

    /// Sum over the lanes, in a fixed order.
    #[inline(always)]
    #[must_use]
    pub fn sum(self) -> f64 {
        (self.0[0] + self.0[1]) + (self.0[2] + self.0[3])
    }

    /// Smallest lane; NaN if any lane is NaN.
    #[inline(always)]
    #[must_use]
    pub fn min(self) -> f64 {
        let mut least = self.0[0];
        for &x in &self.0[1..] {
            if !(x >= least) {
                least = x;
            }
        }
        if self.0.iter().any(|x| x.is_nan()) {
            f64::NAN
        } else {
            least
        }
    }

    /// `self` where `test > 0`, else `other`.
    #[inline(always)]
    #[must_use]
    pub fn where_positive(self, test: Self, other: Self) -> Self {
        let mut out = other;
        for k in 0..WIDTH {
            if test.0[k] > 0.0 {
                out.0[k] = self.0[k];
            }
        }
        out
    }

    /// Whether any lane is above zero.
    #[inline(always)]
    #[must_use]
    pub fn any_positive(self) -> bool {
        (self.0[0] > 0.0) | (self.0[1] > 0.0) | (self.0[2] > 0.0) | (self.0[3] > 0.0)
    }

    /// Cube root of the reciprocal, $x^{-1/3}$ for $x > 0$, by Newton iteration from below (no library call per point).
    ///
    /// Starts at $3/(2+x) \le x^{-1/3}$ (arithmetic against geometric mean), from where Newton's method
    /// $y \leftarrow y (4 - x y^3)/3$ climbs monotonically; five steps reach rounding for $0.3 < x < 3$, and twenty more
    /// for $10^{-5} < x < 10^4$, which only large deformation asks for.
    #[inline(always)]
    #[must_use]
    pub fn recip_cbrt(self) -> Self {
        let x = self;
        let mut y = Lanes::splat(3.0) * (x + Lanes::splat(2.0)).recip();
        let climb =
            |y: Lanes| y * (Lanes::splat(4.0 / 3.0) - x * (y * y * y) * Lanes::splat(1.0 / 3.0));
        for _ in 0..5 {
            y = climb(y);
        }
        if (x - Lanes::splat(3.0)).any_positive() || (Lanes::splat(0.3) - x).any_positive() {
            for _ in 0..20 {
                y = climb(y);
            }
        }
        y
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for Lanes {
            type Output = Lanes;
            #[inline(always)]
            fn $method(self, o: Lanes) -> Lanes {
                self.zip(o, |a, b| a $op b)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, o: Lanes) {
        *self = *self + o;
    }
}

impl Neg for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn neg(self) -> Lanes {
        self.map(|a| -a)
    }
}

impl Mul<f64> for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn mul(self, s: f64) -> Lanes {
        self * Lanes::splat(s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocal_cube_root_reaches_rounding() {
        for i in 0..60 {
            let x = 0.3 + 0.045 * f64::from(i);
            let y = Lanes::splat(x).recip_cbrt().0[0];
            assert!((y - x.powf(-1.0 / 3.0)).abs() < 4e-15, "{x}: {y}");
        }
        for x in [1e-5, 1e-3, 0.1, 10.0, 1e3, 1e4_f64] {
            let y = Lanes::splat(x).recip_cbrt().0[0];
            assert!((y * x.cbrt() - 1.0).abs() < 1e-14, "{x}: {y}");
        }
    }

    #[test]
    fn smallest_lane_reports_nan() {
        assert_eq!(Lanes([3.0, 1.0, 2.0, 5.0]).min(), 1.0);
        assert!(Lanes([3.0, f64::NAN, 2.0, 5.0]).min().is_nan());
    }
}
