//! Ladder: which settings are tried for one impact, each varied on its own from the planner's choice.

use crate::case::Case;
use crate::plan::{Geometry, Plan, plan, with_prediction};
use crate::unit::significant;

/// Name of the ladder of the finest run.
pub const REFERENCE: &str = "reference";
/// Name of the ladder of what the planner chooses for a tolerance.
pub const PLANNED: &str = "planned";

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
    all.extend(ladder.planned());
    all.extend(ladder.cells());
    all.extend(ladder.one_by_one());
    all.extend(ladder.dimensions());
    all.extend(ladder.transfers());
    all.extend(ladder.lattices());
    all.extend(ladder.solid_lattices());
    all.extend(ladder.thesis());
    all
}

/// Cells a contact radius at which what is not the cell size is varied.
const MIDDLE: f64 = 14.0;

/// Ladders of one impact.
pub(super) struct Ladder<'a> {
    /// The case.
    pub case: &'a Case,
    /// What the planner chooses for it.
    pub base: Plan,
    /// How much is tried.
    pub effort: Effort,
}

impl Ladder<'_> {
    /// The planner's grid with another number of cells in the contact radius.
    pub(super) fn with_cells(&self, cells: f64) -> Plan {
        let mut plan = self.base.clone();
        plan.grid.fine = plan.estimate.contact_radius / cells;
        plan
    }

    pub(super) fn rung(&self, ladder: &str, name: String, plan: Plan) -> Rung {
        Rung {
            ladder: ladder.to_owned(),
            name,
            plan: with_prediction(plan, &self.case.material),
        }
    }

    pub(super) fn is_quick(&self) -> bool {
        self.effort == Effort::Quick
    }

    /// The finest run: fine everywhere, one more point a direction. By the errors that the planner is calibrated on
    /// (2.4/n^2 with n cells a contact radius) it is right to 0.08 %, and to 0.3 % where little is tried. A body that is
    /// flattened costs too much for that: there it is the planned run with cells of 1/1.6 of the size.
    pub(super) fn reference(&self) -> Rung {
        if self.base.grid.remedies.is_large() {
            let cells = (1.6 * self.base.estimate.contact_radius / self.base.grid.fine).round();
            return self.rung(REFERENCE, format!("a/{cells}"), self.with_cells(cells));
        }
        let cells = if self.is_quick() { 28.0 } else { 56.0 };
        let mut plan = self.with_cells(cells);
        plan.grid.coarse = 0.05;
        plan.grid.growth = 1.1;
        plan.grid.points_per_direction = 3;
        self.rung(REFERENCE, format!("a/{cells}"), plan)
    }

    /// What the planner chooses for a tolerance.
    fn planned(&self) -> Vec<Rung> {
        let rung = |tolerance: f64| {
            let mut case = self.case.clone();
            case.tolerance = tolerance;
            let percent = significant(tolerance * 100.0, 2);
            let plan = plan(&case, self.base.velocity);
            self.rung(PLANNED, format!("tolerance {percent} %"), plan)
        };
        [0.05, 0.02, 0.01, 0.005].map(rung).into()
    }

    /// The same impact in three dimensions, a quarter of the sphere.
    fn dimensions(&self) -> Vec<Rung> {
        let cells: &[f64] = match self.effort {
            Effort::Quick => &[3.5],
            Effort::Full => &[3.5, 5.0, 7.0, 10.0],
        };
        let rung = |n: &f64| {
            let mut plan = self.with_cells(*n);
            plan.geometry = Geometry::Quarter;
            plan.grid.growth = 1.3;
            plan.grid.coarse = 0.15;
            self.rung("cells, 3-D", format!("a/{n}"), plan)
        };
        cells.iter().map(rung).collect()
    }

    /// Cell size, for each degree.
    fn cells(&self) -> Vec<Rung> {
        let cells: &[f64] = match self.effort {
            Effort::Quick => &[3.5, 5.0, 7.0, 10.0, 14.0],
            Effort::Full => &[3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0],
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
        if self.base.grid.remedies.long_step > 0.0 {
            vary("time step", "one for all cells".to_owned(), &|p| {
                p.grid.remedies.long_step = 0.0
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
}
