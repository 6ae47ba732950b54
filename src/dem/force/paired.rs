//! Paired: two materials whose contacts are of one law, that of both together.

use crate::law::AnyLaw;

/// The law of two materials together.
#[derive(Debug, Clone, Copy)]
pub struct OfPair<'a> {
    /// The two, the first that of the particle of the law.
    pub between: [usize; 2],
    /// The law, of the effective radius.
    pub law: &'a AnyLaw,
    /// Radius of the second body over that of the particle in the impacts it was made from; infinite where that was flat.
    pub ratio: f64,
}

/// A pair of materials with a law of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paired {
    pub(super) between: [u8; 2],
    pub(super) ratio: f64,
    /// Its place among the kinds.
    pub(super) kind: usize,
}

/// Overlap over the effective radius up to which the law of a pair holds for other radii than those it was made of. Of steel on
/// aluminium (ratios of radii of 1/3, 1, 3 and a half-space), forces at one overlap in units of the effective radius are within 1 % of each other
/// at 0.012, within 3 % at 0.02 and within 8 % at 0.04.
pub(super) const OTHER_RADII: f64 = 0.02;
/// Relative difference of ratios of radii that are the same.
const SAME_RATIO: f64 = 1e-6;

impl Paired {
    /// Whether bodies of `radii` (m) and these materials are those the law was made of, in their proportions.
    pub(super) fn is_made_of(&self, materials: [u8; 2], [a, b]: [f64; 2]) -> bool {
        let same = |first: f64, second: f64| {
            let ratio = second / first;
            ratio == self.ratio || (ratio / self.ratio - 1.0).abs() < SAME_RATIO
        };
        let [one, other] = self.between;
        (materials == [one, other] && same(a, b)) || (materials == [other, one] && same(b, a))
    }
}
