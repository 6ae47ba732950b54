//! Bed of grains: a discrete-element run of many grains under a contact law, among bodies moved by rapier.

pub mod filling;
pub mod measures;
pub mod stages;

pub mod record;
pub mod run;
pub mod scene;
