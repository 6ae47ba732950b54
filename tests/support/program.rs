//! The program as a user starts it.

use std::path::Path;
use std::process::{Command, Output};

/// `impactlaw` to be started in `folder`, its messages without colours.
pub fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_impactlaw"));
    command.current_dir(folder).env("NO_COLOR", "1");
    command
}

/// `impactlaw` run to its end in `folder`.
pub fn impactlaw(folder: &Path, arguments: &[&str]) -> Output {
    program(folder).args(arguments).output().unwrap()
}

/// Standard error as one line: line breaks and the drawing characters of the snippet taken out.
pub fn message(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let words = text.replace(['│', '×', '╭', '╰', '─', '·', '╷', '▶'], " ");
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}
