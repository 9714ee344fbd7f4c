//! Why a certificate is not accepted.

use std::fmt;

/// A certificate was not verified: which step failed, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    step: String,
    reason: String,
}

/// What every step of the check returns.
pub(crate) type Checked<T> = Result<T, Rejection>;

impl Rejection {
    pub(crate) fn new(reason: impl Into<String>) -> Rejection {
        Rejection { step: String::new(), reason: reason.into() }
    }

    /// Where in the certificate, for example `pieces[0].evidence[1] (plane-flow)`.
    pub fn step(&self) -> &str {
        if self.step.is_empty() { "document" } else { &self.step }
    }

    /// What is wrong there.
    pub fn reason(&self) -> &str {
        &self.reason
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.step(), self.reason)
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
        self.map_err(|inner| Rejection {
            step: if inner.step.is_empty() { step() } else { format!("{}.{}", step(), inner.step) },
            reason: inner.reason,
        })
    }
}
