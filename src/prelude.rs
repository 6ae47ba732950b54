//! Prelude: what a program that uses the library names most; `use impactlaw::prelude::*;`.
//!
//! Small programs that use it stand under `src/examples/` and are run by the tests.

pub use crate::bed::run::{BedReport, Options, run_scene};
pub use crate::bed::scene::Scene;
pub use crate::case::Case;
pub use crate::compare::Comparison;
pub use crate::contact::rebound::rebound;
pub use crate::contact::{LawVisitor, NormalLaw};
pub use crate::curve::Impact;
pub use crate::export::Target;
pub use crate::export::source::portable::Portable;
pub use crate::fit::fit;
pub use crate::impact::simulate;
pub use crate::law::{FittedLaw, Form, LawFile};
pub use crate::material::{Flow, Material};
pub use crate::plan::plans;
pub use crate::theory::Theory;
pub use crate::{Error, PROGRAM, Result};
