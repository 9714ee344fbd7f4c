//! What this program writes, checked before it is there: a certificate that its own checker rejects is none.

use anyhow::{Context, Result, bail};
use std::time::Duration;
use viewcert_check::{Certificate, Failure, Graph, Limits};
use viewcert_formats::NamedGraph;

/// Operations of the checker, and bytes that it reads, in a second; and what is always spent on it.
const OPERATIONS: f64 = 3e9;
const BYTES: f64 = 3e7;
const ALWAYS: Duration = Duration::from_millis(50);

/// Checks the certificate of a graph that took so long to find; or says that it would take longer.
///
/// # Errors
/// If it is rejected.
pub(super) fn is_checked(text: &[u8], input: &NamedGraph, found_in: Duration) -> Result<bool> {
    let time = found_in.max(ALWAYS).as_secs_f64();
    if text.len() as f64 > BYTES * time {
        return Ok(false);
    }
    let limits = Limits {
        operations: (OPERATIONS * time) as u64,
        ..Limits::default()
    };
    let pairs = input.graph.edges().iter().copied();
    let graph = Graph::new(input.graph.nodes(), pairs).with_context(|| input.name.clone())?;
    let checked = Certificate::parse(text)
        .and_then(|certificate| certificate.check(Some(&graph.as_stated()), None, &limits));
    match checked {
        Ok(_) => Ok(true),
        Err(Failure::TooLarge(_)) => Ok(false),
        Err(Failure::Rejected(why)) => bail!(
            "{}: the certificate that was found is rejected by viewcert-check, so that it is not written: {why}; this \
             is a mistake of this program, please report it",
            input.name
        ),
    }
}
