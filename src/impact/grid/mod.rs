//! Grid that carries displacement and velocity: splines, cells, and where points have their homes.

pub mod basis;
pub mod homes;
pub mod section;
pub mod volume;
