//! View: what a bed looks like: film, portraits, pictures, page.

pub mod canvas;
pub mod colours;
pub mod film;
pub mod kinds;
pub mod lettering;
pub mod outline;
pub mod page;
pub mod picture;
pub mod portrait;
pub mod render;
