//! The commands, a file for each.

pub mod catalog;
pub mod census;
pub mod compare;
pub mod conditions;
pub mod man;
pub mod mixtures;
pub mod motion;
pub mod oriented;
pub mod publish;
pub mod published;
pub mod random;
pub mod scenes;
pub mod solutions;
pub mod thin;
pub mod tolerances;

use std::ops::RangeInclusive;

/// Reads `9` or `3-10`.
fn sizes(text: &str) -> Result<RangeInclusive<usize>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if 3 <= first && first <= last => Ok(first..=last),
        _ => Err("write one number of nodes or two, from 3 up, as in 9 or 3-10".into()),
    }
}
