//! Checkpoint: the file that holds a run under way, resumed by the same plan and program only.
//!
//! A file is [`MAGIC`], a SHA-256 of all that follows, the [`VERSION`], a digest of program and plan, the seconds taken
//! so far, and the run. A file whose sum does not fit is never read any further.

use super::{Keep, Tape};
use crate::files::write_atomic;
use crate::{PROGRAM, Result};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Version of what checkpoints hold: to be raised whenever a kept structure changes.
pub const VERSION: u64 = 5;
/// First bytes of a checkpoint; they change with the layout of its head.
const MAGIC: [u8; 8] = *b"impactk3";
/// Bytes of a SHA-256.
const SUM: usize = 32;

/// Where a run is kept while it is under way.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    path: PathBuf,
    interval: Duration,
    stop: Option<Arc<AtomicBool>>,
}

impl Checkpoint {
    /// Keep runs in `path`, which is written at most once in `interval`.
    #[must_use]
    pub fn new(path: &Path, interval: Duration) -> Self {
        Checkpoint {
            path: path.to_owned(),
            interval,
            stop: None,
        }
    }

    /// Keeps nothing; runs end, as failed, once `stop` is true.
    #[must_use]
    pub fn stopped_by(stop: Arc<AtomicBool>) -> Self {
        Checkpoint {
            stop: Some(stop),
            ..Self::new(Path::new(""), Duration::MAX)
        }
    }

    /// Whether runs are to end.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        let stop = self.stop.as_ref();
        stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// What a checkpoint's file holds: nothing that is there, what cannot be trusted, a run of another program or plan, or a run
/// and the seconds it had taken.
enum Found {
    Nothing,
    Damaged,
    Version(u64),
    Other,
    Run(Tape, f64),
}

/// How taking up a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TakenUp {
    /// There was none.
    Nothing,
    /// There was one whose contents are of this other version.
    Version(u64),
    /// There was one of another plan or program.
    Other,
    /// There was one that cannot be read or whose sum does not fit: the file is damaged.
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

    /// Whether the run is to end.
    pub fn is_stopped(&self) -> bool {
        self.checkpoint.is_stopped()
    }

    /// Keep the run.
    ///
    /// # Errors
    /// [`crate::Error::File`] when the file cannot be written.
    pub fn keep(&mut self, run: &impl Keep) -> Result<()> {
        let seconds = self.before + self.started.elapsed().as_secs_f64();
        let tape = sealed(VERSION, |tape| {
            self.key.save(tape);
            seconds.save(tape);
            run.save(tape);
        });
        write_atomic(&self.checkpoint.path, tape.as_bytes())?;
        self.last = Instant::now();
        Ok(())
    }

    /// Take up the run that was kept; false, and `run` is not touched, when there is none of this plan. What cannot be taken
    /// up is said and begun anew.
    pub fn take_up<T: Keep + Clone>(&mut self, run: &mut T) -> bool {
        let mut taken = run.clone();
        let path = self.checkpoint.path.display();
        let why = match self.take_up_into(&mut taken) {
            TakenUp::Run => {
                *run = taken;
                return true;
            }
            TakenUp::Nothing => return false,
            TakenUp::Damaged => "is damaged".to_owned(),
            TakenUp::Version(version) => format!("is of version {version}, not {VERSION}"),
            TakenUp::Other => "is of another case or program".to_owned(),
        };
        tracing::warn!("{path} {why}: begun anew");
        false
    }

    /// Take up the run that was kept into one that cannot be copied and is left half changed when it does not fit.
    pub fn take_up_into(&mut self, run: &mut impl Keep) -> TakenUp {
        match self.find() {
            Found::Nothing => TakenUp::Nothing,
            Found::Damaged => TakenUp::Damaged,
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
        let bytes = match std::fs::read(&self.checkpoint.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Found::Nothing,
            Err(_) => return Found::Damaged,
        };
        let Some(mut tape) = unsealed(bytes) else {
            return Found::Damaged;
        };
        let (mut version, mut key, mut seconds) = (0u64, [0u64; 4], 0.0);
        match version.load(&mut tape) {
            None => return Found::Damaged,
            Some(()) if version != VERSION => return Found::Version(version),
            Some(()) => {}
        }
        match key.load(&mut tape).and_then(|()| seconds.load(&mut tape)) {
            None => Found::Damaged,
            Some(()) if key != self.key => Found::Other,
            Some(()) => Found::Run(tape, seconds),
        }
    }

    /// Forget the run, which has ended.
    pub fn forget(&self) {
        // a file that stays does no harm: it is resumed only by the same run, which ends as it did
        let _ = std::fs::remove_file(&self.checkpoint.path);
    }
}

/// A kept file of `version` with what `fill` writes, under its sum.
pub fn sealed(version: u64, fill: impl FnOnce(&mut Tape)) -> Tape {
    let mut tape = Tape::default();
    tape.bytes.extend(MAGIC);
    tape.bytes.extend([0; SUM]);
    version.save(&mut tape);
    fill(&mut tape);
    let (head, summed) = tape.bytes.split_at_mut(MAGIC.len() + SUM);
    head[MAGIC.len()..].copy_from_slice(&Sha256::digest(summed));
    tape
}

/// What a checkpoint of this version keeps of its run, whichever run that is: the tape at its beginning.
///
/// # Errors
/// What is wrong, as the end of a sentence that starts with the file's name.
pub fn contents(bytes: Vec<u8>) -> std::result::Result<Tape, String> {
    let damaged = || "is no restart file, or a damaged one".to_owned();
    let mut tape = unsealed(bytes).ok_or_else(damaged)?;
    let (mut version, mut key, mut seconds) = (0u64, [0u64; 4], 0.0);
    version.load(&mut tape).ok_or_else(damaged)?;
    if version != VERSION {
        return Err(format!(
            "is of version {version} of the restart files; this program reads version {VERSION}"
        ));
    }
    key.load(&mut tape).ok_or_else(damaged)?;
    seconds.load(&mut tape).ok_or_else(damaged)?;
    Ok(tape)
}

/// The tape of a file, at the version; `None` when the file is none of ours or its sum does not fit.
pub fn unsealed(bytes: Vec<u8>) -> Option<Tape> {
    let (magic, rest) = bytes.split_at_checked(MAGIC.len())?;
    let (sum, summed) = rest.split_at_checked(SUM)?;
    let holds = magic == MAGIC && sum == &Sha256::digest(summed)[..];
    holds.then(|| Tape {
        at: MAGIC.len() + SUM,
        bytes,
    })
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

    #[test]
    fn none_of_a_thousand_flipped_bits_is_accepted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c.bin");
        let checkpoint = Checkpoint::new(&path, Duration::ZERO);
        let mut keeper = Keeper::new(&checkpoint, "plan");
        let long = Run {
            speeds: vec![[0.1, 0.2]; 50],
            ..run()
        };
        keeper.keep(&long).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let bits = 8 * bytes.len();
        assert!(bits > 1000);
        // every bit of the head, and a thousand more over all of the file
        for bit in (0..512).chain((0..1000).map(|k| k * bits / 1000)) {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            std::fs::write(&path, flipped).unwrap();
            let mut fresh = Run::default();
            assert_eq!(
                keeper.take_up_into(&mut fresh),
                TakenUp::Damaged,
                "bit {bit}"
            );
            assert_eq!(fresh, Run::default());
        }
    }

    #[test]
    fn a_file_of_another_version_is_told_by_its_version_and_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c.bin");
        let checkpoint = Checkpoint::new(&path, Duration::ZERO);
        let mut keeper = Keeper::new(&checkpoint, "plan");
        let key = keeper.key;
        let tape = sealed(9, |tape| key.save(tape));
        std::fs::write(&path, tape.as_bytes()).unwrap();
        let mut fresh = Run::default();
        let said = TakenUp::Version(9);
        assert_eq!(keeper.take_up_into(&mut fresh), said);
        assert_eq!(fresh, Run::default());
        // files from before there was a sum begin with a digest
        std::fs::write(&path, [7; 400]).unwrap();
        assert_eq!(keeper.take_up_into(&mut fresh), TakenUp::Damaged);
    }
}
