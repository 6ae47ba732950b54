//! Program entry: parse, dispatch, print the error, exit code (0 ok, 1 a result fails a stated threshold, 2 could not run).

use clap::CommandFactory;
use impactlaw::cli::{Cli, parsed};
use impactlaw::command::log::Tee;
use impactlaw::command::{Context, Verdict, diagnostic};
use impactlaw::{Error, Result};
use std::io::{IsTerminal, Write};
use std::process::ExitCode;
use tracing::Level;

fn main() -> ExitCode {
    let cli = parsed(std::env::args_os()).unwrap_or_else(|error| error.exit());
    trace(&cli);
    let context = Context::of_process(cli.quiet, Cli::command);
    let outcome = start_threads(cli.threads).and_then(|()| cli.verb.run(&context));
    context.log.close(&outcome);
    match outcome {
        Ok(Verdict::Met) => ExitCode::SUCCESS,
        Ok(Verdict::Missed) => ExitCode::from(1),
        Err(error) => {
            // a device that is full leaves nobody to tell
            let _ = write!(std::io::stderr(), "{}", diagnostic::text(&error));
            ExitCode::from(2)
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
        .init();
}
