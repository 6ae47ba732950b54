//! Target `liggghts`: a normal and a tangential model of LIGGGHTS, and the library that puts them into a stock program.

use crate::Result;
use crate::export::c::contact::{filled, headers};
use crate::export::source::artifact::Artifact;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;

const NORMAL: &str = include_str!("normal_model.h");
const TANGENTIAL: &str = include_str!("tangential_model.h");
const REGISTER: &str = include_str!("register.cpp");
const BUILD: &str = include_str!("build.sh");
const IMPACT: &str = include_str!("impact.in");

/// Number of the models in LIGGGHTS' tables, of six bits; LIGGGHTS itself uses those up to 12.
const MODEL_ID: &str = "40";

/// Models for LIGGGHTS.
#[derive(Debug, Clone, Copy)]
pub struct Liggghts;

impl Dialect for Liggghts {
    const NAME: &'static str = "liggghts";
    const PAIR: Option<PairExport> = None;
    const OF_PAIRS: bool = false;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        Ok(export(law))
    }
}

/// The files, in a folder `liggghts`.
#[must_use]
pub fn export(law: &Portable) -> Vec<Artifact> {
    let name = &law.identifier;
    let mut files = headers(law, "liggghts");
    files.extend(
        [
            (format!("normal_model_{name}.h"), NORMAL),
            (format!("tangential_model_{name}.h"), TANGENTIAL),
            (format!("{name}_liggghts.cpp"), REGISTER),
            ("build.sh".to_owned(), BUILD),
            ("impact.in".to_owned(), IMPACT),
        ]
        .map(|(file, template)| Artifact {
            name: format!("liggghts/{file}"),
            text: filled(&template.replace("@ID@", MODEL_ID), law),
        }),
    );
    files
}
