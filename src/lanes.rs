//! Lanes: four `f64` side by side, the width the kernel works in.
//!
//! Element-wise operators on a value of vector type; the compiler turns them into vector instructions of whatever width
//! the surrounding function is compiled for. (Held as a plain array, the four numbers are taken apart into scalars first
//! and only partly put together again.) Products and sums are fused only where [`Lanes::mul_add`] says so, and then on
//! every machine, so every width gives the same bits; a machine without the instruction (x86 before 2013) calls a function
//! for it and is some ten times slower.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Points handled side by side.
pub const WIDTH: usize = 4;

/// What the four numbers are held as between operators. Only the type is used, no instruction of the machine.
#[cfg(target_arch = "x86_64")]
type Register = std::arch::x86_64::__m256d;
/// What the four numbers are held as between operators.
#[cfg(not(target_arch = "x86_64"))]
type Register = [f64; WIDTH];

/// Four numbers, one per material point of a block.
#[derive(Clone, Copy)]
pub struct Lanes(Register);

impl Lanes {
    /// Four numbers side by side.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::useless_transmute)] // an array already where there is no vector type
    pub fn new(numbers: [f64; WIDTH]) -> Self {
        // SAFETY: both types are four f64 in the same order, and all bits are valid in both.
        Lanes(unsafe { std::mem::transmute::<[f64; WIDTH], Register>(numbers) })
    }

    /// The four numbers.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::useless_transmute)] // see `new`
    pub fn array(self) -> [f64; WIDTH] {
        // SAFETY: as in `new`.
        unsafe { std::mem::transmute::<Register, [f64; WIDTH]>(self.0) }
    }

    /// The same number in every lane.
    #[inline(always)]
    #[must_use]
    pub fn splat(x: f64) -> Self {
        Lanes::new([x; WIDTH])
    }

    /// `f` of the number of each lane.
    #[inline(always)]
    #[must_use]
    pub fn each(f: impl Fn(usize) -> f64) -> Self {
        Lanes::new([f(0), f(1), f(2), f(3)])
    }

    /// Element-wise function of one argument.
    #[inline(always)]
    #[must_use]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.array();
        Lanes::new([f(a), f(b), f(c), f(d)])
    }

    /// Element-wise function of two arguments.
    #[inline(always)]
    #[must_use]
    pub fn zip(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.array(), o.array());
        Lanes::new([f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])])
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
        let [a, b, c, d] = self.array();
        (a + b) + (c + d)
    }

    /// Smallest lane; NaN if any lane is NaN.
    #[inline(always)]
    #[must_use]
    pub fn min(self) -> f64 {
        let numbers = self.array();
        let mut least = numbers[0];
        for &x in &numbers[1..] {
            if !(x >= least) {
                least = x;
            }
        }
        if numbers.iter().any(|x| x.is_nan()) {
            f64::NAN
        } else {
            least
        }
    }

    /// `self` where `test > 0`, else `other`.
    #[inline(always)]
    #[must_use]
    pub fn where_positive(self, test: Self, other: Self) -> Self {
        let (test, a, b) = (test.array(), self.array(), other.array());
        Lanes::each(|k| if test[k] > 0.0 { a[k] } else { b[k] })
    }

    /// Whether any lane is above zero.
    #[inline(always)]
    #[must_use]
    pub fn any_positive(self) -> bool {
        let [a, b, c, d] = self.array();
        (a > 0.0) | (b > 0.0) | (c > 0.0) | (d > 0.0)
    }

    /// `self * a + b`, rounded once.
    #[inline(always)]
    #[must_use]
    pub fn mul_add(self, a: Self, b: Self) -> Self {
        let (x, a, b) = (self.array(), a.array(), b.array());
        Lanes::each(|k| x[k].mul_add(a[k], b[k]))
    }

    /// Cube root of the reciprocal, $x^{-1/3}$ for $x > 0$, by iteration from below (no library call per point).
    ///
    /// Starts at $3/(2+x) \le x^{-1/3}$ (arithmetic against geometric mean). Two steps of [`Self::toward_recip_cbrt`] reach
    /// rounding for $0.55 < x < 1.7$, and twelve more for $10^{-5} < x < 10^4$, which only large deformation asks for.
    #[inline(always)]
    #[must_use]
    pub fn recip_cbrt(self) -> Self {
        let near = self.near_recip_cbrt();
        let mut y = near.toward_recip_cbrt(self).toward_recip_cbrt(self);
        if self.is_far_from_one() {
            for _ in 0..12 {
                y = y.toward_recip_cbrt(self);
            }
        }
        y
    }

    /// Where [`Self::recip_cbrt`] starts.
    #[inline(always)]
    #[must_use]
    pub fn near_recip_cbrt(self) -> Self {
        Lanes::splat(3.0) * (self + Lanes::splat(2.0)).recip()
    }

    /// One step from y = `self` to $x^{-1/3}$: with $r = 1 - x y^3$ the answer is $y (1 - r)^{-1/3}$, whose series up to $r^3$
    /// takes the error to its fourth power and stays below.
    #[inline(always)]
    #[must_use]
    pub fn toward_recip_cbrt(self, x: Self) -> Self {
        let y = self;
        let r = Lanes::splat(1.0) - (x * y) * (y * y);
        let series = r * Lanes::splat(14.0 / 81.0) + Lanes::splat(2.0 / 9.0);
        let series = r * series + Lanes::splat(1.0 / 3.0);
        (y * r) * series + y
    }

    /// Whether two steps are too few for any lane.
    #[inline(always)]
    #[must_use]
    pub fn is_far_from_one(self) -> bool {
        (self - Lanes::splat(1.7)).any_positive() || (Lanes::splat(0.55) - self).any_positive()
    }
}

impl Default for Lanes {
    #[inline(always)]
    fn default() -> Self {
        Lanes::splat(0.0)
    }
}

impl PartialEq for Lanes {
    fn eq(&self, o: &Self) -> bool {
        self.array() == o.array()
    }
}

impl std::fmt::Debug for Lanes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Lanes").field(&self.array()).finish()
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
        for i in 0..300 {
            let x = 0.3 + 0.009 * f64::from(i);
            let y = Lanes::splat(x).recip_cbrt().array()[0];
            assert!((y * x.cbrt() - 1.0).abs() < 1e-15, "{x}: {y}");
        }
        for x in [1e-5, 1e-3, 0.1, 10.0, 1e3, 1e4_f64] {
            let y = Lanes::splat(x).recip_cbrt().array()[0];
            assert!((y * x.cbrt() - 1.0).abs() < 1e-14, "{x}: {y}");
        }
    }

    #[test]
    fn smallest_lane_reports_nan() {
        assert_eq!(Lanes::new([3.0, 1.0, 2.0, 5.0]).min(), 1.0);
        assert!(Lanes::new([3.0, f64::NAN, 2.0, 5.0]).min().is_nan());
    }
}
