//! Material points: where they are in the body and what volume each stands for.

pub mod ball;
pub mod lattice;
pub mod section;
