//! Runs killed at any time end with the bytes of those that were not; a folder has one writer; a full device is no crash.

use crate::program::{message, program};
use crate::runs::{Kept, assert_same, files};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::io::Write;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// Kills of each verb.
const KILLS: usize = 20;

/// Kills `child` after `time`, unless it ends before; whether it was killed.
fn killed_after(mut child: Child, time: Duration) -> bool {
    let began = Instant::now();
    while began.elapsed() < time {
        if let Some(status) = child.try_wait().unwrap() {
            assert!(matches!(status.code(), Some(0 | 1)), "{status}");
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    !child.wait().unwrap().success()
}

/// Twenty kills: a run is killed until it has ended, and then another one is.
fn ends_the_same_after_kills(verb: Kept) {
    let whole = tempfile::tempdir().unwrap();
    let began = Instant::now();
    verb.finish(whole.path());
    let mut seconds = began.elapsed().as_secs_f64();
    let mut random = Pcg64::seed_from_u64(verb as u64);
    let (mut kills, mut resumed) = (0, 0);
    while kills < KILLS {
        let folder = tempfile::tempdir().unwrap();
        let mut hits = 0;
        // some end by themselves: a kill that comes too late is none
        while kills < KILLS {
            let time = Duration::from_secs_f64(random.random_range(0.02..0.6) * seconds);
            let mut command = verb.command(folder.path());
            let began = Instant::now();
            if !killed_after(command.stderr(Stdio::null()).spawn().unwrap(), time) {
                if hits == 0 {
                    // a whole run: the first one may have had the machine for itself less than this one
                    seconds = seconds.min(began.elapsed().as_secs_f64());
                }
                break;
            }
            (kills, hits) = (kills + 1, hits + 1);
        }
        verb.finish(folder.path());
        assert_same(
            folder.path(),
            whole.path(),
            &format!("{verb:?} after {hits} kills"),
        );
        resumed += usize::from(hits > 0);
    }
    assert!(resumed > 0);
    println!("{verb:?}: {kills} kills in {resumed} runs of {seconds:.2} s");
}

#[test]
fn impacts_killed_twenty_times_end_with_the_same_bytes() {
    ends_the_same_after_kills(Kept::Impact);
}

#[test]
fn whole_runs_killed_twenty_times_end_with_the_same_bytes() {
    ends_the_same_after_kills(Kept::Run);
}

#[test]
fn beds_killed_twenty_times_end_with_the_same_bytes() {
    ends_the_same_after_kills(Kept::Bed);
}

#[test]
fn studies_killed_twenty_times_end_with_the_same_bytes() {
    ends_the_same_after_kills(Kept::Study);
}

fn wait_for(path: &Path) {
    let began = Instant::now();
    while !path.exists() {
        assert!(
            began.elapsed() < Duration::from_secs(60),
            "{}",
            path.display()
        );
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_second_process_in_a_folder_is_refused_and_the_first_does_not_notice() {
    let (shared, alone) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    Kept::Bed.finish(alone.path());
    let mut first = Kept::Bed.command(shared.path()).spawn().unwrap();
    wait_for(&shared.path().join("results/.impactlaw-lock"));
    for verb in [Kept::Bed, Kept::Impact] {
        let output = verb.command(shared.path()).output().unwrap();
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains("another impactlaw is writing there"),
            "{said}"
        );
    }
    assert!(matches!(first.wait().unwrap().code(), Some(0 | 1)));
    assert_same(shared.path(), alone.path(), "beside another");
}

#[test]
fn a_killed_process_leaves_a_folder_to_the_next_which_sweeps_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = Kept::Bed.command(folder.path()).spawn().unwrap();
    let packing = folder.path().join("results/bed/packing");
    wait_for(&packing.join("restart.bin"));
    first.kill().unwrap();
    first.wait().unwrap();
    // killed while it wrote a file
    std::fs::write(packing.join(".impactlaw-abc123.part"), "half").unwrap();
    Kept::Bed.finish(folder.path());
    for path in files(folder.path()) {
        let name = path.file_name().unwrap().to_string_lossy();
        assert!(!name.starts_with('.') && !name.ends_with(".bin"), "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_name_that_is_no_text_and_a_pipe_are_ordinary_input() {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().unwrap();
    let plan = |input: &std::ffi::OsStr, text: &str| {
        let mut command = program(folder.path());
        command.arg("plan").arg(input).stdin(Stdio::piped());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // one that does not read its input is gone before it is there
        let _ = child.stdin.take().unwrap().write_all(text.as_bytes());
        let output = child.wait_with_output().unwrap();
        (output.status.code(), message(&output))
    };
    let name = std::ffi::OsStr::from_bytes(b"a\xff.toml");
    let (code, said) = plan(name, "");
    assert_eq!(code, Some(2), "{said}");
    std::fs::write(folder.path().join(name), CASE_ALONE).unwrap();
    assert_eq!(plan(name, "").0, Some(0));
    assert_eq!(plan("/dev/stdin".as_ref(), CASE_ALONE).0, Some(0));
    let (code, said) = plan("/dev/stdin".as_ref(), "[particle]\nradius = \"0 um\"\n");
    assert_eq!(code, Some(2), "{said}");
    assert!(
        said.contains("/dev/stdin") && !said.contains("panicked"),
        "{said}"
    );
}

/// A case that names no bed.
const CASE_ALONE: &str = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"100 GPa\"\n\
    poisson_ratio = 0.35\nyield_strength = \"1.25 GPa\"\n[impact]\nvelocities = [\"10 m/s\"]\n[accuracy]\ntolerance = 0.1\n";

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_no_crash() {
    let full = || {
        std::fs::File::options()
            .write(true)
            .open("/dev/full")
            .unwrap()
    };
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let mut command = Kept::Impact.command(folder.path());
        command.args(arguments).stderr(Stdio::from(full()));
        command
    };
    assert_eq!(run(&["-v"]).status().unwrap().code(), Some(0));
    assert_eq!(
        run(&["-vv", "--velocity", "3 kg"]).status().unwrap().code(),
        Some(2)
    );
    let mut command = run(&[]);
    let status = command.stdout(Stdio::from(full())).status().unwrap();
    assert_eq!(status.code(), Some(2));
}
