//! Axisymmetric space: the section (r, z) of a body of revolution, with its hoop stretch.

use super::{Space, Symmetric};
use crate::lanes::Lanes;

/// Axisymmetry about the impact axis: components (r, z); weights of a node are $N_{,r}$, $N_{,z}$, $N/r$.
#[derive(Debug, Clone, Copy)]
pub struct Axisymmetric;

/// Symmetric tensor with the components rr, zz, hoop, rz.
#[derive(Debug, Clone, Copy)]
pub struct AxialSymmetric {
    rr: Lanes,
    zz: Lanes,
    hoop: Lanes,
    rz: Lanes,
}

crate::tape::keep_fields!(AxialSymmetric: rr, zz, hoop, rz);

/// Gradient with the components rr, rz, zr, zz, hoop.
#[derive(Debug, Clone, Copy)]
pub struct AxialGradient {
    rr: Lanes,
    rz: Lanes,
    zr: Lanes,
    zz: Lanes,
    hoop: Lanes,
}

impl AxialGradient {
    /// Determinant of the part in the section.
    #[inline(always)]
    fn plane(&self) -> Lanes {
        self.rr * self.zz - self.rz * self.zr
    }
}

impl Symmetric for AxialSymmetric {
    #[inline(always)]
    fn identity() -> Self {
        let one = Lanes::splat(1.0);
        AxialSymmetric {
            rr: one,
            zz: one,
            hoop: one,
            rz: Lanes::default(),
        }
    }
    #[inline(always)]
    fn trace(&self) -> Lanes {
        self.rr + self.zz + self.hoop
    }
    #[inline(always)]
    fn shifted(&self, s: Lanes) -> Self {
        AxialSymmetric {
            rr: self.rr + s,
            zz: self.zz + s,
            hoop: self.hoop + s,
            rz: self.rz,
        }
    }
    #[inline(always)]
    fn scaled(&self, s: Lanes) -> Self {
        AxialSymmetric {
            rr: self.rr * s,
            zz: self.zz * s,
            hoop: self.hoop * s,
            rz: self.rz * s,
        }
    }
    #[inline(always)]
    fn squared_norm(&self) -> Lanes {
        self.rr * self.rr + self.zz * self.zz + self.hoop * self.hoop + self.rz * self.rz * 2.0
    }
    #[inline(always)]
    fn determinant(&self) -> Lanes {
        (self.rr * self.zz - self.rz * self.rz) * self.hoop
    }
    #[inline(always)]
    fn where_positive(&self, test: Lanes, other: &Self) -> Self {
        AxialSymmetric {
            rr: self.rr.where_positive(test, other.rr),
            zz: self.zz.where_positive(test, other.zz),
            hoop: self.hoop.where_positive(test, other.hoop),
            rz: self.rz.where_positive(test, other.rz),
        }
    }
}

impl Space for Axisymmetric {
    type Vector = [f64; 2];
    type Gradient = AxialGradient;
    type Symmetric = AxialSymmetric;
    const NORMAL: usize = 1;
    const SLIDING: Option<usize> = None;
    const DIRECTIONS: usize = 2;
    const CURVED: bool = true;

    fn moment(_: &[f64; 2], _: &[f64; 2]) -> f64 {
        0.0
    }
    fn turned(_: &[f64; 2]) -> [f64; 2] {
        [0.0; 2]
    }
    fn section(position: &[f64; 3], reference: &[f64; 3], volume: f64, _: f64) -> Option<[f64; 3]> {
        let size = (volume / (std::f64::consts::TAU * reference[0])).sqrt();
        Some([position[0], position[1], size])
    }

    #[inline(always)]
    fn identity() -> AxialGradient {
        let (one, zero) = (Lanes::splat(1.0), Lanes::default());
        AxialGradient {
            rr: one,
            rz: zero,
            zr: zero,
            zz: one,
            hoop: one,
        }
    }
    #[inline(always)]
    fn add_node(g: &mut AxialGradient, u: &[f64; 2], w: &[Lanes; 3]) {
        let (ur, uz) = (Lanes::splat(u[0]), Lanes::splat(u[1]));
        g.rr = ur.mul_add(w[0], g.rr);
        g.rz = ur.mul_add(w[1], g.rz);
        g.zr = uz.mul_add(w[0], g.zr);
        g.zz = uz.mul_add(w[1], g.zz);
        g.hoop = ur.mul_add(w[2], g.hoop);
    }
    #[inline(always)]
    fn add_force(force: &mut [Lanes; 3], p: &AxialGradient, w: &[Lanes; 3]) {
        force[0] =
            p.rr.mul_add(w[0], p.rz.mul_add(w[1], p.hoop.mul_add(w[2], force[0])));
        force[1] = p.zr.mul_add(w[0], p.zz.mul_add(w[1], force[1]));
    }
    #[inline(always)]
    fn row(factors: &[Lanes], side: usize, row: usize) -> [Lanes; 3] {
        let (value, slope) = (factors[2 * side + row], factors[3 * side + row]);
        [value, slope, value * factors[4 * side]]
    }
    #[inline(always)]
    fn add_row(g: &mut AxialGradient, u: &[[f64; 2]], first: &[Lanes], row: &[Lanes; 3]) {
        let nodes = u.len();
        let (values, slopes) = (&first[..nodes], &first[nodes..2 * nodes]);
        let zero = Lanes::default();
        let (mut r, mut r_slope, mut z, mut z_slope) = (zero, zero, zero, zero);
        // zipped iterators are functions of their own, and may end up in another part of the program, never to be inlined
        for n in 0..nodes {
            let (ur, uz) = (Lanes::splat(u[n][0]), Lanes::splat(u[n][1]));
            r = ur.mul_add(values[n], r);
            r_slope = ur.mul_add(slopes[n], r_slope);
            z = uz.mul_add(values[n], z);
            z_slope = uz.mul_add(slopes[n], z_slope);
        }
        g.rr = r_slope.mul_add(row[0], g.rr);
        g.rz = r.mul_add(row[1], g.rz);
        g.zr = z_slope.mul_add(row[0], g.zr);
        g.zz = z.mul_add(row[1], g.zz);
        g.hoop = r.mul_add(row[2], g.hoop);
    }
    #[inline(always)]
    fn add_row_force(force: &mut [Lanes], p: &AxialGradient, first: &[Lanes], row: &[Lanes; 3]) {
        let nodes = force.len() / 2;
        let (values, slopes) = (&first[..nodes], &first[nodes..2 * nodes]);
        let (r_slope, z_slope) = (p.rr * row[0], p.zr * row[0]);
        let (r, z) = (p.rz.mul_add(row[1], p.hoop * row[2]), p.zz * row[1]);
        // as above
        for n in 0..nodes {
            let (value, slope) = (values[n], slopes[n]);
            let [along_r, along_z] = [2 * n, 2 * n + 1];
            force[along_r] = r_slope.mul_add(slope, r.mul_add(value, force[along_r]));
            force[along_z] = z_slope.mul_add(slope, z.mul_add(value, force[along_z]));
        }
    }
    #[inline(always)]
    fn from_points(h: &[[f64; 9]; 4]) -> AxialGradient {
        let one = Lanes::splat(1.0);
        let of = |k: usize| Lanes::new([h[0][k], h[1][k], h[2][k], h[3][k]]);
        AxialGradient {
            rr: one + of(0),
            rz: of(1),
            zr: of(3),
            zz: one + of(4),
            hoop: one + of(8),
        }
    }
    #[inline(always)]
    fn to_points(p: &AxialGradient) -> [[f64; 9]; 4] {
        let (rr, rz, zr) = (p.rr.array(), p.rz.array(), p.zr.array());
        let (zz, hoop) = (p.zz.array(), p.hoop.array());
        let mut points = [[0.0; 9]; 4];
        for k in 0..4 {
            points[k] = [rr[k], rz[k], 0.0, zr[k], zz[k], 0.0, 0.0, 0.0, hoop[k]];
        }
        points
    }
    #[inline(always)]
    fn determinant(f: &AxialGradient) -> Lanes {
        f.plane() * f.hoop
    }
    #[inline(always)]
    fn push_forward(f: &AxialGradient, c: &AxialSymmetric) -> AxialSymmetric {
        let ar = f.rr * c.rr + f.rz * c.rz;
        let az = f.rr * c.rz + f.rz * c.zz;
        let br = f.zr * c.rr + f.zz * c.rz;
        let bz = f.zr * c.rz + f.zz * c.zz;
        AxialSymmetric {
            rr: ar * f.rr + az * f.rz,
            zz: br * f.zr + bz * f.zz,
            hoop: f.hoop * f.hoop * c.hoop,
            rz: ar * f.zr + az * f.zz,
        }
    }
    #[inline(always)]
    fn pull_back(f: &AxialGradient, recip_j: Lanes, b: &AxialSymmetric) -> AxialSymmetric {
        let scale = recip_j * f.hoop;
        let recip_hoop = recip_j * f.plane();
        let inverse = AxialGradient {
            rr: f.zz * scale,
            rz: -f.rz * scale,
            zr: -f.zr * scale,
            zz: f.rr * scale,
            hoop: recip_hoop,
        };
        Self::push_forward(&inverse, b)
    }
    #[inline(always)]
    fn first_piola(
        tau: &AxialSymmetric,
        f: &AxialGradient,
        recip_j: Lanes,
        volume: Lanes,
    ) -> AxialGradient {
        let scale = recip_j * f.hoop * volume;
        let recip_hoop = recip_j * f.plane() * volume;
        AxialGradient {
            rr: (tau.rr * f.zz - tau.rz * f.rz) * scale,
            rz: (tau.rz * f.rr - tau.rr * f.zr) * scale,
            zr: (tau.rz * f.zz - tau.zz * f.rz) * scale,
            zz: (tau.zz * f.rr - tau.rz * f.zr) * scale,
            hoop: tau.hoop * recip_hoop,
        }
    }
}
