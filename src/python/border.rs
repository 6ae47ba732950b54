//! Border between Python and the library: errors, panics, warnings, interrupts and threads.

use impactlaw::command::{another_kind, diagnostic};
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyUserWarning};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::any::Any;
use std::ffi::CString;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, Once, PoisonError};
use std::time::Duration;
use tracing::Level;

create_exception!(
    impactlaw,
    Error,
    PyException,
    "What the library or the program cannot do: the place, what was found, and what is allowed.\n\n`report` is the text as the program prints it, with the line of the file."
);

/// How often long work looks whether it is to end.
const LOOK: Duration = Duration::from_millis(50);

/// `error` as Python raises it.
pub fn raised(py: Python<'_>, error: impactlaw::Error) -> PyErr {
    let error = another_kind::named(error);
    let raised = Error::new_err(error.to_string());
    // an exception without its report is still the exception
    let _ = (raised.value(py)).setattr("report", diagnostic::plain(&error));
    raised
}

/// Refusal of `found` where `what` was to be given.
pub fn refused(what: &str, found: String, allowed: &str) -> impactlaw::Error {
    impactlaw::Error::Refused {
        what: what.to_owned(),
        found,
        allowed: allowed.to_owned(),
    }
}

/// What a panic says.
fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("no reason given").to_owned()
}

/// What came of work that may have panicked.
type Caught<T> = std::thread::Result<impactlaw::Result<T>>;

fn caught<T>(work: impl FnOnce() -> impactlaw::Result<T>) -> Caught<T> {
    catch_unwind(AssertUnwindSafe(work))
}

fn outcome<T>(py: Python<'_>, done: Caught<T>) -> PyResult<T> {
    tell(py)?;
    match done {
        Ok(done) => done.map_err(|error| raised(py, error)),
        Err(panic) => Err(Error::new_err(format!(
            "impactlaw has a fault that should be reported: {}",
            said(panic.as_ref())
        ))),
    }
}

/// Does short `work` without the interpreter's lock.
pub fn short<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> impactlaw::Result<T> + Send,
) -> PyResult<T> {
    listen();
    let done = py.detach(|| caught(work));
    outcome(py, done)
}

/// Does `work` on the threads of the package, without the interpreter's lock; for work that is short by itself.
pub fn on_threads<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> impactlaw::Result<T> + Send,
) -> PyResult<T> {
    listen();
    let done = py.detach(|| caught(|| threads()?.install(work)));
    outcome(py, done)
}

/// Does long `work` on the threads of the package, without the interpreter's lock. Ctrl-C sets the flag, at which the work has to
/// end soon, and is raised then.
pub fn long<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Arc<AtomicBool>) -> impactlaw::Result<T> + Send,
) -> PyResult<T> {
    listen();
    let stop = Arc::new(AtomicBool::new(false));
    let (done, interrupt) = py.detach(|| {
        std::thread::scope(|scope| {
            let (tell, told) = channel();
            let flag = &stop;
            let worker = scope.spawn(move || {
                let done = caught(|| threads()?.install(|| work(flag)));
                // who waits for it is there until it comes
                let _ = tell.send(());
                done
            });
            let mut interrupt = None;
            while let Err(RecvTimeoutError::Timeout) = told.recv_timeout(LOOK) {
                if interrupt.is_none() {
                    interrupt = Python::attach(|py| py.check_signals()).err();
                    stop.store(interrupt.is_some(), Ordering::Relaxed);
                }
            }
            (worker.join().and_then(|done| done), interrupt)
        })
    });
    match interrupt {
        Some(interrupt) => Err(interrupt),
        None => outcome(py, done),
    }
}

/// Threads of the package. A process that was forked has none of its parent's, and gets its own.
fn threads() -> impactlaw::Result<Arc<ThreadPool>> {
    static THREADS: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((_, pool)) = threads.as_ref().filter(|(owner, _)| *owner == process) {
        return Ok(pool.clone());
    }
    let pool = ThreadPoolBuilder::new().build();
    let pool = pool.map_err(|why| refused("threads", why.to_string(), "must start"))?;
    let pool = Arc::new(pool);
    // threads of another process cannot be ended here
    std::mem::forget(threads.replace((process, pool.clone())));
    Ok(pool)
}

/// What the library has warned of.
static SAID: Mutex<Vec<u8>> = Mutex::new(Vec::new());

struct Ear;

impl Write for Ear {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
        said.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Takes in the library's warnings from now on.
fn listen() {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(|| {
        let ear = tracing_subscriber::fmt()
            .with_max_level(Level::WARN)
            .with_writer(|| Ear)
            .with_ansi(false)
            .with_target(false)
            .with_level(false)
            .without_time();
        // where the host listens itself, it hears them
        ear.try_init().ok();
    });
}

/// Hands what the library has warned of to Python.
fn tell(py: Python<'_>) -> PyResult<()> {
    let said = std::mem::take(&mut *SAID.lock().unwrap_or_else(PoisonError::into_inner));
    let said = String::from_utf8_lossy(&said);
    (said.lines()).try_for_each(|line| warn(py, line.trim()))
}

/// A warning of Python's.
pub fn warn(py: Python<'_>, text: &str) -> PyResult<()> {
    let text = CString::new(text.replace('\0', "")).unwrap_or_default();
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)
}
