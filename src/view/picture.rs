//! Pictures of beds: one PNG of several beds side by side, and an animation of one.

use super::canvas::{Align, Canvas, png};
use super::colours::{colour, level};
use super::film::Film;
use super::kinds::{Apart, Names, colour_of};
use super::portrait::{Cast, Portrait};
use super::render::{Sight, draw};
use crate::Result;
use crate::dem::dynamics::any::AnyBed;
use crate::files::write_atomic;
use crate::unit::engineering;
use parry3d::math::Vector;
use std::path::Path;
use std::time::Duration;

/// Pixels of one view of a bed.
const PANEL: [usize; 2] = [560, 520];
/// Pixels of one bed in an animation.
const MOVING: [usize; 2] = [440, 440];
/// Pixels above the beds for their names, and below for the scale of colours.
const MARGINS: [usize; 2] = [64, 76];
/// Pixels for the names of kinds.
const LEGEND: usize = 30;
/// What the two views of a bed are.
const VIEWS: [&str; 2] = ["whole", "cut open in the middle"];
/// How long a picture of an animation is shown.
const EACH: Duration = Duration::from_millis(120);
/// What grains are painted by.
const FORCE: &str = "sum of contact forces on a grain";
const PLASTIC: &str = "energy lost to plastic flow";

/// Writes a PNG of named beds, each whole and cut open, coloured by the forces on their grains, all on one scale of
/// colours: one bed with its two views side by side, several beds side by side with their views one above the other. Grains of
/// several kinds (`names`) are coloured by kind in the view of the whole.
///
/// # Errors
/// [`crate::Error::File`] when it cannot be written.
pub fn write_picture(path: &Path, beds: &[(&str, &Portrait)], names: &Names) -> Result<()> {
    let most = most(beds.iter().flat_map(|(_, portrait)| &portrait.squeeze));
    let (across, down) = match beds.len() {
        1 => (VIEWS.len(), 1),
        count => (count, VIEWS.len()),
    };
    let (width, height) = (PANEL[0] * across, PANEL[1] * down);
    let shown: Vec<&Portrait> = beds.iter().map(|(_, portrait)| *portrait).collect();
    let kinds = names.apart(&shown);
    let legend = if kinds.is_some() { LEGEND } else { 0 };
    let mut canvas = Canvas::new(width, MARGINS[0] + height + legend + MARGINS[1]);
    for (index, (name, portrait)) in beds.iter().enumerate() {
        let sight = Sight::of(portrait.bounds(), PANEL);
        let views = [(*portrait).clone(), portrait.cut_open()];
        for (number, (view, words)) in views.iter().zip(VIEWS).enumerate() {
            let place = if down == 1 {
                [number, 0]
            } else {
                [index, number]
            };
            let (left, top) = (place[0] * PANEL[0], MARGINS[0] + place[1] * PANEL[1]);
            let paint = match (number, &kinds) {
                (0, Some((apart, _))) => told_apart(view, *apart),
                _ => paint(&view.squeeze, most),
            };
            for pixels in draw(view, sight, &[paint]) {
                canvas.put(&pixels, PANEL[0], [left, top]);
            }
            canvas.write(
                words,
                [left + PANEL[0] - 14, top + PANEL[1] - 28],
                16.0,
                Align::Right,
            );
            canvas.scale_bar(
                sight.pixel() * portrait.unit,
                [left + 16, top + PANEL[1] - 10],
                PANEL[0],
            );
        }
        let middle = width / beds.len() * index + width / beds.len() / 2;
        head(&mut canvas, name, portrait, middle);
    }
    let top = MARGINS[0] + height + 8;
    if let Some((_, kinds)) = &kinds {
        canvas.legend(kinds, [width / 2, top + 2]);
    }
    let top = top + legend;
    canvas.scale(FORCE, most, "N", [width / 2, top], (width * 3 / 4).min(720));
    write_atomic(path, &png(&[canvas], EACH))
}

/// Colour of each grain by what it is told apart by.
fn told_apart(portrait: &Portrait, apart: Apart) -> Vec<[f64; 3]> {
    let kind = |grain: usize| match apart {
        Apart::Material => usize::from(portrait.materials[grain]),
        Apart::Group => portrait.groups[grain] as usize,
    };
    (0..portrait.centres.len())
        .map(|grain| colour_of(kind(grain)))
        .collect()
}

/// Name of a bed, stage and time above it.
fn head(canvas: &mut Canvas, name: &str, portrait: &Portrait, middle: usize) {
    canvas.write(name, [middle, 10], 26.0, Align::Middle);
    let time = engineering(portrait.time, "s", 4);
    let moment = match &portrait.stage[..] {
        "" => time,
        stage => format!("{stage}, {time}"),
    };
    canvas.write(&moment, [middle, 40], 17.0, Align::Middle);
}

/// Writes an animated PNG of at most `most` frames of a film: forces on the left, beside them what was lost to plastic flow where
/// anything was, and the kinds of grains where there are several (`names`).
///
/// # Errors
/// [`crate::Error::File`] when a frame cannot be read or the file not written.
pub fn write_animation(
    path: &Path,
    name: &str,
    (film, names): (&Film, &Names),
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
    let kinds = names.apart(&portraits.iter().collect::<Vec<_>>());
    let width = MOVING[0] * (1 + usize::from(flows) + usize::from(kinds.is_some()));
    let pictures: Vec<Canvas> = portraits
        .iter()
        .map(|portrait| {
            let mut canvas = Canvas::new(width, MARGINS[0] + MOVING[1] + MARGINS[1]);
            let mut paints = vec![paint(&portrait.squeeze, force)];
            if flows {
                paints.push(paint(&portrait.plastic, plastic));
            }
            if let Some((apart, _)) = &kinds {
                paints.push(told_apart(portrait, *apart));
            }
            let panels = draw(portrait, sight, &paints);
            let scales = [(FORCE, force, "N"), (PLASTIC, plastic, "J")];
            let scales = &scales[..1 + usize::from(flows)];
            for (index, pixels) in panels.iter().enumerate() {
                let left = index * MOVING[0];
                canvas.put(pixels, MOVING[0], [left, MARGINS[0]]);
                let corner = [left + 12, MARGINS[0] + MOVING[1] - 6];
                canvas.scale_bar(sight.pixel() * portrait.unit, corner, MOVING[0]);
                let middle = [left + MOVING[0] / 2, MARGINS[0] + MOVING[1] + 8];
                match scales.get(index) {
                    Some(&(words, most, unit)) => {
                        canvas.scale(words, most, unit, middle, MOVING[0] * 4 / 5);
                    }
                    None => kinds
                        .iter()
                        .for_each(|(_, kinds)| canvas.legend(kinds, middle)),
                }
            }
            head(&mut canvas, name, portrait, width / 2);
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
