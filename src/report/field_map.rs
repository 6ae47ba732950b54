//! Field map: a scalar over the deformed cross-section of an axisymmetric particle, as SVG with a raster inside.

use super::markup::{escape, png_url};
use super::raster::{FieldPoint, LEVELS, Raster, SIZE, level_colour};
use super::scale::{Axis, Scale};
use crate::unit::prefixed;
use crate::{Error, Result};
use std::fmt::Write;

/// Scalar field over the particle.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldMap {
    /// Name of the field, e.g. "von Mises stress".
    pub label: String,
    /// SI unit, empty for a pure number.
    pub unit: &'static str,
    /// Values, in any order.
    pub points: Vec<FieldPoint>,
    /// Surface (r, z) from the lower pole upwards, m; above its last point the body is the convex hull of the
    /// points, which is what the far side of an impact is.
    pub outline: Vec<(f64, f64)>,
    /// Value at the end of the colour bar; `None`: the largest one.
    pub top: Option<f64>,
    /// Half width of the window around the contact, m; `None` shows the whole particle.
    pub window: Option<f64>,
}

const SVG_SIZE: (f64, f64) = (660.0, 510.0);
/// Room for the axis of heights, left of the picture.
const LEFT: f64 = 70.0;

impl FieldMap {
    /// The map as an SVG document: cross-section, wall, axes, colour bar.
    ///
    /// # Errors
    /// [`Error::Figure`] when there is nothing to draw or the raster cannot be encoded.
    pub fn svg(&self) -> Result<String> {
        let fail = |reason: String| Error::Figure {
            what: format!("map of the {}", self.label),
            reason,
        };
        let half_width = self.half_width();
        if self.points.is_empty() || !half_width.is_finite() || half_width <= 0.0 {
            return Err(fail("there are no points".to_owned()));
        }
        let top = self.top();
        let raster = Raster::new(&self.points, &self.outline, half_width, top);
        let png = raster.png().map_err(|error| fail(error.to_string()))?;
        Ok(self.drawing(&png, raster.pixel, top))
    }

    fn half_width(&self) -> f64 {
        self.window.unwrap_or_else(|| {
            let outline = self.outline.iter().map(|&(r, z)| r.max(0.5 * z));
            let points = self.points.iter().map(|point| point.r.max(0.5 * point.z));
            1.04 * outline.chain(points).fold(0.0, f64::max)
        })
    }

    fn top(&self) -> f64 {
        let largest = || {
            self.points
                .iter()
                .map(|point| point.value)
                .fold(0.0, f64::max)
        };
        let top = self.top.unwrap_or_else(largest);
        if top > 0.0 { top } else { 1.0 }
    }

    fn drawing(&self, png: &[u8], pixel: f64, top: f64) -> String {
        let (w, h) = SVG_SIZE;
        let (picture_w, picture_h) = (SIZE.0 as f64, SIZE.1 as f64);
        let (x0, y0) = (LEFT, 14.0);
        let wall = y0 + picture_h;
        let mut svg = format!(
            "<svg width=\"{w}\" height=\"{h}\" role=\"img\" viewBox=\"0 0 {w} {h}\" \
             xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#222\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
             <image x=\"{x0}\" y=\"{y0}\" width=\"{picture_w}\" height=\"{picture_h}\" href=\"{}\"/>\n\
             <path d=\"M{x0} {wall}h{picture_w}\" stroke=\"#444\" stroke-width=\"2\"/>\n",
            png_url(png)
        );
        draw_axes(&mut svg, pixel, (x0, wall));
        self.draw_colour_bar(
            &mut svg,
            top,
            (x0 + picture_w + 24.0, y0 + 20.0),
            picture_h - 40.0,
        );
        svg.push_str("</svg>\n");
        svg
    }

    fn draw_colour_bar(&self, svg: &mut String, top: f64, (x, y): (f64, f64), height: f64) {
        let step = height / f64::from(LEVELS);
        for level in 0..LEVELS {
            let [r, g, b] = level_colour(level);
            let _ = writeln!(
                svg,
                "<rect x=\"{x}\" y=\"{:.2}\" width=\"16\" height=\"{:.2}\" shape-rendering=\"crispEdges\" \
                 fill=\"#{r:02x}{g:02x}{b:02x}\"/>",
                y + height - step * f64::from(level + 1),
                step + 0.3
            );
        }
        let axis = Axis {
            range: Some((0.0, top)),
            ..Axis::new(&self.label, self.unit)
        };
        let scale = Scale::new(&axis, std::iter::empty());
        let full = top * prefixed(top, self.unit).0;
        for &tick in &scale.ticks {
            let at = y + height * (1.0 - tick / full);
            let _ = writeln!(
                svg,
                "<path d=\"M{} {at:.1}h5\" stroke=\"#444\"/><text x=\"{}\" y=\"{:.1}\">{}</text>",
                x + 16.0,
                x + 25.0,
                at + 5.0,
                scale.label(tick)
            );
        }
        let (tx, ty) = (x + 84.0, y + 0.5 * height);
        let _ = writeln!(
            svg,
            "<text transform=\"translate({tx},{ty}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            escape(&scale.title)
        );
    }
}

/// Axes of radius and height, with the origin at the pole that meets the wall, where (`x0`, `wall`) is the lower left corner.
fn draw_axes(svg: &mut String, pixel: f64, (x0, wall): (f64, f64)) {
    let (width, height) = (SIZE.0 as f64, SIZE.1 as f64);
    let scale = |label: &str, length: f64| {
        let axis = Axis {
            range: Some((0.0, length)),
            ..Axis::new(label, "m")
        };
        let place = pixel * prefixed(length, "m").0;
        (Scale::new(&axis, std::iter::empty()), place)
    };
    let middle = x0 + 0.5 * width;
    let (radius, place) = scale("distance from the axis r", 0.5 * width * pixel);
    for &tick in &radius.ticks {
        let sides = if tick == 0.0 {
            &[1.0][..]
        } else {
            &[-1.0, 1.0]
        };
        for side in sides {
            let at = middle + side * tick / place;
            let _ = writeln!(
                svg,
                "<path d=\"M{at:.1} {wall}v5\" stroke=\"#444\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                wall + 20.0,
                radius.label(tick)
            );
        }
    }
    let _ = writeln!(
        svg,
        "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        wall + 41.0,
        escape(&radius.title)
    );
    let (up, place) = scale("height z", height * pixel);
    let _ = writeln!(svg, "<path d=\"M{x0} {wall}v-{height}\" stroke=\"#444\"/>");
    for &tick in &up.ticks {
        let at = wall - tick / place;
        let _ = writeln!(
            svg,
            "<path d=\"M{x0} {at:.1}h-5\" stroke=\"#444\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            x0 - 8.0,
            at + 5.0,
            up.label(tick)
        );
    }
    let (tx, ty) = (x0 - 50.0, wall - 0.5 * height);
    let _ = writeln!(
        svg,
        "<text transform=\"translate({tx},{ty}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        escape(&up.title)
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn raster(map: &FieldMap) -> Raster {
        Raster::new(&map.points, &map.outline, map.half_width(), map.top())
    }

    /// A ball of radius 1 whose value grows with height from 0 to 2.
    fn ball() -> FieldMap {
        let n = 60;
        let step = 1.0 / f64::from(n);
        let centres =
            (0..n).flat_map(|i| (0..2 * n).map(move |k| (f64::from(i) + 0.5, f64::from(k) + 0.5)));
        let points = centres
            .map(|(i, k)| (i * step, k * step))
            .filter(|(r, z)| r.hypot(z - 1.0) < 1.0)
            .map(|(r, z)| FieldPoint {
                r,
                z,
                size: step,
                value: z,
            });
        let outline = (0..=180).map(|degree| f64::from(degree).to_radians());
        FieldMap {
            label: "height".to_owned(),
            unit: "m",
            points: points.collect(),
            outline: outline.map(|a| (a.sin(), 1.0 - a.cos())).collect(),
            top: None,
            window: None,
        }
    }

    #[test]
    fn the_body_covers_its_area_without_gaps() {
        let map = ball();
        let raster = raster(&map);
        let covered = raster.levels.iter().flatten().count() as f64 * raster.pixel * raster.pixel;
        assert!((covered / (0.5 * PI) - 1.0).abs() < 0.01, "{covered}");
    }

    #[test]
    fn without_an_outline_the_body_ends_where_its_points_do() {
        let mut map = ball();
        let full = map.outline.len();
        for kept in [full / 2, 0] {
            map.outline.truncate(kept);
            let raster = raster(&map);
            let covered = raster.levels.iter().flatten().count() as f64 * raster.pixel.powi(2);
            assert!(
                (covered / (0.5 * PI) - 1.0).abs() < 0.04,
                "{kept}: {covered}"
            );
        }
    }

    #[test]
    fn values_stand_where_they_belong() {
        let map = ball();
        let raster = raster(&map);
        for (i, level) in raster.levels.iter().enumerate() {
            let z = (raster.height as f64 - (i / raster.columns) as f64 - 0.5) * raster.pixel;
            if let Some(level) = level {
                let expected = z / map.top() * f64::from(LEVELS);
                assert!((f64::from(*level) + 0.5 - expected).abs() < 1.5, "{z}");
            }
        }
    }

    #[test]
    fn the_picture_is_symmetric_and_named() {
        let svg = ball().svg().unwrap();
        assert!(svg.contains("height (m)") && svg.contains("data:image/png;base64,"));
        assert!(svg.contains("distance from the axis r (m)") && svg.contains("height z (m)"));
        let map = ball();
        let png = raster(&map).png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(png))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        for row in pixels.chunks_exact(SIZE.0) {
            assert!(row.iter().eq(row.iter().rev()));
        }
    }

    #[test]
    fn a_map_without_points_is_refused() {
        let empty = FieldMap {
            points: Vec::new(),
            ..ball()
        };
        assert!(matches!(empty.svg(), Err(Error::Figure { .. })));
    }
}
