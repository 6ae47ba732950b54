//! Portrait: what a picture of a bed shows, from the bed itself or from a frame of its film.

use super::film::Frame;
use super::outline::Outline;
use crate::dem::bodies::Mobility;
use crate::dem::dynamics::any::AnyBed;
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::shape::SharedShape;
use std::sync::Arc;

/// Part of the grains, at each end of an axis, that a picture need not hold: a stray grain does not shrink the bed.
const STRAY: f64 = 0.002;

/// What a picture shows; lengths count the largest radius.
#[derive(Clone)]
pub struct Portrait {
    /// Centres.
    pub centres: Vec<Vector>,
    /// Radii.
    pub radii: Vec<f64>,
    /// Sum of the contact forces on each grain, as magnitudes, N.
    pub squeeze: Vec<f64>,
    /// Energy dissipated by plastic flow in the contacts of each grain, J.
    pub plastic: Vec<f64>,
    /// Material of each grain.
    pub materials: Vec<u8>,
    /// Group of each grain.
    pub groups: Vec<u32>,
    /// Bodies.
    pub bodies: Vec<Sitter>,
    /// Unit of length, m.
    pub unit: f64,
    /// Time, s.
    pub time: f64,
    /// Stage.
    pub stage: String,
}

/// A body in a picture; lengths count the largest radius.
#[derive(Clone)]
pub struct Sitter {
    /// Shape.
    pub shape: SharedShape,
    /// Place and orientation.
    pub pose: Pose,
    /// Its edges.
    pub outline: Arc<Outline>,
    /// Moves by itself: drawn solid, where walls are drawn as glass.
    pub free: bool,
}

/// Bodies of a run with what does not change from frame to frame.
pub struct Cast {
    unit: f64,
    sitters: Vec<Sitter>,
}

impl Cast {
    /// Bodies of a bed.
    #[must_use]
    pub fn of(bed: &dyn AnyBed) -> Self {
        let (grains, machine) = (bed.grains(), bed.machine());
        let unit = match grains.largest_radius() {
            radius if radius > 0.0 => radius,
            _ => machine.unit,
        };
        let sitters = machine.bodies().iter().zip(&machine.surfaces);
        let sitters = sitters.filter_map(|(body, surface)| {
            Some(Sitter {
                shape: scaled(&surface.shape, machine.unit / unit)?,
                pose: Pose::IDENTITY,
                outline: Arc::new(Outline::of(&*surface.shape, machine.unit / unit)),
                free: matches!(body.mobility, Mobility::Free { .. }),
            })
        });
        Self {
            unit,
            sitters: sitters.collect(),
        }
    }

    /// Unit of length, m: the largest radius.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The bed at a frame of its film.
    #[must_use]
    pub fn at(&self, frame: &Frame) -> Portrait {
        let length = |x: f32| f64::from(x) / self.unit;
        let wide = |values: &[f32]| values.iter().map(|&v| f64::from(v)).collect();
        let there = self.sitters.iter().zip(&frame.poses).enumerate();
        let there = there.filter(|(index, _)| !frame.gone.contains(index));
        Portrait {
            unit: self.unit,
            time: frame.time,
            stage: frame.stage.clone(),
            centres: frame
                .centres
                .iter()
                .map(|c| Vector::from(c.map(length)))
                .collect(),
            radii: frame.radii.iter().map(|&radius| length(radius)).collect(),
            squeeze: wide(&frame.squeeze),
            plastic: wide(&frame.plastic),
            materials: frame.materials.clone(),
            groups: frame.groups.clone(),
            bodies: there
                .map(|(_, (sitter, &[x, y, z, i, j, k, w]))| {
                    let turn = [i, j, k, w].map(f64::from);
                    Sitter {
                        pose: Pose::from_parts(
                            Vector::new(length(x), length(y), length(z)),
                            Rotation::from_array(turn).normalize(),
                        ),
                        ..sitter.clone()
                    }
                })
                .collect(),
        }
    }
}

/// A shape `factor` times as large; none for a kind that has no size of its own to show.
fn scaled(shape: &SharedShape, factor: f64) -> Option<SharedShape> {
    if shape.as_halfspace().is_some() {
        return Some(shape.clone());
    }
    if let Some(ball) = shape.as_ball() {
        return Some(SharedShape::ball(ball.radius * factor));
    }
    if let Some(block) = shape.as_cuboid() {
        let half = block.half_extents * factor;
        return Some(SharedShape::cuboid(half.x, half.y, half.z));
    }
    if let Some(cylinder) = shape.as_cylinder() {
        return Some(SharedShape::cylinder(
            cylinder.half_height * factor,
            cylinder.radius * factor,
        ));
    }
    let mesh = shape.as_trimesh()?.clone().scaled(Vector::splat(factor));
    Some(SharedShape::new(mesh))
}

impl Portrait {
    /// The bed as it is.
    #[must_use]
    pub fn of(bed: &dyn AnyBed) -> Self {
        Cast::of(bed).at(&Frame::of(bed, ""))
    }

    /// The bed cut open by the upright plane through its middle that faces the eye: grains in front of it are left out.
    #[must_use]
    pub fn cut_open(&self) -> Self {
        let [low, high] = self.bounds();
        let middle = 0.5 * (low.y + high.y);
        let behind: Vec<usize> = (0..self.centres.len())
            .filter(|&grain| self.centres[grain].y > middle)
            .collect();
        let pick = |values: &[f64]| behind.iter().map(|&grain| values[grain]).collect();
        Self {
            centres: behind.iter().map(|&grain| self.centres[grain]).collect(),
            radii: pick(&self.radii),
            squeeze: pick(&self.squeeze),
            plastic: pick(&self.plastic),
            materials: behind.iter().map(|&grain| self.materials[grain]).collect(),
            groups: behind.iter().map(|&grain| self.groups[grain]).collect(),
            bodies: self.bodies.clone(),
            unit: self.unit,
            time: self.time,
            stage: self.stage.clone(),
        }
    }

    /// Lowest and highest corner of nearly all grains, and of the bodies that move by themselves.
    #[must_use]
    pub fn bounds(&self) -> [Vector; 2] {
        let (mut low, mut high) = (Vector::MAX, Vector::MIN);
        for axis in 0..3 {
            let mut places: Vec<f64> = self.centres.iter().map(|c| c[axis]).collect();
            places.sort_unstable_by(f64::total_cmp);
            let skip = (STRAY * places.len() as f64) as usize;
            if let (Some(&first), Some(&last)) = (
                places.get(skip),
                places
                    .len()
                    .checked_sub(1 + skip)
                    .and_then(|at| places.get(at)),
            ) {
                (low[axis], high[axis]) = (first - 1.0, last + 1.0);
            }
        }
        for body in self.bodies.iter().filter(|body| body.free) {
            let bounds = body.shape.compute_aabb(&body.pose);
            (low, high) = (low.min(bounds.mins), high.max(bounds.maxs));
        }
        if low.x <= high.x {
            [low, high]
        } else {
            [Vector::splat(-1.0), Vector::splat(1.0)]
        }
    }
}
