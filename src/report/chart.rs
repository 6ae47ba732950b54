//! Chart: lines and markers over two axes with the legend beside them, as SVG.

use super::palette::{self, Ink, Rgb, Role};
use super::scale::{Axis, Scale};
use crate::{Error, Result};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// How the points of a series are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line through them.
    Line,
    /// A disc on each.
    Points,
}

/// One law or run in a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; known laws keep their colour by it.
    pub label: String,
    /// What it stands for.
    pub role: Role,
    /// Line or markers.
    pub mark: Mark,
    /// Points (x, y) in SI units.
    pub points: Vec<(f64, f64)>,
    /// Largest x that its source supports; beyond it a line is dotted. None: it states no end.
    pub supported_to: Option<f64>,
}

/// A line of a legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Name.
    pub label: String,
    /// How it is drawn.
    pub ink: Ink,
    /// Line or markers.
    pub mark: Mark,
    /// Whether a part of it is dotted.
    pub extrapolated: bool,
}

/// Lines and markers over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is shown, in the order of the legend; drawn from last to first.
    pub series: Vec<Series>,
}

/// Pixels of the drawing per pixel on the page: plotters places points on whole pixels.
const FINE: f64 = 8.0;
const WIDTH: f64 = 750.0;
const HEIGHT: f64 = 400.0;
const LEGEND: f64 = 205.0;
/// Nominal size; plotters draws 1/1.24 of it.
const FONT: f64 = 20.0;
/// Width of a character of a tick's label, on average of digits, over the nominal size.
const CHARACTER: f64 = 0.5;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

impl Chart {
    /// The chart with its legend beside it, as an SVG document.
    ///
    /// # Errors
    /// [`Error::Figure`] when it cannot be drawn.
    pub fn svg(&self) -> Result<String> {
        self.drawing(WIDTH)
    }

    /// The chart without a legend, for pages that have one for several charts.
    ///
    /// # Errors
    /// [`Error::Figure`] when it cannot be drawn.
    pub fn bare(&self) -> Result<String> {
        self.drawing(WIDTH - LEGEND)
    }

    /// The lines of its legend.
    #[must_use]
    pub fn legend(&self) -> Vec<Entry> {
        let entry = |(series, ink): (&Series, Ink)| Entry {
            label: series.label.clone(),
            ink,
            mark: series.mark,
            extrapolated: series.is_extrapolated(),
        };
        self.series.iter().zip(self.inks()).map(entry).collect()
    }

    fn drawing(&self, width: f64) -> Result<String> {
        let mut svg = String::new();
        self.draw(&mut svg, width).map_err(|error| Error::Figure {
            what: format!("{} over {}", self.y.label, self.x.label),
            reason: error.to_string(),
        })?;
        Ok(on_page_size(&svg, width))
    }

    fn draw(&self, svg: &mut String, width: f64) -> Drawn {
        let root =
            SVGBackend::with_string(svg, (px(width) as u32, px(HEIGHT) as u32)).into_drawing_area();
        root.fill(&WHITE)?;
        let (plot, legend) = root.split_horizontally(px(WIDTH - LEGEND));
        let inks = self.inks();
        self.draw_plot(&plot, &inks)?;
        if width > WIDTH - LEGEND {
            self.draw_legend(&legend, &inks)?;
        }
        root.present()?;
        Ok(())
    }

    fn inks(&self) -> Vec<Ink> {
        let roles: Vec<Role> = self.series.iter().map(|series| series.role).collect();
        palette::inks(&roles)
    }

    fn draw_plot(&self, area: &Area, inks: &[Ink]) -> Drawn {
        let all = || self.series.iter().flat_map(|series| &series.points);
        let x = Scale::new(&self.x, all().map(|point| point.0));
        let y = Scale::new(&self.y, all().map(|point| point.1));
        let characters = y.ticks.iter().map(|tick| y.label(*tick).chars().count());
        let widest = CHARACTER * FONT * characters.max().unwrap_or(0) as f64;
        let mut chart = ChartBuilder::on(area)
            .margin(px(12.0))
            .margin_right(px(18.0))
            .x_label_area_size(px(56.0))
            // ticks, their labels, and the name of the axis beside them
            .y_label_area_size(px((10.0 + widest + 1.2 * FONT).max(76.0)))
            .build_cartesian_2d(x.clone(), y.clone())?;
        let label = |size| {
            ("sans-serif", px(size))
                .into_font()
                .color(&colour(palette::AXIS))
        };
        chart
            .configure_mesh()
            .bold_line_style(colour(palette::GRID).stroke_width(px(1.0) as u32))
            .light_line_style(TRANSPARENT)
            .axis_style(colour(palette::AXIS).stroke_width(px(1.0) as u32))
            .label_style(label(FONT))
            .axis_desc_style(
                ("sans-serif", px(FONT))
                    .into_font()
                    .color(&colour(palette::TEXT)),
            )
            .set_all_tick_mark_size(px(5.0))
            .x_labels(x.ticks.len())
            .y_labels(y.ticks.len())
            .x_desc(&x.title)
            .y_desc(&y.title)
            .draw()?;
        for (series, ink) in self.series.iter().zip(inks).rev() {
            draw_series(&mut chart, series, ink, (&x, &y))?;
        }
        Ok(())
    }

    fn draw_legend(&self, area: &Area, inks: &[Ink]) -> Drawn {
        let style = ("sans-serif", px(FONT - 1.0))
            .into_font()
            .color(&colour(palette::TEXT))
            .pos(Pos::new(HPos::Left, VPos::Center));
        for (i, (series, ink)) in self.series.iter().zip(inks).enumerate() {
            let y = px(26.0 + 24.0 * i as f64);
            match series.mark {
                Mark::Points => {
                    let disc = Circle::new((px(12.0), y), px(4.5), colour(ink.colour).filled());
                    area.draw(&disc)?;
                }
                Mark::Line => {
                    let (dash, gap) = ink.dash.unwrap_or((24.0, 0.0));
                    let mut x = 0.0;
                    while x < 24.0 {
                        let ends = [(px(x), y), (px((x + dash).min(24.0)), y)];
                        area.draw(&PathElement::new(ends, stroke(ink)))?;
                        x += dash + gap;
                    }
                }
            }
            area.draw_text(&series.label, &style, (px(31.0), y))?;
        }
        Ok(())
    }
}

impl Series {
    /// Whether a part of it lies beyond what its source supports.
    fn is_extrapolated(&self) -> bool {
        let limit = self.supported_to.unwrap_or(f64::INFINITY);
        self.points.iter().any(|point| point.0 > limit)
    }

    /// The line in pieces that are supported by its source or not, in order; neighbours share a point.
    fn pieces(&self) -> Vec<(bool, Vec<(f64, f64)>)> {
        let limit = self.supported_to.unwrap_or(f64::INFINITY);
        let mut pieces: Vec<(bool, Vec<(f64, f64)>)> = Vec::new();
        for ends in self.points.windows(2) {
            let supported = ends[0].0.max(ends[1].0) <= limit;
            match pieces.last_mut().filter(|piece| piece.0 == supported) {
                Some((_, points)) => points.push(ends[1]),
                None => pieces.push((supported, ends.to_vec())),
            }
        }
        pieces
    }
}

/// Dots and gaps of a line beyond what its source supports, px.
const DOTTED: (f64, f64) = (1.5, 4.5);

type Plane = Cartesian2d<Scale, Scale>;

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (place - self.low) / (self.high - self.low);
        from + (part * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, place: &f64) -> String {
        self.label(*place)
    }
}

fn draw_series(
    chart: &mut ChartContext<SVGBackend, Plane>,
    series: &Series,
    ink: &Ink,
    (x, y): (&Scale, &Scale),
) -> Drawn {
    let place = |point: &(f64, f64)| Some((x.place(point.0)?, y.place(point.1)?));
    if series.mark == Mark::Points {
        let places = series.points.iter().filter_map(place);
        let discs = places.map(|place| Circle::new(place, px(4.5), colour(ink.colour).filled()));
        chart.draw_series(discs)?;
        return Ok(());
    }
    for (supported, points) in series.pieces() {
        let dash = match supported {
            true => ink.dash,
            false => Some(DOTTED),
        };
        for piece in visible_pieces(points.iter().filter_map(place), x, y) {
            match dash {
                None => drop(chart.draw_series(LineSeries::new(piece, stroke(ink)))?),
                Some((dash, gap)) => {
                    let line = DashedLineSeries::new(piece, px(dash), px(gap), stroke(ink));
                    chart.draw_series(line)?;
                }
            }
        }
    }
    Ok(())
}

fn px(length: f64) -> i32 {
    (length * FINE).round() as i32
}

fn colour([r, g, b]: Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

fn stroke(ink: &Ink) -> ShapeStyle {
    colour(ink.colour).stroke_width(px(ink.width) as u32)
}

/// The drawing is made finer than the page; the view box keeps its size, the image gets that of the page.
fn on_page_size(svg: &str, width: f64) -> String {
    let fine = format!("width=\"{}\" height=\"{}\"", px(width), px(HEIGHT));
    let page = format!("width=\"{width}\" height=\"{HEIGHT}\" role=\"img\"");
    svg.replacen(&fine, &page, 1)
}

/// The line, cut at the lower and upper edge of the frame and freed of points closer than half a pixel.
fn visible_pieces(
    places: impl Iterator<Item = (f64, f64)>,
    x: &Scale,
    y: &Scale,
) -> Vec<Vec<(f64, f64)>> {
    let near = |a: (f64, f64), b: (f64, f64)| {
        let dx = (a.0 - b.0) / (x.high - x.low) * WIDTH;
        let dy = (a.1 - b.1) / (y.high - y.low) * HEIGHT;
        dx.hypot(dy) < 0.5
    };
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    for place in places {
        let Some(from) = before else {
            before = Some(place);
            continue;
        };
        if near(from, place) {
            continue;
        }
        before = Some(place);
        let Some((a, b)) = cut(from, place, x, y) else {
            continue;
        };
        match pieces.last_mut().filter(|piece| piece.last() == Some(&a)) {
            Some(piece) => piece.push(b),
            None => pieces.push(vec![a, b]),
        }
    }
    pieces
}

/// The part of a segment inside the frame (Liang and Barsky).
fn cut(a: (f64, f64), b: (f64, f64), x: &Scale, y: &Scale) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let edges = [
        (-dx, a.0 - x.low),
        (dx, x.high - a.0),
        (-dy, a.1 - y.low),
        (dy, y.high - a.1),
    ];
    for (towards, room) in edges {
        if towards == 0.0 && room < 0.0 {
            return None;
        } else if towards < 0.0 {
            enter = enter.max(room / towards);
        } else if towards > 0.0 {
            leave = leave.min(room / towards);
        }
    }
    let at = |t: f64| match t {
        0.0 => a,
        1.0 => b,
        _ => (a.0 + t * dx, a.1 + t * dy),
    };
    (enter < leave).then(|| (at(enter), at(leave)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_scale() -> Scale {
        let axis = Axis {
            range: Some((0.0, 1.0)),
            ..Axis::new("x", "")
        };
        Scale::new(&axis, std::iter::empty())
    }

    #[test]
    fn lines_are_cut_at_the_frame() {
        let s = unit_scale();
        assert_eq!(
            cut((0.5, -1.0), (0.5, 3.0), &s, &s),
            Some(((0.5, 0.0), (0.5, 1.0)))
        );
        assert_eq!(cut((0.5, 2.0), (0.5, 3.0), &s, &s), None);
        let zigzag = [(0.0, 0.5), (0.25, 1.5), (0.5, 0.5), (1.0, 0.75)];
        let pieces = visible_pieces(zigzag.into_iter(), &s, &s);
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[1].last(), Some(&(1.0, 0.75)));
    }

    #[test]
    fn close_points_are_dropped_but_not_the_shape() {
        let s = unit_scale();
        let dense = (0..100_000).map(|i| (f64::from(i) / 1e5, 0.5));
        let pieces = visible_pieces(dense, &s, &s);
        assert!(pieces[0].len() < 1500 && pieces[0].len() > 100);
    }

    #[test]
    fn a_line_parts_where_its_source_ends_and_comes_back() {
        let mut series = Series {
            label: "a".to_owned(),
            role: Role::Law,
            mark: Mark::Line,
            points: vec![(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (1.0, 0.5), (0.0, 0.0)],
            supported_to: Some(1.0),
        };
        let pieces = series.pieces();
        let kinds: Vec<bool> = pieces.iter().map(|piece| piece.0).collect();
        assert_eq!(kinds, [true, false, true]);
        assert_eq!(pieces[1].1, [(1.0, 1.0), (2.0, 2.0), (1.0, 0.5)]);
        assert!(series.is_extrapolated());
        series.supported_to = None;
        assert!(!series.is_extrapolated() && series.pieces().len() == 1);
    }

    #[test]
    fn a_chart_carries_its_labels_and_is_escaped() {
        let chart = Chart {
            x: Axis::new("displacement δ", "m"),
            y: Axis::new("force F", "N"),
            series: vec![Series {
                label: "a<b".to_owned(),
                role: Role::Law,
                mark: Mark::Line,
                points: vec![(0.0, 0.0), (1e-6, 2.0)],
                supported_to: None,
            }],
        };
        let svg = chart.svg().unwrap();
        assert!(svg.contains("displacement δ (µm)") && svg.contains("force F (N)"));
        assert!(svg.contains("a&lt;b") && svg.contains("#D55E00"));
        assert!(
            svg.starts_with("<svg width=\"750\" height=\"400\""),
            "{}",
            &svg[..80]
        );
    }
}
