//! Lattice: material points of equal spacing kept where they lie inside the sphere, as most material point codes fill a
//! body. Its surface is a staircase; the outermost points touch the wall as discs of the spacing.

use super::ball::BallPoint;
use super::section::{SectionPoint, SurfacePoint};
use crate::plan::Geometry;

/// Square lattice of `count` points a diameter over the unit half disc; areas are the squares of the spacing.
#[must_use]
pub fn points(count: f64) -> Vec<SectionPoint> {
    let spacing = 2.0 / count;
    let place = |k: usize| (k as f64 + 0.5) * spacing;
    let most = count.ceil() as usize;
    let mut all = Vec::new();
    for j in 0..most {
        for i in 0..most {
            if is_inside(place(i), place(j)) {
                all.push(SectionPoint {
                    r: place(i),
                    z: place(j),
                    area: spacing * spacing,
                });
            }
        }
    }
    all
}

fn is_inside(r: f64, z: f64) -> bool {
    r * r + (z - 1.0) * (z - 1.0) <= 1.0
}

/// Lattice points of the lower half that miss a neighbour below or outside, in order along the surface.
#[must_use]
pub fn outermost(count: f64) -> Vec<SurfacePoint> {
    let spacing = 2.0 / count;
    let mut all: Vec<SurfacePoint> = points(count)
        .iter()
        .filter(|p| p.z < 1.0)
        .filter(|p| !is_inside(p.r, p.z - spacing) || !is_inside(p.r + spacing, p.z))
        .map(|p| SurfacePoint { r: p.r, z: p.z })
        .collect();
    all.sort_by(|a, b| (a.r / (1.0 - a.z)).total_cmp(&(b.r / (1.0 - b.z))));
    all
}

/// Cubic lattice of `count` points a diameter over a quarter (x, y >= 0) or half (y >= 0) of the unit ball, symmetric about
/// its planes; volumes are the cubes of the spacing.
#[must_use]
pub fn ball(count: f64, geometry: Geometry) -> Vec<BallPoint> {
    let spacing = 2.0 / count;
    let most = count.ceil() as i64;
    let least = if geometry == Geometry::Half { -most } else { 0 };
    let place = |k: i64| (k as f64 + 0.5) * spacing;
    let volume = spacing.powi(3);
    let mut all = Vec::new();
    for k in 0..most {
        for j in 0..most {
            for i in least..most {
                let position = [place(i), place(j), place(k)];
                if is_in_ball(position) {
                    all.push(BallPoint { position, volume });
                }
            }
        }
    }
    all
}

fn is_in_ball([x, y, z]: [f64; 3]) -> bool {
    is_inside(x.hypot(y), z)
}

/// Points of [`ball`] in its lower half that miss a neighbour below or farther out.
#[must_use]
pub fn outermost_ball(count: f64, geometry: Geometry) -> Vec<[f64; 3]> {
    let spacing = 2.0 / count;
    let is_outer = |[x, y, z]: [f64; 3]| {
        let neighbours = [
            [x, y, z - spacing],
            [x + spacing * x.signum(), y, z],
            [x, y + spacing * y.signum(), z],
        ];
        z < 1.0 && !neighbours.into_iter().all(is_in_ball)
    };
    ball(count, geometry)
        .iter()
        .map(|p| p.position)
        .filter(|x| is_outer(*x))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn lattice_fills_the_sphere_up_to_its_staircase() {
        let volume =
            |count: f64| -> f64 { points(count).iter().map(|p| 2.0 * PI * p.r * p.area).sum() };
        for count in [13.0, 25.0, 50.0, 80.0] {
            let error = volume(count) / (4.0 / 3.0 * PI) - 1.0;
            assert!(error.abs() < 1.0 / count, "{count}: {error}");
        }
    }

    #[test]
    fn a_quarter_and_a_half_of_the_cubic_lattice_hold_their_shares() {
        let volume = |geometry| -> f64 { ball(50.0, geometry).iter().map(|p| p.volume).sum() };
        let quarter = volume(Geometry::Quarter);
        // column by column: of the points half a spacing and on above the equator, those below the sphere
        let half = |i: i32| f64::from(i) + 0.5;
        let column = |(i, j): (i32, i32)| (625.0 - half(i).powi(2) - half(j).powi(2)).max(0.0);
        let places = (0..25).flat_map(|i| (0..25).map(move |j| (i, j)));
        let above: f64 = places
            .map(|place| (column(place).sqrt() + 0.5).floor())
            .sum();
        let exact = 2.0 * above * 0.04f64.powi(3);
        assert!((quarter / exact - 1.0).abs() < 1e-12, "{quarter} {exact}");
        // the staircase of 50 points a diameter
        assert!((quarter / (PI / 3.0) - 1.0).abs() < 1.0 / 50.0, "{quarter}");
        let count = |geometry| ball(50.0, geometry).len();
        assert_eq!(count(Geometry::Half), 2 * count(Geometry::Quarter));
        for geometry in [Geometry::Quarter, Geometry::Half] {
            for [x, y, z] in outermost_ball(50.0, geometry) {
                let distance = (x * x + y * y + (z - 1.0) * (z - 1.0)).sqrt();
                assert!(z < 1.0 && distance <= 1.0 && distance > 1.0 - 2.0 * 0.04);
            }
        }
    }

    #[test]
    fn outermost_points_follow_the_surface_within_two_spacings() {
        let all = outermost(50.0);
        for p in &all {
            let distance = p.r.hypot(p.z - 1.0);
            assert!(distance <= 1.0 && distance > 1.0 - 2.0 * 0.04);
        }
        // ordered from the pole: every point lies within two spacings of the next
        for w in all.windows(2) {
            assert!((w[1].r - w[0].r).hypot(w[1].z - w[0].z) < 0.09);
        }
    }
}
