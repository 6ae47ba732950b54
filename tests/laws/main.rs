//! Contact laws: fitted ones, published ones, and the impacts that either gives.

mod atlas;
mod examples;
mod fit_finite_element;
mod fit_synthetic;
mod impacts;
mod inverse;
mod law_file;
mod law_guarantees;
mod pair_law;
mod rebound_inertia;
mod theory_command;
mod theory_compare;
mod theory_hardening;
mod theory_properties;
mod theory_rebound;
mod theory_values;
