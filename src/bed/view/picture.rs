//! Pictures of beds: one PNG of several beds side by side, and an animation of one.

use super::canvas::{Canvas, png};
use super::colours::{colour, level};
use super::film::Film;
use super::portrait::{Cast, Portrait};
use super::render::{Sight, draw};
use crate::Result;
use crate::dem::dynamics::any::AnyBed;
use crate::files::write_atomic;
use crate::unit::engineering;
use parry3d::math::Vector;
use std::path::Path;
use std::time::Duration;

/// Pixels of one bed.
const PANEL: [usize; 2] = [460, 480];
/// Pixels of one bed in an animation.
const MOVING: [usize; 2] = [400, 400];
/// Pixels above the beds for their names, and below for the scale of colours.
const MARGINS: [usize; 2] = [44, 76];
/// How long a picture of an animation is shown.
const EACH: Duration = Duration::from_millis(120);
/// What grains are painted by.
const FORCE: &str = "sum of contact forces on a grain";
const PLASTIC: &str = "energy lost to plastic flow";

/// Writes a PNG of named beds, coloured by the forces on their grains, all on one scale.
///
/// # Errors
/// [`crate::Error::File`] when it cannot be written.
pub fn write_picture(path: &Path, beds: &[(&str, &Portrait)]) -> Result<()> {
    let most = most(beds.iter().flat_map(|(_, portrait)| &portrait.squeeze));
    let width = PANEL[0] * beds.len();
    let mut canvas = Canvas::new(width, MARGINS[0] + PANEL[1] + MARGINS[1]);
    for (index, (name, portrait)) in beds.iter().enumerate() {
        let sight = Sight::of(portrait.bounds(), PANEL);
        for pixels in draw(portrait, sight, &[paint(&portrait.squeeze, most)]) {
            canvas.put(&pixels, PANEL[0], [index * PANEL[0], MARGINS[0]]);
        }
        canvas.write(name, [index * PANEL[0] + PANEL[0] / 2, 14], 3);
    }
    let top = MARGINS[0] + PANEL[1] + 8;
    canvas.scale(FORCE, most, "N", [width / 2, top], (width * 3 / 4).min(720));
    write_atomic(path, &png(&[canvas], EACH))
}

/// Writes an animated PNG of at most `most` frames of a film: forces on the left, what was lost to plastic flow on the
/// right; without plastic flow the forces alone.
///
/// # Errors
/// [`crate::Error::File`] when a frame cannot be read or the file not written.
pub fn write_animation(
    path: &Path,
    name: &str,
    film: &Film,
    bed: &dyn AnyBed,
    most: usize,
) -> Result<()> {
    let cast = Cast::of(bed);
    let frames = film.spread(most)?;
    let portraits: Vec<Portrait> = frames.iter().map(|frame| cast.at(frame)).collect();
    let bounds = portraits.iter().map(Portrait::bounds);
    let bounds = bounds.fold([Vector::MAX, Vector::MIN], |[low, high], [l, h]| {
        [low.min(l), high.max(h)]
    });
    let sight = Sight::of(bounds, MOVING);
    let force = self::most(portraits.iter().flat_map(|p| &p.squeeze));
    let plastic = self::most(portraits.iter().flat_map(|p| &p.plastic));
    let flows = plastic > 1e-6 * force * cast.unit();
    let width = MOVING[0] * if flows { 2 } else { 1 };
    let pictures: Vec<Canvas> = portraits
        .iter()
        .zip(&frames)
        .map(|(portrait, frame)| {
            let mut canvas = Canvas::new(width, MARGINS[0] + MOVING[1] + MARGINS[1]);
            let mut paints = vec![paint(&portrait.squeeze, force)];
            if flows {
                paints.push(paint(&portrait.plastic, plastic));
            }
            let panels = draw(portrait, sight, &paints);
            let scales = [(FORCE, force, "N"), (PLASTIC, plastic, "J")];
            for (index, (pixels, (words, most, unit))) in panels.iter().zip(scales).enumerate() {
                let left = index * MOVING[0];
                canvas.put(pixels, MOVING[0], [left, MARGINS[0]]);
                let middle = [left + MOVING[0] / 2, MARGINS[0] + MOVING[1] + 8];
                canvas.scale(words, most, unit, middle, MOVING[0] * 4 / 5);
            }
            let time = engineering(frame.time, "s", 3);
            canvas.write(
                &format!("{name} {} {time}", frame.stage),
                [width / 2, 14],
                2,
            );
            canvas
        })
        .collect();
    write_atomic(path, &png(&pictures, EACH))
}

fn most<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.fold(f64::MIN_POSITIVE, |most, &value| most.max(value))
}

fn paint(values: &[f64], most: f64) -> Vec<[f64; 3]> {
    values
        .iter()
        .map(|&value| colour(level(value, most)))
        .collect()
}
