//! Contacts, each with its own history: pairs of grains, grains on surfaces.

mod crowd;
mod departure;
pub(crate) mod family;
mod member;
pub(crate) mod pairs;
pub(crate) mod patch;
pub(crate) mod surfaces;
