//! View: what a bed looks like: film, portraits, pictures, page; and the page of an impact.

pub(crate) mod canvas;
pub(crate) mod colours;
pub mod film;
pub mod impact;
pub(crate) mod kinds;
pub(crate) mod lettering;
pub(crate) mod outline;
pub(crate) mod page;
pub(crate) mod picture;
pub(crate) mod portrait;
pub(crate) mod render;
