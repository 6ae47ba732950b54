//! Force of one contact on its two bodies: the normal law and the effects around it.

pub mod by_material;
pub mod damping;
mod edge;
pub mod effects;
pub mod friction;
pub(crate) mod list;
pub(crate) mod losses;
pub(crate) mod meeting;
pub mod mixture;
pub mod named;
pub mod normal;
pub mod paired;
pub mod rolling;
pub(crate) mod sides;
pub mod slider;
