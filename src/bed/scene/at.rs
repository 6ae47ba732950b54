//! Place in a scene file: the table that is being checked, for errors that name their key.

use crate::Result;
use crate::document::Document;
use crate::unit::Quantity;
use parry3d::math::Vector;

/// That a name under `key` is some text, and one that does no harm where it is printed: it may hold blanks, quotes and any script,
/// but no line ends or other control characters.
pub(super) fn check_name(document: &Document, key: &str, name: &str) -> Result<()> {
    if name.trim().is_empty() || name.chars().any(char::is_control) {
        let allowed =
            "must be a name of its own: some text without line ends or control characters";
        return Err(document.reject(key, allowed));
    }
    Ok(())
}

/// What a table is checked against: the document, and the dotted key of the table.
pub(super) struct At<'a> {
    pub(super) document: &'a Document,
    pub(super) key: &'a str,
}

impl At<'_> {
    pub(super) fn name(&self, name: &str) -> String {
        format!("{}.{name}", self.key)
    }

    pub(super) fn positive<D>(&self, name: &str, quantity: Quantity<D>) -> Result<f64> {
        self.document.positive(&self.name(name), quantity)
    }

    pub(super) fn reject(&self, name: &str, allowed: &str) -> crate::Error {
        self.document.reject(&self.name(name), allowed)
    }

    /// Unit vector.
    pub(super) fn direction(&self, name: &str, direction: [f64; 3]) -> Result<Vector> {
        Vector::from(direction).try_normalize().ok_or_else(|| {
            self.reject(
                name,
                "must be a direction other than zero, e.g. [0.0, 0.0, 1.0]",
            )
        })
    }
}
