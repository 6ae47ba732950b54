//! Place in a scene file: the table that is being checked, for errors that name their key.

use crate::Result;
use crate::document::Document;
use crate::unit::Quantity;
use parry3d::math::Vector;

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
