//! Constants of a flow stress as a file holds them: read by key, checked, and turned into the kind that takes them.

use super::{Flow, YIELD_STRENGTH};
use crate::Result;
use crate::document::Document;
use crate::document::keys::{self, Key, Kind, Table};
use crate::material::constant::{Absent, Constant};
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// How a file spells constants.
pub trait Spelling {
    /// What a file holds for a constant: SI value, or several.
    type Value: fmt::Debug + Clone + PartialEq;
    /// Key of a constant.
    fn key(constant: &Constant) -> String;
    /// That key with its line in the reference.
    fn described(constant: &Constant) -> Key;
    /// What stands there.
    ///
    /// # Errors
    /// When it is no such value.
    fn read<'de, D: Deserializer<'de>>(
        constant: &Constant,
        from: D,
    ) -> std::result::Result<Self::Value, D::Error>;
}

/// `yield_strength = "1.25 GPa"`: case and scene files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InText;

/// `yield_strength_Pa = 1.25e9`: law files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InSi;

impl Spelling for InText {
    type Value = f64;
    fn key(constant: &Constant) -> String {
        constant.key.to_owned()
    }
    fn described(constant: &Constant) -> Key {
        constant.in_text()
    }
    fn read<'de, D: Deserializer<'de>>(
        constant: &Constant,
        from: D,
    ) -> std::result::Result<f64, D::Error> {
        constant.dimension.read(from)
    }
}

impl Spelling for InSi {
    type Value = f64;
    fn key(constant: &Constant) -> String {
        format!("{}{}", constant.key, constant.dimension.suffix())
    }
    fn described(constant: &Constant) -> Key {
        constant.in_si()
    }
    fn read<'de, D: Deserializer<'de>>(
        _: &Constant,
        from: D,
    ) -> std::result::Result<f64, D::Error> {
        f64::deserialize(from)
    }
}

/// Constants of a flow stress that a table of a file holds, SI; none for an elastic body.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowConstants<W: Spelling> {
    values: Vec<(Constant, W::Value)>,
    spelling: PhantomData<W>,
}

impl<W: Spelling> Default for FlowConstants<W> {
    fn default() -> Self {
        FlowConstants {
            values: Vec::new(),
            spelling: PhantomData,
        }
    }
}

impl<W: Spelling> FlowConstants<W> {
    /// Constants with what a file holds for each.
    #[must_use]
    pub fn new(mut values: Vec<(Constant, W::Value)>) -> Self {
        let all = Flow::all_constants();
        values.sort_by_key(|(constant, _)| all.iter().position(|c| c == constant));
        FlowConstants {
            values,
            spelling: PhantomData,
        }
    }

    /// The constants that the table names, with what it holds for each.
    #[must_use]
    pub fn named(&self) -> &[(Constant, W::Value)] {
        &self.values
    }
}

impl<W: Spelling<Value = f64>> FlowConstants<W> {
    /// What a file says of `flow`: its own constants, and 0 for those of other kinds that mean no effect then.
    #[must_use]
    pub fn of(flow: Option<&Flow>) -> Self {
        let Some(flow) = flow else {
            return Self::default();
        };
        let own = flow.constants();
        let value = |constant: Constant| {
            let found = own.iter().find(|(c, _)| *c == constant);
            let value = found.map(|(_, value)| *value);
            let absent = (constant.absent == Absent::Nothing).then_some(0.0);
            value.or(absent).map(|value| (constant, value))
        };
        FlowConstants {
            values: Flow::all_constants()
                .into_iter()
                .filter_map(value)
                .collect(),
            spelling: PhantomData,
        }
    }

    /// Value of a constant, if the table names it.
    #[must_use]
    pub fn value(&self, constant: &Constant) -> Option<f64> {
        let found = self.values.iter().find(|(c, _)| c == constant);
        found.map(|(_, value)| *value)
    }

    /// Whether the table names none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The flow stress, its constants checked; `at` is the dotted key of their table.
    ///
    /// # Errors
    /// [`crate::Error::Value`] for a value out of range, or constants that belong to no one kind of flow stress.
    pub fn check(&self, document: &Document, at: &str, young_modulus: f64) -> Result<Option<Flow>> {
        let key = |constant: &Constant| format!("{at}.{}", W::key(constant));
        for (constant, value) in &self.values {
            let holds = |x| constant.range.holds(x, young_modulus);
            let rule = constant.range.rule(young_modulus);
            document.check(&key(constant), *value, holds, &rule)?;
        }
        self.flow()
            .map_err(|Refused(constant, allowed)| document.reject(&key(&constant), allowed))
    }

    /// The first kind of the list that takes all constants with an effect and lacks none.
    fn flow(&self) -> std::result::Result<Option<Flow>, Refused> {
        let Some((first, _)) = self.values.first() else {
            return Ok(None);
        };
        let get = |constant: &Constant| {
            let found = self.values.iter().find(|(c, _)| c == constant);
            found.map(|(_, value)| *value)
        };
        if get(&YIELD_STRENGTH).is_none() {
            let strength = W::key(&YIELD_STRENGTH);
            let allowed =
                format!("needs a `{strength}` beside it: without one the body is elastic");
            return Err(Refused(Box::new(*first), allowed));
        }
        let acts = |(constant, value): &&(Constant, f64)| {
            constant.absent != Absent::Nothing || *value != 0.0
        };
        let acting: Vec<Constant> = self.values.iter().filter(acts).map(|(c, _)| *c).collect();
        let takes = |kind: &&super::Kind| acting.iter().all(|c| kind.constants.contains(c));
        let lacking = |kind: &super::Kind| {
            let absent = |c: &&Constant| c.absent == Absent::Other && get(c).is_none();
            kind.constants.iter().find(absent).copied()
        };
        let fitting: Vec<&super::Kind> = Flow::KINDS.iter().filter(takes).collect();
        if let Some(kind) = fitting.iter().find(|kind| lacking(kind).is_none()) {
            let values = kind.constants.iter();
            let usual = |c: &Constant| match c.absent {
                Absent::Usual(value) => value,
                Absent::Other | Absent::Nothing => 0.0,
            };
            let values: Vec<f64> = values.map(|c| get(c).unwrap_or(usual(c))).collect();
            let flow = (kind.of)(&values);
            return match flow.contradiction() {
                None => Ok(Some(flow)),
                Some((constant, allowed)) => Err(Refused(Box::new(constant), allowed)),
            };
        }
        let last = acting.last().copied().unwrap_or(*first);
        let allowed = match fitting.first().and_then(|kind| lacking(kind)) {
            Some(missing) => format!("needs a `{}` beside it", W::key(&missing)),
            None => format!("must stand with constants of one kind: {}", kinds::<W>()),
        };
        Err(Refused(Box::new(last), allowed))
    }

    /// The flow stress of constants that have been checked.
    #[must_use]
    pub fn checked(&self) -> Option<Flow> {
        self.flow().ok().flatten()
    }
}

/// A constant that cannot stand as it does, and why.
#[derive(Debug, Clone, PartialEq)]
struct Refused(Box<Constant>, String);

/// Keys of every kind, for messages.
fn kinds<W: Spelling>() -> String {
    let keys = |kind: &super::Kind| {
        let keys: Vec<String> = kind.constants.iter().map(W::key).collect();
        format!("{} ({})", kind.name, keys.join(", "))
    };
    let all: Vec<String> = Flow::KINDS.iter().map(keys).collect();
    all.join(", ")
}

impl<W: Spelling<Value = f64>> Serialize for FlowConstants<W> {
    fn serialize<S: Serializer>(&self, to: S) -> std::result::Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(Some(self.values.len()))?;
        for (constant, value) in &self.values {
            map.serialize_entry(&W::key(constant), value)?;
        }
        map.end()
    }
}

/// A table of a file: constants of a flow stress, and the other keys as `T` has them.
#[derive(Debug, Clone, PartialEq)]
pub struct WithFlow<T, W: Spelling> {
    /// The other keys.
    pub others: T,
    /// The constants.
    pub flow: FlowConstants<W>,
}

impl<'de, T: Deserialize<'de>, W: Spelling> Deserialize<'de> for WithFlow<T, W> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        from.deserialize_map(TableVisitor(PhantomData))
    }
}

impl<T: keys::Value, W: Spelling> keys::Value for WithFlow<T, W> {
    fn kind() -> Kind {
        match T::kind() {
            Kind::Table(Table { about, mut keys }) => {
                keys.extend(Flow::all_constants().iter().map(W::described));
                Kind::Table(Table { about, keys })
            }
            other => other,
        }
    }
}

struct TableVisitor<T, W>(PhantomData<(T, W)>);

impl<'de, T: Deserialize<'de>, W: Spelling> Visitor<'de> for TableVisitor<T, W> {
    type Value = WithFlow<T, W>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> std::result::Result<Self::Value, A::Error> {
        let mut flow = FlowConstants::<W>::default();
        let others = T::deserialize(MapAccessDeserializer::new(Others {
            map,
            flow: &mut flow,
        }))?;
        Ok(WithFlow {
            others,
            flow: FlowConstants::new(flow.values),
        })
    }
}

/// A table without the constants of a flow stress, which are put aside.
struct Others<'a, A, W: Spelling> {
    map: A,
    flow: &'a mut FlowConstants<W>,
}

impl<'de, A: MapAccess<'de>, W: Spelling> MapAccess<'de> for Others<'_, A, W> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> std::result::Result<Option<K::Value>, A::Error> {
        let mut seed = Some(seed);
        loop {
            let key = self.map.next_key_seed(KeySeed::<K, W> {
                seed: &mut seed,
                spelling: PhantomData,
            })?;
            match key {
                None => return Ok(None),
                Some(Found::Other(key)) => return Ok(Some(key)),
                Some(Found::Flow(constant)) => {
                    let value = self
                        .map
                        .next_value_seed(ValueSeed::<W>(constant, PhantomData))?;
                    self.flow.values.push((constant, value));
                }
            }
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(
        &mut self,
        seed: V,
    ) -> std::result::Result<V::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}

/// A key of a table.
enum Found<T> {
    Flow(Constant),
    Other(T),
}

/// Reads a key; `seed` is used up by one that is no constant's.
struct KeySeed<'a, K, W> {
    seed: &'a mut Option<K>,
    spelling: PhantomData<W>,
}

impl<'de, K: DeserializeSeed<'de>, W: Spelling> DeserializeSeed<'de> for KeySeed<'_, K, W> {
    type Value = Found<K::Value>;

    fn deserialize<D: Deserializer<'de>>(
        self,
        from: D,
    ) -> std::result::Result<Self::Value, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl<'de, K: DeserializeSeed<'de>, W: Spelling> Visitor<'de> for KeySeed<'_, K, W> {
    type Value = Found<K::Value>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, key: &str) -> std::result::Result<Self::Value, E> {
        let constants = Flow::all_constants();
        if let Some(constant) = constants.iter().find(|c| W::key(c) == key) {
            return Ok(Found::Flow(*constant));
        }
        let seed = self
            .seed
            .take()
            .ok_or_else(|| E::custom("a key read twice"))?;
        let other = seed.deserialize(StrDeserializer::<E>::new(key));
        other.map(Found::Other).map_err(|error| {
            let keys: Vec<String> = constants
                .iter()
                .map(|c| format!("`{}`", W::key(c)))
                .collect();
            E::custom(format!(
                "{}, {}",
                error.to_string().trim_end(),
                keys.join(", ")
            ))
        })
    }
}

/// Reads the value of a constant.
struct ValueSeed<W>(Constant, PhantomData<W>);

impl<'de, W: Spelling> DeserializeSeed<'de> for ValueSeed<W> {
    type Value = W::Value;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> std::result::Result<W::Value, D::Error> {
        W::read(&self.0, from)
    }
}
