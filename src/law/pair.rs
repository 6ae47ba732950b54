//! Law of a pair: a law file that says which two bodies it is of, a type of its own so that nothing takes it for a law of one.

pub use super::bodies::{PairTable, TargetName};
use super::file::LawFile;
use crate::case::pair::PairCase;
use crate::document::Document;
use crate::fit::Fit;
use crate::{Error, Result};
use std::path::Path;

/// A law file of a pair of bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct PairLaw {
    file: LawFile,
    bodies: PairTable,
}

impl PairLaw {
    /// Law of a fit to the impacts of `pair`; `program` is name and version.
    #[must_use]
    pub fn of(fit: &Fit, pair: &PairCase, program: &str) -> Self {
        let bodies = PairTable::of(pair);
        let mut file = LawFile::of(fit, &pair.effective(), program);
        file.pair = Some(bodies.clone());
        PairLaw { file, bodies }
    }

    /// Read and check a law file of a pair.
    ///
    /// # Errors
    /// As [`LawFile::read`], but for a law of one body in place of one of two.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&Document::read(path)?)
    }

    /// Check the text of a law file of a pair.
    ///
    /// # Errors
    /// As [`LawFile::parse`], but for a law of one body in place of one of two.
    pub fn parse(document: &Document) -> Result<Self> {
        let file = LawFile::parse_any(document)?;
        match file.pair.clone() {
            Some(bodies) => Ok(PairLaw { file, bodies }),
            None => Err(Error::Refused {
                what: document.path().display().to_string(),
                found: "the law of one material on a rigid wall".to_owned(),
                allowed: "must be the law of a pair (with a table `[pair]`); `impactlaw fit` makes one of a case with `[wall.material]`".to_owned(),
            }),
        }
    }

    /// The file, whose `[material]` is the sphere that stands for both bodies.
    #[must_use]
    pub fn file(&self) -> &LawFile {
        &self.file
    }

    /// The file for those that write or show it.
    #[must_use]
    pub fn into_file(self) -> LawFile {
        self.file
    }

    /// The bodies.
    #[must_use]
    pub fn bodies(&self) -> &PairTable {
        &self.bodies
    }
}
