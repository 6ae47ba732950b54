//! Values: what the library writes for programs, as Python objects: JSON as dicts, rows of tables as columns.

use crate::array::{floats, wholes};
use crate::border::raised;
use impactlaw::Error;
use impactlaw::files::rows_text;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString};
use serde::Serialize;
use serde_json::Value;
use std::path::Path;

/// A value as an object: what is null, a number that a run could not find, is NaN.
pub fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => PyFloat::new(py, f64::NAN).into_any(),
        Value::Bool(truth) => PyBool::new(py, *truth).to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64()) {
            (Some(whole), _) => PyInt::new(py, whole).into_any(),
            (_, Some(whole)) => PyInt::new(py, whole).into_any(),
            _ => PyFloat::new(py, number.as_f64().unwrap_or(f64::NAN)).into_any(),
        },
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Array(items) => {
            let list = PyList::empty(py);
            for item in items {
                list.append(object(py, item)?)?;
            }
            list.into_any()
        }
        Value::Object(fields) => {
            let dict = PyDict::new(py);
            for (name, field) in fields {
                dict.set_item(name, object(py, field)?)?;
            }
            dict.into_any()
        }
    })
}

/// What `value` is in files for programs, as an object.
pub fn written<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let value = serde_json::to_value(value).map_err(|why| unreadable(py, why.into()))?;
    object(py, &value)
}

/// What of `rows` is a number in each of them, as columns by the names they have in files for programs.
pub fn numbers<'py, 'a, R: Serialize + 'a>(
    py: Python<'py>,
    rows: impl Iterator<Item = &'a R>,
) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<Value> = rows
        .map(serde_json::to_value)
        .collect::<Result<_, _>>()
        .map_err(|why| unreadable(py, why.into()))?;
    let columns = PyDict::new(py);
    let names = rows.first().and_then(Value::as_object);
    for name in names.into_iter().flat_map(serde_json::Map::keys) {
        let number = |row: &Value| match &row[name] {
            Value::Null => Some(f64::NAN),
            value => value.as_f64(),
        };
        if let Some(column) = rows.iter().map(number).collect() {
            columns.set_item(name, floats(py, column)?)?;
        }
    }
    Ok(columns)
}

fn unreadable(py: Python<'_>, why: std::io::Error) -> PyErr {
    raised(py, Error::file("read", Path::new("a table"))(why))
}

/// Rows as a dict of columns by the names they have in files, in their order.
pub fn columns<'py, R: Serialize>(py: Python<'py>, rows: &[R]) -> PyResult<Bound<'py, PyDict>> {
    let text = rows_text("", rows).map_err(|why| unreadable(py, why))?;
    columns_of_text(py, &text)
}

/// The columns of a CSV text: whole numbers, floats (nothing is NaN), or a list of texts.
pub fn columns_of_text<'py>(py: Python<'py>, text: &[u8]) -> PyResult<Bound<'py, PyDict>> {
    let wrong = |why: csv::Error| unreadable(py, why.into());
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text);
    let names = reader.headers().map_err(wrong)?.clone();
    let mut cells: Vec<Vec<String>> = vec![Vec::new(); names.len()];
    for row in reader.records() {
        for (column, cell) in cells.iter_mut().zip(&row.map_err(wrong)?) {
            column.push(cell.to_owned());
        }
    }
    let columns = PyDict::new(py);
    for (name, cells) in names.iter().zip(&cells) {
        columns.set_item(name, column(py, cells)?)?;
    }
    Ok(columns)
}

fn column<'py>(py: Python<'py>, cells: &[String]) -> PyResult<Bound<'py, PyAny>> {
    let whole: Option<Vec<i64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
    if let Some(whole) = whole.filter(|whole| !whole.is_empty()) {
        return wholes(py, whole);
    }
    let number = |cell: &String| match cell.as_str() {
        "" => Some(f64::NAN),
        cell => cell.parse().ok(),
    };
    let numbers: Option<Vec<f64>> = cells.iter().map(number).collect();
    match numbers {
        Some(numbers) => floats(py, numbers),
        None => Ok(PyList::new(py, cells)?.into_any()),
    }
}
