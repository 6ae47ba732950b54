//! The one error type of the library: what went wrong, where, and what is allowed instead.

use std::ops::Range;
use std::path::{Path, PathBuf};

/// Everything that can stop a stage. Messages name the place, what was found and the remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value in an input file is not acceptable.
    #[error("{}: `{key}`: found {found}; {allowed}", path.display())]
    Value {
        /// File the value was read from.
        path: PathBuf,
        /// Dotted key, e.g. `material.poisson_ratio`.
        key: String,
        /// What the file says.
        found: String,
        /// What is allowed, as a sentence part ("must lie in [0, 0.5)").
        allowed: String,
        /// Where it stands, for a snippet.
        place: Option<Box<Place>>,
    },
    /// A TOML file cannot be parsed (syntax, unknown or missing key).
    #[error("{}: {message}", path.display())]
    Syntax {
        /// File.
        path: PathBuf,
        /// The parser's message.
        message: String,
        /// Where, for a snippet.
        place: Option<Box<Place>>,
    },
    /// A file cannot be read or written.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// `read`, `write`, `create`.
        action: &'static str,
        /// File or folder.
        path: PathBuf,
        /// Cause.
        #[source]
        source: std::io::Error,
    },
    /// A command-line argument is not acceptable.
    #[error("{argument}: found {found}; {allowed}")]
    Argument {
        /// Flag or positional name.
        argument: String,
        /// What was given.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// What the library was given cannot be used.
    #[error("{what}: found {found}; {allowed}")]
    Refused {
        /// What it is.
        what: String,
        /// What was given.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// An impact run cannot go on.
    #[error("impact at {velocity} m/s stopped at step {step}: {reason}")]
    Impact {
        /// Impact speed in m/s.
        velocity: f64,
        /// Step at which the run stopped.
        step: u64,
        /// Why.
        reason: String,
    },
    /// A fit did not reach an acceptable law.
    #[error("the fit did not converge: {reason}")]
    Fit {
        /// Why, with the residual reached.
        reason: String,
    },
    /// A bed run cannot go on.
    #[error("bed stopped at step {step}: {reason}")]
    Bed {
        /// Step at which the run stopped.
        step: u64,
        /// Why.
        reason: String,
    },
    /// Bodies cannot be made or moved.
    #[error("bodies: {reason}")]
    Bodies {
        /// Why.
        reason: String,
    },
    /// A figure cannot be drawn.
    #[error("cannot draw {what}: {reason}")]
    Figure {
        /// Which figure.
        what: String,
        /// Why.
        reason: String,
    },
}

/// Place in a text. The text goes with it: what was read from a pipe cannot be read again, and a file may have changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The whole text.
    pub text: String,
    /// Byte range in it; none for what is not there.
    pub span: Option<Range<usize>>,
    /// What the reference says of the key that stands there.
    pub explanation: Option<String>,
    /// Keys at the top of the kind of file it was read as.
    pub reader: Vec<String>,
}

/// Result of a stage.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// Refusal of `found` where one of `names` was to be given.
    pub fn not_one_of<N: AsRef<str>>(
        argument: &str,
        found: &str,
        names: impl IntoIterator<Item = N>,
    ) -> Error {
        Error::Refused {
            what: argument.to_owned(),
            found: format!("`{found}`"),
            allowed: must_be_one_of(names),
        }
    }

    /// A value of a table that is read without its text: `key` says where it stands.
    pub fn in_table(path: &Path, key: &str, found: impl Into<String>, allowed: &str) -> Error {
        Error::Value {
            path: path.to_owned(),
            key: key.to_owned(),
            found: found.into(),
            allowed: allowed.to_owned(),
            place: None,
        }
    }

    /// File error with its path; for `map_err`.
    pub fn file(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Error {
        let path = path.to_owned();
        move |source| Error::File {
            action,
            path,
            source,
        }
    }
}

/// "must be one of ...": what is allowed where a name was to be given.
#[must_use]
pub fn must_be_one_of<N: AsRef<str>>(names: impl IntoIterator<Item = N>) -> String {
    let mut text = "must be one of ".to_owned();
    for (index, name) in names.into_iter().enumerate() {
        text.push_str(if index == 0 { "" } else { ", " });
        text.push_str(name.as_ref());
    }
    text
}
