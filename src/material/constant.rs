//! Constants of a flow stress as files name them: key, physical dimension, allowed range.

use crate::unit::{Pressure, Quantity, SpecificHeat, StrainRate, Temperature, engineering};
use serde::{Deserialize, Deserializer};

/// A constant of a flow stress. Everything that reads or writes one walks tables of these.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Constant {
    /// Key in files, e.g. `hardening_modulus`.
    pub key: &'static str,
    /// Symbol, e.g. `H`.
    pub symbol: &'static str,
    /// Effect that it belongs to, as a plan lists it, e.g. `hardening`.
    pub effect: &'static str,
    /// Physical dimension.
    pub dimension: Dimension,
    /// Allowed values.
    pub range: Range,
    /// Whether a file may leave it out, which means 0: no effect.
    pub may_be_absent: bool,
}

/// Physical dimension of a constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// A pure number.
    Number,
    /// Pa.
    Stress,
    /// 1/s.
    Rate,
    /// K.
    Temperature,
    /// J/(kg K).
    SpecificHeat,
}

/// Values that a constant may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// x > 0.
    Positive,
    /// x >= 0.
    NotNegative,
    /// 0 < x < E.
    BelowYoungModulus,
}

impl Constant {
    /// Name in running text: the key without its underscores.
    #[must_use]
    pub fn name(&self) -> String {
        self.key.replace('_', " ")
    }

    /// Name as a heading: "Yield strength Y".
    #[must_use]
    pub fn title(&self) -> String {
        let name = self.name();
        let (first, rest) = name.split_at(1);
        format!("{}{rest} {}", first.to_uppercase(), self.symbol)
    }
}

impl Dimension {
    /// SI unit; empty for a number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Dimension::Number => "",
            Dimension::Stress => "Pa",
            Dimension::Rate => "1/s",
            Dimension::Temperature => "K",
            Dimension::SpecificHeat => "J/(kg K)",
        }
    }

    /// End of a key whose value is a plain number in SI: `_Pa` in `yield_strength_Pa`.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Dimension::Number => "",
            Dimension::Stress => "_Pa",
            Dimension::Rate => "_1_s",
            Dimension::Temperature => "_K",
            Dimension::SpecificHeat => "_J_kgK",
        }
    }

    /// Whether it holds a time: a constant with one makes impacts differ from size to size.
    #[must_use]
    pub const fn has_time(self) -> bool {
        match self {
            Dimension::Rate => true,
            // of adiabatic heating the rise in temperature follows from the work per volume alone
            Dimension::Number
            | Dimension::Stress
            | Dimension::Temperature
            | Dimension::SpecificHeat => false,
        }
    }

    /// SI value of what an input file says: text with a unit, or a pure number.
    ///
    /// # Errors
    /// Those of [`Quantity`], or of a number.
    pub fn read<'de, D: Deserializer<'de>>(self, from: D) -> Result<f64, D::Error> {
        match self {
            Dimension::Number => f64::deserialize(from),
            Dimension::Stress => Quantity::<Pressure>::deserialize(from).map(Quantity::si),
            Dimension::Rate => Quantity::<StrainRate>::deserialize(from).map(Quantity::si),
            Dimension::Temperature => Quantity::<Temperature>::deserialize(from).map(Quantity::si),
            Dimension::SpecificHeat => {
                Quantity::<SpecificHeat>::deserialize(from).map(Quantity::si)
            }
        }
    }
}

impl Range {
    /// Whether `x` lies in the range, for a material of this Young's modulus.
    #[must_use]
    pub fn holds(self, x: f64, young_modulus: f64) -> bool {
        match self {
            Range::Positive => x > 0.0,
            Range::NotNegative => x >= 0.0,
            Range::BelowYoungModulus => x > 0.0 && x < young_modulus,
        }
    }

    /// What an error says of a value outside.
    #[must_use]
    pub fn rule(self, young_modulus: f64) -> String {
        match self {
            Range::Positive => "must be positive".to_owned(),
            Range::NotNegative => "must not be negative".to_owned(),
            Range::BelowYoungModulus => format!(
                "must be positive and below young_modulus ({}); check the unit of both",
                engineering(young_modulus, "Pa", 4)
            ),
        }
    }
}
