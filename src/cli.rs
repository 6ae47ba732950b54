//! Command line: what holds for every verb, and the verb. Verbs are the arrows of the data flow.

use crate::command::Verb;
use clap::Parser;

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
