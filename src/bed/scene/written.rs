//! Values that a scene may write in two ways.

use crate::Result;
use crate::document::Document;
use crate::document::keys::{self, Kind};
use crate::unit::{Acceleration, Quantity};
use parry3d::math::Vector;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// Magnitude along -z, or a vector.
#[derive(Debug)]
pub(super) enum Gravity {
    Down(Quantity<Acceleration>),
    Vector([Quantity<Acceleration>; 3]),
}

/// A table that may stand once (`[grains]`) or several times (`[[grains]]`).
#[derive(Debug)]
pub(super) enum OneOrMany<T> {
    One(Box<T>),
    Many(Vec<T>),
}

impl<T: keys::Value> keys::Value for OneOrMany<T> {
    fn kind() -> Kind {
        match T::kind() {
            Kind::Table(table) => Kind::OneOrMany(table),
            other => other,
        }
    }
}

impl keys::Value for Gravity {
    fn kind() -> Kind {
        let one = Quantity::<Acceleration>::kind();
        Kind::Either(
            Box::new(one.clone()),
            Box::new(Kind::Array(3, Box::new(one))),
        )
    }
}

impl<T> OneOrMany<T> {
    /// Tables with their dotted keys.
    pub(super) fn keyed(self, key: &str) -> Vec<(String, T)> {
        match self {
            OneOrMany::One(table) => vec![(key.to_owned(), *table)],
            OneOrMany::Many(tables) => tables
                .into_iter()
                .enumerate()
                .map(|(index, table)| (format!("{key}[{index}]"), table))
                .collect(),
        }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMany<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Either<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<T> {
            type Value = OneOrMany<T>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a table or a list of tables")
            }

            fn visit_map<A: MapAccess<'de>>(
                self,
                map: A,
            ) -> std::result::Result<Self::Value, A::Error> {
                let table = T::deserialize(MapAccessDeserializer::new(map))?;
                Ok(OneOrMany::One(Box::new(table)))
            }

            fn visit_seq<A: SeqAccess<'de>>(
                self,
                seq: A,
            ) -> std::result::Result<Self::Value, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(OneOrMany::Many)
            }
        }
        deserializer.deserialize_any(Either(PhantomData))
    }
}

impl<'de> Deserialize<'de> for Gravity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Gravity;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an acceleration along -z, e.g. \"9.81 m/s2\", or three of them")
            }

            fn visit_str<E: serde::de::Error>(self, text: &str) -> std::result::Result<Gravity, E> {
                let text = serde::de::value::StrDeserializer::new(text);
                Quantity::deserialize(text).map(Gravity::Down)
            }

            fn visit_seq<A: SeqAccess<'de>>(
                self,
                seq: A,
            ) -> std::result::Result<Gravity, A::Error> {
                <[Quantity<Acceleration>; 3]>::deserialize(SeqAccessDeserializer::new(seq))
                    .map(Gravity::Vector)
            }
        }
        deserializer.deserialize_any(Either)
    }
}

impl Gravity {
    /// Vector, m/s2.
    pub(super) fn check(&self, document: &Document) -> Result<Vector> {
        match self {
            Gravity::Down(magnitude) => {
                let magnitude = document.non_negative("gravity", *magnitude)?;
                Ok(Vector::new(0.0, 0.0, -magnitude))
            }
            Gravity::Vector(components) => Ok(vector(*components)),
        }
    }
}

/// Vector of an array of quantities, SI.
pub(super) fn vector<D>(components: [Quantity<D>; 3]) -> Vector {
    Vector::from(components.map(Quantity::si))
}
