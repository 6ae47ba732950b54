//! Repose: slopes of free surfaces of grains: the flank of a heap, and the surface in a turning drum.

use crate::dem::grains::Grains;
use std::f64::consts::TAU;

/// Sectors a heap is cut into; the surface of a ring is the mean of theirs.
const SECTORS: usize = 12;
/// Shares of the height between which a flank is straight: the top is round, the foot a single layer.
const FLANK: [f64; 2] = [0.2, 0.8];
/// Middle share of a drum's filling along which its surface is taken as straight.
const MIDDLE: f64 = 0.6;
/// Slices along the axis of a drum; the surface of a column is the mean of theirs.
const SLICES: usize = 6;

/// A straight part of a free surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// Angle with the horizontal, rad.
    pub angle: f64,
    /// Root mean square distance of the surface from the line, m.
    pub scatter: f64,
    /// Highest point, m.
    pub height: f64,
}

/// Flank of a heap about the vertical axis through `axis` (m), on the floor z = `floor`.
///
/// The surface over a ring is the mean over its sectors of the highest grain; a line is fitted to the rings between
/// 20 % and 80 % of the height. `None` for fewer than three rings.
#[must_use]
pub fn heap(grains: &Grains, axis: [f64; 2], floor: f64) -> Option<Slope> {
    let width = 2.0 * grains.largest_radius();
    let mut tops: Vec<[f64; SECTORS]> = Vec::new();
    for sphere in &grains.spheres {
        let (x, y) = (sphere.centre.x - axis[0], sphere.centre.y - axis[1]);
        let ring = (x.hypot(y) / width) as usize;
        let sector = ((y.atan2(x) / TAU + 0.5) * SECTORS as f64) as usize % SECTORS;
        if ring >= tops.len() {
            tops.resize(ring + 1, [f64::NAN; SECTORS]);
        }
        let top = &mut tops[ring][sector];
        *top = top.max(sphere.centre.z + sphere.radius - floor);
    }
    let surface: Vec<[f64; 2]> = tops
        .iter()
        .enumerate()
        .filter_map(|(ring, tops)| Some([(ring as f64 + 0.5) * width, mean(tops)?]))
        .collect();
    let height = surface
        .iter()
        .fold(0.0f64, |high, point| high.max(point[1]));
    let between = |z: f64| z > FLANK[0] * height && z < FLANK[1] * height;
    // from the top outwards, up to the foot: what has rolled away is no flank
    let flank: Vec<[f64; 2]> = surface
        .iter()
        .take_while(|point| point[1] > FLANK[0] * height)
        .filter(|point| between(point[1]))
        .copied()
        .collect();
    line(&flank, height)
}

/// Free surface of grains in a drum that turns about the axis y: its slope along x in the middle of the filling.
#[must_use]
pub fn drum(grains: &Grains) -> Option<Slope> {
    let width = 2.0 * grains.largest_radius();
    let ends = |value: fn(parry3d::math::Vector) -> f64| {
        let values = grains.spheres.iter().map(|sphere| value(sphere.centre));
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
            [low.min(v), high.max(v)]
        })
    };
    let ([left, right], [front, back]) = (ends(|c| c.x), ends(|c| c.y));
    let columns = ((right - left) / width).ceil() as usize;
    let mut tops = vec![[f64::NAN; SLICES]; columns + 1];
    for sphere in &grains.spheres {
        let column = ((sphere.centre.x - left) / width) as usize;
        let slice = (sphere.centre.y - front) / (back - front) * SLICES as f64;
        let top = &mut tops[column][(slice as usize).min(SLICES - 1)];
        *top = top.max(sphere.centre.z + sphere.radius);
    }
    let (middle, half) = (0.5 * (left + right), 0.5 * MIDDLE * (right - left));
    let surface: Vec<[f64; 2]> = tops
        .iter()
        .enumerate()
        .filter_map(|(column, tops)| {
            let x = left + (column as f64 + 0.5) * width;
            (mean(tops).filter(|_| (x - middle).abs() < half)).map(|z| [x, z])
        })
        .collect();
    let height = surface
        .iter()
        .fold(f64::NEG_INFINITY, |high, point| high.max(point[1]));
    line(&surface, height)
}

/// Mean of what is a number, if that is at least half of all.
fn mean(values: &[f64]) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0);
    for value in values.iter().filter(|value| !value.is_nan()) {
        sum += value;
        count += 1;
    }
    (2 * count >= values.len()).then(|| sum / count as f64)
}

/// Least-squares line.
fn line(points: &[[f64; 2]], height: f64) -> Option<Slope> {
    if points.len() < 3 {
        return None;
    }
    let count = points.len() as f64;
    let middle = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let (x, z) = (middle(0), middle(1));
    let (mut xx, mut xz) = (0.0, 0.0);
    for point in points {
        xx += (point[0] - x).powi(2);
        xz += (point[0] - x) * (point[1] - z);
    }
    let slope = xz / xx;
    let square = points
        .iter()
        .map(|point| (point[1] - z - slope * (point[0] - x)).powi(2))
        .sum::<f64>();
    Some(Slope {
        angle: slope.abs().atan(),
        scatter: (square / count).sqrt(),
        height,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry3d::math::Vector;

    /// Dense grains below a surface.
    fn below(surface: impl Fn(f64, f64) -> f64) -> Grains {
        let mut grains = Grains::default();
        let (radius, step) = (0.5e-3, 0.6e-3);
        for index in 0..80 * 80 * 40 {
            let place = [index % 80, index / 80 % 80, index / 6400].map(f64::from);
            let centre = Vector::new(place[0] - 39.5, place[1] - 39.5, place[2] + 0.8) * step;
            if centre.z + radius <= surface(centre.x, centre.y) {
                grains.add(centre, radius, 2500.0);
            }
        }
        grains
    }

    #[test]
    fn a_cone_has_the_slope_it_was_cut_with() {
        let slope = 0.5f64;
        let cone = below(|x, y| 11e-3 - slope * x.hypot(y));
        let found = heap(&cone, [0.0, 0.0], 0.0).unwrap();
        assert!((found.angle - slope.atan()).abs() < 0.02, "{found:?}");
        assert!(found.scatter < 0.3e-3, "{found:?}");
    }

    #[test]
    fn a_tilted_surface_has_its_tilt_either_way() {
        for slope in [0.4f64, -0.4] {
            let found = drum(&below(|x, _| 10e-3 + slope * x)).unwrap();
            assert!((found.angle - slope.abs().atan()).abs() < 0.02, "{found:?}");
        }
    }

    #[test]
    fn a_few_grains_have_no_slope() {
        let mut grains = Grains::default();
        grains.add(Vector::ZERO, 1e-3, 2500.0);
        assert_eq!(heap(&grains, [0.0, 0.0], 0.0), None);
        assert_eq!(drum(&grains), None);
    }
}
