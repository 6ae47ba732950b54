//! Canvas: a picture in memory, with words, lines and a scale of colours, and its PNG file.

use super::colours::{DECADES, colour};
use super::kinds::colour_of;
use super::lettering;
use crate::unit::engineering;
use std::time::Duration;

/// Colour of words and lines.
pub const INK: [f64; 3] = [0.13, 0.14, 0.17];
/// Colour of what is empty.
pub const PAPER: [f64; 3] = [1.0, 1.0, 1.0];

/// Where the place of a word is within it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// At its left end.
    Left,
    /// In its middle.
    Middle,
    /// At its right end.
    Right,
}

/// Largest of 1, 2 and 5 times a power of ten that is not above `length`.
fn round_below(length: f64) -> f64 {
    let power = 10f64.powf(length.log10().floor());
    let step = [5.0, 2.0].into_iter().find(|step| step * power <= length);
    step.unwrap_or(1.0) * power
}

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

    /// Writes `text`, `size` pixels high, its top at `y`; `x` is its left end, its middle or its right end.
    pub fn write(&mut self, text: &str, [x, y]: [usize; 2], size: f64, align: Align) {
        let share = match align {
            Align::Left => 0.0,
            Align::Middle => 0.5,
            Align::Right => 1.0,
        };
        let left = x as f64 - share * lettering::width(text, size);
        let (width, height) = (self.width as i64, self.height as i64);
        lettering::draw(text, [left, y as f64], size, |column, row, cover| {
            if (0..width).contains(&column) && (0..height).contains(&row) {
                let pixel = &mut self.pixels[(row * width + column) as usize];
                *pixel = [0, 1, 2].map(|c| pixel[c] * (1.0 - cover) + INK[c] * cover);
            }
        });
    }

    fn block(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2]) {
        for at in 0..width * height {
            self.dot(left + at % width, top + at / width, INK);
        }
    }

    /// Scale bar: a length of a round number of metres about a quarter of `width` pixels long, its left lower end at
    /// `corner`; a pixel stands for `pixel` metres.
    pub fn scale_bar(&mut self, pixel: f64, [left, bottom]: [usize; 2], width: usize) {
        let length = round_below(0.27 * width as f64 * pixel);
        let across = (length / pixel).round() as usize;
        self.block([left, bottom - 4], [across, 3]);
        self.block([left, bottom - 10], [2, 9]);
        self.block([left + across - 2, bottom - 10], [2, 9]);
        let middle = [left + across / 2, bottom - 29];
        self.write(&engineering(length, "m", 3), middle, 16.0, Align::Middle);
    }

    /// Scale of colours up to `most`, its middle at `x`, its top at `y`, with numbers and a line of words below.
    pub fn scale(&mut self, words: &str, most: f64, unit: &str, [x, y]: [usize; 2], length: usize) {
        let left = x.saturating_sub(length / 2);
        for across in 0..length {
            let colour = colour(across as f64 / (length - 1) as f64);
            (0..14).for_each(|down| self.dot(left + across, y + down, colour));
        }
        for decade in 0..=DECADES as usize {
            let part = decade as f64 / DECADES;
            let value = most * 10f64.powf(decade as f64 - DECADES);
            let x = left + (part * (length - 1) as f64) as usize;
            self.block([x, y + 14], [1, 5]);
            // colours end at the first mark: smaller values look like it
            let sign = if decade == 0 { "≤ " } else { "" };
            let text = format!("{sign}{}", engineering(value, unit, 2));
            self.write(&text, [x, y + 21], 15.0, Align::Middle);
        }
        self.write(words, [x, y + 41], 17.0, Align::Middle);
    }

    /// Names of kinds beside their colours, in one line about `x`, its top at `y`; those that find no room are left out.
    pub fn legend(&mut self, kinds: &[(usize, &str)], [x, y]: [usize; 2]) {
        const SIZE: f64 = 17.0;
        let wide = |name: &str| 34 + lettering::width(name, SIZE).ceil() as usize;
        let mut room = self.width;
        let fitting: Vec<_> = kinds
            .iter()
            .take_while(|(_, name)| {
                let fits = room >= wide(name);
                room = room.saturating_sub(wide(name));
                fits
            })
            .collect();
        let whole: usize = fitting.iter().map(|(_, name)| wide(name)).sum();
        let mut left = x.saturating_sub(whole / 2);
        for (kind, name) in fitting {
            for at in 0..14 * 14 {
                self.dot(left + at % 14, y + 2 + at / 14, colour_of(*kind));
            }
            self.write(name, [left + 20, y], SIZE, Align::Left);
            left += wide(name);
        }
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
    fn a_scale_bar_has_a_round_length() {
        for (length, round) in [
            (1.0, 1.0),
            (1.9e-3, 1e-3),
            (2.3e-3, 2e-3),
            (0.9, 0.5),
            (49.0, 20.0),
        ] {
            assert!(
                (round_below(length) / round - 1.0).abs() < 1e-12,
                "{length}"
            );
        }
    }

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
