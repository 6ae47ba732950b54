//! Wall: what a run asks of its contact, and what one step of contact answers.

pub mod attraction;
pub(crate) mod banded;
pub(crate) mod complementarity;
pub(crate) mod contact_point;
pub(crate) mod interior;
pub(crate) mod meridian;
pub mod surface;

use self::attraction::Pull;
use crate::space::Space;
use crate::tape::Keep;

/// Contact violation that counts as solved, in impact speeds.
pub(in crate::impact) const CONTACT_TOLERANCE: f64 = 1e-7;

/// What one step of contact did.
#[derive(Debug, Clone, Copy, Default)]
pub struct Touch {
    /// Total normal impulse.
    pub impulse: f64,
    /// Total impulse in the direction of sliding.
    pub tangential: f64,
    /// Work of the impulses on the body (negative: taken out by touching points brought to rest).
    pub work: f64,
    /// Outermost deformed distance from the axis of a point that carries force; 0 without contact.
    pub radius: f64,
    /// Largest violation left, as a speed (0 where the active set closed).
    pub residual: f64,
    /// Impulse of attraction, towards the wall; not in `impulse`.
    pub pull: f64,
}

/// What a run asks of its contact with the wall.
pub trait Wall<S: Space>: Clone + Keep {
    /// Points that could touch within `horizon`, if nothing moves faster than `speed`, among those that a node for which
    /// `among` holds carries; call now and then.
    fn refresh(&mut self, u: &[S::Vector], speed: f64, horizon: f64, among: &dyn Fn(usize) -> bool);
    /// Solve one step: `old` are the velocities before the forces, `v` the free velocities, corrected in place.
    fn solve(
        &mut self,
        dt: f64,
        u: &[S::Vector],
        old: &[S::Vector],
        v: &mut [S::Vector],
        recip_mass: &[S::Vector],
    ) -> Touch;
    /// Forces of the wall's attraction at displacements `u`, added to `force`; 0 where it has none.
    fn pull(&mut self, _u: &[S::Vector], _force: &mut [S::Vector]) -> Pull {
        Pull::default()
    }
    /// Gap from which on the wall does not attract; 0 where it never does.
    fn range(&self) -> f64 {
        0.0
    }
    /// Speed at which surfaces may snap together; 0 where they do not.
    fn snapping(&self) -> f64 {
        0.0
    }
    /// Deformed surface points of the meridian, pole to pole: distance from the axis and height above the wall.
    fn outline(&self, u: &[S::Vector]) -> Vec<(f64, f64)>;
}
