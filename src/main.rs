//! Program entry.

use std::process::ExitCode;

fn main() -> ExitCode {
    impactlaw::cli::main(std::env::args_os().collect()).into()
}
