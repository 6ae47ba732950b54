//! Program: the command line in the extension, and verbs whose files become columns.

use crate::border::{Error, short};
use crate::values::columns_of_text;
use clap::CommandFactory;
use impactlaw::PROGRAM;
use impactlaw::cli::{Cli, parsed};
use impactlaw::command::{Context, Verdict};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ffi::OsString;
use std::path::PathBuf;

/// The command line: `words` with the program's name first. Returns the exit code.
#[pyfunction]
pub fn main(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| impactlaw::cli::main(words))
}

/// Does what a command line asks for and says nothing; True if every stated threshold is met.
#[pyfunction]
pub fn verb(py: Python<'_>, words: Vec<OsString>) -> PyResult<bool> {
    let cli = parsed(words.iter().cloned()).map_err(|why| Error::new_err(why.to_string()))?;
    let verdict = short(py, || {
        let context = Context::of(&words, true, Cli::command);
        let outcome = cli.verb.run(&context);
        context.log.close(&outcome);
        outcome
    })?;
    Ok(verdict == Verdict::Met)
}

/// Columns of a CSV file that the program wrote.
#[pyfunction]
pub fn columns_of(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let text = short(py, || {
        std::fs::read(&path).map_err(impactlaw::Error::file("read", &path))
    })?;
    columns_of_text(py, &text)
}

/// Falls, as the library would if it had a fault: what must not cross the border.
#[pyfunction]
pub fn fall(py: Python<'_>, text: &str) -> PyResult<()> {
    short(py, || panic!("{text}"))
}

/// Name and version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    PROGRAM
}
