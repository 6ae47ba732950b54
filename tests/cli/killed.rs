//! Runs killed on their way: stopped once they have been kept, and called again.

use crate::program::message;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Runs the command until the file `kept` is there, and kills it then.
pub fn kill_once_kept(mut command: Command, kept: &Path) {
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let started = Instant::now();
    while !kept.is_file() {
        assert!(
            child.try_wait().unwrap().is_none(),
            "ended before it was kept"
        );
        assert!(started.elapsed() < Duration::from_secs(120), "never kept");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Runs the command to its end; whether it resumed from what had been kept.
pub fn was_resumed(mut command: Command) -> bool {
    let output = command.output().unwrap();
    let said = message(&output);
    assert!(output.status.success(), "{said}");
    said.contains("resumed at step")
}

/// A results file without its first line, which names the command.
pub fn body(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    text.split_once('\n').unwrap().1.to_owned()
}
