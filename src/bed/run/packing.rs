//! Packing of a scene by itself: what stands after the stages that make it, before any law begins.

use crate::Result;
use crate::bed::run::{Options, begin, pack};
use crate::bed::scene::{Scene, Stage};
use crate::dem::bodies::enclosure::Room;
use crate::dem::grains::Grains;

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
/// Those of [`crate::bed::run::run_scene`] but for the laws.
pub fn packed(scene: &Scene, options: &Options) -> Result<Packed> {
    let mut start = begin(scene, options.seed)?;
    if scene.stages.iter().any(Stage::prepares) {
        pack(scene, &mut start, options)?.record.discard();
    }
    Ok(Packed {
        complete: start.feed.is_done(),
        grains: start.grains,
        room: start.room,
    })
}
