//! Materials by name: constants with their sources, as files of `models/constants/` that the program carries with it.

use super::MaterialTable;
use crate::Result;
use crate::document::Document;
use crate::document::keys::{Kind, Value, key, keys, table};
use crate::material::Material;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use std::fmt;
use std::path::PathBuf;

/// Names and texts from one list.
macro_rules! materials {
    ($($name:literal),+ $(,)?) => {
        /// Materials that a case can name.
        pub const NAMES: &[&str] = &[$($name),+];

        fn text(name: &str) -> Option<&'static str> {
            match name {
                $($name => Some(include_str!(concat!("../../models/constants/", $name, ".toml"))),)+
                _ => None,
            }
        }
    };
}

materials! {
    "ofhc-copper",
    "ofhc-copper-static",
    "ofhc-copper-taylor",
    "steel-4340",
}

/// What a case file holds for its material: constants, or a name.
#[derive(Debug)]
pub(super) enum Given {
    Table(Box<MaterialTable>),
    Name(String),
}

impl Value for Given {
    fn kind() -> Kind {
        Kind::Either(Box::new(MaterialTable::kind()), Box::new(Kind::Name(NAMES)))
    }
}

impl<'de> Deserialize<'de> for Given {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        from.deserialize_any(GivenVisitor)
    }
}

struct GivenVisitor;

impl<'de> Visitor<'de> for GivenVisitor {
    type Value = Given;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a table, or the name of a material in quotes")
    }

    fn visit_str<E: Error>(self, name: &str) -> std::result::Result<Given, E> {
        Ok(Given::Name(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> std::result::Result<Given, A::Error> {
        let table = MaterialTable::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Given::Table(Box::new(table)))
    }
}

/// A file of `models/constants/`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialFile {
    source: String,
    material: MaterialTable,
}

keys! {
    MaterialFile {
        source: key("where its constants are printed", "not empty", "'Johnson and Cook 1983'"),
        material: table("its constants"),
    }
}

impl Given {
    /// The material under the dotted key `at`, SI units.
    ///
    /// # Errors
    /// Those of its constants, and [`crate::Error::Value`] for a name that is none.
    pub(super) fn check(self, document: &Document, at: &str) -> Result<Material> {
        match self {
            Given::Table(table) => table.others.check(&table.flow, document, at),
            Given::Name(name) => match of_name(&name) {
                Some(found) => found.map(|(material, _)| material),
                None => {
                    let allowed = format!("must be a table, or one of {}", NAMES.join(", "));
                    Err(document.reject(at, allowed))
                }
            },
        }
    }
}

/// A material by name, with the source of its constants; `None` for a name that is none.
#[must_use]
pub fn of_name(name: &str) -> Option<Result<(Material, String)>> {
    let text = text(name)?;
    let path = PathBuf::from(format!("models/constants/{name}.toml"));
    Some(read(&Document::new(&path, text)))
}

fn read(document: &Document) -> Result<(Material, String)> {
    let MaterialFile { source, material } = document.parse()?;
    if source.trim().is_empty() {
        return Err(document.reject("source", "must say where the constants are printed"));
    }
    let material = material
        .others
        .check(&material.flow, document, "material")?;
    Ok((material, source))
}
