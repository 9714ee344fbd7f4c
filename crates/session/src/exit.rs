//! The table of exit codes; the help of the program and the README say the same.

use std::error::Error;
use std::fmt;
use std::io;
use viewcert::decide::VerdictError;
use viewcert::watch::{Reason, Stopped};
use viewcert_formats::ReadError;

/// All good.
pub const GOOD: u8 = 0;
/// Not solvable, or refuted.
pub const NOT: u8 = 1;
/// Bad usage or input.
pub const BAD_INPUT: u8 = 2;
/// Too large for the method, or for the limits of time and memory.
pub const TOO_LARGE: u8 = 3;
/// Stopped by SIGINT: 128 and its number, as shells have it.
pub const INTERRUPTED: u8 = 130;
/// Nobody reads on: what shells show for programs that a pipe has ended, 128 + SIGPIPE.
pub const BROKEN_PIPE: u8 = 141;
/// Stopped by SIGTERM.
pub const TERMINATED: u8 = 143;

/// Why work was stopped, if that is what an error says.
pub(crate) fn stopped(error: &anyhow::Error) -> Option<&Stopped> {
    error
        .chain()
        .find_map(|cause| match cause.downcast_ref::<VerdictError>() {
            Some(VerdictError::Stopped(stopped)) => Some(stopped),
            _ => cause.downcast_ref(),
        })
}

/// Whether an error says that nobody reads a pipe any more, as in `verify ... | head`. That is
/// no reason for a message.
pub fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        let kind = cause
            .downcast_ref::<io::Error>()
            .map(io::Error::kind)
            .or_else(|| cause.downcast_ref::<serde_json::Error>()?.io_error_kind());
        kind == Some(io::ErrorKind::BrokenPipe)
    })
}

/// Whether an error ends the whole run: not that of a graph, which has a time limit of its own, but of the
/// memory, by a signal, or since nobody reads on.
pub fn ends_run(error: &anyhow::Error) -> bool {
    let of_one = |reason: &Reason| matches!(reason, Reason::TooLarge { .. } | Reason::Time);
    is_broken_pipe(error) || stopped(error).is_some_and(|stopped| !of_one(&stopped.reason))
}

/// Whether an error means that something is too large, for the method or for the limits of time and
/// memory.
pub fn is_too_large(error: &anyhow::Error) -> bool {
    if let Some(stopped) = stopped(error) {
        return stopped.reason != Reason::Interrupted;
    }
    error.chain().any(|cause| {
        matches!(cause.downcast_ref(), Some(VerdictError::TooLarge { .. }))
            || cause.is::<TooLarge>()
            || matches!(cause.downcast_ref::<ReadError>(), Some(error) if error.problem.is_size())
    })
}

/// Something that is too large, in the words of whoever found it so.
#[derive(Clone, Debug)]
pub struct TooLarge(pub String);

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Error for TooLarge {}
