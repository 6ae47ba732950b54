//! Bodies of a scene as they are written: one shape, one place, one way to move.

use super::at::{At, check_name};
use super::drive::{BeltTable, DrivenTable, FreeTable};
use super::material::GrainMaterial;
use super::written::vector;
use crate::Result;
use crate::dem::bodies::mesh::{self, Format};
use crate::dem::bodies::{Body, Mobility, Solid};
use crate::document::Document;
use crate::document::keys::{key, keys, table};
use crate::error::must_be_one_of;
use crate::unit::{Angle, Length, Quantity, engineering};
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
    tolerance: Option<Quantity<Length>>,
    at: Option<[Quantity<Length>; 3]>,
    turn: Option<TurnTable>,
    driven: Option<DrivenTable>,
    belt: Option<BeltTable>,
    free: Option<FreeTable>,
}

keys! {
    BodyTable "One shape: `block`, `ball`, `cylinder`, `plane`, `cone` or `mesh`. One way to move: fixed, `driven`, a `belt` or `free`." {
        name: key("name, for stages and files", "any, but of a wall of the box", "'tube'"),
        material: key("a body that flattens too", "one of `materials`", "'steel'").or("rigid"),
        block: table("a block").or("one shape"),
        ball: table("a ball").or("one shape"),
        cylinder: table("a cylinder").or("one shape"),
        plane: table("the half of space below a plane").or("one shape"),
        cone: table("the thin wall of a cone, tube or ring").or("one shape"),
        mesh: key("triangles", "an STL or OBJ file", "'drum.stl'").or("one shape"),
        scale: key("length that 1 in the file means", "> 0", "'1 mm'").or("required beside `mesh`"),
        tolerance: key("corners of the mesh closer than this are one", "≥ 0, < the smallest radius", "'1 um'").or("a thousandth of the smallest radius"),
        at: key("centre of the shape; a point of a plane; origin of a mesh", "", "['0 mm', '0 mm', '5 mm']").or("0"),
        turn: table("turn about its centre").or("none"),
        driven: table("told motion; an empty one waits for a stage").or("fixed"),
        belt: table("motion of the surface of a body that stands; an empty one waits for a stage").or("fixed"),
        free: table("motion under forces").or("fixed"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BlockTable {
    size: [Quantity<Length>; 3],
}

keys! {
    BlockTable {
        size: key("edges", "> 0", "['10 mm', '10 mm', '1 mm']"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BallTable {
    radius: Quantity<Length>,
}

keys! {
    BallTable {
        radius: key("radius", "> 0", "'6 mm'"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CylinderTable {
    radius: Quantity<Length>,
    length: Quantity<Length>,
    axis: Option<[f64; 3]>,
}

keys! {
    CylinderTable {
        radius: key("radius", "> 0", "'6 mm'"),
        length: key("length", "> 0", "'20 mm'"),
        axis: key("direction of its axis", "not 0", "[1.0, 0.0, 0.0]").or("`[0, 0, 1]`"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneTable {
    normal: [f64; 3],
}

keys! {
    PlaneTable {
        normal: key("out of the solid side", "not 0", "[0.0, 0.0, 1.0]"),
    }
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

keys! {
    ConeTable "Equal radii make a tube, no height a flat ring." {
        bottom_radius: key("radius below", "≥ 0", "'8 mm'"),
        top_radius: key("radius above", "≥ 0", "'21 mm'"),
        height: key("height", "≥ 0", "'0 mm'"),
        sides: key("flat sides it is made of", "8 to 1000", "36").or("48"),
    }
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

keys! {
    TurnTable {
        axis: key("axis of the turn", "not 0", "[0.0, 1.0, 0.0]"),
        angle: key("angle", "", "'30 deg'"),
    }
}

/// Distance between two corners of a mesh below which they are one, over the smallest radius, where the scene does not
/// say: files round their numbers, and a grain cannot feel so small a step.
const TOLERANCE: f64 = 1e-3;
/// Extent of a mesh over the smallest radius below which its `scale` is taken for a slip.
const SMALLEST_EXTENT: f64 = 0.1;

/// A shape, and how it stands.
struct Shape {
    solid: Solid,
    /// Turn that brings its own axis where the table wants it.
    turn: Rotation,
    /// Why its surface is not closed, if it is not.
    opening: Option<String>,
}

impl Shape {
    fn turned(solid: Solid, turn: Rotation) -> Self {
        Self {
            solid,
            turn,
            opening: None,
        }
    }
}

/// Files a scene names, by name, with their bytes: what its hash covers beside its own text.
pub(super) type Files = BTreeMap<String, Vec<u8>>;

pub(super) fn check_bodies(
    document: &Document,
    tables: Vec<BodyTable>,
    reserved: &[&str],
    materials: &[GrainMaterial],
    smallest_radius: f64,
    files: &mut Files,
) -> Result<Vec<Body>> {
    let mut bodies: Vec<Body> = Vec::new();
    for (index, table) in tables.into_iter().enumerate() {
        let key = format!("body[{index}]");
        check_name(document, &format!("{key}.name"), &table.name)?;
        let taken = bodies.iter().any(|body| body.name == table.name);
        if taken || reserved.contains(&&table.name[..]) {
            let allowed = "must be a name of its own: no other body's, and none of a wall of the box or its piston";
            return Err(document.reject(&format!("{key}.name"), allowed));
        }
        let at = At {
            document,
            key: &key,
        };
        let material = table.material(&at, materials)?;
        bodies.push(Body {
            material: material.map(|index| index as u8),
            ..table.check(&at, smallest_radius, files)?
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

    fn check(self, at: &At, smallest_radius: f64, files: &mut Files) -> Result<Body> {
        let shape = self.shape(at, smallest_radius, files)?;
        let turn = match &self.turn {
            Some(turn) => {
                Rotation::from_axis_angle(at.direction("turn.axis", turn.axis)?, turn.angle.si())
            }
            None => Rotation::IDENTITY,
        };
        let centre = self.at.map_or(Vector::ZERO, vector);
        let rotation = turn * shape.turn;
        let mobility = match (&self.driven, &self.belt, &self.free) {
            (None, None, None) => Mobility::Fixed,
            (Some(driven), None, None) => {
                Mobility::Driven(driven.check(at.document, &at.name("driven"))?)
            }
            (None, Some(belt), None) => {
                let belt = belt.check(at.document, &at.name("belt"), centre)?;
                let normal = rotation * Vector::Z;
                let stands = belt.velocity != Vector::ZERO
                    && belt.at(centre, normal).length() < 1e-9 * belt.velocity.length();
                if shape.solid == Solid::HalfSpace && belt.spin == Vector::ZERO && stands {
                    return Err(at.reject(
                        "belt.velocity",
                        "must have a part along the plane: a belt moves along itself",
                    ));
                }
                if shape.solid == Solid::HalfSpace && belt.spin != Vector::ZERO {
                    return Err(at.reject(
                        "belt.spin",
                        "must not be given to a plane: it has no end, and its speed no bound",
                    ));
                }
                Mobility::Belt(belt)
            }
            (None, None, Some(free)) => {
                if let Some(opening) = &shape.opening {
                    let allowed = format!(
                        "must be a closed surface for a free body, whose mass is spread over its inside: {opening}; close the mesh, or make the body driven or fixed"
                    );
                    return Err(at.document.reject(at.key, &allowed));
                }
                Mobility::Free(free.check(at, &shape.solid)?)
            }
            (_, Some(_), _) => {
                return Err(at.reject(
                    "belt",
                    "must stand alone: the surface of a body moves only while the body stands",
                ));
            }
            (Some(_), None, Some(_)) => {
                return Err(at.reject(
                    "free",
                    "must not stand beside `driven`: one body, one way to move",
                ));
            }
        };
        Ok(Body {
            name: self.name,
            solid: shape.solid,
            centre,
            rotation,
            mobility,
            material: None,
        })
    }

    fn shape(&self, at: &At, smallest_radius: f64, files: &mut Files) -> Result<Shape> {
        let shapes = [
            ("`block`", self.block.is_some()),
            ("`ball`", self.ball.is_some()),
            ("`cylinder`", self.cylinder.is_some()),
            ("`plane`", self.plane.is_some()),
            ("`cone`", self.cone.is_some()),
            ("`mesh`", self.mesh.is_some()),
        ];
        let given: Vec<&str> = shapes
            .iter()
            .filter(|(_, given)| *given)
            .map(|(name, _)| *name)
            .collect();
        if given.len() != 1 {
            let has = match given.is_empty() {
                true => "no shape".to_owned(),
                false => given.join(" and "),
            };
            let allowed = format!(
                "must hold one shape: `block`, `ball`, `cylinder`, `plane`, `cone` or `mesh`; it has {has}"
            );
            return Err(at.document.reject(at.key, allowed));
        }
        if self.mesh.is_some() != self.scale.is_some() {
            let allowed =
                "must stand beside `mesh`: the length that 1 in the mesh file means, e.g. \"1 mm\"";
            return Err(at.reject("scale", allowed));
        }
        if self.mesh.is_none() && self.tolerance.is_some() {
            let allowed = "must stand beside `mesh`: corners closer than this are one";
            return Err(at.reject("tolerance", allowed));
        }
        if let Some(block) = &self.block {
            let size = vector(block.size);
            if !size.cmpgt(Vector::ZERO).all() {
                return Err(at.reject("block.size", "must be positive along every axis"));
            }
            return Ok(Shape::turned(Solid::Cuboid(0.5 * size), Rotation::IDENTITY));
        }
        if let Some(ball) = &self.ball {
            let radius = at.positive("ball.radius", ball.radius)?;
            return Ok(Shape::turned(Solid::Ball(radius), Rotation::IDENTITY));
        }
        if let Some(cylinder) = &self.cylinder {
            let axis = at.direction("cylinder.axis", cylinder.axis.unwrap_or([0.0, 0.0, 1.0]))?;
            let solid = Solid::Cylinder {
                radius: at.positive("cylinder.radius", cylinder.radius)?,
                half_height: 0.5 * at.positive("cylinder.length", cylinder.length)?,
            };
            let turn = Rotation::from_rotation_arc(Vector::Y, axis);
            return Ok(Shape::turned(solid, turn));
        }
        if let Some(plane) = &self.plane {
            let normal = at.direction("plane.normal", plane.normal)?;
            let turn = Rotation::from_rotation_arc(Vector::Z, normal);
            return Ok(Shape::turned(Solid::HalfSpace, turn));
        }
        if let Some(cone) = &self.cone {
            return Ok(Shape {
                solid: cone.check(at)?,
                turn: Rotation::IDENTITY,
                opening: Some("a cone is open at both ends".to_owned()),
            });
        }
        self.read_mesh(at, smallest_radius, files)
    }

    fn read_mesh(&self, at: &At, smallest_radius: f64, files: &mut Files) -> Result<Shape> {
        let (Some(name), Some(scale)) = (&self.mesh, self.scale) else {
            return Err(at.reject("mesh", "must name an STL or OBJ file"));
        };
        let unit = at.positive("scale", scale)?;
        let tolerance = self.tolerance(at, smallest_radius)?;
        let path = at.document.resolve(name);
        let bytes = std::fs::read(&path).map_err(|error| {
            let allowed = format!(
                "must name an STL or OBJ file that can be read: {}: {error}",
                path.display()
            );
            at.reject("mesh", &allowed)
        })?;
        let import = mesh::read(&bytes, Format::of(name), unit, tolerance)
            .map_err(|wrong| at.reject("mesh", &format!("{} {wrong}", path.display())))?;
        let extent = import.solid.extent().max_element();
        if extent < SMALLEST_EXTENT * smallest_radius {
            let allowed = format!(
                "must not be so much smaller than the grains: {} across against a radius of {}; look at `scale`",
                engineering(extent, "m", 2),
                engineering(smallest_radius, "m", 2)
            );
            return Err(at.reject("mesh", &allowed));
        }
        for warning in &import.warnings {
            tracing::warn!("{} {warning}", path.display());
        }
        files.insert(name.clone(), bytes);
        Ok(Shape {
            solid: import.solid,
            turn: Rotation::IDENTITY,
            opening: import.opening,
        })
    }

    fn tolerance(&self, at: &At, smallest_radius: f64) -> Result<f64> {
        let Some(tolerance) = self.tolerance else {
            return Ok(TOLERANCE * smallest_radius);
        };
        at.document.check(
            &at.name("tolerance"),
            tolerance.si(),
            |tolerance| (0.0..smallest_radius).contains(&tolerance),
            "must be 0 or more, and less than the smallest grain radius",
        )
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
