//! Discrete elements: the engine that moves grains and bodies under contact laws; it knows no file.

pub mod adapter;
pub mod bodies;
pub(crate) mod contacts;
pub mod dynamics;
pub mod force;
pub mod grains;
