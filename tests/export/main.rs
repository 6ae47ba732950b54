//! Exported laws and scenes: compiled, run in the codes they are for, and beside this library.

mod bed;
mod c;
mod case_decks;
mod codes;
mod damping;
mod decks;
mod granular;
mod lammps;
mod liggghts;
mod names;
mod native;
#[path = "../../benches/packing/mod.rs"]
mod packing;
#[path = "../support/program.rs"]
mod program;
mod scene;
mod shims;
