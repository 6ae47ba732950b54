//! Source of every dialect: the law as plain numbers, its description, its reference values.

pub mod artifact;
pub(crate) mod describe;
pub(crate) mod dialect;
pub mod portable;
pub(crate) mod reference;
