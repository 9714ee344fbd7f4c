//! Internal to viewcert, and may change at any time.
//!
//! One run of a program: what may end it early, what shows that it goes on, where its outputs go, and
//! with which code it ends.
//!
//! In: limits. Out: a [`Session`], which is passed to whatever does the work; nothing here is global.

mod bar;
pub mod exit;
mod limits;
pub mod outputs;
mod session;

pub use limits::{MemoryLimit, RunLimits, TimeLimit, default_memory_limit};
pub use outputs::Outputs;
pub use session::Session;
pub use viewcert::wording::printable;

use std::fmt::Display;
use std::io::{self, Write};
use std::sync::{Mutex, MutexGuard};

/// Says something on standard error, on one line.
///
/// # Errors
/// If it cannot be written.
pub fn complain(program: &str, what: impl Display) -> io::Result<()> {
    writeln!(io::stderr(), "{program}: {}", printable(&what.to_string()))
}

/// What a mutex holds, also if a thread has panicked with it: counters and paths are whole at any time.
fn unpoisoned<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|broken| broken.into_inner())
}
