//! Explorer: laws and theories of one sphere, asked and answered as JSON ([`answer()`]), and the page that asks while its sliders are
//! moved ([`page`]).
//!
//! The page holds these rooms of the library as WebAssembly (`src/explorer`, a package of its own): what it shows are the library's
//! own numbers, and it needs neither network nor program.

pub mod answer;
mod body;
mod curves;
pub mod page;

pub use answer::answer;
