//! Packing of a scene by itself: what stands after the stages that make it, before any law begins.

use super::grains::Grains;
use super::room::Room;
use super::run::{Options, begin, pack};
use super::scene::{Scene, Stage};
use crate::Result;

/// Grains that have come to rest in their room.
#[derive(Debug, Clone)]
pub struct Packed {
    /// Grains, with the motion that is left.
    pub grains: Grains,
    /// The room.
    pub room: Room,
    /// Whether all grains of the scene are in.
    pub complete: bool,
}

/// Runs the stages of a scene that make its packing, and writes their files.
///
/// # Errors
/// Those of [`super::run::run_scene`] but for the laws.
pub fn packed(scene: &Scene, options: &Options) -> Result<Packed> {
    let mut start = begin(scene, options)?;
    if scene.stages.iter().any(Stage::prepares) {
        pack(scene, &mut start, options)?.record.discard();
    }
    Ok(Packed {
        complete: start.feed.is_done(scene),
        grains: start.grains,
        room: start.room,
    })
}
