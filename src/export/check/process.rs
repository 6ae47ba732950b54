//! Programs of others: found, run with input, and their output read.

use crate::{Error, Result};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Output of a program that has ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ran {
    /// Did it end with exit code 0?
    pub success: bool,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// Path of a program: what the environment variable `variable` names, else `name` on `PATH`.
#[must_use]
pub fn find_program(variable: &str, name: &str) -> Option<PathBuf> {
    if let Some(given) = std::env::var_os(variable).filter(|value| !value.is_empty()) {
        return Some(PathBuf::from(given));
    }
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path)
        .map(|folder| folder.join(name))
        .find(|file| file.is_file())
}

/// Run `command` with `input` on its standard input and wait for its end.
///
/// # Errors
/// [`Error::File`] when it cannot be started or talked to.
pub fn run(command: &mut Command, input: &str) -> Result<Ran> {
    let program = PathBuf::from(command.get_program());
    let at = |e| Error::file("run", &program)(e);
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(at)?;
    let pipe = child.stdin.take();
    let output = std::thread::scope(|scope| {
        // a program that stops reading early is judged by its output
        scope.spawn(move || pipe.map(|mut pipe| pipe.write_all(input.as_bytes())));
        child.wait_with_output()
    })
    .map_err(at)?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Ok(Ran {
        success: output.status.success(),
        stdout: text(&output.stdout),
        stderr: text(&output.stderr),
    })
}

impl Ran {
    /// Lines of the standard output that are `N` numbers and nothing else.
    pub fn rows<const N: usize>(&self) -> impl Iterator<Item = [f64; N]> {
        self.stdout.lines().filter_map(|line| {
            let mut words = line.split_whitespace();
            let mut numbers = [0.0; N];
            for number in &mut numbers {
                *number = words.next()?.parse().ok()?;
            }
            words.next().is_none().then_some(numbers)
        })
    }

    /// The output, if the program succeeded.
    ///
    /// # Errors
    /// [`Error::File`] with the program's last words.
    pub fn or_fail(self, action: &'static str, file: &Path) -> Result<Self> {
        if self.success {
            return Ok(self);
        }
        let words = if self.stderr.trim().is_empty() {
            &self.stdout
        } else {
            &self.stderr
        };
        let cause = std::io::Error::other(words.trim().to_owned());
        Err(Error::file(action, file)(cause))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_lines_of_so_many_numbers_alone() {
        let ran = Ran {
            success: true,
            stdout: "Step v f\n 0 2.0 0.0\n 5 3e-6 7\n1 2\n1 2 3 4\nLoop time of 1\n".to_owned(),
            stderr: String::new(),
        };
        let rows: Vec<[f64; 3]> = ran.rows().collect();
        assert_eq!(rows, [[0.0, 2.0, 0.0], [5.0, 3e-6, 7.0]]);
    }
}
