//! Member: one of several surfaces near a grain, and what of its contacts ends or begins with a step.

use crate::dem::bodies::touching::Touches;
use parry3d::math::Vector;

/// Seat of a candidate whose grain has no other.
pub(in crate::dem) const ALONE: u32 = u32::MAX;

/// One of the surfaces near a grain that has several.
#[derive(Debug, Clone, Copy)]
pub(in crate::dem) struct Member {
    pub(super) grain: u32,
    pub(super) surface: u32,
    /// Place among the candidates of its family.
    pub(super) candidate: u32,
    pub(super) is_mesh: bool,
    /// Some of its points belong to the contact of another surface.
    pub(super) shares: bool,
    /// Its points, without those.
    pub(in crate::dem) touches: Touches,
}

/// Patch of a family, and the normal of its contact.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) patch: usize,
    pub(super) normal: Vector,
}

/// Patches of a candidate whose contact ends with this step, and those of which one begins.
#[derive(Default)]
pub(super) struct Turnover {
    pub(super) ending: Vec<Place>,
    pub(super) beginning: Vec<Place>,
}
