//! Report: the figures and the page that show a finished run to a reader; plain data in, SVG and HTML out.
//!
//! Nothing here knows a solver: every figure and table is handed over as numbers and text.

pub mod chart;
pub mod field_map;
pub mod figure;
mod markup;
pub mod page;
pub mod palette;
pub mod raster;
pub mod run_page;
pub mod scale;
pub mod table;

pub use run_page::RunPage;
