//! The source tree itself: which room may use which, and what its scripts may hold.

mod rooms;
mod scripts;
