//! Grid: cells of the background grid, and what is done in them against large deformation.

use crate::shape::Shape;
use std::f64::consts::PI;

/// Background grid, lengths in R.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Shape of the body, lengths in R.
    pub shape: Shape,
    /// Degree of the B-splines, 1 to 3.
    pub degree: usize,
    /// Gauss points a direction in every smooth piece of a cell.
    pub points_per_direction: usize,
    /// Cell size at the contact pole.
    pub fine: f64,
    /// Distance from the impact axis up to which cells stay fine.
    pub fine_width: f64,
    /// Height above the pole up to which cells stay fine.
    pub fine_depth: f64,
    /// Growth from cell to cell beyond.
    pub growth: f64,
    /// Largest cell.
    pub coarse: f64,
    /// Share of the stable time step that is used, at most 1 (smaller to show that dt does not matter).
    pub dt_share: f64,
    /// Size of cell whose stable time step smaller ones keep, by as much more mass ([`Grid::scaled_mass`]); 0: none.
    pub scaled: f64,
    /// What is done against large deformation.
    pub remedies: Remedies,
}

/// Cells through which a wave comes from the contact to cells that keep their mass, at most: a dozen of the smallest, then
/// growing ones.
const SCALED_CELLS: f64 = 40.0;
/// Time that it may take for this over the contact time.
const SCALED_TRANSIT: f64 = 0.04;
/// Gain in the time step below which mass is left as it is.
const LEAST_GAIN: f64 = 2.0;

impl Grid {
    /// Factor on the density of a cell whose sides are at least `side`: its stable step becomes that of [`Grid::scaled`].
    #[must_use]
    pub fn density(&self, side: f64) -> f64 {
        (self.scaled / side).powi(2).max(1.0)
    }

    /// Mass that the density of small cells adds to a sphere in the section, over its own.
    #[must_use]
    pub fn added_mass(&self) -> f64 {
        let breaks = |length, to| graded(length, self.fine, to, self.growth, self.coarse);
        let (across, up) = (breaks(1.0, self.fine_width), breaks(2.0, self.fine_depth));
        let mut added = 0.0;
        for z in up.windows(2) {
            let middle = 0.5 * (z[0] + z[1]);
            let chord = (middle * (2.0 - middle)).sqrt();
            for r in across.windows(2).take_while(|r| r[0] < chord) {
                let ring = PI * (r[1].min(chord).powi(2) - r[0].powi(2)) * (z[1] - z[0]);
                added += ring * (self.density((r[1] - r[0]).min(z[1] - z[0])) - 1.0);
            }
        }
        added / (4.0 / 3.0 * PI)
    }

    /// The grid with mass scaled so that its small cells keep the step of cells as large as possible.
    ///
    /// A slow impact lasts many times as long as a wave takes through the body, ever more with $V^{-1/5}$, while the stable step
    /// shrinks with the contact radius, $V^{2/5}$. What inertia the cells at the contact have does not matter then: they are at
    /// rest while the body is slowed down. They get the mass with which they keep the step of larger cells, and the whole is
    /// brought back to the mass of the sphere. Two errors are bounded. The share of mass that is `added`, and so taken from what
    /// moves, is that of the largest errors in F*, $\delta$*, e and contact time. And waves still pass the cells made heavy
    /// within a 25th of the `contact_time`: the forces of inertia go with the square of this.
    #[must_use]
    pub fn scaled_mass(self, added: f64, contact_time: f64) -> Grid {
        let with = |scaled| Grid { scaled, ..self };
        let most = (SCALED_TRANSIT * contact_time / SCALED_CELLS).min(self.coarse);
        let (mut low, mut high) = (self.fine, most);
        if with(most).added_mass() <= added {
            low = most;
        }
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if with(middle).added_mass() <= added {
                low = middle;
            } else {
                high = middle;
            }
        }
        with(if low >= LEAST_GAIN * self.fine {
            low
        } else {
            0.0
        })
    }
}

/// Shortest step that is accepted of flattened bodies as a share of the first, up to [`COARSE`] cells a contact radius. Cells
/// that ask for less lie in the sheet that is squeezed out along the wall. At $\rho V^2/Y = 1$ a tenth of this changes delta*
/// by 0.1 % (34 cells, E/Y 40 to 1280), at 6.4 a quarter by 0.5 %; two and a half times as much takes the sheet's strength
/// where it carries the body, once cells are fine: delta* + 14 % at E/Y 40 with 68 cells.
const LEAST_STEP: f64 = 0.02;
/// Finer cells are squeezed further.
const COARSE: f64 = 28.0;

/// Remedies that carry a run through large deformation; each is off at zero and then costs nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Remedies {
    /// Share of the volumetric stiffness that acts on the volume ratio of each point instead of the cell's mean. Keeps a
    /// point of a yielding cell, whose shape resists with no more than Y, from being turned inside out.
    pub own_volume: f64,
    /// Share of a cell that the body must fill for the cell to keep its own polynomials; what lies in emptier cells is
    /// carried by those of a fuller neighbour, so that no node hangs on a sliver of the body.
    pub least_fill: f64,
    /// Share of the undeformed body's stable step below which the cells that ask for it are weakened (`impact::erosion`).
    pub least_step: f64,
    /// Share of the undeformed body's stable step that most cells keep while those that would shorten it take several short
    /// steps each (`impact::local`); 0: one step for all.
    pub long_step: f64,
    /// Whether shocks are given a viscous stress (`impact::kernel::shock`).
    pub shocks: bool,
}

impl Remedies {
    /// Nothing is done.
    pub const NONE: Remedies = Remedies {
        own_volume: 0.0,
        least_fill: 0.0,
        least_step: 0.0,
        long_step: 0.0,
        shocks: false,
    };
    /// For yielding bodies in three dimensions, where points near the contact edge turn inside out long before the body is
    /// flattened.
    pub const SOLID: Remedies = Remedies {
        own_volume: 0.1,
        least_fill: 0.0,
        least_step: 0.0,
        long_step: 0.0,
        shocks: false,
    };
    /// For impacts that flatten the body, with this many cells a contact radius.
    #[must_use]
    pub fn large(cells: f64) -> Remedies {
        Remedies {
            own_volume: 0.1,
            least_fill: 0.4,
            least_step: LEAST_STEP * (COARSE / cells).min(1.0),
            long_step: 0.3,
            shocks: true,
        }
    }

    /// Whether the body is expected to be flattened.
    #[must_use]
    pub fn is_large(&self) -> bool {
        self.least_step > 0.0
    }
}

/// Breakpoints of a direction: uniform cells of size `fine` over `[0, fine_to]`, then each at most `growth` times the
/// one before, none larger than `coarse`, ending exactly at `length`.
///
/// The graded part is rescaled to end at `length`; cells therefore differ from `fine` by less than one cell's share.
#[must_use]
pub fn graded(length: f64, fine: f64, fine_to: f64, growth: f64, coarse: f64) -> Vec<f64> {
    let n_fine = (fine_to.min(length) / fine).ceil().max(1.0) as usize;
    let mut sizes = vec![1.0; n_fine];
    let mut total = n_fine as f64;
    let mut size = 1.0f64;
    while total * fine < length {
        size = (size * growth).min((coarse / fine).max(1.0));
        sizes.push(size);
        total += size;
    }
    let scale = length / total;
    let mut x = 0.0;
    let mut breaks = vec![0.0];
    for s in &sizes {
        x += s * scale;
        breaks.push(x);
    }
    if let Some(last) = breaks.last_mut() {
        *last = length;
    }
    breaks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grading_respects_growth_and_ends() {
        let b = graded(2.0, 0.01, 0.1, 1.2, 0.1);
        assert_eq!(b[b.len() - 1], 2.0);
        let sizes: Vec<f64> = b.windows(2).map(|w| w[1] - w[0]).collect();
        assert!(
            sizes
                .windows(2)
                .all(|s| s[1] <= 1.2001 * s[0] && s[1] > 0.99 * s[0])
        );
        assert!(sizes[0] <= 0.01 && sizes[0] > 0.008);
    }
}
