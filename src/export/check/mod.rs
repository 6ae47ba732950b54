//! Check: the exported law compiled and run in the codes that are installed, compared with the law itself.

mod c;
pub mod driver;
mod impacts;
pub mod lammps;
pub mod liggghts;
mod native;
mod pair_law;
pub mod paths;
mod process;
pub mod series;
mod shim;

pub use c::CompilerCheck;
pub use native::NativeCheck;
pub use process::{Ran, find_program, run};
pub use shim::ShimCheck;

use crate::Result;
use crate::export::source::portable::Portable;
use std::fmt::Write;
use std::path::Path;

/// How far one figure of another code is from ours.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// What was compared, e.g. `sphere on wall, 10 m/s: restitution`.
    pub subject: String,
    /// Largest deviation found; relative unless the subject says otherwise.
    pub deviation: f64,
    /// Deviation allowed.
    pub allowed: f64,
}

impl Agreement {
    /// Is the deviation within what is allowed? NaN is not.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.deviation <= self.allowed
    }
}

/// What came of one check.
#[derive(Debug, Clone, PartialEq)]
pub enum Finding {
    /// It ran.
    Ran {
        /// Program and version it ran with.
        with: String,
        /// The comparisons.
        agreements: Vec<Agreement>,
    },
    /// It could not run here.
    Skipped {
        /// What is missing and how to get it.
        why: String,
    },
}

/// One code that can be tried.
pub trait Check {
    /// Name of the code.
    fn name(&self) -> &'static str;

    /// Export `law`, run it in the code and compare; files go into `scratch`, an existing folder.
    ///
    /// # Errors
    /// Those of writing and running files; a code that is not installed is [`Finding::Skipped`], not an error.
    fn run(&self, law: &Portable, scratch: &Path) -> Result<Finding>;
}

/// Largest of some deviations; NaN if one of them is, so that nothing undefined passes for agreement.
#[must_use]
pub fn largest(deviations: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, next: f64| {
        if next.is_nan() || next > most {
            next
        } else {
            most
        }
    };
    deviations.into_iter().fold(0.0, larger)
}

/// The findings as text: a table of the comparisons, and what was skipped and why.
#[must_use]
pub fn table(findings: &[(&'static str, Finding)]) -> String {
    let mut text = String::new();
    for (code, finding) in findings {
        match finding {
            Finding::Skipped { why } => {
                let _ = writeln!(text, "{code}: SKIPPED: {why}");
            }
            Finding::Ran { with, agreements } => {
                let _ = writeln!(text, "{code} ({with}):");
                let width = agreements.iter().map(|a| a.subject.chars().count()).max();
                for a in agreements {
                    let verdict = if a.holds() { "ok" } else { "MISS" };
                    let _ = writeln!(
                        text,
                        "  {:width$}  {:9.2e}  allowed {:.1e}  {verdict}",
                        a.subject,
                        a.deviation,
                        a.allowed,
                        width = width.unwrap_or(0)
                    );
                }
            }
        }
    }
    text
}
