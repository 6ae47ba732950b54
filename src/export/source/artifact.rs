//! Artifact: a text file of an export.

/// A text file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Artifact {
    /// File name, relative to the output folder.
    pub name: String,
    /// Content.
    pub text: String,
}
