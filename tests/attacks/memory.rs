//! An allocator that counts what each thread holds, and ends the process before a reader fills the machine.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io::Write;

/// Most that a thread may hold while it is watched, bytes: past it the process ends.
const MOST_EVER: isize = 2 << 30;

thread_local! {
    static HELD: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
    /// The watched input: number of its reader and its own.
    static WATCHED: Cell<Option<(usize, u64)>> = const { Cell::new(None) };
}

struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Counts `size` bytes more or less for this thread.
fn count(size: isize) {
    // a thread that ends frees memory when its own values are gone
    let _ = HELD.try_with(|held| {
        let now = held.get() + size;
        held.set(now);
        PEAK.with(|peak| peak.set(peak.get().max(now)));
        if now > MOST_EVER
            && let Some((reader, input)) = WATCHED.get()
        {
            let mut error = std::io::stderr();
            let _ = writeln!(error, "reader {reader}, input {input}: holds {now} bytes");
            std::process::abort();
        }
    });
}

// SAFETY: everything is the system's; counting touches no memory of the heap
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        // SAFETY: as the caller's
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        // SAFETY: as the caller's
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        // SAFETY: as the caller's
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as isize - layout.size() as isize);
        // SAFETY: as the caller's
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// Largest number of bytes that `work` held at once beyond what was held before, on this thread.
pub fn peak_of<T>(watched: (usize, u64), work: impl FnOnce() -> T) -> (T, isize) {
    let before = HELD.get();
    PEAK.set(before);
    WATCHED.set(Some(watched));
    let done = work();
    WATCHED.set(None);
    (done, PEAK.get() - before)
}

#[test]
fn what_is_held_at_once_is_counted() {
    let (kept, peak) = peak_of((0, 0), || {
        drop(vec![0u8; 3 << 20]);
        vec![0u8; 1 << 20]
    });
    assert_eq!(kept.len(), 1 << 20);
    assert!((3 << 20..4 << 20).contains(&peak), "{peak}");
}
