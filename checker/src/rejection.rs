//! Why a certificate is not accepted.

use std::fmt;

/// A certificate was not verified, or a graph not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// Where in the certificate, for example `pieces[0].evidence[1] (plane-flow)`; empty if it is not in one place.
    pub step: String,
    /// What is wrong there.
    pub reason: String,
}

pub(crate) type Checked<T> = Result<T, Rejection>;

impl Rejection {
    pub(crate) fn new(reason: impl Into<String>) -> Rejection {
        Rejection { step: String::new(), reason: reason.into() }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}", self.step, if self.step.is_empty() { "" } else { ": " }, self.reason)
    }
}

impl std::error::Error for Rejection {}

/// Returns a rejection unless the condition holds.
macro_rules! ensure {
    ($condition:expr, $($reason:tt)+) => {
        if !$condition {
            return Err($crate::rejection::Rejection::new(format!($($reason)+)));
        }
    };
}
pub(crate) use ensure;

/// Says in which step a rejection happened; outer steps are put in front of inner ones.
pub(crate) trait Within {
    fn within(self, step: impl FnOnce() -> String) -> Self;
}

impl<T> Within for Checked<T> {
    fn within(self, step: impl FnOnce() -> String) -> Self {
        self.map_err(|Rejection { step: inner, reason }| {
            let dot = if inner.is_empty() { "" } else { "." };
            Rejection { step: step() + dot + &inner, reason }
        })
    }
}
