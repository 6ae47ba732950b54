//! What interrupted runs and films keep.

use super::Accepted;
use impactlaw::tape::{Checkpoint, Keep, Keeper, TakenUp, Tape};
use impactlaw::view::film::{Film, Frame};
use sha2::{Digest, Sha256};
use std::path::Path;
use std::sync::LazyLock;
use std::time::Duration;

/// Bytes of a checkpoint up to the version: what marks it, and its sum.
pub(super) const HEAD: usize = 40;
pub(super) const PLAN: &str = "plan";

/// What a run keeps: numbers, names, lists of lists, things that may be absent.
#[derive(Debug, Clone, Default, PartialEq)]
struct Run {
    frame: Frame,
    lists: Vec<Vec<u32>>,
    place: Option<(f64, usize)>,
}

impl Keep for Run {
    fn save(&self, tape: &mut Tape) {
        self.frame.save(tape);
        self.lists.save(tape);
        self.place.save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.frame.load(tape)?;
        self.lists.load(tape)?;
        self.place.load(tape)
    }
}

pub(super) fn frame() -> Frame {
    Frame {
        time: 0.5,
        stage: "settle".to_owned(),
        ids: (0..9).collect(),
        centres: vec![[1.0, -2.0, 3.5]; 9],
        radii: vec![0.5; 9],
        materials: vec![1; 9],
        groups: vec![0; 9],
        speed: vec![0.25; 9],
        plastic: vec![0.0; 9],
        squeeze: vec![1.0; 9],
        poses: vec![[0.0; 7]; 2],
        gone: vec![1],
    }
}

pub(super) fn kept() -> Vec<u8> {
    static KEPT: LazyLock<Vec<u8>> = LazyLock::new(written_checkpoint);
    KEPT.clone()
}

pub(super) fn written_checkpoint() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let checkpoint = Checkpoint::new(&folder.path().join("c.bin"), Duration::ZERO);
    let run = Run {
        frame: frame(),
        lists: vec![vec![1, 2, 3], Vec::new(), vec![7]],
        place: Some((1e-3, 5)),
    };
    Keeper::new(&checkpoint, PLAN).keep(&run).unwrap();
    std::fs::read(checkpoint.path()).unwrap()
}

/// What stands below the sum of a checkpoint, under a sum that fits.
pub(super) fn resealed(below: &[u8]) -> Vec<u8> {
    let head = &kept()[..8];
    [head, &Sha256::digest(below)[..], below].concat()
}

pub(super) fn taken_up(bytes: &[u8], folder: &Path) -> Accepted {
    let checkpoint = Checkpoint::new(&folder.join("c.bin"), Duration::ZERO);
    std::fs::write(checkpoint.path(), bytes).unwrap();
    let mut run = Run::default();
    Keeper::new(&checkpoint, PLAN).take_up_into(&mut run) == TakenUp::Run
}

/// A frame below its sum.
pub(super) fn film(bytes: &[u8], folder: &Path) -> Accepted {
    std::fs::write(folder.join("00000.bin"), resealed(bytes)).unwrap();
    Film::new(folder).frame(0).is_ok()
}
