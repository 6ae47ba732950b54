//! `impactlaw` turns a particle's material into a contact law that discrete-element (DEM) codes can use.
//!
//! Data flow one way; every arrow is a file that a person can open, every stage can be rerun from its
//! input file, and no room reads one to its right:
//!
//! ```text
//! case.toml -> case -> plan -> impact -> curve.csv -> fit -> law.toml -+-> compare -> report
//!                                                                      +-> bed
//!                                                                      +-> export
//! ```
//!
//! How to use it: [`guide`]. Units are SI everywhere in memory; files carry their units in keys and headers.
#![warn(missing_docs)]
#![cfg_attr(not(test), deny(clippy::unwrap_used))]

pub mod atlas;
pub mod bed;
pub mod case;
pub mod cli;
pub mod command;
pub mod compare;
pub mod contact;
pub mod cost;
pub mod curve;
pub mod dem;
pub mod discover;
pub mod document;
pub mod error;
pub mod explore;
pub mod export;
pub mod files;
pub mod fit;
pub mod guide;
pub mod impact;
pub mod inverse;
pub(crate) mod lanes;
pub mod law;
pub mod listing;
pub mod material;
pub mod plan;
pub mod prelude;
pub mod report;
pub mod scheme;
pub mod shape;
pub mod space;
pub mod study;
pub mod table;
pub mod tape;
pub mod tester;
pub mod theory;
pub mod thesis;
pub mod unit;
pub mod validate;
pub mod view;

pub use error::{Error, Place, Result};

/// Program name and version, for provenance.
pub const PROGRAM: &str = concat!("impactlaw ", env!("CARGO_PKG_VERSION"));
