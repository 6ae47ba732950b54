//! Scheme: the choices that make one material point method differ from another, and their names.
//!
//! [`Scheme::default`] is what this crate uses. The others exist to be compared with it (`impactlaw cost`), and are asked for by the
//! name of a [`preset::Preset`].

pub mod preset;

/// How velocity lives between steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transfer {
    /// On the nodes, for good: no transfer between points and grid.
    Persistent,
    /// On the points: each step maps it to the nodes by lumped mass; the points take back this share of the change of
    /// the nodal velocity (FLIP) and for the rest the nodal velocity itself (PIC). 1: FLIP, 0: PIC.
    Blend(f64),
    /// On the points, with an affine field about each (Jiang and others 2015).
    Apic,
}

/// Where the material points are and what grid they live on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Layout {
    /// Gauss points of the cells clipped by the exact sphere; contact on its exact surface; graded grid.
    Fitted,
    /// Square (in three dimensions cubic) lattice of this many points a diameter, kept where they lie inside the sphere; the
    /// outermost touch the wall as discs of the lattice's spacing.
    Lattice(f64),
    /// The lattice of the thesis: a point in the centre of the sphere, as many points as its table 3-1 prints for so many a
    /// diameter, of equal masses that sum to the sphere's; the outermost touch the wall as spheres of the points' distance. Equal cells
    /// reach a point beyond the body all around.
    Centred(f64),
}

impl Layout {
    /// Breakpoints of equal cells of size `cell` to both sides of the centre, of a lattice with a point there: out to a point beyond
    /// the body. None of other layouts.
    #[must_use]
    pub fn around_centre(&self, cell: f64) -> Option<Vec<f64>> {
        let Layout::Centred(count) = self else {
            return None;
        };
        let half = ((1.0 + 2.0 / count) / cell - 1e-9).ceil() as i32;
        Some((-half..=half).map(|k| f64::from(k) * cell).collect())
    }

    /// Length of a grid of cells of size `cell` that covers `length`: of a lattice a whole number of cells, so that the ratio of
    /// cell to spacing is the one asked for; a fitted grid is scaled to end with the body.
    #[must_use]
    pub fn covering(&self, length: f64, cell: f64) -> f64 {
        match self {
            Layout::Fitted => length,
            // a cell that is full but for rounding is full
            Layout::Lattice(_) | Layout::Centred(_) => cell * (length / cell - 1e-9).ceil(),
        }
    }
}

/// Configuration that gradients refer to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// The undeformed one: weights never change (total Lagrangian).
    Initial,
    /// The present one: points move through the grid and weights are computed every step (updated Lagrangian); in the
    /// axisymmetric section only.
    Present,
}

/// Length of the time steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeStep {
    /// A share of the stability limit, estimated as the body deforms.
    Stable,
    /// This long throughout, R/c0.
    Fixed(f64),
}

/// One material point method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scheme {
    /// How velocity lives between steps.
    pub transfer: Transfer,
    /// Material points and grid.
    pub layout: Layout,
    /// Configuration that gradients refer to.
    pub reference: Reference,
    /// Length of the time steps.
    pub time_step: TimeStep,
}

impl Default for Scheme {
    fn default() -> Self {
        Scheme {
            transfer: Transfer::Persistent,
            layout: Layout::Fitted,
            reference: Reference::Initial,
            time_step: TimeStep::Stable,
        }
    }
}

impl Transfer {
    /// Name as the field writes it: FLIP, PIC, APIC.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Transfer::Persistent => "nodal".to_owned(),
            Transfer::Blend(1.0) => "FLIP".to_owned(),
            Transfer::Blend(0.0) => "PIC".to_owned(),
            Transfer::Blend(flip) => format!("FLIP {flip}"),
            Transfer::Apic => "APIC".to_owned(),
        }
    }
}
