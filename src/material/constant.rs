//! Constants of a flow stress as files name them: key, physical dimension, allowed range.

use crate::document::keys::{Key, Kind, Line, key};
use crate::unit::{
    self, Pressure, Quantity, SpecificHeat, StrainRate, Temperature, Units, engineering,
};
use serde::{Deserialize, Deserializer};

/// A constant of a flow stress. Everything that reads or writes one walks tables of these.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// What it means that a file leaves it out.
    pub absent: Absent,
    /// What it means, for the reference of keys.
    pub meaning: &'static str,
    /// A value as an input file spells it, single quotes for double ones.
    pub example: &'static str,
    /// What holds where a file does not name it.
    pub otherwise: &'static str,
}

/// What it means that a file leaves a constant out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Absent {
    /// The flow stress is none that takes it.
    Other,
    /// It is 0: no effect.
    Nothing,
    /// It has this value, SI, where the flow stress takes it.
    Usual(f64),
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
    /// 0 < x <= 1.
    UpToOne,
    /// 0 <= x <= 1.
    Share,
    /// 0 < x < E.
    BelowYoungModulus,
}

impl Constant {
    /// Name in running text: the key without its underscores.
    #[must_use]
    pub fn name(&self) -> String {
        self.key.replace('_', " ")
    }

    /// Its key in files that spell quantities as text.
    #[must_use]
    pub fn in_text(&self) -> Key {
        Key {
            name: self.key.to_owned(),
            kind: match self.dimension.units() {
                Some(units) => Kind::Quantity(units),
                None => Kind::Number,
            },
            line: key(self.meaning, self.range.words(), self.example).or(self.otherwise),
        }
    }

    /// Its key in files that hold plain numbers in SI.
    #[must_use]
    pub fn in_si(&self) -> Key {
        let line = key(self.meaning, self.range.words(), "").or(self.otherwise);
        let value = self.dimension.si(self.example.trim_matches('\''));
        Key {
            name: format!("{}{}", self.key, self.dimension.suffix()),
            kind: Kind::Number,
            line: Line {
                example: format!("{value:?}").into(),
                ..line
            },
        }
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

    /// Its units in input files; none for a number.
    #[must_use]
    pub const fn units(self) -> Option<Units> {
        match self {
            Dimension::Number => None,
            Dimension::Stress => Some(Units::of::<Pressure>()),
            Dimension::Rate => Some(Units::of::<StrainRate>()),
            Dimension::Temperature => Some(Units::of::<Temperature>()),
            Dimension::SpecificHeat => Some(Units::of::<SpecificHeat>()),
        }
    }

    /// SI value of a text; not a number for one that is none of this dimension.
    fn si(self, text: &str) -> f64 {
        let value = match self {
            Dimension::Number => text.parse().ok(),
            Dimension::Stress => unit::parse::<Pressure>(text).ok(),
            Dimension::Rate => unit::parse::<StrainRate>(text).ok(),
            Dimension::Temperature => unit::parse::<Temperature>(text).ok(),
            Dimension::SpecificHeat => unit::parse::<SpecificHeat>(text).ok(),
        };
        value.unwrap_or(f64::NAN)
    }

    /// End of a key whose value is a plain number in SI: `_Pa` in `yield_strength_Pa`.
    #[must_use]
    pub const fn suffix(self) -> &'static str {
        match self {
            Dimension::Number => "",
            Dimension::Stress => "_Pa",
            Dimension::Rate => "_1_s",
            Dimension::Temperature => "_K",
            Dimension::SpecificHeat => "_J_kg_K",
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
            Range::UpToOne => x > 0.0 && x <= 1.0,
            Range::Share => (0.0..=1.0).contains(&x),
            Range::BelowYoungModulus => x > 0.0 && x < young_modulus,
        }
    }

    /// The range as the reference of keys says it.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Range::Positive => "> 0",
            Range::NotNegative => "≥ 0",
            Range::UpToOne => "> 0, ≤ 1",
            Range::Share => "0 to 1",
            Range::BelowYoungModulus => "> 0, < E",
        }
    }

    /// What an error says of a value outside.
    #[must_use]
    pub fn rule(self, young_modulus: f64) -> String {
        match self {
            Range::Positive => "must be positive".to_owned(),
            Range::NotNegative => "must not be negative".to_owned(),
            Range::UpToOne => "must be positive and at most 1".to_owned(),
            Range::Share => "must lie in [0, 1]".to_owned(),
            Range::BelowYoungModulus => format!(
                "must be positive and below young_modulus ({}); check the unit of both",
                engineering(young_modulus, "Pa", 4)
            ),
        }
    }
}
