//! Report: the figures and the page that show a finished run to a reader; plain data in, SVG and HTML out.
//!
//! Nothing here knows a solver: every figure and table is handed over as numbers and text.

pub(crate) mod chart;
pub(crate) mod field_map;
pub(crate) mod figure;
mod markup;
pub(crate) mod page;
pub(crate) mod palette;
pub(crate) mod raster;
pub mod run_page;
pub(crate) mod scale;
pub(crate) mod table;

pub use run_page::RunPage;
