//! Command line: what holds for every verb, and the verb. Verbs are the arrows of the data flow.

use crate::command::Verb;
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser};
use std::ffi::OsString;

/// Contact laws for discrete-element codes, from simulated impacts of yielding particles.
#[derive(Debug, Parser)]
#[command(
    version,
    about,
    propagate_version = true,
    disable_help_subcommand = true
)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
    /// Worker threads (0: all cores). Results do not depend on it.
    #[arg(long, global = true, default_value_t = 0)]
    pub threads: usize,
    /// More output: -v progress of every stage, -vv solver detail.
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Print errors only.
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
}

/// The command line, parsed.
///
/// # Errors
/// clap's, with the verbs that are one slip of the finger from an unknown one: clap itself measures likeness by letters in
/// place, which finds nothing for two letters of a short word that are swapped.
pub fn parsed(words: impl Iterator<Item = OsString>) -> Result<Cli, clap::Error> {
    Cli::try_parse_from(words).map_err(|mut error| {
        let Some(ContextValue::String(found)) = error.get(ContextKind::InvalidSubcommand) else {
            return error;
        };
        let root = Cli::command();
        let verbs = root.get_subcommands().map(clap::Command::get_name);
        let near = verbs.filter(|verb| strsim::osa_distance(verb, found) == 1);
        let near: Vec<String> = near.map(str::to_owned).collect();
        if error.get(ContextKind::SuggestedSubcommand).is_none() && !near.is_empty() {
            let near = ContextValue::Strings(near);
            error.insert(ContextKind::SuggestedSubcommand, near);
        }
        error
    })
}
