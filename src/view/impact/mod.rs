//! Page of an impact: one HTML file that plays its film beside its force-displacement curve, and needs nothing else.

use super::colours::COLOURS;
use super::page::{Words, encode, filled};
use crate::curve::film::Film;
use crate::curve::{Curve, MapPoint, Part, ParticleMap};
use crate::files::write_atomic;
use crate::{Error, Result};
use serde::Serialize;
use std::path::Path;

const HTML: &str = include_str!("page.html");
const SCRIPT: &str = include_str!("page.js");

/// Part of the points, at each end of a scale, that may lie beyond it: single points of the rim would take all colours.
const STRAY: f64 = 0.002;
/// Most points of the curve in a page.
const CURVE_POINTS: usize = 400;

/// A quantity that points can be coloured by.
struct Quantity {
    name: &'static str,
    unit: &'static str,
    /// Whether its scale begins at 0.
    from_zero: bool,
    of: fn(&MapPoint) -> Option<f64>,
}

const QUANTITIES: [Quantity; 4] = [
    Quantity {
        name: "equivalent plastic strain",
        unit: "",
        from_zero: true,
        of: |point| Some(point.equivalent_plastic_strain),
    },
    Quantity {
        name: "von Mises stress",
        unit: "Pa",
        from_zero: true,
        of: |point| Some(point.von_mises_pa),
    },
    Quantity {
        name: "pressure",
        unit: "Pa",
        from_zero: false,
        of: |point| Some(point.pressure_pa),
    },
    Quantity {
        name: "temperature",
        unit: "K",
        from_zero: false,
        of: |point| point.temperature_k,
    },
];

#[derive(Debug, Serialize)]
struct Scale {
    name: &'static str,
    unit: &'static str,
    low: f64,
    high: f64,
}

#[derive(Debug, Serialize)]
struct Frame {
    time: f64,
    /// Distance from the axis, height and edge of each point, in 65535ths of the block.
    places: String,
    /// The same of the surface, without an edge.
    surface: String,
    /// Place of each point on each scale, a byte.
    levels: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Data {
    /// Lowest corner and edge of the block that places are counted in, m.
    low: [f64; 2],
    edge: f64,
    /// Whether the section is one half of a body of revolution or symmetry.
    mirrored: bool,
    colours: [[f64; 3]; 7],
    scales: Vec<Scale>,
    frames: Vec<Frame>,
    /// Displacement (m) and force (N) over time (s).
    curve: Vec<[f64; 3]>,
}

/// Writes the page of an impact from its film and its curve; `words` stand in its corner.
///
/// # Errors
/// [`Error::File`] when it cannot be written.
pub fn write_impact_page(path: &Path, words: Words, film: &Film, curve: &Curve) -> Result<()> {
    let data = data(film, curve);
    let json = serde_json::to_string(&data).map_err(|e| Error::file("write", path)(e.into()))?;
    write_atomic(path, filled(HTML, SCRIPT, words, &json).as_bytes())
}

fn data(film: &Film, curve: &Curve) -> Data {
    let all = || film.pictures.iter().flat_map(|(_, map)| &map.points);
    let least = |of: fn(&MapPoint) -> f64| all().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&MapPoint) -> f64| all().map(of).fold(f64::NEG_INFINITY, f64::max);
    let low = [least(|p| p.r_m).min(0.0), least(|p| p.z_m).min(0.0)];
    let high = [most(|p| p.r_m), most(|p| p.z_m)];
    let edge = (high[0] - low[0]).max(high[1] - low[1]);
    let (scales, shown): (Vec<Scale>, Vec<&Quantity>) = QUANTITIES
        .iter()
        .filter_map(|quantity| Some((scale(quantity, film)?, quantity)))
        .unzip();
    let frames = film.pictures.iter().map(|(time, map)| Frame {
        time: *time,
        places: places(map, Part::Inside, low, edge),
        surface: places(map, Part::Surface, low, edge),
        levels: (scales.iter().zip(&shown))
            .map(|(scale, quantity)| levels(map, scale, quantity))
            .collect(),
    });
    let step = curve.samples.len().div_ceil(CURVE_POINTS).max(1);
    Data {
        low,
        edge,
        // the section of a whole body has a left side of its own
        mirrored: low[0] >= 0.0,
        colours: COLOURS,
        frames: frames.collect(),
        scales,
        curve: (curve.samples.iter().step_by(step))
            .map(|s| [s.time_s, s.displacement_m, s.force_n])
            .collect(),
    }
}

fn inside(map: &ParticleMap) -> impl Iterator<Item = &MapPoint> {
    map.points.iter().filter(|point| point.part == Part::Inside)
}

/// Scale of a quantity over all pictures; none where it does not vary, or is none.
fn scale(quantity: &Quantity, film: &Film) -> Option<Scale> {
    let points = film.pictures.iter().flat_map(|(_, map)| inside(map));
    let mut values: Vec<f64> = points.filter_map(quantity.of).collect();
    values.retain(|value| value.is_finite());
    values.sort_unstable_by(f64::total_cmp);
    let skip = (STRAY * values.len() as f64) as usize;
    let high = *values.get(values.len().checked_sub(1 + skip)?)?;
    let low = if quantity.from_zero {
        0.0
    } else {
        values[skip]
    };
    (high > low).then_some(Scale {
        name: quantity.name,
        unit: quantity.unit,
        low,
        high,
    })
}

fn places(map: &ParticleMap, part: Part, low: [f64; 2], edge: f64) -> String {
    let count = |length: f64| ((length / edge).clamp(0.0, 1.0) * 65535.0).round() as u16;
    let of_part = map.points.iter().filter(|point| point.part == part);
    encode(of_part.flat_map(|point| {
        let place = [point.r_m - low[0], point.z_m - low[1], point.size_m];
        place.map(|length| count(length).to_le_bytes())
    }))
}

fn levels(map: &ParticleMap, scale: &Scale, quantity: &Quantity) -> String {
    encode(inside(map).map(|point| {
        let value = (quantity.of)(point).unwrap_or(scale.low);
        let level = (value - scale.low) / (scale.high - scale.low);
        [(level.clamp(0.0, 1.0) * 255.0).round() as u8]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(part: Part, r_m: f64, von_mises_pa: f64) -> MapPoint {
        MapPoint {
            part,
            r_m,
            z_m: 1e-3,
            size_m: 1e-4,
            equivalent_plastic_strain: 0.0,
            von_mises_pa,
            pressure_pa: -von_mises_pa,
            temperature_k: None,
        }
    }

    #[test]
    fn a_quantity_that_is_nowhere_has_no_scale_and_the_others_go_over_the_film() {
        let map = |stress: f64| ParticleMap {
            points: vec![
                point(Part::Inside, 0.0, 0.0),
                point(Part::Inside, 1e-3, stress),
                point(Part::Surface, 1e-3, 0.0),
            ],
        };
        let film = Film {
            pictures: vec![(0.0, map(1e6)), (1e-6, map(4e6))],
        };
        let data = data(&film, &Curve::default());
        let names: Vec<&str> = data.scales.iter().map(|scale| scale.name).collect();
        assert_eq!(names, ["von Mises stress", "pressure"]);
        assert_eq!((data.scales[0].low, data.scales[0].high), (0.0, 4e6));
        assert_eq!((data.scales[1].low, data.scales[1].high), (-4e6, 0.0));
        assert!(data.mirrored && data.edge == 1e-3);
        let level = |frame: usize| levels(&film.pictures[frame].1, &data.scales[0], &QUANTITIES[1]);
        assert_eq!(level(0), encode([[0u8], [64]].into_iter()));
        assert_eq!(level(1), encode([[0u8], [255]].into_iter()));
    }
}
