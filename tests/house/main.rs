//! The source tree itself: which room may use which, what its scripts may hold, and equations that can be read.

#[path = "../support/browser.rs"]
mod browser;
mod equations;
mod rooms;
mod scripts;
mod sources;
