//! Beds of grains: contacts, bodies and periodic sides, scenes from their files to their pages, and refusals.

mod adapter;
mod belts;
mod bodies;
#[path = "../support/browser.rs"]
mod browser;
mod collisions;
mod fast_bodies;
mod files;
mod fine_grain;
mod grain_files;
mod insertion;
mod kinds_shown;
mod many;
#[path = "../support/maw_barber_fawcett.rs"]
mod maw_barber_fawcett;
mod mesh_files;
mod meshes;
mod mixture;
mod naming;
mod oblique;
mod oblique_elastic;
mod oblique_published;
mod outlets;
mod page;
mod periodic;
#[path = "../support/program.rs"]
mod program;
mod refusals;
mod removal;
mod restart;
mod restitution;
mod resume;
mod same_bits;
mod scene_run;
mod scenes;
mod seams;
mod shear_cell;
mod turning;
mod two_bodies;
