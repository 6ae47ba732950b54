//! Target `table`: F(delta; delta_max) of a body of radius 1 m as CSV, for codes that interpolate.

use crate::Result;
use crate::export::source::artifact::Artifact;
use crate::export::source::describe;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;
use crate::files::row;
use std::fmt::Write;

/// Largest displacements of the table, up to the end of the law's range.
const BRANCHES: u32 = 40;
/// Displacements on each branch, from loss of contact to the largest one.
const POINTS: u32 = 40;

/// Table of forces.
#[derive(Debug, Clone, Copy)]
pub struct Table;

impl Dialect for Table {
    const NAME: &'static str = "table";
    const PAIR: Option<PairExport> = None;
    const OF_PAIRS: bool = false;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        Ok(export(law))
    }
}

/// The table `<identifier>.csv`: for each largest displacement, spaced evenly in $\sqrt{\delta_m}$, the branch from the
/// displacement at which contact is lost up to it. The last point of each branch lies on the loading curve.
#[must_use]
pub fn export(law: &Portable) -> Vec<Artifact> {
    let mut text = String::new();
    for line in describe::lines(law) {
        let _ = writeln!(text, "{}", format!("# {line}").trim_end());
    }
    text.push_str(
        "# Table: x = delta/R and F/R^2 (Pa) of one body on a wall on the branch of each x_max = delta_max/R.\n\
         # F is 0 below the first x of a branch. Between branches interpolate at equal (x - x_res)/(x_max - x_res),\n\
         # x_res being the first x of each; the last row of a branch lies on the loading curve.\n\
         displacement_max_over_radius,displacement_over_radius,force_over_radius2_Pa\n",
    );
    for branch in 1..=BRANCHES {
        let share = f64::from(branch) / f64::from(BRANCHES);
        let most = share * share * law.file.valid.displacement_over_radius_max;
        let lost = residual(law, most);
        for point in 0..=POINTS {
            let x = lost + (most - lost) * f64::from(point) / f64::from(POINTS);
            let x = if point == POINTS { most } else { x };
            text.push_str(&row(&[most, x, law.core.force(1.0, x, most)]));
        }
    }
    vec![Artifact {
        name: format!("{}.csv", law.identifier),
        text,
    }]
}

/// Flattening over radius at which contact is lost after a largest one of `most`.
fn residual(law: &Portable, most: f64) -> f64 {
    use crate::law::FittedLaw;
    match &law.core {
        FittedLaw::Hertz(_) => 0.0,
        FittedLaw::ClosedForm(core) => core.residual(&core.memory(most)),
        FittedLaw::Spline(core) => core.residual(&core.memory(most)),
    }
}
