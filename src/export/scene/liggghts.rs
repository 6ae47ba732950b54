//! Scene for LIGGGHTS: data file, input script and the mesh of the piston beside the law's library.

use crate::dem::force::named::Constants;
use crate::export::liggghts;
use crate::export::scene::{Bed, Parts};
use crate::export::source::artifact::Artifact;
use std::fmt::Write;

const BEGIN: &str = include_str!("liggghts_begin.in");
const PARTS: Parts = Parts {
    drive: include_str!("liggghts_drive.in"),
    turn: "unfix drive\n",
    seat: include_str!("liggghts_seat.in"),
    end: include_str!("liggghts_end.in"),
};

/// The files, in a folder `liggghts`.
pub(super) fn export(bed: &Bed) -> Vec<Artifact> {
    let words = models(bed);
    let script = bed.fill(BEGIN, &words) + &bed.stages(&PARTS);
    let mut files = liggghts::export(bed.law);
    files.extend(
        [
            bed.data(),
            Artifact {
                name: "scene.in".to_owned(),
                text: script,
            },
            piston(bed),
        ]
        .map(|file| Artifact {
            name: format!("liggghts/{}", file.name),
            ..file
        }),
    );
    files
}

/// Models and properties for the effects the scene names.
fn models(bed: &Bed) -> [(&'static str, String); 4] {
    let Constants {
        friction,
        rolling,
        restitution,
        stiffness: _,
    } = bed.scene.contact;
    let mut wall = "model @NAME@".to_owned();
    let mut properties = String::new();
    let mut property = |name: &str, value: f64| {
        let _ = writeln!(
            properties,
            "fix {name} all property/global {name} peratomtypepair 1 {value:e}"
        );
    };
    if let Some(friction) = friction {
        wall.push_str(" tangential @NAME@");
        property("coefficientFriction", friction);
    }
    if let Some(rolling) = rolling {
        wall.push_str(" rolling_friction epsd2");
        property("coefficientRollingFriction", rolling);
    }
    let damping = match restitution {
        Some(restitution) => {
            property("coefficientRestitution", restitution);
            " damping on"
        }
        None => "",
    };
    [
        ("@PROPERTIES@\n", properties),
        ("@MODEL@", format!("{wall}{damping}")),
        ("@WALL@", wall),
        ("@DAMPING@", damping.to_owned()),
    ]
}

/// The piston's face: two triangles that look down, a radius larger than the box on every side.
fn piston(bed: &Bed) -> Artifact {
    let over = bed.packed.grains.largest_radius();
    let (low, z) = (-over, bed.face());
    let (right, back) = (bed.container.width + over, bed.container.depth + over);
    let corners = [[low, low], [right, low], [right, back], [low, back]];
    let mut text = "solid piston\n".to_owned();
    for triangle in [[0, 2, 1], [0, 3, 2]] {
        text.push_str("facet normal 0 0 -1\nouter loop\n");
        for corner in triangle {
            let [x, y] = corners[corner];
            let _ = writeln!(text, "vertex {x:e} {y:e} {z:e}");
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid piston\n");
    Artifact {
        name: "piston.stl".to_owned(),
        text,
    }
}
