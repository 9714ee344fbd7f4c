//! What is wrong with a folder, in one message.

use anyhow::{Result, bail};

/// Most that are named one by one.
const NAMED: usize = 10;

/// Some words, and how many more there are.
pub(crate) fn listed(words: &[String], between: &str) -> String {
    let named = words[..words.len().min(NAMED)].join(between);
    match words.len().saturating_sub(NAMED) {
        0 => named,
        more => format!("{named}{between}and {more} more"),
    }
}

/// Says what is wrong, if anything is.
///
/// # Errors
/// The faults.
pub(crate) fn refuse(faults: &[String]) -> Result<()> {
    if faults.is_empty() {
        return Ok(());
    }
    bail!("{}", listed(faults, "; "))
}
