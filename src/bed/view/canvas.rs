//! Canvas: a picture in memory, with words, lines and a scale of colours, and its PNG file.

use super::colours::{DECADES, colour};
use super::lettering;
use crate::unit::engineering;
use std::time::Duration;

/// Colour of words and lines.
pub const INK: [f64; 3] = [0.13, 0.14, 0.17];
/// Colour of what is empty.
pub const PAPER: [f64; 3] = [1.0, 1.0, 1.0];

/// Picture in memory, from the upper left corner, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Canvas {
    /// Pixels along a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue from 0 to 1.
    pub pixels: Vec<[f64; 3]>,
}

impl Canvas {
    /// Empty canvas.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![PAPER; width * height],
        }
    }

    /// Puts a picture of `width` pixels a row with its upper left corner at `corner`.
    pub fn put(&mut self, pixels: &[[f64; 3]], width: usize, [left, top]: [usize; 2]) {
        for (at, &pixel) in pixels.iter().enumerate() {
            self.dot(left + at % width, top + at / width, pixel);
        }
    }

    fn dot(&mut self, x: usize, y: usize, colour: [f64; 3]) {
        if x < self.width && y < self.height {
            self.pixels[y * self.width + x] = colour;
        }
    }

    /// Writes `text` with its middle at `x`, its top at `y`.
    pub fn write(&mut self, text: &str, [x, y]: [usize; 2], size: usize) {
        let left = x.saturating_sub(lettering::width(text) * size / 2);
        lettering::draw(text, |column, row| {
            for at in 0..size * size {
                let (column, row) = (column * size + at % size, row * size + at / size);
                self.dot(left + column, y + row, INK);
            }
        });
    }

    /// Scale of colours up to `most`, its middle at `x`, its top at `y`, with numbers and a line of words below.
    pub fn scale(&mut self, words: &str, most: f64, unit: &str, [x, y]: [usize; 2], length: usize) {
        let left = x.saturating_sub(length / 2);
        for across in 0..length {
            let colour = colour(across as f64 / (length - 1) as f64);
            (0..16).for_each(|down| self.dot(left + across, y + down, colour));
        }
        for decade in 0..=DECADES as usize {
            let part = decade as f64 / DECADES;
            let value = most * 10f64.powf(decade as f64 - DECADES);
            let x = left + (part * (length - 1) as f64) as usize;
            (16..21).for_each(|down| self.dot(x, y + down, INK));
            self.write(&engineering(value, unit, 2), [x, y + 24], 2);
        }
        self.write(words, [x, y + 46], 2);
    }

    fn bytes(&self) -> Vec<u8> {
        let channel = |c: &f64| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        self.pixels.iter().flatten().map(channel).collect()
    }
}

/// PNG file of one picture, or an animated PNG of several of one size, each shown for `each`, over and over.
///
/// Writing to memory cannot fail; a picture that could not be encoded is left empty.
#[must_use]
pub fn png(pictures: &[Canvas], each: Duration) -> Vec<u8> {
    let mut file = Vec::new();
    let _ = encode(&mut file, pictures, each);
    file
}

fn encode(
    file: &mut Vec<u8>,
    pictures: &[Canvas],
    each: Duration,
) -> Result<(), png::EncodingError> {
    let Some(first) = pictures.first() else {
        return Ok(());
    };
    let mut encoder = png::Encoder::new(file, first.width as u32, first.height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if pictures.len() > 1 {
        encoder.set_animated(pictures.len() as u32, 0)?;
        encoder.set_frame_delay(each.as_millis() as u16, 1000)?;
    }
    let mut writer = encoder.write_header()?;
    for picture in pictures {
        writer.write_image_data(&picture.bytes())?;
    }
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_animation_holds_all_its_pictures_and_another_reader_finds_them() {
        let picture = |shade: f64| Canvas {
            pixels: vec![[shade; 3]; 6],
            ..Canvas::new(3, 2)
        };
        let file = png(&[picture(0.0), picture(1.0)], Duration::from_millis(80));
        let mut reader = png::Decoder::new(std::io::Cursor::new(file))
            .read_info()
            .unwrap();
        assert_eq!(reader.info().animation_control.unwrap().num_frames, 2);
        let mut seen = Vec::new();
        for _ in 0..2 {
            let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut bytes).unwrap();
            seen.push(bytes[0]);
        }
        assert_eq!(seen, [0, 255]);
    }
}
