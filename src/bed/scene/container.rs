//! Box of a scene: its edges, whether a piston hangs in it, and which of its sides are periodic.

use super::stage::Stage;
use crate::Result;
use crate::dem::bodies::enclosure::PISTON;
use crate::document::Document;
use crate::document::keys::{key, keys};
use crate::unit::{Length, Quantity};
use serde::Deserialize;

/// Box of a scene: walls around x in [0, width], y in [0, depth], on the floor z = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Container {
    /// Inner edge along x, m.
    pub width: f64,
    /// Inner edge along y, m.
    pub depth: f64,
    /// Height of the walls, m; what the grains need if none.
    pub height: Option<f64>,
    /// Whether a piston hangs under the rim.
    pub piston: bool,
    /// Whether its sides along each axis are periodic instead of walls.
    pub periodic: [bool; 3],
}

/// Table `[box]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxTable {
    width: Quantity<Length>,
    depth: Quantity<Length>,
    height: Option<Quantity<Length>>,
}

keys! {
    BoxTable "Its walls are the bodies `left`, `right` (x), `front`, `back` (y) and `floor`; a `piston` hangs under the rim where a stage needs one." {
        width: key("inner edge along x", "≥ 2 grain diameters; 3 if periodic", "'5 mm'"),
        depth: key("inner edge along y", "≥ 2 grain diameters; 3 if periodic", "'5 mm'"),
        height: key("height of the walls; required if periodic", "> 0; 3 grain diameters if periodic", "'25 mm'").or("what the grains need"),
    }
}

impl BoxTable {
    pub(super) fn check(
        self,
        document: &Document,
        stages: &[Stage],
        sides: &[String],
    ) -> Result<Container> {
        let axes = ["x", "y", "z"];
        if let Some(at) = sides.iter().position(|side| !axes.contains(&&side[..])) {
            let allowed = "must be \"x\", \"y\" or \"z\": the sides of the box that are periodic instead of walls";
            return Err(document.reject(&format!("periodic[{at}]"), allowed));
        }
        let uses_piston = |stage: &Stage| match stage {
            Stage::Compress { .. } => true,
            Stage::Run(run) => {
                run.until.stress.is_some() || run.moves.iter().any(|order| order.body == PISTON)
            }
            _ => false,
        };
        let periodic = axes.map(|axis| sides.iter().any(|side| side == axis));
        Ok(Container {
            width: document.positive("box.width", self.width)?,
            depth: document.positive("box.depth", self.depth)?,
            height: match self.height {
                Some(height) => Some(document.positive("box.height", height)?),
                None => None,
            },
            piston: !periodic[2] && stages.iter().any(uses_piston),
            periodic,
        })
    }
}
