//! Discover: equations from the results of a study, found from raw columns by units, search and physics.
//!
//! Columns with units make a matrix whose integer null space gives the groups (`dimension`). Figures are searched for as
//! formulas over the groups (`search`): every small structure once (`enumerate`), constants by least squares (`solve`), numbers
//! taken out one by one as long as the description gets no longer. `physics` rejects; `score` leaves whole levels out.

pub mod bound;
pub(crate) mod dimension;
pub(crate) mod enumerate;
pub mod file;
pub(crate) mod forest;
pub(crate) mod formula;
pub(crate) mod front;
pub(crate) mod identity;
pub mod infix;
pub(crate) mod more;
pub(crate) mod physics;
pub mod problem;
pub(crate) mod process;
pub(crate) mod ranking;
pub(crate) mod ratio;
pub(crate) mod score;
pub(crate) mod search;
pub(crate) mod solve;
pub mod table;
pub(crate) mod thesis;
