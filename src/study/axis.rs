//! Axis: what a study file holds for one quantity: a value, a list of values, or a range that a hypercube is drawn from.

use crate::document::keys::{Kind, Value as Described};
use crate::unit::Quantity;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// What stands in the file; values in SI once [`Axis::map`] has made them so.
#[derive(Debug, Clone, PartialEq)]
pub enum Axis<T> {
    /// One value.
    One(T),
    /// A list of values.
    List(Vec<T>),
    /// A range, both ends included.
    Range(Ends<T>),
}

/// Ends of a range.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ends<T> {
    from: T,
    to: T,
    #[serde(default)]
    scale: Scale,
}

/// How a range is filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Evenly in the value.
    #[default]
    Linear,
    /// Evenly in its logarithm.
    Log,
}

impl<T: Copy> Axis<T> {
    /// The same axis with another kind of values.
    pub fn map<U>(&self, of: impl Fn(T) -> U) -> Axis<U> {
        match self {
            Axis::One(value) => Axis::One(of(*value)),
            Axis::List(values) => Axis::List(values.iter().map(|value| of(*value)).collect()),
            Axis::Range(ends) => Axis::Range(Ends {
                from: of(ends.from),
                to: of(ends.to),
                scale: ends.scale,
            }),
        }
    }

    /// Every value that stands in the file, with the end of its key: `[2]`, `.from`, or nothing.
    pub fn written(&self) -> Vec<(String, T)> {
        match self {
            Axis::One(value) => vec![(String::new(), *value)],
            Axis::List(values) => values
                .iter()
                .enumerate()
                .map(|(i, value)| (format!("[{i}]"), *value))
                .collect(),
            Axis::Range(ends) => vec![(".from".to_owned(), ends.from), (".to".to_owned(), ends.to)],
        }
    }
}

impl<D: Copy> Axis<Quantity<D>> {
    /// The axis in SI.
    pub fn si(&self) -> Axis<f64> {
        self.map(Quantity::si)
    }
}

impl Ends<f64> {
    /// Whether the range can be drawn from, else what is wrong with it.
    pub fn wrong(&self) -> Option<&'static str> {
        match self.scale {
            _ if self.from >= self.to => Some("must begin (`from`) below its end (`to`)"),
            Scale::Log if self.from <= 0.0 => Some("must begin above 0 on a logarithmic scale"),
            _ => None,
        }
    }

    /// The value at the share `u` of the range, to six digits, so that a table says all of it.
    pub fn at(&self, u: f64) -> f64 {
        let value = match self.scale {
            Scale::Linear => self.from + u * (self.to - self.from),
            Scale::Log => self.from * (self.to / self.from).powf(u),
        };
        let rounded = format!("{value:.5e}").parse().unwrap_or(value);
        f64::clamp(rounded, self.from, self.to)
    }
}

impl<T: Described> Described for Axis<T> {
    fn kind() -> Kind {
        Kind::Axis(Box::new(T::kind()))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Axis<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(AxisVisitor(PhantomData))
    }
}

struct AxisVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for AxisVisitor<T> {
    type Value = Axis<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value, a list of values, or a range, { from = ..., to = ... }")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        T::deserialize(text.into_deserializer()).map(Axis::One)
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Self::Value, E> {
        T::deserialize(number.into_deserializer()).map(Axis::One)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Self::Value, E> {
        T::deserialize(number.into_deserializer()).map(Axis::One)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Self::Value, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(items)).map(Axis::List)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        Ends::deserialize(MapAccessDeserializer::new(map)).map(Axis::Range)
    }
}
