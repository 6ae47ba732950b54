//! Bed of grains: a discrete-element run of many grains under a contact law, among bodies moved by rapier.

pub mod bodies;
pub mod compose;
pub mod contacts;
pub mod damping;
pub mod friction;
pub mod grains;
pub mod insertion;
pub mod law;
pub mod lettering;
pub mod machine;
pub mod measure;
pub mod neighbours;
pub mod normals;
pub mod output;
mod patches;
pub mod protocol;
pub mod render;
mod restart;
pub mod row;
pub mod run;
pub mod scene;
pub mod stage;
pub mod step;
pub mod surfaces;
pub mod time_step;
pub mod touching;
pub mod vtp;
