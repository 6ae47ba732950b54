//! Misfit: in how many places a text is not what a kind of file holds, to tell which kind it is of.

use super::keys::{Kind, Table};
use toml::de::{DeTable, DeValue};

/// Number of places in `value` that `kind` does not take: unknown keys and values of another
/// type. What is missing is no sign: a slip in a key is one more key missing.
#[must_use]
pub fn misfits(kind: &Kind, value: &DeValue) -> usize {
    match (kind, value) {
        (Kind::Number, DeValue::Integer(_) | DeValue::Float(_))
        | (Kind::Whole, DeValue::Integer(_))
        | (Kind::Truth, DeValue::Boolean(_))
        | (Kind::Text | Kind::Name(_) | Kind::Quantity(_), DeValue::String(_)) => 0,
        (Kind::List(item) | Kind::Array(_, item), DeValue::Array(items)) => {
            items.iter().map(|one| misfits(item, one.get_ref())).sum()
        }
        // brackets left out are a slip, and no sign of another kind of file
        (Kind::List(item), value) => misfits(item, value),
        (Kind::Axis(item), DeValue::Array(items)) => {
            items.iter().map(|one| misfits(item, one.get_ref())).sum()
        }
        (Kind::Axis(item), DeValue::Table(ends)) => ends
            .values()
            .filter(|end| misfits(item, end.get_ref()) > 0)
            .count()
            .saturating_sub(usize::from(ends.contains_key("scale"))),
        (Kind::Axis(item), value) => misfits(item, value),
        (Kind::Table(table) | Kind::OneOrMany(table), DeValue::Table(entries)) => {
            in_table(table, entries, "")
        }
        (Kind::OneOrMany(table), DeValue::Array(items)) => {
            let kind = Kind::Table(table.clone());
            items.iter().map(|one| misfits(&kind, one.get_ref())).sum()
        }
        (Kind::Named(table), DeValue::Table(entries)) => {
            let kind = Kind::Table(table.clone());
            entries
                .values()
                .map(|one| misfits(&kind, one.get_ref()))
                .sum()
        }
        (Kind::Variants(tag, variants), DeValue::Table(entries)) => {
            let name = entries.get(*tag).and_then(|name| name.get_ref().as_str());
            let chosen = variants.iter().find(|(title, _)| Some(*title) == name);
            chosen.map_or(1, |(_, table)| in_table(table, entries, tag))
        }
        (Kind::Either(one, other), value) => misfits(one, value).min(misfits(other, value)),
        _ => 1,
    }
}

/// The same within a table in which `tag`, if it is not empty, chose the keys.
fn in_table(table: &Table, entries: &DeTable, tag: &str) -> usize {
    entries
        .iter()
        .filter(|(name, _)| name.get_ref() != tag)
        .map(|(name, value)| match table.key(name.get_ref()) {
            Some(key) => misfits(&key.kind, value.get_ref()),
            None => 1,
        })
        .sum()
}
