//! Ratio: simple fractions, the exponents that belong to the structure of a formula.

/// Fraction in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ratio {
    /// Numerator.
    pub over: i32,
    /// Denominator, positive.
    pub under: i32,
}

impl Ratio {
    /// A whole number.
    #[must_use]
    pub const fn whole(over: i32) -> Self {
        Ratio { over, under: 1 }
    }

    /// As a number.
    #[must_use]
    pub fn value(self) -> f64 {
        f64::from(self.over) / f64::from(self.under)
    }

    /// Bits it takes to write it: those of numerator and denominator, and a sign.
    #[must_use]
    pub fn bits(self) -> f64 {
        if self.over == 0 {
            return 1.0;
        }
        2.0 + 2.0 * f64::from(self.over.abs()).log2() + 2.0 * f64::from(self.under).log2()
    }
}

impl std::fmt::Display for Ratio {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.under {
            1 => write!(f, "{}", self.over),
            under => write!(f, "{}/{under}", self.over),
        }
    }
}
