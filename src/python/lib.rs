//! Python package of impactlaw: cases, impacts, laws, theories, the atlas, beds by hand, and the program itself.
//!
//! Numbers go in and out as NumPy arrays through the buffer protocol, without a copy on the way out. Work is done without the
//! interpreter's lock, long work looks for Ctrl-C, and whatever the library refuses is raised as `impactlaw.Error` with its text.
//! What the program can do this package does with the same functions, so results are the program's bit for bit.

mod array;
mod bed;
mod border;
mod case;
mod impacts;
mod law;
mod program;
mod values;
mod words;

/// The compiled part of the package `impactlaw`.
#[pyo3::pymodule]
mod _impactlaw {
    #[pymodule_export]
    use crate::bed::Bed;
    #[pymodule_export]
    use crate::border::Error;
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::impacts::{Impact, Impacts};
    #[pymodule_export]
    use crate::law::{Law, Rebound, theories};
    #[pymodule_export]
    use crate::program::{columns_of, fall, main, verb, version};
}
