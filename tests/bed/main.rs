//! Beds of grains: contacts, bodies and periodic sides, scenes from their files to their pages, and refusals.

mod adapter;
mod beds_from_files;
mod belts;
mod bodies;
#[path = "../support/browser.rs"]
mod browser;
mod collisions;
mod fast_bodies;
mod files;
mod fine_grain;
mod grain_files;
mod grain_files_in_scenes;
mod grain_files_refused;
#[path = "../support/grain_lists.rs"]
mod grain_lists;
mod insertion;
mod kinds_shown;
mod many;
#[path = "../support/maw_barber_fawcett.rs"]
mod maw_barber_fawcett;
#[path = "../support/mesh_lists.rs"]
mod mesh_lists;
mod meshes;
mod mixture;
mod naming;
mod obj_files;
mod oblique;
mod oblique_elastic;
mod oblique_published;
mod outlets;
mod page;
mod pair_law;
mod periodic;
#[path = "../support/program.rs"]
mod program;
mod range;
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
mod stl_ascii;
mod stl_binary;
mod turning;
mod two_bodies;
