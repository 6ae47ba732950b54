//! Words: keywords of Python as the text of a case file, which the one reader of case files checks.

use crate::array::{magnitude, shown, si};
use crate::border::{raised, refused};
use impactlaw::Error;
use impactlaw::case::Case;
use impactlaw::document::keys::Kind;
use impactlaw::unit::Units;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyComplex, PyDict, PyFloat, PyInt, PyString};
use toml::{Table, Value};

/// Text of the case file that holds these keywords: names of the file's keys, at its top or in its tables.
pub fn case_text(keywords: &Bound<'_, PyDict>) -> PyResult<String> {
    let py = keywords.py();
    let root = Case::keys();
    let mut file = Table::new();
    for (name, given) in keywords {
        let name = name.extract::<String>()?;
        if given.is_none() {
            continue;
        }
        let Some((table, kind)) = place(&root, &name) else {
            return Err(raised(
                py,
                Error::not_one_of("keyword", &name, names(&root)),
            ));
        };
        let value = value(&name, &given, Some(&kind))?;
        let Some(table) = table else {
            file.insert(name, value);
            continue;
        };
        let there = file.entry(&table).or_insert_with(|| Table::new().into());
        let Some(there) = there.as_table_mut() else {
            let allowed = "must be left out: the name of the material says it";
            return Err(raised(py, refused(&name, shown(&given), allowed)));
        };
        there.insert(name, value);
    }
    Ok(file.to_string())
}

/// Table and kind of the key called `name`; no table for what stands at the top.
fn place(root: &Kind, name: &str) -> Option<(Option<String>, Kind)> {
    let tables = root.tables();
    let (_, top) = tables.first()?;
    if let Some(key) = top.key(name) {
        return Some((None, key.kind.clone()));
    }
    top.keys.iter().find_map(|table| {
        let key = table.kind.at(name)?;
        Some((Some(table.name.clone()), key.kind.clone()))
    })
}

/// Every keyword.
fn names(root: &Kind) -> Vec<String> {
    let tables = root.tables();
    let top = tables.iter().flat_map(|(_, table)| &table.keys);
    let mut names = Vec::new();
    for key in top {
        let below: Vec<String> = key
            .kind
            .tables()
            .iter()
            .flat_map(|(_, t)| t.names())
            .collect();
        match below.is_empty() {
            true => names.push(key.name.clone()),
            false => names.extend(below),
        }
    }
    let mut seen = std::collections::HashSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

/// What was given, as the file has it: numbers get the SI unit of the key.
fn value(name: &str, given: &Bound<'_, PyAny>, kind: Option<&Kind>) -> PyResult<Value> {
    if let (Some(Kind::List(inner)), true) = (kind, given.is_instance_of::<PyString>()) {
        return Ok(Value::Array(vec![value(name, given, Some(inner))?]));
    }
    if let Ok(text) = given.cast::<PyString>() {
        return Ok(Value::String(text.to_string_lossy().into_owned()));
    }
    if let Some(units) = kind.and_then(|kind| quantity(inner(kind)))
        && let Some(magnitude) = magnitude(name, given, &units)?
    {
        return value(name, &magnitude, kind);
    }
    if let Ok(truth) = given.cast::<PyBool>() {
        return Ok(Value::Boolean(truth.is_true()));
    }
    if let Ok(table) = given.cast::<PyDict>() {
        let mut values = Table::new();
        for (key, given) in table {
            let key = key.str()?.to_string();
            let below = kind.and_then(|kind| kind.at(&key)).map(|key| &key.kind);
            values.insert(key.clone(), value(&key, &given, below)?);
        }
        return Ok(values.into());
    }
    let is_float = given.is_instance_of::<PyFloat>();
    let is_number = given.hasattr("__float__")? && !given.hasattr("__len__")?;
    let is_number = is_number && !given.is_instance_of::<PyComplex>();
    if is_float || given.is_instance_of::<PyInt>() || is_number {
        return scalar(name, given, kind, is_float);
    }
    if given.hasattr("__fspath__")? {
        let path = given.call_method0("__fspath__")?;
        return Ok(Value::String(path.str()?.to_string()));
    }
    let items = given.try_iter().map_err(|_| {
        let allowed = "must be a number, a text, a list or a dict";
        raised(given.py(), refused(name, shown(given), allowed))
    })?;
    let inner = kind.map(inner);
    let items = items.map(|item| value(name, &item?, inner));
    Ok(Value::Array(items.collect::<PyResult<_>>()?))
}

/// A number; one where a list belongs is a list of one.
fn scalar(
    name: &str,
    given: &Bound<'_, PyAny>,
    kind: Option<&Kind>,
    is_float: bool,
) -> PyResult<Value> {
    if let Some(Kind::List(inner)) = kind {
        return Ok(Value::Array(vec![scalar(
            name,
            given,
            Some(inner),
            is_float,
        )?]));
    }
    if let Some(units) = kind.and_then(quantity) {
        let number = given
            .extract::<f64>()
            .map_err(|_| raised(given.py(), refused(name, shown(given), "must be a number")))?;
        return Ok(Value::String(format!("{number:?} {}", si(&units))));
    }
    let whole = (!is_float).then(|| given.extract::<i64>().ok()).flatten();
    match (whole, kind) {
        (Some(whole), Some(Kind::Number)) => Ok(Value::Float(whole as f64)),
        (Some(whole), _) => Ok(Value::Integer(whole)),
        (None, _) => given
            .extract::<f64>()
            .map(Value::Float)
            .map_err(|_| raised(given.py(), refused(name, shown(given), "must be a number"))),
    }
}

/// Kind of the items of a list.
fn inner(kind: &Kind) -> &Kind {
    match kind {
        Kind::List(inner) | Kind::Array(_, inner) | Kind::Axis(inner) => inner,
        kind => kind,
    }
}

/// The dimension of a key that holds a quantity.
fn quantity(kind: &Kind) -> Option<Units> {
    match kind {
        Kind::Quantity(units) => Some(*units),
        Kind::Axis(inner) => quantity(inner),
        Kind::Either(one, other) => quantity(one).or_else(|| quantity(other)),
        _ => None,
    }
}
