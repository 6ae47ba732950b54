//! Readers under attack: no input makes one panic, hang or fill the memory, and what is accepted holds what it must.
//!
//! The tests run a bounded count; `IMPACTLAW_ATTACKS=1000000` sets how many inputs all readers get together, and
//! `IMPACTLAW_ATTACK_SEED` another beginning.

use crate::memory::peak_of;
use crate::mutate::mutated;
use crate::readers::{READERS, Reader};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Inputs of all readers together, unless the environment says otherwise.
const COUNT: u64 = 10_000;
/// Longest time for one input. A reader takes milliseconds; the machine may be busy.
const LONGEST: Duration = Duration::from_secs(10);
/// Most memory that an input may take, bytes: a thousand times the longest.
const MOST: isize = 64 << 20;

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
}

/// Inputs of one reader: its share of all.
fn inputs_of(reader: &Reader) -> u64 {
    let shares: u64 = READERS.iter().map(|reader| reader.share).sum();
    (number("IMPACTLAW_ATTACKS", COUNT) * reader.share / shares).max(20)
}

/// What is being read, and since when.
type Watched = Mutex<Option<(usize, u64, Instant)>>;

/// Ends the process when one input takes too long: nothing else stops a loop.
fn watch(now: &Watched, done: &AtomicBool) {
    while !done.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(50));
        if let Some((reader, input, since)) = *now.lock().unwrap()
            && since.elapsed() > LONGEST
        {
            let name = READERS[reader].name;
            eprintln!("{name}: input {input} takes more than {LONGEST:?}");
            std::process::abort();
        }
    }
}

/// Ends the watch, also when a reader's own seeds cannot be made.
struct Watch<'a>(&'a AtomicBool);

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// What went wrong with an input.
fn fault(
    index: usize,
    input: u64,
    bytes: &[u8],
    folder: &std::path::Path,
) -> (bool, Option<String>) {
    let reader = &READERS[index];
    let work = || catch_unwind(AssertUnwindSafe(|| (reader.read)(bytes, folder)));
    match peak_of((index, input), work) {
        (Ok(accepted), peak) if peak <= MOST => (accepted, None),
        (Ok(_), peak) => (false, Some(format!("held {peak} bytes"))),
        (Err(why), _) => {
            let text = why.downcast_ref::<String>().cloned();
            let text = text.or_else(|| why.downcast_ref::<&str>().map(|&text| text.to_owned()));
            (false, Some(text.unwrap_or_default()))
        }
    }
}

/// A folder for files that live for a moment, in memory where there is such a place.
fn scratch() -> tempfile::TempDir {
    tempfile::tempdir_in("/dev/shm").unwrap_or_else(|_| tempfile::tempdir().unwrap())
}

/// Faults of one reader over its inputs, and how many it accepted.
fn attack(index: usize, now: &Watched) -> (Vec<String>, [u64; 2]) {
    let reader = &READERS[index];
    let seeds = (reader.seeds)();
    let folder = scratch();
    let (mut faults, mut accepted) = (Vec::new(), 0);
    for (k, seed) in seeds.iter().enumerate() {
        let (taken, fault) = fault(index, 0, seed, folder.path());
        if !taken || fault.is_some() {
            faults.push(format!("{}, seed {k} is refused: {fault:?}", reader.name));
        }
    }
    let first = number("IMPACTLAW_ATTACK_SEED", 0) << 32;
    let count = inputs_of(reader);
    for input in 0..count {
        let mut random = Pcg64::seed_from_u64(first + input);
        let bytes = mutated(&seeds, reader.kind, &mut random);
        *now.lock().unwrap() = Some((index, input, Instant::now()));
        let (taken, fault) = fault(index, input, &bytes, folder.path());
        *now.lock().unwrap() = None;
        accepted += u64::from(taken);
        if let Some(fault) = fault {
            let place = std::env::temp_dir().join(format!("impactlaw-attack-{index}-{input}"));
            std::fs::write(&place, &bytes).unwrap();
            faults.push(format!(
                "{}, input {input} ({}): {fault}",
                reader.name,
                place.display()
            ));
        }
    }
    (faults, [count, accepted])
}

#[test]
fn no_input_makes_a_reader_panic_hang_or_fill_the_memory() {
    let (now, done) = (Watched::default(), AtomicBool::new(false));
    let mut faults = Vec::new();
    std::thread::scope(|scope| {
        scope.spawn(|| watch(&now, &done));
        let _watch = Watch(&done);
        for (index, reader) in READERS.iter().enumerate() {
            let began = Instant::now();
            let (found, [count, accepted]) = attack(index, &now);
            let seconds = began.elapsed().as_secs_f64();
            let name = reader.name;
            println!(
                "{name:26} {count:8} inputs {accepted:8} accepted {seconds:7.1} s {} faults",
                found.len()
            );
            faults.extend(found);
        }
    });
    let shown: Vec<&String> = faults.iter().take(20).collect();
    assert!(faults.is_empty(), "{} faults: {shown:#?}", faults.len());
}
