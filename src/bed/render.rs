//! Picture of beds side by side, by parry ray casts: grains coloured by how hard they are squeezed.

use super::lettering;
use super::run::Portrait;
use crate::Result;
use crate::files::write_atomic;
use crate::unit::significant;
use parry3d::bounding_volume::Aabb;
use parry3d::math::{Pose, Vector};
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::{Ray, RayCast};
use parry3d::shape::{Ball, Cuboid};
use rayon::prelude::*;
use std::path::Path;

/// Pixels of one bed.
const PANEL: [usize; 2] = [460, 480];
/// Pixels above the beds for their names, and below for the colour bar.
const MARGINS: [usize; 2] = [44, 76];
/// Rays along each edge of a pixel.
const SAMPLES: usize = 2;
/// Where the eye is, from the bed; far away, so that parallel edges stay parallel.
const EYE: Vector = Vector::new(0.62, -0.9, 0.42);
/// Where the light comes from.
const LIGHT: Vector = Vector::new(0.25, -0.75, 1.0);
/// Room around a bed, over its size.
const BORDER: f64 = 1.06;
/// Decades of force the colours span, down from the largest.
const DECADES: f64 = 3.0;
const PAPER: [f64; 3] = [1.0, 1.0, 1.0];
const INK: [f64; 3] = [0.13, 0.14, 0.17];
const WALL: [f64; 3] = [0.90, 0.91, 0.93];
const PISTON: [f64; 3] = [0.62, 0.65, 0.70];
/// Colours from low to high: samples of the map "inferno" of matplotlib, lightened at the dark end to show shading.
const COLOURS: [[f64; 3]; 7] = [
    [0.16, 0.12, 0.35],
    [0.34, 0.10, 0.43],
    [0.55, 0.16, 0.41],
    [0.75, 0.24, 0.33],
    [0.91, 0.38, 0.19],
    [0.98, 0.61, 0.10],
    [0.98, 0.93, 0.55],
];

/// Picture in memory.
struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<[f64; 3]>,
}

/// One bed, ready for rays: lengths count the largest radius.
struct View<'a> {
    portrait: &'a Portrait,
    tree: Bvh,
    unit: f64,
    /// Blocks that are drawn, with their colours: floor, the two far walls, the piston.
    blocks: Vec<(Pose, Cuboid, [f64; 3])>,
    right: Vector,
    up: Vector,
    eye: Vector,
    centre: Vector,
    /// Length of a pixel.
    pixel: f64,
}

/// What a ray hits first.
struct Hit {
    distance: f64,
    normal: Vector,
    colour: [f64; 3],
}

/// Writes a PNG of named beds, all on one scale of colours.
///
/// # Errors
/// [`crate::Error::File`] when it cannot be written.
pub fn write_picture(path: &Path, beds: &[(&str, &Portrait)]) -> Result<()> {
    let squeezes = beds.iter().flat_map(|(_, portrait)| &portrait.squeeze);
    let most = squeezes.fold(f64::MIN_POSITIVE, |most, &force| most.max(force));
    let mut canvas = Canvas {
        width: PANEL[0] * beds.len(),
        height: MARGINS[0] + PANEL[1] + MARGINS[1],
        pixels: Vec::new(),
    };
    canvas.pixels = vec![PAPER; canvas.width * canvas.height];
    for (index, (name, portrait)) in beds.iter().enumerate() {
        let pixels = View::new(portrait).draw(most);
        for (at, pixel) in pixels.into_iter().enumerate() {
            let (x, y) = (index * PANEL[0] + at % PANEL[0], MARGINS[0] + at / PANEL[0]);
            canvas.pixels[y * canvas.width + x] = pixel;
        }
        canvas.write(name, [index * PANEL[0] + PANEL[0] / 2, 14], 3);
    }
    canvas.colour_bar(most);
    write_atomic(path, &canvas.png())
}

impl<'a> View<'a> {
    fn new(portrait: &'a Portrait) -> Self {
        let unit = portrait.grains.largest_radius();
        let boxes: Vec<Aabb> = portrait
            .grains
            .spheres
            .iter()
            .map(|s| Aabb::from_half_extents(s.centre / unit, Vector::splat(s.radius / unit)))
            .collect();
        let room = &portrait.room;
        let (w, d, h) = (
            room.width / unit,
            room.depth / unit,
            (portrait.face + room.thickness) / unit,
        );
        let face = portrait.face / unit;
        let thin = 0.3;
        let block = |low: Vector, high: Vector, colour| {
            (
                Pose::from_translation(0.5 * (low + high)),
                Cuboid::new(0.5 * (high - low)),
                colour,
            )
        };
        let blocks = vec![
            block(
                Vector::new(-thin, 0.0, -thin),
                Vector::new(w, d + thin, 0.0),
                WALL,
            ),
            block(
                Vector::new(-thin, 0.0, 0.0),
                Vector::new(0.0, d + thin, h),
                WALL,
            ),
            block(Vector::new(0.0, d, 0.0), Vector::new(w, d + thin, h), WALL),
            block(Vector::new(0.0, 0.0, face), Vector::new(w, d, h), PISTON),
        ];
        let eye = EYE.normalize();
        let right = Vector::Z.cross(eye).normalize();
        let up = eye.cross(right);
        let (centre, size) = (0.5 * Vector::new(w, d, h), Vector::new(w, d, h));
        let seen = |axis: Vector| BORDER * size.dot(axis.abs());
        let pixel = (seen(right) / PANEL[0] as f64).max(seen(up) / PANEL[1] as f64);
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self {
            portrait,
            tree,
            unit,
            blocks,
            right,
            up,
            eye,
            centre,
            pixel,
        }
    }

    fn draw(&self, most: f64) -> Vec<[f64; 3]> {
        (0..PANEL[0] * PANEL[1])
            .into_par_iter()
            .map(|at| {
                let mut sum = [0.0; 3];
                for sample in 0..SAMPLES * SAMPLES {
                    let part = |k: usize| (k as f64 + 0.5) / SAMPLES as f64;
                    let x = (at % PANEL[0]) as f64 + part(sample % SAMPLES) - 0.5 * PANEL[0] as f64;
                    let y = (at / PANEL[0]) as f64 + part(sample / SAMPLES) - 0.5 * PANEL[1] as f64;
                    let colour = self.look(x * self.pixel, -y * self.pixel, most);
                    (0..3).for_each(|c| sum[c] += colour[c]);
                }
                sum.map(|c| c / (SAMPLES * SAMPLES) as f64)
            })
            .collect()
    }

    fn look(&self, x: f64, y: f64, most: f64) -> [f64; 3] {
        const FAR: f64 = 1e3;
        let origin = self.centre + self.right * x + self.up * y + self.eye * FAR;
        let ray = Ray::new(origin, -self.eye);
        let Some(hit) = self.first_hit(&ray, most) else {
            return PAPER;
        };
        let light = LIGHT.normalize();
        let point = ray.point_at(hit.distance) + hit.normal * 1e-6;
        let lit = if self.first_hit(&Ray::new(point, light), most).is_some() {
            0.0
        } else {
            1.0
        };
        let diffuse = hit.normal.dot(light).max(0.0) * lit;
        // light from the sky keeps shadows readable; surfaces that face the eye are a little lighter
        let sky = 0.5 + 0.2 * hit.normal.z + 0.15 * hit.normal.dot(self.eye).max(0.0);
        let shine = hit
            .normal
            .dot((light + self.eye).normalize())
            .max(0.0)
            .powi(40)
            * 0.25
            * lit;
        hit.colour
            .map(|c| (c * (0.75 * sky + 0.5 * diffuse) + shine).min(1.0))
    }

    fn first_hit(&self, ray: &Ray, most: f64) -> Option<Hit> {
        let spheres = &self.portrait.grains.spheres;
        let cast = |grain: u32, reach: f64| {
            let sphere = &spheres[grain as usize];
            let pose = Pose::from_translation(sphere.centre / self.unit);
            Ball::new(sphere.radius / self.unit).cast_ray(&pose, ray, reach, true)
        };
        let grain = self
            .tree
            .cast_ray(ray, f64::MAX, cast)
            .map(|(grain, distance)| {
                let centre = spheres[grain as usize].centre / self.unit;
                let colour = colour(level(self.portrait.squeeze[grain as usize], most));
                Hit {
                    distance,
                    normal: (ray.point_at(distance) - centre).normalize(),
                    colour,
                }
            });
        let blocks = self.blocks.iter().filter_map(|(pose, block, colour)| {
            let hit = block.cast_ray_and_get_normal(pose, ray, f64::MAX, true)?;
            Some(Hit {
                distance: hit.time_of_impact,
                normal: hit.normal,
                colour: *colour,
            })
        });
        blocks
            .chain(grain)
            .min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}

/// Place of a force on the scale of colours, from 0 to 1.
fn level(force: f64, most: f64) -> f64 {
    (1.0 + (force.max(f64::MIN_POSITIVE) / most).log10() / DECADES).clamp(0.0, 1.0)
}

fn colour(level: f64) -> [f64; 3] {
    let place = level * (COLOURS.len() - 1) as f64;
    let low = (place as usize).min(COLOURS.len() - 2);
    let part = place - low as f64;
    [0, 1, 2].map(|c| COLOURS[low][c] * (1.0 - part) + COLOURS[low + 1][c] * part)
}

impl Canvas {
    fn dot(&mut self, x: usize, y: usize, colour: [f64; 3]) {
        if x < self.width && y < self.height {
            self.pixels[y * self.width + x] = colour;
        }
    }

    /// Writes `text` with its middle at `x`, its top at `y`.
    fn write(&mut self, text: &str, [x, y]: [usize; 2], size: usize) {
        let left = x.saturating_sub(lettering::width(text) * size / 2);
        lettering::draw(text, |column, row| {
            for at in 0..size * size {
                self.dot(
                    left + column * size + at % size,
                    y + row * size + at / size,
                    INK,
                );
            }
        });
    }

    /// Scale of colours with its numbers along the lower edge.
    fn colour_bar(&mut self, most: f64) {
        let length = (self.width * 3 / 4).min(720);
        let (left, top) = ((self.width - length) / 2, MARGINS[0] + PANEL[1] + 8);
        for x in 0..length {
            let colour = colour(x as f64 / (length - 1) as f64);
            (0..16).for_each(|y| self.dot(left + x, top + y, colour));
        }
        for decade in 0..=DECADES as usize {
            let part = decade as f64 / DECADES;
            let force = most * 10f64.powf(decade as f64 - DECADES);
            let x = left + (part * (length - 1) as f64) as usize;
            (16..21).for_each(|y| self.dot(x, top + y, INK));
            self.write(&format!("{} N", significant(force, 2)), [x, top + 24], 2);
        }
        self.write(
            "sum of contact forces on a grain",
            [self.width / 2, top + 46],
            2,
        );
    }

    fn png(&self) -> Vec<u8> {
        let bytes: Vec<u8> = self
            .pixels
            .iter()
            .flatten()
            .map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
            .collect();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        // writing to memory cannot fail; a picture that could not be encoded is left empty
        if let Ok(mut writer) = encoder.write_header() {
            let _ = writer.write_image_data(&bytes);
        }
        file
    }
}
