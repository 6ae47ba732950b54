//! Outlets: where grains leave the bed.

use super::at::{At, check_name};
use super::group::Group;
use super::region::{Region, RegionTable};
use super::written::vector;
use crate::Result;
use crate::document::Document;
use crate::document::keys::{key, keys, table};
use crate::unit::{Length, Quantity};
use parry3d::math::Vector;
use serde::Deserialize;

/// Least thickness of a region over the smallest radius. A grain moves at most about a tenth of that radius in a step; fast ones are
/// looked at every five steps, so that none flies through unseen.
const THICKNESS: f64 = 5.0;

/// Where grains leave.
#[derive(Debug, Clone, PartialEq)]
pub struct Outlet {
    /// Name, for the figures.
    pub name: String,
    /// The place.
    pub mouth: Mouth,
}

/// Place of an outlet: a grain leaves when its centre is in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mouth {
    /// Part of space.
    Region(Region),
    /// All that lies beyond a plane.
    Beyond {
        /// A point of the plane, m.
        point: Vector,
        /// Direction in which grains leave.
        normal: Vector,
    },
}

impl Mouth {
    /// Whether a grain with its centre at a point (m) leaves.
    #[must_use]
    pub fn takes(&self, centre: Vector) -> bool {
        match self {
            Mouth::Region(region) => region.holds(centre, 0.0),
            Mouth::Beyond { point, normal } => (centre - *point).dot(*normal) > 0.0,
        }
    }

    /// How far (m) a grain flies at least within it, straight through; infinite beyond a plane, which no grain leaves again.
    #[must_use]
    pub fn thickness(&self) -> f64 {
        match self {
            Mouth::Region(region) => {
                let [low, high] = region.corners();
                (high - low).min_element()
            }
            Mouth::Beyond { .. } => f64::INFINITY,
        }
    }

    /// Whether it takes some of the block between two corners (m).
    fn meets(&self, [low, high]: [Vector; 2]) -> bool {
        match self {
            Mouth::Region(region) => {
                let [below, above] = region.corners();
                below.cmplt(high).all() && above.cmpgt(low).all()
            }
            Mouth::Beyond { normal, .. } => {
                let furthest = Vector::select(normal.cmpgt(Vector::ZERO), high, low);
                self.takes(furthest)
            }
        }
    }
}

/// Table `[[outlet]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutletTable {
    name: Option<String>,
    region: Option<RegionTable>,
    plane: Option<PlaneTable>,
}

keys! {
    OutletTable "One place: `region` or `plane`. A grain leaves when its centre is there; grains must not come in there." {
        name: key("name, for the figures", "each once", "'mouth'").or("`\"outlet\"`"),
        region: table("part of space").within("at least 5 of the smallest radius thick").or("one place"),
        plane: table("all that lies beyond a plane").within("across no periodic side").or("one place"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneTable {
    at: [Quantity<Length>; 3],
    normal: [f64; 3],
}

keys! {
    PlaneTable {
        at: key("a point of the plane", "", "['0 mm', '0 mm', '-5 mm']"),
        normal: key("direction in which grains leave", "not 0", "[0.0, 0.0, -1.0]"),
    }
}

/// What outlets are checked against.
pub(super) struct Surroundings<'a> {
    /// Groups of grains.
    pub(super) groups: &'a [Group],
    /// Smallest radius, m.
    pub(super) smallest: f64,
    /// Axes along which the box is periodic.
    pub(super) periodic: [bool; 3],
}

pub(super) fn check_outlets(
    document: &Document,
    tables: Vec<OutletTable>,
    around: &Surroundings,
) -> Result<Vec<Outlet>> {
    let mut outlets: Vec<Outlet> = Vec::new();
    for (index, table) in tables.into_iter().enumerate() {
        let key = format!("outlet[{index}]");
        let at = At {
            document,
            key: &key,
        };
        let mouth = table.mouth(&at, around)?;
        let name = table.name.unwrap_or_else(|| "outlet".to_owned());
        check_name(document, &at.name("name"), &name)?;
        if outlets.iter().any(|other| other.name == name) {
            return Err(at.reject("name", "must be given, and another one for every outlet"));
        }
        for group in around.groups {
            if group
                .region
                .is_some_and(|region| mouth.meets(region.corners()))
            {
                let allowed = format!(
                    "must stay clear of the region of the group \"{}\": its grains would leave as they come in",
                    group.name
                );
                return Err(document.reject(&key, allowed));
            }
        }
        outlets.push(Outlet { name, mouth });
    }
    Ok(outlets)
}

impl OutletTable {
    fn mouth(&self, at: &At, around: &Surroundings) -> Result<Mouth> {
        match (&self.region, &self.plane) {
            (Some(region), None) => {
                let region = region.check(at.document, &at.name("region"))?;
                let least = THICKNESS * around.smallest;
                if Mouth::Region(region).thickness() < least {
                    let allowed = format!(
                        "must be at least {:.3e} m thick, {THICKNESS} of the smallest radius: a fast grain could fly through it between two looks; or use a `plane`",
                        least
                    );
                    return Err(at.reject("region", &allowed));
                }
                Ok(Mouth::Region(region))
            }
            (None, Some(plane)) => {
                let normal = at.direction("plane.normal", plane.normal)?;
                let axes = [normal.x, normal.y, normal.z];
                let across = axes
                    .iter()
                    .zip(around.periodic)
                    .position(|(part, periodic)| periodic && *part != 0.0);
                if let Some(axis) = across {
                    let allowed = format!(
                        "must lie across {}: grains that leave there come back on the other side; use a `region`",
                        ["x", "y", "z"][axis]
                    );
                    return Err(at.reject("plane.normal", &allowed));
                }
                Ok(Mouth::Beyond {
                    point: vector(plane.at),
                    normal,
                })
            }
            _ => {
                let allowed = "must hold one place: `region` or `plane`";
                Err(at.document.reject(at.key, allowed))
            }
        }
    }
}
