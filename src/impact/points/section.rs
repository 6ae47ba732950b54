//! Body: quadrature of a unit sphere clipped from a grid (the material points) and points on its exact surface.
//!
//! The axisymmetric section is the half disc $r \ge 0$, $r^2 + (z-1)^2 \le 1$, south pole (first contact) at the
//! origin. Each cell is cut by the exact circle; Gauss points fill what remains, so there is no staircase.

/// Gauss-Legendre abscissae and weights on [0, 1], 1 to 4 points.
#[must_use]
pub fn gauss(n: usize) -> Vec<(f64, f64)> {
    let half: &[(f64, f64)] = match n {
        1 => &[(0.0, 2.0)],
        2 => &[(0.577_350_269_189_625_8, 1.0)],
        3 => &[(0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)],
        _ => &[
            (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
            (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
        ],
    };
    let mut rule: Vec<(f64, f64)> = Vec::new();
    for &(x, w) in half {
        rule.push((0.5 * (1.0 + x), 0.5 * w));
        if x != 0.0 {
            rule.push((0.5 * (1.0 - x), 0.5 * w));
        }
    }
    rule.sort_by(|a, b| a.0.total_cmp(&b.0));
    rule
}

/// A quadrature point of the half disc: position and area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPoint {
    /// Distance from the axis.
    pub r: f64,
    /// Height above the wall plane.
    pub z: f64,
    /// Area weight (without the factor $2 \pi r$).
    pub area: f64,
}

/// Quadrature of the part of the cell `r0..r1` x `z0..z1` that lies inside the unit half disc.
///
/// `n` Gauss points a direction in each smooth piece. The outer variable is the one along which the circle is
/// flatter, so the inner limits are smooth functions of it.
#[must_use]
pub fn clip_cell((r0, r1): (f64, f64), (z0, z1): (f64, f64), n: usize) -> Vec<SectionPoint> {
    let rule = gauss(n);
    let (zeta0, zeta1) = (z0 - 1.0, z1 - 1.0);
    let near = if zeta0 > 0.0 {
        zeta0
    } else if zeta1 < 0.0 {
        zeta1
    } else {
        0.0
    };
    if r0 * r0 + near * near >= 1.0 {
        return Vec::new();
    }
    let far = zeta0.abs().max(zeta1.abs());
    if r1 * r1 + far * far <= 1.0 {
        return fill(&rule, &[r0, r1], |_| (z0, z1), false);
    }
    let (rm, zm) = (0.5 * (r0 + r1), 0.5 * (zeta0 + zeta1));
    if rm <= zm.abs() {
        let cuts = pieces(r0, r1, &[chord(zeta0), chord(zeta1)]);
        let limits = |r: f64| {
            let half = chord(r);
            (z0.max(1.0 - half), z1.min(1.0 + half))
        };
        fill(&rule, &cuts, limits, false)
    } else {
        let at = |r: f64| [1.0 - chord(r), 1.0 + chord(r)];
        let [a, b] = at(r0);
        let [c, d] = at(r1);
        let cuts = pieces(z0, z1, &[a, b, c, d]);
        fill(&rule, &cuts, |z| (r0, r1.min(chord(z - 1.0))), true)
    }
}

/// Quadrature of a whole cell.
#[must_use]
pub fn whole_cell((r0, r1): (f64, f64), z: (f64, f64), n: usize) -> Vec<SectionPoint> {
    fill(&gauss(n), &[r0, r1], |_| z, false)
}

/// Half chord of the unit circle at distance `x` from its centre.
fn chord(x: f64) -> f64 {
    (1.0 - x * x).max(0.0).sqrt()
}

/// Interval `a..b` split at those `cuts` that lie inside it.
fn pieces(a: f64, b: f64, cuts: &[f64]) -> Vec<f64> {
    let margin = 1e-9 * (b - a);
    let mut all = vec![a];
    let mut inner: Vec<f64> = cuts
        .iter()
        .copied()
        .filter(|c| *c > a + margin && *c < b - margin)
        .collect();
    inner.sort_by(f64::total_cmp);
    inner.dedup_by(|x, y| (*x - *y).abs() < margin);
    all.extend(inner);
    all.push(b);
    all
}

/// Gauss points of the region between `limits` over each outer piece; `swapped`: the outer variable is z.
fn fill(
    rule: &[(f64, f64)],
    cuts: &[f64],
    limits: impl Fn(f64) -> (f64, f64),
    swapped: bool,
) -> Vec<SectionPoint> {
    let mut points = Vec::new();
    for piece in cuts.windows(2) {
        for &(s, ws) in rule {
            let outer = piece[0] + s * (piece[1] - piece[0]);
            let (low, high) = limits(outer);
            if high <= low {
                continue;
            }
            for &(t, wt) in rule {
                let inner = low + t * (high - low);
                let area = ws * (piece[1] - piece[0]) * wt * (high - low);
                let (r, z) = if swapped {
                    (inner, outer)
                } else {
                    (outer, inner)
                };
                points.push(SectionPoint { r, z, area });
            }
        }
    }
    points
}

/// Point of the meridian: polar angle from the south pole, position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Distance from the axis.
    pub r: f64,
    /// Height above the wall plane.
    pub z: f64,
}

/// Points on the exact meridian from the south pole up to polar angle `to`, spaced by `spacing(angle)` (arc length).
#[must_use]
pub fn meridian(to: f64, spacing: impl Fn(SurfacePoint) -> f64) -> Vec<SurfacePoint> {
    let mut angle = 0.0f64;
    let mut points = Vec::new();
    while angle <= to {
        let p = SurfacePoint {
            r: angle.sin(),
            z: 2.0 * (0.5 * angle).sin().powi(2),
        };
        points.push(p);
        angle += spacing(p);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::graded;
    use std::f64::consts::PI;

    fn integrate(h: f64, n: usize, f: impl Fn(&SectionPoint) -> f64) -> f64 {
        let rs = graded(1.0, h, 0.2, 1.2, 0.1);
        let zs = graded(2.0, h, 0.2, 1.2, 0.1);
        let mut sum = 0.0;
        for r in rs.windows(2) {
            for z in zs.windows(2) {
                for p in clip_cell((r[0], r[1]), (z[0], z[1]), n) {
                    sum += 2.0 * PI * p.r * p.area * f(&p);
                }
            }
        }
        sum
    }

    #[test]
    fn clipped_cells_reproduce_volume_centre_and_inertia_of_the_sphere() {
        let volume = 4.0 / 3.0 * PI;
        assert!((integrate(0.02, 2, |_| 1.0) / volume - 1.0).abs() < 2e-5);
        assert!((integrate(0.02, 3, |_| 1.0) / volume - 1.0).abs() < 1e-6);
        assert!((integrate(0.02, 3, |p| p.z) / volume - 1.0).abs() < 1e-6);
        let inertia = integrate(0.02, 3, |p| p.r * p.r);
        assert!((inertia / (0.4 * volume) - 1.0).abs() < 2e-6);
    }

    #[test]
    fn every_point_lies_inside_the_sphere() {
        let all = integrate(0.05, 3, |p| {
            assert!(p.area > 0.0 && p.r * p.r + (p.z - 1.0).powi(2) < 1.0);
            1.0
        });
        assert!(all > 0.0);
    }

    #[test]
    fn meridian_starts_at_the_pole_on_the_exact_circle() {
        let points = meridian(1.0, |_| 0.01);
        assert_eq!((points[0].r, points[0].z), (0.0, 0.0));
        for p in points {
            assert!((p.r * p.r + (p.z - 1.0).powi(2) - 1.0).abs() < 1e-14);
        }
    }
}
