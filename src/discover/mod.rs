//! Discover: equations from the results of a study, found from raw columns by units, search and physics.
//!
//! Columns with units make a matrix whose integer null space gives the groups ([`dimension`]). Figures are searched for as
//! formulas over the groups ([`search`]): every small structure once ([`enumerate`]), constants by least squares ([`solve`]), numbers
//! taken out one by one as long as the description gets no longer. [`physics`] rejects; [`score`] leaves whole levels out.

pub mod bound;
pub mod dimension;
pub mod enumerate;
pub mod file;
pub mod forest;
pub mod formula;
pub mod front;
pub mod identity;
pub mod infix;
pub mod physics;
pub mod problem;
pub mod process;
pub mod ranking;
pub mod ratio;
pub mod score;
pub mod search;
pub mod solve;
pub mod table;
pub mod thesis;
