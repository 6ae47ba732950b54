//! The room `atlas` without the fit that makes one.

#[path = "../atlas/law.rs"]
mod law;
#[path = "../atlas/place.rs"]
pub(crate) mod place;
#[path = "../atlas/score.rs"]
mod score;

pub use law::Atlas;
