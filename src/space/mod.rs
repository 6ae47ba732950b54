//! Space: what a run's kernel is generic over, from the components of a node to the tensors of a point.
//!
//! [`Axisymmetric`] carries (r, z) and the hoop stretch, [`Solid`] all three dimensions. All tensors hold `Lanes`: four
//! material points side by side.

mod axisymmetric;
mod solid;

pub use axisymmetric::{AxialGradient, AxialSymmetric, Axisymmetric};
pub use solid::{Solid, SolidGradient, SolidSymmetric};

use crate::lanes::Lanes;
use crate::tape::Keep;

/// Symmetric tensor of a space.
pub trait Symmetric: Copy + Keep + Send + Sync + 'static {
    /// Unit tensor.
    fn identity() -> Self;
    /// Trace.
    fn trace(&self) -> Lanes;
    /// `self + s 1`.
    #[must_use]
    fn shifted(&self, s: Lanes) -> Self;
    /// `s self`.
    #[must_use]
    fn scaled(&self, s: Lanes) -> Self;
    /// `self : self`.
    fn squared_norm(&self) -> Lanes;
    /// Determinant.
    fn determinant(&self) -> Lanes;
    /// `self` where `test > 0`, else `other`.
    #[must_use]
    fn where_positive(&self, test: Lanes, other: &Self) -> Self;
}

/// Vectors whose components lie side by side in memory.
pub trait Flat: Sized {
    /// Components of one.
    const COMPONENTS: usize;
    /// Components of all, vector after vector.
    fn flat(all: &[Self]) -> &[f64];
    /// The same, to be changed.
    fn flat_mut(all: &mut [Self]) -> &mut [f64];
}

impl<const D: usize> Flat for [f64; D] {
    const COMPONENTS: usize = D;
    #[inline(always)]
    fn flat(all: &[Self]) -> &[f64] {
        all.as_flattened()
    }
    #[inline(always)]
    fn flat_mut(all: &mut [Self]) -> &mut [f64] {
        all.as_flattened_mut()
    }
}

/// A space a run can live in.
pub trait Space: Copy + Send + Sync + 'static {
    /// Vector of a node (displacement, velocity, force).
    type Vector: Copy
        + Default
        + Keep
        + Flat
        + Send
        + Sync
        + std::fmt::Debug
        + AsRef<[f64]>
        + AsMut<[f64]>;
    /// Deformation gradient, or first Piola-Kirchhoff stress.
    type Gradient: Copy + Send + Sync;
    /// Stress-like tensor.
    type Symmetric: Symmetric;
    /// Component of a vector that is normal to the wall.
    const NORMAL: usize;
    /// Component of a vector along which an oblique impact slides; `None` where only normal impacts exist.
    const SLIDING: Option<usize>;

    /// Moment about the axis an oblique impact turns about, y of $x \times v$; `x` from any fixed point.
    fn moment(x: &Self::Vector, v: &Self::Vector) -> f64;
    /// Velocity at `x` of a turn about that axis at unit rate: positive rolls in the direction of sliding.
    fn turned(x: &Self::Vector) -> Self::Vector;
    /// A material point of reference volume `volume` as seen in the plane of a map: distance along it, height, edge length.
    /// `None` for points farther than `depth` from that plane.
    fn section(
        position: &[f64; 3],
        reference: &[f64; 3],
        volume: f64,
        depth: f64,
    ) -> Option<[f64; 3]>;

    /// Unit deformation gradient.
    fn identity() -> Self::Gradient;
    /// `gradient += u (x) grad N` for one node with weights `w`.
    fn add_node(gradient: &mut Self::Gradient, u: &Self::Vector, w: &[Lanes; 3]);
    /// `force += P grad N` lane by lane, for one node with weights `w`.
    fn add_force(force: &mut [Lanes; 3], p: &Self::Gradient, w: &[Lanes; 3]);
    /// Directions of the grid, each with splines of its own, and components of a vector.
    const DIRECTIONS: usize;
    /// Whether a point has one more factor, $1/r$.
    const CURVED: bool;

    /// Weights that the nodes of row `row` have in common: products of the factors of all directions but the first.
    ///
    /// `factors` of four points: values and slopes of `side` functions of the first direction, then of the second, ..., then
    /// $1/r$ in a curved space. A row is the `side` nodes that differ in the first direction only.
    fn row(factors: &[Lanes], side: usize, row: usize) -> [Lanes; 3];
    /// `gradient += sum u (x) grad N` over the nodes of a row with weights `row`; `first` are the factors of the first
    /// direction. What the nodes have in common is multiplied once.
    fn add_row(
        gradient: &mut Self::Gradient,
        u: &[Self::Vector],
        first: &[Lanes],
        row: &[Lanes; 3],
    );
    /// `force += P grad N` lane by lane for each node of a row, all components of a node side by side; the counterpart of
    /// [`Self::add_row`].
    fn add_row_force(force: &mut [Lanes], p: &Self::Gradient, first: &[Lanes], row: &[Lanes; 3]);
    /// Deformation gradients of four points from their displacement gradients, row by row of three; what a curved space has besides, the
    /// hoop strain, stands last.
    fn from_points(displacement: &[[f64; 9]; 4]) -> Self::Gradient;
    /// A tensor of four points taken apart as [`Self::from_points`] has it, without the unit.
    fn to_points(tensor: &Self::Gradient) -> [[f64; 9]; 4];
    /// Determinant J.
    fn determinant(f: &Self::Gradient) -> Lanes;
    /// $F C F^T$.
    fn push_forward(f: &Self::Gradient, c: &Self::Symmetric) -> Self::Symmetric;
    /// $F^{-1} b F^{-T}$, with `1/J` given.
    fn pull_back(f: &Self::Gradient, recip_j: Lanes, b: &Self::Symmetric) -> Self::Symmetric;
    /// First Piola-Kirchhoff stress $\tau F^{-T}$ times `volume`, with `1/J` given.
    fn first_piola(
        tau: &Self::Symmetric,
        f: &Self::Gradient,
        recip_j: Lanes,
        volume: Lanes,
    ) -> Self::Gradient;
}
