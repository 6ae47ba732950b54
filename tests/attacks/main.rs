//! Attacks on the program: damaged and hostile input, flipped bits, kills, a folder used twice, devices that are full.
//!
//! A crate of its own, because its allocator counts what each reader holds.

mod flips;
#[path = "../support/four_cases.rs"]
mod four_cases;
mod fuzz;
#[path = "../laws/impacts.rs"]
#[allow(dead_code)] // part of what it holds is for fits alone
mod impacts;
mod kills;
mod memory;
mod mutate;
#[path = "../support/program.rs"]
mod program;
mod readers;
mod runs;
#[path = "../house/sources.rs"]
mod sources;
