//! Checkpoint: the file that holds a run under way, resumed by the same plan and program only.

use super::{Keep, Tape};
use crate::files::write_atomic;
use crate::{PROGRAM, Result};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Version of what checkpoints hold: to be raised whenever a kept structure changes.
pub const VERSION: u64 = 2;
/// First bytes of a checkpoint; the first version had none.
const MAGIC: [u8; 8] = *b"impactlw";

/// Where a run is kept while it is under way.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    path: PathBuf,
    interval: Duration,
}

impl Checkpoint {
    /// Keep runs in `path`, which is written at most once in `interval`.
    #[must_use]
    pub fn new(path: &Path, interval: Duration) -> Self {
        Checkpoint {
            path: path.to_owned(),
            interval,
        }
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// What a checkpoint's file holds: nothing, a run of another version, plan or program, or a run and the seconds it had taken.
enum Found {
    Nothing,
    Version(u64),
    Other,
    Run(Tape, f64),
}

/// How taking up a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TakenUp {
    /// There was none.
    Nothing,
    /// There was one whose contents are of this other version.
    Version(u64),
    /// There was one of another plan or program.
    Other,
    /// There was one that does not fit: the file is damaged.
    Damaged,
    /// It goes on.
    Run,
}

/// A checkpoint in use by one run.
#[derive(Debug)]
pub struct Keeper<'a> {
    checkpoint: &'a Checkpoint,
    /// First numbers of the file: program and plan.
    key: [u64; 4],
    last: Instant,
    started: Instant,
    /// Seconds that the run had taken when it was resumed.
    before: f64,
}

impl<'a> Keeper<'a> {
    /// For the run that `description` tells from all others.
    pub fn new(checkpoint: &'a Checkpoint, description: &str) -> Self {
        let digest = Sha256::digest(format!("{PROGRAM}\n{description}"));
        let key = std::array::from_fn(|k| {
            let bytes: [u8; 8] = std::array::from_fn(|i| digest[8 * k + i]);
            u64::from_le_bytes(bytes)
        });
        Keeper {
            checkpoint,
            key,
            last: Instant::now(),
            started: Instant::now(),
            before: 0.0,
        }
    }

    /// Seconds the run took before it was resumed.
    pub fn seconds_before(&self) -> f64 {
        self.before
    }

    /// Whether it is time to keep the run again.
    pub fn is_due(&self) -> bool {
        self.last.elapsed() >= self.checkpoint.interval
    }

    /// Keep the run.
    ///
    /// # Errors
    /// [`crate::Error::File`] when the file cannot be written.
    pub fn keep(&mut self, run: &impl Keep) -> Result<()> {
        let mut tape = Tape::default();
        MAGIC.save(&mut tape);
        VERSION.save(&mut tape);
        self.key.save(&mut tape);
        (self.before + self.started.elapsed().as_secs_f64()).save(&mut tape);
        run.save(&mut tape);
        write_atomic(&self.checkpoint.path, tape.as_bytes())?;
        self.last = Instant::now();
        Ok(())
    }

    /// Take up the run that was kept; false, and `run` is not touched, when there is none of this plan.
    pub fn take_up<T: Keep + Clone>(&mut self, run: &mut T) -> bool {
        let Found::Run(mut tape, seconds) = self.find() else {
            return false;
        };
        let mut taken = run.clone();
        let fits = taken.load(&mut tape).is_some() && tape.is_at_end();
        if fits {
            *run = taken;
            self.before = seconds;
        }
        fits
    }

    /// Take up the run that was kept into one that cannot be copied and is left half changed when it does not fit.
    pub fn take_up_into(&mut self, run: &mut impl Keep) -> TakenUp {
        match self.find() {
            Found::Nothing => TakenUp::Nothing,
            Found::Version(version) => TakenUp::Version(version),
            Found::Other => TakenUp::Other,
            Found::Run(mut tape, seconds) => {
                if run.load(&mut tape).is_none() || !tape.is_at_end() {
                    return TakenUp::Damaged;
                }
                self.before = seconds;
                TakenUp::Run
            }
        }
    }

    /// What the file holds.
    fn find(&self) -> Found {
        let Ok(bytes) = std::fs::read(&self.checkpoint.path) else {
            return Found::Nothing;
        };
        let mut tape = Tape::from_bytes(bytes);
        let (mut magic, mut version) = ([0u8; 8], 0u64);
        let read = magic.load(&mut tape).is_some() && version.load(&mut tape).is_some();
        if !read || magic != MAGIC {
            return Found::Version(1);
        }
        if version != VERSION {
            return Found::Version(version);
        }
        let (mut key, mut seconds) = ([0u64; 4], 0.0);
        let read = key.load(&mut tape).is_some() && seconds.load(&mut tape).is_some();
        match read && key == self.key {
            true => Found::Run(tape, seconds),
            false => Found::Other,
        }
    }

    /// Forget the run, which has ended.
    pub fn forget(&self) {
        // a file that stays does no harm: it is resumed only by the same run, which ends as it did
        let _ = std::fs::remove_file(&self.checkpoint.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tape::keep_fields;

    #[derive(Debug, Clone, Default, PartialEq)]
    struct Run {
        speeds: Vec<[f64; 2]>,
        step: u64,
        seen: Option<bool>,
    }
    keep_fields!(Run: speeds, step, seen);

    fn run() -> Run {
        Run {
            speeds: vec![[0.1, -0.0], [f64::INFINITY, 1e-300]],
            step: 7,
            seen: Some(true),
        }
    }

    #[test]
    fn a_run_is_taken_up_as_it_was_kept_and_only_by_its_own_plan() {
        let folder = tempfile::tempdir().unwrap();
        let checkpoint = Checkpoint::new(&folder.path().join("c.bin"), Duration::ZERO);
        let mut keeper = Keeper::new(&checkpoint, "plan a");
        assert!(keeper.is_due());
        keeper.keep(&run()).unwrap();
        let mut fresh = Run::default();
        assert!(!Keeper::new(&checkpoint, "plan b").take_up(&mut fresh));
        assert_eq!(fresh, Run::default());
        let mut again = Keeper::new(&checkpoint, "plan a");
        assert!(again.take_up(&mut fresh));
        assert_eq!(fresh, run());
        again.forget();
        assert!(!again.take_up(&mut fresh));
    }

    #[test]
    fn a_file_of_another_version_is_told_by_its_version() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c.bin");
        let checkpoint = Checkpoint::new(&path, Duration::ZERO);
        let mut keeper = Keeper::new(&checkpoint, "plan");
        keeper.keep(&run()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let later = [&MAGIC[..], &9u64.to_le_bytes(), &bytes[16..]].concat();
        for (file, version) in [(&later[..], 9), (&bytes[16..], 1), (b"short", 1)] {
            std::fs::write(&path, file).unwrap();
            let mut fresh = Run::default();
            assert_eq!(keeper.take_up_into(&mut fresh), TakenUp::Version(version));
            assert_eq!(fresh, Run::default());
        }
    }

    #[test]
    fn a_damaged_file_is_not_taken_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c.bin");
        let checkpoint = Checkpoint::new(&path, Duration::ZERO);
        let mut keeper = Keeper::new(&checkpoint, "plan");
        keeper.keep(&run()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        for damaged in [
            &bytes[..bytes.len() - 8],
            &[bytes.as_slice(), &[0; 8]].concat(),
        ] {
            std::fs::write(&path, damaged).unwrap();
            let mut fresh = Run::default();
            assert!(!keeper.take_up(&mut fresh));
            assert_eq!(fresh, Run::default());
        }
    }
}
