//! Source of every dialect: the law as plain numbers, its description, its reference values.

pub mod artifact;
pub mod describe;
pub mod dialect;
pub mod portable;
pub mod reference;
