//! The room `fit` without its search: what a law file and the atlas take from it.

#[path = "../fit/fitted.rs"]
mod fitted;
#[path = "../fit/form.rs"]
pub(crate) mod form;
#[path = "../fit/quality.rs"]
pub mod quality;
#[path = "../fit/run.rs"]
pub mod run;

pub use fitted::{Fit, FittedForm, Outcome, left_out_bound, threshold};
