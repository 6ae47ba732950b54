//! Scene for LAMMPS: data file and input script beside the plugin.

use crate::dem::force::named::Constants;
use crate::export::lammps;
use crate::export::scene::{Bed, Parts};
use crate::export::source::artifact::Artifact;
use std::fmt::Write;

const BEGIN: &str = include_str!("lammps_begin.in");
const PARTS: Parts = Parts {
    drive: include_str!("lammps_drive.in"),
    turn: "",
    seat: include_str!("lammps_seat.in"),
    end: "",
};

/// The files, in a folder `lammps`.
pub(super) fn export(bed: &Bed) -> Vec<Artifact> {
    let script = bed.fill(BEGIN, &[("@EFFECTS@", effects(bed))]) + &bed.stages(&PARTS);
    let mut files = lammps::export(bed.law);
    files.extend(
        [
            bed.data(),
            Artifact {
                name: "scene.in".to_owned(),
                text: script,
            },
        ]
        .map(|file| Artifact {
            name: format!("lammps/{}", file.name),
            ..file
        }),
    );
    files
}

/// Words for the effects the scene names.
fn effects(bed: &Bed) -> String {
    let Constants {
        friction,
        rolling,
        restitution,
        stiffness: _,
    } = bed.scene.contact;
    let named = [
        ("friction", friction),
        ("rolling", rolling),
        ("restitution", restitution),
    ];
    let mut words = String::new();
    for (name, value) in named {
        if let Some(value) = value {
            let _ = write!(words, " {name} {value:e}");
        }
    }
    words
}
