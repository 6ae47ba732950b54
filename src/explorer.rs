//! Root of the library as WebAssembly: the rooms that the page of `impactlaw explore` asks, and the border between the two memories.
//!
//! The rooms are the library's own files; `atlas`, `fit`, `export` and `explore` come with those of their files that make no atlas, fit no law
//! and write no other code. Nothing of it is compiled for another target.
#![cfg(target_family = "wasm")]
// what other parts of the library use of these rooms has no user here
#![allow(dead_code, unused_imports)]

#[path = "explorer/atlas.rs"]
mod atlas;
mod case;
mod contact;
mod curve;
mod document;
mod error;
#[path = "explorer/explore.rs"]
mod explore;
#[path = "explorer/export.rs"]
mod export;
mod files;
#[path = "explorer/fit.rs"]
mod fit;
mod lanes;
mod law;
mod material;
mod scheme;
mod shape;
mod space;
mod table;
mod tape;
mod theory;
mod unit;

pub use error::{Error, Place, Result};
use std::sync::{Mutex, Once, PoisonError};

/// Program name and version, for provenance.
pub const PROGRAM: &str = concat!("impactlaw ", env!("CARGO_PKG_VERSION"));

/// What `impactlaw explore` looks for before it takes a file: `explore::page::MARK` of this version.
#[used]
static MARK: &[u8] = concat!("explorer of impactlaw ", env!("CARGO_PKG_VERSION"), ";").as_bytes();

/// Place for a question of `length` bytes. It is given back by [`answer`].
#[unsafe(no_mangle)]
pub extern "C" fn allocate(length: usize) -> *mut u8 {
    Box::into_raw(vec![0u8; length].into_boxed_slice()).cast()
}

/// Answers the question (JSON in UTF-8) at `place`: the place of the answer in the upper 32 bits, its length in the lower.
///
/// # Safety
/// `place` comes from [`allocate`] with the same `length`, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn answer(place: *mut u8, length: usize) -> u64 {
    // SAFETY: as the caller says
    let question = unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(place, length)) };
    LISTEN.call_once(|| {
        std::panic::set_hook(Box::new(|panic| {
            let mut last = LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner);
            *last = panic.to_string();
        }));
    });
    handed_out(explore::answer(&String::from_utf8_lossy(&question)))
}

/// What a panic said, after which nothing else of this memory is to be trusted; as [`answer`].
#[unsafe(no_mangle)]
pub extern "C" fn last_words() -> u64 {
    let last = LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner);
    handed_out(last.clone())
}

static LISTEN: Once = Once::new();
static LAST_WORDS: Mutex<String> = Mutex::new(String::new());

/// Place and length of a text that the other side gives back.
fn handed_out(text: String) -> u64 {
    let text = text.into_bytes().into_boxed_slice();
    let length = text.len() as u64;
    let place = Box::into_raw(text).cast::<u8>() as u64;
    place << 32 | length
}

/// Gives back the place of an answer.
///
/// # Safety
/// `place` and `length` come from [`answer`], and are not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn release(place: *mut u8, length: usize) {
    // SAFETY: as the caller says
    drop(unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(place, length)) });
}
