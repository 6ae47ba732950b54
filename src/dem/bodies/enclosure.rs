//! Room: the block of space a bed is in, and the walls and piston of its box.

use super::motion::Motion;
use crate::dem::bodies::{Body, Mobility};
use parry3d::math::Vector;

/// Name of the body that compresses the bed.
pub const PISTON: &str = "piston";
/// Names of the floor and the walls of a box, in order.
pub const WALLS: [&str; 5] = ["floor", "left", "right", "front", "back"];
/// Thickness of walls and piston over the largest radius: far more than a grain ever sinks in.
pub const THICKNESS: f64 = 4.0;

/// Space of a bed: x in [0, width] and y in [0, depth] of its corner, z from the corner up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Lowest corner, m.
    pub corner: Vector,
    /// Edge along x, m.
    pub width: f64,
    /// Edge along y, m.
    pub depth: f64,
    /// Height of the walls, m.
    pub height: f64,
    /// Thickness of walls and piston, m.
    pub thickness: f64,
    /// Whether grains may not go above the height either.
    pub closed: bool,
    /// Whether the sides along each axis are periodic: no walls, and all others reach beyond them.
    pub periodic: [bool; 3],
}

impl Room {
    /// Box with its corner in the origin, open above.
    #[must_use]
    pub fn open_box(width: f64, depth: f64, height: f64, thickness: f64) -> Self {
        Self {
            corner: Vector::ZERO,
            width,
            depth,
            height,
            thickness,
            closed: false,
            periodic: [false; 3],
        }
    }

    /// Block between two corners (m), closed on all sides.
    #[must_use]
    pub fn block([low, high]: [Vector; 2], thickness: f64) -> Self {
        let size = high - low;
        Self {
            corner: low,
            width: size.x,
            depth: size.y,
            height: size.z,
            thickness,
            closed: true,
            periodic: [false; 3],
        }
    }

    /// Floor area, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.width * self.depth
    }

    /// Whether a point is inside, or above an open room.
    #[must_use]
    pub fn holds(&self, point: Vector) -> bool {
        let inside = point - self.corner;
        let [x, y, z] = self.periodic;
        let below = inside.z < 0.0;
        let above = self.closed && inside.z > self.height;
        (z || !(below || above || inside.z.is_nan()))
            && (x || (0.0..=self.width).contains(&inside.x))
            && (y || (0.0..=self.depth).contains(&inside.y))
    }

    /// Whether a body of this name is one of the room's own: of its box.
    #[must_use]
    pub fn owns(&self, name: &str) -> bool {
        let [x, y, z] = self.periodic;
        !self.closed
            && match name {
                "left" | "right" => !x,
                "front" | "back" => !y,
                "floor" | PISTON => !z,
                _ => false,
            }
    }

    /// Floor, walls, and the piston parked under the rim.
    #[must_use]
    pub fn bodies(&self) -> Vec<Body> {
        let (h, t) = (self.height, self.thickness);
        let mut bodies = self.walls();
        let beyond = self.periodic.map(|periodic| if periodic { t } else { 0.0 });
        let beyond = Vector::from(beyond);
        let mut piston = Body::block(
            PISTON,
            self.corner + Vector::new(0.0, 0.0, h - t) - beyond,
            self.corner + Vector::new(self.width, self.depth, h) + beyond,
        );
        piston.mobility = Mobility::Driven(Motion::default());
        bodies.push(piston);
        bodies
    }

    /// Floor and walls.
    #[must_use]
    pub fn walls(&self) -> Vec<Body> {
        let (w, d, h, t) = (self.width, self.depth, self.height, self.thickness);
        // walls reach beyond sides that are periodic, as the floor does
        let along = |periodic: bool| if periodic { t } else { 0.0 };
        let [x, y, z] = self.periodic;
        let (a, b) = (along(x), along(z));
        let corners = [
            ([-t, -t, -t], [w + t, d + t, 0.0]),
            ([-t, -t, -b], [0.0, d + t, h + b]),
            ([w, -t, -b], [w + t, d + t, h + b]),
            ([-a, -t, -b], [w + a, 0.0, h + b]),
            ([-a, d, -b], [w + a, d + t, h + b]),
        ];
        let standing = [!z, !x, !x, !y, !y];
        WALLS
            .iter()
            .zip(corners)
            .zip(standing)
            .filter(|(_, standing)| *standing)
            .map(|((name, (low, high)), _)| {
                Body::block(
                    name,
                    self.corner + Vector::from(low),
                    self.corner + Vector::from(high),
                )
            })
            .collect()
    }
}
