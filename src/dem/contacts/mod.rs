//! Contacts, each with its own history: pairs of grains, grains on surfaces.

pub(crate) mod family;
pub mod pairs;
pub(crate) mod patch;
pub mod surfaces;
