//! Admissibility of constants: what a law refuses, and why.

use crate::Error;

/// A constant that would break a guarantee of the law that holds it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("`{key}`: found {found}; {allowed}")]
pub struct Inadmissible {
    /// Which constant, by the key it has in a law file.
    pub key: String,
    /// Its value.
    pub found: f64,
    /// What is allowed, as a sentence part.
    pub allowed: &'static str,
}

impl Inadmissible {
    /// `Ok` if `holds`; the condition must be false for NaN.
    ///
    /// # Errors
    /// [`Inadmissible`] with the key, the value and what is allowed.
    pub fn unless(
        holds: bool,
        key: impl Into<String>,
        found: f64,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if holds {
            Ok(())
        } else {
            Err(Inadmissible {
                key: key.into(),
                found,
                allowed,
            })
        }
    }
}

impl From<Inadmissible> for Error {
    fn from(e: Inadmissible) -> Self {
        Error::Refused {
            what: e.key,
            found: e.found.to_string(),
            allowed: e.allowed.to_string(),
        }
    }
}
