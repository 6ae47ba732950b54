//! Bodies of a scene as they are written: one shape, one place, one way to move.

use super::at::At;
use super::drive::{DrivenTable, FreeTable};
use super::material::GrainMaterial;
use super::written::vector;
use crate::Result;
use crate::dem::bodies::mesh;
use crate::dem::bodies::{Body, Mobility, Solid};
use crate::document::Document;
use crate::error::must_be_one_of;
use crate::unit::{Angle, Length, Quantity};
use parry3d::math::{Rotation, Vector};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Table `[[body]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyTable {
    name: String,
    material: Option<String>,
    block: Option<BlockTable>,
    ball: Option<BallTable>,
    cylinder: Option<CylinderTable>,
    plane: Option<PlaneTable>,
    cone: Option<ConeTable>,
    mesh: Option<String>,
    scale: Option<Quantity<Length>>,
    at: Option<[Quantity<Length>; 3]>,
    turn: Option<TurnTable>,
    driven: Option<DrivenTable>,
    free: Option<FreeTable>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BlockTable {
    size: [Quantity<Length>; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BallTable {
    radius: Quantity<Length>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CylinderTable {
    radius: Quantity<Length>,
    length: Quantity<Length>,
    axis: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneTable {
    normal: [f64; 3],
}

/// Thin wall of a cone cut off at both ends: equal radii make a tube, no height a ring.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ConeTable {
    bottom_radius: Quantity<Length>,
    top_radius: Quantity<Length>,
    height: Quantity<Length>,
    #[serde(default = "usual_sides")]
    sides: u32,
}

fn usual_sides() -> u32 {
    48
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TurnTable {
    axis: [f64; 3],
    angle: Quantity<Angle>,
}

/// Files a scene names, by name, with their bytes: what its hash covers beside its own text.
pub(super) type Files = BTreeMap<String, Vec<u8>>;

pub(super) fn check_bodies(
    document: &Document,
    tables: Vec<BodyTable>,
    reserved: &[&str],
    materials: &[GrainMaterial],
    files: &mut Files,
) -> Result<Vec<Body>> {
    let mut bodies: Vec<Body> = Vec::new();
    for (index, table) in tables.into_iter().enumerate() {
        let key = format!("body[{index}]");
        let taken = bodies.iter().any(|body| body.name == table.name);
        if taken || table.name.is_empty() || reserved.contains(&&table.name[..]) {
            let allowed = "must be a name of its own: no other body's, and none of the box's walls";
            return Err(document.reject(&format!("{key}.name"), allowed));
        }
        let at = At {
            document,
            key: &key,
        };
        let material = table.material(&at, materials)?;
        bodies.push(Body {
            material: material.map(|index| index as u8),
            ..table.check(&at, files)?
        });
    }
    Ok(bodies)
}

impl BodyTable {
    fn material(&self, at: &At, materials: &[GrainMaterial]) -> Result<Option<usize>> {
        let Some(name) = &self.material else {
            return Ok(None);
        };
        let place = materials.iter().position(|material| material.name == *name);
        place.map(Some).ok_or_else(|| {
            let names = materials.iter().map(|material| &material.name);
            let allowed = format!("{}, or left out for a rigid body", must_be_one_of(names));
            at.reject("material", &allowed)
        })
    }

    fn check(self, at: &At, files: &mut Files) -> Result<Body> {
        let (solid, own_turn) = self.solid(at, files)?;
        let turn = match &self.turn {
            Some(turn) => {
                Rotation::from_axis_angle(at.direction("turn.axis", turn.axis)?, turn.angle.si())
            }
            None => Rotation::IDENTITY,
        };
        let mobility = match (&self.driven, &self.free) {
            (None, None) => Mobility::Fixed,
            (Some(driven), None) => {
                Mobility::Driven(driven.check(at.document, &at.name("driven"))?)
            }
            (None, Some(free)) => Mobility::Free(free.check(at, &solid)?),
            (Some(_), Some(_)) => {
                return Err(at.reject(
                    "free",
                    "must not stand beside `driven`: one body, one way to move",
                ));
            }
        };
        Ok(Body {
            name: self.name,
            solid,
            centre: self.at.map_or(Vector::ZERO, vector),
            rotation: turn * own_turn,
            mobility,
            material: None,
        })
    }

    /// Shape, and the turn that brings its own axis where the table wants it.
    fn solid(&self, at: &At, files: &mut Files) -> Result<(Solid, Rotation)> {
        let shapes = [
            self.block.is_some(),
            self.ball.is_some(),
            self.cylinder.is_some(),
            self.plane.is_some(),
            self.cone.is_some(),
            self.mesh.is_some(),
        ];
        if shapes.iter().filter(|shape| **shape).count() != 1 {
            let allowed =
                "must hold one shape: `block`, `ball`, `cylinder`, `plane`, `cone` or `mesh`";
            return Err(at.document.reject(at.key, allowed));
        }
        if self.mesh.is_some() != self.scale.is_some() {
            let allowed =
                "must stand beside `mesh`: the length that 1 in the STL file means, e.g. \"1 mm\"";
            return Err(at.reject("scale", allowed));
        }
        if let Some(block) = &self.block {
            let size = vector(block.size);
            if !size.cmpgt(Vector::ZERO).all() {
                return Err(at.reject("block.size", "must be positive along every axis"));
            }
            return Ok((Solid::Cuboid(0.5 * size), Rotation::IDENTITY));
        }
        if let Some(ball) = &self.ball {
            let radius = at.positive("ball.radius", ball.radius)?;
            return Ok((Solid::Ball(radius), Rotation::IDENTITY));
        }
        if let Some(cylinder) = &self.cylinder {
            let axis = at.direction("cylinder.axis", cylinder.axis.unwrap_or([0.0, 0.0, 1.0]))?;
            let solid = Solid::Cylinder {
                radius: at.positive("cylinder.radius", cylinder.radius)?,
                half_height: 0.5 * at.positive("cylinder.length", cylinder.length)?,
            };
            return Ok((solid, Rotation::from_rotation_arc(Vector::Y, axis)));
        }
        if let Some(plane) = &self.plane {
            let normal = at.direction("plane.normal", plane.normal)?;
            return Ok((
                Solid::HalfSpace,
                Rotation::from_rotation_arc(Vector::Z, normal),
            ));
        }
        if let Some(cone) = &self.cone {
            return Ok((cone.check(at)?, Rotation::IDENTITY));
        }
        Ok((self.read_mesh(at, files)?, Rotation::IDENTITY))
    }

    fn read_mesh(&self, at: &At, files: &mut Files) -> Result<Solid> {
        let (Some(name), Some(scale)) = (&self.mesh, self.scale) else {
            return Err(at.reject("mesh", "must name an STL file"));
        };
        let unit = at.positive("scale", scale)?;
        let path = at.document.resolve(name);
        let bytes = std::fs::read(&path).map_err(|error| {
            let allowed = format!(
                "must name an STL file that can be read: {}: {error}",
                path.display()
            );
            at.reject("mesh", &allowed)
        })?;
        let solid = mesh::read_stl(&bytes, unit)
            .map_err(|wrong| at.reject("mesh", &format!("{} {wrong}", path.display())))?;
        files.insert(name.clone(), bytes);
        Ok(solid)
    }
}

impl ConeTable {
    fn check(&self, at: &At) -> Result<Solid> {
        if self.sides < 8 || self.sides > 1000 {
            return Err(at.reject("cone.sides", "must lie in [8, 1000]"));
        }
        let name = |radius: &str| at.name(&format!("cone.{radius}"));
        let bottom = at
            .document
            .non_negative(&name("bottom_radius"), self.bottom_radius)?;
        let top = at
            .document
            .non_negative(&name("top_radius"), self.top_radius)?;
        let height = at.document.non_negative(&name("height"), self.height)?;
        if height == 0.0 && bottom == top {
            return Err(at.reject("cone.height", "must be positive between equal radii"));
        }
        Ok(mesh::cone(bottom, top, height, self.sides))
    }
}
