//! Keys: what an input file may hold, described beside the types that read it.
//!
//! [`Document::parse`](super::Document::parse) reads nothing but a [`Value`], and a table becomes one through `keys!` alone, which
//! takes the type apart field by field: a key without its line does not compile. JSON schema, reference, help and what errors
//! say of a key are written from these lines.

use crate::unit::{self, Quantity, Units};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Something a file may hold.
pub trait Value {
    /// What it is.
    fn kind() -> Kind;
}

/// What a file may hold in one place.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A number without unit.
    Number,
    /// A whole number.
    Whole,
    /// True or false.
    Truth,
    /// Any text.
    Text,
    /// One of a few names.
    Name(&'static [&'static str]),
    /// Number and unit as text.
    Quantity(Units),
    /// A list of any length.
    List(Box<Kind>),
    /// A list of so many.
    Array(usize, Box<Kind>),
    /// A table.
    Table(Table),
    /// Tables under names of the user's own.
    Named(Table),
    /// A table, or a list of them.
    OneOrMany(Table),
    /// A table whose other keys depend on the name that stands under a first one.
    Variants(&'static str, Vec<(&'static str, Table)>),
    /// One or the other.
    Either(Box<Kind>, Box<Kind>),
    /// A value, a list of values, or a range `{ from = A, to = B, scale = "log" }`.
    Axis(Box<Kind>),
}

/// Keys of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// What there is to say of the table as a whole; often nothing.
    pub about: &'static str,
    /// Its keys, in the order of the reference.
    pub keys: Vec<Key>,
}

/// A key of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Its name in the file.
    pub name: String,
    /// What may stand there.
    pub kind: Kind,
    /// Its line in the reference.
    pub line: Line,
}

/// What the reference says of a key beside its kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What it means.
    pub meaning: &'static str,
    /// Allowed values: an interval (`[0, 0.5)`, `> 0`, `8 to 1000`) or words; empty where the kind says it all.
    pub range: &'static str,
    /// A value as the file spells it; empty for a table.
    pub example: Cow<'static, str>,
    /// What holds where the key is absent; `None` for a key that must be there.
    pub default: Option<&'static str>,
}

/// Line of a key that must be there. Single quotes in the example stand for double ones.
#[must_use]
pub const fn key(meaning: &'static str, range: &'static str, example: &'static str) -> Line {
    Line {
        meaning,
        range,
        example: Cow::Borrowed(example),
        default: None,
    }
}

/// Line of a key that holds a table and must be there.
#[must_use]
pub const fn table(meaning: &'static str) -> Line {
    key(meaning, "", "")
}

impl Line {
    /// The same line for a key that may be absent, with what holds then.
    #[must_use]
    pub fn or(self, default: &'static str) -> Self {
        Line {
            default: Some(default),
            ..self
        }
    }

    /// The same line with a range that the kind does not say.
    #[must_use]
    pub fn within(self, range: &'static str) -> Self {
        Line { range, ..self }
    }

    /// The example as a file spells it.
    #[must_use]
    pub fn example(&self) -> String {
        self.example.replace('\'', "\"")
    }
}

impl Table {
    /// The names of its keys.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.keys.iter().map(|key| key.name.clone()).collect()
    }

    /// The key called `name`.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<&Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}

impl Kind {
    /// The table that stands here, once or several times, with the lines that choose it; one a variant.
    #[must_use]
    pub fn tables(&self) -> Vec<(Option<(&'static str, &'static str)>, &Table)> {
        match self {
            Kind::Table(table) | Kind::Named(table) | Kind::OneOrMany(table) => vec![(None, table)],
            Kind::List(inner) => inner.tables(),
            Kind::Either(one, other) => [one.tables(), other.tables()].concat(),
            Kind::Variants(tag, variants) => variants
                .iter()
                .map(|(name, table)| (Some((*tag, *name)), table))
                .collect(),
            _ => Vec::new(),
        }
    }

    /// The key at a dotted path such as `stage[0].move[1].body`; `None` where there is none, or more than one.
    #[must_use]
    pub fn at(&self, path: &str) -> Option<&Key> {
        let split = |path| str::split_once(path, '.').unwrap_or((path, ""));
        let (first, rest) = match self {
            // a name of the user's own stands before the keys
            Kind::Named(_) => split(split(path).1),
            _ => split(path),
        };
        let name = first.split('[').next().unwrap_or(first);
        let tables = self.tables();
        let mut found = tables.iter().filter_map(|(_, table)| {
            let key = table.key(name)?;
            match rest {
                "" => Some(key),
                rest => key.kind.at(rest),
            }
        });
        let key = found.next()?;
        found.next().is_none().then_some(key)
    }
}

impl Value for f64 {
    fn kind() -> Kind {
        Kind::Number
    }
}

impl Value for bool {
    fn kind() -> Kind {
        Kind::Truth
    }
}

impl Value for String {
    fn kind() -> Kind {
        Kind::Text
    }
}

/// Whole numbers of any width.
macro_rules! whole {
    ($($width:ty),+) => {$(
        impl Value for $width {
            fn kind() -> Kind {
                Kind::Whole
            }
        }
    )+};
}
whole!(u32, u64, usize, i64);

impl<D: unit::Dimension> Value for Quantity<D> {
    fn kind() -> Kind {
        Kind::Quantity(Units::of::<D>())
    }
}

impl<T: Value> Value for Option<T> {
    fn kind() -> Kind {
        T::kind()
    }
}

impl<T: Value> Value for Box<T> {
    fn kind() -> Kind {
        T::kind()
    }
}

impl<T: Value> Value for Vec<T> {
    fn kind() -> Kind {
        Kind::List(Box::new(T::kind()))
    }
}

impl<T: Value, const N: usize> Value for [T; N] {
    fn kind() -> Kind {
        Kind::Array(N, Box::new(T::kind()))
    }
}

impl<T: Value> Value for BTreeMap<String, T> {
    fn kind() -> Kind {
        match T::kind() {
            Kind::Table(table) => Kind::Named(table),
            other => other,
        }
    }
}

/// Kind of the field that `_field` reaches.
pub fn kind_of<S, T: Value>(_field: fn(&S) -> Option<&T>) -> Kind {
    T::kind()
}

/// Describes the keys of a table or of an enumeration, in place of documentation of its fields.
///
/// `keys! { ParticleTable { radius: key("radius of the sphere", "> 0", "'250 um'"), } }`: every field, with `as "name"` where
/// the file has another name for it. `names!` describes an enumeration of names.
macro_rules! keys {
    ($table:ident $($about:literal)? { $($field:ident $(as $name:literal)?: $line:expr,)* }) => {
        impl $crate::document::keys::Value for $table {
            fn kind() -> $crate::document::keys::Kind {
                // a field without a line does not compile
                let _ = |$table { $($field: _,)* }: &$table| ();
                $crate::document::keys::Kind::Table($crate::document::keys::Table {
                    about: concat!($($about)?),
                    keys: vec![$($crate::document::keys::Key {
                        name: $crate::document::keys::keys!(@name $field $($name)?).to_owned(),
                        kind: $crate::document::keys::kind_of(|table: &$table| Some(&table.$field)),
                        line: $line,
                    }),*],
                })
            }
        }
    };
    (
        enum $table:ident by $tag:literal {
            $($variant:ident as $title:literal $about:literal { $($field:ident: $line:expr,)* })*
        } and {
            $($other:ident as $other_title:literal ($inner:ty))*
        }
    ) => {
        impl $crate::document::keys::Value for $table {
            fn kind() -> $crate::document::keys::Kind {
                use $crate::document::keys::{Key, Kind, Table, kind_of};
                // a variant, or a field of one, without a line does not compile
                let _ = |table: &$table| match table {
                    $($table::$variant { $($field: _,)* } => (),)*
                    $($table::$other(_) => (),)*
                };
                let variants = vec![$(($title, Table {
                    about: $about,
                    keys: vec![$(Key {
                        name: stringify!($field).to_owned(),
                        kind: kind_of(|table: &$table| match table {
                            $table::$variant { $field, .. } => Some($field),
                            _ => None,
                        }),
                        line: $line,
                    }),*],
                })),*];
                let others = [$(($other_title, <$inner as $crate::document::keys::Value>::kind())),*];
                let others = others.into_iter().filter_map(|(title, kind): (_, Kind)| match kind {
                    Kind::Table(table) => Some((title, table)),
                    _ => None,
                });
                Kind::Variants($tag, variants.into_iter().chain(others).collect())
            }
        }
    };
    (@name $field:ident) => { stringify!($field) };
    (@name $field:ident $name:literal) => { $name };
}
pub(crate) use keys;

/// Describes an enumeration of names.
macro_rules! names {
    ($names:ident { $($variant:ident as $name:literal,)+ }) => {
        impl $crate::document::keys::Value for $names {
            fn kind() -> $crate::document::keys::Kind {
                let _ = |name: &$names| match name {
                    $($names::$variant => (),)+
                };
                $crate::document::keys::Kind::Name(&[$($name),+])
            }
        }
    };
}
pub(crate) use names;
