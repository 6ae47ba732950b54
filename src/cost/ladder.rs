//! Ladder: which settings are tried for one impact, each varied on its own from the planner's choice.

use crate::case::Case;
use crate::material::stress::Moduli;
use crate::plan::{Plan, plan, with_prediction};
use crate::scheme::{Layout, Reference, Scheme, TimeStep, Transfer};
use crate::unit::significant;

/// Name of the ladder of the finest run.
pub const REFERENCE: &str = "reference";

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Coarse ladders: under a minute for the cases here.
    Quick,
    /// Everything.
    Full,
}

/// One setting to try.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// What is varied.
    pub ladder: String,
    /// Setting.
    pub name: String,
    /// What to run.
    pub plan: Plan,
}

/// Ladders of one impact of a case, the reference first.
#[must_use]
pub fn rungs(case: &Case, velocity: f64, effort: Effort) -> Vec<Rung> {
    let ladder = Ladder {
        case,
        base: plan(case, velocity),
        effort,
    };
    let mut all = vec![ladder.reference()];
    all.extend(ladder.cells());
    all.extend(ladder.one_by_one());
    all.extend(ladder.transfers());
    all.extend(ladder.lattices());
    all.extend(ladder.thesis());
    all
}

/// Fifteen settings of the thesis (table 3-1): name, points a diameter, element to point ratio.
const THESIS: [(&str, f64, f64); 5] = [
    ("MP/ES", 50.0, 1.05),
    ("2MP/ES", 62.0, 1.3),
    ("4MP/ES", 80.0, 1.68),
    ("MP/2ES", 25.0, 1.05),
    ("MP/4ES", 13.0, 1.05),
];

/// Cells a contact radius at which what is not the cell size is varied.
const MIDDLE: f64 = 14.0;

struct Ladder<'a> {
    case: &'a Case,
    base: Plan,
    effort: Effort,
}

impl Ladder<'_> {
    /// The planner's grid with another number of cells in the contact radius.
    fn with_cells(&self, cells: f64) -> Plan {
        let mut plan = self.base.clone();
        plan.grid.fine = plan.estimate.contact_radius / cells;
        plan
    }

    fn rung(&self, ladder: &str, name: String, plan: Plan) -> Rung {
        Rung {
            ladder: ladder.to_owned(),
            name,
            plan: with_prediction(plan, &self.case.material),
        }
    }

    fn is_quick(&self) -> bool {
        self.effort == Effort::Quick
    }

    /// The finest run: fine everywhere, one more point a direction.
    fn reference(&self) -> Rung {
        let cells = if self.is_quick() { 28.0 } else { 80.0 };
        let mut plan = self.with_cells(cells);
        plan.grid.coarse = 0.05;
        plan.grid.growth = 1.1;
        plan.grid.points_per_direction = 3;
        self.rung(REFERENCE, format!("a/{cells}"), plan)
    }

    /// Cell size, for each degree.
    fn cells(&self) -> Vec<Rung> {
        let cells: &[f64] = match self.effort {
            Effort::Quick => &[3.5, 5.0, 7.0, 10.0, 14.0],
            Effort::Full => &[3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0, 56.0],
        };
        let mut all = Vec::new();
        for degree in [2, 1, 3] {
            for &n in cells {
                let mut plan = self.with_cells(n);
                plan.grid.degree = degree;
                all.push(self.rung(&format!("cells, degree {degree}"), format!("a/{n}"), plan));
            }
        }
        all
    }

    /// Points, time step and far grid, one at a time.
    fn one_by_one(&self) -> Vec<Rung> {
        let mut all = Vec::new();
        let mut vary = |ladder: &str, name: String, change: &dyn Fn(&mut Plan)| {
            let mut plan = self.with_cells(MIDDLE);
            change(&mut plan);
            all.push(self.rung(ladder, name, plan));
        };
        for n in 1..=4 {
            vary("points", format!("{n} x {n}"), &|p| {
                p.grid.points_per_direction = n
            });
        }
        for share in [1.0, 0.5, 0.25, 0.125] {
            vary("time step", format!("{share} of stable"), &|p| {
                p.grid.dt_share = share
            });
        }
        for coarse in [0.2, 0.1, 0.05, 0.025] {
            vary("far cells", format!("{coarse} R"), &|p| {
                p.grid.coarse = coarse
            });
        }
        for growth in [1.3, 1.15, 1.08] {
            vary("growth", format!("{growth}"), &|p| p.grid.growth = growth);
        }
        all
    }

    /// Transfers of velocity between points and grid, every step, on the planner's grid; with the stable step and a tenth.
    fn transfers(&self) -> Vec<Rung> {
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

    /// Lattice points on a uniform grid, one point a cell: velocity on the nodes, FLIP, updated Lagrangian.
    fn lattices(&self) -> Vec<Rung> {
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
                    let mut plan = self.lattice(count, 1.05);
                    plan.grid.degree = degree;
                    plan.scheme.transfer = transfer;
                    plan.scheme.reference = reference;
                    if reference == Reference::Present {
                        plan.scheme.time_step =
                            TimeStep::Fixed(0.1 * self.crossing(plan.grid.fine));
                    }
                    let ladder = format!("lattice, degree {degree}, {name}");
                    all.push(self.rung(&ladder, format!("{count} a diameter"), plan));
                }
            }
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

    /// c0, m/s.
    fn bar_speed(&self) -> f64 {
        (self.case.material.young_modulus / self.case.material.density).sqrt()
    }

    /// Time in which a dilatational wave and the body cross a cell, R/c0 (thesis, equation 3-27).
    fn crossing(&self, cell: f64) -> f64 {
        let material = &self.case.material;
        let wave = Moduli::new(1.0, material.poisson_ratio).dilatational_speed(1.0);
        cell / (wave + self.base.velocity / self.bar_speed())
    }

    /// Settings of the thesis (tables 3-1 and 3-2) in the axisymmetric section: lattice, cubic splines, FLIP, fixed step.
    ///
    /// Its step is 0.1, 0.01 or 0.001 of the power of ten (in seconds) below the smallest cell's crossing time.
    fn thesis(&self) -> Vec<Rung> {
        let unit = self.case.radius / self.bar_speed();
        let least = THESIS
            .iter()
            .map(|(_, count, ratio)| self.crossing(ratio * 2.0 / count) * unit)
            .fold(f64::INFINITY, f64::min);
        let order = 10f64.powf(least.log10().floor()) / unit;
        let mut all = Vec::new();
        for multiplier in [0.1, 0.01, 0.001] {
            for (name, count, ratio) in THESIS {
                if self.is_quick() && (multiplier < 0.1 || count > 25.0) {
                    continue;
                }
                let mut plan = self.lattice(count, ratio);
                plan.grid.degree = 3;
                plan.scheme = Scheme {
                    transfer: Transfer::Blend(1.0),
                    time_step: TimeStep::Fixed(multiplier * order),
                    ..plan.scheme
                };
                let step = significant(multiplier * order * unit * 1e9, 3);
                all.push(self.rung("thesis", format!("{name}, {step} ns"), plan));
            }
        }
        all
    }
}
