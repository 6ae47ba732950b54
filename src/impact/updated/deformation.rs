//! Deformation gradient of one axisymmetric point as plain numbers, for points that move through the grid.

use crate::lanes::Lanes;
use crate::space::{Axisymmetric, Space};

/// Components rr, rz, zr, zz, hoop.
pub type Deformation = [f64; 5];

/// $F^T \nabla N$ for weights $N_{,r}$, $N_{,z}$, $N/r$.
#[must_use]
pub fn pulled_back(w: &[f64; 3], f: &Deformation) -> [f64; 3] {
    let [rr, rz, zr, zz, hoop] = f;
    [w[0] * rr + w[1] * zr, w[0] * rz + w[1] * zz, w[2] * hoop]
}

/// The same numbers as the space's gradient.
#[must_use]
pub fn gradient(f: &Deformation) -> <Axisymmetric as Space>::Gradient {
    let [rr, rz, zr, zz, hoop] = *f;
    let lanes = |w: [f64; 3]| w.map(Lanes::splat);
    let mut gradient = Axisymmetric::identity();
    Axisymmetric::add_node(
        &mut gradient,
        &[1.0, 0.0],
        &lanes([rr - 1.0, rz, hoop - 1.0]),
    );
    Axisymmetric::add_node(&mut gradient, &[0.0, 1.0], &lanes([zr, zz - 1.0, 0.0]));
    gradient
}
