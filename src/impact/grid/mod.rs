//! Grid that carries displacement and velocity: splines, cells, and where points have their homes.

pub(crate) mod basis;
pub(crate) mod homes;
pub(crate) mod section;
pub(crate) mod volume;
