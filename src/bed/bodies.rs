//! Bodies: what is not a grain, as a scene describes it: shape, place and how it may move.

use crate::{Error, Result};
use parry3d::math::{Rotation, Vector};
use parry3d::shape::{SharedShape, TriMeshFlags};

/// Shape of a body, SI units, about its own origin.
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// Rectangular block with half its edges.
    Cuboid(Vector),
    /// Ball of a radius.
    Ball(f64),
    /// Cylinder about the y axis.
    Cylinder {
        /// Radius, m.
        radius: f64,
        /// Half the length, m.
        half_height: f64,
    },
    /// Triangle mesh; grains touch both of its sides.
    Mesh {
        /// Corners, m.
        vertices: Vec<Vector>,
        /// Corners of each triangle.
        triangles: Vec<[u32; 3]>,
    },
}

/// How a body may move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mobility {
    /// Never moves.
    Fixed,
    /// Moves as told, whatever the grains do.
    Driven {
        /// Velocity, m/s.
        velocity: Vector,
        /// Angular velocity, rad/s.
        spin: Vector,
    },
    /// Moves under gravity and the grains.
    Free {
        /// Mass, kg, spread evenly over the shape.
        mass: f64,
        /// Axis of a prismatic joint to the ground, which holds it in all other directions.
        slide: Option<Vector>,
    },
}

/// A body of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Name, for messages and files.
    pub name: String,
    /// Shape.
    pub solid: Solid,
    /// Place of its origin, m.
    pub centre: Vector,
    /// Orientation.
    pub rotation: Rotation,
    /// How it may move.
    pub mobility: Mobility,
}

impl Body {
    /// Fixed block between two corners (m).
    #[must_use]
    pub fn block(name: &str, low: Vector, high: Vector) -> Self {
        Self {
            name: name.to_owned(),
            solid: Solid::Cuboid(0.5 * (high - low)),
            centre: 0.5 * (low + high),
            rotation: Rotation::IDENTITY,
            mobility: Mobility::Fixed,
        }
    }
}

impl Solid {
    /// parry's shape, with lengths in `unit` (m).
    ///
    /// # Errors
    /// [`Error::Bed`] for a mesh without triangles or with a corner that does not exist.
    pub fn shape(&self, unit: f64) -> Result<SharedShape> {
        Ok(match self {
            Solid::Cuboid(half) => {
                let half = *half / unit;
                SharedShape::cuboid(half.x, half.y, half.z)
            }
            Solid::Ball(radius) => SharedShape::ball(radius / unit),
            Solid::Cylinder {
                radius,
                half_height,
            } => SharedShape::cylinder(half_height / unit, radius / unit),
            Solid::Mesh {
                vertices,
                triangles,
            } => {
                let vertices = vertices.iter().map(|v| *v / unit).collect();
                let flags = TriMeshFlags::MERGE_DUPLICATE_VERTICES
                    | TriMeshFlags::DELETE_DEGENERATE_TRIANGLES
                    | TriMeshFlags::DELETE_DUPLICATE_TRIANGLES;
                SharedShape::trimesh_with_flags(vertices, triangles.clone(), flags).map_err(
                    |e| Error::Bed {
                        step: 0,
                        reason: format!(
                            "a triangle mesh is broken ({e}); repair the file that holds it"
                        ),
                    },
                )?
            }
        })
    }
}
