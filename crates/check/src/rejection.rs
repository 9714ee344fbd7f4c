//! Why there is no answer `VERIFIED`: what was found wrong, or too large, or not readable.

use std::fmt;

/// Reasons are cut to this many characters: a certificate must not fill a terminal.
const LONGEST_REASON: usize = 200;

/// A certificate was not verified: something in it does not hold, or cannot be verified.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// Where in the certificate, for example `pieces[0].evidence[1] (plane-flow)`; empty if it is
    /// not in one place.
    pub step: String,
    /// What is wrong there, on one line.
    pub reason: String,
}

/// A certificate was not decided: checking it would cost more than the limits allow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TooLarge {
    /// Where in the certificate, as for a rejection.
    pub step: String,
    /// What is too large, on one line.
    pub reason: String,
    /// The option of the program that raises the limit.
    pub option: &'static str,
}

/// Why a certificate was not verified.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// It is wrong, or cannot be verified.
    Rejected(Rejection),
    /// It may be right, but the limits do not allow to find out.
    TooLarge(TooLarge),
}

/// A file that does not hold a graph, or not in one way only.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// What is wrong with it, on one line.
    pub reason: String,
}

pub(crate) type Checked<T> = Result<T, Failure>;

impl Failure {
    pub(crate) fn rejected(reason: impl AsRef<str>) -> Failure {
        Failure::Rejected(Rejection {
            step: String::new(),
            reason: shown(reason.as_ref()),
        })
    }

    pub(crate) fn too_large(reason: impl AsRef<str>, option: &'static str) -> Failure {
        Failure::TooLarge(TooLarge {
            step: String::new(),
            reason: shown(reason.as_ref()),
            option,
        })
    }
}

/// A text that may come from a file, in such a form that it cannot pass for something else: on one
/// line, without control characters, and not longer than so many characters.
pub(crate) fn escaped(text: &str, most: usize) -> String {
    let mut shown = String::new();
    for character in text.chars() {
        let printable = matches!(character, ' '..='~');
        let piece = if printable {
            character.to_string()
        } else {
            character.escape_default().to_string()
        };
        if shown.len() + piece.len() > most {
            return shown + "...";
        }
        shown += &piece;
    }
    shown
}

fn shown(text: &str) -> String {
    escaped(text, LONGEST_REASON - 3)
}

impl From<String> for Failure {
    fn from(reason: String) -> Failure {
        Failure::rejected(reason)
    }
}

impl From<String> for Unreadable {
    fn from(reason: String) -> Unreadable {
        Unreadable {
            reason: shown(&reason),
        }
    }
}

impl From<Unreadable> for Failure {
    fn from(error: Unreadable) -> Failure {
        Failure::rejected(error.reason)
    }
}

fn step_and_reason(f: &mut fmt::Formatter<'_>, step: &str, reason: &str) -> fmt::Result {
    let colon = if step.is_empty() { "" } else { ": " };
    write!(f, "{step}{colon}{reason}")
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        step_and_reason(f, &self.step, &self.reason)
    }
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("too large for the limits: ")?;
        step_and_reason(f, &self.step, &self.reason)?;
        write!(f, "; raise it with {}", self.option)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Rejected(rejection) => rejection.fmt(f),
            Failure::TooLarge(limit) => limit.fmt(f),
        }
    }
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for Rejection {}
impl std::error::Error for TooLarge {}
impl std::error::Error for Failure {}
impl std::error::Error for Unreadable {}

/// Returns an error with the reason unless the condition holds.
macro_rules! ensure {
    ($condition:expr, $($reason:tt)+) => {
        if !$condition {
            return Err(From::from(format!($($reason)+)));
        }
    };
}
pub(crate) use ensure;

/// Says in which step something failed; outer steps are put in front of inner ones.
pub(crate) trait Within {
    fn within(self, step: impl FnOnce() -> String) -> Self;
}

impl<T> Within for Checked<T> {
    fn within(self, step: impl FnOnce() -> String) -> Self {
        self.map_err(|mut failure| {
            let (Failure::Rejected(Rejection { step: inner, .. })
            | Failure::TooLarge(TooLarge { step: inner, .. })) = &mut failure;
            let dot = if inner.is_empty() { "" } else { "." };
            *inner = step() + dot + inner;
            failure
        })
    }
}

#[cfg(test)]
mod tests;
