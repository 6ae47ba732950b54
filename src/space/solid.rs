//! Three-dimensional Cartesian space: full tensors, the wall plane is z = 0.

use super::{Space, Symmetric};
use crate::lanes::Lanes;

/// Three dimensions: components (x, y, z), z normal to the wall; weights of a node are $N_{,x}$, $N_{,y}$, $N_{,z}$.
#[derive(Debug, Clone, Copy)]
pub struct Solid;

/// Symmetric tensor in three dimensions.
#[derive(Debug, Clone, Copy)]
pub struct SolidSymmetric {
    xx: Lanes,
    yy: Lanes,
    zz: Lanes,
    xy: Lanes,
    xz: Lanes,
    yz: Lanes,
}

crate::tape::keep_fields!(SolidSymmetric: xx, yy, zz, xy, xz, yz);

/// Gradient in three dimensions: row (component), then column (direction).
#[derive(Debug, Clone, Copy)]
pub struct SolidGradient([[Lanes; 3]; 3]);

impl SolidSymmetric {
    /// Row `i` of the full matrix.
    #[inline(always)]
    fn rows(&self) -> [[Lanes; 3]; 3] {
        [
            [self.xx, self.xy, self.xz],
            [self.xy, self.yy, self.yz],
            [self.xz, self.yz, self.zz],
        ]
    }

    /// Each pair of components combined.
    #[inline(always)]
    fn zip(&self, o: &Self, f: impl Fn(Lanes, Lanes) -> Lanes) -> Self {
        SolidSymmetric {
            xx: f(self.xx, o.xx),
            yy: f(self.yy, o.yy),
            zz: f(self.zz, o.zz),
            xy: f(self.xy, o.xy),
            xz: f(self.xz, o.xz),
            yz: f(self.yz, o.yz),
        }
    }
}

impl Symmetric for SolidSymmetric {
    #[inline(always)]
    fn identity() -> Self {
        let (one, zero) = (Lanes::splat(1.0), Lanes::default());
        SolidSymmetric {
            xx: one,
            yy: one,
            zz: one,
            xy: zero,
            xz: zero,
            yz: zero,
        }
    }
    #[inline(always)]
    fn trace(&self) -> Lanes {
        self.xx + self.yy + self.zz
    }
    #[inline(always)]
    fn shifted(&self, s: Lanes) -> Self {
        SolidSymmetric {
            xx: self.xx + s,
            yy: self.yy + s,
            zz: self.zz + s,
            ..*self
        }
    }
    #[inline(always)]
    fn scaled(&self, s: Lanes) -> Self {
        self.zip(self, |a, _| a * s)
    }
    #[inline(always)]
    fn squared_norm(&self) -> Lanes {
        let diagonal = self.xx * self.xx + self.yy * self.yy + self.zz * self.zz;
        diagonal + (self.xy * self.xy + self.xz * self.xz + self.yz * self.yz) * 2.0
    }
    #[inline(always)]
    fn determinant(&self) -> Lanes {
        Solid::determinant(&SolidGradient(self.rows()))
    }
    #[inline(always)]
    fn where_positive(&self, test: Lanes, other: &Self) -> Self {
        self.zip(other, |a, b| a.where_positive(test, b))
    }
}

/// Matrix of cofactors, $J F^{-T}$.
#[inline(always)]
fn cofactors(f: &SolidGradient) -> [[Lanes; 3]; 3] {
    let [a, b, c] = &f.0;
    [cross(b, c), cross(c, a), cross(a, b)]
}

#[inline(always)]
fn cross(a: &[Lanes; 3], b: &[Lanes; 3]) -> [Lanes; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
fn dot(a: &[Lanes; 3], b: &[Lanes; 3]) -> Lanes {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// $A C A^T$ for the rows of A.
#[inline(always)]
fn congruent(a: &[[Lanes; 3]; 3], c: &SolidSymmetric) -> SolidSymmetric {
    let rows = c.rows();
    // by index, as below: closures of arrays are functions of their own
    let mut half = [[Lanes::default(); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            half[i][j] = dot(&a[i], &rows[j]);
        }
    }
    SolidSymmetric {
        xx: dot(&half[0], &a[0]),
        yy: dot(&half[1], &a[1]),
        zz: dot(&half[2], &a[2]),
        xy: dot(&half[0], &a[1]),
        xz: dot(&half[0], &a[2]),
        yz: dot(&half[1], &a[2]),
    }
}

impl Space for Solid {
    type Vector = [f64; 3];
    type Gradient = SolidGradient;
    type Symmetric = SolidSymmetric;
    const NORMAL: usize = 2;
    const SLIDING: Option<usize> = Some(0);
    const DIRECTIONS: usize = 3;
    const CURVED: bool = false;

    fn moment(x: &[f64; 3], v: &[f64; 3]) -> f64 {
        x[2] * v[0] - x[0] * v[2]
    }
    fn turned(x: &[f64; 3]) -> [f64; 3] {
        [x[2], 0.0, -x[0]]
    }
    fn section(
        position: &[f64; 3],
        reference: &[f64; 3],
        volume: f64,
        depth: f64,
    ) -> Option<[f64; 3]> {
        (reference[1].abs() <= depth).then(|| [position[0], position[2], volume.cbrt()])
    }

    #[inline(always)]
    fn identity() -> SolidGradient {
        SolidGradient(SolidSymmetric::identity().rows())
    }
    #[inline(always)]
    fn add_node(g: &mut SolidGradient, u: &[f64; 3], w: &[Lanes; 3]) {
        for (row, u) in g.0.iter_mut().zip(u) {
            let u = Lanes::splat(*u);
            for (entry, w) in row.iter_mut().zip(w) {
                *entry = u.mul_add(*w, *entry);
            }
        }
    }
    #[inline(always)]
    fn add_force(force: &mut [Lanes; 3], p: &SolidGradient, w: &[Lanes; 3]) {
        for (force, row) in force.iter_mut().zip(&p.0) {
            for (p, w) in row.iter().zip(w) {
                *force = p.mul_add(*w, *force);
            }
        }
    }
    #[inline(always)]
    fn row(factors: &[Lanes], side: usize, row: usize) -> [Lanes; 3] {
        let (j, k) = (row % side, row / side);
        let (y, y_slope) = (factors[2 * side + j], factors[3 * side + j]);
        let (z, z_slope) = (factors[4 * side + k], factors[5 * side + k]);
        [y * z, y_slope * z, y * z_slope]
    }
    #[inline(always)]
    fn add_row(g: &mut SolidGradient, u: &[[f64; 3]], first: &[Lanes], row: &[Lanes; 3]) {
        let nodes = u.len();
        let (values, slopes) = (&first[..nodes], &first[nodes..2 * nodes]);
        for (k, entries) in g.0.iter_mut().enumerate() {
            let (mut sum, mut sum_slope) = (Lanes::default(), Lanes::default());
            // zipped iterators are functions of their own, and may end up in another part of the program, never to be inlined
            for n in 0..nodes {
                let u = Lanes::splat(u[n][k]);
                sum = u.mul_add(values[n], sum);
                sum_slope = u.mul_add(slopes[n], sum_slope);
            }
            entries[0] = sum_slope.mul_add(row[0], entries[0]);
            entries[1] = sum.mul_add(row[1], entries[1]);
            entries[2] = sum.mul_add(row[2], entries[2]);
        }
    }
    #[inline(always)]
    fn add_row_force(force: &mut [Lanes], p: &SolidGradient, first: &[Lanes], row: &[Lanes; 3]) {
        let nodes = force.len() / 3;
        let (values, slopes) = (&first[..nodes], &first[nodes..2 * nodes]);
        for (k, p) in p.0.iter().enumerate() {
            let along = p[0] * row[0];
            let across = p[1].mul_add(row[1], p[2] * row[2]);
            // as above
            for n in 0..nodes {
                let at = 3 * n + k;
                force[at] = along.mul_add(slopes[n], across.mul_add(values[n], force[at]));
            }
        }
    }
    #[inline(always)]
    fn from_points(h: &[[f64; 9]; 4]) -> SolidGradient {
        let mut f = Self::identity();
        for i in 0..3 {
            for j in 0..3 {
                let k = 3 * i + j;
                f.0[i][j] += Lanes::new([h[0][k], h[1][k], h[2][k], h[3][k]]);
            }
        }
        f
    }
    #[inline(always)]
    fn to_points(p: &SolidGradient) -> [[f64; 9]; 4] {
        let mut points = [[0.0; 9]; 4];
        for i in 0..3 {
            for j in 0..3 {
                let lanes = p.0[i][j].array();
                for k in 0..4 {
                    points[k][3 * i + j] = lanes[k];
                }
            }
        }
        points
    }
    #[inline(always)]
    fn determinant(f: &SolidGradient) -> Lanes {
        dot(&f.0[0], &cross(&f.0[1], &f.0[2]))
    }
    #[inline(always)]
    fn push_forward(f: &SolidGradient, c: &SolidSymmetric) -> SolidSymmetric {
        congruent(&f.0, c)
    }
    #[inline(always)]
    fn pull_back(f: &SolidGradient, recip_j: Lanes, b: &SolidSymmetric) -> SolidSymmetric {
        let c = cofactors(f);
        let mut inverse = [[Lanes::default(); 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                inverse[i][j] = c[j][i] * recip_j;
            }
        }
        congruent(&inverse, b)
    }
    #[inline(always)]
    fn first_piola(
        tau: &SolidSymmetric,
        f: &SolidGradient,
        recip_j: Lanes,
        volume: Lanes,
    ) -> SolidGradient {
        let c = cofactors(f);
        let scale = recip_j * volume;
        let rows = tau.rows();
        let mut stress = [[Lanes::default(); 3]; 3];
        for j in 0..3 {
            let column = [c[0][j] * scale, c[1][j] * scale, c[2][j] * scale];
            for i in 0..3 {
                stress[i][j] = dot(&rows[i], &column);
            }
        }
        SolidGradient(stress)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four different, well conditioned gradients.
    fn gradient() -> SolidGradient {
        let mut f = Solid::identity();
        for (i, row) in f.0.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let change = |k: usize| 0.2 * ((3 * i + 5 * j + 7 * k) as f64).sin();
                *entry += Lanes::new([0, 1, 2, 3].map(change));
            }
        }
        f
    }

    fn metric() -> SolidSymmetric {
        congruent(&cofactors(&gradient()), &SolidSymmetric::identity())
    }

    fn distance(a: &SolidSymmetric, b: &SolidSymmetric) -> f64 {
        let d = a.zip(b, |a, b| a - b).squared_norm();
        d.array().iter().fold(0.0f64, |m, x| m.max(x.sqrt()))
    }

    #[test]
    fn pulling_back_undoes_pushing_forward() {
        let f = gradient();
        let recip_j = Solid::determinant(&f).recip();
        let there = Solid::push_forward(&f, &metric());
        assert!(distance(&Solid::pull_back(&f, recip_j, &there), &metric()) < 1e-13);
    }

    #[test]
    fn first_piola_times_the_transposed_gradient_is_the_kirchhoff_stress() {
        let (f, tau) = (gradient(), metric());
        let recip_j = Solid::determinant(&f).recip();
        let p = Solid::first_piola(&tau, &f, recip_j, Lanes::splat(2.0));
        for (i, row) in tau.rows().iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let product = dot(&p.0[i], &f.0[j]) - *entry * 2.0;
                assert!(product.array().iter().all(|x| x.abs() < 1e-13), "{i} {j}");
            }
        }
    }

    #[test]
    fn norm_and_determinant_do_not_change_with_rotation() {
        let (s, c) = 0.7f64.sin_cos();
        let rotation =
            [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]].map(|row| row.map(Lanes::splat));
        let turned = congruent(&rotation, &metric());
        for (a, b) in [
            (metric().squared_norm(), turned.squared_norm()),
            (metric().determinant(), turned.determinant()),
            (metric().trace(), turned.trace()),
        ] {
            assert!((0..4).all(|k| (a.array()[k] / b.array()[k] - 1.0).abs() < 1e-13));
        }
    }
}
