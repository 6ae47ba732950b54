//! Artifact: a text file of an export.

/// A text file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Artifact {
    /// File name, relative to the output folder.
    pub name: String,
    /// Content.
    pub text: String,
}

impl Artifact {
    /// The file in `folder`, unless it says so itself already.
    #[must_use]
    pub fn within(mut self, folder: &str) -> Self {
        let there = self.name.strip_prefix(folder);
        if !there.is_some_and(|rest| rest.starts_with('/')) {
            self.name = format!("{folder}/{}", self.name);
        }
        self
    }
}
