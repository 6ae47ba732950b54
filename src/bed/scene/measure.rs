//! Measures of a scene: what to find out beside the usual series.

use super::region::Region;
use super::region::RegionTable;
use super::written::vector;
use crate::Result;
use crate::document::Document;
use crate::document::keys::{key, keys, table};
use crate::error::must_be_one_of;
use crate::unit::{Length, Quantity};
use serde::Deserialize;

/// Something to be measured.
#[derive(Debug, Clone, PartialEq)]
pub enum Measure {
    /// Angle of repose of the heap at the end.
    Repose {
        /// Place (m) of the vertical axis of the heap along x and y.
        axis: [f64; 2],
        /// Height of the floor, m.
        floor: f64,
    },
    /// Mean slope of the free surface in a drum that turns about the axis y, in the last stage.
    Slope,
    /// Mass flow down through a horizontal plane.
    Flow(Plane),
    /// Depth and deceleration of a body that falls into the bed.
    Plunge {
        /// Name of the body.
        body: String,
    },
}

/// Plane of a flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Height, m.
    pub height: f64,
    /// Orifice the flow comes out of, to be compared with Beverloo's law.
    pub orifice: Option<Orifice>,
}

/// Orifice of a silo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orifice {
    /// Diameter, m.
    pub diameter: f64,
    /// Beverloo's C and k.
    pub constants: [f64; 2],
    /// Where the bulk density of the filling is taken.
    pub filling: Region,
}

/// Table `[[measure]]`.
#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum MeasureTable {
    Repose {
        axis: [Quantity<Length>; 3],
    },
    Slope {},
    Flow {
        height: Quantity<Length>,
        orifice: Option<OrificeTable>,
    },
    Plunge {
        body: String,
    },
}

keys! {
    enum MeasureTable by "kind" {
        Repose as "repose" "Angle of repose of the heap at the end." {
            axis: key("where the heap's vertical axis meets the floor", "", "['0 mm', '0 mm', '0 mm']"),
        }
        Slope as "slope" "Mean slope of the free surface in a drum that turns about the axis y, in the last stage." {
        }
        Flow as "flow" "Mass flow down through a horizontal plane." {
            height: key("height of the plane", "", "'55 mm'"),
            orifice: table("orifice to compare with Beverloo's law").or("none"),
        }
        Plunge as "plunge" "Depth and deceleration of a body that falls into the bed." {
            body: key("the body", "of a body", "'ball'"),
        }
    } and {
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OrificeTable {
    diameter: Quantity<Length>,
    #[serde(rename = "C")]
    coefficient: f64,
    k: f64,
    filling: RegionTable,
}

keys! {
    OrificeTable {
        diameter: key("diameter", "> 0", "'16 mm'"),
        coefficient as "C": key("Beverloo's C", "> 0", "0.58"),
        k: key("Beverloo's k", "> 0", "1.4"),
        filling: table("where the bulk density of the filling is taken"),
    }
}

pub(super) fn check_measures(
    document: &Document,
    tables: Vec<MeasureTable>,
    bodies: &[String],
) -> Result<Vec<Measure>> {
    let tables = tables.into_iter().enumerate();
    tables
        .map(|(index, table)| table.check(document, &format!("measure[{index}]"), bodies))
        .collect()
}

impl MeasureTable {
    fn check(self, document: &Document, key: &str, bodies: &[String]) -> Result<Measure> {
        Ok(match self {
            MeasureTable::Repose { axis } => {
                let foot = vector(axis);
                Measure::Repose {
                    axis: [foot.x, foot.y],
                    floor: foot.z,
                }
            }
            MeasureTable::Slope {} => Measure::Slope,
            MeasureTable::Flow { height, orifice } => Measure::Flow(Plane {
                height: height.si(),
                orifice: match orifice {
                    Some(table) => Some(table.check(document, &format!("{key}.orifice"))?),
                    None => None,
                },
            }),
            MeasureTable::Plunge { body } if bodies.contains(&body) => Measure::Plunge { body },
            MeasureTable::Plunge { .. } => {
                return Err(document.reject(&format!("{key}.body"), must_be_one_of(bodies)));
            }
        })
    }
}

impl OrificeTable {
    fn check(&self, document: &Document, key: &str) -> Result<Orifice> {
        let at = |name: &str| format!("{key}.{name}");
        let positive = "must be positive, e.g. C = 0.58 and k = 1.4 for smooth spheres";
        Ok(Orifice {
            diameter: document.positive(&at("diameter"), self.diameter)?,
            constants: [
                document.check(&at("C"), self.coefficient, |c| c > 0.0, positive)?,
                document.check(&at("k"), self.k, |k| k > 0.0, positive)?,
            ],
            filling: self.filling.check(document, &at("filling"))?,
        })
    }
}
