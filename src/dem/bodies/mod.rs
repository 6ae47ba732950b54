//! Bodies: what is not a grain, as a scene describes it: shape, place and how it may move.

pub mod belt;
pub mod enclosure;
pub mod machine;
pub mod mesh;
pub mod motion;
pub(crate) mod touching;

use self::belt::Belt;
use self::motion::Motion;
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
    /// Everything below the plane z = 0.
    HalfSpace,
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
    /// Never moves, but its surface does.
    Belt(Belt),
    /// Moves as told, whatever the grains do.
    Driven(Motion),
    /// Moves under gravity and the grains.
    Free(Freedom),
}

/// A free body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Freedom {
    /// Mass, kg, spread evenly over the shape.
    pub mass: f64,
    /// Velocity at the start, m/s.
    pub velocity: Vector,
    /// Angular velocity at the start, rad/s.
    pub spin: Vector,
    /// Constant force from outside on the centre of mass, N: a dead load.
    pub force: Vector,
    /// What holds it.
    pub joint: Option<Joint>,
    /// Held in place until a stage releases it.
    pub held: bool,
}

/// Joint of a free body to the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// What is left free.
    pub kind: JointKind,
    /// Point of the joint, m; the body's centre if none.
    pub point: Option<Vector>,
    /// Drive along or about the axis.
    pub motor: Option<Motor>,
}

/// What a joint leaves free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointKind {
    /// Sliding along an axis.
    Prismatic(Vector),
    /// Turning about an axis.
    Revolute(Vector),
    /// Turning about a point.
    Spherical,
    /// Nothing.
    Fixed,
}

/// Motor of a prismatic or revolute joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// Speed aimed at, m/s or rad/s.
    pub speed: f64,
    /// Largest force (N) or torque (N m).
    pub strength: f64,
}

impl Freedom {
    /// A body of `mass` (kg) that nothing holds, at rest.
    #[must_use]
    pub fn of_mass(mass: f64) -> Self {
        Self {
            mass,
            velocity: Vector::ZERO,
            spin: Vector::ZERO,
            force: Vector::ZERO,
            joint: None,
            held: false,
        }
    }

    /// The same on a joint that lets it slide along `axis` only.
    #[must_use]
    pub fn sliding(self, axis: Vector) -> Self {
        Self {
            joint: Some(Joint {
                kind: JointKind::Prismatic(axis),
                point: None,
                motor: None,
            }),
            ..self
        }
    }
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
    /// Material that flattens, as an index into those of the scene; none for a rigid body.
    pub material: Option<u8>,
}

impl Body {
    /// Material that flattens, as an index into those of the scene.
    #[must_use]
    pub fn flattening_material(&self) -> Option<usize> {
        self.material.map(usize::from)
    }

    /// Fixed block between two corners (m).
    #[must_use]
    pub fn block(name: &str, low: Vector, high: Vector) -> Self {
        Self {
            name: name.to_owned(),
            solid: Solid::Cuboid(0.5 * (high - low)),
            centre: 0.5 * (low + high),
            rotation: Rotation::IDENTITY,
            mobility: Mobility::Fixed,
            material: None,
        }
    }
}

impl Body {
    /// Corners (m) of the block around the body; none for a plane.
    #[must_use]
    pub fn corners(&self) -> Option<[Vector; 2]> {
        let half = match &self.solid {
            Solid::HalfSpace => return None,
            Solid::Ball(radius) => Vector::splat(*radius),
            Solid::Cuboid(half) => *half,
            Solid::Cylinder {
                radius,
                half_height,
            } => Vector::new(*radius, *half_height, *radius),
            Solid::Mesh { vertices, .. } => {
                let placed = vertices.iter().map(|v| self.centre + self.rotation * *v);
                return placed.fold(None, |corners: Option<[Vector; 2]>, v| {
                    let [low, high] = corners.unwrap_or([v, v]);
                    Some([low.min(v), high.max(v)])
                });
            }
        };
        let turned = [Vector::X, Vector::Y, Vector::Z]
            .map(|axis| (self.rotation * (axis * half)).abs())
            .into_iter()
            .sum::<Vector>();
        Some([self.centre - turned, self.centre + turned])
    }
}

impl Solid {
    /// parry's shape, with lengths in `unit` (m).
    ///
    /// # Errors
    /// [`Error::Bodies`] for a mesh without triangles or with a corner that does not exist.
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
            Solid::HalfSpace => SharedShape::halfspace(Vector::Z),
            Solid::Mesh {
                vertices,
                triangles,
            } => {
                let vertices = vertices.iter().map(|v| *v / unit).collect();
                let flags = TriMeshFlags::MERGE_DUPLICATE_VERTICES
                    | TriMeshFlags::DELETE_DEGENERATE_TRIANGLES
                    | TriMeshFlags::DELETE_DUPLICATE_TRIANGLES;
                SharedShape::trimesh_with_flags(vertices, triangles.clone(), flags).map_err(
                    |e| Error::Bodies {
                        reason: format!(
                            "a triangle mesh is broken ({e}); repair the file that holds it"
                        ),
                    },
                )?
            }
        })
    }

    /// Volume, m3; none for a plane, and of no meaning for an open mesh.
    ///
    /// # Errors
    /// As [`Solid::shape`].
    pub fn volume(&self, unit: f64) -> Result<Option<f64>> {
        if matches!(self, Solid::HalfSpace) {
            return Ok(None);
        }
        let mass = self.shape(unit)?.mass_properties(1.0).mass();
        Ok(Some(mass * unit.powi(3)))
    }

    /// Edges (m) of the block about the corners of a mesh; infinite for what has no corners.
    #[must_use]
    pub fn extent(&self) -> Vector {
        let Solid::Mesh { vertices, .. } = self else {
            return Vector::INFINITY;
        };
        let low = vertices.iter().copied().fold(Vector::MAX, Vector::min);
        vertices.iter().copied().fold(Vector::MIN, Vector::max) - low
    }

    /// Radius (m) about the origin that holds the shape; infinite for a plane.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self {
            Solid::Cuboid(half) => half.length(),
            Solid::Ball(radius) => *radius,
            Solid::Cylinder {
                radius,
                half_height,
            } => radius.hypot(*half_height),
            Solid::HalfSpace => f64::INFINITY,
            Solid::Mesh { vertices, .. } => {
                vertices.iter().fold(0.0, |reach, v| reach.max(v.length()))
            }
        }
    }
}
