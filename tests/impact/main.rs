//! Simulated impacts: closed forms, schemes and geometries beside each other, and what accuracy costs.

mod adhesion;
mod cost_thesis;
mod elastic;
mod flow;
mod hard;
mod large;
#[path = "../support/maw_barber_fawcett.rs"]
mod maw_barber_fawcett;
mod pair;
mod pair_law;
mod plastic;
mod presets;
mod scan;
mod schemes;
mod solid;
mod taylor;
