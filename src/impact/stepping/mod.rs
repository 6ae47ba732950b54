//! Time steps: how long one may be, cells with steps of their own, and what is taken out when it vanishes.

pub(crate) mod erosion;
pub(crate) mod levels;
pub(crate) mod stability;
