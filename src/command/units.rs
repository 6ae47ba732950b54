//! `units`: the units that quantities may have, by dimension.

use super::{Command, Context, Verdict, print};
use crate::Result;
use crate::unit::DIMENSIONS;
use clap::Args;

/// Print the units of every dimension, with an example.
#[derive(Debug, Args)]
pub struct UnitsArgs {}

impl Command for UnitsArgs {
    const EXAMPLES: &'static [&'static str] =
        &["impactlaw units", "impactlaw units | grep pressure"];

    /// Print the list that the readers themselves use.
    ///
    /// # Errors
    /// As [`print()`].
    fn run(&self, _context: &Context) -> Result<Verdict> {
        print(&table())?;
        Ok(Verdict::Met)
    }
}

/// One line a dimension: name, example, units.
#[must_use]
pub fn table() -> String {
    let line = |units: &crate::unit::Units| {
        let example = format!("\"{}\"", units.example);
        format!(
            "{:<18} {example:<16} {}\n",
            units.noun(),
            units.units.join(", ")
        )
    };
    DIMENSIONS.iter().map(line).collect()
}
