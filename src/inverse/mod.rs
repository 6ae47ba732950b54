//! Inverse: from measured impacts back to the yield strength, or yield strength and hardening modulus, of the material.
//!
//! The atlas answers in microseconds what an impact of any material does, so strength and hardening are those whose impacts are nearest to
//! the measured ones, each in units of its uncertainty. Intervals come from the same estimate of impacts drawn around what was
//! found. Where the atlas is not good enough, real impacts at the estimate correct it (module `refine`).

pub mod confidence;
pub mod measurement;
pub mod model;
pub(crate) mod refine;
pub mod search;
mod table;
