//! Ball: quadrature of a unit sphere clipped from the cells of a three-dimensional grid, and points on its surface.
//!
//! The centre is at height one above the wall plane z = 0, first contact at the origin. Each cell is cut by the exact
//! sphere, direction after direction, so there is no staircase.

use super::section::gauss;

/// A quadrature point: position and volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallPoint {
    /// Position (x, y, z).
    pub position: [f64; 3],
    /// Volume weight.
    pub volume: f64,
}

/// Two ends in each direction.
pub type Cell = [(f64, f64); 3];

/// Quadrature of the part of `cell` that lies inside the unit sphere, `n` Gauss points a direction in each piece.
///
/// The innermost direction is the one in which the middle of the cell lies farthest out, where the sphere is a smooth
/// function of the other two.
#[must_use]
pub fn clip(cell: Cell, n: usize) -> Vec<BallPoint> {
    let mut points = Vec::new();
    let mut local = cell;
    local[2].0 -= 1.0;
    local[2].1 -= 1.0;
    let near: f64 = local.iter().map(|s| nearest(*s).powi(2)).sum();
    if near >= 1.0 {
        return points;
    }
    let far: f64 = local.iter().map(|s| farthest(*s).powi(2)).sum();
    let middle = local.map(|(a, b)| 0.5 * (a + b).abs());
    let inner = (0..3).fold(0, |best, k| if middle[k] > middle[best] { k } else { best });
    let order = [(inner + 1) % 3, (inner + 2) % 3, inner];
    let spans = order.map(|k| local[k]);
    let rule = gauss(n);
    nest(&rule, spans, far <= 1.0, |x, volume| {
        let mut position = [0.0; 3];
        for (k, x) in order.iter().zip(x) {
            position[*k] = x;
        }
        position[2] += 1.0;
        points.push(BallPoint { position, volume });
    });
    points
}

/// Nested quadrature over `spans` (outer to inner), inside the sphere unless the cell is `whole`.
fn nest(
    rule: &[(f64, f64)],
    [outer, middle, inner]: [(f64, f64); 3],
    whole: bool,
    mut give: impl FnMut([f64; 3], f64),
) {
    // the base of the inner direction lies inside the disc where its near end does
    let disc = chord(nearest(inner));
    let half = |squared: f64| (disc * disc - squared).max(0.0).sqrt();
    let cut = |span: (f64, f64), reach: f64| (span.0.max(-reach), span.1.min(reach));
    let (a, cuts) = if whole {
        (outer, Vec::new())
    } else {
        let ends = [middle.0, middle.1].map(|b| half(b * b));
        let reach = half(nearest(middle).powi(2));
        (cut(outer, reach), ends.to_vec())
    };
    for (a0, a1) in pieces(a, &cuts) {
        for &(s, ws) in rule {
            let x = a0 + s * (a1 - a0);
            let b = if whole {
                middle
            } else {
                cut(middle, half(x * x))
            };
            for &(t, wt) in rule {
                let y = b.0 + t * (b.1 - b.0);
                let c = if whole {
                    inner
                } else {
                    cut(inner, (1.0 - x * x - y * y).max(0.0).sqrt())
                };
                for &(r, wr) in rule {
                    let volume = ws * (a1 - a0) * wt * (b.1 - b.0) * wr * (c.1 - c.0);
                    if b.1 > b.0 && c.1 > c.0 {
                        give([x, y, c.0 + r * (c.1 - c.0)], volume);
                    }
                }
            }
        }
    }
}

/// Coordinate of the interval nearest to 0.
fn nearest((a, b): (f64, f64)) -> f64 {
    if a > 0.0 {
        a
    } else if b < 0.0 {
        -b
    } else {
        0.0
    }
}

fn farthest((a, b): (f64, f64)) -> f64 {
    a.abs().max(b.abs())
}

/// Half chord of the unit circle at distance `x` from its centre.
fn chord(x: f64) -> f64 {
    (1.0 - x * x).max(0.0).sqrt()
}

/// An interval split where the disc's edge passes a corner (at plus and minus `cuts`).
fn pieces((a, b): (f64, f64), cuts: &[f64]) -> Vec<(f64, f64)> {
    if b <= a {
        return Vec::new();
    }
    let margin = 1e-9 * (b - a);
    let mut all = vec![a, b];
    all.extend(
        cuts.iter()
            .flat_map(|c| [-c, *c])
            .filter(|c| *c > a + margin && *c < b - margin),
    );
    all.sort_by(f64::total_cmp);
    all.dedup_by(|x, y| (*x - *y).abs() < margin);
    all.windows(2).map(|w| (w[0], w[1])).collect()
}

/// Points on the lower half of the exact sphere, one above the middle of every surface cell of the grid `breaks`.
///
/// Where the sphere faces down, columns of cells are followed in z; on its sides in x or y.
#[must_use]
pub fn surface(breaks: [&[f64]; 3]) -> Vec<[f64; 3]> {
    let middles = breaks.map(|b| {
        b.windows(2)
            .map(|w| 0.5 * (w[0] + w[1]))
            .collect::<Vec<_>>()
    });
    let mut points = Vec::new();
    for axis in [2, 0, 1] {
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        for &a in &middles[first] {
            for &b in &middles[second] {
                let mut n = [0.0; 3];
                n[first] = if first == 2 { a - 1.0 } else { a };
                n[second] = if second == 2 { b - 1.0 } else { b };
                let squared = n[first] * n[first] + n[second] * n[second];
                let height = (1.0 - squared).max(0.0).sqrt();
                for sign in [-1.0, 1.0] {
                    n[axis] = sign * height;
                    let leads = n[first].abs() < height && n[second].abs() < height;
                    let inside = axis == 2 || (n[axis] >= breaks[axis][0]);
                    if leads && n[2] < 0.0 && inside {
                        // 1 - sqrt(1 - s) without cancellation near the pole
                        let z = if axis == 2 {
                            squared / (1.0 + height)
                        } else {
                            1.0 + n[2]
                        };
                        points.push([n[0], n[1], z]);
                    }
                }
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::graded;
    use std::f64::consts::PI;

    fn integrate(h: f64, n: usize, f: impl Fn([f64; 3]) -> f64) -> f64 {
        let side = graded(1.0, h, 0.2, 1.3, 0.2);
        let up = graded(2.0, h, 0.2, 1.3, 0.2);
        let mut sum = 0.0;
        for x in side.windows(2) {
            for y in side.windows(2) {
                for z in up.windows(2) {
                    let cell = [(x[0], x[1]), (y[0], y[1]), (z[0], z[1])];
                    sum += clip(cell, n)
                        .iter()
                        .map(|p| 4.0 * p.volume * f(p.position))
                        .sum::<f64>();
                }
            }
        }
        sum
    }

    #[test]
    fn clipped_cells_reproduce_volume_centre_and_inertia_of_the_sphere() {
        let volume = 4.0 / 3.0 * PI;
        let near = |x: f64, y: f64| (x / y - 1.0).abs();
        assert!(near(integrate(0.05, 2, |_| 1.0), volume) < 2e-4);
        assert!(near(integrate(0.05, 2, |p| p[2]), volume) < 2e-4);
        assert!(near(integrate(0.05, 2, |p| p[0] * p[0]), 0.2 * volume) < 1e-3);
        assert!(near(integrate(0.05, 2, |p| (p[2] - 1.0).powi(2)), 0.2 * volume) < 1e-3);
    }

    #[test]
    fn every_point_lies_inside_the_sphere() {
        let all = integrate(0.1, 2, |p| {
            assert!(p[0] * p[0] + p[1] * p[1] + (p[2] - 1.0).powi(2) < 1.0);
            1.0
        });
        assert!(all > 0.0);
    }

    #[test]
    fn surface_points_lie_on_the_lower_half_of_the_sphere() {
        let side = graded(1.0, 0.05, 0.2, 1.3, 0.2);
        let up = graded(2.0, 0.05, 0.2, 1.3, 0.2);
        let points = surface([&side, &side, &up]);
        assert!(points.len() > 100);
        for p in &points {
            let squared = p[0] * p[0] + p[1] * p[1] + (p[2] - 1.0).powi(2);
            assert!((squared - 1.0).abs() < 1e-14 && p[2] < 1.0 && p[0] > 0.0 && p[1] > 0.0);
        }
    }
}
