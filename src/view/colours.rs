//! Colours of a quantity: a scale of decades down from its largest value.

/// Decades the colours span, down from the largest value.
pub const DECADES: f64 = 3.0;
/// Colours from low to high: samples of the map "inferno" of matplotlib, lightened at the dark end to show shading.
pub const COLOURS: [[f64; 3]; 7] = [
    [0.16, 0.12, 0.35],
    [0.34, 0.10, 0.43],
    [0.55, 0.16, 0.41],
    [0.75, 0.24, 0.33],
    [0.91, 0.38, 0.19],
    [0.98, 0.61, 0.10],
    [0.98, 0.93, 0.55],
];

/// Place of a value on the scale below `most`, from 0 to 1.
#[must_use]
pub fn level(value: f64, most: f64) -> f64 {
    (1.0 + (value.max(f64::MIN_POSITIVE) / most).log10() / DECADES).clamp(0.0, 1.0)
}

/// Colour of a place on the scale.
#[must_use]
pub fn colour(level: f64) -> [f64; 3] {
    let place = level * (COLOURS.len() - 1) as f64;
    let low = (place as usize).min(COLOURS.len() - 2);
    let part = place - low as f64;
    [0, 1, 2].map(|c| COLOURS[low][c] * (1.0 - part) + COLOURS[low + 1][c] * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_spans_its_decades_and_no_value_leaves_it() {
        assert_eq!(level(5.0, 5.0), 1.0);
        assert!((level(5e-3, 5.0) - 0.0).abs() < 1e-12);
        assert!((level(0.05, 5.0) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!((level(0.0, 5.0), level(9.0, 5.0)), (0.0, 1.0));
        assert_eq!((colour(0.0), colour(1.0)), (COLOURS[0], COLOURS[6]));
    }
}
