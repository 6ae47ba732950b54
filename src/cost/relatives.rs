//! Relatives: rungs with the schemes of other codes, from transfers of velocity to the settings of the thesis.

use super::ladder::{Ladder, Rung};
use super::thesis::{self, Setting};
use crate::case::Case;
use crate::plan::{Geometry, Plan, plan};
use crate::scheme::preset::{Method, Preset, StepRule};
use crate::scheme::{Layout, Reference, TimeStep, Transfer};
use crate::unit::significant;

/// Ladder of the thesis' scheme at its cheapest: a lattice in three dimensions, cubic splines, one point a cell, FLIP, the
/// largest stable step.
pub const CUBIC_LATTICES: &str = "lattice, 3-D, degree 3, 1 point a cell, FLIP";

/// Ladder of what most material point codes do: a lattice in three dimensions, linear functions, eight points a cell, FLIP,
/// the largest stable step.
pub const LINEAR_LATTICES: &str = "lattice, 3-D, degree 1, 8 points a cell, FLIP";

/// Time after loss of contact of the thesis' runs over that of others: e is that of the centre of mass, which nothing changes then.
const RING_SHARE: f64 = 0.25;

/// Cell over spacing of lattices that fill every cell: two points a direction.
const FULL_RATIO: f64 = 2.0;

impl Ladder<'_> {
    /// Transfers of velocity between points and grid, every step, on the planner's grid; with the stable step and a tenth.
    pub(super) fn transfers(&self) -> Vec<Rung> {
        let cells: &[f64] = if self.is_quick() {
            &[5.0]
        } else {
            &[7.0, 14.0]
        };
        let kinds = [
            Transfer::Persistent,
            Transfer::Blend(1.0),
            Transfer::Blend(0.99),
            Transfer::Blend(0.0),
            Transfer::Apic,
        ];
        let mut all = Vec::new();
        for &n in cells {
            for share in [1.0, 0.1] {
                for transfer in kinds {
                    let mut plan = self.with_cells(n);
                    plan.scheme.transfer = transfer;
                    plan.grid.dt_share = share;
                    let name = format!("{}, a/{n}, {share} of stable", transfer.name());
                    all.push(self.rung("transfer", name, plan));
                }
            }
        }
        all
    }

    /// Lattice points on a uniform grid, one point a cell: velocity on the nodes, FLIP, updated Lagrangian; and four points a
    /// cell with FLIP, which a section affords fine enough to show the order of the error.
    ///
    /// One point a cell leaves motions of cubic nodes that no point resists. A transfer filters some of them every step; with
    /// the velocity on the nodes the body sinks into itself (`tests/impact/schemes.rs`), which is why this crate fills its
    /// cells with Gauss points.
    pub(super) fn lattices(&self) -> Vec<Rung> {
        let counts: &[f64] = if self.is_quick() {
            &[26.0, 38.0]
        } else {
            &[26.0, 38.0, 50.0, 80.0, 120.0]
        };
        let nodal = (Transfer::Persistent, Reference::Initial, "nodal");
        let flip = (Transfer::Blend(1.0), Reference::Initial, "FLIP");
        let updated = (
            Transfer::Blend(1.0),
            Reference::Present,
            "FLIP, updated Lagrangian",
        );
        let mut all = Vec::new();
        for degree in [1, 3] {
            for (transfer, reference, name) in [nodal, flip, updated] {
                for &count in counts {
                    let mut plan = self.lattice(count, thesis::RATIO);
                    plan.grid.degree = degree;
                    plan.scheme.transfer = transfer;
                    plan.scheme.reference = reference;
                    if reference == Reference::Present {
                        plan.scheme.time_step = TimeStep::Fixed(
                            0.1 * self.case.crossing(plan.velocity, plan.grid.fine),
                        );
                    }
                    let ladder = format!("lattice, degree {degree}, {name}");
                    all.push(self.rung(&ladder, format!("{count} a diameter"), plan));
                }
            }
        }
        let fine: &[f64] = if self.is_quick() {
            counts
        } else {
            &[26.0, 50.0, 100.0, 200.0, 400.0]
        };
        for &count in fine {
            let mut plan = self.lattice(count, FULL_RATIO);
            plan.grid.degree = 1;
            plan.scheme.transfer = Transfer::Blend(1.0);
            let ladder = "lattice, degree 1, 4 points a cell, FLIP";
            all.push(self.rung(ladder, format!("{count} a diameter"), plan));
        }
        all
    }

    /// Lattice of `count` points a diameter on uniform cells of `ratio` spacings.
    fn lattice(&self, count: f64, ratio: f64) -> Plan {
        let mut plan = self.base.clone();
        plan.grid.fine = ratio * 2.0 / count;
        plan.grid.fine_width = 1.0;
        plan.grid.fine_depth = 2.0;
        plan.scheme.layout = Layout::Lattice(count);
        plan
    }

    /// Lattices in three dimensions with FLIP and the largest stable step: the thesis' scheme, and linear functions with
    /// eight points a cell.
    ///
    /// What bounds both is the staircase. The lattice first touches with a flat of radius $\sqrt{s R}$ (s: spacing), so its
    /// delta* falls short by about s/4 and the error is of first order in s. One point a cell is worse than that: cubic
    /// functions then have motions that no point resists, and at a ratio of 1.05 every twentieth cell is empty; plastic flow
    /// takes them up and e falls to a third (0.18 for 0.48 at E/Y 80, rho V^2/Y 0.0058, 50 points a
    /// diameter; a ratio of 1 or degree 2 leaves 0.34).
    pub(super) fn solid_lattices(&self) -> Vec<Rung> {
        let (cubic, linear): (&[f64], &[f64]) = if self.is_quick() {
            (&[13.0, 20.0], &[20.0, 30.0])
        } else {
            (
                &[13.0, 25.0, 38.0, 50.0, 80.0],
                &[26.0, 50.0, 80.0, 120.0, 160.0],
            )
        };
        let kinds = [
            (3, CUBIC_LATTICES, thesis::RATIO, cubic),
            (1, LINEAR_LATTICES, FULL_RATIO, linear),
        ];
        let mut all = Vec::new();
        for (degree, name, ratio, counts) in kinds {
            for &count in counts {
                let mut plan = self.lattice(count, ratio);
                plan.geometry = Geometry::Quarter;
                plan.grid.degree = degree;
                plan.scheme.transfer = Transfer::Blend(1.0);
                all.push(self.rung(name, format!("{count} a diameter"), plan));
            }
        }
        all
    }

    /// Settings of the thesis (tables 3-1 and 3-2) by its preset; in the section, and in three dimensions with two planes of symmetry.
    ///
    /// Its step is 0.1, 0.01 or 0.001 of the power of ten (in seconds) below the smallest cell's crossing time, for all settings.
    pub(super) fn thesis(&self) -> Vec<Rung> {
        let unit = self.case.unit_of_time();
        let least = (thesis::SETTINGS.iter())
            .map(|s| self.case.crossing(self.base.velocity, s.cell()))
            .fold(f64::INFINITY, f64::min);
        let mut all = Vec::new();
        for geometry in [Geometry::Axisymmetric, Geometry::Quarter] {
            for (nth, multiplier) in thesis::MULTIPLIERS.into_iter().enumerate() {
                for setting in &thesis::SETTINGS {
                    if self.is_quick() && (nth > 0 || setting.count > 25) {
                        continue;
                    }
                    let Some(dt) = StepRule::OfOrder(multiplier).fixed(least, unit) else {
                        continue;
                    };
                    let plan = self.preset(setting, dt, geometry);
                    let step = significant(dt * unit * 1e9, 3);
                    let name = format!("{}, {step} ns", setting.name);
                    all.push(self.rung(&thesis::ladder(geometry, nth), name, plan));
                }
            }
        }
        all
    }

    /// A setting of the thesis with the fixed step `dt`. Its runs end when contact is lost; here a little later.
    fn preset(&self, setting: &Setting, dt: f64, geometry: Geometry) -> Plan {
        let crossing = self.case.crossing(self.base.velocity, setting.cell());
        let method = Method {
            filling: Some(setting.filling()),
            step: StepRule::OfCrossing(dt / crossing),
            dimensions: match geometry {
                Geometry::Axisymmetric => 2,
                _ => 3,
            },
            ..Preset::Thesis.usual()
        };
        let case = Case {
            method: Some(method),
            ..self.case.clone()
        };
        let plan = plan(&case, self.base.velocity);
        Plan {
            ring_time: RING_SHARE * plan.ring_time,
            ..plan
        }
    }
}
