//! Rendering of a bed by parry ray casts: grains in colours, bodies that move by themselves solid, walls
//! behind them pale, walls before them as edges only: nothing tints the colour of a grain.

use super::canvas::{INK, PAPER};
use super::portrait::{Portrait, Sitter};
use parry3d::bounding_volume::Aabb;
use parry3d::math::{Pose, Vector};
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::{Ray, RayCast};
use parry3d::shape::Ball;
use rayon::prelude::*;

/// Rays along each edge of a pixel where its neighbours show something else; one elsewhere.
const SAMPLES: usize = 3;
/// Where the eye is, from the bed; far away, so that parallel edges stay parallel.
const EYE: Vector = Vector::new(0.62, -0.9, 0.42);
/// Distance of the eye, in grain radii.
const FAR: f64 = 1e4;
/// Where the light comes from.
const LIGHT: Vector = Vector::new(0.25, -0.75, 1.0);
/// Room around a bed, over its size.
const BORDER: f64 = 1.12;
const WALL: [f64; 3] = [0.90, 0.91, 0.93];
const BODY: [f64; 3] = [0.52, 0.58, 0.66];
/// Distance over which a shadow on a wall fades, in grain radii: that of a whole bed on a far wall is a stain, for the walls between
/// are glass.
const SHADOW: f64 = 4.0;
/// How much an edge covers.
const EDGE: f64 = 0.55;

/// From where a bed is looked at: lengths count grain radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    right: Vector,
    up: Vector,
    eye: Vector,
    centre: Vector,
    /// Length of a pixel.
    pixel: f64,
    size: [usize; 2],
}

impl Sight {
    /// Sight of the block between two corners, filling a picture of `size` pixels.
    #[must_use]
    pub fn of([low, high]: [Vector; 2], size: [usize; 2]) -> Self {
        let eye = EYE.normalize();
        let right = Vector::Z.cross(eye).normalize();
        let up = eye.cross(right);
        let seen = |axis: Vector| BORDER * (high - low).dot(axis.abs());
        Self {
            right,
            up,
            eye,
            centre: 0.5 * (low + high),
            pixel: (seen(right) / size[0] as f64).max(seen(up) / size[1] as f64),
            size,
        }
    }

    /// Length of a pixel.
    #[must_use]
    pub fn pixel(&self) -> f64 {
        self.pixel
    }

    fn ray(&self, x: f64, y: f64) -> Ray {
        let x = (x - 0.5 * self.size[0] as f64) * self.pixel;
        let y = (0.5 * self.size[1] as f64 - y) * self.pixel;
        let origin = self.centre + self.right * x + self.up * y + self.eye * FAR;
        Ray::new(origin, -self.eye)
    }

    /// Pixel and distance from the eye of a point.
    fn project(&self, point: Vector) -> ([f64; 2], f64) {
        let from = point - self.centre;
        let x = from.dot(self.right) / self.pixel + 0.5 * self.size[0] as f64;
        let y = 0.5 * self.size[1] as f64 - from.dot(self.up) / self.pixel;
        ([x, y], FAR - from.dot(self.eye))
    }
}

/// What is seen through a pixel: a grain's colour times `own` plus `rest`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    /// Grain, body or nothing: neighbours that differ make an edge.
    what: usize,
    grain: Option<usize>,
    own: f64,
    rest: [f64; 3],
    distance: f64,
}

impl Seen {
    fn colour(&self, paint: &[[f64; 3]]) -> [f64; 3] {
        let own = self.grain.map_or([0.0; 3], |grain| paint[grain]);
        [0, 1, 2].map(|c| (own[c] * self.own + self.rest[c]).min(1.0))
    }
}

/// A bed ready for rays.
struct Stage<'a> {
    portrait: &'a Portrait,
    sight: Sight,
    tree: Bvh,
}

/// Pictures of a bed, one for each way its grains are painted.
#[must_use]
pub fn draw(portrait: &Portrait, sight: Sight, paints: &[Vec<[f64; 3]>]) -> Vec<Vec<[f64; 3]>> {
    let boxes = portrait.centres.iter().zip(&portrait.radii);
    let boxes: Vec<Aabb> = boxes
        .map(|(&centre, &radius)| Aabb::from_half_extents(centre, Vector::splat(radius)))
        .collect();
    let stage = Stage {
        portrait,
        sight,
        tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
    };
    let [width, height] = sight.size;
    let centre = |at: usize| ((at % width) as f64 + 0.5, (at / width) as f64 + 0.5);
    let first: Vec<Seen> = (0..width * height)
        .into_par_iter()
        .map(|at| {
            let (x, y) = centre(at);
            stage.look(x, y)
        })
        .collect();
    let colours: Vec<Vec<[f64; 3]>> = (0..width * height)
        .into_par_iter()
        .map(|at| {
            let (x, y) = (at % width, at / width);
            let differs = |other: usize| first[other].what != first[at].what;
            let edge = (x > 0 && differs(at - 1))
                || (x + 1 < width && differs(at + 1))
                || (y > 0 && differs(at - width))
                || (y + 1 < height && differs(at + width));
            match edge {
                true => stage.mix(x, y, paints),
                false => paints.iter().map(|paint| first[at].colour(paint)).collect(),
            }
        })
        .collect();
    let edges = stage.edges(&first);
    let picture = |paint: usize| {
        let inked = colours.iter().zip(&edges);
        inked
            .map(|(colour, &cover)| over(colour[paint], INK, cover))
            .collect()
    };
    (0..paints.len()).map(picture).collect()
}

fn over(below: [f64; 3], colour: [f64; 3], cover: f64) -> [f64; 3] {
    [0, 1, 2].map(|c| below[c] * (1.0 - cover) + colour[c] * cover)
}

impl Stage<'_> {
    /// Mean of several rays through one pixel.
    fn mix(&self, x: usize, y: usize, paints: &[Vec<[f64; 3]>]) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; paints.len()];
        for sample in 0..SAMPLES * SAMPLES {
            let part = |k: usize| (k as f64 + 0.5) / SAMPLES as f64;
            let (x, y) = (
                x as f64 + part(sample % SAMPLES),
                y as f64 + part(sample / SAMPLES),
            );
            let seen = self.look(x, y);
            for (sum, paint) in sums.iter_mut().zip(paints) {
                let colour = seen.colour(paint);
                (0..3).for_each(|c| sum[c] += colour[c] / (SAMPLES * SAMPLES) as f64);
            }
        }
        sums
    }

    fn look(&self, x: f64, y: f64) -> Seen {
        let ray = self.sight.ray(x, y);
        let walls = self.portrait.bodies.iter().filter(|body| !body.free);
        if let Some(seen) = self.solid(&ray) {
            return seen;
        }
        let facing = walls
            .filter_map(|wall| hit(wall, &ray))
            .filter(|(_, normal)| normal.dot(self.sight.eye) > 0.0);
        match facing.max_by(|a, b| a.0.total_cmp(&b.0)) {
            // nothing behind: the last wall closes the view
            Some((distance, normal)) => {
                let wall = self.lit(&ray, distance, normal, usize::MAX - 1, SHADOW);
                // pale whichever way it faces: shadows show, sides do not compete with grains
                let shade = 0.8 + 0.2 * wall.own.min(1.0);
                Seen {
                    own: 0.0,
                    rest: WALL.map(|c| c * shade),
                    ..wall
                }
            }
            None => Seen {
                what: usize::MAX,
                grain: None,
                own: 0.0,
                rest: PAPER,
                distance: f64::INFINITY,
            },
        }
    }

    /// Grain or solid body that a ray meets first.
    fn solid(&self, ray: &Ray) -> Option<Seen> {
        let grain = self.grain(ray);
        let bodies = self
            .portrait
            .bodies
            .iter()
            .enumerate()
            .filter(|(_, body)| body.free);
        let body = bodies
            .filter_map(|(index, body)| Some((index, hit(body, ray)?)))
            .min_by(|a, b| a.1.0.total_cmp(&b.1.0));
        match (grain, body) {
            (grain, Some((index, (distance, normal))))
                if grain.is_none_or(|(_, nearest)| distance < nearest) =>
            {
                let lit = self.lit(
                    ray,
                    distance,
                    normal,
                    self.portrait.centres.len() + index,
                    f64::INFINITY,
                );
                Some(Seen {
                    own: 0.0,
                    rest: [0, 1, 2].map(|c| BODY[c] * lit.own + lit.rest[c]),
                    ..lit
                })
            }
            (Some((grain, distance)), _) => {
                let normal = (ray.point_at(distance) - self.portrait.centres[grain]).normalize();
                Some(Seen {
                    grain: Some(grain),
                    ..self.lit(ray, distance, normal, grain, f64::INFINITY)
                })
            }
            _ => None,
        }
    }

    fn grain(&self, ray: &Ray) -> Option<(usize, f64)> {
        let cast = |grain: u32, reach: f64| {
            let pose = Pose::from_translation(self.portrait.centres[grain as usize]);
            Ball::new(self.portrait.radii[grain as usize]).cast_ray(&pose, ray, reach, true)
        };
        let found = self.tree.cast_ray(ray, f64::MAX, cast);
        found.map(|(grain, distance)| (grain as usize, distance))
    }

    /// Light on a point: factor of its own colour, and shine. Shadows of what is `fade` away and farther are none.
    fn lit(&self, ray: &Ray, distance: f64, normal: Vector, what: usize, fade: f64) -> Seen {
        let light = LIGHT.normalize();
        let shadow = Ray::new(ray.point_at(distance) + normal * 1e-5, light);
        let free = self.portrait.bodies.iter().filter(|body| body.free);
        let bodies = free.filter_map(|body| hit(body, &shadow));
        let grain = self.grain(&shadow);
        let between = bodies.map(|hit| hit.0).chain(grain.map(|hit| hit.1));
        let nearest = between.fold(f64::INFINITY, f64::min);
        let lit = match nearest.is_finite() {
            true => (nearest / fade).min(1.0),
            false => 1.0,
        };
        let diffuse = normal.dot(light).max(0.0) * lit;
        // light from the sky keeps shadows readable; surfaces that face the eye are a little lighter
        let eye = self.sight.eye;
        let sky = 0.5 + 0.2 * normal.z + 0.15 * normal.dot(eye).max(0.0);
        let shine = 0.25 * lit * normal.dot((light + eye).normalize()).max(0.0).powi(40);
        Seen {
            what,
            grain: None,
            own: 0.75 * sky + 0.5 * diffuse,
            rest: [shine; 3],
            distance,
        }
    }

    /// How much the edges of bodies cover each pixel; an edge behind something solid is not seen.
    fn edges(&self, seen: &[Seen]) -> Vec<f64> {
        let [width, height] = self.sight.size;
        let mut cover = vec![0.0f64; width * height];
        for body in &self.portrait.bodies {
            for ends in &body.outline.edges {
                let [a, b] = ends.map(|end| {
                    let corner = body.outline.vertices[end as usize];
                    self.sight.project(body.pose.transform_point(corner))
                });
                let steps = (2.0 * (b.0[0] - a.0[0]).hypot(b.0[1] - a.0[1])).ceil();
                for step in 0..=steps.min(1e5) as usize {
                    let part = step as f64 / steps.max(1.0);
                    let mix = |a: f64, b: f64| a + part * (b - a);
                    let (x, y) = (mix(a.0[0], b.0[0]) - 0.5, mix(a.0[1], b.0[1]) - 0.5);
                    for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                        let (column, row) = (x.floor() + i, y.floor() + j);
                        let inside = column >= 0.0
                            && row >= 0.0
                            && column < width as f64
                            && row < height as f64;
                        let at = match inside {
                            true => row as usize * width + column as usize,
                            false => continue,
                        };
                        if mix(a.1, b.1) < seen[at].distance + 0.02 {
                            let near = (1.0 - (x - column).abs()) * (1.0 - (y - row).abs());
                            cover[at] = cover[at].max(EDGE * near);
                        }
                    }
                }
            }
        }
        cover
    }
}

/// Where a ray enters a body.
fn hit(body: &Sitter, ray: &Ray) -> Option<(f64, Vector)> {
    let hit = body
        .shape
        .cast_ray_and_get_normal(&body.pose, ray, f64::MAX, true)?;
    Some((hit.time_of_impact, hit.normal))
}
