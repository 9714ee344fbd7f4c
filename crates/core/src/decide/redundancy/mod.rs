//! What a decided graph can notice: which pairs check each other, and which are determined though
//! they are not there (docs/theory.md, section 15).
//!
//! In: a graph and its verdict. Out: the groups of its pairs, and its closure. Neither is part of a
//! certificate.

mod closure;
mod groups;
#[cfg(test)]
mod tests;

pub use closure::{Closure, closure};
pub use groups::{Groups, groups};

use crate::decide::error::VerdictError;
use crate::decide::verdict::Verdict;

/// Refuses verdicts that rest on more than pairs.
fn ensure_pairs_alone(verdict: &Verdict) -> Result<(), VerdictError> {
    if verdict.known_parts.is_empty() && verdict.displacements.is_empty() {
        return Ok(());
    }
    Err(VerdictError::PairsAlone)
}
