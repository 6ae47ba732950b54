//! The room `export` as far as the C header.

#[path = "../export/c/mod.rs"]
pub mod c;
#[path = "../export/source/mod.rs"]
pub mod source;
