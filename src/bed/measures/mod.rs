//! Measures of a bed: time series, fabric, slopes, flow.

pub mod fabric;
pub mod flow;
pub(crate) mod gauge;
pub mod oedometer;
pub mod repose;
pub mod series;
