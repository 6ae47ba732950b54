//! Thesis: the equations, tables and readings of chapters 4 and 5 of the thesis this project starts from, compared with the results of a
//! study.
//!
//! Saifoori, *Analysis of Particle Deformation during Impact Deposition*, Leeds 2025. Numbers of equations, tables and figures are its own.
//! q is $\rho V^2/Y$ throughout.

pub(crate) mod claims;
pub(crate) mod data;
pub(crate) mod equations;
pub(crate) mod score;
pub(crate) mod tables;

pub use claims::{Claim, claims};
pub use data::{Data, Row};
pub(crate) use equations::{EQUATIONS, Equation};
pub(crate) use score::{Refit, Score, refit};
