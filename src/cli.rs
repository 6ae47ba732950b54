//! Command line: what holds for every verb, and the verb. Verbs are the arrows of the data flow.

use crate::command::log::Tee;
use crate::command::{Context, Verb, Verdict, diagnostic};
use crate::{Error, Result};
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser};
use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use tracing::Level;

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
pub fn parsed(words: impl Iterator<Item = OsString>) -> std::result::Result<Cli, clap::Error> {
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

/// The program: parses `words`, its own name first, does what they ask for, prints the error if there is one. Returns the exit
/// code: 0 ok, 1 a result fails a stated threshold, 2 could not run.
#[must_use]
pub fn main(words: Vec<OsString>) -> u8 {
    let cli = match parsed(words.iter().cloned()) {
        Ok(cli) => cli,
        Err(error) => {
            // a device that is full leaves nobody to tell
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(2);
        }
    };
    trace(&cli);
    let context = Context::of(&words, cli.quiet, Cli::command);
    let outcome = start_threads(cli.threads).and_then(|()| cli.verb.run(&context));
    context.log.close(&outcome);
    match outcome {
        Ok(Verdict::Met) => 0,
        Ok(Verdict::Missed) => 1,
        Err(error) => {
            let _ = write!(std::io::stderr(), "{}", diagnostic::text(&error));
            2
        }
    }
}

/// Most worker threads: more only take time to start.
const MOST_THREADS: usize = 1024;

/// Worker threads; 0 is one a core.
fn start_threads(threads: usize) -> Result<()> {
    if threads > MOST_THREADS {
        return Err(Error::Argument {
            argument: "--threads".to_owned(),
            found: threads.to_string(),
            allowed: format!("must be at most {MOST_THREADS}; 0 is one a core"),
        });
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| Error::Argument {
            argument: "--threads".to_owned(),
            found: format!("{threads} ({error})"),
            allowed: "must be a number of threads the system can start".to_owned(),
        })
}

/// What is said on stderr besides progress: warnings, with -v what stages do, with -vv solver detail.
fn trace(cli: &Cli) {
    let level = match (cli.quiet, cli.verbose) {
        // what is not said stands in the log all the same
        (true, _) | (_, 0) => Level::WARN,
        (_, 1) => Level::INFO,
        _ => Level::DEBUG,
    };
    let quiet = cli.quiet;
    tracing_subscriber::fmt()
        .with_max_level(level)
        .with_writer(move || Tee { quiet })
        .with_ansi(std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none())
        .with_target(false)
        // it would be told of on stderr, which is what could not be written, and panic
        .log_internal_errors(false)
        .without_time()
        .try_init()
        // a process that hosts the program may listen already
        .ok();
}
