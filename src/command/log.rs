//! Log of a run, beside its results: what was asked for, with which version, what was warned of, how it came out, and when.
//!
//! Times and the command line stand here and in provenance lines, never in results that are compared byte for byte.

use super::Verdict;
use crate::files::write_atomic;
use crate::{Error, PROGRAM};
use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// What the process has said on stderr.
static SAID: Mutex<Vec<u8>> = Mutex::new(Vec::new());

/// Standard error that remembers what it was told; says nothing aloud if quiet.
#[derive(Debug, Clone, Copy)]
pub struct Tee {
    /// Whether only the log gets it.
    pub quiet: bool,
}

impl Write for Tee {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
        said.extend_from_slice(bytes);
        if !self.quiet {
            std::io::stderr().write_all(bytes)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        std::io::stderr().flush()
    }
}

/// Log that a verb opens once its input is good.
#[derive(Debug)]
pub struct Log {
    started: Instant,
    open: Mutex<Option<Open>>,
}

#[derive(Debug)]
struct Open {
    path: PathBuf,
    text: String,
}

impl Default for Log {
    fn default() -> Self {
        Self {
            started: Instant::now(),
            open: Mutex::new(None),
        }
    }
}

impl Log {
    /// Opens the log of `verb` in `folder`; `hash` is that of the input file. Nothing is written yet.
    pub fn open(&self, folder: &Path, verb: &str, command: &str, hash: &str) {
        let text = format!(
            "version  {PROGRAM}\ncommand  {command}\ninput    sha256 {hash}\nthreads  {}\n",
            rayon::current_num_threads()
        );
        let path = folder.join(format!("{verb}.log"));
        *self.lock() = Some(Open { path, text });
    }

    /// Adds a paragraph to an open log.
    pub fn note(&self, title: &str, text: &str) {
        if let Some(open) = self.lock().as_mut() {
            let _ = write!(open.text, "\n{title}\n{}\n", text.trim_end());
        }
    }

    /// Writes an open log: warnings, how the run came out, and its time.
    pub fn close(&self, outcome: &Result<Verdict, Error>) {
        let said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
        let said = without_colours(&String::from_utf8_lossy(&said));
        self.note(
            "said on stderr",
            if said.is_empty() { "nothing" } else { &said },
        );
        let outcome = match outcome {
            Ok(Verdict::Met) => "exit code 0: every threshold is met".to_owned(),
            Ok(Verdict::Missed) => "exit code 1: a threshold is missed".to_owned(),
            Err(error) => format!("exit code 2: {error}"),
        };
        let seconds = self.started.elapsed().as_secs_f64();
        self.note("outcome", &format!("{outcome}\n{seconds:.2} s"));
        // a run that was refused late has left no folder, and gets none for its log
        let there = |open: &Open| open.path.parent().is_some_and(Path::exists);
        if let Some(open) = self.lock().take().filter(there)
            && let Err(error) = write_atomic(&open.path, open.text.as_bytes())
        {
            tracing::warn!("no log: {error}");
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Option<Open>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Text without the codes that colour it on a terminal.
fn without_colours(text: &str) -> String {
    let mut parts = text.split('\u{1b}');
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        plain.push_str(part.split_once('m').map_or(part, |(_, rest)| rest));
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_left_out() {
        assert_eq!(
            without_colours("\u{1b}[33m WARN\u{1b}[0m: a m"),
            " WARN: a m"
        );
    }

    #[test]
    fn a_log_says_how_the_run_came_out_and_one_that_was_not_opened_writes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let log = Log::default();
        log.note("plan", "nothing");
        log.close(&Ok(Verdict::Met));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        log.open(folder.path(), "run", "impactlaw run a.toml", "00ff");
        log.note("plan", "two impacts");
        log.close(&Ok(Verdict::Missed));
        let text = std::fs::read_to_string(folder.path().join("run.log")).unwrap();
        for part in [
            "impactlaw run a.toml",
            "00ff",
            "two impacts",
            "exit code 1",
            " s\n",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}
