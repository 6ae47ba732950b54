//! A file of another kind than a verb reads: said as what it is, with the verb that reads it.

use super::quoted;
use super::schema::{FILES, FileKind};
use crate::document::keys::Kind;
use crate::document::misfit::misfits;
use crate::{Error, Place};
use std::io::ErrorKind;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// `error`, or, where its file fits another kind of input file better than the one it was read as, what the file is.
#[must_use]
pub fn named(error: Error) -> Error {
    if let Some(refused) = no_toml(&error) {
        return refused;
    }
    let (Error::Value { path, place, .. } | Error::Syntax { path, place, .. }) = &error else {
        return error;
    };
    let Some((wanted, found)) = place.as_deref().and_then(other) else {
        return error;
    };
    let file = quoted(&path.to_string_lossy());
    Error::Refused {
        what: path.display().to_string(),
        found: with_article(found.name),
        allowed: format!(
            "must be {}; this one goes to `{}`",
            with_article(wanted.name),
            found.next.replace("FILE", &file)
        ),
    }
}

/// Name of the kind of input file that was read as another one with this error.
#[must_use]
pub fn kind_of(error: &Error) -> Option<&'static str> {
    let (Error::Value { place, .. } | Error::Syntax { place, .. }) = error else {
        return None;
    };
    let (_, found) = place.as_deref().and_then(other)?;
    Some(found.name)
}

/// What a file is that is no TOML file by its name and cannot be read as one.
fn no_toml(error: &Error) -> Option<Error> {
    let mesh = |path: &Path| {
        let ending = path.extension().unwrap_or_default();
        ["stl", "obj"]
            .iter()
            .any(|mesh| ending.eq_ignore_ascii_case(mesh))
    };
    let path = match error {
        // what a run wrote is read without a place in its text
        Error::Syntax {
            path,
            place: Some(_),
            ..
        } => path,
        // files of runs are called damaged by those who read them
        Error::File { path, source, .. } if source.kind() == ErrorKind::InvalidData => {
            Some(path).filter(|path| mesh(path))?
        }
        _ => return None,
    };
    let ending = path.extension()?.to_string_lossy();
    (!ending.eq_ignore_ascii_case("toml")).then(|| Error::Refused {
        what: path.display().to_string(),
        found: format!("a file that ends in .{ending} and is no TOML"),
        allowed: format!(
            "must be a TOML file: {}",
            FILES.map(|kind| kind.name).join(", ")
        ),
    })
}

/// `a case file`, `an equations file`.
fn with_article(name: &str) -> String {
    let article = match name.starts_with(['a', 'e', 'i', 'o', 'u']) {
        true => "an",
        false => "a",
    };
    format!("{article} {name} file")
}

/// The kind that the text was read as and the one it is of, if they differ.
fn other(place: &Place) -> Option<(FileKind, FileKind)> {
    let table = DeTable::parse(&place.text).ok()?.into_inner();
    let wanted = FILES
        .into_iter()
        .find(|kind| kind.table().names() == place.reader)?;
    let own = |kind: &FileKind| {
        let known = kind.table();
        table
            .keys()
            .filter(|key| known.key(key.get_ref()).is_some())
            .count()
    };
    let half = table.len().div_ceil(2);
    let value = DeValue::Table(table.clone());
    let wrong = |kind: &FileKind| misfits(&Kind::Table(kind.table()), &value);
    let found = FILES.into_iter().min_by_key(wrong)?;
    let better = wrong(&found) < wrong(&wanted) && own(&found) >= half.max(1);
    better.then_some((wanted, found))
}
