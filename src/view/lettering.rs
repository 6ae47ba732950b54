//! Lettering: words of a picture in outlines of DejaVu Sans, smooth at any size.

use ab_glyph::{Font, FontRef, ScaleFont, point};

/// DejaVu Sans 2.37 (dejavu-fonts.github.io), cut down to the letters of labels and numbers; its licence stands beside it.
const SANS: &[u8] = include_bytes!("sans.ttf");

/// Width of `text` at `size` pixels, in pixels.
#[must_use]
pub fn width(text: &str, size: f64) -> f64 {
    FontRef::try_from_slice(SANS).map_or(0.0, |font| {
        let scaled = font.as_scaled(size as f32);
        let advance = |letter| scaled.h_advance(scaled.glyph_id(letter));
        f64::from(text.chars().map(advance).sum::<f32>())
    })
}

/// Calls `dot` with column, row and cover (0 to 1) of every pixel that `text` covers, its left upper corner at `corner`.
pub fn draw(text: &str, corner: [f64; 2], size: f64, mut dot: impl FnMut(i64, i64, f64)) {
    let Ok(font) = FontRef::try_from_slice(SANS) else {
        return;
    };
    let scaled = font.as_scaled(size as f32);
    let (mut x, base) = (corner[0] as f32, corner[1] as f32 + scaled.ascent());
    for letter in text.chars() {
        let id = scaled.glyph_id(letter);
        let glyph = id.with_scale_and_position(size as f32, point(x, base));
        x += scaled.h_advance(id);
        if let Some(outline) = font.outline_glyph(glyph) {
            let low = outline.px_bounds().min;
            outline.draw(|column, row, cover| {
                let place = |low: f32, at: u32| low as i64 + i64::from(at);
                dot(place(low.x, column), place(low.y, row), f64::from(cover));
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theory::Theory;

    #[test]
    fn every_law_and_number_can_be_written() {
        let names = Theory::ALL.map(Theory::name).join("");
        let font = FontRef::try_from_slice(SANS).unwrap();
        for letter in format!(
            "{names}fitted0123456789.-+_:=(),/%abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZµ°×−"
        )
        .chars()
        {
            assert_ne!(font.glyph_id(letter).0, 0, "{letter} is not in the font");
            let mut ink = 0.0;
            draw(&letter.to_string(), [0.0; 2], 20.0, |_, _, cover| ink += cover);
            assert!(ink > 1.0, "{letter} is blank");
        }
    }

    #[test]
    fn words_keep_within_their_width_and_their_size() {
        let (text, size) = ("sum of contact forces, 12.5 mN", 18.0);
        let wide = width(text, size);
        assert!(wide > 9.0 * size && wide < 16.0 * size, "{wide}");
        draw(text, [5.0, 7.0], size, |column, row, _| {
            assert!((3..=(7 + wide as i64)).contains(&column), "{column}");
            assert!((6..=(8 + size as i64)).contains(&row), "{row}");
        });
    }
}
