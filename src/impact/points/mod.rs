//! Material points: where they are in the body and what volume each stands for.

pub(crate) mod ball;
pub(crate) mod lattice;
pub(crate) mod section;
