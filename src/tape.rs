//! Tape: what a run in progress knows, as a row of numbers, so that it can be stopped and taken up again bit by bit.
//!
//! Only what changes is kept; grid, points and couplings are built again from the plan, and the file names the plan and the
//! program it belongs to. Numbers are kept as their bits.

use crate::files::write_atomic;
use crate::lanes::{Lanes, WIDTH};
use crate::{PROGRAM, Result};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Numbers written one after the other, and read back in the same order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tape {
    numbers: Vec<u64>,
    at: usize,
}

impl Tape {
    /// The next number.
    fn next(&mut self) -> Option<u64> {
        let number = self.numbers.get(self.at).copied();
        self.at += 1;
        number
    }
}

/// What can be kept on a tape.
pub trait Keep {
    /// Write what changes in a run.
    fn save(&self, tape: &mut Tape);
    /// Take back what [`Keep::save`] wrote; `None` when the tape does not fit.
    fn load(&mut self, tape: &mut Tape) -> Option<()>;
}

impl Keep for () {
    fn save(&self, _: &mut Tape) {}
    fn load(&mut self, _: &mut Tape) -> Option<()> {
        Some(())
    }
}

impl Keep for u64 {
    fn save(&self, tape: &mut Tape) {
        tape.numbers.push(*self);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = tape.next()?;
        Some(())
    }
}

impl Keep for f64 {
    fn save(&self, tape: &mut Tape) {
        self.to_bits().save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = f64::from_bits(tape.next()?);
        Some(())
    }
}

impl Keep for bool {
    fn save(&self, tape: &mut Tape) {
        u64::from(*self).save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = tape.next()? != 0;
        Some(())
    }
}

/// Elements whose number does not change.
impl<T: Keep> Keep for [T] {
    fn save(&self, tape: &mut Tape) {
        self.iter().for_each(|x| x.save(tape));
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.iter_mut().try_for_each(|x| x.load(tape))
    }
}

impl<T: Keep, const N: usize> Keep for [T; N] {
    fn save(&self, tape: &mut Tape) {
        self.as_slice().save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.as_mut_slice().load(tape)
    }
}

impl Keep for usize {
    fn save(&self, tape: &mut Tape) {
        (*self as u64).save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = usize::try_from(tape.next()?).ok()?;
        Some(())
    }
}

impl Keep for u32 {
    fn save(&self, tape: &mut Tape) {
        u64::from(*self).save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = u32::try_from(tape.next()?).ok()?;
        Some(())
    }
}

impl Keep for u8 {
    fn save(&self, tape: &mut Tape) {
        u64::from(*self).save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = tape.next()?.try_into().ok()?;
        Some(())
    }
}

impl<A: Keep, B: Keep> Keep for (A, B) {
    fn save(&self, tape: &mut Tape) {
        self.0.save(tape);
        self.1.save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.0.load(tape)?;
        self.1.load(tape)
    }
}

impl<T: Keep + Default + Clone> Keep for Vec<T> {
    fn save(&self, tape: &mut Tape) {
        (self.len() as u64).save(tape);
        self.iter().for_each(|x| x.save(tape));
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let length = usize::try_from(tape.next()?).ok()?;
        if length > tape.numbers.len() {
            return None;
        }
        self.resize(length, T::default());
        self.iter_mut().try_for_each(|x| x.load(tape))
    }
}

impl<T: Keep + Default> Keep for Option<T> {
    fn save(&self, tape: &mut Tape) {
        self.is_some().save(tape);
        if let Some(x) = self {
            x.save(tape);
        }
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        *self = match tape.next()? {
            0 => None,
            _ => {
                let mut x = T::default();
                x.load(tape)?;
                Some(x)
            }
        };
        Some(())
    }
}

impl Keep for Lanes {
    fn save(&self, tape: &mut Tape) {
        self.array().save(tape);
    }
    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let mut numbers = [0.0; WIDTH];
        numbers.load(tape)?;
        *self = Lanes::new(numbers);
        Some(())
    }
}

/// Keep a structure by some of its fields, in the order given: `keep_fields!(Type: a, b)`, or with generics
/// `keep_fields!(impl [T: Keep] Type<T>: a, b)`.
macro_rules! keep_fields {
    (impl [$($generics:tt)*] $structure:ty: $($field:ident),+ $(,)?) => {
        impl<$($generics)*> $crate::tape::Keep for $structure {
            fn save(&self, tape: &mut $crate::tape::Tape) {
                $(self.$field.save(tape);)+
            }
            fn load(&mut self, tape: &mut $crate::tape::Tape) -> Option<()> {
                $(self.$field.load(tape)?;)+
                Some(())
            }
        }
    };
    ($structure:ty: $($field:ident),+ $(,)?) => {
        $crate::tape::keep_fields!(impl [] $structure: $($field),+);
    };
}
pub(crate) use keep_fields;

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
}

/// A checkpoint in use by one run.
#[derive(Debug)]
pub struct Keeper<'a> {
    checkpoint: &'a Checkpoint,
    /// First numbers of the file: program and plan.
    key: [u64; 4],
    last: Instant,
    started: Instant,
    /// Seconds that the run had taken when it was taken up.
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

    /// Seconds the run took before it was taken up.
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
        self.key.save(&mut tape);
        (self.before + self.started.elapsed().as_secs_f64()).save(&mut tape);
        run.save(&mut tape);
        let bytes: Vec<u8> = tape.numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        write_atomic(&self.checkpoint.path, &bytes)?;
        self.last = Instant::now();
        Ok(())
    }

    /// Take up the run that was kept; false, and `run` is not touched, when there is none of this plan.
    pub fn take_up<T: Keep + Clone>(&mut self, run: &mut T) -> bool {
        let Ok(bytes) = std::fs::read(&self.checkpoint.path) else {
            return false;
        };
        let mut tape = Tape {
            numbers: bytes
                .chunks_exact(8)
                .map(|b| u64::from_le_bytes(std::array::from_fn(|i| b[i])))
                .collect(),
            at: 0,
        };
        let mut key = [0u64; 4];
        let mut seconds = 0.0;
        let mut taken = run.clone();
        let fits = key.load(&mut tape).is_some()
            && key == self.key
            && seconds.load(&mut tape).is_some()
            && taken.load(&mut tape).is_some()
            && tape.at == tape.numbers.len();
        if fits {
            *run = taken;
            self.before = seconds;
        }
        fits
    }

    /// Forget the run, which has ended.
    pub fn forget(&self) {
        // a file that stays does no harm: it is taken up only by the same run, which ends as it did
        let _ = std::fs::remove_file(&self.checkpoint.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
